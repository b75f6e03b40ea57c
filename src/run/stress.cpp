#include "run/stress.hpp"

#include "base/error.hpp"
#include "case/units.hpp"
#include "physics/stress/spot_stress.hpp"
#include "trust/grid_error.hpp"

namespace rsc {

std::vector<double> stress_depths(const Job& job) {
    const Case::Output& keys = job.settings.output;
    if (!keys.stresses() || !keys.stress_depths.empty()) return keys.stress_depths;
    double step = job.domain.grid_step;
    if (job.given_heights) step = std::max(job.given_heights->dx, job.given_heights->dy);
    if (job.spectrum && by_elements(job.settings))
        step = job.spectrum->L / element_points(job.settings, *job.spectrum);
    if (!(step > 0))
        bad_input(
            "output%stress_depths = 'auto' needs the points of a surface, and "
            "source = 'asperities' has none; list the depths");
    constexpr int count = 15;
    const double deepest = 0.25 * std::min(job.domain.Lx, job.domain.Ly);
    std::vector<double> depths{0};
    for (const int k : indices(count))
        depths.push_back(step * std::pow(deepest / step, k / (count - 1.0)));
    return depths;
}

StressedBody stressed_body(const Job& job) {
    const Case& settings = job.settings;
    StressedBody body;
    body.period = job.indenter.period;
    body.nu = settings.solids.nu[0];
    if (settings.output.sliding_direction) {
        const double angle = *settings.output.sliding_direction * std::numbers::pi / 180;
        body.sliding = {settings.solids.friction * std::cos(angle),
                        settings.solids.friction * std::sin(angle)};
    }
    return body;
}

void add_stresses(std::vector<LargestStress>& all, const Job& job, const HeightMap* map,
                  const Level& level) {
    const StressedBody body = stressed_body(job);
    for (const double depth : job.observe.stress_depths) {
        if (std::isnan(level.force))
            all.emplace_back();
        else if (map) {
            all.push_back(stress_below(*map, level.pixels, body, depth,
                                       stressed_window(*map, level.pixels, body.period, depth)));
            state_errors(all.back(), depth / std::max(map->dx, map->dy), body.sliding.any(), level,
                         job.solver.surface.measured);
        } else
            all.push_back(stress_below(level, body.nu, depth));
    }
}

void print_stresses(std::ostream& out, std::span<const LargestStress> stresses, const Job& job) {
    const std::vector<double>& depths = job.observe.stress_depths;
    if (depths.empty() || stresses.size() < depths.size()) return;
    const std::span<const LargestStress> last = stresses.last(depths.size());
    const std::string length = job.settings.run.length_unit,
                      unit = unit_of(length, -2, job.settings.run.force_unit, 1);
    const auto print = [&](const char* what, LargestStress::Value LargestStress::*which) {
        std::size_t most = depths.size();
        for (const auto k : indices(depths))
            if (const double v = (last[k].*which).value;
                v > 0 && (most == depths.size() || v > (last[most].*which).value))
                most = k;
        if (most == depths.size()) return;
        const LargestStress::Value& value = last[most].*which;
        out << format("  %s %.4g %s at (%.5g, %.5g) %s, depth %.4g %s\n", what, value.value,
                      unit.c_str(), value.x, value.y, length.c_str(), depths[most], length.c_str());
    };
    out << "largest stresses at the last level:\n";
    print("von Mises", &LargestStress::mises);
    print("shear    ", &LargestStress::shear);
    print("tension  ", &LargestStress::tension);
}

}  // namespace rsc
