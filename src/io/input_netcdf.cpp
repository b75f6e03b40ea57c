#include "io/input_netcdf.hpp"

#include <netcdf.h>
#include <zlib.h>

#include "base/error.hpp"
#include "base/reason.hpp"
#include "case/units.hpp"
#include "io/formats.hpp"

extern "C" int H5Eset_auto2(std::int64_t stack, int (*print)(std::int64_t, void*), void* data)
    __attribute__((weak));

namespace rsc {
namespace {

std::string line_of(uLong crc) {
    return format("\nrsc: CRC-32 of all before this line: %08lx\n", crc & 0xffffffffUL);
}

}  // namespace

std::string checksum_line(const char* bytes, std::size_t size) {
    return line_of(crc32_z(0, reinterpret_cast<const Bytef*>(bytes), size));
}

bool require_sound(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    std::string line = line_of(0);
    const std::streamoff length = std::streamoff(line.size()), digits = 9,
                         size = in ? std::streamoff(in.tellg()) : 0;
    if (size < length) return false;
    const std::string start = line.substr(0, line.size() - digits);
    in.seekg(size - length);
    if (!in.read(line.data(), length)) return false;
    if (!line.starts_with(start)) {
        if (line.find(start) != std::string::npos)
            bad_input(path, ": is truncated: its last line, the checksum, is incomplete");
        return false;
    }
    std::vector<char> buffer(1 << 20);
    uLong crc = 0;
    in.seekg(0);
    for (std::streamoff left = size - length; left > 0 && in;) {
        in.read(buffer.data(), std::min(left, std::streamoff(buffer.size())));
        crc = crc32_z(crc, reinterpret_cast<const Bytef*>(buffer.data()), at(in.gcount()));
        left -= in.gcount();
    }
    if (line_of(crc) != line)
        bad_input(path, ": is damaged, or was changed since rsc wrote it: its checksum is wrong");
    return true;
}

namespace {

// The header is described in the NetCDF user's guide, "File format specifications". Numbers are
// big-endian. The NetCDF library crashes on some damaged headers.
class ClassicHeader {
public:
    explicit ClassicHeader(const std::string& path)
        : path_(path), file_(path, std::ios::binary), length_(std::filesystem::file_size(path)) {}

    // Required size of the file in bytes; 0 for another kind of file.
    std::uint64_t needed_length() {
        char magic[4] = {};
        if (length_ < 4 || !file_.read(magic, 4) || std::memcmp(magic, "CDF", 3) != 0) return 0;
        version_ = magic[3];
        if (version_ != 1 && version_ != 2 && version_ != 5) return 0;
        const std::uint64_t records = count();
        const bool streaming = records == (version_ == 5 ? ~std::uint64_t{0} : 0xffffffffu);
        std::vector<std::uint64_t> dimensions;
        each([&] {
            name();
            dimensions.push_back(count());
        });
        attributes();
        struct Variable {
            bool record;
            std::uint64_t begin, bytes;
        };
        std::vector<Variable> variables;
        each([&] {
            name();
            Variable v{false, 0, 1};
            const std::uint64_t rank = bounded(count());
            for (std::uint64_t d = 0; d < rank; ++d) {
                const std::uint64_t id = count();
                if (id >= dimensions.size()) damaged();
                if (dimensions[id] == 0 && d == 0)
                    v.record = true;
                else
                    v.bytes = times(v.bytes, dimensions[id]);
            }
            attributes();
            v.bytes = times(v.bytes, size_of(number(4)));
            count();  // the stored size is not valid for large variables
            v.begin = number(version_ == 1 ? 4 : 8);
            variables.push_back(v);
        });
        std::uint64_t end = position_, record_bytes = 0;
        const auto recorded =
            std::ranges::count_if(variables, [](const Variable& v) { return v.record; });
        for (const Variable& v : variables)
            if (v.record) record_bytes += recorded == 1 ? v.bytes : (v.bytes + 3) / 4 * 4;
        for (const Variable& v : variables) {
            std::uint64_t last = v.bytes;
            if (v.record)
                last = records == 0 || streaming ? 0 : times(records - 1, record_bytes) + v.bytes;
            if (last > 0) end = std::max(end, v.begin + last);
        }
        return end;
    }

    std::uint64_t length() const { return length_; }

private:
    [[noreturn]] void damaged() const {
        bad_input(path_, ": looks like NetCDF, but its header is truncated or damaged at byte ",
                  position_);
    }

    std::uint64_t number(int bytes) {
        unsigned char b[8] = {};
        if (!file_.read(reinterpret_cast<char*>(b), bytes)) damaged();
        position_ += std::uint64_t(bytes);
        std::uint64_t value = 0;
        for (const int i : indices(bytes)) value = value << 8 | b[i];
        return value;
    }
    std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }

    // A count in the header cannot be larger than the file.
    std::uint64_t bounded(std::uint64_t n) const {
        if (n > length_) damaged();
        return n;
    }
    std::uint64_t times(std::uint64_t a, std::uint64_t b) const {
        if (b != 0 && a > (std::uint64_t{1} << 62) / b) damaged();
        return a * b;
    }
    void skip(std::uint64_t bytes) {
        bytes = (bytes + 3) / 4 * 4;
        if (bytes > length_ - std::min(position_, length_)) damaged();
        file_.seekg(std::streamoff(bytes), std::ios::cur);
        position_ += bytes;
    }
    void name() { skip(bounded(count())); }

    template <class Item>
    void each(Item item) {
        number(4);  // the tag of the list
        const std::uint64_t n = bounded(count());
        for (std::uint64_t i = 0; i < n; ++i) item();
    }
    void attributes() {
        each([&] {
            name();
            const std::uint64_t bytes = size_of(number(4));
            skip(times(bounded(count()), bytes));
        });
    }
    std::uint64_t size_of(std::uint64_t type) const {
        switch (type) {
            case NC_BYTE:
            case NC_CHAR:
            case NC_UBYTE: return 1;
            case NC_SHORT:
            case NC_USHORT: return 2;
            case NC_INT:
            case NC_UINT:
            case NC_FLOAT: return 4;
            case NC_DOUBLE:
            case NC_INT64:
            case NC_UINT64: return 8;
            default: damaged();
        }
    }

    std::string path_;
    std::ifstream file_;
    std::uint64_t length_ = 0, position_ = 4;
    int version_ = 0;
};

}  // namespace

void check_classic_length(const std::string& path) {
    ClassicHeader header(path);
    const std::uint64_t needed = header.needed_length();
    if (header.length() < needed)
        bad_input(path, ": ends at byte ", header.length(), " of the ", needed,
                  " in its header; the file is truncated");
}

namespace {

// The fill value of the library for values that were not written; none for types all of whose
// values may be data.
std::optional<double> default_fill(nc_type type) {
    switch (type) {
        case NC_FLOAT: return NC_FILL_FLOAT;
        case NC_DOUBLE: return NC_FILL_DOUBLE;
        case NC_INT: return NC_FILL_INT;
        case NC_SHORT: return NC_FILL_SHORT;
        case NC_INT64: return double(NC_FILL_INT64);
        default: return {};
    }
}

std::string value_name(const NetcdfInput::Variable& v, std::size_t flat) {
    std::string text;
    for (std::size_t d = v.lengths.size(); d-- > 0;) {
        text = v.axes[d] + " = " + std::to_string(flat % v.lengths[d]) +
               (text.empty() ? "" : ", ") + text;
        flat /= v.lengths[d];
    }
    return v.name + "(" + text + "), counted from 0,";
}

}  // namespace

void require_memory(double bytes, const std::string& purpose, const char* remedy) {
    void* const probe = bytes < 9e18 ? std::malloc(at(bytes)) : nullptr;
    if (!probe)
        throw Error(Failure::no_memory, "not enough memory ", purpose,
                    format(" (some %.0f MB)", bytes / 1e6), remedy);
    std::free(probe);
}

bool is_netcdf(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) &&
        !std::filesystem::is_regular_file(path, ignored) &&
        !std::filesystem::is_directory(path, ignored))
        bad_input(path, ": is a device or a FIFO; a plain file was expected");
    if (const std::string why = why_not_opened(path); !why.empty()) bad_input(path, ": ", why);
    std::ifstream file(path, std::ios::binary);
    constexpr std::array<char, 8> kHdf5 = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
    for (const long offset :
         {0L, 512L, 1024L, 2048L}) {  // a user block may come before the HDF5 signature
        std::array<char, 8> start{};
        file.seekg(offset);
        file.read(start.data(), start.size());
        const auto count = file.gcount();
        if (offset == 0 && count == 0) bad_input(path, ": is empty");
        if (offset == 0 && count >= 4 && std::memcmp(start.data(), "CDF", 3) == 0 &&
            (start[3] == 1 || start[3] == 2 || start[3] == 5))
            return true;
        if (count == 8 && start == kHdf5) return true;
        if (count < 8) break;
    }
    return false;
}

void suppress_hdf5_messages() {
    if (H5Eset_auto2) H5Eset_auto2(0, nullptr, nullptr);
}

std::string global_text(int file, const char* name) {
    // of a case: the length in a damaged file may be arbitrary
    constexpr std::size_t longest = std::size_t{1} << 26;
    std::size_t length = 0;
    nc_type type = NC_NAT;
    std::string value;
    if (nc_inq_att(file, NC_GLOBAL, name, &type, &length) != NC_NOERR || type != NC_CHAR ||
        length > longest)
        return value;
    value.resize(length);
    if (nc_get_att_text(file, NC_GLOBAL, name, value.data()) != NC_NOERR) value.clear();
    return value;
}

// True for the attribute `source` of a result that ends with a checksum.
static bool ends_with_checksum(const std::string& source) {
    int major = 0, minor = 0;
    return std::sscanf(source.c_str(), "rsc %d.%d.", &major, &minor) == 2 &&
           std::pair(major, minor) >= std::pair(0, 3);
}

int open_netcdf(const std::string& path) {
    suppress_hdf5_messages();
    const bool checked = require_sound(path);
    check_classic_length(path);  // the library reads zeros beyond the end of a classic file
    int file = -1;
    const int status = nc_open(path.c_str(), NC_NOWRITE, &file);
    if (status != NC_NOERR)
        bad_input(path, ": looks like NetCDF but cannot be opened; is it complete? (",
                  nc_strerror(status), ")");
    if (!checked && ends_with_checksum(global_text(file, "source"))) {
        nc_close(file);
        bad_input(
            path,
            ": is cut or damaged: its last line, the checksum that rsc writes, is missing (a "
            "copy made by another program is read if its attribute source does not begin with "
            "'rsc')");
    }
    return file;
}

NetcdfInput::NetcdfInput(const std::string& path)
    : alone_(library_lock()), path_(path), id_(open_netcdf(path)) {}

NetcdfInput::~NetcdfInput() { nc_close(id_); }

void NetcdfInput::must(int status, const std::string& what) const {
    if (status != NC_NOERR)
        bad_input(path_, ": ", what, " cannot be read; is the file complete? (",
                  nc_strerror(status), ")");
}

std::string NetcdfInput::Variable::shape() const {
    std::string text;
    for (const auto d : indices(axes)) enlist(text, ", ", axes[d], " = ", lengths[d]);
    return name + "(" + text + ")";
}

std::size_t NetcdfInput::Variable::count() const {
    return std::accumulate(lengths.begin(), lengths.end(), std::size_t{1}, std::multiplies<>());
}

NetcdfInput::Variable NetcdfInput::variable(int id) const {
    Variable v;
    v.id = id;
    char name[NC_MAX_NAME + 1] = {};
    int rank = 0;
    must(nc_inq_var(id_, id, name, &v.type, &rank, nullptr, nullptr),
         "variable " + std::to_string(id));
    v.name = printable(name, NC_MAX_NAME);
    v.dimensions.resize(at(rank));
    must(nc_inq_vardimid(id_, id, v.dimensions.data()), "the dimensions of " + v.name);
    for (const int d : v.dimensions) {
        std::size_t length = 0;
        must(nc_inq_dim(id_, d, name, &length), "a dimension of " + v.name);
        v.lengths.push_back(length);
        v.axes.push_back(printable(name, NC_MAX_NAME));
    }
    return v;
}

std::vector<NetcdfInput::Variable> NetcdfInput::variables() const {
    int count = 0;
    must(nc_inq_nvars(id_, &count), "the list of variables");
    std::vector<Variable> all;
    for (const int id : indices(count)) all.push_back(variable(id));
    return all;
}

std::optional<NetcdfInput::Variable> NetcdfInput::find(const std::string& name) const {
    int id = -1;
    if (nc_inq_varid(id_, name.c_str(), &id) != NC_NOERR) return std::nullopt;
    return variable(id);
}

std::optional<std::vector<double>> NetcdfInput::numbers_attribute(const Variable& v,
                                                                  const char* name) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    const int status = nc_inq_att(id_, v.id, name, &type, &length);
    if (status == NC_ENOTATT) return std::nullopt;
    must(status, v.name + ":" + name);
    if (type == NC_CHAR || type == NC_STRING)
        bad_input(path_, ": attribute ", v.name, ":", name, " is text; a number was expected");
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
        bad_input(path_, ": attribute ", v.name, ":", name, " is no text");
    }
    const std::string converted = utf8(text.substr(0, text.find('\0')));
    return printable(converted, converted.size());
}

double NetcdfInput::number_attribute(const Variable& v, const char* name, double otherwise) const {
    const auto values = numbers_attribute(v, name);
    if (!values) return otherwise;
    if (values->size() != 1 || !std::isfinite(values->front()))
        bad_input(path_, ": attribute ", v.name, ":", name, " must be one finite number");
    return values->front();
}

// How the stored numbers of a variable are to be read.
struct NetcdfInput::Packing {
    nc_type type;
    // The classic formats mark unsigned integers by an attribute.
    bool is_unsigned;
    double scale, offset;
    std::vector<double> missing;
    double least, most;     // of valid values
    bool unpacked = false;  // these limits are those of unpacked values

    // A value of the variable's type.
    double typed(double value) const {
        const double wrap = type == NC_BYTE ? 0x1p8 : type == NC_SHORT ? 0x1p16 : 0x1p32;
        return is_unsigned && value < 0 ? value + wrap
               : type == NC_FLOAT       ? double(float(value))
                                        : value;
    }
    bool is_missing(double stored) const {
        const double judged = unpacked ? stored * scale + offset : stored;
        return contains(missing, stored) || judged < least || judged > most;
    }
};

NetcdfInput::Packing NetcdfInput::packing(const Variable& v) const {
    Packing packing{v.type,
                    v.type <= NC_INT && text_attribute(v, "_Unsigned").value_or("") == "true",
                    number_attribute(v, "scale_factor", 1.0),
                    number_attribute(v, "add_offset", 0.0),
                    numbers_attribute(v, "missing_value").value_or(std::vector<double>()),
                    number_attribute(v, "valid_min", -kInfinity),
                    number_attribute(v, "valid_max", kInfinity)};
    if (const auto fill = numbers_attribute(v, "_FillValue"))
        append(packing.missing, *fill);
    else if (const auto standard = default_fill(v.type))
        packing.missing.push_back(*standard);
    for (double& value : packing.missing) value = packing.typed(value);
    // Limits are stored values, unless those are integers, and the limits real numbers like the
    // factors (NetCDF user's guide).
    const auto real = [&](const char* name) {
        nc_type type = NC_NAT;
        return nc_inq_atttype(id_, v.id, name, &type) == NC_NOERR &&
               (type == NC_FLOAT || type == NC_DOUBLE);
    };
    packing.unpacked = v.type != NC_FLOAT && v.type != NC_DOUBLE &&
                       (real("scale_factor") || real("add_offset")) &&
                       (real("valid_range") || real("valid_min") || real("valid_max"));
    if (const auto range = numbers_attribute(v, "valid_range")) {
        if (range->size() != 2)
            bad_input(path_, ": attribute ", v.name, ":valid_range must be two numbers");
        packing.least = (*range)[0];
        packing.most = (*range)[1];
    }
    if (packing.unpacked) {
        // However the stored numbers were rounded.
        packing.least -= 0.5 * std::abs(packing.scale);
        packing.most += 0.5 * std::abs(packing.scale);
    } else {
        packing.least = packing.typed(packing.least);
        packing.most = packing.typed(packing.most);
    }
    return packing;
}

void NetcdfInput::read(const Variable& v, double* out, bool missing_allowed) const {
    if (!v.numeric()) bad_input(path_, ": variable ", v.name, " is not numeric");
    must(nc_get_var_double(id_, v.id, out), "variable " + v.name);
    const Packing packing = this->packing(v);
    for (std::size_t i = 0; i < v.count(); ++i) {
        const double stored = packing.typed(out[i]);
        const bool filled = packing.is_missing(stored);
        if (missing_allowed && (std::isnan(stored) || filled)) {
            out[i] = std::nan("");
            continue;
        }
        if (filled)
            bad_input(path_, ": ", value_name(v, i), " is missing (", stored,
                      " is a fill value or not valid); every value must be known");
        out[i] = stored * packing.scale + packing.offset;
        if (!std::isfinite(out[i]))
            bad_input(path_, ": ", value_name(v, i), " is not finite; every value must be known");
    }
}

std::optional<std::string> NetcdfInput::unit(const Variable& v) const {
    const auto units = text_attribute(v, "units");
    return units ? units : text_attribute(v, "unit");  // SurfaceTopography, contact.engineering
}

std::optional<double> NetcdfInput::unit_factor(const Variable& v, const std::string& length_unit,
                                               int power) const {
    const auto units = unit(v);
    if (!units) return std::nullopt;
    try {
        return length_factor(*units, length_unit, power);
    } catch (const Error& error) {
        bad_input(path_, ": the units of ", v.name, ": ", error.what());
    }
}

std::vector<double> NetcdfInput::values(const std::string& name, std::size_t rank,
                                        const std::string& length_unit, int power,
                                        const char* expected) const {
    const auto v = find(name);
    if (!v) bad_input(path_, ": there is no variable ", name, "; ", expected);
    if (v->lengths.size() != rank || !v->numeric())
        bad_input(path_, ": ", name, ", numeric over ",
                  rank == 1 ? "one dimension" : "two dimensions", ", was expected, not ",
                  v->shape());
    check_memory(path_, v->shape(), 8.0 * double(v->count()));
    std::vector<double> all(v->count());
    read(*v, all.data());
    const double factor = unit_factor(*v, length_unit, power).value_or(1.0);
    for (double& value : all) value *= factor;
    return all;
}

}  // namespace rsc
