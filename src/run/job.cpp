#include "run/job.hpp"

#include <cmath>

#include "error.hpp"

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

}  // namespace

Job prepare(const Case& settings) {
    Job job;
    job.settings = settings;
    double sqrt_m4;
    if (settings.surface.source == Source::synthetic) {
        job.site = synthetic_site(settings);
        job.theory = theoretical_moments(spectrum_of(settings));
        sqrt_m4 = std::sqrt(job.theory->m4);
    } else {
        if (settings.surface.source == Source::heights && settings.output.heights) {
            Surface surface = make_surface(settings, 1, 1);
            job.given = make_ground(surface, settings, 1);
            job.given_heights = std::move(surface.map);
        } else {
            job.given = make_ground(settings, 1, 1);
        }
        job.site = job.given->site;
        sqrt_m4 = job.given->statistics.m4 > 0 ? std::sqrt(job.given->statistics.m4) : typical_sqrt_m4(job.given->asperities);
    }
    job.sigma = sigma_of(settings, job.site);
    if (!(job.sigma > 0)) {
        throw Error(Failure::bad_input,
                    "surface%sigma: the rms height of what was read is 0; give a sigma > 0 (it scales unit='sigma' "
                    "and solver%delta0), and unit='length' if the levels are lengths");
    }
    job.solver = solver_of(settings, job.site);
    job.indenter = indenter_of(settings, job.site);

    const auto& indentation = settings.indentation;
    job.levels = spaced(indentation);
    if (indentation.control == Control::separation && indentation.unit == LevelUnit::sigma) {
        for (double& level : job.levels) level *= job.sigma;
    }
    job.observe = observe_options(settings, job.site.domain, job.indenter, job.sigma, sqrt_m4);
    return job;
}

Realization realize(const Job& job, std::int64_t number, int threads, const std::function<bool(std::size_t, const Level&)>& on_level) {
    Realization r;
    const auto& settings = job.settings;
    if (settings.output.heights && !job.given) r.heights = make_surface(settings, number, threads).map;
    Ground ground = job.given ? *job.given : make_ground(settings, number, threads);
    r.asperities = std::move(ground.asperities);
    r.statistics = ground.statistics;
    AsperityContact contact(r.asperities, job.indenter, job.solver);
    r.levels.reserve(job.levels.size());
    for (std::size_t k = 0; k < job.levels.size(); ++k) {
        if (settings.indentation.control == Control::force) {
            r.levels.push_back(contact.at_force(job.levels[k]));
            r.levels.back().stiffness = contact.stiffness();
        } else {
            r.levels.push_back(contact.at_separation(job.levels[k]));
        }
        if (on_level && !on_level(k, r.levels.back())) break;
    }
    return r;
}

RealizationRecord observe(const Job& job, std::int64_t number, const Realization& r) {
    return observe(job.observe, number, r.statistics, r.levels);
}

}  // namespace rsc
