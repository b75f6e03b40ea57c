// Reading NetCDF files: their checksum, their length, their variables.
#pragma once

#include <netcdf.h>

#include "rough/library_lock.hpp"

namespace rsc {

// The checksum of result files: a last line of text behind what NetCDF and HDF5 know of, "\nrsc: CRC-32 of all before this line: 0a1b2c3d\n".
// It is checked before these libraries open the file: HDF5 crashes on some damaged ones, and classic files have no checksums of their own.

// That line for the `size` bytes of a file.
std::string checksum_line(const char* bytes, std::size_t size);

// Throws Error(bad_input) for a file with such a line whose bytes are not those it was made for. Files without one pass: those of earlier versions
// and of other programs.
void require_sound(const std::string& path);

// The length a NetCDF file of the classic formats must have.

// Reads the header of a classic, 64-bit offset or CDF-5 file and throws Error(bad_input) if the file ends before the header or
// the data it announces: the NetCDF library gives zeros or worse there without a word. Does nothing with other files.
void check_classic_length(const std::string& path);

// A NetCDF file open for reading, with errors that name the file and the variable. While it lives it holds library_lock(): the library
// is not made for several threads.
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

// True if the first bytes are those of a NetCDF file (classic, 64-bit, CDF-5, or HDF5 with or without a user block). Throws
// Error(bad_input) if there is no such file, it cannot be read, or it is empty.
bool is_netcdf(const std::string& path);

}  // namespace rsc
