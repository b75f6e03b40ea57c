// Output on the screen: the table of levels, the closing summary, the progress line.
#pragma once

#include "contact/level.hpp"
#include "observe/record.hpp"
#include "problem/job.hpp"
#include "run/run.hpp"

namespace rsc {

// Of a case.
struct UnitNames {
    const char *length, *force, *time;
};
inline UnitNames units_of(const Job& job) {
    const Case::Run& run = job.settings.run;
    return {run.length_unit.c_str(), run.force_unit.c_str(), run.time_unit.c_str()};
}

std::string name_of(Method method);
const char* fallback_text(
    Fallback fallback);  // why another method solved the level than the one asked for; empty: none

// The title, the bodies, the theoretical properties or the treatment of the surface, and the column
// heads; then one line for each level.
void print_heading(std::ostream& out, const Job& job);
void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level);

// Methods of the levels with reasons for fallbacks; number of levels, meaning and remedy of each
// status; warnings. `curves`: those of all levels of a single realization.
void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job,
                   std::span<const double> curves = {});

// A remark on rms slopes too large for the theory; empty for small ones.
const char* slope_remark(double rms_slope);

// Reports synthetic surfaces that miss the skewness or kurtosis asked for.
void tell_unreached_heights(std::ostream& out, std::span<const SurfaceStatistics> surfaces,
                            const Job& job);

// The last lines: the result file, a note if it replaced another one, and the command for pictures.
void print_result(std::ostream& out, const std::string& file, bool replaces);

// A path as a word of a shell command, in quotes if it needs them.
std::string shell_word(const std::string& path);

// The running program as a shell command: its path, or `rsc` where a library runs.
std::string program_command();

// One unit of pressure of a case in Pa; 0: its units are not known.
double pascals(const Case& settings);

// "12.3 s", "4 min 10 s", ...
std::string duration(double seconds);

// Progress with rate and remaining time: a line that is redrawn on a terminal, a line every 30 s on
// other streams. Without such a line the remaining time is said once, after the first step.
class ProgressLine {
public:
    // On options.messages, as options.progress says. `already`: done by an earlier run, not
    // included in the rate; `scrolls`: with Progress::automatic there is no line.
    ProgressLine(const RunOptions& options, const char* unit, double already = 0,
                 bool scrolls = false);
    ~ProgressLine();  // erases the line
    void show(double done, double total);
    void wipe();  // before other output to the same terminal

private:
    using Clock = std::chrono::steady_clock;
    std::ostream* out_ = nullptr;       // null: no output
    std::ostream* messages_ = nullptr;  // until the time of the rest was said once
    bool terminal_, drawn_ = false;
    const char* unit_;
    double already_;
    Clock::time_point start_, last_;
};

// A campaign on stdout: a line for each batch of realizations, and at the end the mean curve with
// its scatter.

// Prints the case, the numbers of realizations and workers, and the column heads. `done`:
// realizations of an interrupted run.
void print_campaign_heading(std::ostream& out, const Job& job, std::size_t workers,
                            std::size_t done);

// Prints means and scatter (standard deviation of one realization) of the last level over the
// realizations so far.
void print_batch(std::ostream& out, const Job& job, const Accumulators& sums, double seconds,
                 std::size_t done_in_this_run);

// Prints the mean curve, statuses, warnings and the name of the file.
void print_campaign_summary(std::ostream& out, const Job& job, const Observations& observations,
                            double seconds, const std::string& file, bool replaces);

}  // namespace rsc
