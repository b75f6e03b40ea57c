// Remarks after the levels: methods, statuses with their meaning and remedy, expected errors,
// warnings.

#include "asperities/shifted_summits.hpp"
#include "base/format.hpp"
#include "physics/physics.hpp"
#include "run/screen.hpp"
#include "trust/judge.hpp"

namespace rsc {
namespace {

struct Remarks {
    std::ostream& out;
    std::span<const LevelValues> levels;
    const Job& job;
    std::span<const double> curves;
    const Case& c = job.settings;
    bool elements = by_elements(c);
    const char *l = c.run.length_unit.c_str(), *f = c.run.force_unit.c_str();

    void print() const {
        if (!elements) print_methods();
        print_bounds();
        print_statuses();
        print_pressures();
        print_physics();
        print_words();
        std::int64_t crowded = 0;
        for (const LevelValues& level : levels) crowded += level.crowded_cells;
        if (crowded > 0 && !elements)
            out << "  " << crowded
                << " map cells (over all levels) have an area fraction above pi/16 = 19.6 %, where "
                   "contacts would merge.\n";
    }

    // Elastic levels whose pressures a metal, glass or ceramic would not bear. The strongest yield
    // at a strain of about 1 %, and an indented body at about three times its yield stress. Softer
    // bodies, polymers and rubbers, bear larger strains.
    void print_pressures() const {
        constexpr double kSoft = 10e9;  // Young's modulus [Pa]
        constexpr double kYieldStrain = 0.01, kConstraint = 3;
        double E = kInfinity;
        for (const double of_body : c.solids.E)
            if (of_body * pascals(c) > kSoft) E = std::min(E, of_body);
        double p = 0;
        const LevelValues* most = nullptr;
        for (const LevelValues& level : levels)
            if (level.converged && level.pressure_max > p) {
                p = level.pressure_max;
                most = &level;
            }
        const double bears = kConstraint * kYieldStrain * E;
        if (!(p > bears) || any_physics(c, &Physics::mends_extreme_pressures)) return;
        out << format("  elastic pressures reach %.4g %s/%s2 (%s)", p, f, l,
                      place_of(*most).c_str());
        if (const double share = most->extreme_area_fraction; share > kExtremeShare)
            out << format(", and are above E*/10 on %.0f %% of the contact area", 100 * share);
        out << format(
            ": more than a body of E = %g %s/%s2 bears, which yields at some %.0f %s/%s2 at the "
            "latest (three times a yield stress of E/100); give solids%%hardness.\n",
            E, f, l, bears, f, l);
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
        if (c.run.realizations > 1) return format("N = %.4g %s", level.force, f);
        return format("level %td, N = %.4g %s", &level - levels.data() + 1, level.force, f);
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

    static double error_of_force(const LevelValues& l) {
        if (l.force_error_expected >= 0) return l.force_error_expected;
        if (l.plastic_contacts > 0)  // the stiffness is that of unloading
            return l.errors[find_quantity("force")->quantity->slot];
        return l.separation_error_expected * std::abs(l.stiffness) / std::abs(l.force);
    }

    // The largest value of the levels with a doubt; 0: none is known.
    template <class Value>
    double largest(Cause cause, Value&& value) const {
        double most = 0;
        for (const LevelValues& l : levels)
            if (l.doubts & bit(cause)) most = std::fmax(most, value(l));
        return most;
    }

    // The quantity from which a doubt follows, and its worst value over the levels.
    std::string figure_of(Cause cause) const {
        const auto up_to = [&](const char* what, auto value, bool share = true) {
            const double most = largest(cause, value);
            const std::string figure = share ? percent(most) : format("%.3g", most);
            return most > 0 ? std::string(" (") + what + " up to " + figure + ")" : "";
        };
        const auto area = [](const LevelValues& l) { return l.area_error_expected; };
        switch (cause) {
            case Cause::grid: {
                const double N = largest(cause, error_of_force), A = largest(cause, area);
                return A > 0 ? " (errors at a given separation up to: N " + percent(N) + ", A " +
                                   percent(A) + ")"
                             : up_to("error of N", error_of_force);
            }
            case Cause::model_error: return up_to("error of N", error_of_force);
            case Cause::filled_points:
                return up_to("filled_share", [](auto& l) { return l.filled_share; });
            case Cause::sliding_steps:
                return up_to("sliding_error", [](auto& l) { return l.sliding_error; });
            case Cause::layer:
                return up_to("wide_contacts", [](auto& l) { return l.wide_contacts; });
            case Cause::slope_ratio:
                return up_to(
                    "slope_ratio", [](auto& l) { return l.slope_ratio; }, false);
            case Cause::steep_indenter:
                return up_to(
                    "indenter_slope", [](auto& l) { return l.indenter_slope; }, false);
            case Cause::border:
                return up_to(
                    "edge_contacts", [](auto& l) { return l.edge_contacts; }, false);
            case Cause::range:
                return format(
                    " (cohesive_resolution down to %.3g)",
                    4 / largest(cause, [](auto& l) { return 4 / l.cohesive_resolution; }));
            default: return "";
        }
    }

    // How many times as many points remove the doubt: errors fall at least in proportion to the
    // side of a pixel.
    std::string finer_by(double times, const char* otherwise) const {
        if (!job.spectrum) return otherwise;
        const double points = std::ceil(1.05 * times * c.elements.points_per_wave);
        constexpr double kMost = 64;  // elements%points_per_wave
        if (!(points <= kMost)) return "; press harder, or accept the stated error";
        Case finer = c;
        finer.elements.points_per_wave = points;
        return format("; use elements%%points_per_wave = %g", points) +
               (too_large_for_elements(finer, *job.spectrum).empty()
                    ? ""
                    : ", which is more than this machine can hold: press harder, or accept the "
                      "stated error");
    }

    std::string remedy_of_elements(Cause cause) const {
        switch (cause) {
            case Cause::grid:
                return finer_by(
                    largest(cause,
                            [](const LevelValues& l) {
                                return std::max({1.0, error_of_force(l) / kMuchForceError,
                                                 l.area_error_expected / kMuchAreaError});
                            }),
                    "; only a map with smaller steps, or a harder pressed contact, removes this");
            case Cause::missed_contact:
                return finer_by(2,
                                "; a map with smaller steps, or a smaller separation, removes it");
            case Cause::range:
                return finer_by(largest(cause, [](auto& l) { return 4 / l.cohesive_resolution; }),
                                "; only a map with smaller steps removes this") +
                       " or a larger adhesion_range";
            case Cause::sliding_steps: return "; give closer distances";
            default: return "";
        }
    }

    // Advice where the surface is known beyond a list of asperities, so that elements can solve it.
    std::string to_elements(const char* reason = " solves the surface itself") const {
        if (c.surface.source == Source::asperities) return "";
        std::string advice = "; solver%model = 'elements'";
        for (const Physics* p : physics_asked(c))
            if (p->for_elements) advice += p->for_elements(c);
        return advice + reason;
    }

    std::string remedy_of(Cause cause) const {
        if (cause == Cause::filled_points)
            return "; only a map without holes there, or another centre, removes this";
        if (cause == Cause::border)
            return job.spectrum ? "; enlarge surface%L"
                                : "; only a larger map, or a lighter load, removes this";
        if (cause == Cause::steep_indenter) return "";
        return elements ? remedy_of_elements(cause) : to_elements();
    }

    void print_doubts() const {
        for (const auto k : indices(kCauseNames)) {
            const Cause cause{int(k)};
            const auto has = [&](const LevelValues& l) { return (l.doubts & bit(cause)) != 0; };
            if (std::ranges::none_of(levels, has)) continue;
            say(has, words_of_doubts(bit(cause)) + " - " + sentence(cause, elements) +
                         figure_of(cause) + remedy_of(cause));
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
        if (!elements && any_physics(c, &Physics::pulls))
            remedy = "contacts overlap too much to follow their path" + to_elements();
        else if (!elements && (!c.solids.layer_thickness.empty() || flats))
            remedy =
                "with contacts wider than the top layer, or between flats pressed deep, the "
                "asperity model may have no solution" +
                to_elements();
        for (const Physics* p : physics_asked(c))
            if (elements && flats && p->may_close_gap)
                remedy = joined(p->may_close_gap, "; otherwise ", remedy);
        say(failed,
            failure + "the residual is above solver%tolerance: do not use these values; " + remedy);
    }

    std::string why_no_stiffness() const {
        if (!elements) return "contacts overlap too much for them" + to_elements();
        constexpr double kFull = 1 - 1e-12;  // A/A0
        const bool closed = std::ranges::all_of(levels, [](const LevelValues& l) {
            return !(std::isnan(l.stiffness) && l.contacts > 0) || l.area_fraction > kFull;
        });
        return closed ? "the gap between two flats is closed" : "their iteration did not converge";
    }

    void print_statuses() const {
        print_doubts();
        say(
            [](const LevelValues& l) {
                return std::isnan(l.stiffness) && l.contacts > 0 && l.converged;
            },
            std::string("stiffness, conductance and resistance are missing: ") +
                why_no_stiffness());
        say([](const LevelValues& l) { return l.status == LevelStatus::overlapping; },
            "overlapping - pairs of contact spots closer than the sum of their radii: "
            "spots that would merge are counted as two");
        say([](const LevelValues& l) { return l.status == LevelStatus::not_unique; },
            "not unique - spots that overlap so much that other solutions may exist: this "
            "one is a local minimum of the energy, selected by a fixed rule");
        print_failures();
    }

    std::string unit_after(const LevelQuantity& q) const {
        const std::string unit = q.unit_in(l, f, c.run.time_unit);
        return unit == "1" ? "" : " " + unit;
    }

    // "N = 1.23 N +- 5 %": the last level of a single run that has expected errors; under a
    // prescribed force the separation instead of N.
    void print_bounds() const {
        const auto last = std::find_if(levels.rbegin(), levels.rend(), [](const LevelValues& l) {
            return l.force_error_expected >= 0 || l.area_error_expected >= 0;
        });
        if (c.run.realizations > 1 || last == levels.rend()) return;
        std::string text;
        if (last->separation_error_expected >= 0) {
            text = format("Z0 = %.6g %s +- %.2g %s", last->separation, l,
                          last->separation_error_expected, l);
        } else if (const double error = last->force_error_expected; error >= 0) {
            // Where adhesion nearly balances N, the error is many times N: printed as a force.
            text =
                format("N = %.4g %s +- ", last->force, f) +
                (error > 1 ? format("%.2g %s", error * std::abs(last->force), f) : percent(error));
        }
        if (last->area_error_expected >= 0)
            enlist(text, ", ", format("A = %.4g %s2 +- ", last->area, l),
                   percent(last->area_error_expected));
        // What the case asks for beyond N and A.
        for (const LevelQuantity& q : level_quantities())
            if (const double error = q.error(*last), value = q.of(*last);
                q.answers && error > 0 && std::abs(value) > 0)
                enlist(text, ", ", q.plain, format(" = %.4g", value), unit_after(q), " +- ",
                       percent(error));
        out << format("level %td: ", levels.rend() - last) << text
            << ": bounds valid in nine of ten cases\n";
    }

    // What the physics of the case say of the levels.
    void print_physics() const {
        double summit = kNotComputed;  // mean radius
        if (job.theory) {
            summit = 0.737 / std::sqrt(job.theory->m4);
        } else if (job.given && job.given->asperities.size() > 0) {
            const std::vector<double>& radii = job.given->asperities.radius;
            summit = sum_of(radii) / double(radii.size());
        }
        RunFacts run{c,
                     levels,
                     job.indenter,
                     job.theory,
                     summit,
                     elements,
                     [this](const LevelValues& l) { return place_of(l); },
                     {},
                     {}};
        std::span<const double> last =
            curves.last(std::min(curves.size(), values_of(job.observe.curves)));
        for (const Physics* p : physics_asked(c)) {
            run.axis = run.curves = {};
            for (const AskedCurves& asked : job.observe.curves)
                if (asked.physics == p && !last.empty()) {
                    run.axis = asked.axis.values;
                    run.curves = last.first(asked.values());
                    last = last.subspan(asked.values());
                }
            if (p->remark) p->remark(out, run);
        }
    }

    // Effects that the model of this case neglects.
    void print_words() const {
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

void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job,
                   std::span<const double> curves) {
    Remarks{out, levels, job, curves}.print();
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
