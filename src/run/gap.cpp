#include "run/gap.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "case/units.hpp"
#include "physics/flow/flow.hpp"

namespace rsc {

bool has_gap(const Case& settings) {
    return by_elements(settings) && settings.indentation.boundary == Boundary::periodic;
}

void require_flow_memory(const Case& settings, double points) {
    if (!settings.output.flow) return;
    const double needed = permeability_bytes(points), memory = machine_memory();
    if (needed <= memory) return;
    const double side = std::floor(std::sqrt(permeability_points(memory)));
    bad_input(
        format("output%%flow: the flow through a gap of %.0f points needs up to %.3g GB, and the "
               "machine has %.3g GB of memory, enough for %.0f x %.0f points; give a smaller "
               "elements%%points_per_wave or surface%%L_lambda_s",
               points, 1e-9 * needed, 1e-9 * memory, side, side));
}

void print_gap(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    if (!job.settings.output.flow) return;
    const auto open = [](const LevelValues& l) { return l.percolates_x > 0; };
    const auto count = std::ranges::count_if(levels, open);
    double most = 0, least = kInfinity;
    for (const LevelValues& l : levels) {
        if (open(l)) most = std::max(most, l.area_fraction);
        if (l.percolates_x == 0) least = std::min(least, l.area_fraction);
    }
    out << format("gap: open across the cell along x at %zu of %zu levels", at(count),
                  levels.size());
    if (count > 0) out << format(", up to A/A0 = %.3g", most);
    if (least < kInfinity) out << format("; closed at A/A0 = %.3g and above", least);
    const std::string l = job.settings.run.length_unit, f = job.settings.run.force_unit;
    out << format(
        "\n  leak rate = K w dP/(eta l) [%s/%s] for a pressure drop dP [%s] over the length l of "
        "the seal along x, its width w and the viscosity eta [%s %s]; hydraulic gap h: K = "
        "h^3/12\n",
        unit_of(l, 3, "", 0).c_str(), job.settings.run.time_unit.c_str(),
        unit_of(l, -2, f, 1).c_str(), unit_of(l, -2, f, 1).c_str(),
        job.settings.run.time_unit.c_str());
}

}  // namespace rsc
