#include "run/forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "contact/interaction/mesh.hpp"
#include "contact/ranking.hpp"
#include "error.hpp"

namespace rsc {
namespace {

// E[h^p] over h > 0, h = z - Z0 with Gaussian heights z of deviation sigma, by the midpoint rule.
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

// Greenwood and Tripp's sum without interaction: force of a sphere at Z0 on Gaussian summits. More than the sphere carries.
double greenwood_force(const Job& job, double Z0) {
    const double r = job.theory ? job.theory->mean_radius() : 1.0;
    const double density = 1 / (job.site.mean_spacing * job.site.mean_spacing), k = 4.0 / 3.0 * job.indenter.E_star * std::sqrt(r);
    if (std::isinf(job.indenter.R)) return density * job.site.domain.Lx * job.site.domain.Ly * k * mean_excess(Z0, job.sigma, 1.5);
    return density * k * 2 * 3.14159265358979 * job.indenter.R * 0.4 * mean_excess(Z0, job.sigma, 2.5);
}

// A separation that carries some such force.
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
    // As `auto` counts (contact.cpp): some 40 products of the contacts, 0.4 of the candidates, at 6e9 pairs a second.
    const double contacts = 0.4 * candidates;
    double solve = 40 * contacts * contacts / 6e9;
    if (job.solver.method == Method::dgesv)
        solve = 10 * candidates * candidates * candidates / 1.5e9;  // ten factorisations, two thirds of n^3, 1 G a second
    else if (job.solver.method != Method::direct && candidates > 1)
        solve = std::min(solve, 160 * MeshPotential::estimated_cost(static_cast<std::size_t>(candidates), 1e-3));
    return 1e-4 + 3e-6 * candidates + solve;
}

// Seconds for a surface, its summits included.
double surface_seconds(const Case& settings) {
    using Clock = std::chrono::steady_clock;
    constexpr int small = 512;
    Case sample = settings;
    auto& keys = sample.surface;
    const double scale = std::max(1.0, settings.surface.n / static_cast<double>(small));
    if (scale > 1) {
        keys.n = small;
        keys.L_lambda_s = std::max(2.0, settings.surface.L_lambda_s / scale);
        keys.L_lambda_l = std::min(std::max(1.0, settings.surface.L_lambda_l / scale), 0.5 * keys.L_lambda_s);
    }
    const auto start = Clock::now();
    try {
        make_ground(sample, 1, 1);
    } catch (const Error&) {  // a piece of the surface so small that it has no summit
    }
    return std::chrono::duration<double>(Clock::now() - start).count() * scale * scale;
}

}  // namespace

double expected_candidates(const Job& job, double Z0) {
    if (job.given) {
        const Asperities& a = job.given->asperities;
        double count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += height_under_sphere(job.indenter, a.x[i], a.y[i], a.z[i]) > Z0 ? 1 : 0;
        return count;
    }
    const double density = 1 / (job.site.mean_spacing * job.site.mean_spacing);
    const double everywhere = density * job.site.domain.Lx * job.site.domain.Ly * mean_excess(Z0, job.sigma, 0);
    if (std::isinf(job.indenter.R)) return everywhere;
    return std::min(everywhere, density * 2 * 3.14159265358979 * job.indenter.R * mean_excess(Z0, job.sigma, 1));
}

double expected_seconds(const Job& job, double workers) {
    const bool force = job.settings.indentation.control != Control::separation;
    double one = job.given ? 0 : surface_seconds(job.settings);
    for (const double level : job.levels) {
        if (!force)
            one += level_seconds(job, expected_candidates(job, level));
        else if (job.given)
            one += 6 * level_seconds(job, expected_candidates(job, 0.0));  // some six separations a level
        else
            one += 6 * level_seconds(job, expected_candidates(job, separation_at(job, level)));
    }
    const double realizations = job.settings.run.realizations;
    return one * std::ceil(realizations / std::max(1.0, std::min(workers, realizations)));
}

}  // namespace rsc
