#include "read/netcdf_library.hpp"

namespace rsc {

std::mutex& netcdf_mutex() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace rsc
