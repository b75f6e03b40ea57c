#include "read/input_netcdf.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "error.hpp"
#include "format.hpp"
#include "read/checksum.hpp"
#include "read/input_classic.hpp"
#include "rough/library_lock.hpp"

// NetCDF asks for attributes that may not be there, and HDF5 tells each refusal on stderr; NetCDF silences it in the first thread alone.
extern "C" int H5Eset_auto2(std::int64_t stack, int (*print)(std::int64_t, void*), void* data) __attribute__((weak));

namespace rsc {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(Failure::bad_input, message); }

// Values that stand for "missing" in the variable as stored.
bool has_default_fill(nc_type type) {
    return type == NC_FLOAT || type == NC_DOUBLE || type == NC_INT || type == NC_SHORT || type == NC_INT64;
}

std::string shown(double v) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", v);
    return buffer;
}

std::string indices(const NetcdfInput::Variable& v, std::size_t flat) {
    std::string text;
    for (std::size_t d = v.lengths.size(); d-- > 0;) {
        text = v.axes[d] + " = " + std::to_string(flat % v.lengths[d]) + (text.empty() ? "" : ", ") + text;
        flat /= v.lengths[d];
    }
    return v.name + "(" + text + "), counted from 0,";
}

}  // namespace

bool is_netcdf(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path + ": is a directory, not a file");
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
        refuse(path + ": is a device or a FIFO; a plain file was expected");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(path + ": " + (errno != 0 ? std::strerror(errno) : "cannot be opened"));
    constexpr std::array<char, 8> kHdf5 = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
    for (const long offset : {0L, 512L, 1024L, 2048L}) {  // a user block may come before the HDF5 signature
        std::array<char, 8> start{};
        file.seekg(offset);
        file.read(start.data(), start.size());
        const auto count = file.gcount();
        if (offset == 0 && count == 0) refuse(path + ": is empty");
        if (offset == 0 && count >= 4 && std::memcmp(start.data(), "CDF", 3) == 0 && (start[3] == 1 || start[3] == 2 || start[3] == 5))
            return true;
        if (count == 8 && start == kHdf5) return true;
        if (count < 8) break;
    }
    return false;
}

NetcdfInput::NetcdfInput(const std::string& path) : alone_(library_lock()), path_(path) {
    if (H5Eset_auto2) H5Eset_auto2(0, nullptr, nullptr);
    require_sound(path);
    check_classic_length(path);  // the library reads zeros beyond the end of a classic file
    const int status = nc_open(path.c_str(), NC_NOWRITE, &id_);
    if (status != NC_NOERR) refuse(path + ": looks like NetCDF but cannot be opened; is it whole? (" + nc_strerror(status) + ")");
}

NetcdfInput::~NetcdfInput() { nc_close(id_); }

void NetcdfInput::must(int status, const std::string& what) const {
    if (status != NC_NOERR) refuse(path_ + ": " + what + " cannot be read; is the file whole? (" + nc_strerror(status) + ")");
}

std::string NetcdfInput::Variable::shape() const {
    std::string text = name + "(";
    for (std::size_t d = 0; d < axes.size(); ++d) text += (d > 0 ? ", " : "") + axes[d] + " = " + std::to_string(lengths[d]);
    return text + ")";
}

std::vector<NetcdfInput::Variable> NetcdfInput::variables() const {
    int count = 0;
    must(nc_inq_nvars(id_, &count), "the list of variables");
    std::vector<Variable> all;
    for (int id = 0; id < count; ++id) {
        Variable v;
        v.id = id;
        char name[NC_MAX_NAME + 1] = {};
        int rank = 0;
        must(nc_inq_var(id_, id, name, &v.type, &rank, nullptr, nullptr), "variable " + std::to_string(id));
        v.name = printable(name, NC_MAX_NAME);
        v.dimensions.resize(static_cast<std::size_t>(rank));
        must(nc_inq_vardimid(id_, id, v.dimensions.data()), "the dimensions of " + v.name);
        for (const int d : v.dimensions) {
            std::size_t length = 0;
            must(nc_inq_dim(id_, d, name, &length), "a dimension of " + v.name);
            v.lengths.push_back(length);
            v.axes.push_back(printable(name, NC_MAX_NAME));
        }
        all.push_back(std::move(v));
    }
    return all;
}

std::optional<NetcdfInput::Variable> NetcdfInput::find(const std::string& name) const {
    for (auto& v : variables())
        if (v.name == name) return v;
    return std::nullopt;
}

std::optional<std::vector<double>> NetcdfInput::numbers_attribute(const Variable& v, const char* name) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    const int status = nc_inq_att(id_, v.id, name, &type, &length);
    if (status == NC_ENOTATT) return std::nullopt;
    must(status, v.name + ":" + name);
    if (type == NC_CHAR || type == NC_STRING) refuse(path_ + ": attribute " + v.name + ":" + name + " is text; a number was expected");
    std::vector<double> values(length);
    if (length > 0) must(nc_get_att_double(id_, v.id, name, values.data()), v.name + ":" + name);
    return values;
}

std::optional<std::string> NetcdfInput::text_attribute(const Variable& v, const char* name) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(id_, v.id, name, &type, &length) != NC_NOERR) return std::nullopt;
    std::string text;
    if (type == NC_CHAR) {
        text.resize(length);
        must(nc_get_att_text(id_, v.id, name, text.data()), v.name + ":" + name);
    } else if (type == NC_STRING && length == 1) {
        char* value = nullptr;
        must(nc_get_att_string(id_, v.id, name, &value), v.name + ":" + name);
        if (value) text = value;
        nc_free_string(1, &value);
    } else {
        refuse(path_ + ": attribute " + v.name + ":" + name + " is no text");
    }
    return printable(text.substr(0, text.find('\0')), text.size());
}

void NetcdfInput::read(const Variable& v, double* out, bool missing_allowed) const {
    if (!v.numeric()) refuse(path_ + ": variable " + v.name + " is not numeric");
    std::size_t count = 1;
    for (const std::size_t n : v.lengths) count *= n;
    must(nc_get_var_double(id_, v.id, out), "variable " + v.name);

    std::vector<double> missing = numbers_attribute(v, "missing_value").value_or(std::vector<double>());
    if (const auto fill = numbers_attribute(v, "_FillValue")) {
        missing.insert(missing.end(), fill->begin(), fill->end());
    } else if (has_default_fill(v.type)) {
        // What the library left where nothing was written.
        const double standard = v.type == NC_FLOAT    ? static_cast<double>(NC_FILL_FLOAT)
                                : v.type == NC_DOUBLE ? NC_FILL_DOUBLE
                                : v.type == NC_INT    ? static_cast<double>(NC_FILL_INT)
                                : v.type == NC_SHORT  ? static_cast<double>(NC_FILL_SHORT)
                                                      : static_cast<double>(NC_FILL_INT64);
        missing.push_back(standard);
    }
    const auto factor = [&](const char* name, double otherwise) {
        const auto values = numbers_attribute(v, name);
        if (!values) return otherwise;
        if (values->size() != 1 || !std::isfinite(values->front()))
            refuse(path_ + ": attribute " + v.name + ":" + name + " must be one finite number");
        return values->front();
    };
    const double scale = factor("scale_factor", 1.0), offset = factor("add_offset", 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double stored = out[i];
        if (missing_allowed && (std::isnan(stored) || std::find(missing.begin(), missing.end(), stored) != missing.end())) {
            out[i] = std::nan("");
            continue;
        }
        if (std::find(missing.begin(), missing.end(), stored) != missing.end())
            refuse(path_ + ": " + indices(v, i) + " is missing (it holds the fill value " + shown(stored) + "); every value must be known");
        out[i] = stored * scale + offset;
        if (!std::isfinite(out[i])) refuse(path_ + ": " + indices(v, i) + " is not finite; every value must be known");
    }
}

}  // namespace rsc
