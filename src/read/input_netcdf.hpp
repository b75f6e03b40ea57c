// A NetCDF file open for reading, with errors that name the file and the variable. While it lives it holds library_lock(): the library
// is not made for several threads.
#pragma once

#include <netcdf.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rough/library_lock.hpp"

namespace rsc {

class NetcdfInput {
public:
    // Throws Error(bad_input) if it cannot be opened, ends before its data do, or its checksum (checksum.hpp) does not hold.
    explicit NetcdfInput(const std::string& path);
    ~NetcdfInput();
    NetcdfInput(const NetcdfInput&) = delete;
    NetcdfInput& operator=(const NetcdfInput&) = delete;

    struct Variable {
        int id = -1;
        std::string name;
        nc_type type = NC_NAT;
        std::vector<int> dimensions;       // ids
        std::vector<std::size_t> lengths;  // of the dimensions
        std::vector<std::string> axes;     // their names
        std::string shape() const;         // "name(y = 3, x = 4)"
        bool numeric() const { return type != NC_CHAR && type != NC_STRING && type <= NC_MAX_ATOMIC_TYPE; }
    };
    std::vector<Variable> variables() const;
    std::optional<Variable> find(const std::string& name) const;

    // All values of a numeric variable to out, unpacked with scale_factor and add_offset. Throws Error(bad_input) naming the
    // first that is missing or not finite, by its indices counted from 0; with `missing` these are NaN, but infinity is refused.
    void read(const Variable& variable, double* out, bool missing = false) const;

    // None where there is none; throws Error(bad_input) for one that is no text. Control characters are replaced.
    std::optional<std::string> text_attribute(const Variable& variable, const char* name) const;
    const std::string& path() const { return path_; }

private:
    void must(int status, const std::string& what) const;
    std::optional<std::vector<double>> numbers_attribute(const Variable& variable, const char* name) const;

    std::unique_lock<LibraryLock> alone_;
    std::string path_;
    int id_ = -1;
};

// Whether a file begins as NetCDF files do (classic, 64-bit, CDF-5, or HDF5 with or without a user block). Throws
// Error(bad_input) if there is no such file, it cannot be read, or it is empty.
bool is_netcdf(const std::string& path);

}  // namespace rsc
