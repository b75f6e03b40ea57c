// A result file whose values are compared with what a test computes: variables, attributes that are
// numbers or text.
#pragma once

#include <netcdf.h>

#include "check.hpp"
#include "support/result_reader.hpp"

using Vector = std::vector<double>;
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class CheckedFile {
public:
    // `name` says in messages which file it is.
    CheckedFile(std::string name, const std::string& path) : name_(std::move(name)), file_(path) {}

    const Reader& reader() const { return file_; }
    bool has(const std::string& variable) const { return file_.has(variable); }
    // Absent values are NaN.
    Vector values(const std::string& variable) const {
        Vector v = file_.values(variable);
        for (double& x : v)
            if (x == NC_FILL_DOUBLE) x = kNone;
        return v;
    }

    // The variable is `expected`, to `relative` of each value or `absolute`, the coarser; NaN:
    // absent.
    void same(const std::string& variable, const Vector& expected, double relative = 0,
              double absolute = 0) {
        if (!has(variable)) return failed(variable, "is missing");
        compare(variable, values(variable), expected, relative, absolute);
    }
    void attribute(const std::string& variable, const std::string& attribute, Vector expected,
                   double relative = 0, double absolute = 0) {
        const std::string both = variable + ":" + attribute;
        Vector there = file_.numbers(variable, attribute);
        for (double& x : there)
            if (x == NC_FILL_DOUBLE) x = kNone;
        compare(both, there, expected, relative, absolute);
    }

    // Large arrays of netCDF-4 are compressed, the others not.
    void finish() const {
        int variables = 0;
        nc_inq_nvars(file_.id(), &variables);
        for (const int v : indices(variables)) stored(v);
    }

private:
    // Large arrays of netCDF-4 are compressed, at the default level, but not those whose digits
    // have no order: of asperities and contacts.
    void stored(int v) const {
        char name[NC_MAX_NAME + 1] = "";
        int format = 0, shuffled = 0, deflated = 0, level = 0;
        nc_inq_varname(file_.id(), v, name);
        nc_inq_format(file_.id(), &format);
        if (format == NC_FORMAT_NETCDF4_CLASSIC)
            nc_inq_var_deflate(file_.id(), v, &shuffled, &deflated, &level);
        const std::string first = file_.dimensions(name).empty() ? "" : file_.dimensions(name)[0];
        const bool large = format == NC_FORMAT_NETCDF4_CLASSIC && file_.values(name).size() >= 2048;
        if (level != (large && first != "asperity" && first != "contact" ? 4 : 0))
            failed(name, ("has level " + std::to_string(level) + " of compression").c_str());
    }
    void failed(const std::string& what, const char* how) const {
        std::printf("%s, %s: ", name_.c_str(), what.c_str());
        check::that(false, how, __FILE__, __LINE__);
    }
    void compare(const std::string& what, const Vector& there, const Vector& expected,
                 double relative, double absolute) const {
        if (there.size() != expected.size())
            return failed(what, ("has " + std::to_string(there.size()) + " values").c_str());
        for (const auto k : indices(there)) {
            const double allowed = std::max(relative * std::abs(expected[k]), absolute);
            const bool equal = std::isnan(expected[k])
                                   ? std::isnan(there[k])
                                   : std::abs(there[k] - expected[k]) <= allowed;
            ++check::checks;
            if (equal) continue;
            char text[200];
            std::snprintf(text, sizeof text,
                          "value %zu of %zu is %.17g, expected %.17g, allowed error %.3g", k + 1,
                          there.size(), there[k], expected[k], allowed);
            return failed(what, text);
        }
    }
    std::string name_;
    Reader file_;
};
