#include "physics/flow/flow.hpp"

#include "base/parallel.hpp"

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

void add_permeability(LevelValues& level, const GapMap& map, std::vector<double>* flow) {
    const Permeability k = permeability(map, flow);
    level.permeability_xx = k.xx;
    level.permeability_yy = k.yy;
    level.permeability_xy = k.xy;
    level.hydraulic_gap_x = std::cbrt(12 * k.xx);
    level.hydraulic_gap_y = std::cbrt(12 * k.yy);
}

}  // namespace rsc
