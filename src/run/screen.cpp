#include "run/screen.hpp"

#include <unistd.h>

#include "base/format.hpp"
#include "case/units.hpp"
#include "contact/quantities.hpp"
#include "io/inputs.hpp"
#include "observe/regimes.hpp"
#include "physics/physics.hpp"
#include "trust/doubts.hpp"

namespace rsc {
namespace fs = std::filesystem;

const char* fallback_text(Fallback fallback) {
    // In the order of Fallback.
    constexpr const char* texts[] = {"",
                                     "there is no interaction",
                                     "dgesv did not converge",
                                     "dgesv's matrix was singular",
                                     "dgesv's solution is not proved unique",
                                     "no state has this force; level of the smallest force",
                                     "the force jumps over this one"};
    return texts[at(fallback)];
}

std::string name_of(Method method) { return kMethodNames[at(method)]; }

namespace {

bool shown(const LevelQuantity& q, const Job& job) {
    return q.heading && (q.shown ? q.shown(job.settings) : q.always);
}

// Whether separations are shown in rms heights, too; a ball under a prescribed force may be pressed
// many of these below the mean plane.
bool in_sigma(const Job& job) {
    return job.settings.indentation.control == Control::separation || job.indenter.period.finite();
}

// The column of Z0/sigma; a closed gap is 0 but for rounding, whose sign is not shown.
std::string in_rms_heights(double separation, const Job& job) {
    const double z = separation / job.sigma;
    return format(" %9.5f", std::abs(z) < 5e-6 ? 0.0 : z);
}

}  // namespace

double pascals(const Case& settings) {
    const auto& run = settings.run;
    return run.length_unit == "mm" && run.force_unit == "N"
               ? 1e6
               : unit_factor(unit_of(run.length_unit, -2, run.force_unit, 1), "Pa");
}

namespace {

// Half the width of the contact of a smooth indenter at the largest load; NaN if it is not known.
double smooth_radius(const Job& job) {
    const double R = job.indenter.shape->hertz_radius(), E = job.indenter.E_star;
    if (job.indenter.period.finite() || !std::isfinite(R) || job.levels.empty())
        return kNotComputed;
    if (job.settings.indentation.control == Control::separation)
        return std::sqrt(R * std::max(0.0, -std::ranges::min(job.levels)));
    return std::cbrt(0.75 * R * std::max(0.0, std::ranges::max(job.levels)) / E);
}

// Lengths and moduli in another unit than that of the case are a common mistake. No solid is
// stiffer than diamond, 1.2e12 Pa, and gels softer than 1 kPa flow.
void print_unlikely_units(std::ostream& out, const Job& job) {
    const UnitNames units = units_of(job);
    const char *l = units.length, *f = units.force;
    constexpr double stiffest = 2e12, softest = 1e3, highest = 0.1;
    const double steepest = job.measured ? 1 : 3, flattest = job.measured ? 1e-4 : 1e-6;
    const double in_pascals = pascals(job.settings);
    const auto modulus = [&](const char* key, double E) {
        const double value = E * in_pascals;
        if (value > 0 && std::isfinite(E) && (value > stiffest || value < softest))
            out << format(
                "warning: %s = %g %s/%s2 is %.2g Pa, which no solid has: is it in "
                "%s/%s2?\n",
                key, E, f, l, value, f, l);
    };
    for (const double E : job.settings.solids.E) modulus("solids%E", E);
    for (const double E : job.settings.solids.layer_E) modulus("solids%layer_E", E);
    const double slope = job.theory     ? job.theory->rms_slope()
                         : job.measured ? job.measured->parameters.sdq
                                        : kNotComputed,
                 height = job.spectrum   ? job.spectrum->sigma
                          : job.measured ? job.measured->parameters.sq
                                         : kNotComputed,
                 L = std::max(job.domain.Lx, job.domain.Ly);
    const char* const heights = job.spectrum ? "surface%sigma or surface%L"
                                             : "surface%height_unit, surface%coordinate_unit, "
                                               "surface%pixel or surface%L";
    constexpr double rounding = 1e-12;  // of heights from which a form was subtracted
    if (slope > steepest || (slope > rounding && slope < flattest))
        out << format("warning: the rms slope is %.3g: are %s in %s?\n", slope, heights, l);
    if (height > highest * L)
        out << format(
            "warning: the rms height, %.4g %s, is more than a tenth of the side, %.4g "
            "%s: are %s in %s?\n",
            height, l, L, l, heights, l);
    if (const double a = smooth_radius(job); 2 * a > L)
        out << format(
            "warning: a smooth contact would be %.4g %s wide at the largest load, the "
            "surface is %.4g %s: solids%%E, solids%%R, surface%%L or indentation%%levels?\n",
            2 * a, l, L, l);
}

static void print_finish(std::ostream& out, const Case& settings) {
    const auto made = finished_surface(settings);
    if (!made) return;
    const char* const l = settings.run.length_unit.c_str();
    out << format(
        "warning: surface%%finish = '%s' is an assumption: rms height %.4g %s, hurst %.3g, waves "
        "from %.4g to %.4g %s (%s)\n",
        kFinishNames[std::size_t(settings.surface.finish)], made->sigma, l, made->hurst,
        made->longest, made->shortest, l, made->sources.c_str());
}

// The title, the bodies, and the theoretical properties of the surface.
void print_case(std::ostream& out, const Job& job) {
    const auto& run = job.settings.run;
    const auto [l, f, time] = units_of(job);
    if (!run.title.empty()) out << run.title << '\n';
    if (const Period& period = job.indenter.period; period.finite())
        out << format(
            "two flats, a rough half-space that repeats every %g x %g %s, E* = %g %s/%s2, sigma = "
            "%g %s\n",
            period.x, period.y, l, job.indenter.E_star, f, l, job.sigma, l);
    else if (period.line())
        out << job.indenter.shape->text(l)
            << format(
                   " on a rough half-space that repeats every %g %s along %s, E* = %g %s/%s2, "
                   "sigma = %g %s\n",
                   period.length(), l, period.along_x() ? "x" : "y", job.indenter.E_star, f, l,
                   job.sigma, l);
    else
        out << job.indenter.shape->text(l)
            << format(" on a rough half-space, E* = %g %s/%s2, sigma = %g %s\n",
                      job.indenter.E_star, f, l, job.sigma, l);
    static const Case defaults;
    const auto& solids = job.settings.solids;
    if (std::ranges::equal(solids.E, defaults.solids.E) &&
        std::ranges::equal(solids.nu, defaults.solids.nu) &&
        std::ranges::equal(solids.R, defaults.solids.R) && solids.layer_E.empty())
        out << (pascals(job.settings) == 1e6 && run.length_unit == "mm"
                    ? "gold against a rigid sphere of 2.5 mm (defaults of &solids)\n"
                    : format("&solids by default: E(1) = %g %s/%s2, body 2 is rigid\n", solids.E[0],
                             f, l));
    if (job.settings.solver.model == ModelKind::automatic) {
        const ModelChoice choice = model_of(job.settings);
        out << format("by %s: %s (solver%%model = 'auto')\n", kModelNames[at(choice.model)],
                      choice.why);
    }
    // rsc itself wrote n into a case of twins.
    if (job.spectrum && by_elements(job.settings) && job.settings.surface.n != defaults.surface.n &&
        job.settings.surface.source != Source::spectrum) {
        const int n = element_points(job.settings, *job.spectrum);
        if (job.settings.surface.n != n)
            out << format(
                "surface%%n = %d has no effect on elements, which take %d x %d points "
                "(elements%%points_per_wave)\n",
                job.settings.surface.n, n, n);
    }
    print_finish(out, job.settings);
    if (job.theory) {
        const Moments& m = *job.theory;
        out << format(
            "theory: rms slope %.4g, Nayak parameter %.4g, summit density %.5g 1/%s2, r_g %.4g %s",
            m.rms_slope(), m.nayak(), m.summit_density(), l, m.mean_radius(), l);
        if (has_closed_forms(job.settings))
            out << format(", transition force N* %.5g %s", transition_force(m, job.indenter.E_star),
                          f);
        out << '\n';
    }
    print_unlikely_units(out, job);
}

// The treatment of a measured map, or of the first of several maps.
void print_measured(std::ostream& out, const Job& job) {
    if (!job.measured) return;
    if (is_pattern(job.settings.surface.file)) {
        const std::size_t files = matching_files(job.settings.surface.file).size();
        if (job.settings.run.realizations == 1 && files > 1)
            out << format(
                "%zu files match surface%%file; only number %d is used (run%%realizations = 1)\n",
                files, job.settings.run.first_realization);
    }
    if (!job.given) out << "the first of the maps:\n";
    for (const std::string& line : report(*job.measured, job.settings.run.length_unit))
        out << line << '\n';
    constexpr double most = 3;
    if (job.seam > most)
        out << format(
            "warning: the map is not periodic: heights jump across its border %.2g times as much "
            "as between neighbouring points; contacts at "
            "the border are artefacts\n",
            job.seam);
}

// A second rough body: the treatment of its map, and a note if it is interpolated.
void print_second(std::ostream& out, const Job& job) {
    const ShapeKeys& keys = job.indenter.shape->keys();
    if (!keys.map) return;
    for (const std::string& line : keys.report) out << "body 2: " << line << '\n';
    const HeightMap& map = *keys.map;
    const Domain& d = job.domain;
    double dx = job.measured ? job.measured->dx : 0, dy = job.measured ? job.measured->dy : 0;
    if (job.spectrum && by_elements(job.settings))
        dx = dy = d.Lx / element_points(job.settings, *job.spectrum);
    const auto between = [](double step, double steps_of_2, int points, double tip, double first) {
        const double at = (first - tip) / steps_of_2 + 0.5 * (points - 1);
        return !(std::abs(step / steps_of_2 - 1) <= 1e-9) || std::abs(at - std::round(at)) > 1e-6;
    };
    if (!between(dx, map.dx, map.nx, job.indenter.x0, d.x0) &&
        !between(dy, map.dy, map.ny, job.indenter.y0, d.y0))
        return;
    const char* const l = units_of(job).length;
    out << format("body 2 is interpolated between its points, at a spacing of %g x %g %s", map.dx,
                  map.dy, l);
    if (dx > 0) out << format("; the spacing of body 1 is %g x %g %s", dx, dy, l);
    out << (dx > 1.000001 * map.dx || dy > 1.000001 * map.dy
                ? ", which is coarser, so that details of body 2 are missed\n"
                : "\n");
}

}  // namespace

// The columns after the first three are quantities of contact/quantities.hpp.
void print_heading(std::ostream& out, const Job& job) {
    print_case(out, job);
    print_measured(out, job);
    print_second(out, job);
    const std::string l = job.settings.run.length_unit, f = job.settings.run.force_unit;
    out << format("\n%5s %12s", "level", format("Z0 [%s]", l.c_str()).c_str());
    if (in_sigma(job)) out << format(" %9s", "Z0/sigma");
    for (const LevelQuantity& q : level_quantities()) {
        if (!shown(q, job)) continue;
        std::string heading = q.heading;
        if (const std::string unit = q.unit_in(l, f, job.settings.run.time_unit); unit != "1")
            heading += " [" + unit + "]";
        out << format(" %*s", q.width, heading.c_str());
    }
    out << '\n';
}

// The status of a level, or the words of its doubts.
static std::string outcome_of(const LevelValues& level) {
    if (level.status == LevelStatus::not_converged) return "NOT CONVERGED";
    if (level.status == LevelStatus::out_of_validity) return words_of_doubts(level.doubts);
    if (level.status == LevelStatus::not_unique) return "not unique";
    return kLevelStatusNames[at(level.status)];
}

void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level) {
    out << format("%5zu %12.6g", number + 1, level.separation);
    if (in_sigma(job)) out << in_rms_heights(level.separation, job);
    for (const LevelQuantity& q : level_quantities()) {
        if (!shown(q, job)) continue;
        if (std::holds_alternative<LevelStatus LevelValues::*>(q.member))
            out << "  " << outcome_of(level) << (level.fallback == Fallback::none ? "" : ", ")
                << (level.fallback == Fallback::none || level.method == Method::automatic
                        ? ""
                        : name_of(level.method) + ": ")
                << fallback_text(level.fallback);
        else if (q.integer())
            out << format(" %*.0f", q.width, q.of(level));
        else if (q.digits > 0)
            out << format(" %*.*g", q.width, q.digits, q.of(level));
        else
            out << format(" %*.1e", q.width, q.of(level));
    }
    out << std::endl;  // a run may be watched in a file
}

// Path of the plotting script: in a clone, in the installation, or in the clone where the program
// was built.
static std::string plot_script() {
    const std::string here = "output/plot/plot.py";
    std::error_code error;
    if (fs::exists(here, error)) return here;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* place :
         {"output/plot/plot.py", "../share/rsc/plot/plot.py", "../output/plot/plot.py"})
        if (fs::exists(folder / place, error)) return (folder / place).lexically_normal().string();
    return here;
}

std::string shell_word(const std::string& path) {
    const bool plain = std::ranges::all_of(path, [](unsigned char c) {
        return std::isalnum(c) || c >= 0x80 || std::strchr("_-+=%@:,./", c) != nullptr;
    });
    if (plain && !path.empty()) return path;
    std::string quoted = "'";
    for (const char c : path) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string program_command() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!program.filename().string().starts_with("rsc")) return "rsc";
    if (program.parent_path() == fs::current_path(error))
        return "./" + shell_word(program.filename().string());
    return shell_word(program.string());
}

void print_result(std::ostream& out, const std::string& file, bool replaces) {
    out << "result: " << file << (replaces ? " (replaces an earlier result)" : "")
        << "\npicture: python3 " << shell_word(plot_script()) << ' ' << shell_word(file)
        << std::endl;
}

std::string duration(double seconds) {
    if (seconds < 1) return format("%.0f ms", 1000 * seconds);
    if (seconds < 100) return format("%.1f s", seconds);
    if (seconds < 5400) return format("%d min %02d s", int(seconds) / 60, int(seconds) % 60);
    return format("%d h %02d min", int(seconds / 3600), int(seconds / 60) % 60);
}

// Seconds from which the time of the rest is said, and before which the preparation of the surface
// or the first of several parallel steps would spoil the estimate.
constexpr double kWorthSaying = 5, kSteady = 2;

ProgressLine::ProgressLine(const RunOptions& options, const char* unit, double already,
                           bool scrolls)
    : terminal_(isatty(STDERR_FILENO) != 0),
      unit_(unit),
      already_(already),
      start_(Clock::now()),
      last_(start_) {
    if (options.progress != Progress::never) messages_ = options.messages;
    if (options.progress == Progress::always ||
        (options.progress == Progress::automatic && terminal_ && !scrolls))
        out_ = options.messages;
}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
    if (drawn_ && terminal_) *out_ << "\r\033[K" << std::flush;
    drawn_ = false;
}

void ProgressLine::show(double done, double total) {
    const double since = seconds_since(last_), spent = seconds_since(start_);
    if (messages_ && done > already_ && spent > kSteady) {
        const double rest = spent * (total - done) / (done - already_);
        if (rest > kWorthSaying && !(out_ && terminal_))
            *messages_ << format("rsc: %.0f of %.0f %s after ", done, total, unit_)
                       << duration(spent) << "; at this rate the rest takes " << duration(rest)
                       << std::endl;
        messages_ = nullptr;
    }
    if (!out_) return;
    if (since < (terminal_ ? 0.1 : 30.0)) return;
    last_ = Clock::now();
    drawn_ = true;
    const double rate = (done - already_) / spent;
    const std::string left =
        rate > 0 ? format("%.3g a second, ", rate) + duration((total - done) / rate) + " left" : "";
    if (terminal_) {
        constexpr int width = 30;
        const int filled = int(width * done / total);
        *out_ << "\r[" << std::string(at(filled), '#') << std::string(at(width - filled), '.')
              << format("] %.0f/%.0f %s, %s\033[K", done, total, unit_, left.c_str()) << std::flush;
    } else {
        *out_ << format("rsc: %.0f of %.0f %s, %s\n", done, total, unit_, left.c_str())
              << std::flush;
    }
}

namespace {

// Steps of the table: about ten, including the first and the last.
std::vector<std::size_t> shown_steps(std::size_t steps) {
    constexpr std::size_t most = 11;
    std::vector<std::size_t> shown;
    const std::size_t rows = std::min(steps, most);
    for (const auto r : indices(rows)) shown.push_back(rows > 1 ? r * (steps - 1) / (rows - 1) : 0);
    return shown;
}

}  // namespace

// The quantities of a campaign on the screen: Z0 under a prescribed load, and those of the level
// table that are means in the result.
static std::vector<const LevelQuantity*> with_means(const Job& job) {
    std::vector<const LevelQuantity*> all;
    const bool prescribed = job.settings.indentation.control != Control::separation;
    for (const LevelQuantity& q : level_quantities())
        if ((q.separate && q.length_power == 1 && prescribed) || (shown(q, job) && q.statistics))
            all.push_back(&q);
    return all;
}

// Column heads of these, each with its scatter.
static std::string scatter_heading(const Job& job) {
    const auto [l, f, time] = units_of(job);
    std::string text;
    for (const LevelQuantity* q : with_means(job)) {
        const std::string unit = q->unit_in(l, f, time);
        const std::string name = q->heading ? q->heading : "Z0";
        text += format(" %14s %10s", (unit == "1" ? name : name + " [" + unit + "]").c_str(),
                       "scatter");
    }
    return text;
}

// Their values at a level; the scatter of what the case prescribes is left out.
static std::string with_scatter(const Job& job, const Observations& o, std::size_t step) {
    std::string text;
    Observations level;
    level.realizations = o.realizations;
    level.steps = 1;
    for (const auto k : indices(o.realizations)) level.rows.push_back(o.row(k, step));
    for (const LevelQuantity* q : with_means(job)) {
        const LevelStatistics s =
            level.statistics([&](const LevelValues& values) { return q->of(values); });
        const double spread = s.count[0] > 1 ? s.deviation[0] : kNotComputed;
        const bool given = !(spread > 1e-6 * std::abs(s.mean[0]));
        text += format(" %14.6g %10s", s.mean[0],
                       std::isnan(spread) || given ? "-" : format("%.3g", spread).c_str());
    }
    return text;
}

void print_campaign_heading(std::ostream& out, const Job& job, std::size_t workers,
                            std::size_t done) {
    print_case(out, job);
    print_measured(out, job);
    const auto& run = job.settings.run;
    out << format("%d realizations of %zu levels, %zu in parallel", run.realizations,
                  job.levels.size(), workers);
    if (done > 0) out << format("; %zu of them are finished", done);
    out << "\n\nMeans over the realizations so far at the last level; scatter is the standard "
           "deviation of one realization.\n"
        << format("%12s", "realizations") << scatter_heading(job)
        << format(" %12s %10s\n", "elapsed", "a second") << std::flush;
}

void print_batch(std::ostream& out, const Job& job, const Accumulators& sums, double seconds,
                 std::size_t done_in_this_run) {
    const std::size_t count = sums.realization.size();
    Observations last;  // the last level of each realization
    last.realizations = count;
    last.steps = 1;
    for (std::size_t k = 1; k <= count; ++k) last.rows.push_back(sums.rows[k * sums.steps - 1]);
    out << format("%12zu", count) << with_scatter(job, last, 0)
        << format(" %12s %10.3g\n", duration(seconds).c_str(),
                  double(done_in_this_run) / std::max(seconds, 1e-3))
        << std::flush;
}

void print_campaign_summary(std::ostream& out, const Job& job, const Observations& o,
                            double seconds, const std::string& file, bool replaces) {
    const char* const l = units_of(job).length;
    const bool prescribed = job.settings.indentation.control != Control::separation;
    out << format("\nmean curve of %zu realizations\n%5s", o.realizations, "level");
    if (!prescribed) out << format(" %12s", joined("Z0 [", l, "]").c_str());
    if (in_sigma(job)) out << format(" %9s", "Z0/sigma");
    out << scatter_heading(job) << '\n';
    for (const std::size_t s : shown_steps(o.steps)) {
        out << format("%5zu", s + 1);
        if (!prescribed) out << format(" %12.6g", o.separation.mean[s]);
        if (in_sigma(job)) out << in_rms_heights(o.separation.mean[s], job);
        out << with_scatter(job, o, s) << '\n';
    }

    out << '\n'
        << o.realizations << " realizations, " << o.rows.size() << " levels in "
        << duration(seconds) << '\n';
    if (!o.surface.empty() && o.surface.front().m2 > 0) {
        double m2 = 0;
        for (const SurfaceStatistics& surface : o.surface)
            m2 += surface.m2 / double(o.surface.size());
        out << format("surfaces: rms slope %.4g", std::sqrt(2 * m2))
            << slope_remark(std::sqrt(2 * m2)) << '\n';
    }
    tell_unreached_heights(out, o.surface, job);
    print_remarks(out, o.rows, job);
    print_result(out, file, replaces);
}

}  // namespace rsc
