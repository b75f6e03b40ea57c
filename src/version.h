/* The one place where the version stands: CMake, the C API, the Fortran module and the NetCDF files take it from here. */
#define RSC_VERSION "0.2.0"
