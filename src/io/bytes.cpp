#include "io/formats.hpp"

#include <zlib.h>

#include "base/parallel.hpp"

namespace rsc {

std::string shown(std::string_view word) {
    return format("'%s%s'", printable(word, 40).c_str(), word.size() > 40 ? "..." : "");
}

void check_memory(const std::string& path, const std::string& what, double count) {
    const double bytes = count * sizeof(double), machine = machine_memory();
    if (bytes > machine)
        bad_input(path, ": ", what, " needs ", bytes / 1e9, " GB; this machine has ", machine / 1e9,
                  " GB");
}

void check_grid(const std::string& path, std::size_t nx, std::size_t ny) {
    const std::string what = joined("a height map of ", nx, " x ", ny, " points");
    if (nx < 3 || ny < 3) bad_input(path, ": ", what, "; at least 3 x 3 are needed");
    if (std::max(nx, ny) > at(std::numeric_limits<int>::max()))
        bad_input(path, ": ", what, "; at most 2147483647 points a side are possible");
    check_memory(path, what, double(nx) * double(ny));
}

UnpackedFile::UnpackedFile(const std::string& path)
    : path_(path), file_(gzopen(path.c_str(), "rb")) {
    if (!file_) bad_input(path, ": cannot be read");
    gzbuffer(static_cast<gzFile>(file_), unsigned(buffer_.size()));
}

UnpackedFile::~UnpackedFile() { gzclose(static_cast<gzFile>(file_)); }

std::streambuf::int_type UnpackedFile::underflow() {
    auto* const file = static_cast<gzFile>(file_);
    const int count = gzread(file, buffer_.data(), unsigned(buffer_.size()));
    int error = Z_OK;
    gzerror(file, &error);
    if (count < 0 || error == Z_BUF_ERROR)
        bad_input(path_,
                  gzdirect(file) ? ": reading failed" : ": is packed by gzip, and cut or damaged");
    setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
    return count > 0 ? traits_type::to_int_type(buffer_[0]) : traits_type::eof();
}

std::string read_bytes(const std::string& path) {
    UnpackedFile file(path);
    std::string bytes;
    constexpr std::size_t portion = std::size_t{1} << 20;
    for (std::size_t size = 0; size == bytes.size();) {
        check_memory(path, "the file", double(size + portion) / sizeof(double));
        bytes.resize(size + portion);
        size += std::size_t(file.sgetn(bytes.data() + size, std::streamsize(portion)));
        if (size < bytes.size()) {
            bytes.resize(size);
            break;
        }
    }
    return bytes;
}

std::string first_bytes(const std::string& path) {
    UnpackedFile file(path);
    std::string start(4096, '\0');
    start.resize(std::size_t(file.sgetn(start.data(), std::streamsize(start.size()))));
    return start;
}

bool next_line(std::streambuf& text, std::string& line) {
    constexpr int end = std::streambuf::traits_type::eof();
    line.clear();
    int c = text.sbumpc();
    if (c == end) return false;
    for (; c != end && c != '\n' && c != '\r'; c = text.sbumpc()) line += char(c);
    if (c == '\r' && text.sgetc() == '\n') text.sbumpc();
    return true;
}

std::string utf8(std::string_view text) {
    int more = 0;  // bytes of the present character that follow
    bool valid = true;
    for (const char byte : text) {
        const auto c = static_cast<unsigned char>(byte);
        if (more > 0) {
            valid = valid && (c & 0xc0) == 0x80;
            --more;
        } else if (c >= 0x80) {
            valid = valid && c >= 0xc2 && c < 0xf5;
            more = c < 0xe0 ? 1 : c < 0xf0 ? 2 : 3;
        }
    }
    if (valid && more == 0) return std::string(text);
    std::string converted;
    for (const char byte : text) {
        const auto c = static_cast<unsigned char>(byte);
        if (c >= 0x80) converted += char(0xc0 | c >> 6);
        converted += char(c < 0x80 ? c : 0x80 | (c & 0x3f));
    }
    return converted;
}

std::string for_shell(const std::string& path) {
    std::string quoted = "'";
    for (const char c : path) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string copy_for_shell(const std::string& path, const std::string& ending) {
    const std::filesystem::path name(path);
    return for_shell((name.parent_path() / name.stem()).string() + ending);
}

HeightMap allocate_map(std::size_t nx, std::size_t ny) {
    HeightMap map;
    map.allocate(int(nx), int(ny), std::ptrdiff_t(nx));
    return map;
}

void scale_heights(HeightMap& map, double factor) {
    for (double& z : std::span(map.data.get(), map.points())) z *= factor;
}

void reverse_columns(HeightMap& map) {
    for (const int j : indices(map.ny)) std::reverse(map.row(j), map.row(j) + map.nx);
}

void reverse_rows(HeightMap& map) {
    for (int j = 0; j < map.ny - 1 - j; ++j)
        std::swap_ranges(map.row(j), map.row(j) + map.nx, map.row(map.ny - 1 - j));
}

}  // namespace rsc
