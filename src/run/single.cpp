#include "run/single.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <thread>

#include "case/registry.hpp"
#include "error.hpp"
#include "file/netcdf_writer.hpp"
#include "observe/regimes.hpp"
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

// Starts as many threads once, because OpenMP ends the program where the machine refuses one.
void require_threads(int threads) {
    std::vector<std::thread> started;
    started.reserve(static_cast<std::size_t>(threads));
    std::mutex all_there;
    bool refused = false;
    {
        const std::lock_guard wait(all_there);  // they must be there at the same time
        try {
            for (int k = 1; k < threads; ++k) started.emplace_back([&] { const std::lock_guard lock(all_there); });
        } catch (const std::system_error&) {
            refused = true;
        }
    }
    for (std::thread& thread : started) thread.join();
    if (refused)
        throw Error(Failure::no_memory,
                    "the machine refused to start " + std::to_string(threads) + " threads; fewer run%threads need less");
}

// The OpenMP threads of the caller while this lives.
class OmpThreads {
public:
    explicit OmpThreads(int threads) {
        require_threads(threads);
        omp_set_num_threads(threads);
    }
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
    const int threads = static_cast<int>(thread_count(settings.run.threads));
    const OmpThreads omp(threads);
    bool terminal = false;
    std::ostream* const line_out = progress_stream(options, terminal);
    std::ostream* table = options.quiet ? nullptr : options.table;
    if (table) print_heading(*table, job);
    Realization r;
    {
        ProgressLine progress(line_out, terminal, "levels");
        r = realize(job, settings.run.first_realization, threads, [&](std::size_t k, const Level& level) {
            if (table) print_level(*table, job, k, level);
            progress.show(static_cast<double>(k + 1), static_cast<double>(job.levels.size()));
            return caught_signal() == 0 && !(options.abandoned && *options.abandoned);
        });
    }
    if (const int signal = caught_signal())
        throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; nothing is written");
    if (options.abandoned && *options.abandoned) throw Interrupted(0, "abandoned");
    Accumulators sums(job.observe, job.levels.size());
    const RealizationRecord record = observe(job, settings.run.first_realization, r);
    sums.add(record);
    const auto stopped = [&] { return caught_signal() != 0 || (options.abandoned && *options.abandoned); };
    ComparedLevels compared;
    if (compares(job, options.compare_automatically))
        compared = compare_levels(job, settings.run.first_realization, threads, record.levels, table, stopped);
    if (const int signal = caught_signal())
        throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; nothing is written");
    if (options.abandoned && *options.abandoned) throw Interrupted(0, "abandoned");
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
    const RunSummary summary{static_cast<long>(record.levels.size()),
                             static_cast<long>(std::count_if(record.levels.begin(), record.levels.end(), failed)) + result.compared.failed,
                             last.separation, last.force, last.area};
    tell_failed(options, summary);
    return summary;
}

}  // namespace rsc
