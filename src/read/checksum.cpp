#include "read/checksum.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "error.hpp"
#include "format.hpp"

namespace rsc {
namespace {

std::string line_of(uLong crc) { return format("\nrsc: CRC-32 of all before this line: %08lx\n", crc & 0xffffffffUL); }

}  // namespace

std::string checksum_line(const char* bytes, std::size_t size) { return line_of(crc32_z(0, reinterpret_cast<const Bytef*>(bytes), size)); }

void require_sound(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    std::string line = line_of(0);
    const std::streamoff length = static_cast<std::streamoff>(line.size()), digits = 9,
                         size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
    if (size < length) return;
    const std::string start = line.substr(0, line.size() - digits);
    in.seekg(size - length);
    if (!in.read(line.data(), length)) return;
    if (!line.starts_with(start)) {
        if (line.find(start) != std::string::npos)
            throw Error(Failure::bad_input, path + ": is cut off: its last line, the checksum, is not whole");
        return;
    }
    std::vector<char> buffer(1 << 20);
    uLong crc = 0;
    in.seekg(0);
    for (std::streamoff left = size - length; left > 0 && in;) {
        in.read(buffer.data(), std::min(left, static_cast<std::streamoff>(buffer.size())));
        crc = crc32_z(crc, reinterpret_cast<const Bytef*>(buffer.data()), static_cast<std::size_t>(in.gcount()));
        left -= in.gcount();
    }
    if (line_of(crc) != line)
        throw Error(Failure::bad_input,
                    path +
                        ": is damaged, or was changed since rsc wrote it: its checksum does not hold (nccopy makes a copy "
                        "without one)");
}

}  // namespace rsc
