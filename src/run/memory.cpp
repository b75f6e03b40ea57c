#include "run/memory.hpp"

#include "interaction/products.hpp"
#include "physics/physics.hpp"

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
    return sum * std::max(width, 0.0) / (sigma * std::sqrt(2 * pi));
}

// The integral of mean_excess(Z0 + s) over the domain, s being the height of the indenter's face:
// from the areas of the face in intervals of height, sampled on a grid.
double under_indenter(const Job& job, double Z0, double power) {
    constexpr int side = 96, steps = 32;
    const double step = std::max(1.0, 6 - Z0 / job.sigma) * job.sigma / steps;
    double area[steps] = {};
    const Domain& d = job.domain;
    for (const int j : indices(side))
        for (const int i : indices(side)) {
            const double x = d.x0 + (i + 0.5) * d.Lx / side - job.indenter.x0,
                         y = d.y0 + (j + 0.5) * d.Ly / side - job.indenter.y0;
            const double s = std::max(0.0, job.indenter.shape->height(x, y)) / step;
            if (s < steps) area[int(s)] += d.Lx * d.Ly / (side * side);
        }
    double sum = 0;
    for (const int k : indices(steps))
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
    const double higher = job.theory ? 4 * job.theory->m2 / std::sqrt(pi * job.theory->m4) : 0.0;
    const double elastic = density * k * under_indenter(job, Z0 - higher, 1.5),
                 most = largest_pressure(job.settings);
    return std::isfinite(most) ? std::min(elastic, most * under_indenter(job, Z0, 0)) : elastic;
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
    if (job.heights) return double(job.heights->nx) * job.heights->ny;
    return job.spectrum ? std::pow(points_per_wave * job.spectrum->L_lambda_s, 2) : 0;
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
        for (const auto i : indices(a))
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
                                              (job.indenter.E_star * std::sqrt(1.5 * area / pi)));
}

ElementSize element_size(const Job& job, double Z0, double points_per_wave) {
    const double points = points_of_elements(job, points_per_wave);
    return {points, points_under(job, Z0, points)};
}

namespace {

// Of elements [byte]: the surface with its physics and fields, and the points under the indenter.
double of_elements(const Job& job) {
    const Case& settings = job.settings;
    const bool flats = job.indenter.period.finite();
    const double per_wave = settings.elements.points_per_wave, number = sizeof(double);
    const double points = points_of_elements(job, per_wave);
    // Between flats a plane of transforms and the gap, too; where only high points are read, modes
    // of waves that are `per_wave` points long.
    double surface = flats ? 28 : reads_high_points(settings) ? number / per_wave : number;
    double fields = double(settings.output.fields.size()), more = 0;
    for (const Physics* p : physics_asked(settings)) {
        surface += p->bytes_per_point;
        if (p->bytes) more += p->bytes(points);
    }
    for (const AskedCurves& asked : job.observe.curves)
        for (const PointField& f : asked.physics->fields)
            if (f.along && has_field(settings, f.name)) fields += double(asked.axis.size) - 1;
    fields *= double(std::max<std::size_t>(1, settings.output.field_levels.size()));
    double most = 0, all = 0;
    for (const double level : job.levels) {
        const double under = points_under(job, likely_separation(job, level), points);
        most = std::max(most, under);
        all += under;
    }
    // About half of the points under a flat touch it; the result stores their pressures.
    constexpr double touching = 80, pressed = 200, stored = 12;
    // Vectors of fields that grow hold up to twice as much.
    return points * (surface + 2 * number * fields) + more + (flats ? touching : pressed) * most +
           (flats && settings.run.realizations == 1 ? stored * all : 0.0);
}

// Of the stored values of the kernel of coated asperities, at most between all candidates [byte].
double coated_asperities(const Job& job) {
    double values = 0;
    for (const double level : job.levels)
        values =
            std::max(values, std::pow(expected_candidates(job, likely_separation(job, level)), 2));
    return sizeof(double) * std::min(values, double(kMostStoredValues));
}

}  // namespace

Unknowns expected_unknowns(const Job& job) {
    const bool elements = by_elements(job.settings), flats = job.indenter.period.finite();
    const double points = points_of_elements(job, job.settings.elements.points_per_wave);
    double most = 0;
    for (const double level : job.levels) {
        const double Z0 = likely_separation(job, level);
        most =
            std::max(most, elements ? points_under(job, Z0, points) : expected_candidates(job, Z0));
    }
    const double step = std::pow(10, std::max(0.0, std::floor(std::log10(most)) - 1));
    const std::string about = format("about %.0f", step * std::round(most / step));
    if (!elements)
        return {most, "asperities, " + about + " under the indenter at the largest load"};
    const int n = job.heights ? 0 : element_points(job.settings, *job.spectrum);
    const std::string grid =
        job.heights ? format("%d x %d", job.heights->nx, job.heights->ny) : format("%d x %d", n, n);
    if (flats) return {points, "elements, a grid of " + grid + " points with a pressure at each"};
    return {most, "elements, a grid of " + grid + " points; unknowns are the pressures at those " +
                      "under the indenter, " + about + " at the largest load"};
}

double expected_megabytes(const Job& job, double workers) {
    const bool elements = by_elements(job.settings),
               coated = !job.settings.solids.layer_thickness.empty();
    if (!elements && (!coated || job.indenter.period.finite())) return 0;
    const double realization = elements ? of_elements(job) : coated_asperities(job);
    const double realizations = double(job.settings.run.realizations),
                 at_once = std::max(1.0, std::min(workers, realizations));
    constexpr double element_program = 40e6, coated_program = 55e6;
    return 1e-6 * ((elements ? element_program : coated_program) + realization * at_once);
}

}  // namespace rsc
