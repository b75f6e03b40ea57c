#include "run/run.hpp"

#include <unistd.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "case/read_case.hpp"
#include "case/registry.hpp"
#include "io/inputs.hpp"
#include "io/netcdf_writer.hpp"
#include "io/whole_file.hpp"
#include "observe/regimes.hpp"
#include "run/checkpoint.hpp"
#include "run/compare.hpp"
#include "run/realize.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/team.hpp"

namespace rsc {

std::vector<std::string> input_files(const Case& settings) {
    std::vector<std::string> files;
    if (settings.surface.source != Source::synthetic && !settings.surface.file.empty())
        files = matching_files(settings.surface.file);
    if (!settings.indenter.file.empty()) files.push_back(settings.indenter.file);
    return files;
}

namespace {

// With --resume, a file that has all realizations of this case and more of them is left alone.
void require_none_lost(const Case& settings) {
    const std::optional<ResultHead> head = head_of_result(settings.output.file);
    if (!head || !head->this_version()) return;
    const Reading there = read_namelist(head->case_text);
    const auto &has = there.settings.run, &asks = settings.run;
    const auto end = [](const auto& run) { return run.first_realization + run.realizations; };
    if (there.study || !there.faults.empty() || has.realizations <= asks.realizations ||
        asks.first_realization < has.first_realization || end(asks) > end(has))
        return;
    Case same = settings;
    same.run.first_realization = has.first_realization;
    same.run.realizations = has.realizations;
    if (!Checkpoint::differences(there.settings, without_idle_keys(same)).empty()) return;
    bad_input("'", settings.output.file, "' is complete: it holds ", has.realizations,
              " realizations of this case, which asks for ", asks.realizations,
              ". Nothing is changed. Set run%realizations = ", has.realizations,
              " to go on with this file, another output%file for fewer, or leave out --resume to "
              "replace the file");
}

}  // namespace

bool check_result_path(const Case& settings, const RunOptions& options) {
    if (options.resume) require_none_lost(settings);
    std::vector<std::string> inputs = input_files(settings);
    append(inputs, options.inputs);
    return check_output(settings.output.file, inputs);
}

std::string case_text(const Case& settings) {
    return effective_namelist(without_idle_keys(settings));
}

// The means of a level over the realizations in which it has a value.
static LevelValues mean_of(const Observations& o, std::size_t step) {
    LevelValues mean;
    for (const LevelQuantity& q : level_quantities())
        for (const auto c : indices(q.components())) {
            double sum = 0;
            int count = 0;
            for (const auto k : indices(o.realizations))
                if (const double value = q.of(o.row(k, step), c); !std::isnan(value)) {
                    sum += value;
                    ++count;
                }
            if (!q.integer()) q.put(mean, count > 0 ? sum / count : kNotComputed, c);
            mean.errors[q.slot + c] =
                o.realizations == 1 ? q.error(o.row(0, step), c) : kNotComputed;
        }
    return mean;
}

RunSummary summary_of(const Result& result) {
    const Observations& o = result.observations;
    RunSummary summary;
    summary.levels = long(o.rows.size() + result.compared.levels.size());
    summary.failed = result.compared.failed;
    for (const LevelValues& level : o.rows) {
        summary.failed += level.status == LevelStatus::not_converged;
        summary.held += level.fallback == Fallback::held;
        summary.doubtful += level.doubts != 0;
        summary.doubts |= level.doubts;
    }
    if (o.steps == 0) return summary;
    summary.first = mean_of(o, 0);
    summary.last = mean_of(o, o.steps - 1);
    if (o.realizations == 1) summary.least_force_error = error_of_least_force(o.rows);
    return summary;
}

void tell_failed(const RunOptions& options, const RunSummary& summary) {
    if (summary.failed == 0 || !options.messages) return;
    *options.messages
        << "rsc: " << summary.failed << " of " << summary.levels
        << " levels did not converge; they have status = 4 in the file, and tables leave them out"
        << (summary.held == 0
                ? "."
                : joined("; ", summary.held,
                         " of them because no state has their force: give separations "
                         "(indentation%control = 'separation')."))
        << '\n';
}

namespace {

void summarise(std::ostream& out, const Job& job, const SurfaceStatistics& s,
               std::span<const LevelValues> levels, std::span<const double> curves, double seconds,
               const std::string& file, bool replaces, const std::string& twins) {
    out << '\n';
    if (by_elements(job.settings))
        out << "elements, ";
    else
        out << s.summits << " asperities (" << s.saddles << " saddles excluded), ";
    out << levels.size() << (levels.size() == 1 ? " level in " : " levels in ") << duration(seconds)
        << '\n';
    if (const double slope = std::sqrt(2 * s.m2); slope > 0)
        out << format("surface: rms height %.6g %s, rms slope %.4g%s\n", s.sigma,
                      job.settings.run.length_unit.c_str(), slope, slope_remark(slope));
    tell_unreached_heights(out, {&s, 1}, job);
    print_remarks(out, levels, job, curves);
    if (!twins.empty()) out << twins << '\n';
    print_result(out, file, replaces);
}

constexpr const char* kMark =
    "! Written by rsc with the result of a measured map, and replaced with it: edit a copy.\n";
const FileKind kTwins{"case of twins",
                      [](const std::string& path) { return begins_with(path, kMark); }};
constexpr int kRealizations = 100;

std::string stem(const std::string& result) {
    return result.ends_with(".nc") ? result.substr(0, result.size() - 3) : result;
}

// The keys of a surface that belong to the map of body 2, too.
Case::Surface for_second_body(const Case::Surface& keys, const Case::IndenterKeys& body) {
    Case::Surface kept;
    kept.detrend = keys.detrend;
    kept.missing = keys.missing;
    kept.filter_cutoff = keys.filter_cutoff;
    kept.outliers = keys.outliers;
    if (lacks_units(body.file, body.channel)) {
        kept.height_unit = keys.height_unit;
        kept.coordinate_unit = keys.coordinate_unit;
        kept.pixel = keys.pixel;
    }
    kept.missing_value = keys.missing_value;
    return kept;
}

void scale_levels(Case::Indentation& keys, double factor) {
    keys.start *= factor;
    keys.stop *= factor;
    for (double& level : keys.levels) level *= factor;
}

// Surfaces as long as the profile would have too many waves.
double length_of_twins(const Measured& m) {
    constexpr double most = 1024;  // of the shortest waves
    return std::min(m.Lx(), most * 2 * pi / m.spectrum.wavenumber.back());
}

}  // namespace

std::string twins_text(const Job& job, const std::string& result) {
    const Measured& m = *job.measured;
    Case twins = job.settings;
    const double L = m.profile ? length_of_twins(m) : std::max(m.Lx(), m.Ly());
    twins.run.title = "Surfaces with the spectrum of " +
                      std::filesystem::path(job.settings.surface.file).filename().string();
    twins.run.realizations = kRealizations;
    twins.run.first_realization = 1;
    const Case::Surface keys = twins.surface;
    const Case::IndenterKeys& second = twins.indenter;
    twins.surface = second.file.empty() ? Case::Surface() : for_second_body(keys, second);
    twins.surface.source = Source::spectrum;
    twins.surface.file = result;
    twins.surface.L = L;
    twins.surface.n =
        2 * int(std::ceil(m.spectrum.wavenumber.back() * L / (2 * pi) * (1 - 1e-12))) +
        2;  // one more point for heights of any distribution
    if (m.profile) {
        twins.surface.aspect = keys.aspect;
        twins.surface.direction = keys.direction;
        // The forces of a length of the profile become those of the length of the twins.
        if (job.indenter.period.line() && twins.indentation.control == Control::force)
            scale_levels(twins.indentation, L / m.Ly());
    }
    twins.surface.twins = m.isotropy < kIsotropic ? Twins::directional : Twins::radial;
    twins.surface.twin_heights = m.gaussian() ? TwinHeights::gaussian : TwinHeights::measured;
    // That of one sample, about which those of twins scatter; of a profile that of the spectrum.
    twins.surface.sigma = m.profile ? std::optional<double>() : m.parameters.sq;
    twins.surface.normalise = Normalise::ensemble;
    if (keys.sigma && twins.indentation.control == Control::separation &&
        twins.indentation.unit == LevelUnit::sigma) {
        // For the map sigma was a unit of length; for twins it is the rms height.
        twins.indentation.unit = LevelUnit::length;
        scale_levels(twins.indentation, job.sigma);
    }
    if (job.indenter.period.finite() &&
        twins.indentation.control == Control::force) {  // the area of the twins may be another
        twins.indentation.control = Control::pressure;
        twins.indentation.unit = LevelUnit::pressure;
        scale_levels(twins.indentation, 1 / job.indenter.period.area());
    }
    // The square begins at 0 and has the longer side of the map; the tip keeps its distance from
    // the middle.
    const Domain& d = job.domain;
    if (auto& x = twins.indentation.centre[0])
        x = std::clamp(*x - (d.x0 + 0.5 * d.Lx) + 0.5 * L, 0.0, L);
    if (auto& y = twins.indentation.centre[1])
        y = std::clamp(*y - (d.y0 + 0.5 * d.Ly) + 0.5 * L, 0.0, L);
    twins.output.file = stem(result) + "_twins.nc";
    twins.output.contacts = Contacts::automatic;
    twins.output.heights = false;
    // What is for one realization only.
    const Case defaults;
    twins.output.fields.clear();
    twins.output.field_levels.clear();
    std::ranges::copy(defaults.output.field_window, twins.output.field_window);
    twins.solids.friction = 0;
    twins.solver.model = model_of(job.settings).model;  // as for the map, for comparison
    return kMark + effective_namelist(twins);
}

// States the exponent of the twins' spectrum, where the map is smoother or rougher than elsewhere
// if it is high, and how far the rms slope of the twins is from the map's. The spectrum does not
// hold waves longer than the map, nor those shorter than its wider grid step, and is scaled to the
// rms height of the map.
constexpr double kTold = 0.05;  // a difference of slopes, or an exponent, that is stated
static std::string other_slopes(const Measured& m) {
    if (m.profile) return "";
    const MeasuredSpectrum& s = m.spectrum;
    const double L = std::max(m.Lx(), m.Ly()), sigma = m.parameters.sq;
    const bool directional = m.isotropy < kIsotropic;
    const double exponent = directional ? s.plane_exponent : s.exponent;
    std::string said =
        std::abs(exponent) < kTold
            ? ""
            : format("\nspectrum of the twins: that of the map times k^%.2f, for its rms slope",
                     exponent);
    constexpr double smoother = 0.8, rougher = 1.25;
    if (const double high = m.parameters.high_slope; high < smoother || high > rougher)
        said += format(
            "\nwarning: where the map is more than one rms height above its mean plane, its rms "
            "slope is %.2g times that of the whole; the twins "
            "do not keep this, and their contact area at a given force may differ from the map's "
            "by a factor of two and more",
            high);
    const Spectrum twin = tabulated_spectrum(
        directional
            ? std::make_shared<SpectrumTable>(s.plane_wavenumber,
                                              tilted(s.plane_psd, s.plane_wavenumber, exponent),
                                              MeasuredSpectrum::kAngles)
            : std::make_shared<SpectrumTable>(s.wavenumber, tilted(s.psd, s.wavenumber, exponent)),
        L, sigma);
    const double slope = theoretical_moments(twin).rms_slope(), held = twin.table->sigma() / sigma;
    if (std::abs(slope / m.parameters.sdq - 1) < kTold) return said;
    said += format("\nwarning: the rms slope of the twins is %.3g, the map's %.3g", slope,
                   m.parameters.sdq);
    if (exponent != 0 &&
        std::abs(exponent) <
            kMostExponent * (1 - 1e-9))  // which makes the slopes by first differences equal
        return said +
               ": by first differences with the step of the map both are equal, but this step "
               "smooths the shortest waves; elements see the "
               "twins, on their finer grid, steeper than the map";
    return said + format(
                      ", and their contact area at a given force differs about as much in the "
                      "opposite direction: the spectrum holds %.0f %% of "
                      "the mean square height and is scaled to 100 %%",
                      100 * held * held);
}

// Writes twins_text() to NAME_twins.nml for the result NAME.nc of a measured map. Returns a line
// for the screen, which also reports a file of that name that was not written by rsc and is not
// replaced; empty for other surfaces, and for maps too small for a spectrum.
static std::string write_twins(const Job& job, const std::string& result) {
    if (!job.measured || !job.measured->fit) return {};
    const std::string path = stem(result) + "_twins.nml";
    if (const std::string why = reason_to_leave(path, kTwins); !why.empty())
        return "twins: " + path + ": " + why;
    write_whole(path, kTwins, twins_text(job, result));
    const char* const kept =
        job.measured->gaussian()
            ? ""
            : " and these heights; not kept: which waves carry the skewness: some 10 % of N, and a "
              "factor of several in A where few summits touch";
    return "twins: " + path + " (surfaces with this spectrum" + kept + ": " + program_command() +
           " " + shell_word(path) + ")" + other_slopes(*job.measured);
}

namespace {

// Moves what a realization leaves into its result.
void take_realization(Result& result, Job& job, Realization& r) {
    result.asperities = std::move(r.asperities);
    result.residual_depth = std::move(r.remains.residual_depths);
    result.residual_profile = std::move(r.remains.residual_profile);
    result.measured = job.measured;
    result.fields = std::move(r.fields);
    if (job.settings.output.heights) result.heights = std::move(r.heights);
}

}  // namespace

RunSummary run_realization(const Case& settings, const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const bool replaces = check_result_path(settings, options);
    const Contacts keep = contacts_kept(settings);
    Job job = prepare(settings);
    const int threads = int(most_threads(settings.run.threads));
    const LoopThreads loops(threads);
    std::ostream* const table = options.table;
    const double total = double(job.levels.size());
    double done = 0;
    const auto go_on = [&] {
        leave_if_interrupted("; nothing is written");
        if ((options.abandoned && *options.abandoned) ||
            (options.report && options.report(done, total)))
            throw Interrupted(0, "stopped; nothing is written");
    };
    const Watch watch(go_on);
    if (table) print_heading(*table, job);
    Realization r;
    {
        // A table on the terminal shows the progress itself.
        ProgressLine progress(options, "levels", 0, table && isatty(STDOUT_FILENO) != 0);
        r = realize(job, settings.run.first_realization, threads,
                    [&](std::size_t k, const Level& level) {
                        if (table) print_level(*table, job, k, level);
                        done = double(k + 1);
                        progress.show(done, total);
                        go_on();
                    });
    }
    Accumulators sums(job.observe, job.levels.size());
    const RealizationRecord record = observe(job.observe, settings.run.first_realization,
                                             r.statistics, r.levels, std::move(r.curves));
    sums.add(record);
    ComparedLevels compared;
    if (compares(job, options.compare_automatically))
        compared = compare_levels(job, settings.run.first_realization, threads, record.levels,
                                  table, [] { return false; });
    go_on();
    Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory,
                                sums.finish());
    keep_contacts(result, r.levels, keep);
    result.compared = std::move(compared);
    take_realization(result, job, r);
    write_result(result, settings.output.file, options.command);

    const std::string twins = write_twins(job, settings.output.file);

    if (table)
        summarise(*table, job, r.statistics, record.levels, record.curves, seconds_since(start),
                  settings.output.file, replaces, twins);
    const RunSummary summary = summary_of(result);
    tell_failed(options, summary);
    return summary;
}

long run_case(const Case& settings, const RunOptions& options) {
    if (settings.run.realizations == 1) return run_realization(settings, options).failed;
    CampaignWork work({settings}, options);
    ThreadTeam team(std::ref(work), settings.run.threads);
    return run_campaign(settings, options, team, 0, work.job(0)).failed;
}

}  // namespace rsc
