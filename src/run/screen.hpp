// Output on the screen: the table of levels, the closing summary, the progress line.
#pragma once

#include "contact/level.hpp"
#include "observe/record.hpp"
#include "run/job.hpp"
#include "run/run.hpp"

namespace rsc {

std::string status_text(LevelStatus status);

// The title, the bodies, and what theory says of the surface.
void print_case(std::ostream& out, const Job& job);

// The treatment of a measured map, if there is one.
void print_measured(std::ostream& out, const Job& job);

// print_case, print_measured and the column heads; then a line a level.
void print_heading(std::ostream& out, const Job& job);
void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level);

// The methods the levels were solved with, and why others than asked for; how often each status came, with what it means and what to do;
// what else to be wary of.
void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job);

// A remark on rms slopes too large for the theory; empty for small ones.
const char* slope_remark(double rms_slope);

// The last lines: the file written, whether it took the place of another result, and how to see it.
void print_result(std::ostream& out, const std::string& file, bool replaces);

// "12.3 s", "4 min 10 s", ...
std::string duration(double seconds);

// A line on a terminal that is written over, with rate and time left; on other streams a line now and then.
class ProgressLine {
public:
    // `out` null: silent. `terminal`: redraw in place. `already`: how much an earlier run has done; it says nothing of the rate.
    ProgressLine(std::ostream* out, bool terminal, const char* unit, double already = 0);
    ~ProgressLine();  // wipes the line
    void show(double done, double total);
    void wipe();  // before something else is printed to the same terminal

private:
    using Clock = std::chrono::steady_clock;
    std::ostream* out_;
    bool terminal_, drawn_ = false;
    const char* unit_;
    double already_;
    Clock::time_point start_, last_;
};

// A campaign on stdout: a line for each batch of realizations, and at the end the mean curve with its scatter.

// The case, how many realizations by how many workers, the column heads. `done` of them are there from an interrupted run.
void print_campaign_heading(std::ostream& out, const Job& job, std::size_t workers, std::size_t done);

// Means and scatter (standard deviation of a realization) of the last level over the realizations so far.
void print_batch(std::ostream& out, const Job& job, const Accumulators& sums, double seconds, std::size_t done_in_this_run);

// The mean curve, statuses, what to be wary of, the file.
void print_campaign_summary(std::ostream& out, const Job& job, const Observations& observations, double seconds, const std::string& file,
                            bool replaces);

RunSummary campaign_summary(const Result& result);

}  // namespace rsc
