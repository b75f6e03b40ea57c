// Remarks after the levels: methods, statuses with their meaning and remedy, expected errors,
// warnings.

#include "asperities/touching.hpp"
#include "base/format.hpp"
#include "run/screen.hpp"
#include "trust/expected_error.hpp"
#include "trust/resolution.hpp"
#include "trust/validity.hpp"

namespace rsc {
namespace {

void print_methods(std::ostream& out, std::span<const LevelValues> levels) {
    std::map<std::pair<Method, Fallback>, long> counts;
    for (const LevelValues& level : levels) ++counts[{level.method, level.fallback}];
    out << "method:";
    const char* before = " ";
    for (const auto& [how, count] : counts) {
        out << before << name_of(how.first) << " (" << count << " levels"
            << (how.second == Fallback::none ? "" : ": ") << fallback_text(how.second) << ")";
        before = ", ";
    }
    out << '\n';
}

void print_statuses(std::ostream& out, std::span<const LevelValues> levels, const Job& job,
                    bool elements) {
    const double sigma = job.sigma;
    const std::string remedy = job.spectrum ? format("use elements%%points_per_wave = %g.",
                                                     2 * job.settings.elements.points_per_wave)
                                            : "the map has too few points for its contacts.";
    const auto count = [&](auto holds) {
        return static_cast<long>(std::count_if(levels.begin(), levels.end(), holds));
    };
    const auto tell = [&](long found, const std::string& what) {
        if (found > 0) out << format("  %ld of %zu levels: ", found, levels.size()) << what << '\n';
    };
    const auto tell_status = [&](LevelStatus status, const char* meaning) {
        tell(count([status](const LevelValues& l) { return l.status == status; }),
             status_text(status) + " - " + meaning);
    };
    // Reasons for status out_of_validity, reported also if a more serious status overrides it.
    tell(count([](const LevelValues& l) { return l.edge_contacts > 0; }),
         "contacts, or their attraction, within <d> of the border of the surface - what lies "
         "beyond it is missing: |N| is too small.");
    tell(count([](const LevelValues& l) { return l.filled_share > kMuchFilled; }),
         "more than 1 % of the contact area would be in holes of the map, which are filled "
         "smoothly (filled_share): N is too small.");
    if (std::isfinite(job.points_touch) &&
        std::all_of(levels.begin(), levels.end(), [](const auto& l) { return l.force == 0; }))
        out << format(
            "  no level reaches contact: the first point of the map touches at Z0 = %g (%g "
            "sigma).\n",
            job.points_touch, job.points_touch / sigma);
    if (elements) {
        double worst = 0;
        for (const LevelValues& l : levels)
            worst = std::max(worst, l.force_error_expected);  // ignores NaN
        const double much = job.settings.solids.adhesion > 0 ? kMuchError : kUnresolved;
        tell(count([much](const LevelValues& l) { return l.force_error_expected > much; }),
             format("a finer grid may change N by more than %s, in nine of ten cases %s "
                    "(force_error_expected); ",
                    percent(much).c_str(),
                    worst > 10 ? "by many times N"
                               : format("by less than %.3g %%", 100 * worst).c_str()) +
                 remedy);
        tell(count([](const LevelValues& l) {
                 return l.force == 0 && l.status == LevelStatus::out_of_validity;
             }),
             "the bodies touch between the points of the grid, so that N is not 0; " + remedy);
    }
    if (!elements) {
        tell(count([](const LevelValues& l) {
                 return l.force == 0 && l.status == LevelStatus::out_of_validity;
             }),
             "the surface may touch outside the summits of the model, so that N need not be 0; use "
             "solver%model = 'elements'" +
                 std::string(job.indenter.shape && job.indenter.shape->edge(HUGE_VAL) >= 0
                                 ? "."
                                 : " or law = 'fourth_order'."));
        const bool list = job.settings.surface.source == Source::asperities;
        double steepest = 0;
        for (const LevelValues& l : levels)
            steepest = std::max(steepest, std::isnan(l.slope_ratio) ? 0.0 : l.slope_ratio);
        if (list || job.settings.asperities.law == LawKind::hertz)
            tell(count([](const LevelValues& l) { return l.slope_ratio > kMostSlopeRatio; }),
                 format("at contacts the indenter is up to %.2g times as steep as the surface "
                        "(slope_ratio), and touches points other than the "
                        "summits of the surface; ",
                        steepest) +
                     (list ? "a list of asperities has no other points."
                           : "use asperities%law = 'elliptic' or 'fourth_order'."));
        tell(count([sigma](const LevelValues& l) {
                 return l.separation < kLowestSeparation * sigma;
             }),
             "separation below -3 sigma - the tip lies below 99.9 % of the heights: the asperity "
             "model is outside its range.");
        tell(count([](const LevelValues& l) { return exceeds_nominal_area(l); }),
             "contact area above the nominal area - the asperity model is outside its range.");
        std::map<std::int32_t, long> causes;
        for (const LevelValues& l : levels)
            causes[l.error_cause] += l.force_error_expected > kMuchError;
        for (const auto& [cause, found] : causes)
            tell(found,
                 "N may differ from elements by more than 10 % (force_error_expected)" +
                     (cause > 0 ? std::string(", mainly because of ") + error_cause(cause) : "") +
                     ".");
        tell(count([](const LevelValues& l) { return l.large_contacts > 0; }),
             "contacts with a > <d>/4, a quarter of the mean spacing of summits - the asperity "
             "model is near the limit of its range.");
    }
    double widest = 0;
    for (const LevelValues& l : levels) widest = std::max(widest, l.wide_contacts);
    tell(count([](const LevelValues& l) { return l.wide_contacts > 0; }),
         format("up to %.0f %% of the contacts have a > h/5, where h is the thickness of the top "
                "layer - elements have no such limit.",
                100 * widest));
    tell(count([](const LevelValues& l) { return l.beyond_law > 0; }),
         "contacts beyond the range of validity of the contact law (beyond_law in the file).");
    tell(count([](const LevelValues& l) {
             return std::isnan(l.stiffness) && l.contacts > 0 &&
                    l.status != LevelStatus::not_converged;
         }),
         std::string("stiffness, conductance and resistance are missing: ") +
             (elements ? "their iteration did not converge."
                       : "contacts overlap too much for them; use solver%model = 'elements'."));
    tell_status(LevelStatus::overlapping,
                "pairs of contact spots closer than the sum of their radii: spots that would merge "
                "are counted as two.");
    tell_status(LevelStatus::not_unique,
                "spots that overlap so much that other solutions may exist: this one is a local "
                "minimum of the energy, selected by a fixed rule.");
    const auto held = [](const LevelValues& l) { return l.fallback == Fallback::held; };
    tell(count(held),
         "no state has the force asked for: the level is the last stable one, that of the smallest "
         "force, where the bodies part under a dead "
         "load; give separations (indentation%control = 'separation') to go beyond.");
    const auto jump = [](const LevelValues& l) { return l.fallback == Fallback::jump; };
    tell(count(jump),
         status_text(LevelStatus::not_converged) +
             " - the force asked for is inside a jump of N(Z0), so that no separation has it. The "
             "level is a state at one side of "
             "the jump; prescribe separations there, or another force" +
             (elements ? "."
                       : "; solver%model = 'elements' has no such jumps between close contacts."));
    const auto failed = [&](const LevelValues& l) {
        return l.status == LevelStatus::not_converged && !held(l) && !jump(l);
    };
    const auto lost = [&](const LevelValues& l) {
        return failed(l) && !elements && job.settings.solids.adhesion > 0;
    };
    tell(count(lost), status_text(LevelStatus::not_converged) +
                          " - the path of the attached asperities could not be followed to these "
                          "levels, mostly because contacts overlap: "
                          "that is beyond the asperity model; use model = 'elements'.");
    tell(count([&](const LevelValues& l) { return failed(l) && !lost(l); }),
         status_text(LevelStatus::not_converged) +
             " - the residual is above solver%tolerance: do not use these values; " +
             (!elements && (!job.settings.solids.layer_thickness.empty() ||
                            job.settings.indentation.boundary == Boundary::periodic)
                  ? "with contacts wider than the top layer, or between flats pressed deep, the "
                    "asperity model may have no solution: use "
                    "solver%model = 'elements'."
              : elements && !job.settings.solids.relaxation_share.empty() &&
                      job.settings.indentation.boundary == Boundary::periodic
                  ? "bodies that relax may have closed the gap between flats; otherwise raise "
                    "solver%max_iterations or the tolerance."
                  : "raise solver%max_iterations or the tolerance."));
}

// "N = 1.23 N +- 5 %": the last level of a single run with its expected errors.
void print_bounds(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const auto last = std::find_if(levels.rbegin(), levels.rend(), [](const LevelValues& l) {
        return l.force_error_expected >= 0;
    });
    if (job.settings.run.realizations > 1 || last == levels.rend()) return;
    const char *l = job.settings.run.length_unit.c_str(), *f = job.settings.run.force_unit.c_str();
    const std::string area = last->area_error_expected >= 0
                                 ? format(", A = %.4g %s2 +- %s", last->area, l,
                                          percent(last->area_error_expected).c_str())
                                 : "";
    // Where adhesion nearly balances N, the error is many times N, and is printed as a force.
    const double error = last->force_error_expected;
    const std::string bound =
        error > 1 ? format("%.2g %s", error * std::abs(last->force), f) : percent(error);
    out << format("level %td: N = %.4g %s +- %s%s: bounds valid in nine of ten cases\n",
                  levels.rend() - last, last->force, f, bound.c_str(), area.c_str());
}

// The summary of plastic contacts for cases with hardness, and of the energy lost in bodies that
// relax.
void print_yielding(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    if (relaxes(job.settings) && !levels.empty() && job.settings.run.realizations == 1)
        out << format(
            "  %.4g %s %s of the work done are lost by relaxation. Levels depend on the levels "
            "before.\n",
            levels.back().energy_lost, job.settings.run.force_unit.c_str(),
            job.settings.run.length_unit.c_str());
    if (!std::isfinite(job.settings.solids.hardness) || levels.empty()) return;
    const auto most = std::max_element(levels.begin(), levels.end(),
                                       [](const LevelValues& p, const LevelValues& q) {
                                           return p.plastic_contacts < q.plastic_contacts;
                                       });
    if (most->plastic_contacts == 0) {
        out << "  no contact yields: pressures stay below the hardness.\n";
        return;
    }
    out << format("  at Z0/sigma = %.4g, %d of %d contacts yield", most->separation / job.sigma,
                  most->plastic_contacts, most->contacts);
    double lost = 0;
    for (const LevelValues& level : levels)
        lost = std::max(lost, level.plastic_work);  // NaN if a level did not converge
    if (job.settings.run.realizations == 1)
        out << format("; plastic work %.4g %s %s", lost, job.settings.run.force_unit.c_str(),
                      job.settings.run.length_unit.c_str());
    out << ". Levels depend on the levels before.\n";
}

// The summary of a run with adhesion, and the range of attraction up to which JKR is valid.
void print_sticking(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const Case& c = job.settings;
    if (!(c.solids.adhesion > 0) || levels.empty()) return;
    const char *l = c.run.length_unit.c_str(), *f = c.run.force_unit.c_str();
    long jumps = 0;
    double lost = 0, least = 0, attracting = 0;
    for (const LevelValues& level : levels)
        attracting = std::fmax(attracting, level.area + level.cohesive_area), jumps += level.jumps,
        lost = std::fmax(lost, level.energy_lost), least = std::fmin(least, level.least_force);
    // of the work of adhesion: some steps, each divided at 0.003
    // (physics/adhesion/adhesive_pixels.cpp)
    constexpr double resolved = 0.01;
    std::string how;
    if (by_elements(c))
        how = c.indentation.control == Control::separation
                  ? format(" (below %.1g not resolved)", resolved * c.solids.adhesion * attracting)
                  : " (trapezoidal rule over the levels)";
    const bool without_state = std::ranges::any_of(
        levels, [](const LevelValues& level) { return std::isnan(level.force); });
    if (c.run.realizations == 1 && without_state)
        out << "  adhesion: the smallest force is not known, because levels have no state.\n";
    else if (c.run.realizations == 1)
        out << format(
            "  adhesion: the smallest force is %.4g %s; jumps: %ld, energy lost: %.4g %s %s%s. "
            "Levels depend on the levels before.\n",
            least, f, jumps, lost, f, l, how.c_str());
    if (const double fine = levels.back().cohesive_resolution; fine < 2)
        out << format(
            "  adhesion_range is %.2g pixel sides (cohesive_resolution): below 2 the pull-off "
            "force is about 5 to 10 %% too high.\n",
            fine);
    // The length in which the traction acts at an edge of a contact, E* z0^2/w, in pixel sides
    // (measured: test/README).
    if (const double zone = levels.back().cohesive_resolution * job.indenter.E_star *
                            c.solids.adhesion_range / c.solids.adhesion;
        zone < 8)
        out << format(
            "  adhesion acts across %.2g pixel sides at edges of contact, E* "
            "adhesion_range^2/adhesion: below 8 the pull-off force may be more "
            "than 10 %% too high, and edges that advance lag behind.\n",
            zone);
    // Tabor's parameter is this length over the range of the attraction; JKR holds from 5 on.
    const auto reach = [&](double radius) {
        return std::cbrt(radius * std::pow(c.solids.adhesion / job.indenter.E_star, 2));
    };
    double summit = kNotComputed;
    if (job.theory)
        summit = 0.737 / std::sqrt(job.theory->m4);
    else if (job.given && job.given->asperities.size() > 0) {
        summit = 0;
        for (double r : job.given->asperities.radius)
            summit += r / static_cast<double>(job.given->asperities.radius.size());
    }
    const double R = job.indenter.shape->hertz_radius(), range = c.solids.adhesion_range;
    if (summit > 0 && range > 0)
        out << format(
            "  Tabor's parameter (JKR from 5 on, DMT below 0.1): %.3g for summits of mean radius "
            "(%.3g %s)",
            reach(summit) / range, summit, l);
    else if (summit > 0)
        out << format(
            "  JKR (adhesion_range = 0) is valid for summits of mean radius (%.3g %s) if the range "
            "of the attraction is at most %.3g %s "
            "(Tabor's parameter 5)",
            summit, l, reach(summit) / 5, l);
    if (summit > 0 && std::isfinite(R))
        out << (range > 0 ? format("; %.3g for a smooth sphere", reach(R) / range)
                          : format("; for a smooth sphere at most %.3g %s", reach(R) / 5, l));
    if (summit > 0) out << ".\n";
    if (!(job.theory && range > 0) || job.indenter.layers.count > 0) return;
    // Pastewka and Robbins, PNAS 111, 3298 (2014), with kappa_rep = 2, d_rep = 4 h'/h'': h'
    // range/(2 l_a) (h'^2/(h'' range))^(2/3) < pi (3/16)^(2/3), l_a = w/E*, rms slope h', rms
    // curvature h'' (rms of the sum of both second derivatives).
    const double slope = std::sqrt(2 * job.theory->m2),
                 curvature = std::sqrt(8.0 / 3 * job.theory->m4);
    const double needed = 1 / (2 * 1.03) * job.indenter.E_star * slope * range *
                          std::pow(slope * slope / (curvature * range), 2.0 / 3);
    out << format(
        "  two flats with this surface %s (Pastewka and Robbins 2014): it needs w above about %.2g "
        "%s/%s.\n",
        c.solids.adhesion > needed ? "would stick" : "would not stick", needed, f, l);
}

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

// Effects that the model of this case neglects.
void print_words(std::ostream& out, const Job& job, bool elements) {
    const Case& c = job.settings;
    constexpr double much_coupling = 0.05, least_points = 5;
    if (c.solids.friction > 0 && std::abs(coupling(c.solids)) > much_coupling)
        out << format(
            "  friction between unlike bodies: the coupling of pressure and tangential "
            "displacement (Dundurs' beta = %.2f) is neglected in the tangential "
            "forces.\n",
            coupling(c.solids));
    if (elements) return;
    const double points = job.spectrum   ? c.surface.n / job.spectrum->L_lambda_s
                          : job.measured ? job.measured->points_per_wave()
                                         : least_points;
    if (c.asperities.law == LawKind::hertz && points < least_points)
        out << format(
            "  law 'hertz' on %.2g points in the shortest wave: summits between the points are "
            "missed, N is too low near first contact (by half "
            "at 3 points); use 5 or more, or law 'fourth_order'.\n",
            points);
    if (c.indentation.selection == Selection::paper && c.indentation.selection_factor < 1.5)
        out << format(
            "  selection = 'paper' with a factor of %g excludes asperities that touch: N may be "
            "too low by more than half; 'overlap' includes "
            "all of them.\n",
            c.indentation.selection_factor);
}

}  // namespace

void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const bool elements = by_elements(job.settings);
    if (!elements) print_methods(out, levels);
    print_bounds(out, levels, job);
    print_statuses(out, levels, job, elements);
    const auto extreme = std::max_element(
        levels.begin(), levels.end(), [](const LevelValues& p, const LevelValues& q) {
            return p.extreme_area_fraction < q.extreme_area_fraction;
        });
    // the hardness of hardened steel; softer bodies bear E*/10
    constexpr double kHardest = 5e9;  // [Pa]
    if (job.indenter.E_star / 10 * pascals(job.settings) > kHardest &&
        !std::isfinite(job.settings.solids.hardness) && !relaxes(job.settings) &&
        extreme != levels.end() && extreme->extreme_area_fraction > kExtremeShare)
        out << format(
            "  pressures above E*/10 on %.0f %% of the contact area at Z0/sigma = %.4g: no metal "
            "stays elastic at such pressures; solids%%hardness "
            "limits them.\n",
            100 * extreme->extreme_area_fraction, extreme->separation / job.sigma);
    print_yielding(out, levels, job);
    print_sticking(out, levels, job);
    print_words(out, job, elements);
    std::int64_t crowded = 0;
    for (const LevelValues& level : levels) crowded += level.crowded_cells;
    if (crowded > 0 && !elements)
        out << "  " << crowded
            << " map cells (over all levels) have an area fraction above pi/16 = 19.6 %, where "
               "contacts would merge.\n";
}

void tell_unreached_heights(std::ostream& out, std::span<const SurfaceStatistics> surfaces,
                            const Job& job) {
    if (!job.spectrum || job.spectrum->gaussian()) return;
    constexpr double near_skewness = 0.02, near_kurtosis = 0.05;
    const HeightShape wish =
        job.spectrum->heights ? job.spectrum->heights->shape() : job.spectrum->shape;
    HeightShape mean{0, 0};
    const double all = static_cast<double>(surfaces.size());
    long missed = 0;
    for (const SurfaceStatistics& s : surfaces) {
        mean.skewness += s.skewness / all, mean.kurtosis += s.kurtosis / all;
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
