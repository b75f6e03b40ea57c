/* The one place where the version stands: CMake, the C API, the Fortran module and the NetCDF files
 * take it from here; that RSC_VERSION_MAJOR, RSC_VERSION_MINOR and RSC_VERSION_PATCH of rsc.h say
 * the same is checked in api/guard.cpp. */
#define RSC_VERSION "0.4.0"
