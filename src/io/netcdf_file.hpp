// A NetCDF file for writing: its contents are declared first, then written in one call; the file
// gets its final name when it is complete.
#pragma once

#include "case/case.hpp"

namespace rsc {

using NetcdfAttribute =
    std::variant<std::string, double, std::int32_t, std::vector<double>, std::vector<std::int32_t>>;
using NetcdfAttributes = std::vector<std::pair<std::string, NetcdfAttribute>>;

// Fills in the values at one index of the first dimension; they need not be in memory all at once.
template <class T>
using Filler = std::function<void(std::size_t index, std::span<T> values)>;
using RowFiller = Filler<double>;
using FlagFiller = Filler<signed char>;  // stored in one byte each

struct NetcdfVariable {
    std::string name;
    std::vector<std::string> dimensions;  // slowest first; none for a scalar
    std::string units, long_name;
    // Texts: two dimensions, the last one their longest length in bytes; shorter ones end in zeros.
    std::variant<std::vector<double>, std::vector<std::int32_t>, RowFiller, FlagFiller,
                 std::vector<std::string>>
        values;
    NetcdfAttributes attributes;
    // NaN is a missing value, written as _FillValue; elsewhere it is an internal error.
    bool may_be_absent = false;
    // Incompressible numbers: deflate saves a quarter at most and takes ten times as long as
    // writing.
    bool disorder = false;
};

class NetcdfFile {
public:
    void dimension(const std::string& name, std::size_t length);
    void attribute(const std::string& name, NetcdfAttribute value);
    void variable(NetcdfVariable variable);

    // Writes everything to `path`, completely or not at all (whole_file.hpp); missing folders are
    // created. An existing file is replaced only if it is a result or a manifest of rsc. Text
    // becomes NC_CHAR, the data model is the classic one. Throws Error(file_system) with a remedy,
    // and Error(internal) for an infinite value or an unexpected NaN; then there is no file.
    void write(const std::string& path, Format format, int compression) const;

private:
    std::vector<std::size_t> shape(const NetcdfVariable& v) const;  // the lengths of its dimensions
    void check_values(const NetcdfVariable& v) const;
    void define_and_put(int ncid, Format format, int compression, const std::string& path) const;

    std::vector<std::pair<std::string, std::size_t>> dimensions_;
    NetcdfAttributes attributes_;
    std::vector<NetcdfVariable> variables_;
};

}  // namespace rsc
