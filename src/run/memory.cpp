#include "run/memory.hpp"

#include "interaction/products.hpp"
#include "physics/physics.hpp"
#include "run/realize.hpp"

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

// Share of two flats in contact: under a force 2.1 p/(E* h'), or all; at a separation 0.4 of what
// is higher.
double share_in_contact(const Job& job, double level, bool is_force) {
    const double area = job.domain.Lx * job.domain.Ly;
    if (any_physics(job.settings, &Physics::reshapes)) return 1;
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

// The memory of elements, by its parts [byte].
class ElementBytes {
public:
    ElementBytes(const Job& job, double workers)
        : job_(job),
          workers_(workers),
          points_(points_of_elements(job, job.settings.elements.points_per_wave)) {
        for (const Physics* p : physics_asked(job.settings)) each_ += p->bytes_per_point;
    }

    // Of a realization: the largest of a level, and what it stores of all levels.
    double realization() const {
        const bool flats = job_.indenter.period.finite();
        double most = 0, stored = 0;
        for (const double level : job_.levels) {
            const double contact =
                flats ? points_ * share_in_contact(job_, level, by_force()) : under(level);
            most = std::max(most, flats ? between_flats(contact) : pressed(contact));
            if (flats && job_.settings.run.realizations == 1) stored += kPixel * contact;
        }
        constexpr double record = 0.3e6;
        return most + more() + fields() + stored + record * double(job_.levels.size());
    }

private:
    static constexpr double kPixel = 24;  // pressures that the result stores

    bool by_force() const { return job_.settings.indentation.control != Control::separation; }
    double under(double level) const {
        return points_under(job_, likely_separation(job_, level), points_);
    }

    double between_flats(double contact) const {
        // Heights, the plane of the transforms, and the gap.
        constexpr double planes = 28, touching = 165;
        return points_ * (planes + each_) + touching * contact;
    }

    // Of physics, beside each point.
    double more() const {
        double sum = 0;
        for (const Physics* p : physics_asked(job_.settings))
            if (p->bytes) sum += p->bytes(points_);
        return sum;
    }

    double pressed(double under) const {
        // Of the heights that can touch whole pages are stored, after the modes were: of waves that
        // are 8 points long, most in a row of 4096 points.
        constexpr double in_pages = 32 * 8, row = 4096, of_modes = 8, of_heights = 8.4;
        const bool high = reads_high_points(job_.settings);
        const double heights =
            high ? std::min(8 * points_, in_pages * under * std::min(1.0, row / std::sqrt(points_)))
                 : (of_heights + each_) * points_;
        const double modes = high ? of_modes / job_.settings.elements.points_per_wave * points_ : 0;
        // Where most of the surface is under the indenter, its far products take more.
        constexpr double of_contact = 170, deep = 50, of_table = 1500, most_tables = 90e6;
        const double tables = std::min(most_tables, of_table * under);
        const double level = tables + heights + (of_contact + deep * under / points_) * under;
        // Groups of levels side by side (realize.hpp): a contact for each thread.
        const double beside = tables + of_contact * under;
        return std::max(modes, level + (groups_at_once(under) - 1) * beside);
    }

    double groups_at_once(double under) const {
        const double groups = std::ceil(double(job_.levels.size()) / kGroup);
        const bool alone =
            groups < kFewestGroups || job_.settings.run.realizations > 1 || under > kFewPoints;
        return alone ? 1 : std::min(workers_, groups);
    }

    // Of the requested fields; vectors that grow hold up to twice as much.
    double fields() const {
        double values = 0;
        for (const AskedCurves& asked : job_.observe.curves)
            for (const PointField& f : asked.physics->fields)
                if (f.along && has_field(job_.settings, f.name))
                    values += double(asked.axis.size) - 1;
        values += double(job_.settings.output.fields.size());
        const std::size_t levels =
            std::max<std::size_t>(1, job_.settings.output.field_levels.size());
        return 2 * sizeof(double) * values * points_ * double(levels);
    }

    const Job& job_;
    double workers_, points_;
    double each_ = 0;  // bytes for each point of the surface, of its physics
};

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
    const double realization =
        elements ? ElementBytes(job, workers).realization() : coated_asperities(job);
    const double realizations = double(job.settings.run.realizations),
                 at_once = std::max(1.0, std::min(workers, realizations));
    constexpr double element_program = 40e6, coated_program = 55e6;
    return 1e-6 * ((elements ? element_program : coated_program) + realization * at_once);
}

}  // namespace rsc
