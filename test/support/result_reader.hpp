// A result file read back through the NetCDF library: values by name, attributes, dimensions.
#pragma once

#include <netcdf.h>

#include "check.hpp"

// Reading through the C library, failures counted as failed checks.
class Reader {
public:
    explicit Reader(const std::string& path) {
        CHECK(nc_open(path.c_str(), NC_NOWRITE, &id_) == NC_NOERR);
    }
    ~Reader() { nc_close(id_); }
    int id() const { return id_; }
    bool has(const std::string& name) const {
        int v = 0;
        return nc_inq_varid(id_, name.c_str(), &v) == NC_NOERR;
    }
    int var(const std::string& name) const {
        int v = -1;
        const bool found = nc_inq_varid(id_, name.c_str(), &v) == NC_NOERR;
        if (!found) std::printf("missing variable %s\n", name.c_str());
        CHECK(found);
        return v;
    }
    std::vector<std::string> dimensions(const std::string& name) const {
        int n = 0;
        std::array<int, NC_MAX_VAR_DIMS> ids{};
        nc_inq_var(id_, var(name), nullptr, nullptr, &n, ids.data(), nullptr);
        std::vector<std::string> names;
        for (const int d : indices(n)) {
            char text[NC_MAX_NAME + 1] = "";
            nc_inq_dimname(id_, ids[d], text);
            names.emplace_back(text);
        }
        return names;
    }
    std::vector<double> values(const std::string& name) const {
        std::size_t size = 1;
        for (const std::string& d : dimensions(name)) {
            int dim = 0;
            std::size_t n = 0;
            nc_inq_dimid(id_, d.c_str(), &dim);
            nc_inq_dimlen(id_, dim, &n);
            size *= n;
        }
        std::vector<double> out(size);
        CHECK(nc_get_var_double(id_, var(name), out.data()) == NC_NOERR);
        return out;
    }
    std::string text(const std::string& name, const std::string& attribute) const {
        const int v = name.empty() ? NC_GLOBAL : var(name);
        nc_type type = NC_NAT;
        std::size_t n = 0;
        if (nc_inq_att(id_, v, attribute.c_str(), &type, &n) != NC_NOERR || type != NC_CHAR)
            return "";
        std::string out(n, ' ');
        nc_get_att_text(id_, v, attribute.c_str(), out.data());
        return out;
    }
    std::vector<double> numbers(const std::string& name, const std::string& attribute) const {
        const int v = name.empty() ? NC_GLOBAL : var(name);
        std::size_t n = 0;
        if (nc_inq_attlen(id_, v, attribute.c_str(), &n) != NC_NOERR) return {};
        std::vector<double> out(n);
        nc_get_att_double(id_, v, attribute.c_str(), out.data());
        return out;
    }

private:
    int id_ = -1;
};
