// Remarks after the levels: methods, statuses with their meaning and remedy, expected errors,
// warnings.

#include "asperities/shifted_summits.hpp"
#include "base/format.hpp"
#include "physics/adhesion/adhesive_elements.hpp"
#include "run/screen.hpp"
#include "trust/judge.hpp"

namespace rsc {
namespace {

// Dundurs' second parameter, which couples the normal and the tangential problem; 0 for equal
// bodies.
double coupling(const Case::Solids& s) {
    const auto compliance = [&](int i) {
        return std::isinf(s.E[i]) ? 0.0 : 2 * (1 + s.nu[i]) / s.E[i];
    };  // 1/G
    const double above = (1 - 2 * s.nu[0]) * compliance(0) - (1 - 2 * s.nu[1]) * compliance(1);
    const double below = 2 * ((1 - s.nu[0]) * compliance(0) + (1 - s.nu[1]) * compliance(1));
    return above / below;
}

struct Remarks {
    std::ostream& out;
    std::span<const LevelValues> levels;
    const Job& job;
    const Case& c = job.settings;
    bool elements = by_elements(c);
    const char *l = c.run.length_unit.c_str(), *f = c.run.force_unit.c_str();

    void print() const {
        if (!elements) print_methods();
        print_bounds();
        print_statuses();
        const auto extreme =
            std::ranges::max_element(levels, [](const LevelValues& p, const LevelValues& q) {
                return p.extreme_area_fraction < q.extreme_area_fraction;
            });
        // the hardness of hardened steel; softer bodies bear E*/10
        constexpr double kHardest = 5e9;  // [Pa]
        if (job.indenter.E_star / 10 * pascals(c) > kHardest && !yields(c) && !relaxes(c) &&
            extreme != levels.end() && extreme->extreme_area_fraction > kExtremeShare)
            out << format(
                "  pressures above E*/10 on %.0f %% of the contact area at %s: no metal stays "
                "elastic "
                "at such pressures; solids%%hardness limits them.\n",
                100 * extreme->extreme_area_fraction, place_of(*extreme).c_str());
        print_changes();
        print_sticking();
        print_words();
        std::int64_t crowded = 0;
        for (const LevelValues& level : levels) crowded += level.crowded_cells;
        if (crowded > 0 && !elements)
            out << "  " << crowded
                << " map cells (over all levels) have an area fraction above pi/16 = 19.6 %, where "
                   "contacts would merge.\n";
    }

    // Says how many of the levels this holds for.
    void say(auto holds, const std::string& what) const {
        if (const auto found = std::ranges::count_if(levels, holds); found > 0)
            out << format("  %td of %zu levels: ", found, levels.size()) << what << ".\n";
    }

    // Names a level in the quantity that the case prescribes.
    std::string place_of(const LevelValues& level) const {
        if (c.indentation.control == Control::separation)
            return format("Z0/sigma = %.4g", level.separation / job.sigma);
        return format("N = %.4g %s", level.force, f);
    }

    void print_methods() const {
        std::map<std::pair<Method, Fallback>, long> counts;
        for (const LevelValues& level : levels) ++counts[{level.method, level.fallback}];
        out << "method:";
        const char* before = " ";
        for (const auto& [how, count] : counts) {
            out << before << name_of(how.first) << " (" << count
                << (count == 1 ? " level" : " levels") << (how.second == Fallback::none ? "" : ": ")
                << fallback_text(how.second) << ")";
            before = ", ";
        }
        out << '\n';
    }

    std::string remedy_of_grid() const {
        return job.spectrum
                   ? format("; use elements%%points_per_wave = %g", 2 * c.elements.points_per_wave)
                   : "; the map has too few points for its contacts";
    }

    // Advice where the surface is known beyond a list of asperities, so that elements can solve it.
    std::string to_elements(const char* reason = " solves the surface itself") const {
        if (c.surface.source == Source::asperities) return "";
        const bool ranged = attracts(c) && c.solids.adhesion_range == 0;
        return std::string("; solver%model = 'elements'") +
               (ranged ? " with a solids%adhesion_range" : "") + reason;
    }

    std::string remedy_of(Cause cause) const {
        if (cause == Cause::filled_points) return "";
        if (cause == Cause::border) return job.spectrum ? "; enlarge surface%L" : "";
        if (elements)
            return cause == Cause::grid || cause == Cause::missed_contact ? remedy_of_grid() : "";
        return to_elements();
    }

    void print_doubts() const {
        for (const auto k : indices(kCauseNames)) {
            const Cause cause{int(k)};
            say([&](const LevelValues& l) { return (l.doubts & bit(cause)) != 0; },
                words_of_doubts(bit(cause)) + " - " + sentence(cause, elements) + remedy_of(cause));
        }
        if (std::ranges::any_of(levels, [](const LevelValues& l) { return l.force != 0; })) return;
        out << "  no level reaches contact: ";
        if (std::isfinite(job.points_touch))
            out << format("the first point of the map touches at Z0 = %g (%g sigma).\n",
                          job.points_touch, job.points_touch / job.sigma);
        else
            out << "give smaller separations.\n";
    }

    void print_failures() const {
        const std::string failure = "NOT CONVERGED - ";
        const auto held = [](const LevelValues& l) { return l.fallback == Fallback::held; };
        say(held,
            "no state has the force asked for: the level is the last stable one, that of "
            "the smallest force, where the bodies part under a dead load; give separations "
            "(indentation%control = 'separation') to go beyond");
        const auto jump = [](const LevelValues& l) { return l.fallback == Fallback::jump; };
        say(jump, failure +
                      "the force asked for is inside a jump of N(Z0), so that no separation has "
                      "it. The level is a state at one side of the jump; prescribe separations "
                      "there, or another force" +
                      (elements ? "" : to_elements(" has no such jumps between close contacts")));
        const auto failed = [&](const LevelValues& l) {
            return !l.converged && !held(l) && !jump(l);
        };
        const bool flats = c.indentation.boundary == Boundary::periodic;
        std::string remedy = "raise solver%max_iterations or the tolerance";
        if (!elements && attracts(c))
            remedy = "contacts overlap too much to follow their path" + to_elements();
        else if (!elements && (!c.solids.layer_thickness.empty() || flats))
            remedy =
                "with contacts wider than the top layer, or between flats pressed deep, the "
                "asperity model may have no solution" +
                to_elements();
        else if (elements && !c.solids.relaxation_share.empty() && flats)
            remedy = "bodies that relax may have closed the gap between flats; otherwise " + remedy;
        say(failed,
            failure + "the residual is above solver%tolerance: do not use these values; " + remedy);
    }

    void print_statuses() const {
        print_doubts();
        say(
            [](const LevelValues& l) {
                return std::isnan(l.stiffness) && l.contacts > 0 && l.converged;
            },
            std::string("stiffness, conductance and resistance are missing: ") +
                (elements ? "their iteration did not converge, or the gap of worn flats is closed"
                          : "contacts overlap too much for them" + to_elements()));
        say([](const LevelValues& l) { return l.status == LevelStatus::overlapping; },
            "overlapping - pairs of contact spots closer than the sum of their radii: "
            "spots that would merge are counted as two");
        say([](const LevelValues& l) { return l.status == LevelStatus::not_unique; },
            "not unique - spots that overlap so much that other solutions may exist: this "
            "one is a local minimum of the energy, selected by a fixed rule");
        print_failures();
    }

    // "N = 1.23 N +- 5 %": the last level of a single run that has expected errors; under a
    // prescribed force the separation instead of N.
    void print_bounds() const {
        const auto last = std::find_if(levels.rbegin(), levels.rend(), [](const LevelValues& l) {
            return l.force_error_expected >= 0 || l.separation_error_expected >= 0;
        });
        if (c.run.realizations > 1 || last == levels.rend()) return;
        std::string first;
        if (last->separation_error_expected >= 0) {
            first = format("Z0 = %.6g %s +- %.2g %s", last->separation, l,
                           last->separation_error_expected, l);
        } else {
            // Where adhesion nearly balances N, the error is many times N: printed as a force.
            const double error = last->force_error_expected;
            first =
                format("N = %.4g %s +- ", last->force, f) +
                (error > 1 ? format("%.2g %s", error * std::abs(last->force), f) : percent(error));
        }
        const std::string area = last->area_error_expected >= 0
                                     ? format(", A = %.4g %s2 +- %s", last->area, l,
                                              percent(last->area_error_expected).c_str())
                                     : "";
        out << format("level %td: %s%s: bounds valid in nine of ten cases\n", levels.rend() - last,
                      first.c_str(), area.c_str());
    }

    // The summary of plastic contacts for cases with hardness, of what is worn off, and of the
    // energy lost in bodies that relax.
    void print_changes() const {
        if (relaxes(c) && !levels.empty() && c.run.realizations == 1)
            out << format(
                "  %.4g %s %s of the work done are lost by relaxation. Results depend on the "
                "loading history.\n",
                levels.back().energy_lost, f, l);
        if (wears(c) && !levels.empty() && c.run.realizations == 1) {
            const LevelValues& last = levels.back();
            out << format(
                "  %.4g %s3 are worn off, up to %.4g %s deep, and the surface has the rms height "
                "%.4g "
                "%s. Results depend on the loading history.\n",
                last.worn_volume, l, last.wear_depth_max, l, last.worn_rms, l);
        }
        if (!yields(c) || levels.empty()) return;
        const auto most =
            std::ranges::max_element(levels, [](const LevelValues& p, const LevelValues& q) {
                return p.plastic_contacts < q.plastic_contacts;
            });
        if (most->plastic_contacts == 0) {
            out << "  no contact yields: pressures stay below the hardness.\n";
            return;
        }
        out << format("  level %td, %s: %d of %d contacts yield", most - levels.begin() + 1,
                      place_of(*most).c_str(), most->plastic_contacts, most->contacts);
        double lost = 0;
        for (const LevelValues& level : levels)
            lost = std::max(lost, level.plastic_work);  // NaN if a level did not converge
        if (c.run.realizations == 1) out << format("; plastic work %.4g %s %s", lost, f, l);
        out << ". Results depend on the loading history.\n";
    }

    // The range of attraction up to which JKR is valid.
    void print_tabor() const {
        // JKR holds from a Tabor parameter of 5 on.
        const auto reach = [&](double radius) {
            return std::cbrt(radius * std::pow(c.solids.adhesion / job.indenter.E_star, 2));
        };
        double summit = kNotComputed;
        if (job.theory)
            summit = 0.737 / std::sqrt(job.theory->m4);
        else if (job.given && job.given->asperities.size() > 0) {
            summit = 0;
            for (double r : job.given->asperities.radius)
                summit += r / double(job.given->asperities.radius.size());
        }
        const double R = job.indenter.shape->hertz_radius(), range = c.solids.adhesion_range;
        if (summit > 0 && range > 0)
            out << format(
                "  Tabor's parameter (JKR from 5 on, DMT below 0.1): %.3g for summits of mean "
                "radius "
                "(%.3g %s)",
                reach(summit) / range, summit, l);
        else if (summit > 0)
            out << format(
                "  JKR (adhesion_range = 0) is valid for summits of mean radius (%.3g %s) if the "
                "range "
                "of the attraction is at most %.3g %s (Tabor's parameter 5)",
                summit, l, reach(summit) / 5, l);
        if (summit > 0 && std::isfinite(R))
            out << (range > 0 ? format("; %.3g for a smooth sphere", reach(R) / range)
                              : format("; for a smooth sphere at most %.3g %s", reach(R) / 5, l));
        if (summit > 0) out << ".\n";
    }

    // Whether two flats with this surface would stick.
    void print_stickiness() const {
        const double range = c.solids.adhesion_range;
        if (!(job.theory && range > 0) || job.indenter.layers.count > 0) return;
        // Pastewka and Robbins, PNAS 111, 3298 (2014), with kappa_rep = 2, d_rep = 4 h'/h'': h'
        // range/(2 l_a) (h'^2/(h'' range))^(2/3) < pi (3/16)^(2/3), l_a = w/E*, rms slope h', rms
        // curvature h'' (rms of the sum of both second derivatives).
        const double slope = std::sqrt(2 * job.theory->m2),
                     curvature = std::sqrt(8.0 / 3 * job.theory->m4);
        const double needed = 1 / (2 * 1.03) * job.indenter.E_star * slope * range *
                              std::pow(slope * slope / (curvature * range), 2.0 / 3);
        out << format(
            "  two flats with this surface %s (Pastewka and Robbins 2014): it needs w above about "
            "%.2g "
            "%s/%s.\n",
            c.solids.adhesion > needed ? "would stick" : "would not stick", needed, f,
            units_of(job).length);
    }

    // The summary of a run with adhesion.
    void print_sticking() const {
        if (!attracts(c) || levels.empty()) return;
        long jumps = 0;
        double lost = 0, least = 0, attracting = 0;
        for (const LevelValues& level : levels) {
            attracting = std::fmax(attracting, level.area + level.cohesive_area);
            jumps += level.jumps;
            lost = std::fmax(lost, level.energy_lost);
            least = std::fmin(least, level.least_force);
        }
        std::string how;
        if (by_elements(c))
            how = format(" (steps that lose less than %.1g count as reversible)",
                         kAdhesiveLossShare * c.solids.adhesion * attracting);
        const bool without_state = std::ranges::any_of(
            levels, [](const LevelValues& level) { return std::isnan(level.force); });
        if (c.run.realizations == 1 && without_state)
            out << "  adhesion: the smallest force is not known, because levels have no state.\n";
        else if (c.run.realizations == 1)
            out << format(
                "  adhesion: the smallest force is %.4g %s; jumps: %ld, energy lost: %.4g %s %s%s. "
                "Results depend on the loading history.\n",
                least, f, jumps, lost, f, l, how.c_str());
        print_tabor();
        print_stickiness();
    }

    // Effects that the model of this case neglects.
    void print_words() const {
        constexpr double much_coupling = 0.05;
        if (c.solids.friction > 0 && std::abs(coupling(c.solids)) > much_coupling)
            out << format(
                "  friction between unlike bodies: the coupling of pressure and tangential "
                "displacement (Dundurs' beta = %.2f) is neglected in the tangential "
                "forces.\n",
                coupling(c.solids));
        if (elements) return;
        if (c.indentation.selection == Selection::paper && c.indentation.selection_factor < 1.5)
            out << format(
                "  selection = 'paper' with a factor of %g excludes asperities that touch: N may "
                "be "
                "too low by more than half; 'overlap' includes "
                "all of them.\n",
                c.indentation.selection_factor);
    }
};

}  // namespace

void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    Remarks{out, levels, job}.print();
}

void tell_unreached_heights(std::ostream& out, std::span<const SurfaceStatistics> surfaces,
                            const Job& job) {
    if (!job.spectrum || job.spectrum->gaussian()) return;
    constexpr double near_skewness = 0.02, near_kurtosis = 0.05;
    const HeightShape wish =
        job.spectrum->heights ? job.spectrum->heights->shape() : job.spectrum->shape;
    HeightShape mean{0, 0};
    const double all = double(surfaces.size());
    long missed = 0;
    for (const SurfaceStatistics& s : surfaces) {
        mean.skewness += s.skewness / all;
        mean.kurtosis += s.kurtosis / all;
        missed += std::abs(s.skewness - wish.skewness) > near_skewness ||
                  std::abs(s.kurtosis - wish.kurtosis) > near_kurtosis;
    }
    if (missed > 0)
        out << format(
            "  %ld of %zu surfaces miss skewness %.3f or kurtosis %.3f by more than %g or %g, "
            "because few waves carry the heights; "
            "means %.3f and %.3f.\n",
            missed, surfaces.size(), wish.skewness, wish.kurtosis, near_skewness, near_kurtosis,
            mean.skewness, mean.kurtosis);
}

const char* slope_remark(double rms_slope) {
    if (rms_slope <= 0.5) return "";
    if (rms_slope <= 2)
        return " - above 0.5 the theory of small slopes is inaccurate: use ratios and trends of "
               "N(Z0), A(N) and stiffness to compare surfaces; "
               "absolute areas and pressures (some 0.4 E* in a contact) are not those of a real "
               "body";
    return " - above 2 the theory of small slopes is not valid: use results only to compare runs "
           "of the model and to reproduce "
           "the paper (4.7 there); loads, areas and pressures are not those of a real body";
}

}  // namespace rsc
