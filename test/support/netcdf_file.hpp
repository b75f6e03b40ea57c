// NetCDF files of any content, written through the C library: what the readers are tested with.
#pragma once

#include <netcdf.h>

#include "check.hpp"

namespace netcdf_file {

inline void ok(int status) {
    if (status != NC_NOERR) std::printf("NetCDF: %s\n", nc_strerror(status));
    CHECK(status == NC_NOERR);
}

// A variable over named dimensions, with text and number attributes (doubles, but a fill value of
// the variable's type); without values: not written.
struct Variable {
    std::string name;
    nc_type type;
    std::vector<std::string> dimensions;
    std::vector<double> values = {};
    std::vector<std::pair<std::string, std::string>> texts = {};
    std::vector<std::pair<std::string, std::vector<double>>> numbers = {};
};
using Dimensions = std::vector<std::pair<std::string, std::size_t>>;

// Writes the file; returns its path. Of no length: without limit.
inline std::string write(const std::string& path, const Dimensions& dimensions,
                         const std::vector<Variable>& variables, int format = NC_NETCDF4) {
    int id = -1;
    ok(nc_create(path.c_str(), NC_CLOBBER | format, &id));
    std::map<std::string, std::pair<int, std::size_t>> of;
    for (const auto& [name, length] : dimensions) {
        of[name].second = length;
        ok(nc_def_dim(id, name.c_str(), length > 0 ? length : NC_UNLIMITED, &of[name].first));
    }
    for (const Variable& v : variables) {
        std::vector<int> ids;
        for (const std::string& d : v.dimensions) ids.push_back(of.at(d).first);
        int variable = -1;
        ok(nc_def_var(id, v.name.c_str(), v.type, int(ids.size()), ids.data(), &variable));
        for (const auto& [key, text] : v.texts)
            ok(nc_put_att_text(id, variable, key.c_str(), text.size(), text.c_str()));
        for (const auto& [key, n] : v.numbers)
            ok(nc_put_att_double(id, variable, key.c_str(),
                                 key == "_FillValue" ? v.type : NC_DOUBLE, n.size(), n.data()));
    }
    ok(nc_enddef(id));
    for (const auto k : indices(variables))
        if (!variables[k].values.empty())
            ok(nc_put_var_double(id, int(k), variables[k].values.data()));
    ok(nc_close(id));
    return path;
}

inline std::vector<double> counted(std::size_t n, double first, double step) {
    std::vector<double> v;
    for (const std::size_t k : indices(n)) v.push_back(first + double(k) * step);
    return v;
}

}  // namespace netcdf_file
