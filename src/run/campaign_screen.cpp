#include "run/campaign_screen.hpp"

#include <algorithm>
#include <cmath>

#include "format.hpp"
#include "run/screen.hpp"

namespace rsc {
namespace {

// Steps of the table: about ten, the first and the last among them.
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
    out << format("%d realizations of %zu levels, %zu at a time", run.realizations, job.levels.size(), workers);
    if (done > 0) out << format("; %zu of them are done", done);
    out << "\n\nMeans over the realizations so far at the last level; scatter is the standard deviation of one realization.\n"
        << format("%12s %14s %10s %14s %10s %12s %10s\n", "realizations", format("N [%s]", run.force_unit.c_str()).c_str(), "scatter",
                  format("A [%s2]", run.length_unit.c_str()).c_str(), "scatter", "elapsed", "a second")
        << std::flush;
}

void print_batch(std::ostream& out, const Job&, const Accumulators& sums, double seconds, std::size_t done_in_this_run) {
    const std::size_t count = sums.realization.size();
    Observations last;  // the last level of each
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
    summary.levels = static_cast<long>(o.rows.size() + result.compared.step.size());
    summary.failed = result.compared.failed;
    for (const LevelValues& row : o.rows)
        if (row.status == LevelStatus::not_converged) ++summary.failed;
    summary.separation = o.separation.mean.back();
    summary.force = o.force.mean.back();
    summary.area = o.area.mean.back();
    return summary;
}

}  // namespace rsc
