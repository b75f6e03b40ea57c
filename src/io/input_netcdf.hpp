// Reads NetCDF files: checksum, length, variables.
#pragma once

#include <netcdf.h>

#include "base/library_lock.hpp"

namespace rsc {

// The checksum of result files: a last line of text after the data of NetCDF or HDF5, "\nrsc:
// CRC-32 of all before this line: 0a1b2c3d\n".
// It is checked before these libraries open the file: HDF5 crashes on some damaged ones, and
// classic files have no checksums of their own.

// The checksum line for the `size` bytes of a file.
std::string checksum_line(const char* bytes, std::size_t size);

// Throws Error(bad_input) for a file with such a line whose bytes do not match it. Files without a
// checksum, of earlier versions or other programs, pass; true if the line is there.
bool require_sound(const std::string& path);

// Opens a NetCDF file of any format for reading, under library_lock(). Throws Error(bad_input) if
// it cannot be opened, its checksum is wrong, it is shorter than its header says, or it is a result
// of rsc 0.3 or later without the checksum, so that a cut file is never read as zeros.
int open_netcdf(const std::string& path);

// A global text attribute of an open file; empty if there is none.
std::string global_text(int file, const char* name);

// The required length of a NetCDF file of the classic formats.

// Reads the header of a classic, 64-bit offset or CDF-5 file and throws Error(bad_input) if the
// file is shorter than its header and data, because the NetCDF library then returns zeros or worse
// without an error. Does nothing for other files.
void check_classic_length(const std::string& path);

// HDF5 may crash, now or when the program ends, if it is out of memory: allocates as many bytes as
// it needs, as a test. Throws Error(no_memory): "not enough memory PURPOSE (some 34 MB)REMEDY".
void require_memory(double bytes, const std::string& purpose, const char* remedy = "");

// NetCDF queries attributes that may be missing, and HDF5 prints each failure on stderr. NetCDF
// suppresses this in the first thread only, this function in the calling one.
void suppress_hdf5_messages();

// A NetCDF file open for reading; errors name the file and the variable. Holds library_lock()
// during its lifetime, because the library is not thread-safe.
class NetcdfInput {
public:
    // Throws Error(bad_input) if the file cannot be opened, is truncated, or its checksum does not
    // match.
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
        std::size_t count() const;         // of its values
        bool numeric() const {
            return type != NC_CHAR && type != NC_STRING && type <= NC_MAX_ATOMIC_TYPE;
        }
    };
    std::vector<Variable> variables() const;
    std::optional<Variable> find(const std::string& name) const;

    // All values of a numeric variable to out, unpacked with scale_factor and add_offset. Throws
    // Error(bad_input) with the indices, counted from 0, of the first value that is missing or not
    // finite; with `missing` missing values become NaN, but infinity is refused.
    void read(const Variable& variable, double* out, bool missing = false) const;

    // The attribute `units`, or `unit`.
    std::optional<std::string> unit(const Variable& variable) const;
    // Factor from a variable's unit to length_unit^power; none if it has no units.
    std::optional<double> unit_factor(const Variable& variable, const std::string& length_unit,
                                      int power = 1) const;
    // All values of the variable `name`, with `rank` dimensions, converted from its units, if it
    // has them, to length_unit^power. Throws Error(bad_input), with `expected` if there is no such
    // variable.
    std::vector<double> values(const std::string& name, std::size_t rank,
                               const std::string& length_unit, int power,
                               const char* expected) const;

    // None if the attribute does not exist; throws Error(bad_input) if it is no text. Control
    // characters are replaced.
    std::optional<std::string> text_attribute(const Variable& variable, const char* name) const;
    std::optional<std::vector<double>> numbers_attribute(const Variable& variable,
                                                         const char* name) const;
    const std::string& path() const { return path_; }

private:
    void must(int status, const std::string& what) const;
    Variable variable(int id) const;
    double number_attribute(const Variable& variable, const char* name, double otherwise) const;
    struct Packing;
    Packing packing(const Variable& variable) const;

    std::unique_lock<LibraryLock> alone_;
    std::string path_;
    int id_ = -1;
};

// True if the first bytes are those of a NetCDF file (classic, 64-bit, CDF-5, or HDF5 with or
// without a user block). Throws Error(bad_input) if there is no such file, it cannot be read, or it
// is empty.
bool is_netcdf(const std::string& path);

}  // namespace rsc
