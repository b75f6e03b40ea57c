#include "run/screen.hpp"

#include <cctype>
#include <cmath>
#include <cstdio>

#include "case/units.hpp"
#include "observe/quantities.hpp"
#include "observe/regimes.hpp"

namespace rsc {
namespace {

template <class... Args>
std::string format(const char* text, Args... args) {
    char buffer[400];
    std::snprintf(buffer, sizeof buffer, text, args...);
    return buffer;
}

}  // namespace

std::string status_text(LevelStatus status) {
    std::string text = kLevelStatusNames[static_cast<std::size_t>(status)];
    for (char& c : text) {
        if (c == '_') c = ' ';
        if (status == LevelStatus::not_converged) c = static_cast<char>(std::toupper(c));
    }
    return text;
}

void print_case(std::ostream& out, const Job& job) {
    const auto& run = job.settings.run;
    const char* l = run.length_unit.c_str();
    const char* f = run.force_unit.c_str();
    if (!run.title.empty()) out << run.title << '\n';
    out << format("sphere R = %g %s on a rough half-space, E* = %g %s/%s2, sigma = %g %s\n", job.indenter.R, l, job.indenter.E_star, f, l,
                  job.sigma, l);
    if (job.theory) {
        const Moments& m = *job.theory;
        out << format("theory: rms slope %.4g, Nayak parameter %.4g, summit density %.5g 1/%s2, r_g %.4g %s, transition force N* %.5g %s\n",
                      m.rms_slope(), m.nayak(), m.summit_density(), l, m.mean_radius(), l, transition_force(m, job.indenter.E_star), f);
    }
}

// What was done to a measured map; of several, to the first.
void print_measured(std::ostream& out, const Job& job) {
    if (!job.measured) return;
    if (!job.given) out << "the first of the maps:\n";
    for (const std::string& line : told(*job.measured, job.settings.run.length_unit)) out << line << '\n';
}

// The columns after the first three are the level's declared quantities (observe/quantities.hpp).
void print_heading(std::ostream& out, const Job& job) {
    print_case(out, job);
    print_measured(out, job);
    const std::string l = job.settings.run.length_unit, f = job.settings.run.force_unit;
    out << format("\n%5s %12s %9s", "level", format("Z0 [%s]", l.c_str()).c_str(), "Z0/sigma");
    for (const LevelQuantity& q : level_quantities()) {
        if (!q.heading) continue;
        std::string heading = q.heading;
        if (q.length_power != 0 || q.force_power != 0) heading += " [" + unit_of(l, q.length_power, f, q.force_power) + "]";
        out << format(" %*s", q.width, heading.c_str());
    }
    out << '\n';
}

void print_level(std::ostream& out, const Job& job, std::size_t number, const Level& level) {
    out << format("%5zu %12.6g %9.5f", number + 1, level.separation, level.separation / job.sigma);
    for (const LevelQuantity& q : level_quantities()) {
        if (!q.heading) continue;
        if (std::holds_alternative<LevelStatus LevelValues::*>(q.member))
            out << "  " << status_text(level.status);
        else if (q.integer())
            out << format(" %*.0f", q.width, q.of(level));
        else if (q.digits > 0)
            out << format(" %*.*g", q.width, q.digits, q.of(level));
        else
            out << format(" %*.1e", q.width, q.of(level));
    }
    out << '\n';
}

void print_statuses(std::ostream& out, const std::map<LevelStatus, long>& counts, long levels) {
    const auto tell = [&](LevelStatus status, const char* meaning) {
        const auto found = counts.find(status);
        if (found == counts.end() || found->second == 0) return;
        out << format("  %ld of %ld levels: %s - %s\n", found->second, levels, status_text(status).c_str(), meaning);
    };
    tell(
        LevelStatus::out_of_validity,
        "contacts with a > <d>/4, a quarter of the mean spacing of summits, or pressed beyond what the law knows of a summit (beyond_law in "
        "the file): the asperity model is leaving its range.");
    tell(LevelStatus::overlapping,
         "pairs of contact spots nearer than the sum of their radii: asperities that would merge are counted as two.");
    tell(
        LevelStatus::not_unique,
        "spots so deep in each other that other solutions may exist: the one given is a local minimum of the energy, reached by a fixed rule.");
    tell(LevelStatus::not_converged,
         "the residual is above solver%tolerance: do not use these values; raise solver%max_iterations or the tolerance.");
}

std::string duration(double seconds) {
    if (seconds < 1) return format("%.0f ms", 1000 * seconds);
    if (seconds < 100) return format("%.1f s", seconds);
    if (seconds < 5400) return format("%d min %02d s", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
    return format("%d h %02d min", static_cast<int>(seconds / 3600), static_cast<int>(seconds / 60) % 60);
}

ProgressLine::ProgressLine(std::ostream* out, bool terminal, const char* unit, double already)
    : out_(out), terminal_(terminal), unit_(unit), already_(already), start_(Clock::now()), last_(start_) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
    if (drawn_ && terminal_) *out_ << "\r\033[K" << std::flush;
    drawn_ = false;
}

void ProgressLine::show(double done, double total) {
    if (!out_) return;
    const auto now = Clock::now();
    const double since = std::chrono::duration<double>(now - last_).count(), spent = std::chrono::duration<double>(now - start_).count();
    if (since < (terminal_ ? 0.1 : 30.0)) return;
    last_ = now;
    drawn_ = true;
    const double rate = (done - already_) / spent;
    const std::string left = rate > 0 ? format("%.3g a second, ", rate) + duration((total - done) / rate) + " left" : "";
    if (terminal_) {
        constexpr int width = 30;
        const int filled = static_cast<int>(width * done / total);
        *out_ << "\r[" << std::string(static_cast<std::size_t>(filled), '#') << std::string(static_cast<std::size_t>(width - filled), '.')
              << format("] %.0f/%.0f %s, %s\033[K", done, total, unit_, left.c_str()) << std::flush;
    } else {
        *out_ << format("rsc: %.0f of %.0f %s, %s\n", done, total, unit_, left.c_str()) << std::flush;
    }
}

}  // namespace rsc
