#include "run/screen.hpp"

#include <unistd.h>

#include "case/units.hpp"
#include "contact/expected_error.hpp"
#include "contact/touching.hpp"
#include "contact/validity.hpp"
#include "format.hpp"
#include "observe/quantities.hpp"
#include "observe/regimes.hpp"
#include "run/resolution.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

const char* fallback_text(Fallback fallback) {
    switch (fallback) {
        case Fallback::none: return "";
        case Fallback::no_interaction: return "there is no interaction";
        case Fallback::dgesv_not_converged: return "dgesv did not converge";
        case Fallback::dgesv_singular: return "dgesv's matrix was singular";
        case Fallback::not_unique: return "dgesv's solution is not proved unique";
        case Fallback::jump: return "the force jumps over this one";
        case Fallback::held: return "no state has this force; level of the smallest force";
    }
    return "";
}

const char* name_of(Method method) { return kMethodNames[static_cast<std::size_t>(method)]; }
// Columns that only two flats have are shown for two flats only.
bool shown(const LevelQuantity& q, const Job& job) {
    return q.heading && (q.always || (q.of_step ? !job.times.empty() : job.indenter.period.finite()));
}

}  // namespace

std::string percent(double share) { return format(std::abs(share) < 0.995 ? "%.2g %%" : "%.0f %%", 100 * share); }

std::string status_text(LevelStatus status) {
    std::string text = kLevelStatusNames[static_cast<std::size_t>(status)];
    for (char& c : text) {
        if (c == '_') c = ' ';
        if (status == LevelStatus::not_converged) c = static_cast<char>(std::toupper(c));
    }
    return text;
}

void print_case(std::ostream& out, const Job& job) {
    const auto& run = job.settings.run;
    const char* l = run.length_unit.c_str();
    const char* f = run.force_unit.c_str();
    if (!run.title.empty()) out << run.title << '\n';
    if (const Period& period = job.indenter.period; period.finite())
        out << format("two flats, a rough half-space that repeats every %g x %g %s, E* = %g %s/%s2, sigma = %g %s\n", period.x, period.y, l,
                      job.indenter.E_star, f, l, job.sigma, l);
    else
        out << job.indenter.shape->text(l)
            << format(" on a rough half-space, E* = %g %s/%s2, sigma = %g %s\n", job.indenter.E_star, f, l, job.sigma, l);
    if (job.settings.solver.model == Model::automatic) {
        const ModelChoice choice = model_of(job.settings);
        out << format("by %s: %s (solver%%model = 'auto')\n", kModelNames[static_cast<std::size_t>(choice.model)], choice.why);
    }
    if (job.theory) {
        const Moments& m = *job.theory;
        out << format("theory: rms slope %.4g, Nayak parameter %.4g, summit density %.5g 1/%s2, r_g %.4g %s, transition force N* %.5g %s\n",
                      m.rms_slope(), m.nayak(), m.summit_density(), l, m.mean_radius(), l, transition_force(m, job.indenter.E_star), f);
    }
}

// The treatment of a measured map, or of the first of several maps.
void print_measured(std::ostream& out, const Job& job) {
    if (!job.measured) return;
    if (!job.given) out << "the first of the maps:\n";
    for (const std::string& line : report(*job.measured, job.settings.run.length_unit)) out << line << '\n';
    constexpr double most = 3;
    if (job.seam > most)
        out << format(
            "warning: the map is not periodic: heights jump across its border %.2g times as much as between neighbouring points; contacts at "
            "the border are artefacts\n",
            job.seam);
}

// A second rough body: the treatment of its map, and a note if it is interpolated.
void print_second(std::ostream& out, const Job& job) {
    const ShapeKeys& keys = job.indenter.shape->keys();
    if (!keys.map) return;
    for (const std::string& line : keys.told) out << "body 2: " << line << '\n';
    const HeightMap& map = *keys.map;
    const Domain& d = job.domain;
    double dx = job.measured ? job.measured->dx : 0, dy = job.measured ? job.measured->dy : 0;
    if (job.spectrum && by_elements(job.settings)) dx = dy = d.Lx / element_points(job.settings, *job.spectrum);
    const auto between = [](double step, double steps_of_2, int points, double tip, double first) {
        const double at = (first - tip) / steps_of_2 + 0.5 * (points - 1);
        return !(std::abs(step / steps_of_2 - 1) <= 1e-9) || std::abs(at - std::round(at)) > 1e-6;
    };
    if (!between(dx, map.dx, map.nx, job.indenter.x0, d.x0) && !between(dy, map.dy, map.ny, job.indenter.y0, d.y0)) return;
    const char* l = job.settings.run.length_unit.c_str();
    out << format("body 2 is interpolated between its points, at a spacing of %g x %g %s", map.dx, map.dy, l);
    if (dx > 0) out << format("; the spacing of body 1 is %g x %g %s", dx, dy, l);
    out << (dx > 1.000001 * map.dx || dy > 1.000001 * map.dy ? ", which is coarser, so that details of body 2 are missed\n" : "\n");
}

// The columns after the first three are quantities of observe/quantities.hpp.
void print_heading(std::ostream& out, const Job& job) {
    print_case(out, job);
    print_measured(out, job);
    print_second(out, job);
    const std::string l = job.settings.run.length_unit, f = job.settings.run.force_unit;
    out << format("\n%5s %12s %9s", "level", format("Z0 [%s]", l.c_str()).c_str(), "Z0/sigma");
    for (const LevelQuantity& q : level_quantities()) {
        if (!shown(q, job)) continue;
        std::string heading = q.heading;
        if (q.length_power != 0 || q.force_power != 0) heading += " [" + unit_of(l, q.length_power, f, q.force_power) + "]";
        if (q.of_step) heading += " [" + job.settings.run.time_unit + "]";
        out << format(" %*s", q.width, heading.c_str());
    }
    out << '\n';
}

void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level) {
    out << format("%5zu %12.6g %9.5f", number + 1, level.separation, level.separation / job.sigma);
    for (const LevelQuantity& q : level_quantities()) {
        if (!shown(q, job)) continue;
        if (std::holds_alternative<LevelStatus LevelValues::*>(q.member))
            out << "  " << status_text(level.status)
                << (level.fallback == Fallback::none ? ""
                                                     : std::string(", ") + name_of(level.method) + ": " + fallback_text(level.fallback));
        else if (q.integer())
            out << format(" %*.0f", q.width, q.of(level));
        else if (q.digits > 0)
            out << format(" %*.*g", q.width, q.digits, q.of(level));
        else
            out << format(" %*.1e", q.width, q.of(level));
    }
    out << '\n';
}

namespace {

void print_methods(std::ostream& out, std::span<const LevelValues> levels) {
    std::map<std::pair<Method, Fallback>, long> counts;
    for (const LevelValues& level : levels) ++counts[{level.method, level.fallback}];
    out << "method:";
    const char* before = " ";
    for (const auto& [how, count] : counts) {
        out << before << name_of(how.first) << " (" << count << " levels" << (how.second == Fallback::none ? "" : ": ")
            << fallback_text(how.second) << ")";
        before = ", ";
    }
    out << '\n';
}

void print_statuses(std::ostream& out, std::span<const LevelValues> levels, const Job& job, bool elements) {
    const double sigma = job.sigma;
    const std::string remedy = job.spectrum ? format("use elements%%points_per_wave = %g.", 2 * job.settings.elements.points_per_wave)
                                            : "the map has too few points for its contacts.";
    const auto count = [&](auto holds) { return static_cast<long>(std::count_if(levels.begin(), levels.end(), holds)); };
    const auto tell = [&](long found, const std::string& what) {
        if (found > 0) out << format("  %ld of %zu levels: ", found, levels.size()) << what << '\n';
    };
    const auto tell_status = [&](LevelStatus status, const char* meaning) {
        tell(count([status](const LevelValues& l) { return l.status == status; }), status_text(status) + " - " + meaning);
    };
    // Reasons for status out_of_validity, reported also if a more serious status overrides it.
    tell(count([](const LevelValues& l) { return l.edge_contacts > 0; }),
         "contacts within <d> of the border of the surface - asperities beyond it are missing: N is too small.");
    tell(count([](const LevelValues& l) { return l.filled_share > kMuchFilled; }),
         "more than 1 % of the contact area is on filled points, which were missing in the map (filled_share).");
    if (std::isfinite(job.points_touch) && std::all_of(levels.begin(), levels.end(), [](const auto& l) { return l.force == 0; }))
        out << format("  no level reaches contact: the first point of the map touches at Z0 = %g (%g sigma).\n", job.points_touch,
                      job.points_touch / sigma);
    if (elements) {
        double worst = 0;
        for (const LevelValues& l : levels) worst = std::max(worst, l.force_error_expected);  // ignores NaN
        tell(count([](const LevelValues& l) { return l.force_error_expected > kUnresolved; }),
             format("a finer grid may change N by more than 1 %%, in nine of ten cases by less than %s (force_error_expected); ",
                    percent(worst).c_str()) +
                 remedy);
    }
    if (!elements) {
        tell(
            count([](const LevelValues& l) { return l.force == 0 && l.status == LevelStatus::out_of_validity; }),
            "the surface may touch outside the summits of the model, so that N need not be 0; use solver%model = 'elements' or law = 'fourth_order'.");
        const bool list = job.settings.surface.source == Source::asperities;
        double steepest = 0;
        for (const LevelValues& l : levels) steepest = std::max(steepest, std::isnan(l.slope_ratio) ? 0.0 : l.slope_ratio);
        if (list || job.settings.asperities.law == LawKind::hertz)
            tell(
                count([](const LevelValues& l) { return l.slope_ratio > kMostSlopeRatio; }),
                format(
                    "at contacts the indenter is up to %.2g times as steep as the surface (slope_ratio), and touches points other than the "
                    "summits of the surface; ",
                    steepest) +
                    (list ? "a list of asperities has no other points." : "use asperities%law = 'elliptic' or 'fourth_order'."));
        tell(count([sigma](const LevelValues& l) { return l.separation < kLowestSeparation * sigma; }),
             "separation below -3 sigma - the tip lies below 99.9 % of the heights: the asperity model is outside its range.");
        tell(count([](const LevelValues& l) { return exceeds_nominal_area(l); }),
             "contact area above the nominal area - the asperity model is outside its range.");
        std::map<std::int32_t, long> causes;
        for (const LevelValues& l : levels) causes[l.error_cause] += l.force_error_expected > kMuchError;
        for (const auto& [cause, found] : causes)
            tell(found, "N may differ from elements by more than 10 % (force_error_expected)" +
                            (cause > 0 ? std::string(", mainly because of ") + error_cause(cause) : "") + ".");
        tell(count([](const LevelValues& l) { return l.large_contacts > 0; }),
             "contacts with a > <d>/4, a quarter of the mean spacing of summits - the asperity model is near the limit of its range.");
    }
    double widest = 0;
    for (const LevelValues& l : levels) widest = std::max(widest, l.wide_contacts);
    tell(count([](const LevelValues& l) { return l.wide_contacts > 0; }),
         format("up to %.0f %% of the contacts have a > h/5, where h is the thickness of the top layer - elements have no such limit.",
                100 * widest));
    tell(count([](const LevelValues& l) { return l.beyond_law > 0; }),
         "contacts beyond the range of validity of the contact law (beyond_law in the file).");
    tell_status(LevelStatus::overlapping,
                "pairs of contact spots closer than the sum of their radii: spots that would merge are counted as two.");
    tell_status(
        LevelStatus::not_unique,
        "spots that overlap so much that other solutions may exist: this one is a local minimum of the energy, selected by a fixed rule.");
    const auto held = [](const LevelValues& l) { return l.fallback == Fallback::held; };
    tell(
        count(held),
        "no state has the force asked for: the level is the last stable one, that of the smallest force, where the bodies part under a dead "
        "load; give separations (indentation%control = 'separation') to go beyond.");
    const auto jump = [](const LevelValues& l) { return l.fallback == Fallback::jump; };
    tell(count(jump),
         status_text(LevelStatus::not_converged) +
             " - the force asked for is inside a jump of N(Z0), so that no separation has it. The level is a state at one side of "
             "the jump; prescribe separations there, or another force" +
             (elements ? "." : "; solver%model = 'elements' has no such jumps between close contacts."));
    const auto failed = [&](const LevelValues& l) { return l.status == LevelStatus::not_converged && !held(l) && !jump(l); };
    const auto lost = [&](const LevelValues& l) { return failed(l) && !elements && job.settings.solids.adhesion > 0; };
    tell(count(lost), status_text(LevelStatus::not_converged) +
                          " - the path of the attached asperities could not be followed to these levels, mostly because contacts overlap: "
                          "that is beyond the asperity model; use model = 'elements'.");
    tell(count([&](const LevelValues& l) { return failed(l) && !lost(l); }),
         status_text(LevelStatus::not_converged) +
             " - the residual is above solver%tolerance: do not use these values; raise solver%max_iterations or the tolerance.");
}

// "N = 1.23 N +- 5 %": the last level of a single run with its expected errors.
void print_bounds(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const auto last = std::find_if(levels.rbegin(), levels.rend(), [](const LevelValues& l) { return l.force_error_expected >= 0; });
    if (job.settings.run.realizations > 1 || last == levels.rend()) return;
    const char *l = job.settings.run.length_unit.c_str(), *f = job.settings.run.force_unit.c_str();
    const std::string area =
        last->area_error_expected >= 0 ? format(", A = %.4g %s2 +- %s", last->area, l, percent(last->area_error_expected).c_str()) : "";
    out << format("level %td: N = %.4g %s +- %s%s: bounds valid in nine of ten cases\n", levels.rend() - last, last->force, f,
                  percent(last->force_error_expected).c_str(), area.c_str());
}

// The summary of plastic contacts for cases with hardness, and of the energy lost in bodies that relax.
void print_yielding(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    if (relaxes(job.settings) && !levels.empty() && job.settings.run.realizations == 1)
        out << format("  %.4g %s %s of the work done are lost by relaxation. Levels depend on the levels before.\n",
                      levels.back().energy_lost, job.settings.run.force_unit.c_str(), job.settings.run.length_unit.c_str());
    if (!std::isfinite(job.settings.solids.hardness) || levels.empty()) return;
    const auto most = std::max_element(levels.begin(), levels.end(),
                                       [](const LevelValues& p, const LevelValues& q) { return p.plastic_contacts < q.plastic_contacts; });
    if (most->plastic_contacts == 0) {
        out << "  no contact yields: pressures stay below the hardness.\n";
        return;
    }
    out << format("  at Z0/sigma = %.4g, %d of %d contacts yield", most->separation / job.sigma, most->plastic_contacts, most->contacts);
    double lost = 0;
    for (const LevelValues& level : levels) lost = std::max(lost, level.plastic_work);  // NaN if a level did not converge
    if (job.settings.run.realizations == 1)
        out << format("; plastic work %.4g %s %s", lost, job.settings.run.force_unit.c_str(), job.settings.run.length_unit.c_str());
    out << ". Levels depend on the levels before.\n";
}

// The summary of a run with adhesion, and the range of attraction up to which JKR is valid.
void print_sticking(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const Case& c = job.settings;
    if (!(c.solids.adhesion > 0) || levels.empty()) return;
    const char *l = c.run.length_unit.c_str(), *f = c.run.force_unit.c_str();
    long jumps = 0;
    double lost = 0, least = 0;
    for (const LevelValues& level : levels)
        jumps += level.jumps, lost = std::fmax(lost, level.energy_lost), least = std::fmin(least, level.least_force);
    if (c.run.realizations == 1)
        out << format(
            "  adhesion: the smallest force is %.4g %s; energy lost in %ld jumps: %.4g %s %s. Levels depend on the levels before.\n", least,
            f, jumps, lost, f, l);
    if (const double fine = levels.back().cohesive_resolution; fine < 2)
        out << format(
            "  adhesion_range is %.2g pixel sides (cohesive_resolution): below 2 the pull-off force is about 5 to 10 %% too high.\n", fine);
    // Tabor's parameter is this length over the range of the attraction; JKR holds from 5 on.
    const auto reach = [&](double radius) { return std::cbrt(radius * std::pow(c.solids.adhesion / job.indenter.E_star, 2)); };
    double summit = kNotComputed;
    if (job.theory)
        summit = 0.737 / std::sqrt(job.theory->m4);
    else if (job.given && job.given->asperities.size() > 0) {
        summit = 0;
        for (double r : job.given->asperities.radius) summit += r / static_cast<double>(job.given->asperities.radius.size());
    }
    const double R = job.indenter.shape->hertz_radius(), range = c.solids.adhesion_range;
    if (summit > 0 && range > 0)
        out << format("  Tabor's parameter (JKR from 5 on, DMT below 0.1): %.3g for summits of mean radius (%.3g %s)",
                      reach(summit) / range, summit, l);
    else if (summit > 0)
        out << format(
            "  JKR (adhesion_range = 0) is valid for summits of mean radius (%.3g %s) if the range of the attraction is at most %.3g %s "
            "(Tabor's parameter 5)",
            summit, l, reach(summit) / 5, l);
    if (summit > 0 && std::isfinite(R))
        out << (range > 0 ? format("; %.3g for a smooth sphere", reach(R) / range)
                          : format("; for a smooth sphere at most %.3g %s", reach(R) / 5, l));
    if (summit > 0) out << ".\n";
    if (!(job.theory && range > 0)) return;
    // Pastewka and Robbins, PNAS 111, 3298 (2014), with kappa_rep = 2, d_rep = 4 h'/h'': h' range/(2 l_a) (h'^2/(h'' range))^(2/3) <
    // pi (3/16)^(2/3), l_a = w/E*, rms slope h', rms curvature h'' (rms of the sum of both second derivatives).
    const double slope = std::sqrt(2 * job.theory->m2), curvature = std::sqrt(8.0 / 3 * job.theory->m4);
    const double needed = 1 / (2 * 1.03) * job.indenter.E_star * slope * range * std::pow(slope * slope / (curvature * range), 2.0 / 3);
    out << format("  two flats with this surface %s (Pastewka and Robbins 2014): it needs w above about %.2g %s/%s.\n",
                  c.solids.adhesion > needed ? "would stick" : "would not stick", needed, f, l);
}

// Dundurs' second parameter, which couples the normal and the tangential problem; 0 for equal bodies.
double coupling(const Case::Solids& s) {
    const auto compliance = [&](int i) { return std::isinf(s.E[i]) ? 0.0 : 2 * (1 + s.nu[i]) / s.E[i]; };  // 1/G
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
            "  friction between unlike bodies: the coupling of pressure and tangential displacement (Dundurs' beta = %.2f) is neglected in the tangential "
            "forces.\n",
            coupling(c.solids));
    if (elements) return;
    const double points = job.spectrum   ? c.surface.n / job.spectrum->L_lambda_s
                          : job.measured ? job.measured->points_per_wave()
                                         : least_points;
    if (c.asperities.law == LawKind::hertz && points < least_points)
        out << format(
            "  law 'hertz' on %.2g points in the shortest wave: summits between the points are missed, N is too low near first contact (by half "
            "at 3 points); use 5 or more, or law 'fourth_order'.\n",
            points);
    if (c.indentation.selection == Selection::paper && c.indentation.selection_factor < 1.5)
        out << format(
            "  selection = 'paper' with a factor of %g excludes asperities that touch: N may be too low by more than half; 'overlap' includes "
            "all of them.\n",
            c.indentation.selection_factor);
}

}  // namespace

void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job) {
    const bool elements = by_elements(job.settings);
    if (!elements) print_methods(out, levels);
    print_bounds(out, levels, job);
    print_statuses(out, levels, job, elements);
    const auto extreme = std::max_element(levels.begin(), levels.end(), [](const LevelValues& p, const LevelValues& q) {
        return p.extreme_area_fraction < q.extreme_area_fraction;
    });
    if (!std::isfinite(job.settings.solids.hardness) && !relaxes(job.settings) && extreme != levels.end() &&
        extreme->extreme_area_fraction > kExtremeShare)
        out << format(
            "  pressures above E*/10 on %.0f %% of the contact area at Z0/sigma = %.4g: no metal stays elastic at such pressures; solids%%hardness "
            "limits them.\n",
            100 * extreme->extreme_area_fraction, extreme->separation / job.sigma);
    print_yielding(out, levels, job);
    print_sticking(out, levels, job);
    print_words(out, job, elements);
    std::int64_t crowded = 0;
    for (const LevelValues& level : levels) crowded += level.crowded_cells;
    if (crowded > 0 && !elements)
        out << "  " << crowded << " map cells (over all levels) have an area fraction above pi/16 = 19.6 %, where contacts would merge.\n";
}

const char* slope_remark(double rms_slope) {
    if (rms_slope <= 0.5) return "";
    if (rms_slope <= 2)
        return " - above 0.5 the theory of small slopes is inaccurate: use ratios and trends of N(Z0), A(N) and stiffness to compare surfaces; "
               "absolute areas and pressures (some 0.4 E* in a contact) are not those of a real body";
    return " - above 2 the theory of small slopes is not valid: use results only to compare runs of the model and to reproduce "
           "the paper (4.7 there); loads, areas and pressures are not those of a real body";
}

// Path of the plotting script: in a clone, in the installation, or in the clone where the program was built.
static std::string plot_script() {
    const std::string here = "output/plot/plot.py";
    std::error_code error;
    if (fs::exists(here, error)) return here;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* place : {"../share/rsc/plot/plot.py", "../output/plot/plot.py"})
        if (fs::exists(folder / place, error)) return (folder / place).lexically_normal().string();
    return here;
}

void print_result(std::ostream& out, const std::string& file, bool replaces) {
    out << "result: " << file << (replaces ? " (replaces an earlier result)" : "") << "\npicture: python3 " << plot_script() << ' ' << file
        << std::endl;
}

std::string duration(double seconds) {
    if (seconds < 1) return format("%.0f ms", 1000 * seconds);
    if (seconds < 100) return format("%.1f s", seconds);
    if (seconds < 5400) return format("%d min %02d s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
    return format("%d h %02d min", static_cast<int>(seconds / 3600), static_cast<int>(seconds / 60) % 60);
}

ProgressLine::ProgressLine(const RunOptions& options, const char* unit, double already, bool scrolls)
    : terminal_(isatty(STDERR_FILENO) != 0), unit_(unit), already_(already), start_(Clock::now()), last_(start_) {
    if (options.progress == Progress::always || (options.progress == Progress::automatic && terminal_ && !scrolls)) out_ = options.messages;
}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
    if (drawn_ && terminal_) *out_ << "\r\033[K" << std::flush;
    drawn_ = false;
}

void ProgressLine::show(double done, double total) {
    if (!out_) return;
    const auto now = Clock::now();
    const double since = std::chrono::duration<double>(now - last_).count(), spent = std::chrono::duration<double>(now - start_).count();
    if (since < (terminal_ ? 0.1 : 30.0)) return;
    last_ = now;
    drawn_ = true;
    const double rate = (done - already_) / spent;
    const std::string left = rate > 0 ? format("%.3g a second, ", rate) + duration((total - done) / rate) + " left" : "";
    if (terminal_) {
        constexpr int width = 30;
        const int filled = static_cast<int>(width * done / total);
        *out_ << "\r[" << std::string(static_cast<std::size_t>(filled), '#') << std::string(static_cast<std::size_t>(width - filled), '.')
              << format("] %.0f/%.0f %s, %s\033[K", done, total, unit_, left.c_str()) << std::flush;
    } else {
        *out_ << format("rsc: %.0f of %.0f %s, %s\n", done, total, unit_, left.c_str()) << std::flush;
    }
}

namespace {

// Steps of the table: about ten, including the first and the last.
std::vector<std::size_t> shown_steps(std::size_t steps) {
    constexpr std::size_t most = 11;
    std::vector<std::size_t> shown;
    const std::size_t rows = std::min(steps, most);
    for (std::size_t r = 0; r < rows; ++r) shown.push_back(rows > 1 ? r * (steps - 1) / (rows - 1) : 0);
    return shown;
}

}  // namespace

void print_campaign_heading(std::ostream& out, const Job& job, std::size_t workers, std::size_t done) {
    print_case(out, job);
    print_measured(out, job);
    const auto& run = job.settings.run;
    out << format("%d realizations of %zu levels, %zu in parallel", run.realizations, job.levels.size(), workers);
    if (done > 0) out << format("; %zu of them are finished", done);
    out << "\n\nMeans over the realizations so far at the last level; scatter is the standard deviation of one realization.\n"
        << format("%12s %14s %10s %14s %10s %12s %10s\n", "realizations", format("N [%s]", run.force_unit.c_str()).c_str(), "scatter",
                  format("A [%s2]", run.length_unit.c_str()).c_str(), "scatter", "elapsed", "a second")
        << std::flush;
}

void print_batch(std::ostream& out, const Job&, const Accumulators& sums, double seconds, std::size_t done_in_this_run) {
    const std::size_t count = sums.realization.size();
    Observations last;  // the last level of each realization
    last.realizations = count, last.steps = 1;
    for (std::size_t k = 1; k <= count; ++k) last.rows.push_back(sums.rows[k * sums.steps - 1]);
    const LevelStatistics force = last.statistics([](const LevelValues& l) { return l.force; });
    const LevelStatistics area = last.statistics([](const LevelValues& l) { return l.area; });
    const auto scatter = [](const LevelStatistics& s) { return s.count[0] > 1 ? s.deviation[0] : 0.0; };
    out << format("%12zu %14.8g %10.3g %14.8g %10.3g %12s %10.3g\n", count, force.mean[0], scatter(force), area.mean[0], scatter(area),
                  duration(seconds).c_str(), static_cast<double>(done_in_this_run) / std::max(seconds, 1e-3))
        << std::flush;
}

void print_campaign_summary(std::ostream& out, const Job& job, const Observations& o, double seconds, const std::string& file,
                            bool replaces) {
    const auto& run = job.settings.run;
    out << format("\nmean curve of %zu realizations\n%5s %12s %9s %14s %10s %14s %10s\n", o.realizations, "level",
                  format("Z0 [%s]", run.length_unit.c_str()).c_str(), "Z0/sigma", format("N [%s]", run.force_unit.c_str()).c_str(),
                  "scatter", format("A [%s2]", run.length_unit.c_str()).c_str(), "scatter");
    for (const std::size_t s : shown_steps(o.steps))
        out << format("%5zu %12.6g %9.5f %14.8g %10.3g %14.8g %10.3g\n", s + 1, o.separation.mean[s], o.separation.mean[s] / job.sigma,
                      o.force.mean[s], o.force.deviation[s], o.area.mean[s], o.area.deviation[s]);

    out << '\n' << o.realizations << " realizations, " << o.rows.size() << " levels in " << duration(seconds) << '\n';
    if (!o.surface.empty() && o.surface.front().m2 > 0) {
        double m2 = 0;
        for (const SurfaceStatistics& surface : o.surface) m2 += surface.m2 / static_cast<double>(o.surface.size());
        out << format("surfaces: rms slope %.4g", std::sqrt(2 * m2)) << slope_remark(std::sqrt(2 * m2)) << '\n';
    }
    print_remarks(out, o.rows, job);
    print_result(out, file, replaces);
}

RunSummary campaign_summary(const Result& result) {
    const Observations& o = result.observations;
    RunSummary summary;
    summary.levels = static_cast<long>(o.rows.size() + result.compared.levels.size());
    summary.failed = result.compared.failed;
    for (const LevelValues& row : o.rows)
        if (row.status == LevelStatus::not_converged) ++summary.failed;
    summary.separation = o.separation.mean.back();
    summary.force = o.force.mean.back();
    summary.area = o.area.mean.back();
    return summary;
}

}  // namespace rsc
