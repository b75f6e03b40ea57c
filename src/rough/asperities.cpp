#include "rough/asperities.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <numeric>
#include <tuple>

#include "error.hpp"
#include "rough/summits.hpp"
#include "rough/synthesis.hpp"

namespace rsc {
namespace {

// What one thread found in its rows.
struct Part {
    Asperities found;
    long saddles = 0;
};

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

// The parts in order as one; the means are summed over the whole, so that they do not depend on where it was cut.
Asperities join(std::vector<Part>& parts, SummitCount* count) {
    Asperities all = std::move(parts[0].found);
    long saddles = parts[0].saddles;
    for (std::size_t t = 1; t < parts.size(); ++t) {
        const Asperities& part = parts[t].found;
        append(all.x, part.x), append(all.y, part.y), append(all.z, part.z), append(all.radius, part.radius);
        append(all.kappa1, part.kappa1), append(all.kappa2, part.kappa2), append(all.angle, part.angle);
        saddles += parts[t].saddles;
    }
    if (count) {
        double sum_g = 0, sum_a = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            sum_g += std::sqrt(all.kappa1[i] * all.kappa2[i]);
            sum_a += 0.5 * (all.kappa1[i] + all.kappa2[i]);
        }
        const double n = all.size() > 0 ? static_cast<double>(all.size()) : 1.0;
        *count = {static_cast<long>(all.size()), saddles, sum_g / n, sum_a / n};
    }
    return all;
}

// Runs part(t, first, last) on each of `threads` shares of the rows 0 ... rows - 1; an exception of one comes out of here.
void share_rows(int rows, int threads, const std::function<void(int, int, int)>& part) {
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(threads));
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int t = 0; t < threads; ++t) {
        const auto bound = [&](int k) { return static_cast<int>(static_cast<std::int64_t>(rows) * k / threads); };
        try {
            if (bound(t) < bound(t + 1)) part(t, bound(t), bound(t + 1));
        } catch (...) {
            thrown[static_cast<std::size_t>(t)] = std::current_exception();
        }
    }
    for (const auto& e : thrown)
        if (e) std::rethrow_exception(e);
}

// The summits of rows first ... last - 1, the rows being made on the way with one more at either side.
void scan_while_making(const RowSource& source, double step, Curvature curvature, int first, int last, Part& part) {
    constexpr int kRows = RowSource::kBlock + 2;
    const int n = source.n();
    const std::ptrdiff_t stride = (n + 7) / 8 * 8 + 8;
    const std::unique_ptr<double[], HeightMap::Free> window(
        allocate_doubles(static_cast<std::size_t>(kRows * stride), "rows of a synthetic surface"));
    RowSource::Scratch scratch(source);
    RowPlace place{n, 0.0, step, step, 0.0, true};
    int held = 0;          // rows in the window, of which the first is row next - held
    int next = first - 1;  // the row to make next
    while (next <= last) {
        const int made = std::min(kRows - held, last + 1 - next);
        source.rows(next, made, window.get() + held * stride, stride, scratch);
        next += made;
        held += made;
        for (int k = 1; k + 1 < held; ++k) {
            const double* const z = window.get() + k * stride;
            place.y = (next - held + k) * step;
            part.saddles += append_summits(place, z - stride, z, z + stride, curvature, part.found);
        }
        const int kept = std::min(held, 2);
        std::copy_n(window.get() + (held - kept) * stride, kept * stride, window.get());
        held = kept;
    }
}

}  // namespace

void validate(const Asperities& a, const std::function<std::string(std::size_t)>& name) {
    const std::size_t n = a.size();
    const auto refuse = [](const std::string& message) { throw Error(Failure::bad_input, message); };
    const auto text = [](double v) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.17g", v);
        return std::string(buffer);
    };
    if (n == 0) refuse("there is no asperity");
    const struct {
        const char* name;
        const std::vector<double>& values;
        bool required;
    } fields[] = {{"x", a.x, true},
                  {"y", a.y, true},
                  {"z", a.z, true},
                  {"radius", a.radius, true},
                  {"kappa1", a.kappa1, false},
                  {"kappa2", a.kappa2, false},
                  {"angle", a.angle, false},
                  {"biharmonic", a.biharmonic, false}};
    for (const auto& field : fields) {
        if (field.values.empty() && !field.required) continue;
        if (field.values.size() != n)
            refuse(std::string("asperities: ") + std::to_string(field.values.size()) + " values of " + field.name + " for " +
                   std::to_string(n) + " asperities");
        for (std::size_t i = 0; i < n; ++i)
            if (!std::isfinite(field.values[i])) refuse(name(i) + ": " + field.name + " is not finite");
    }
    if (a.kappa1.size() != a.kappa2.size() || a.kappa1.size() != a.angle.size())
        refuse("asperities: kappa1, kappa2 and angle must be given together");
    for (std::size_t i = 0; i < n; ++i) {
        if (!(a.radius[i] > 0)) refuse(name(i) + ": the radius must be positive, not " + text(a.radius[i]));
        if (!a.kappa1.empty() && !(a.kappa1[i] >= a.kappa2[i] && a.kappa2[i] > 0))
            refuse(name(i) + ": kappa1 >= kappa2 > 0 was expected, not " + text(a.kappa1[i]) + " and " + text(a.kappa2[i]));
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t i) { return std::tuple(a.x[i], a.y[i], i); };
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
    for (std::size_t k = 1; k < n; ++k) {
        const std::size_t i = order[k - 1], j = order[k];
        if (a.x[i] == a.x[j] && a.y[i] == a.y[j])
            refuse(name(j) + ": lies at the same point as " + name(i) + " (x = " + text(a.x[i]) + ", y = " + text(a.y[i]) + ")");
    }
}

Asperities find_asperities(const HeightMap& map, Curvature curvature, SummitCount* count, int threads) {
    const int edge = map.periodic ? 0 : 1;
    const int rows = map.ny - 2 * edge;
    threads = std::clamp(threads, 1, std::max(rows, 1));
    std::vector<Part> parts(static_cast<std::size_t>(threads));
    share_rows(rows, threads, [&](int t, int first, int last) {
        RowPlace place{map.nx, map.x0, map.dx, map.dy, 0.0, map.periodic};
        Part& part = parts[static_cast<std::size_t>(t)];
        for (int j = first + edge; j < last + edge; ++j) {
            place.y = map.y0 + j * map.dy;
            part.saddles += append_summits(place, map.row(j > 0 ? j - 1 : map.ny - 1), map.row(j),
                                           map.row(j + 1 < map.ny ? j + 1 : 0), curvature, part.found);
        }
    });
    return join(parts, count);
}

Asperities make_asperities(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization,
                           Curvature curvature, SummitCount* count, Moments* sampled, int threads) {
    threads = std::max(threads, 1);
    const RowSource source(spectrum, n, normalise, seed, realization, threads);
    threads = std::min(threads, n);
    std::vector<Part> parts(static_cast<std::size_t>(threads));
    share_rows(n, threads, [&](int t, int first, int last) {
        scan_while_making(source, spectrum.L / n, curvature, first, last, parts[static_cast<std::size_t>(t)]);
    });
    if (sampled) *sampled = source.sampled();
    return join(parts, count);
}

}  // namespace rsc
