// The C interface driven by random calls, in any order, with null and odd arguments. No crash, no
// leak, no status that is not in rsc.h or that confesses an internal error, no number that is not
// finite among the results of a call that succeeded.
#include <fuzzer/FuzzedDataProvider.h>

#include "promise.hpp"
#include "rsc.h"

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string message() {
    char text[4096];
    rsc_message(text, sizeof text, nullptr);
    return text;
}

class Session {
public:
    Session(const std::uint8_t* data, std::size_t size) : in_(data, size) {}
    ~Session() {
        hold(case_, nullptr);
        hold(surface_, nullptr);
        hold(asperities_, nullptr);
        hold(contacts_[0], nullptr);
        hold(contacts_[1], nullptr);
    }
    void run() {
        for (int calls = 0; calls < 40 && in_.remaining_bytes() > 0; ++calls) call();
    }

private:
    static std::int32_t destroy(rsc_case** h) { return rsc_case_destroy(h); }
    static std::int32_t destroy(rsc_surface** h) { return rsc_surface_destroy(h); }
    static std::int32_t destroy(rsc_asperities** h) { return rsc_asperities_destroy(h); }
    static std::int32_t destroy(rsc_contact** h) { return rsc_contact_destroy(h); }
    // What `make` makes takes the place of what was held.
    template <class T>
    void hold(T*& held, const std::function<std::int32_t(std::type_identity_t<T>**)>& make) {
        T* made = nullptr;
        if (make)
            PROMISE(told(make(&made)) == (made != nullptr),
                    "a handle that does not match the status");
        PROMISE(destroy(&held) == RSC_SUCCESS && !held, "a handle that is not destroyed");
        held = made;
    }

    // True for success; the status must be one that the header promises.
    bool told(std::int32_t status) {
        PROMISE(status >= -10 && status < RSC_INTERNAL, std::to_string(status) + ": " + message());
        PROMISE(status == RSC_SUCCESS || !message().empty(), "a failure without a message");
        return status == RSC_SUCCESS;
    }
    void finite(double v, const char* what) { PROMISE(std::isfinite(v), what); }

    double number() {
        static const double odd[] = {0,          1,      -1,    1e-3,   1e3,    1e-9,
                                     1e9,        1e-300, 1e300, -1e300, 5e-324, kInfinity,
                                     -kInfinity, NAN,    0.5,   2};
        const auto k = in_.ConsumeIntegral<std::uint8_t>();
        if (k < 32) return odd[k % 16];
        return std::ldexp(double(in_.ConsumeIntegral<std::int16_t>()) / 32768, k % 16 - 12);
    }
    double positive() {
        const double v = std::abs(number());
        return in_.ConsumeIntegral<std::uint8_t>() == 0 ? -v : v;
    }
    bool rare() { return in_.ConsumeIntegral<std::uint8_t>() >= 250; }

    std::vector<double> numbers(std::size_t n, bool absolute = false) {
        std::vector<double> v(n);
        for (double& x : v) x = absolute ? std::abs(number()) : number();
        return v;
    }

    rsc_contact*& contact() { return contacts_[in_.ConsumeBool() ? 1 : 0]; }

    template <class Get>
    void text(Get get) {
        char buffer[64];
        std::int64_t length = 0;
        const std::int64_t size = in_.ConsumeIntegralInRange<std::int64_t>(-1, 64);
        if (told(get(rare() ? nullptr : buffer, size, &length)) && size > 0)
            PROMISE(std::char_traits<char>::length(buffer) < static_cast<std::size_t>(size),
                    "text not ended");
    }

    // What the program would do without complaint, but for hours.
    void keep_small(bool run) {
        if (!case_) return;
        static const char* const small[][2] = {{"surface%n", "32"},
                                               {"surface%L_lambda_s", "12"},
                                               {"surface%L_lambda_l", "2"},
                                               {"run%threads", "1"},
                                               {"output%map_cells", "5"},
                                               {"output%radial_bins", "5"},
                                               {"output%pdf_bins", "5"},
                                               {"indentation%steps", "3"},
                                               {"run%realizations", "1"},
                                               {"solver%max_iterations", "50"},
                                               {"surface%source", "'synthetic'"}};
        for (std::size_t k = 0; k < (run ? std::size(small) : 4); ++k)
            told(rsc_case_set(case_, small[k][0], small[k][1]));
        told(rsc_case_set(case_, "solver%max_iterations", "50"));
        const std::string file = "'" + scratch("fuzz_api.nc") + "'";
        told(rsc_case_set(case_, "output%file", file.c_str()));
    }

    void call() {
        double v[3] = {};
        switch (in_.ConsumeIntegralInRange(0, 19)) {
            case 0: hold(case_, rsc_case_create); break;
            case 1: told(rsc_case_read(case_, in_.ConsumeRandomLengthString(200).c_str())); break;
            case 2: {
                char name[64];
                if (!told(rsc_key_name(in_.ConsumeIntegralInRange<std::int64_t>(-1, 60), name,
                                       sizeof name, nullptr)))
                    break;
                const std::string value = in_.ConsumeBool()
                                              ? std::to_string(number())
                                              : "'" + in_.ConsumeRandomLengthString(12) + "'";
                told(rsc_case_set(case_, name, value.c_str()));
                text([&](char* b, std::int64_t n, std::int64_t* l) {
                    return rsc_case_get(case_, name, b, n, l);
                });
                break;
            }
            case 3:
                text([&](char* b, std::int64_t n, std::int64_t* l) {
                    return rsc_case_text(case_, b, n, l);
                });
                break;
            case 4:
                hold(case_, [&](rsc_case** c) { return rsc_case_copy(c, case_); });
                hold(surface_, [&](rsc_surface** s) { return rsc_surface_copy(s, surface_); });
                break;
            case 5:
                if (!case_) break;  // the defaults are a large surface
                keep_small(false);
                hold(surface_, [&](rsc_surface** s) {
                    return rsc_surface_synthesize(s, case_, in_.ConsumeIntegral<std::int64_t>());
                });
                break;
            case 6: {
                const auto nx = in_.ConsumeIntegralInRange<std::int64_t>(2, 9),
                           ny = in_.ConsumeIntegralInRange<std::int64_t>(2, 9);
                const auto z = numbers(static_cast<std::size_t>(nx * ny));
                hold(surface_, [&](rsc_surface** s) {
                    return rsc_surface_take(s, rare() ? std::int64_t{1} << 33 : nx, ny, positive(),
                                            positive(), number(), number(),
                                            in_.ConsumeIntegralInRange(0, 1),
                                            rare() ? nullptr : z.data());
                });
                break;
            }
            case 7: {
                static const char* const how[] = {"none",      "mean",   "plane",
                                                  "quadratic", "sphere", "other"};
                if (told(rsc_surface_detrend(surface_, in_.PickValueInArray(how), v)))
                    finite(v[0], "rms");
                told(rsc_surface_filter(surface_, positive()));
                if (told(rsc_surface_moments(surface_, &v[0], &v[1], &v[2])))
                    finite(v[0] + v[1] + v[2], "moments");
                break;
            }
            case 8:
                hold(asperities_, [&](rsc_asperities** a) {
                    return rsc_asperities_find(a, surface_, rare() ? nullptr : case_);
                });
                break;
            case 9:
                if (!case_) break;
                keep_small(false);
                hold(asperities_, [&](rsc_asperities** a) {
                    return rsc_asperities_make(a, case_, in_.ConsumeIntegral<std::int64_t>());
                });
                break;
            case 10:
            case 11: take_asperities(); break;
            case 12:
                hold(contacts_[0], [&](rsc_contact** c) {
                    return rsc_contact_create(c, asperities_, positive(), positive(), number(),
                                              number(), case_);
                });
                break;
            case 13:
                hold(contacts_[0], [&](rsc_contact** c) {
                    return rsc_contact_create_from_case(c, asperities_, case_);
                });
                break;
            case 14:
                hold(contacts_[1],
                     [&](rsc_contact** c) { return rsc_contact_copy(c, contacts_[0]); });
                break;
            case 15: {
                rsc_contact* const c = contact();
                told(rsc_contact_move_tip(c, number(), number()));
                if (told(rsc_contact_stiffness(c, v))) finite(v[0], "stiffness");
                const auto x = numbers(3), y = numbers(3);
                if (told(rsc_contact_deflection(c, 3, x.data(), y.data(), v)))
                    finite(v[0] + v[1] + v[2], "deflection");
                break;
            }
            case 16: {
                rsc_contact* const c = contact();
                if (told(rsc_contact_first_touch(c, v))) indent(c, v[0] - positive());
                finite(v[0], "first touch");
                indent(c, number());
                break;
            }
            case 17: {
                rsc_contact* const c = contact();
                if (told(rsc_contact_press(c, positive(), v))) finite(v[0], "separation");
                look(c);
                break;
            }
            case 18:
                if (!case_) break;
                told(rsc_case_set(case_, "solids%adhesion", std::to_string(positive()).c_str()));
                if (in_.ConsumeBool())
                    told(rsc_case_set(case_, "solids%adhesion_range",
                                      std::to_string(positive()).c_str()));
                break;
            case 19: {
                if (!case_) break;
                keep_small(true);
                std::int64_t failed = 0;
                told(rsc_case_run(case_, &failed));
            }
        }
    }

    void take_asperities() {
        const auto n = in_.ConsumeIntegralInRange<std::size_t>(0, 12);
        const bool curved = in_.ConsumeBool(), flattened = in_.ConsumeBool();
        const auto x = numbers(n), y = numbers(n), z = numbers(n), r = numbers(n, true),
                   k2 = numbers(n, true);
        const auto angle = numbers(n);
        const auto b = numbers(n);
        std::vector<double> k1 = k2;
        for (double& k : k1) k *= 1 + std::abs(number());
        hold(asperities_, [&](rsc_asperities** a) {
            return rsc_asperities_take(
                a, rare() ? -1 : static_cast<std::int64_t>(n), x.data(), y.data(), z.data(),
                r.data(), curved ? k1.data() : nullptr, curved ? k2.data() : nullptr,
                curved ? angle.data() : nullptr, flattened ? b.data() : nullptr);
        });
    }

    void indent(rsc_contact* c, double separation) {
        double force = 0;
        const std::int32_t status = rsc_contact_indent(c, separation, &force);
        told(status);
        if (status == RSC_SUCCESS) finite(force, "force");
        look(c);
    }

    void look(rsc_contact* c) {
        double separation = 0, force = 0, area = 0, energy = 0, residual = 0;
        std::int64_t contacts = 0, candidates = 0, pairs = 0;
        std::int32_t level = 0;
        if (!told(rsc_contact_result(c, &separation, &force, &area, &contacts))) return;
        PROMISE(told(rsc_contact_level(c, &level, &candidates, nullptr, &pairs, &residual)),
                "level");
        finite(separation, "separation");
        PROMISE(std::isfinite(force), "force " + std::to_string(force));  // negative with adhesion
        PROMISE(std::isfinite(area) && area >= 0, "area " + std::to_string(area));
        PROMISE(level >= 0 && level < RSC_LEVEL_LAST_ + 1 && contacts <= candidates, "level");
        PROMISE(std::isfinite(residual), "residual at separation " + std::to_string(separation) +
                                             ", force " + std::to_string(force) + ", status " +
                                             std::to_string(level) + ", " +
                                             std::to_string(contacts) + " contacts");
        if (told(rsc_contact_energy(c, &energy))) finite(energy, "energy");
        std::vector<double> f(static_cast<std::size_t>(contacts)), a(f), u(f);
        std::vector<std::int32_t> which(f.size());
        PROMISE(told(rsc_contact_spots(c, contacts, which.data(), f.data(), a.data(), u.data())),
                "spots");
        for (std::size_t k = 0; k < f.size(); ++k)
            PROMISE(std::isfinite(f[k]) && std::isfinite(a[k]) && std::isfinite(u[k]), "a spot");
    }

    FuzzedDataProvider in_;
    rsc_case* case_ = nullptr;
    rsc_surface* surface_ = nullptr;
    rsc_asperities* asperities_ = nullptr;
    rsc_contact* contacts_[2] = {};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Session(data, size).run();
    return 0;
}
