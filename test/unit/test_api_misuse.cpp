// The C interface misused: every entry with null, wrong sizes, NaN, negative numbers, coincident points, after a failure and
// twice destroyed. Each refusal names its argument, and nothing else changes. Run under AddressSanitizer and UBSan it shows that
// a refusal touches no memory it was not given.
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "rsc.h"

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBefore = 12345;  // what outputs hold before a call
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

#define OK(call) CHECK((call) == RSC_SUCCESS)

std::string message() {
    char buffer[5000];
    std::int64_t length = 0;
    OK(rsc_message(buffer, sizeof buffer, &length));
    CHECK(length == static_cast<std::int64_t>(std::strlen(buffer)));
    return buffer;
}

// The call is refused because of this argument, and says so.
#define REFUSED(argument, call)       \
    do {                              \
        CHECK((call) == -(argument)); \
        CHECK(!message().empty());    \
    } while (0)

void test_case() {
    rsc_case* c = nullptr;
    char b[8] = "before";
    std::int64_t length = 77;
    REFUSED(1, rsc_case_create(nullptr));
    REFUSED(1, rsc_case_destroy(nullptr));
    OK(rsc_case_destroy(&c));
    OK(rsc_case_create(&c));
    rsc_case* d = c;
    REFUSED(1, rsc_case_copy(nullptr, c));
    REFUSED(2, rsc_case_copy(&d, nullptr));
    CHECK(d == nullptr);
    REFUSED(1, rsc_case_read(nullptr, "&run /"));
    REFUSED(2, rsc_case_read(c, nullptr));
    for (const char* bad :
         {"", "nothing here", "&run", "&run seed = 'x' /", "&surface sigma = NaN /", "&nosuch a=1 /", "&surface n = 2048 n = 4096 /"})
        REFUSED(2, rsc_case_read(c, bad));
    REFUSED(1, rsc_case_set(nullptr, "surface%n", "256"));
    REFUSED(2, rsc_case_set(c, nullptr, "256"));
    REFUSED(3, rsc_case_set(c, "surface%n", nullptr));
    for (const char* bad :
         {"", "%", "n", "surface", "surface%", "%n", "surface%m", "surface%n%n", "solids%E(3)", "solids%E(0)", "study%mode", "\xff%\xff"})
        REFUSED(2, rsc_case_set(c, bad, "1"));
    for (const char* bad : {"x", "1 2", "-4", "1.5", "99999999999999999999", "NaN", "&run", "'256'"})
        REFUSED(3, rsc_case_set(c, "surface%n", bad));
    REFUSED(1, rsc_case_get(nullptr, "surface%n", b, 8, &length));
    REFUSED(2, rsc_case_get(c, nullptr, b, 8, &length));
    REFUSED(2, rsc_case_get(c, "surface%m", b, 8, &length));
    REFUSED(3, rsc_case_get(c, "surface%n", nullptr, 8, &length));
    REFUSED(4, rsc_case_get(c, "surface%n", b, -8, &length));
    REFUSED(1, rsc_case_text(nullptr, b, 8, &length));
    REFUSED(2, rsc_case_text(c, nullptr, 8, &length));
    REFUSED(3, rsc_case_text(c, b, -8, &length));
    REFUSED(1, rsc_key_count(nullptr));
    REFUSED(1, rsc_key_name(-1, b, 8, &length));
    REFUSED(1, rsc_key_name(kMost, b, 8, &length));
    REFUSED(2, rsc_key_name(0, nullptr, 8, &length));
    REFUSED(3, rsc_key_name(0, b, -8, &length));
    REFUSED(1, rsc_case_run(nullptr, &length));
    OK(rsc_case_set(c, "surface%source", "'heights'"));
    OK(rsc_case_set(c, "surface%file", "'no/such/file'"));
    REFUSED(1, rsc_case_run(c, &length));
    CHECK(length == 77 && std::strcmp(b, "before") == 0);
    OK(rsc_case_destroy(&c));
    OK(rsc_case_destroy(&c));
    CHECK(c == nullptr);
}

void test_surface() {
    std::vector<double> z(12, 0.0);
    z[5] = 1;
    rsc_surface *s = nullptr, *t = nullptr;
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    REFUSED(1, rsc_surface_synthesize(nullptr, c, 1));
    OK(rsc_case_set(c, "surface%n", "128"));  // too coarse for the default spectrum
    REFUSED(2, rsc_surface_synthesize(&s, c, 1));
    REFUSED(1, rsc_surface_take(nullptr, 4, 3, 1, 1, 0, 0, 0, z.data()));
    for (const std::int64_t n : {std::int64_t{-1}, std::int64_t{0}, std::int64_t{2}, kMost}) {
        REFUSED(2, rsc_surface_take(&s, n, 3, 1, 1, 0, 0, 0, z.data()));
        REFUSED(3, rsc_surface_take(&s, 4, n, 1, 1, 0, 0, 0, z.data()));
    }
    for (const double d : {0.0, -1.0, kNaN, kInfinity}) {
        REFUSED(4, rsc_surface_take(&s, 4, 3, d, 1, 0, 0, 0, z.data()));
        REFUSED(5, rsc_surface_take(&s, 4, 3, 1, d, 0, 0, 0, z.data()));
    }
    REFUSED(6, rsc_surface_take(&s, 4, 3, 1, 1, kNaN, 0, 0, z.data()));
    REFUSED(7, rsc_surface_take(&s, 4, 3, 1, 1, 0, -kInfinity, 0, z.data()));
    REFUSED(8, rsc_surface_take(&s, 4, 3, 1, 1, 0, 0, 2, z.data()));
    REFUSED(9, rsc_surface_take(&s, 4, 3, 1, 1, 0, 0, 0, nullptr));
    z[7] = kNaN;
    REFUSED(9, rsc_surface_take(&s, 4, 3, 1, 1, 0, 0, 0, z.data()));
    CHECK(s == nullptr);
    z[7] = 0;
    OK(rsc_surface_take(&s, 4, 3, 1, 1, 0, 0, 0, z.data()));
    std::vector<double> out(12, kBefore);
    REFUSED(1, rsc_surface_detrend(nullptr, "mean", nullptr));
    REFUSED(2, rsc_surface_detrend(s, nullptr, nullptr));
    REFUSED(2, rsc_surface_detrend(s, "Mean", out.data()));
    REFUSED(1, rsc_surface_filter(nullptr, 1.0));
    for (const double cutoff : {0.0, -1.0, kNaN, kInfinity}) REFUSED(2, rsc_surface_filter(s, cutoff));
    REFUSED(1, rsc_surface_grid(nullptr, nullptr, nullptr, out.data(), nullptr, nullptr, nullptr, nullptr));
    REFUSED(1, rsc_surface_heights(nullptr, 12, out.data()));
    for (const std::int64_t n : {-12, 0, 11, 13}) REFUSED(2, rsc_surface_heights(s, n, out.data()));
    REFUSED(3, rsc_surface_heights(s, 12, nullptr));
    REFUSED(1, rsc_surface_moments(nullptr, out.data(), nullptr, nullptr));
    for (const double v : out) CHECK(v == kBefore);
    OK(rsc_surface_grid(s, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_surface_moments(s, nullptr, nullptr, nullptr));

    rsc_asperities* a = nullptr;
    REFUSED(1, rsc_asperities_find(nullptr, s, nullptr));
    REFUSED(2, rsc_asperities_find(&a, nullptr, nullptr));
    REFUSED(1, rsc_asperities_make(nullptr, c, 1));
    REFUSED(2, rsc_asperities_make(&a, c, 1));
    OK(rsc_asperities_find(&a, s, nullptr));
    REFUSED(1, rsc_surface_copy(nullptr, s));
    REFUSED(2, rsc_surface_copy(&t, nullptr));
    REFUSED(1, rsc_asperities_copy(nullptr, a));
    rsc_asperities* b = nullptr;
    REFUSED(2, rsc_asperities_copy(&b, nullptr));
    REFUSED(1, rsc_surface_destroy(nullptr));
    OK(rsc_surface_destroy(&t));
    OK(rsc_surface_destroy(&s));
    OK(rsc_surface_destroy(&s));
    std::int64_t n = 0;
    OK(rsc_asperities_count(a, &n));  // outlive the surface
    CHECK(n == 1);
    OK(rsc_asperities_destroy(&a));
    OK(rsc_case_destroy(&c));
}

void test_asperities() {
    std::vector<double> x = {0, 1, 2}, y = {0, 0, 1}, z = {0, 0.1, 0.2}, r = {1, 2, 3}, k1 = {2, 2, 2}, k2 = {1, 1, 1}, angle = {0, 0, 0},
                        q = {1, 1, 1};
    rsc_asperities* a = nullptr;
    const auto take = [&](std::int64_t n) {
        return rsc_asperities_take(&a, n, x.data(), y.data(), z.data(), r.data(), k1.data(), k2.data(), angle.data(), q.data());
    };
    REFUSED(1, rsc_asperities_take(nullptr, 3, x.data(), y.data(), z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    for (const std::int64_t n : {std::int64_t{0}, std::int64_t{-3}, kMost}) REFUSED(2, take(n));
    REFUSED(3, rsc_asperities_take(&a, 3, nullptr, y.data(), z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    REFUSED(4, rsc_asperities_take(&a, 3, x.data(), nullptr, z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    REFUSED(5, rsc_asperities_take(&a, 3, x.data(), y.data(), nullptr, r.data(), nullptr, nullptr, nullptr, nullptr));
    REFUSED(6, rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), nullptr, nullptr, nullptr, nullptr, nullptr));
    REFUSED(7, rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), r.data(), nullptr, k2.data(), angle.data(), nullptr));
    REFUSED(8, rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), r.data(), k1.data(), nullptr, angle.data(), nullptr));
    REFUSED(9, rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), r.data(), k1.data(), k2.data(), nullptr, nullptr));
    int argument = 3;
    for (std::vector<double>* values : {&x, &y, &z, &r, &k1, &k2, &angle, &q}) {
        for (const double bad : {kNaN, kInfinity, -kInfinity}) {
            const double good = (*values)[2];
            (*values)[2] = bad;
            REFUSED(argument, take(3));
            CHECK(message().find("entry 2") != std::string::npos);
            (*values)[2] = good;
        }
        ++argument;
    }
    for (const double bad : {0.0, -1.0}) {
        r[1] = bad;
        REFUSED(6, take(3));
        r[1] = 2;
        k2[1] = bad;
        REFUSED(8, take(3));
        k2[1] = 1;
    }
    k1[0] = 0.5;
    REFUSED(7, take(3));
    k1[0] = 2;
    x[2] = x[0];
    y[2] = y[0];
    REFUSED(3, take(3));
    CHECK(message().find("same place") != std::string::npos);
    CHECK(a == nullptr);
    x[2] = 2;
    OK(take(3));

    std::vector<double> out(3, kBefore);
    std::int64_t n = 77;
    REFUSED(1, rsc_asperities_count(nullptr, &n));
    REFUSED(2, rsc_asperities_count(a, nullptr));
    REFUSED(1, rsc_asperities_get(nullptr, 3, out.data(), nullptr, nullptr, nullptr));
    for (const std::int64_t wrong : {-3, 0, 2, 4}) {
        REFUSED(2, rsc_asperities_get(a, wrong, out.data(), out.data(), out.data(), out.data()));
        REFUSED(2, rsc_asperities_curvatures(a, wrong, out.data(), out.data(), out.data()));
    }
    REFUSED(1, rsc_asperities_curvatures(nullptr, 3, out.data(), nullptr, nullptr));
    for (const double v : out) CHECK(v == kBefore);
    OK(rsc_asperities_get(a, 3, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_asperities_curvatures(a, 3, nullptr, nullptr, nullptr));
    OK(rsc_asperities_destroy(&a));
    OK(rsc_asperities_destroy(&a));
    REFUSED(1, rsc_asperities_destroy(nullptr));
    OK(rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    REFUSED(1, rsc_asperities_curvatures(a, 3, out.data(), nullptr, nullptr));
    OK(rsc_asperities_destroy(&a));
}

void test_contact() {
    const std::vector<double> x = {0, 1, 2}, y = {0, 0, 1}, z = {0, 0.1, 0.1}, r = {1, 2, 3};
    rsc_asperities* a = nullptr;
    OK(rsc_asperities_take(&a, 3, x.data(), y.data(), z.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    rsc_contact *k = nullptr, *l = nullptr;
    rsc_case* c = nullptr;
    OK(rsc_case_create(&c));
    REFUSED(1, rsc_contact_create(nullptr, a, 1, 1, 0, 0, c));
    REFUSED(2, rsc_contact_create(&k, nullptr, 1, 1, 0, 0, c));
    for (const double bad : {0.0, -1.0, kNaN, kInfinity}) REFUSED(3, rsc_contact_create(&k, a, bad, 1, 0, 0, c));
    for (const double bad : {0.0, -1.0, kNaN, -kInfinity}) REFUSED(4, rsc_contact_create(&k, a, 1, bad, 0, 0, c));
    REFUSED(5, rsc_contact_create(&k, a, 1, 1, kNaN, 0, c));
    REFUSED(6, rsc_contact_create(&k, a, 1, 1, 0, kInfinity, c));
    REFUSED(1, rsc_contact_create_from_case(nullptr, a, c));
    REFUSED(2, rsc_contact_create_from_case(&k, nullptr, c));
    REFUSED(3, rsc_case_set(c, "solids%E", "Infinity, Infinity"));  // two rigid bodies
    CHECK(k == nullptr);
    // Asperities of one height give no rms height, which some methods need.
    rsc_asperities* flat = nullptr;
    const std::vector<double> level = {0, 0, 0};
    OK(rsc_asperities_take(&flat, 3, x.data(), y.data(), level.data(), r.data(), nullptr, nullptr, nullptr, nullptr));
    OK(rsc_case_set(c, "solver%method", "'dgesv'"));
    REFUSED(7, rsc_contact_create(&k, flat, 1, 1, 0, 0, c));
    OK(rsc_asperities_destroy(&flat));

    OK(rsc_contact_create(&k, a, 1e5, 10, 1, 0, nullptr));
    REFUSED(1, rsc_contact_copy(nullptr, k));
    REFUSED(2, rsc_contact_copy(&l, nullptr));
    double out[3] = {kBefore, kBefore, kBefore};
    std::int64_t count = 77;
    std::int32_t which[3] = {77, 77, 77};
    // Before any level there is nothing to read.
    const auto no_result = [&] {
        CHECK(rsc_contact_result(k, out, out, out, &count) == RSC_NO_RESULT);
        CHECK(rsc_contact_level(k, which, &count, &count, &count, out) == RSC_NO_RESULT);
        CHECK(rsc_contact_stiffness(k, out) == RSC_NO_RESULT);
        CHECK(rsc_contact_energy(k, out) == RSC_NO_RESULT);
        CHECK(rsc_contact_spots(k, 3, which, out, out, out) == RSC_NO_RESULT);
        CHECK(rsc_contact_value(k, "force", out) == RSC_NO_RESULT);
        CHECK(rsc_contact_answer(k, out, out, out, out, out, out, out, which, &count, &count, &count, &count, &count) == RSC_NO_RESULT);
        CHECK(rsc_contact_per_asperity(k, 3, out, out, out) == RSC_NO_RESULT);
        CHECK(rsc_contact_deflection(k, 3, x.data(), y.data(), out) == RSC_NO_RESULT);
    };
    no_result();
    REFUSED(1, rsc_contact_move_tip(nullptr, 0, 0));
    REFUSED(1, rsc_contact_tip(nullptr, out, out));
    REFUSED(1, rsc_contact_first_touch(nullptr, out));
    REFUSED(2, rsc_contact_first_touch(k, nullptr));
    REFUSED(1, rsc_contact_indent(nullptr, 0, out));
    REFUSED(1, rsc_contact_press(nullptr, 1, out));
    REFUSED(1, rsc_contact_result(nullptr, out, out, out, &count));
    REFUSED(1, rsc_contact_level(nullptr, which, &count, &count, &count, out));
    REFUSED(1, rsc_contact_stiffness(nullptr, out));
    REFUSED(1, rsc_contact_energy(nullptr, out));
    REFUSED(1, rsc_contact_spots(nullptr, 3, which, out, out, out));
    REFUSED(1, rsc_contact_answer(nullptr, out, out, out, out, out, out, out, which, &count, &count, &count, &count, &count));
    REFUSED(1, rsc_contact_per_asperity(nullptr, 3, out, out, out));
    REFUSED(1, rsc_contact_deflection(nullptr, 3, x.data(), y.data(), out));
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
        REFUSED(2, rsc_contact_indent(k, bad, out));
        REFUSED(2, rsc_contact_press(k, bad, out));
        REFUSED(2, rsc_contact_move_tip(k, bad, 0));
        REFUSED(3, rsc_contact_move_tip(k, 0, bad));
    }
    REFUSED(2, rsc_contact_press(k, -1, out));
    no_result();
    CHECK(out[0] == kBefore && count == 77 && which[0] == 77);

    // After all these failures the contact works, and after a failure it holds what it held.
    double N = 0, M = 0, x0 = 0;
    OK(rsc_contact_indent(k, 0.05, &N));
    CHECK(N > 0);
    REFUSED(2, rsc_contact_indent(k, kNaN, &M));
    REFUSED(2, rsc_contact_press(k, -1, &M));
    REFUSED(2, rsc_contact_move_tip(k, kNaN, 0));
    OK(rsc_contact_tip(k, &x0, nullptr));
    CHECK(x0 == 1);
    OK(rsc_contact_result(k, nullptr, &M, nullptr, &count));
    CHECK(M == N && count >= 1);
    REFUSED(2, rsc_contact_stiffness(k, nullptr));
    REFUSED(2, rsc_contact_energy(k, nullptr));
    for (const std::int64_t n : {count - 1, std::int64_t{-1}, -kMost}) REFUSED(2, rsc_contact_spots(k, n, which, out, out, out));
    for (const std::int64_t n : {-3, 0, 2, 4}) REFUSED(2, rsc_contact_per_asperity(k, n, out, out, out));
    REFUSED(2, rsc_contact_deflection(k, -1, x.data(), y.data(), out));
    REFUSED(3, rsc_contact_deflection(k, 3, nullptr, y.data(), out));
    REFUSED(4, rsc_contact_deflection(k, 3, x.data(), nullptr, out));
    REFUSED(5, rsc_contact_deflection(k, 3, x.data(), y.data(), nullptr));
    const double bad_x[3] = {0, kNaN, 0};
    REFUSED(3, rsc_contact_deflection(k, 3, bad_x, y.data(), out));
    REFUSED(4, rsc_contact_deflection(k, 3, x.data(), bad_x, out));
    CHECK(out[0] == kBefore && which[0] == 77);
    OK(rsc_contact_deflection(k, 0, nullptr, nullptr, nullptr));
    OK(rsc_contact_spots(k, 3, nullptr, nullptr, nullptr, nullptr));
    OK(rsc_contact_per_asperity(k, 3, nullptr, nullptr, nullptr));
    OK(rsc_contact_indent(k, 0.04, nullptr));
    OK(rsc_contact_press(k, N, nullptr));

    // Extremes: from a force no balance could weigh to one no sphere survives, and separations far beyond.
    for (const double force : {1e-300, 1e-30, 1e-12, 1e12, 1e30}) {
        const std::int32_t status = rsc_contact_press(k, force, &M);
        // Too small for neighbouring separations near 0.1 to tell: refused.
        CHECK(status == RSC_SUCCESS || status == RSC_NOT_CONVERGED || (status == -2 && force <= 1e-12));
        CHECK(std::isfinite(M));
        if (force == 1e12) {
            OK(rsc_contact_result(k, nullptr, &N, nullptr, nullptr));
            CHECK_RELATIVE(N, force, 1e-6);
        }
    }
    for (const double separation : {1e300, -1e3, -1e300}) {
        const std::int32_t status = rsc_contact_indent(k, separation, &M);
        CHECK(status == RSC_SUCCESS || status == RSC_NOT_CONVERGED);
        if (status == RSC_SUCCESS) CHECK(std::isfinite(M));
    }
    OK(rsc_contact_indent(k, 0.05, &M));

    OK(rsc_contact_copy(&l, k));
    OK(rsc_asperities_destroy(&a));
    OK(rsc_case_destroy(&c));
    OK(rsc_contact_destroy(&k));
    OK(rsc_contact_destroy(&k));
    OK(rsc_contact_indent(l, 0.05, &N));  // needs none of them
    CHECK_RELATIVE(N, M, 1e-6);
    OK(rsc_contact_destroy(&l));
    REFUSED(1, rsc_contact_destroy(nullptr));
}

}  // namespace

TESTS {
    test_case();
    test_surface();
    test_asperities();
    test_contact();
}
