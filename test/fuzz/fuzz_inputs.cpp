// Any bytes as a file of heights, of a spectrum or of asperities: text, .gwy, .sdf, or NetCDF of the classic formats. Files of the HDF5 kind are left to fuzz_netcdf:
// their bytes are the affair of the HDF5 library, which is known to fall over damaged ones.
#include <netcdf.h>

#include "memory_file.hpp"
#include "read_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static MemoryFile file;
    if (memmem(data, size, "\x89HDF\r\n\x1a\n", 8)) return -1;
    file.set(data, size);
    read_input(file.path(), size % 2 == 0 ? std::optional<double>(1.0) : std::nullopt);
    return 0;
}
