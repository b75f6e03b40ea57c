#include "run/single.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <thread>

#include "case/registry.hpp"
#include "error.hpp"
#include "file/netcdf_file.hpp"
#include "file/netcdf_writer.hpp"
#include "observe/regimes.hpp"
#include "run/campaign_team.hpp"
#include "run/job.hpp"
#include "run/screen.hpp"
#include "run/signals.hpp"
#include "run/twins.hpp"

namespace rsc {
namespace {

// What the levels add up to, for the summary.
struct Tally {
    std::map<LevelStatus, long> statuses;
    long levels = 0;
    std::int64_t crowded_cells = 0;
    std::map<Method, long> methods;
};

void summarise(std::ostream& out, const Job& job, const Realization& r, const Tally& tally, double seconds, const std::string& file,
               const std::string& twins) {
    const char* l = job.settings.run.length_unit.c_str();
    char line[400];
    const auto& s = r.statistics;
    out << '\n';
    std::snprintf(line, sizeof line, "%lld asperities (%lld saddles left out), %ld levels in %s\n", static_cast<long long>(s.summits),
                  static_cast<long long>(s.saddles), tally.levels, duration(seconds).c_str());
    out << line;
    if (s.m2 > 0) {
        std::snprintf(line, sizeof line, "surface: rms height %.6g %s, rms slope %.4g%s\n", s.sigma, l, std::sqrt(2 * s.m2),
                      std::sqrt(2 * s.m2) > 0.5 ? " (the theory is one of small slopes: take N and A with care)" : "");
        out << line;
    }
    out << "method:";
    for (const auto& [method, levels] : tally.methods)
        out << ' ' << kMethodNames[static_cast<std::size_t>(method)] << " (" << levels << " levels)";
    out << '\n';
    print_statuses(out, tally.statuses, tally.levels);
    if (tally.crowded_cells > 0) {
        std::snprintf(line, sizeof line,
                      "  %lld map cells (over all levels) with an area fraction above pi/16 = 19.6 %%: contacts there would merge.\n",
                      static_cast<long long>(tally.crowded_cells));
        out << line;
    }
    out << "result: " << file << '\n';
    if (!twins.empty()) out << twins << '\n';
    out << "picture: python3 output/plot/plot.py " << file << '\n';
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
    check_output(settings.output.file);
    const Contacts keep = contacts_kept(settings);
    Job job = prepare(settings);
    const int threads = static_cast<int>(thread_count(settings.run.threads));
    const OmpThreads omp(threads);
    bool terminal = false;
    std::ostream* const line_out = progress_stream(options, terminal);
    std::ostream* table = options.quiet ? nullptr : options.table;
    if (table) print_heading(*table, job);
    Tally tally;
    Realization r;
    {
        ProgressLine progress(line_out, terminal, "levels");
        r = realize(job, settings.run.first_realization, threads, [&](std::size_t k, const Level& level) {
            if (table) print_level(*table, job, k, level);
            ++tally.statuses[level.status];
            ++tally.methods[level.method];
            ++tally.levels;
            progress.show(static_cast<double>(k + 1), static_cast<double>(job.levels.size()));
            return caught_signal() == 0 && !(options.abandoned && *options.abandoned);
        });
    }
    if (const int signal = caught_signal())
        throw Interrupted(signal, std::string("stopped by ") + signal_name(signal) + "; nothing is written");
    if (options.abandoned && *options.abandoned) throw Interrupted(0, "abandoned");
    Accumulators sums(job.observe, job.levels.size());
    const RealizationRecord record = observe(job, settings.run.first_realization, r);
    for (const auto& row : record.levels) tally.crowded_cells += row.crowded_cells;
    sums.add(record);
    Result result = make_result(settings, case_text(settings), job.indenter, job.sigma, job.theory, sums.finish());
    keep_contacts(result, r.levels, keep);
    const Realization shown{r.statistics, {}, {}, {}};
    result.asperities = std::move(r.asperities);
    result.measured = job.measured;
    if (settings.output.heights) result.heights = std::move(job.given_heights ? job.given_heights : r.heights);
    write_result(result, settings.output.file, {settings.output.format, settings.output.compression, options.command});

    const std::string twins = write_twins(job, settings.output.file);

    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (table) summarise(*table, job, shown, tally, seconds, settings.output.file, twins);
    const LevelValues& last = record.levels.back();
    const RunSummary summary{tally.levels, tally.statuses[LevelStatus::not_converged], last.separation, last.force, last.area};
    tell_failed(options, summary);
    return summary;
}

}  // namespace rsc
