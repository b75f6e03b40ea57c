#include "run/memory.hpp"

#include "interaction/pair_matrix.hpp"
#include "physics/flow/permeability.hpp"

namespace rsc {
namespace {

// E[h^p] over h > 0, h = z - Z0 for Gaussian heights z of standard deviation sigma, by the midpoint
// rule.
double mean_excess(double Z0, double sigma, double power) {
    constexpr int points = 400;
    constexpr double reach = 6;  // standard deviations
    const double low = std::max(Z0, -reach * sigma), width = (reach * sigma - low) / points;
    double sum = 0;
    for (int k = 0; k < points && width > 0; ++k) {
        const double z = low + (k + 0.5) * width;
        sum += std::pow(z - Z0, power) * std::exp(-0.5 * z * z / (sigma * sigma));
    }
    return sum * std::max(width, 0.0) / (sigma * std::sqrt(2 * std::numbers::pi));
}

// The integral of mean_excess(Z0 + s) over the domain, s being the height of the indenter's face:
// from the areas of the face in intervals of height, sampled on a grid.
double under_indenter(const Job& job, double Z0, double power) {
    constexpr int side = 96, steps = 32;
    const double step = std::max(1.0, 6 - Z0 / job.sigma) * job.sigma / steps;
    double area[steps] = {};
    const Domain& d = job.domain;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const double x = d.x0 + (i + 0.5) * d.Lx / side - job.indenter.x0,
                         y = d.y0 + (j + 0.5) * d.Ly / side - job.indenter.y0;
            const double s = std::max(0.0, job.indenter.shape->height(x, y)) / step;
            if (s < steps) area[static_cast<int>(s)] += d.Lx * d.Ly / (side * side);
        }
    double sum = 0;
    for (int k = 0; k < steps; ++k)
        if (area[k] > 0)
            sum += area[k] * mean_excess(Z0 + (job.indenter.shape->flat() ? 0 : (k + 0.5) * step),
                                         job.sigma, power);
    return sum;
}

// Greenwood and Tripp's force of an indenter at Z0 on Gaussian summits without interaction, or the
// hardness times the area under the indenter: upper bounds.
double greenwood_force(const Job& job, double Z0) {
    const double r = job.theory ? job.theory->mean_radius() : 1.0;
    const double density = 1 / (job.domain.mean_spacing * job.domain.mean_spacing),
                 k = 4.0 / 3.0 * job.indenter.E_star * std::sqrt(r);
    // Nayak's summits are on the average this much higher than the surface.
    const double higher =
        job.theory ? 4 * job.theory->m2 / std::sqrt(std::numbers::pi * job.theory->m4) : 0.0;
    const double elastic = density * k * under_indenter(job, Z0 - higher, 1.5),
                 H = job.settings.solids.hardness;
    return std::isfinite(H) ? std::min(elastic, H * under_indenter(job, Z0, 0)) : elastic;
}

// A separation with approximately this force.
double separation_at(const Job& job, double force) {
    double high = 6 * job.sigma, low = high;
    do low -= 2 * job.sigma;
    while (greenwood_force(job, low) < force && low > -1e3 * job.sigma);
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        (greenwood_force(job, middle) > force ? low : high) = middle;
    }
    return low;
}

// The part of the domain where a Gaussian surface is higher than the indenter at Z0.
double area_under(const Job& job, double Z0) { return under_indenter(job, Z0, 0); }

// Number of grid points of the elements.
double points_of_elements(const Job& job, double points_per_wave) {
    if (job.given_heights)
        return static_cast<double>(job.given_heights->nx) * job.given_heights->ny;
    return job.spectrum ? std::pow(points_per_wave * job.spectrum->L_lambda_s, 2) : 0;
}

// Share of two flats in contact: under a force 2.1 p/(E* h'), or all; at a separation 0.4 of what
// is higher.
double share_in_contact(const Job& job, double level, bool is_force) {
    const double area = job.domain.Lx * job.domain.Ly;
    if (wears(job.settings)) return 1;
    if (!is_force) return std::min(1.0, 0.4 * area_under(job, level) / area);
    const double slope = job.theory ? job.theory->rms_slope() : job.solver.surface.gentlest_slope;
    return slope > 0 ? std::erf(1.86 * level / area / (job.indenter.E_star * slope)) : 1.0;
}

// Number of grid points of elements that are higher than the indenter at Z0.
double points_under(const Job& job, double Z0, double points) {
    return points * area_under(job, Z0) / (job.domain.Lx * job.domain.Ly);
}

// Penetration of the smooth indenter under a force; 0 if no closed form is known.
double smooth_depth(const Job& job, double force) {
    const auto smooth = job.indenter.shape->smooth(job.indenter.E_star);
    return smooth ? smooth->depth_under(force) : 0.0;
}

}  // namespace

double expected_candidates(const Job& job, double Z0) {
    if (job.given) {
        const Asperities& a = job.given->asperities;
        double count = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            count += job.indenter.clearance(a.x[i], a.y[i], a.z[i]) > Z0 ? 1 : 0;
        return count;
    }
    return area_under(job, Z0) / (job.domain.mean_spacing * job.domain.mean_spacing);
}

double likely_separation(const Job& job, double level) {
    if (job.settings.indentation.control == Control::separation) return level;
    // Roughness spreads the load, so that the body deflects less than under a smooth contact: as
    // under Hertz's pressures with the mean of those without interaction.
    constexpr double spread = 0.6;
    const double smooth = smooth_depth(job, level),
                 Z0 = job.given ? 0.0 : separation_at(job, level);
    if (job.given) return -spread * smooth;
    const double area = under_indenter(job, Z0, 1.5) / mean_excess(Z0, job.sigma, 1.5);
    return Z0 - spread * std::min(smooth, 0.75 * level /
                                              (job.indenter.E_star *
                                               std::sqrt(1.5 * area / std::numbers::pi)));
}

ElementSize element_size(const Job& job, double Z0, double points_per_wave) {
    const double points = points_of_elements(job, points_per_wave);
    return {points, points_under(job, Z0, points)};
}

double expected_megabytes(const Job& job, double workers) {
    const double contacts_at_once =
        std::max(1.0, std::min(workers, static_cast<double>(job.settings.run.realizations)));
    if (!by_elements(job.settings)) {
        if (job.settings.solids.layer_thickness.empty() || job.indenter.period.finite()) return 0;
        // Kept values of the kernel, of the contacts among each other and onto the other
        // candidates. Bytes from the peaks of six runs, within 5 %; a mesh keeps fewer.
        constexpr double coated_program = 55e6, touching_share = 0.4, bytes = 33, most_bytes = 11;
        double values = 0;
        for (const double level : job.levels) {
            const double all = expected_candidates(job, likely_separation(job, level));
            values = std::max(values, touching_share * (1 - 0.5 * touching_share) * all * all);
        }
        return 1e-6 *
               (coated_program +
                std::min(bytes * values, most_bytes * 2.0 * kMostKeptValues) * contacts_at_once);
    }
    // Bytes for each point of the surface (heights, modes; transforms of two flats), and for each
    // point under the indenter or in contact, from the peaks of some 40 runs (of the largest tables
    // of interpolation, of two); a single realization keeps the pixels of all its levels, and the
    // result some numbers a level. Stresses below the surface are not counted.
    constexpr double program = 40e6, tables = 90e6, table = 1500, record = 0.3e6;
    constexpr double under = 170, adhesion = 49, lowered = 8, states = 50;
    constexpr double flats = 28, touching = 150, pixel = 24;
    const double sticking = job.settings.solids.adhesion > 0 ? adhesion : 0;
    // Depths of lowered points, and with wear those of the level before.
    const double lowering = (std::isfinite(job.settings.solids.hardness) ? lowered : 0.0) +
                            (wears(job.settings) ? lowered + states : 0.0);
    const double heights = 8.4 + sticking + lowering;
    // Of the heights that can touch whole pages are kept, after the modes were: of waves that are 8
    // points long, most in a row of 4096 points.
    constexpr double in_pages = 32 * 8, row = 4096, modes = 8;
    const bool high = reads_high_points(job.settings),
               force = job.settings.indentation.control != Control::separation;
    const double points = points_of_elements(job, job.settings.elements.points_per_wave);
    // Where most of the surface is under the indenter, its far products take more.
    constexpr double deep = 50;
    // The gap of two flats, and what its permeability takes where it is open everywhere.
    constexpr double of_gap = 80;
    const double gap =
        of_gap * points + (job.settings.output.flow ? permeability_bytes(points) : 0);
    // Groups of levels side by side (job.hpp): a contact and its second grid for each thread.
    const double groups = static_cast<double>((job.levels.size() + kGroup - 1) / kGroup),
                 beside = groups < kFewestGroups || job.settings.run.realizations > 1
                              ? 0.0
                              : std::min(workers, groups) - 1;
    double most = 0, kept = 0;
    for (const double level : job.levels) {
        if (job.indenter.period.finite()) {
            const double share = share_in_contact(job, level, force);
            most = std::max(most, points * (flats + sticking + lowering + touching * share) + gap);
            if (job.settings.run.realizations == 1) kept += pixel * share * points;
            continue;
        }
        const double below = points_under(job, likely_separation(job, level), points);
        const double stored =
            high ? std::min(8 * points, in_pages * below * std::min(1.0, row / std::sqrt(points)))
                 : heights * points;
        most = std::max(
            {most, high ? modes / job.settings.elements.points_per_wave * points : 0.0,
             std::min(tables, table * below) + stored + (under + deep * below / points) * below +
                 (below > kFewPoints ? 0.0
                                     : beside * (std::min(tables, table * below) +
                                                 (1 + 0.25) * under * below + stored / 4))});
    }
    return 1e-6 * (program + record * static_cast<double>(job.levels.size()) + kept +
                   most * contacts_at_once);
}

}  // namespace rsc
