// What a run shows: the table of levels, the closing summary, the progress line.
#pragma once

#include <chrono>
#include <ostream>
#include <span>
#include <string>

#include "contact/level.hpp"
#include "run/job.hpp"

namespace rsc {

std::string status_text(LevelStatus status);

// The title, the bodies, and what theory says of the surface.
void print_case(std::ostream& out, const Job& job);

// What was done to a measured map, if there is one.
void print_measured(std::ostream& out, const Job& job);

// print_case, print_measured and the column heads; then a line a level.
void print_heading(std::ostream& out, const Job& job);
void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level);

// The methods the levels were solved with, and why others than asked for; how often each status came, with what it means and what to do;
// what else to be wary of.
void print_remarks(std::ostream& out, std::span<const LevelValues> levels, const Job& job);

// What an rms slope means for the results; empty for the small ones that the theory is for.
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

}  // namespace rsc
