#include "run/forecast.hpp"

#include "base/error.hpp"
#include "interaction/mesh.hpp"
#include "interaction/pair_matrix.hpp"
#include "physics/flow/permeability.hpp"
#include "run/compare.hpp"

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
    return sum * std::max(width, 0.0) / (sigma * std::sqrt(2 * 3.14159265358979));
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

double level_seconds(const Job& job, double candidates) {
    // As for method `auto` (contact.cpp): about 40 products with the contacts, which are 0.4 of the
    // candidates, at 6e9 pairs per second.
    const double contacts = 0.4 * candidates;
    double solve = 40 * contacts * contacts / 6e9;
    if (job.solver.method == Method::dgesv)
        solve = 10 * candidates * candidates * candidates /
                1.5e9;  // ten factorisations of 2/3 n^3 operations at 1e9 per second
    else if (job.solver.method != Method::direct && candidates > 1)
        solve = std::min(
            solve, 160 * MeshPotential::estimated_cost(static_cast<std::size_t>(candidates), 1e-3));
    return 1e-4 + 3e-6 * candidates + solve;
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
    if (!is_force) return std::min(1.0, 0.4 * area_under(job, level) / area);
    const double slope = job.theory ? job.theory->rms_slope() : job.solver.rms_slope;
    return slope > 0 ? std::erf(1.86 * level / area / (job.indenter.E_star * slope)) : 1.0;
}

// Number of grid points of elements that are higher than the indenter at Z0.
double points_under(const Job& job, double Z0, double points) {
    return points * area_under(job, Z0) / (job.domain.Lx * job.domain.Ly);
}

// An indenter over nearly the whole surface is a punch, with high pressures at the border:
// additional time, and its share.
constexpr double kPunch = 2.5;
double punch_share(double under, double points) { return std::pow(under / points, 6); }

// Elastic separations with half as many points again as the level before start from pressures that
// help little.
constexpr double kCold = 1.7, kGrown = 1.5;

// Seconds to make a point of a surface: all heights, or modes and the heights that can touch.
double making_seconds(const Job& job) {
    return !job.spectrum ? 0 : reads_high_points(job.settings) ? 7e-9 : 3e-8;
}

// Seconds for a level by elements, a separation or a force, from trials on one core. Two flats:
// transforms of all points, and steps on those in contact. Otherwise the time is that of the points
// under the indenter. A force takes some more products than a separation, and levels where points
// yield many more.
double element_level_seconds(const Job& job, double level, double points, bool is_force) {
    if (job.indenter.period.finite()) {
        const double share = share_in_contact(job, level, is_force);
        return points *
               (job.settings.solids.adhesion > 0 ? 2.4e-7 + 2.5e-6 * share : 9e-8 + 3e-6 * share);
    }
    const double under =
                     points_under(job, is_force ? likely_separation(job, level) : level, points),
                 share = punch_share(under, points);
    const bool yields = std::isfinite(job.settings.solids.hardness);
    const double products =
        (yields ? 3 : 1) * (is_force ? (yields ? 4 : 1.5) * (1 + 2 * share) : 1);
    return 5e-5 * std::pow(under, 0.75) * (1 + kPunch * share) * products *
           (job.settings.solids.layer_thickness.empty() ? 1 : 2);
}

// Penetration of the smooth indenter under a force; 0 if no closed form is known.
double smooth_depth(const Job& job, double force) {
    const auto smooth = job.indenter.shape->smooth(job.indenter.E_star);
    return smooth ? smooth->depth_under(force) : 0.0;
}

// Seconds for a surface, including its summits.
double surface_seconds(const Case& settings) {
    constexpr int small = 512;
    Case sample = settings;
    auto& keys = sample.surface;
    const double scale = std::max(1.0, settings.surface.n / static_cast<double>(small));
    if (scale > 1) {
        keys.n = small;
        keys.L_lambda_s = std::max(2.0, settings.surface.L_lambda_s / scale);
        keys.L_lambda_l =
            std::min(std::max(1.0, settings.surface.L_lambda_l / scale), 0.5 * keys.L_lambda_s);
    }
    const std::clock_t start = std::clock();  // of the processor, which other programs may share
    try {
        make_surface_model(sample, 1, 1);
    } catch (const Error&) {  // the piece of surface is so small that it has no summit
    }
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC * scale * scale;
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

double element_seconds(const Job& job, double Z0, double points_per_wave) {
    constexpr double making = 3e-8;  // for each point of a synthetic surface
    const double points = points_of_elements(job, points_per_wave);
    return (job.spectrum ? making * points : 0) +
           kCold * element_level_seconds(job, Z0, points, false);
}

double expected_seconds(const Job& job, double workers) {
    const bool force = job.settings.indentation.control != Control::separation;
    const bool elements = by_elements(job.settings);
    const double points =
        elements ? points_of_elements(job, job.settings.elements.points_per_wave) : 0;
    const bool layers = !job.settings.solids.layer_thickness.empty();
    constexpr double program = 0.04;
    double one = elements    ? making_seconds(job) * points
                 : job.given ? 0
                             : surface_seconds(job.settings);
    if (compares(job, true)) one += comparison_seconds(job);
    const bool steps = elements && !force && !layers && !job.indenter.period.finite() &&
                       !std::isfinite(job.settings.solids.hardness);
    double before = 0, longest = 0, last_time = job.times.empty() ? 0.0 : job.times.front();
    for (std::size_t k = 0; k < job.levels.size(); ++k) {
        const double level = job.levels[k], begun = one;
        const double under = steps ? points_under(job, level, points) : 0;
        if (elements)
            one += std::max(1.0, steps && under > kGrown * before
                                     ? kCold / (1 + kPunch * punch_share(under, points))
                                     : 0.0) *
                   element_level_seconds(job, level, points, force);
        else
            one += (force && !job.indenter.period.finite() ? 2.5 : 1) * (layers ? 2 : 1) *
                   (job.indenter.period.finite() ? 8 : 1) *
                   level_seconds(job, expected_candidates(job, likely_separation(job, level)));
        if (relaxes(job.settings)) {  // in steps of time, of elements also on a coarser grid
            const double parts =
                steps_of_time(job.times[k] - last_time, job.solver.relaxation.shortest());
            one += (one - begun) *
                   ((elements && job.settings.run.realizations == 1 ? 1.25 : 1.0) * parts - 1);
            last_time = job.times[k];
        }
        before = under;
        if (elements && job.indenter.period.finite())
            longest = std::max(longest, element_level_seconds(job, level, points, force));
    }
    one += 0.25 * longest;            // two flats: the check on a coarser grid
    constexpr double circles = 1e-6;  // for the weights of the radial means
    const auto& output = job.settings.output;
    one += circles * output.map_cells * output.radial_bins;
    const double realizations = job.settings.run.realizations;
    return program + one * std::ceil(realizations / std::max(1.0, std::min(workers, realizations)));
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
    // point under the indenter or in contact, from the peaks of some 40 runs; a single realization
    // keeps the pixels of all its levels, and the result some numbers a level.
    constexpr double program = 40e6, tables = 15e6, table = 1500, under = 170, adhesion = 49,
                     yielding = 5, flats = 28, touching = 150, pixel = 24, record = 0.3e6;
    const double sticking = job.settings.solids.adhesion > 0 ? adhesion : 0;
    const double heights =
        8.4 + sticking + (std::isfinite(job.settings.solids.hardness) ? yielding : 0.0);
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
    double most = 0, kept = 0;
    for (const double level : job.levels) {
        if (job.indenter.period.finite()) {
            const double share = share_in_contact(job, level, force);
            most = std::max(most, points * (flats + sticking + touching * share) + gap);
            if (job.settings.run.realizations == 1) kept += pixel * share * points;
            continue;
        }
        const double below = points_under(job, likely_separation(job, level), points);
        const double stored =
            high ? std::min(8 * points, in_pages * below * std::min(1.0, row / std::sqrt(points)))
                 : heights * points;
        most = std::max(
            {most, high ? modes / job.settings.elements.points_per_wave * points : 0.0,
             std::min(tables, table * below) + stored + (under + deep * below / points) * below});
    }
    return 1e-6 * (program + record * static_cast<double>(job.levels.size()) + kept +
                   most * contacts_at_once);
}

}  // namespace rsc
