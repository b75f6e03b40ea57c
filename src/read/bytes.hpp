// Checks of the size of a height map before its memory is allocated, and a reader of binary files.
#pragma once

#include "error.hpp"
#include "format.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Throws Error(bad_input) if `what`, of `count` doubles, needs more memory than the machine has: the size in a damaged file may be
// arbitrary.
void check_memory(const std::string& path, const std::string& what, double count);

// Throws Error(bad_input) unless a map has at least 3 x 3 points, at most 2^31 - 1 a side, and fits into memory.
void check_grid(const std::string& path, std::size_t nx, std::size_t ny);

// Rows without padding, as for the functions below.
HeightMap allocate_map(std::size_t nx, std::size_t ny);
void scale_heights(HeightMap& map, double factor);

// Reverse the order of columns or rows.
void reverse_columns(HeightMap& map);
void reverse_rows(HeightMap& map);

// The bytes of a binary file, read in order; reading beyond their end throws an error with the position.

// Reads all bytes of a file. Throws Error(bad_input) if they cannot be read.
inline std::string read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) bad_input(path + ": cannot be read");
    check_memory(path, "the file", static_cast<double>(size) / sizeof(double));
    std::string bytes(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    file.read(bytes.data(), size);
    if (file.gcount() != size) bad_input(path + ": reading failed");
    return bytes;
}

// Little-endian numbers.
class ByteReader {
public:
    ByteReader(const std::string& path, std::string_view bytes, std::size_t at, std::size_t end)
        : path_(path), bytes_(bytes), at_(at), end_(end) {}

    std::size_t at() const { return at_; }
    std::size_t left() const { return end_ - at_; }
    const std::string& path() const { return path_; }
    [[noreturn]] void refuse(const std::string& what) const { bad_input(path_ + ": at byte " + std::to_string(at_) + ": " + what); }

    // The next `count` items of `size` bytes each; `what` names them in messages.
    std::string_view take(std::size_t count, std::size_t size, const std::string& what) {
        if (count > left() / size)
            refuse(what + " of " + std::to_string(count) + " x " + std::to_string(size) + " bytes, but " + std::to_string(left()) +
                   " are left; is the file complete?");
        const std::string_view taken = bytes_.substr(at_, count * size);
        at_ += count * size;
        return taken;
    }
    template <class T>
    T number(const std::string& what) {
        return value<T>(take(1, sizeof(T), what).data());
    }
    // Up to a zero byte.
    std::string_view text(const std::string& what) {
        const std::size_t zero = bytes_.substr(at_, left()).find('\0');
        if (zero == std::string_view::npos) refuse(what + " has no end; is the file complete?");
        const std::string_view taken = bytes_.substr(at_, zero);
        at_ += zero + 1;
        return taken;
    }
    template <class T>
    static T value(const char* bytes) {
        static_assert(std::endian::native == std::endian::little);
        T value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }

private:
    const std::string& path_;
    std::string_view bytes_;
    std::size_t at_, end_;
};

}  // namespace rsc
