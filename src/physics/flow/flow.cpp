#include "physics/flow/flow.hpp"

#include "base/array.hpp"
#include "base/parallel.hpp"
#include "elements/deformed.hpp"

namespace rsc {
namespace {

constexpr int kRows = 16;  // that a thread takes at a time

struct OpenGap {
    double sum = 0;
    std::size_t open = 0;
    OpenGap operator+(const OpenGap& o) const { return {sum + o.sum, open + o.open}; }
};

}  // namespace

void add_gap(LevelValues& level, const GapMap& map) {
    const auto nx = at(map.nx);
    const auto [sum, open] = sum_in_order<OpenGap>(map.ny, kRows, 0, [&](int j) {
        OpenGap row;
        for (const double g : map.gap.subspan(at(j) * nx, nx)) {
            row.sum += g;
            row.open += g > 0 ? 1 : 0;
        }
        return row;
    });
    level.gap_mean = sum / double(map.points());
    level.gap_mean_open = open > 0 ? sum / double(open) : 0;
    const Openings openings(
        map, [&](std::size_t k, std::size_t l) { return map.gap[k] > 0 && map.gap[l] > 0; });
    level.percolates_x = openings.any_winds_x() ? 1 : 0;
    level.percolates_y = openings.any_winds_y() ? 1 : 0;
}

GapCounts count_gaps(const GapMap& map, int bins, double width) {
    GapCounts counts;
    counts.of_bin.assign(at(bins), 0);
    for (const double g : map.gap) {
        if (!(g > 0)) continue;
        const double position = g / width;
        ++(position < bins ? counts.of_bin[at(position)] : counts.beyond);
        double power = 1;
        for (double& sum : counts.power) sum += power *= g;
    }
    return counts;
}

GapMap gap_of(LevelSource& source) {
    const HeightMap& map = *source.map;
    if (source.gap.empty()) {
        const Path& contact = source.contact;
        const PointWindow whole{{0, map.nx - 1}, {0, map.ny - 1}, map.nx};
        const Pressures pressures = pressures_of(source.level.pixels);
        const auto [none, depths, lasting] = contact.remains(source.level);
        Array<double> deflection = deflections(
            map, contact.indenter(), lasting ? pressures_of(lasting->pixels) : pressures, whole);
        std::vector<char> touches = zeros_on_huge_pages<char>(whole.points());
        for (const auto& [point, load] : pressures) touches[at(point)] = load.touches;
        const HeightMap lowered = depths.depth.empty() ? HeightMap{} : lowered_map(map, depths);
        source.gap = gaps(lowered.data ? lowered : map, contact.indenter(), source.level.separation,
                          touches, whole, std::move(deflection));
    }
    return {map.nx, map.ny, map.dx, map.dy, source.gap};
}

const char* compute_gap(LevelSource& source) {
    if (!source.map || !source.contact.indenter().period.finite())
        return "only two flats solved by elements have a gap";
    if (!std::isnan(source.level.gap_mean)) return nullptr;
    add_gap(source.level, gap_of(source));
    if (source.gap_bins > 0)
        source.level.gaps = count_gaps(gap_of(source), source.gap_bins, source.gap_bin);
    return nullptr;
}

namespace {

// Geometric means of K and S along x and along y of the gap on every second point, of both diagonal
// choices; NaN for odd numbers of points.
GapFlow coarse_flow(const GapMap& map) {
    constexpr double none = kNotComputed;
    if (map.nx % 2 != 0 || map.ny % 2 != 0) return {{none, none, none}, {none, none, none, none}};
    const int nx = map.nx / 2, ny = map.ny / 2;
    GapFlow product{{1, 1, none}, {1, none, none, 1}};
    for (const int offset : {0, 1}) {
        std::vector<double> gap;
        gap.reserve(at(nx) * at(ny));
        for (const int j : indices(ny))
            for (const int i : indices(nx))
                gap.push_back(map.gap[at(2 * j + offset) * at(map.nx) + at(2 * i + offset)]);
        const GapFlow one = permeability({nx, ny, 2 * map.dx, 2 * map.dy, gap});
        product.K.xx *= one.K.xx;
        product.K.yy *= one.K.yy;
        product.S.xx *= one.S.xx;
        product.S.yy *= one.S.yy;
    }
    for (double* p : {&product.K.xx, &product.K.yy, &product.S.xx, &product.S.yy})
        *p = std::sqrt(*p);
    return product;
}

// The value on ever finer grids, from those on the grid and on every second point of it.
double extrapolated(double fine, double coarse, double power) {
    return fine > 0 && coarse > 0 ? fine * std::pow(fine / coarse, power) : fine;
}

// Those of Patir and Cheng, of the mean gap with its closed parts, and the rms height of the map.
void add_flow_factors(LevelValues& level, const HeightMap& map) {
    const double h = level.gap_mean;
    if (!(h > 0)) return;  // full contact
    level.pressure_factor_x = 12 * level.permeability_xx / (h * h * h);
    level.pressure_factor_y = 12 * level.permeability_yy / (h * h * h);
    const double mean = mean_present(map, [](double z, int, int) { return z; });
    const double sigma =
        std::sqrt(mean_present(map, [&](double z, int, int) { return (z - mean) * (z - mean); }));
    if (!(sigma > 0)) return;
    level.shear_factor_x = (h - 2 * level.shear_xx) / sigma;
    level.shear_factor_y = (h - 2 * level.shear_yy) / sigma;
}

}  // namespace

namespace {

// Where more of the area touches, the gap nearly seals, and K depends on single constrictions,
// however narrow: no error is known (input/trust/permeability.py has up to 0.3).
constexpr double kSealing = 0.3;

// From the change from the coarse grid.
double error_of_change(const LevelValues& level, double value, double coarse, double part) {
    return value > 0 && coarse > 0 && !(level.area_fraction > kSealing)
               ? part * std::abs(std::log(value / coarse))
               : kNotComputed;
}

}  // namespace

double permeability_error(const LevelValues& level, std::size_t component) {
    if (component > 1) return kNotComputed;
    const double K = component == 0 ? level.permeability_xx : level.permeability_yy,
                 coarse =
                     component == 0 ? level.coarse_permeability_x : level.coarse_permeability_y;
    return error_of_change(level, K, coarse, kPermeabilityPart / (1 + kPermeabilityPower));
}

double hydraulic_gap_error(const LevelValues& level, std::size_t component) {
    return permeability_error(level, component) / 3;
}

double shear_flow_error(const LevelValues& level, std::size_t component) {
    if (component > 1) return kNotComputed;
    const double S = component == 0 ? level.shear_xx : level.shear_yy,
                 coarse = component == 0 ? level.coarse_shear_x : level.coarse_shear_y;
    return error_of_change(level, S, coarse, kShearPart / (1 + kShearPower));
}

double shear_factor_error(const LevelValues& level, std::size_t component) {
    const double twice = 2 * (component == 0 ? level.shear_xx : level.shear_yy);
    return shear_flow_error(level, component) * std::abs(twice / (level.gap_mean - twice));
}

const char* compute_leak(LevelSource& source) {
    const Leak& leak = source.physics->of<Leak>();
    if (!leak.asked()) return "the leak rate needs output%leak_drop";
    if (const char* const none = compute_permeability(source)) return none;
    const auto [inlet, outlet] = leak.pressures;
    const double drop =
        leak.gas ? (inlet * inlet - outlet * outlet) / (2 * outlet) : inlet - outlet;
    source.level.leak_rate =
        source.level.permeability_xx * drop * leak.width / (leak.viscosity * leak.length);
    return nullptr;
}

const char* compute_permeability(LevelSource& source) {
    if (const char* const none = compute_gap(source)) return none;
    if (!has_permeability()) return "this rsc was built without CHOLMOD";
    LevelValues& level = source.level;
    if (!std::isnan(level.permeability_xx)) return nullptr;
    const auto& [k, s] = permeability(gap_of(source), source.for_fields ? &source.flux : nullptr);
    const GapFlow coarse = coarse_flow(gap_of(source));
    level.permeability_xx = extrapolated(k.xx, coarse.K.xx, kPermeabilityPower);
    level.permeability_yy = extrapolated(k.yy, coarse.K.yy, kPermeabilityPower);
    level.permeability_xy = k.xy;
    level.shear_xx = extrapolated(s.xx, coarse.S.xx, kShearPower);
    level.shear_yy = extrapolated(s.yy, coarse.S.yy, kShearPower);
    level.shear_xy = s.xy;
    level.shear_yx = s.yx;
    level.coarse_permeability_x = coarse.K.xx;
    level.coarse_permeability_y = coarse.K.yy;
    level.coarse_shear_x = coarse.S.xx;
    level.coarse_shear_y = coarse.S.yy;
    level.hydraulic_gap_x = std::cbrt(12 * level.permeability_xx);
    level.hydraulic_gap_y = std::cbrt(12 * level.permeability_yy);
    add_flow_factors(level, *source.map);
    return nullptr;
}

}  // namespace rsc
