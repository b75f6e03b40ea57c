#include "io/netcdf_file.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/library_lock.hpp"
#include "io/formats.hpp"
#include "io/input_netcdf.hpp"
#include "io/whole_file.hpp"

namespace rsc {
namespace fs = std::filesystem;
namespace {

void check(int status, const std::string& path) {
    if (status == NC_NOERR) return;
    if (status == NC_EVARSIZE || status == NC_EDIMSIZE)
        throw Error(Failure::file_system, "cannot write '", path,
                    "': a variable is too large for &output "
                    "format='classic'; use format='netcdf4' or 'cdf5'");
    if (status == NC_ENOMEM || status == ENOMEM)
        throw Error(Failure::no_memory, "not enough memory for '", path,
                    "'; write less (&output contacts, heights)");
    // The file is written in memory: if NetCDF or HDF5 fail there, lack of memory is the likely
    // reason, whatever error they report.
    throw Error(status == NC_EHDFERR ? Failure::no_memory : Failure::internal, "'", path,
                "' cannot be written (", nc_strerror(status),
                "), most likely for lack of memory; write less (&output contacts, heights) or "
                "use format='classic'");
}

// The bytes of an empty netCDF-4 file. A file created in memory loses the order of its variables;
// one created on disk and opened in memory keeps it. HDF5 crashes if the disk is full, so the space
// is checked first.
std::vector<char> make_empty(const std::string& path, int mode) {
    std::error_code none;
    int error = 0;
    for (const fs::path& folder : {fs::temp_directory_path(none), fs::path(folder_of(path))}) {
        std::string name = (folder / "rsc-empty-XXXXXX").string();
        const int fd = ::mkstemp(name.data());
        if (fd < 0) {
            error = errno;
            continue;
        }
        std::vector<char> bytes(1 << 16);
        int status = NC_NOERR, ncid = -1;
        const ssize_t written = ::write(fd, bytes.data(), bytes.size()),
                      size = static_cast<ssize_t>(bytes.size());
        // A short write sets no errno; the next one does.
        const bool whole =
            written == size ||
            (written >= 0 && ::write(fd, bytes.data(), at(size - written)) == size - written);
        const bool room = whole && ::ftruncate(fd, 0) == 0 && ::lseek(fd, 0, SEEK_SET) == 0;
        error = room ? 0 : errno;
        if (room) {
            status = nc_create(name.c_str(), mode, &ncid);
            if (status == NC_NOERR) status = nc_close(ncid);
            bytes.resize(at(std::max<off_t>(::lseek(fd, 0, SEEK_END), 0)));
            if (::pread(fd, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
                error = errno != 0 ? errno : EIO;
        }
        ::close(fd);
        ::unlink(name.c_str());
        check(status, path);
        if (error == 0) return bytes;
    }
    fail_to_write(path, error);
}

// A file written in memory, whose bytes go to the disk by plain system calls with proper errors.
// HDF5 (1.10) crashes when it closes a file on a full disk.
class MemoryFile {
public:
    MemoryFile(const std::string& path, int mode) : path_(path) {
        if ((mode & NC_NETCDF4) == 0) {
            check(nc_create_mem(path.c_str(), mode, 1 << 16, &ncid_), path);
            return;
        }
        static const std::vector<char> empty = make_empty(path, mode);
        image_.size = empty.size();
        image_.memory = std::malloc(empty.size());  // NetCDF reallocates it as the file grows
        if (image_.memory == nullptr)
            throw Error(Failure::no_memory, "no memory to put '", path, "' together");
        std::ranges::copy(empty, static_cast<char*>(image_.memory));
        const int status = nc_open_memio(path.c_str(), NC_WRITE, &image_, &ncid_);
        if (status == NC_NOERR) image_ = {};  // owned by NetCDF until nc_close_memio
        check(status, path);
        check(nc_redef(ncid_), path);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() {
        if (ncid_ >= 0) nc_abort(ncid_);
        std::free(image_.memory);
    }
    int id() const { return ncid_; }
    // Ends the writing and returns the bytes of the file, which are valid as long as this object.
    std::span<const char> close() {
        NC_memio image{};  // after a failure it may point to freed memory
        check(nc_close_memio(std::exchange(ncid_, -1), &image), path_);
        image_ = image;
        return {static_cast<const char*>(image_.memory), file_size()};
    }

private:
    // HDF5's memory is padded; its superblock (version 2 or 3, 8-byte offsets) contains the end of
    // the file.
    std::size_t file_size() const {
        const auto* bytes = static_cast<const unsigned char*>(image_.memory);
        if (image_.size < 48 || bytes[0] != 0x89 || bytes[1] != 'H' || bytes[8] < 2 ||
            bytes[9] != 8)
            return image_.size;
        std::uint64_t end = 0;
        for (int i = 7; i >= 0; --i) end = end << 8 | bytes[28 + i];
        return end >= 48 && end <= image_.size ? at(end) : image_.size;
    }

    std::string path_;
    int ncid_ = -1;
    NC_memio image_{};
};

// One function for each kind of values.
template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
// clang 14 does not deduce the arguments of an aggregate by itself.
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

void put_attribute(int ncid, int varid, const std::string& name, const NetcdfAttribute& value,
                   const std::string& path) {
    const auto put = [&](auto function, nc_type type, auto values) {
        check(function(ncid, varid, name.c_str(), type, values.size(), values.data()), path);
    };
    const Overloaded put_value = {
        [&](const std::string& text) {
            // The case stays as it is, because it may name files.
            const std::string shown = name == "case" ? text : utf8(text);
            check(nc_put_att_text(ncid, varid, name.c_str(), shown.size(), shown.c_str()), path);
        },
        [&](const double& x) { put(nc_put_att_double, NC_DOUBLE, std::span(&x, 1)); },
        [&](const std::int32_t& n) { put(nc_put_att_int, NC_INT, std::span(&n, 1)); },
        [&](const std::vector<double>& x) { put(nc_put_att_double, NC_DOUBLE, std::span(x)); },
        [&](const std::vector<std::int32_t>& n) { put(nc_put_att_int, NC_INT, std::span(n)); }};
    std::visit(put_value, value);
}

// Smaller variables are not chunked: managing a chunk takes HDF5 longer than writing them, and
// deflate saves nothing.
constexpr std::size_t kChunked = 2048;  // values

std::size_t values_of(const std::vector<std::size_t>& shape) {
    std::size_t n = 1;
    for (const std::size_t length : shape) n *= length;
    return n;
}

template <class T, class Action>
void for_each_row(const Filler<T>& fill, const std::vector<std::size_t>& shape,
                  const Action& action) {
    std::vector<T> row(values_of({shape.begin() + 1, shape.end()}));
    for (std::size_t j = 0; j < shape[0]; ++j) {
        fill(j, row);
        action(j, row);
    }
}

// Chunk size: maps are read a few levels at a time, heights a band of rows.
std::vector<std::size_t> chunks(const std::vector<std::size_t>& shape) {
    constexpr std::size_t target = 1u << 17;  // values, 1 MiB
    std::vector<std::size_t> chunk(shape.size(), 1);
    std::size_t held = 1;
    for (std::size_t d = shape.size(); d-- > 0;) {
        const std::size_t most = shape.size() == 3 && d == 0 ? target / 4 : target;
        chunk[d] = std::clamp<std::size_t>(most / held, 1, shape[d]);
        held *= chunk[d];
    }
    return chunk;
}

// Bytes of nearly empty maps are deflated in less time, and to less, if they are not shuffled
// first.
bool mostly_zero(const NetcdfVariable& v, const std::vector<std::size_t>& shape) {
    if (std::holds_alternative<FlagFiller>(v.values)) return true;
    std::size_t zeros = 0;
    const auto count = [&](std::span<const double> values) {
        zeros += at(std::ranges::count(values, 0.0));
    };
    if (const auto* values = std::get_if<std::vector<double>>(&v.values)) count(*values);
    if (const auto* rows = std::get_if<RowFiller>(&v.values))
        for_each_row<double>(*rows, shape,
                             [&](std::size_t, std::span<const double> row) { count(row); });
    return 2 * zeros > values_of(shape);
}

void put_values(int ncid, int varid, const NetcdfVariable& v, const std::vector<std::size_t>& shape,
                const std::string& path) {
    std::vector<std::size_t> start(shape.size(), 0), count = shape;
    if (!count.empty()) count[0] = 1;  // of rows
    if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&v.values)) {
        check(nc_put_var_int(ncid, varid, integers->data()), path);
    } else if (const auto* doubles = std::get_if<std::vector<double>>(&v.values)) {
        std::vector<double> filled;
        const bool absent = v.may_be_absent &&
                            std::ranges::any_of(*doubles, [](double x) { return std::isnan(x); });
        if (absent) {
            filled = *doubles;
            for (double& x : filled)
                if (std::isnan(x)) x = NC_FILL_DOUBLE;
        }
        check(nc_put_var_double(ncid, varid, absent ? filled.data() : doubles->data()), path);
    } else if (const auto* rows = std::get_if<RowFiller>(&v.values)) {
        for_each_row<double>(*rows, shape, [&](std::size_t j, std::span<const double> row) {
            start[0] = j;
            check(nc_put_vara_double(ncid, varid, start.data(), count.data(), row.data()), path);
        });
    } else if (const auto* flags = std::get_if<FlagFiller>(&v.values)) {
        for_each_row<signed char>(
            *flags, shape, [&](std::size_t j, std::span<const signed char> row) {
                start[0] = j;
                check(nc_put_vara_schar(ncid, varid, start.data(), count.data(), row.data()), path);
            });
    } else if (const auto* texts = std::get_if<std::vector<std::string>>(&v.values)) {
        std::string padded;
        for (const std::string& text : *texts)
            padded.append(text).append(shape[1] - text.size(), '\0');
        check(nc_put_var_text(ncid, varid, padded.data()), path);
    }
}

}  // namespace

void NetcdfFile::dimension(const std::string& name, std::size_t length) {
    dimensions_.emplace_back(name, length);
}

void NetcdfFile::attribute(const std::string& name, NetcdfAttribute value) {
    attributes_.emplace_back(name, std::move(value));
}

std::vector<std::size_t> NetcdfFile::shape(const NetcdfVariable& v) const {
    std::vector<std::size_t> lengths;
    for (const std::string& dimension : v.dimensions) {
        const auto found =
            std::ranges::find_if(dimensions_, [&](const auto& d) { return d.first == dimension; });
        if (found == dimensions_.end())
            throw Error(Failure::internal, "result file: no dimension '", dimension, "'");
        lengths.push_back(found->second);
    }
    return lengths;
}

void NetcdfFile::variable(NetcdfVariable v) {
    check_values(v);
    variables_.push_back(std::move(v));
}

void NetcdfFile::check_values(const NetcdfVariable& v) const {
    const std::vector<std::size_t> lengths = shape(v);
    const std::size_t size = values_of(lengths);
    const auto bad = [&v](double x) {
        return std::isinf(x) || (std::isnan(x) && !v.may_be_absent);
    };
    bool finite = true, fits = true;
    if (const auto* doubles = std::get_if<std::vector<double>>(&v.values)) {
        fits = doubles->size() == size;
        finite = std::ranges::none_of(*doubles, bad);
    } else if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&v.values)) {
        fits = integers->size() == size;
    } else if (const auto* rows = std::get_if<RowFiller>(&v.values); rows) {
        for_each_row<double>(*rows, lengths, [&](std::size_t, std::span<const double> row) {
            finite = finite && std::ranges::none_of(row, bad);
        });
    } else if (const auto* texts = std::get_if<std::vector<std::string>>(&v.values)) {
        fits = lengths.size() == 2 && texts->size() == lengths[0] &&
               std::ranges::none_of(*texts, [&](const auto& t) { return t.size() > lengths[1]; });
    }
    if (!fits)
        throw Error(Failure::internal, "result file: the values of '", v.name,
                    "' do not fill its dimensions");
    if (!finite)
        throw Error(Failure::internal, "result file: '", v.name,
                    "' holds a value that is not a finite number");
}

void NetcdfFile::define_and_put(int ncid, Format format, int compression,
                                const std::string& path) const {
    int old_fill = 0;
    check(nc_set_fill(ncid, NC_NOFILL, &old_fill), path);  // every value is written below
    for (const auto& [name, n] : dimensions_)
        check(nc_def_dim(ncid, name.c_str(), n, nullptr), path);
    for (const auto& [name, value] : attributes_) put_attribute(ncid, NC_GLOBAL, name, value, path);

    std::vector<int> varids;
    for (const NetcdfVariable& v : variables_) {
        std::vector<int> ids(v.dimensions.size());
        for (const auto d : indices(ids))
            check(nc_inq_dimid(ncid, v.dimensions[d].c_str(), &ids[d]), path);
        const nc_type type = std::holds_alternative<FlagFiller>(v.values)                  ? NC_BYTE
                             : std::holds_alternative<std::vector<std::int32_t>>(v.values) ? NC_INT
                             : std::holds_alternative<std::vector<std::string>>(v.values)
                                 ? NC_CHAR
                                 : NC_DOUBLE;
        int varid = -1;
        check(nc_def_var(ncid, v.name.c_str(), type, int(ids.size()), ids.data(), &varid), path);
        if (v.may_be_absent)
            put_attribute(ncid, varid, "_FillValue", std::vector<double>{NC_FILL_DOUBLE}, path);
        if (format == Format::netcdf4 && !ids.empty() && values_of(shape(v)) >= kChunked) {
            check(nc_def_var_chunking(ncid, varid, NC_CHUNKED, chunks(shape(v)).data()), path);
            if (compression > 0 && !v.disorder)
                check(nc_def_var_deflate(ncid, varid, mostly_zero(v, shape(v)) ? 0 : 1, 1,
                                         compression),
                      path);
        }
        put_attribute(ncid, varid, "long_name", v.long_name, path);
        if (!v.units.empty())
            put_attribute(ncid, varid, "units", v.units, path);  // texts have none
        for (const auto& [name, value] : v.attributes)
            put_attribute(ncid, varid, name, value, path);
        varids.push_back(varid);
    }
    check(nc_enddef(ncid), path);
    for (const auto k : indices(variables_))
        put_values(ncid, varids[k], variables_[k], shape(variables_[k]), path);
}

void NetcdfFile::write(const std::string& path, Format format, int compression) const {
    const std::lock_guard lock(library_lock());
    std::error_code error;
    const fs::path folder = folder_of(path);
    fs::create_directories(folder, error);
    if (error)
        throw Error(Failure::file_system, "cannot write '", path, "': folder '", folder.string(),
                    "' cannot be made: ", error.message());
    WholeFile file(path, kResultFile);

    double bytes = 0;
    for (const NetcdfVariable& v : variables_)
        bytes +=
            (std::holds_alternative<FlagFiller>(v.values) ? 1 : 8) * double(values_of(shape(v)));
    // The image of the file is copied when it grows, and once more for reading.
    require_memory(3 * bytes + (32 << 20), "for '" + path + "'",
                   "; write less (&output contacts, heights, map_cells)");
    int mode = NC_CLOBBER | NC_NETCDF4 | NC_CLASSIC_MODEL;
    if (format == Format::cdf5) mode = NC_CLOBBER | NC_64BIT_DATA;
    if (format == Format::classic)
        mode = bytes < 1.9e9 ? NC_CLOBBER
                             : NC_CLOBBER | NC_64BIT_OFFSET;  // offsets of 32 bits reach 2 GiB

    MemoryFile memory(path, mode);
    define_and_put(memory.id(), format, compression, path);
    const std::span<const char> image = memory.close();
    file.write(image);
    file.write(checksum_line(image.data(), image.size()));
    file.finish();
}

}  // namespace rsc
