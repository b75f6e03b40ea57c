#include "read/input_classic.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "error.hpp"

namespace rsc {
namespace {

// The grammar of the header is in the NetCDF user's guide, "File format specifications". Numbers are big-endian.
class ClassicHeader {
public:
    explicit ClassicHeader(const std::string& path)
        : path_(path), file_(path, std::ios::binary), length_(std::filesystem::file_size(path)) {}

    // Bytes the file must have; 0 if it is of another kind.
    std::uint64_t wanted_length() {
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
            count();  // the size as written is of no use for large variables
            v.begin = number(version_ == 1 ? 4 : 8);
            variables.push_back(v);
        });
        std::uint64_t end = position_, record_bytes = 0;
        const auto recorded = std::count_if(variables.begin(), variables.end(), [](const Variable& v) { return v.record; });
        for (const Variable& v : variables)
            if (v.record) record_bytes += recorded == 1 ? v.bytes : (v.bytes + 3) / 4 * 4;
        for (const Variable& v : variables) {
            std::uint64_t last = v.bytes;
            if (v.record) last = records == 0 || streaming ? 0 : times(records - 1, record_bytes) + v.bytes;
            if (last > 0) end = std::max(end, v.begin + last);
        }
        return end;
    }

    std::uint64_t length() const { return length_; }

private:
    [[noreturn]] void damaged() const {
        throw Error(Failure::bad_input,
                    path_ + ": looks like NetCDF, but its header is cut off or damaged at byte " + std::to_string(position_));
    }

    std::uint64_t number(int bytes) {
        unsigned char b[8] = {};
        if (!file_.read(reinterpret_cast<char*>(b), bytes)) damaged();
        position_ += static_cast<std::uint64_t>(bytes);
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8 | b[i];
        return value;
    }
    std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }

    // A number of things in the header cannot be larger than the file.
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
        file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
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
    const std::uint64_t wanted = header.wanted_length();
    if (header.length() < wanted)
        throw Error(Failure::bad_input, path + ": ends at byte " + std::to_string(header.length()) + " of the " + std::to_string(wanted) +
                                            " its header announces; the file is not whole");
}

}  // namespace rsc
