#include "run/run.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "error.hpp"
#include "observe/regimes.hpp"
#include "run/job.hpp"
#include "run/netcdf_file.hpp"
#include "run/netcdf_writer.hpp"
#include "run/screen.hpp"

namespace rsc {
namespace {

// What the levels add up to, for the summary.
struct Tally {
    std::map<LevelStatus, long> statuses;
    long levels = 0;
    std::int64_t crowded_cells = 0;
    std::map<Method, long> methods;
};

void summarise(std::ostream& out, const Job& job, const Realization& r, const Tally& tally, double seconds, const std::string& file) {
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
    for (const auto& [method, levels] : tally.methods) out << ' ' << method_name(method) << " (" << levels << " levels)";
    out << '\n';
    print_statuses(out, tally.statuses, tally.levels);
    if (tally.crowded_cells > 0) {
        std::snprintf(line, sizeof line, "  %lld map cells (over all levels) with an area fraction above pi/16 = 19.6 %%: contacts there would merge.\n",
                      static_cast<long long>(tally.crowded_cells));
        out << line;
    }
    out << "result: " << file << '\n';
    out << "picture: python3 output/plot/plot.py " << file << '\n';
}

}  // namespace

long run_case(const Case& settings, const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    check_output(settings.output.file);
    const Contacts keep = contacts_kept(settings);
    Job job = prepare(settings);
    // On a terminal a line that is drawn over, unless the table scrolls there; `always` gives a line now and then elsewhere too.
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const bool scrolls = options.table && !options.quiet && isatty(STDOUT_FILENO) != 0;
    const bool show = options.progress == Progress::always || (options.progress == Progress::automatic && terminal && !scrolls);
    std::ostream* line_out = show ? options.messages : nullptr;

    std::ostream* table = options.quiet ? nullptr : options.table;
    if (table) print_heading(*table, job);
    Tally tally;
    Realization r;
    {
        ProgressLine progress(line_out, terminal, "levels");
        r = realize(job, settings.run.first_realization, settings.run.threads, [&](std::size_t k, const Level& level) {
            if (table) print_level(*table, job, k, level);
            ++tally.statuses[level.status];
            ++tally.methods[level.method];
            ++tally.levels;
            progress.show(static_cast<double>(k + 1), static_cast<double>(job.levels.size()));
            return true;
        });
    }
    Accumulators sums(job.observe, job.levels.size());
    const RealizationRecord record = observe(job, settings.run.first_realization, r);
    for (const auto& row : record.levels) tally.crowded_cells += row.crowded_cells;
    sums.add(record);
    Result result = make_result(settings, options.case_text, job.indenter, job.sigma, job.theory, sums.finish());
    keep_contacts(result, r.levels, keep);
    const Realization shown{r.statistics, {}, {}, {}, {}};
    result.asperities = std::move(r.asperities);
    if (settings.output.heights) result.heights = std::move(job.given_heights ? job.given_heights : r.heights);
    write_result(result, settings.output.file, {settings.output.format, settings.output.compression, options.command});

    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (table) summarise(*table, job, shown, tally, seconds, settings.output.file);
    const long failed = tally.statuses[LevelStatus::not_converged];
    if (failed > 0 && options.messages) {
        *options.messages << "rsc: " << failed << " of " << tally.levels
                          << " levels did not converge; their values are in the file with status = 4. Raise solver%max_iterations or "
                             "solver%tolerance.\n";
    }
    return failed;
}

}  // namespace rsc
