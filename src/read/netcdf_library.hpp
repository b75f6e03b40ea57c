// The NetCDF library as all of rsc uses it.
#pragma once

#include <mutex>

namespace rsc {

// NetCDF and HDF5 are not safe to call from several threads: this mutex is held during every call.
std::mutex& netcdf_mutex();

}  // namespace rsc
