#include "run/job.hpp"

#include <cmath>

#include "contact/equivalent.hpp"
#include "contact/law/law.hpp"
#include "error.hpp"
#include "read/inputs.hpp"

namespace rsc {
namespace {

// Values between start and stop, both included.
std::vector<double> spaced(const Case::Indentation& keys) {
    if (!keys.levels.empty()) return keys.levels;
    std::vector<double> values(static_cast<std::size_t>(keys.steps));
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double t = keys.steps > 1 ? static_cast<double>(k) / (keys.steps - 1) : 0.0;
        values[k] =
            keys.spacing == Spacing::log ? keys.start * std::pow(keys.stop / keys.start, t) : keys.start + t * (keys.stop - keys.start);
    }
    if (keys.steps > 1) values.back() = keys.stop;  // exactly
    return values;
}

double rms(const std::vector<double>& values) {
    double mean = 0, square = 0;
    for (double v : values) mean += v;
    mean /= static_cast<double>(values.size());
    for (double v : values) square += (v - mean) * (v - mean);
    return std::sqrt(square / static_cast<double>(values.size()));
}

// Hertz asperities are the paper's, on the grid; the laws that look closer want the summits themselves.
Detail detail_of(const Case& settings) { return settings.asperities.law == LawKind::hertz ? Detail::grid : Detail::subgrid; }

void make_synthetic(Job& job) {
    const auto& keys = job.settings.surface;
    job.spectrum = Spectrum{keys.L.value_or(1.0), keys.hurst, keys.L_lambda_l, keys.L_lambda_s, keys.plateau, keys.sigma.value_or(0.01)};
    job.domain = {0, 0, job.spectrum->L, job.spectrum->L};
    job.sigma = job.spectrum->sigma;
    job.theory = theoretical_moments(*job.spectrum);
    job.solver.mean_spacing = job.theory->mean_spacing();
}

void read_surface(Job& job) {
    const auto& keys = job.settings.surface;
    HeightMap map = read_heights(keys.file, keys.L, job.settings.run.length_unit);
    const double rms_height = detrend(map, keys.detrend).rms;
    SummitCount count;
    const Detail detail = detail_of(job.settings);
    job.given = find_asperities(map, job.settings.asperities.curvature, &count, 1, detail);
    if (job.given.size() == 0) {
        const std::string where =
            detail == Detail::grid ? "inside the map" : std::to_string(kMeasuredReach) + " or more points inside the map";
        throw Error(Failure::bad_input, keys.file + ": no summit " + where + ": no point lies strictly above its 8 neighbours");
    }
    const Moments grid = grid_moments(map);
    auto& s = job.given_statistics;
    s.sigma = rms_height;
    s.m2 = s.m2_grid = grid.m2;
    s.m4 = s.m4_grid = grid.m4;
    s.mean_kappa_g = count.mean_kappa_g;
    s.mean_kappa_a = count.mean_kappa_a;
    s.summits = count.summits;
    s.saddles = count.saddles + count.repeated;
    job.domain = {map.x0, map.y0, map.Lx(), map.Ly()};
    job.sigma = keys.sigma.value_or(rms_height);
    if (job.settings.output.heights) job.given_heights = std::move(map);
}

void read_asperity_list(Job& job) {
    const auto& keys = job.settings.surface;
    job.given = read_asperities(keys.file, job.settings.run.length_unit);
    make_law(job.settings.asperities.law, job.given, 1);  // refuses asperities that lack what the law needs
    const Extent box = extent(job.given);
    const double side = std::max(box.x_max - box.x_min, box.y_max - box.y_min);
    // A square that holds them; a single asperity has no extent of its own.
    job.domain = {box.x_min, box.y_min, side, side};
    if (keys.L) job.domain.Lx = job.domain.Ly = *keys.L;
    if (!(job.domain.Lx > 0)) job.domain.Lx = job.domain.Ly = 1.0;
    if (keys.L && side > *keys.L) {
        throw Error(Failure::bad_input, "surface%L = " + std::to_string(*keys.L) + " is less than the extent of the asperities in " +
                                            keys.file + ", " + std::to_string(side));
    }
    auto& s = job.given_statistics;
    s.summits = static_cast<std::int64_t>(job.given.size());
    s.sigma = rms(job.given.z);
    job.sigma = keys.sigma.value_or(s.sigma);
}

}  // namespace

Job prepare(const Case& settings) {
    Job job;
    job.settings = settings;
    const auto& solver = settings.solver;
    job.solver.method = solver.method;
    job.solver.law = settings.asperities.law;
    job.solver.interaction = solver.interaction;
    job.solver.selection = settings.indentation.selection;
    job.solver.selection_factor = settings.indentation.selection_factor;
    job.solver.tolerance = solver.tolerance;
    job.solver.max_iterations = solver.max_iterations;
    job.solver.delta0 = solver.delta0;

    switch (settings.surface.source) {
        case Source::synthetic: make_synthetic(job); break;
        case Source::heights: read_surface(job); break;
        case Source::asperities: read_asperity_list(job); break;
    }
    if (!job.theory) job.solver.mean_spacing = std::sqrt(job.domain.Lx * job.domain.Ly / static_cast<double>(job.given.size()));
    const auto& indentation = settings.indentation;
    if (!(job.sigma > 0)) {
        throw Error(Failure::bad_input,
                    "surface%sigma: the rms height of what was read is 0; give a sigma > 0 (it scales unit='sigma' "
                    "and solver%delta0), and unit='length' if the levels are lengths");
    }
    job.solver.sigma = job.sigma;
    job.indenter.E_star = equivalent_modulus(settings.solids.E, settings.solids.nu);
    job.indenter.R = equivalent_radius(settings.solids.R);
    job.indenter.x0 = indentation.centre[0].value_or(job.domain.x0 + 0.5 * job.domain.Lx);
    job.indenter.y0 = indentation.centre[1].value_or(job.domain.y0 + 0.5 * job.domain.Ly);

    job.levels = spaced(indentation);
    if (indentation.control == Control::separation && indentation.unit == LevelUnit::sigma) {
        for (double& level : job.levels) level *= job.sigma;
    }
    const double sqrt_m4 = job.theory                    ? std::sqrt(job.theory->m4)
                           : job.given_statistics.m4 > 0 ? std::sqrt(job.given_statistics.m4)
                                                         : typical_sqrt_m4(job.given);
    job.observe = observe_options(settings, job.domain, job.indenter, job.sigma, sqrt_m4);
    return job;
}

Realization realize(const Job& job, std::int64_t number, int threads, const std::function<bool(std::size_t, const Level&)>& on_level) {
    Realization r;
    const auto& settings = job.settings;
    if (job.spectrum) {
        SummitCount count;
        Moments sampled;
        const auto& keys = settings.surface;
        Moments differences;
        if (settings.output.heights)
            r.heights = synthesize(*job.spectrum, keys.n, keys.normalise, settings.run.seed, number, nullptr, threads);
        r.asperities = make_asperities(*job.spectrum, keys.n, keys.normalise, settings.run.seed, number, settings.asperities.curvature,
                                       &count, &sampled, threads, detail_of(settings), &differences);
        auto& s = r.statistics;
        s.sigma = std::sqrt(sampled.m0);
        s.m2 = sampled.m2;
        s.m4 = sampled.m4;
        s.m2_grid = differences.m2;
        s.m4_grid = differences.m4;
        s.mean_kappa_g = count.mean_kappa_g;
        s.mean_kappa_a = count.mean_kappa_a;
        s.summits = count.summits;
        s.saddles = count.saddles + count.repeated;
    } else {
        r.asperities = job.given;
        r.statistics = job.given_statistics;
    }
    Contact contact(r.asperities, job.indenter, job.solver);
    r.levels.reserve(job.levels.size());
    for (std::size_t k = 0; k < job.levels.size(); ++k) {
        if (settings.indentation.control == Control::force) {
            r.levels.push_back(contact.at_force(job.levels[k]));
            r.stiffness.push_back(contact.stiffness());
        } else {
            r.levels.push_back(contact.at_separation(job.levels[k]));
        }
        if (on_level && !on_level(k, r.levels.back())) break;
    }
    return r;
}

RealizationRecord observe(const Job& job, std::int64_t number, const Realization& r) {
    return observe(job.observe, number, r.statistics, r.asperities, r.levels, r.stiffness);
}

}  // namespace rsc
