#include "run/single.hpp"
#include "rough/omp_team.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "case/registry.hpp"
#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "observe/regimes.hpp"
#include "rough/stopping.hpp"
#include "run/campaign_team.hpp"
#include "run/compare.hpp"
#include "run/job.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/twins.hpp"

namespace rsc {
namespace {

void summarise(std::ostream& out, const Job& job, const SurfaceStatistics& s, std::span<const LevelValues> levels, double seconds,
               const std::string& file, bool replaces, const std::string& twins) {
    const char* l = job.settings.run.length_unit.c_str();
    char line[600];
    out << '\n';
    if (by_elements(job.settings))
        std::snprintf(line, sizeof line, "elements, %zu levels in %s\n", levels.size(), duration(seconds).c_str());
    else
        std::snprintf(line, sizeof line, "%lld asperities (%lld saddles left out), %zu levels in %s\n", static_cast<long long>(s.summits),
                      static_cast<long long>(s.saddles), levels.size(), duration(seconds).c_str());
    out << line;
    if (s.m2 > 0) {
        const double slope = std::sqrt(2 * s.m2);
        std::snprintf(line, sizeof line, "surface: rms height %.6g %s, rms slope %.4g%s\n", s.sigma, l, slope, slope_remark(slope));
        out << line;
    }
    print_remarks(out, levels, job);
    if (!twins.empty()) out << twins << '\n';
    print_result(out, file, replaces);
}

// The OpenMP threads of the caller while this lives.
class OmpThreads {
public:
    explicit OmpThreads(int threads) { omp_set_num_threads(threads); }
    OmpThreads(const OmpThreads&) = delete;
    OmpThreads& operator=(const OmpThreads&) = delete;
    ~OmpThreads() { omp_set_num_threads(before_); }

private:
    int before_ = omp_get_max_threads();
};

}  // namespace

RunSummary run_realization(const Case& settings, const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const bool replaces = check_result_path(settings, options);
    const Contacts keep = contacts_kept(settings);
    Job job = prepare(settings);
    const int threads = static_cast<int>(most_threads(settings.run.threads));
    const OmpThreads omp(threads);
    bool terminal = false;
    std::ostream* const line_out = progress_stream(options, terminal);
    std::ostream* table = options.quiet ? nullptr : options.table;
    const double total = static_cast<double>(job.levels.size());
    double done = 0;
    const auto go_on = [&] {
        if (const int signal = caught_signal())
            throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; nothing is written");
        if ((options.abandoned && *options.abandoned) || (options.report && options.report(done, total)))
            throw Interrupted(0, "stopped; nothing is written");
    };
    const Watch watch(go_on);
    if (table) print_heading(*table, job);
    Realization r;
    {
        ProgressLine progress(line_out, terminal, "levels");
        r = realize(job, settings.run.first_realization, threads, [&](std::size_t k, const Level& level) {
            if (table) print_level(*table, job, k, level);
            done = static_cast<double>(k + 1);
            progress.show(done, total);
            go_on();
            return true;
        });
    }
    Accumulators sums(job.observe, job.levels.size());
    const RealizationRecord record = observe(job, settings.run.first_realization, r);
    sums.add(record);
    ComparedLevels compared;
    if (compares(job, options.compare_automatically))
        compared = compare_levels(job, settings.run.first_realization, threads, record.levels, table, [] { return false; });
    go_on();
    Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory, sums.finish());
    keep_contacts(result, r.levels, keep);
    const SurfaceStatistics statistics = r.statistics;
    result.friction = std::move(r.friction);
    result.asperities = std::move(r.asperities);
    result.residual_depth = std::move(r.residual_depth);
    result.residual_profile = std::move(r.residual_profile);
    result.measured = job.measured;
    result.compared = std::move(compared);
    if (settings.output.heights) result.heights = std::move(job.given_heights ? job.given_heights : r.heights);
    write_result(result, settings.output.file, {settings.output.format, settings.output.compression, options.command});

    const std::string twins = write_twins(job, settings.output.file);

    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (table) summarise(*table, job, statistics, record.levels, seconds, settings.output.file, replaces, twins);
    const LevelValues& last = record.levels.back();
    const auto failed = [](const LevelValues& level) { return level.status == LevelStatus::not_converged; };
    const RunSummary summary{static_cast<long>(record.levels.size() + result.compared.step.size()),
                             static_cast<long>(std::count_if(record.levels.begin(), record.levels.end(), failed)) + result.compared.failed,
                             last.separation, last.force, last.area};
    tell_failed(options, summary);
    return summary;
}

}  // namespace rsc
