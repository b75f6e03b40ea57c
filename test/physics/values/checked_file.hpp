// A result file of which nothing may go unchecked: variables, attributes with numbers, attributes with text.
//
// Every value is compared through same() or flags() and every number of an attribute through attribute(); finish() fails for whatever was not.
// What a variable is (dimensions, type, unit) and what its texts say stands in test/data/result_variables.txt, a line each:
//     force:shape = double(realization, step)
//     force:units = N
// with lengths in mm and forces in N; a file in other units must have these in their places. A new variable: its line there, its check here.
#pragma once

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"
#include "result_reader.hpp"

using Vector = std::vector<double>;
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// The lines of the table, and which were met.
class Descriptions {
public:
    explicit Descriptions(const std::string& path) {
        std::ifstream in(path);
        CHECK(in.good());
        for (std::string line; std::getline(in, line);)
            if (!line.empty() && line[0] != '#') met_[line] = false;
    }
    void meet(const std::string& line) {
        const auto found = met_.find(line);
        if (found == met_.end()) {
            std::printf("%s\n", line.c_str());
            check::that(false, "the line above stands in test/data/result_variables.txt", __FILE__, __LINE__);
            met_[line] = true;
        } else {
            found->second = true;
        }
    }
    // Whether a variable or an attribute has a value in the file that is neither 0 nor absent.
    void meet_value(const std::string& variable, bool any) { has_value_[variable] = has_value_[variable] || any; }
    // Every line was met in some file, and so was a value of everything.
    void finish() const {
        for (const auto& [variable, any] : has_value_) {
            if (!any) std::printf("%s\n", variable.c_str());
            check::that(any, "the variable above has a value in some file", __FILE__, __LINE__);
        }
        for (const auto& [line, met] : met_) {
            if (!met) std::printf("%s\n", line.c_str());
            check::that(met, "the line above of test/data/result_variables.txt is met in a file", __FILE__, __LINE__);
        }
    }

private:
    std::map<std::string, bool> met_, has_value_;
};

class CheckedFile {
public:
    // `name` says in messages which file it is.
    CheckedFile(std::string name, const std::string& path, std::string length_unit, std::string force_unit)
        : name_(std::move(name)), file_(path), length_(std::move(length_unit)), force_(std::move(force_unit)) {}

    const Reader& reader() const { return file_; }
    bool has(const std::string& variable) const { return file_.has(variable); }
    // Absent values are NaN.
    Vector values(const std::string& variable) const {
        Vector v = file_.values(variable);
        for (double& x : v)
            if (x == NC_FILL_DOUBLE) x = kNone;
        return v;
    }

    // The variable is `expected`, to `relative` of each value or `absolute`, the coarser; NaN: absent.
    void same(const std::string& variable, const Vector& expected, double relative = 0, double absolute = 0) {
        checked_.insert(variable);
        if (!has(variable)) return failed(variable, "is missing");
        compare(variable, values(variable), expected, relative, absolute);
    }
    void attribute(const std::string& variable, const std::string& attribute, Vector expected, double relative = 0, double absolute = 0) {
        const std::string both = variable + ":" + attribute;
        checked_.insert(both);
        Vector there = file_.numbers(variable, attribute);
        for (double& x : there)
            if (x == NC_FILL_DOUBLE) x = kNone;
        compare(both, there, expected, relative, absolute);
    }
    // Numbers that were compared elsewhere.
    void attribute_was_checked(const std::string& variable, const std::string& attribute) { checked_.insert(variable + ":" + attribute); }
    void text(const std::string& variable, const std::string& attribute, const std::string& expected) {
        checked_.insert(variable + ":" + attribute);
        if (file_.text(variable, attribute) != expected)
            failed(variable + ":" + attribute, ("is '" + file_.text(variable, attribute) + "', expected '" + expected + "'").c_str());
    }

    // Everything there was checked, and described as the table says.
    void finish(Descriptions& descriptions) {
        int variables = 0;
        nc_inq_nvars(file_.id(), &variables);
        for (int v = NC_GLOBAL; v < variables; ++v) finish(v, descriptions);
        for (int v = 0; v < variables; ++v) stored(v);
    }

private:
    // Large arrays of netCDF-4 are compressed, at the default level, but not those whose digits have no order: of asperities and contacts.
    void stored(int v) const {
        char name[NC_MAX_NAME + 1] = "";
        int format = 0, shuffled = 0, deflated = 0, level = 0;
        nc_inq_varname(file_.id(), v, name);
        nc_inq_format(file_.id(), &format);
        if (format == NC_FORMAT_NETCDF4_CLASSIC) nc_inq_var_deflate(file_.id(), v, &shuffled, &deflated, &level);
        const std::string first = file_.dimensions(name).empty() ? "" : file_.dimensions(name)[0];
        const bool large = format == NC_FORMAT_NETCDF4_CLASSIC && file_.values(name).size() >= 2048;
        if (level != (large && first != "asperity" && first != "contact" ? 4 : 0))
            failed(name, ("has level " + std::to_string(level) + " of compression").c_str());
    }
    void failed(const std::string& what, const char* how) const {
        std::printf("%s, %s: ", name_.c_str(), what.c_str());
        check::that(false, how, __FILE__, __LINE__);
    }
    void compare(const std::string& what, const Vector& there, const Vector& expected, double relative, double absolute) const {
        if (there.size() != expected.size()) return failed(what, ("has " + std::to_string(there.size()) + " values").c_str());
        for (std::size_t k = 0; k < there.size(); ++k) {
            const double allowed = std::max(relative * std::abs(expected[k]), absolute);
            const bool equal = std::isnan(expected[k]) ? std::isnan(there[k]) : std::abs(there[k] - expected[k]) <= allowed;
            ++check::checks;
            if (equal) continue;
            char text[200];
            std::snprintf(text, sizeof text, "value %zu of %zu is %.17g, expected %.17g, allowed error %.3g", k + 1, there.size(), there[k],
                          expected[k], allowed);
            return failed(what, text);
        }
    }
    // Lengths in mm, forces in N.
    std::string in_table_units(const std::string& variable, std::string units) const {
        std::string out;
        for (std::size_t at = 0; at < units.size();) {
            const std::size_t end = std::min(units.find(' ', at), units.size());
            const std::string token = units.substr(at, end - at);
            const std::size_t letters = std::min(token.find_first_of("-0123456789"), token.size());
            std::string symbol = token.substr(0, letters);
            if ((symbol == "mm" && length_ != "mm") || (symbol == "N" && force_ != "N"))
                failed(variable, ("is in " + units + " whatever the units of the case").c_str());
            if (symbol == length_) symbol = "mm";
            if (symbol == force_) symbol = "N";
            out += (out.empty() ? "" : " ") + symbol + token.substr(letters);
            at = end + 1;
        }
        return out;
    }
    void finish(int v, Descriptions& descriptions) {
        std::string variable;
        int attributes = 0;
        if (v == NC_GLOBAL) {
            nc_inq_natts(file_.id(), &attributes);
        } else {
            char name[NC_MAX_NAME + 1] = "";
            nc_type type = NC_NAT;
            nc_inq_var(file_.id(), v, name, &type, nullptr, nullptr, &attributes);
            variable = name;
            std::string shape;
            for (const std::string& d : file_.dimensions(variable)) shape += (shape.empty() ? "" : ", ") + d;
            descriptions.meet(variable + ":shape = " + (type == NC_DOUBLE ? "double(" : type == NC_INT ? "int(" : "?(") + shape + ")");
            if (!checked_.count(variable)) failed(variable, "its values are checked by nothing");
            const Vector v = values(variable);
            descriptions.meet_value(variable, std::any_of(v.begin(), v.end(), [](double x) { return x != 0 && !std::isnan(x); }));
        }
        for (int a = 0; a < attributes; ++a) {
            char name[NC_MAX_NAME + 1] = "";
            nc_type type = NC_NAT;
            nc_inq_attname(file_.id(), v, a, name);
            nc_inq_atttype(file_.id(), v, name, &type);
            const std::string both = variable + ":" + name;
            if (type == NC_DOUBLE && std::string(name) != "_FillValue") {
                const Vector v = file_.numbers(variable, name);
                descriptions.meet_value(both, std::any_of(v.begin(), v.end(), [](double x) { return x != 0 && x != NC_FILL_DOUBLE; }));
            }
            if (checked_.count(both)) continue;
            if (type == NC_CHAR) {
                const std::string text = file_.text(variable, name);
                descriptions.meet(both + " = " + (std::string(name) == "units" ? in_table_units(variable, text) : text));
            } else if (std::string(name) == "_FillValue") {
                if (file_.numbers(variable, name) != Vector{NC_FILL_DOUBLE}) failed(both, "is another");
                if (file_.text(variable, "comment").find("_FillValue: absent") == std::string::npos) failed(both, "is not explained");
            } else {
                failed(both, "its numbers are checked by nothing");
            }
        }
    }

    std::string name_;
    Reader file_;
    std::string length_, force_;
    std::set<std::string> checked_;
};
