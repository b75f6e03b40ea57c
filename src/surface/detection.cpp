#include "surface/detection.hpp"

#include "base/parallel.hpp"
#include "surface/subgrid.hpp"
#include "surface/summits.hpp"
#include "surface/synthesis.hpp"

namespace rsc {
namespace {

constexpr int kFewestRows = 64;  // rows of a share; the rows beside it are synthesised twice

// Degree of alignment of the summits' long axes: 1 if aligned, 0 if no more than by chance.
double lay_share(const Asperities& summits) {
    std::complex<double> directed = 0;
    double all = 0;
    for (const auto i : indices(summits)) {
        const double elongation = std::log(summits.kappa1[i] / summits.kappa2[i]);
        directed += std::polar(elongation, 2 * summits.angle[i]);
        all += elongation;
    }
    // Ten summits of an isotropic surface may reach `none` by chance, fewer reach more; surfaces
    // with correlation lengths in the ratio 1:1.6 reach `whole`. One summit alone is a lay of its
    // own: there the quartic around its ellipse is right. Found by hand; checked by test_elongated.
    constexpr double whole = 0.75;
    const double none = std::clamp(0.3 * std::sqrt(10 / double(summits.size())), 0.3, 0.7);
    return all > 0 ? std::clamp((std::abs(directed) / all - none) / (whole - none), 0.0, 1.0) : 0;
}

// Concatenates the parts in order. Those between grid points (`refined`) lose what was found
// several times.
Asperities join(std::vector<RefinedSummits>& parts, bool refined, int nx, int ny, bool periodic,
                SummitCount* count) {
    RefinedSummits all = std::move(parts[0]);
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    // One column after the other, by several threads; then the starts.
    parallel_for(parts.size() > 1 ? kAsperityColumns.size() + 1 : 0, 1, 0, [&](std::size_t c) {
        for (std::size_t t = 1; t < parts.size(); ++t) {
            if (c == kAsperityColumns.size())
                append(all.from, parts[t].from);
            else
                append(all.found.*kAsperityColumns[c].values,
                       parts[t].found.*kAsperityColumns[c].values);
        }
    });
    for (std::size_t t = 1; t < parts.size(); ++t) all.saddles += parts[t].saddles;
    const long repeated = refined ? drop_repeated(all, nx, ny, periodic) : 0;
    if (count) *count = counted(all.found, all.saddles, repeated);
    if (!refined) return std::move(all.found);
    // With a lay, the quartic term continues along the long axis of an elongated summit. On
    // isotropic surfaces summits are elongated by chance in all directions; there the plain
    // biharmonic agrees better with boundary elements (study in input/trust).
    const double share = lay_share(all.found);
    for (const auto i : indices(all.from))
        all.found.biharmonic[i] += share * (all.from[i].elongated - all.found.biharmonic[i]);
    return std::move(all.found);
}

// Runs part(its summits, first, last) on shares of the rows 0 ... rows - 1, several per thread.
// Returns the parts in order.
std::vector<RefinedSummits> share_rows(int rows, int threads,
                                       const std::function<void(RefinedSummits&, int, int)>& part) {
    const int shares = threads > 1 ? std::clamp(rows / kFewestRows, 1, 8 * threads) : 1;
    std::vector<RefinedSummits> parts(at(shares));
    parallel_for(shares, 1, threads, [&](int t) {
        const auto bound = [&](int k) { return int(static_cast<std::int64_t>(rows) * k / shares); };
        stopping_point();
        part(parts[at(t)], bound(t), bound(t + 1));
    });
    return parts;
}

// Calls visit(j, z, stride) for the rows j = first ... last - 1 while synthesising rows first -
// margin ... last - 1 + margin. z points to row j; margin rows lie on either side of it, stride
// apart.
template <class Visit>
void visit_while_making(const RowSource& source, int margin, int rows_held, int first, int last,
                        Visit visit) {
    const int n = source.n();
    const std::ptrdiff_t stride = (n + 7) / 8 * 8 + 8;
    const std::unique_ptr<double[], HeightMap::Free> window(
        allocate_doubles(at(rows_held * stride), "rows of a synthetic surface"));
    RowSource::Scratch scratch(source);
    int held = 0;               // rows in the window; the first is row next - held
    int next = first - margin;  // next row to synthesise
    while (next <= last - 1 + margin) {
        stopping_point();
        const int made = std::min(rows_held - held, last + margin - next);
        source.rows(next, made, window.get() + held * stride, stride, scratch);
        next += made;
        held += made;
        for (int k = margin; k + margin < held; ++k)
            visit(next - held + k, window.get() + k * stride, stride);
        const int reused = std::min(held, 2 * margin);
        std::copy_n(window.get() + (held - reused) * stride, reused * stride, window.get());
        held = reused;
    }
}

// Exchanges x and y of summits of a square of side L, and orders them by the rows of n that are
// their y now.
Asperities mirrored(const Asperities& found, double L, int n) {
    std::vector<std::size_t> row, first(at(n) + 1), order(found.size());
    for (const double x : found.x) {
        row.push_back(at(std::clamp(int(x / L * n + 0.5), 0, n - 1)));
        ++first[row.back() + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const auto i : indices(found)) order[first[row[i]]++] = i;
    Asperities all = selected(found, order);
    std::swap(all.x, all.y);
    for (double& angle : all.angle) angle = angle < 0 ? -pi / 2 - angle : pi / 2 - angle;
    return all;
}

// One stencil if the band is known, otherwise polynomials of all reaches.
std::vector<Stencil> stencils_for(double points_per_wave) {
    std::vector<Stencil> stencils;
    if (points_per_wave != 0) stencils.push_back(Stencil::band_limited(points_per_wave));
    for (int reach = 1; points_per_wave == 0 && reach <= kMeasuredReach; ++reach)
        stencils.push_back(Stencil::polynomial(reach));
    return stencils;
}

// Row j + d of a map for SummitClimber; null beyond a border.
SummitClimber::Rows rows_about(const HeightMap& map, int j) {
    return [&map, j](int d) -> const double* {
        if (map.periodic) return map.row(wrapped(j + d, map.ny));
        return j + d >= 0 && j + d < map.ny ? map.row(j + d) : nullptr;
    };
}

}  // namespace

SummitCount counted(const Asperities& all, long saddles, long repeated) {
    double sum_g = 0, sum_a = 0;
    for (const auto i : indices(all)) {
        sum_g += std::sqrt(all.kappa1[i] * all.kappa2[i]);
        sum_a += 0.5 * (all.kappa1[i] + all.kappa2[i]);
    }
    const double n = all.size() > 0 ? double(all.size()) : 1.0;
    return {static_cast<long>(all.size()), saddles, repeated, sum_g / n, sum_a / n};
}

Asperities find_asperities(const HeightMap& map, Curvature curvature, SummitCount* count,
                           int threads, Detail detail, double points_per_wave,
                           const Breaks* breaks) {
    const bool refined = detail == Detail::subgrid;
    const std::vector<Stencil> stencils =
        refined ? stencils_for(points_per_wave) : std::vector<Stencil>{};
    const int edge = map.periodic ? 0 : 1;
    const int rows = map.ny - 2 * edge;
    std::vector<RefinedSummits> parts =
        share_rows(rows, threads, [&](RefinedSummits& part, int first, int last) {
            RowPlace place{map.nx, map.x0, map.dx, map.dy, 0.0, map.periodic};
            SummitClimber climber(stencils, place, map.ny, map.y0, curvature, breaks);
            for (int j = first + edge; j < last + edge; ++j) {
                const SummitClimber::Rows row = rows_about(map, j);
                if (refined) {
                    climber.climb(j, row, part);
                    continue;
                }
                place.y = map.y(j);
                part.saddles +=
                    append_summits(place, row(-1), row(0), row(1), curvature, part.found);
            }
        });
    return join(parts, refined, map.nx, map.ny, map.periodic, count);
}

int summit_points(const Spectrum& spectrum, int n) {
    int fine = n;
    // An invalid n is rejected by RowSource.
    if (n >= 2 && n % 2 == 0 && 2 * shortest_wave(spectrum) <= n)
        while (fine < 4 * shortest_wave(spectrum) * (1 - 1e-12)) fine += n;
    return fine;
}

Asperities make_asperities(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed,
                           std::int64_t realization, Curvature curvature, SummitCount* count,
                           Moments* sampled, int threads, Detail detail, Moments* differences) {
    const bool mirror = made_as_transpose(spectrum);
    if (mirror) {  // no need to store the surface
        const Asperities found =
            make_asperities(transposed(spectrum), n, normalise, seed, realization, curvature, count,
                            sampled, threads, detail, differences);
        if (sampled) sampled->tensor = sampled->tensor.transposed();
        return mirrored(found, spectrum.L, n);
    }
    threads = std::max(threads, 1);
    const bool refined = detail == Detail::subgrid;
    const int fine = refined ? summit_points(spectrum, n) : n;
    const RowSource source(spectrum, fine, normalise, seed, realization, threads, spectrum.L / n);
    const double step = spectrum.L / fine;
    if (sampled) *sampled = source.sampled();
    if (differences) *differences = source.differences();
    std::vector<Stencil> stencils;
    if (refined) stencils.push_back(Stencil::band_limited(fine / shortest_wave(spectrum)));
    std::vector<RefinedSummits> parts =
        share_rows(fine, threads, [&](RefinedSummits& part, int first, int last) {
            RowPlace place{fine, 0.0, step, step, 0.0, true};
            SummitClimber climber(stencils, place, fine, 0.0, curvature);
            const int margin = refined ? climber.margin() : 1;
            // The window is at least twice as long as the 2 margin rows reused from one filling to
            // the next, so that moving these is cheap.
            visit_while_making(source, margin, 4 * margin + RowSource::kBlock, first, last,
                               [&](int j, const double* z, std::ptrdiff_t stride) {
                                   place.y = j * step;
                                   if (refined)
                                       climber.climb(
                                           j, [&](int d) { return z + d * stride; }, part);
                                   else
                                       part.saddles += append_summits(
                                           place, z - stride, z, z + stride, curvature, part.found);
                               });
        });
    return join(parts, refined, fine, fine, true, count);
}

}  // namespace rsc
