#include "run/job.hpp"

#include <cmath>
#include <memory>

#include "case/registry.hpp"
#include "contact/answers.hpp"
#include "contact/asperity_contact.hpp"
#include "contact/element_contact.hpp"
#include "contact/equivalent.hpp"
#include "error.hpp"
#include "format.hpp"
#include "read/file_list.hpp"
#include "run/friction_loops.hpp"

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

// As many files as realizations.
void require_maps(const Case& settings) {
    const auto files = static_cast<std::int64_t>(matching_files(settings.surface.file).size());
    const std::int64_t last = std::int64_t{settings.run.first_realization} + settings.run.realizations - 1;
    if (last > files)
        throw Error(Failure::bad_input, settings.surface.file + ": realizations up to " + std::to_string(last) + " are asked for, and " +
                                            std::to_string(files) + " files match");
}

// The sphere comes down on the same place of every map: they must be of one size; where one lies says nothing.
void move_to(const Domain& place, Ground& ground, std::int64_t number) {
    constexpr double kSame = 1e-6;
    const Domain& d = ground.site.domain;
    if (!(std::abs(d.Lx - place.Lx) <= kSame * place.Lx && std::abs(d.Ly - place.Ly) <= kSame * place.Ly))
        throw Error(Failure::bad_input, "the map of realization " + std::to_string(number) + " is " + std::to_string(d.Lx) + " x " +
                                            std::to_string(d.Ly) + ", the first is " + std::to_string(place.Lx) + " x " +
                                            std::to_string(place.Ly) + "; maps of one size are expected");
    for (double& x : ground.asperities.x) x += place.x0 - d.x0;
    for (double& y : ground.asperities.y) y += place.y0 - d.y0;
    ground.site.domain = place;
}

}  // namespace

Job prepare(const Case& settings) {
    Job job;
    job.settings = settings;
    const bool elements = settings.solver.model == Model::elements;
    double sqrt_m4;
    if (has_spectrum(settings)) {
        job.spectrum = spectrum_of(settings);
        if (elements || !settings.compare.levels.empty()) require_element_memory(settings, *job.spectrum);
        job.site = synthetic_site(*job.spectrum);
        job.theory = theoretical_moments(*job.spectrum);
        sqrt_m4 = std::sqrt(job.theory->m4);
    } else {
        Ground ground;
        if (settings.surface.source == Source::heights) {
            Surface surface = make_surface(settings, settings.run.first_realization, 1);
            ground = elements ? make_bare_ground(surface) : make_ground(surface, settings, 1);
            if (settings.output.heights || elements || !settings.compare.levels.empty()) job.given_heights = std::move(surface.map);
        } else {
            ground = make_ground(settings, 1, 1);
        }
        job.site = ground.site;
        job.measured = ground.measured;
        sqrt_m4 = ground.statistics.m4 > 0 ? std::sqrt(ground.statistics.m4) : elements ? 0.0 : typical_sqrt_m4(ground.asperities);
        if (!differs_by_realization(settings) || settings.run.realizations == 1) job.given = std::move(ground);
        if (differs_by_realization(settings)) require_maps(settings);
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
    if (indentation.control == Control::separation && indentation.unit == LevelUnit::sigma) job.level_unit = job.sigma;
    if (indentation.control == Control::pressure) {
        // Into forces. m2 is the spectrum's, so that a pressure is the same for every realization, or that of the map read.
        const double m2 = job.theory ? job.theory->m2 : job.given->statistics.m2, full = job.indenter.E_star * std::sqrt(2 * m2);
        const bool relative = indentation.unit == LevelUnit::relative;
        if (relative && !(m2 > 0)) {
            throw Error(Failure::bad_input,
                        "indentation%unit = 'relative': the surface's rms slope is not known, only summits; use unit = 'pressure'");
        }
        const double unit = relative ? full : 1.0;
        for (double level : job.levels) {
            if (level * unit >= kClosingPressure * full)
                throw Error(Failure::bad_input,
                            format("indentation: a pressure of %g closes the gap altogether: it must be below E* sqrt(2 m2) = %g",
                                   level * unit, full));
        }
        job.level_unit = unit * job.indenter.period.area();
    }
    for (double& level : job.levels) level *= job.level_unit;
    job.observe = observe_options(settings, job.site.domain, job.indenter, job.sigma, sqrt_m4);
    return job;
}

Realization realize(const Job& job, std::int64_t number, int threads, const std::function<bool(std::size_t, const Level&)>& on_level) {
    Realization r;
    const auto& settings = job.settings;
    std::unique_ptr<Contact> contact;
    if (settings.solver.model == Model::elements) {
        if (job.given) {
            r.statistics = job.given->statistics;
        } else {
            Surface surface = make_element_surface(settings, number, threads);
            Ground ground = make_bare_ground(surface);
            if (!job.spectrum) {  // one of several maps
                move_to(job.site.domain, ground, number);
                surface.map.x0 = job.site.domain.x0, surface.map.y0 = job.site.domain.y0;
            }
            r.statistics = ground.statistics;
            r.heights = std::move(surface.map);
        }
        contact = make_element_contact(job.given ? *job.given_heights : *r.heights, job.indenter, job.solver);
    } else {
        if (settings.output.heights && job.spectrum) r.heights = make_surface(settings, *job.spectrum, number, threads).map;
        Ground ground = job.spectrum ? make_ground(settings, *job.spectrum, number, threads)
                        : job.given  ? *job.given
                                     : make_ground(settings, number, threads);
        if (settings.surface.source == Source::heights) move_to(job.site.domain, ground, number);
        r.asperities = std::move(ground.asperities);
        r.statistics = ground.statistics;
        contact = std::make_unique<AsperityContact>(r.asperities, job.indenter, job.solver);
    }
    std::optional<FrictionRows> friction;
    if (settings.solids.friction > 0) {
        const auto another = [&] { return std::make_unique<AsperityContact>(r.asperities, job.indenter, job.solver); };
        friction.emplace(Friction{settings.solids.friction, tangential_ratio(settings.solids.E, settings.solids.nu)}, another(), another());
    }
    r.levels.reserve(job.levels.size());
    for (std::size_t k = 0; k < job.levels.size(); ++k) {
        if (settings.indentation.control != Control::separation) {
            r.levels.push_back(contact->at_force(job.levels[k]));
        } else {
            r.levels.push_back(contact->at_separation(job.levels[k]));
        }
        Level& level = r.levels.back();
        add_answers(*contact, level, settings.solids.resistivity);
        if (friction && !friction->add(level, r.friction)) level.status = LevelStatus::not_converged;
        if (on_level && !on_level(k, r.levels.back())) break;
    }
    r.residual_depth = contact->residual_depths();
    r.residual_profile = contact->residual_profile();
    contact.reset();
    if (!settings.output.heights) r.heights.reset();
    return r;
}

RealizationRecord observe(const Job& job, std::int64_t number, const Realization& r) {
    return observe(job.observe, number, r.statistics, r.levels);
}

}  // namespace rsc
