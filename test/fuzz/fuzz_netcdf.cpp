// NetCDF files of every format that are sound as files and odd in what they hold: names, types,
// shapes, attributes, values, sizes that are announced and never written. Some are cut short.
#include <fuzzer/FuzzedDataProvider.h>
#include <netcdf.h>

#include "read_input.hpp"

namespace {

const char* const kNames[] = {"height",
                              "x",
                              "y",
                              "asperity_x",
                              "asperity_y",
                              "asperity_z",
                              "asperity_radius",
                              "asperity_kappa1",
                              "asperity_kappa2",
                              "asperity_angle",
                              "asperity_biharmonic",
                              "z",
                              "other"};
const char* const kAttributes[] = {"_FillValue", "missing_value", "scale_factor",
                                   "add_offset", "units",         "long_name"};
const nc_type kTypes[] = {NC_DOUBLE, NC_DOUBLE, NC_FLOAT, NC_INT,    NC_SHORT, NC_BYTE,
                          NC_CHAR,   NC_UBYTE,  NC_INT64, NC_UINT64, NC_STRING};
const double kValues[] = {0,           1,      -1,    2,        3,
                          0.5,         1e-300, 1e300, -1e300,   NC_FILL_DOUBLE,
                          NC_FILL_INT, 127,    NAN,   INFINITY, 1e-12};

double value(FuzzedDataProvider& in) {
    const auto k = in.ConsumeIntegral<std::uint8_t>();
    return k < 128 ? double(k) : kValues[k % (sizeof kValues / sizeof *kValues)];
}

void attribute(FuzzedDataProvider& in, int file, int variable) {
    const char* const name = in.PickValueInArray(kAttributes);
    int there = -1;
    if (nc_inq_attid(file, variable, name, &there) == NC_NOERR)
        return;  // replacing one by another type crashes netCDF 4.9
    const std::size_t length = in.ConsumeIntegralInRange<std::size_t>(0, 3);
    if (in.ConsumeBool()) {
        const std::string text = in.ConsumeRandomLengthString(8);
        const char* words[] = {text.c_str(), "two", "three"};
        if (in.ConsumeBool())
            nc_put_att_text(file, variable, name, text.size(), text.data());
        else
            nc_put_att_string(file, variable, name, length, words);
        return;
    }
    double values[3] = {value(in), value(in), value(in)};
    nc_put_att_double(file, variable, name, in.PickValueInArray(kTypes), length, values);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = scratch("fuzz_netcdf.nc");
    FuzzedDataProvider in(data, size);
    static const int kFormats[] = {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4,
                                   NC_NETCDF4 | NC_CLASSIC_MODEL};
    int file = -1;
    if (nc_create(path.c_str(), NC_CLOBBER | in.PickValueInArray(kFormats), &file) != NC_NOERR)
        return -1;
    nc_set_fill(file, in.ConsumeBool() ? NC_NOFILL : NC_FILL, nullptr);
    std::vector<int> dimensions;
    bool large = false;
    for (int d = in.ConsumeIntegralInRange(1, 3); d > 0; --d) {
        std::size_t length = in.ConsumeIntegralInRange<std::size_t>(0, 9);
        if (in.ConsumeIntegral<std::uint8_t>() == 255)
            length = in.PickValueInArray<std::size_t>({2147483647, 4294967290, 100000});
        large = large || length > 9;
        int id = -1;
        if (nc_def_dim(file,
                       kNames[dimensions.size() == 0   ? 2
                              : dimensions.size() == 1 ? 1
                                                       : 12],
                       length, &id) == NC_NOERR)
            dimensions.push_back(id);
    }
    std::vector<int> variables;
    for (int v = in.ConsumeIntegralInRange(1, 8); v > 0 && !dimensions.empty(); --v) {
        int ids[3], id = -1;
        const int rank = in.ConsumeIntegralInRange(0, 3);
        for (int d = 0; d < rank; ++d)
            ids[d] = dimensions[in.ConsumeIntegralInRange<std::size_t>(0, dimensions.size() - 1)];
        if (nc_def_var(file, in.PickValueInArray(kNames), in.PickValueInArray(kTypes), rank, ids,
                       &id) != NC_NOERR)
            continue;
        variables.push_back(id);
        if (large && rank > 0)
            nc_def_var_chunking(file, id, NC_CHUNKED, std::vector<std::size_t>(3, 8).data());
        for (int a = in.ConsumeIntegralInRange(0, 2); a > 0; --a) attribute(in, file, id);
    }
    if (large)
        nc_set_fill(file, NC_NOFILL, nullptr);  // gigabytes of fill values are no test of a reader
    if (nc_enddef(file) == NC_NOERR && !large)
        for (const int id : variables) {
            std::vector<double> values(1000);
            for (double& v : values) v = value(in);
            if (in.ConsumeBool()) nc_put_var_double(file, id, values.data());
        }
    nc_close(file);
    std::error_code error;
    const auto length = std::filesystem::file_size(path, error);
    const bool cut = !error && in.ConsumeIntegral<std::uint8_t>() >= 224;
    if (cut)
        std::filesystem::resize_file(path, length * in.ConsumeIntegral<std::uint8_t>() / 256,
                                     error);
    if (!error) read_input(path, in.ConsumeBool() ? std::optional<double>(1.0) : std::nullopt);
    std::filesystem::remove(path, error);
    return 0;
}
