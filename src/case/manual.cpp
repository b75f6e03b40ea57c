#include "case/manual.hpp"

#include <sstream>
#include <string_view>

#include "case/options.hpp"
#include "case/registry.hpp"
#include "version.h"

namespace rsc {
namespace {

// Text as roff takes it for text: no command at the start of a line, hyphens that can be copied.
std::string escaped(std::string_view text) {
    std::string result;
    if (!text.empty() && (text.front() == '.' || text.front() == '\'')) result = "\\&";
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

// The lines of usage_text() between the first and the last are options, told from column 35 on.
void write_options(std::ostream& out) {
    constexpr std::size_t column = 35;
    std::istringstream lines(usage_text());
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  ") || line.size() <= column) continue;
        const std::string_view all = line;
        out << ".TP\n.B " << escaped(trimmed(all.substr(0, column))) << '\n' << escaped(trimmed(all.substr(column))) << '\n';
    }
}

// A group as describe() tells it: a line of two blanks begins a key, deeper ones explain it.
void write_group(std::ostream& out, std::string_view group) {
    out << ".SS " << escaped("&" + std::string(group)) << '\n' << escaped(group_meaning(group)) << '\n';
    std::istringstream lines(describe(group));
    std::string line;
    std::getline(lines, line);  // the group's own
    bool first = false;
    while (std::getline(lines, line)) {
        if (line.starts_with("      ")) {
            out << (first ? "" : ".br\n") << escaped(trimmed(line)) << '\n';
            first = false;
        } else {
            out << ".TP\n.B " << escaped(trimmed(line)) << '\n';
            first = true;
        }
    }
}

}  // namespace

std::string manual_page() {
    std::ostringstream out;
    out << ".TH RSC 1 \"\" \"rsc " RSC_VERSION
           "\"\n"
           ".SH NAME\nrsc \\- elastic contact of rough spheres by a deterministic multi\\-asperity model\n"
           ".SH SYNOPSIS\n.B rsc\n.RI [ options ]\n.B <\n.I case.nml\n.br\n.B rsc\n.RI [ options ]\n.I case.nml\n"
           ".SH DESCRIPTION\nA case in Fortran namelist input says which surfaces are pressed on each other, and how; the force, the true "
           "contact area, every contact, maps, radial profiles and distributions go to a NetCDF file whose variables explain themselves "
           "(ncdump \\-h). A line a level is printed.\n"
           ".SH OPTIONS\n";
    write_options(out);
    out << ".SH EXIT STATUS\n.TP\n.B 0\nDone.\n.TP\n.B 1\nRan and failed: a level did not converge, the disk is full.\n.TP\n.B 2\nRefused "
           "before running: wrong usage or case, unreadable input.\n.TP\n.B 130, 143\nStopped by SIGINT or SIGTERM; "
           "\\-\\-resume goes on.\n.SH CASES\nEvery key has a default; any case, comments with !, repeat counts and nulls as in Fortran. What is "
           "wrong is said with file, line and column, all of it at once.\n";
    for (const std::string_view group : group_names()) write_group(out, group);
    out << ".SH EXAMPLE\n.nf\n&surface     sigma = 0.01  L_lambda_s = 512  n = 2048 /\n&indentation start = 4, stop = 1, steps = 100 /\n"
           "&output      file = 'mine.nc' /\n.fi\n.SH SEE ALSO\n.BR ncdump (1).\nV. A. Yastrebov, The Elastic Contact of Rough Spheres Investigated "
           "Using a Deterministic Multi\\-Asperity Model, Journal of Multiscale Modelling (2018).\n";
    return out.str();
}

}  // namespace rsc
