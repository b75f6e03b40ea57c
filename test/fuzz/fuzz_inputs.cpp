// Any bytes as a file of heights, of a spectrum or of asperities: text, .gwy, .sdf, or NetCDF of
// the classic formats. Files of the HDF5 kind are left to fuzz_netcdf: their bytes are the affair
// of the HDF5 library, which is known to fall over damaged ones.
#include "read_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = scratch("fuzz_inputs");
    if (memmem(data, size, "\x89HDF\r\n\x1a\n", 8)) return -1;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    read_input(path, size % 2 == 0 ? std::optional<double>(1.0) : std::nullopt);
    return 0;
}
