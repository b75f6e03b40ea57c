#!/bin/sh
# Installs missing packages (on Debian and derivatives; elsewhere it lists them and stops) and
# builds rsc in build/.
# Usage: sh input/setup.sh      from anywhere; extra arguments go to cmake, e.g. -DRSC_MPI=ON
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)

missing=
need() {  # need PACKAGE COMMAND...: PACKAGE (Debian's name) is missing unless COMMAND succeeds
    package=$1
    shift
    "$@" > /dev/null 2>&1 || missing="$missing $package"
}
header() { printf '#include <%s>\n' "$1" | g++ -E -x c++ - ; }
header_udunits() { header udunits2.h || header udunits2/udunits2.h; }
header_cholmod() { header suitesparse/cholmod.h || header cholmod.h; }
links() { echo 'int main() {}' | g++ -x c++ - -o /dev/null "$@"; }
can_plot() { "$1" -c 'import numpy, matplotlib, netCDF4'; }
plots() { can_plot python3 || can_plot /usr/bin/python3; }
look() {
    missing=
    need g++ command -v g++
    need gfortran command -v gfortran
    need cmake command -v cmake
    need make command -v make
    need pkg-config command -v pkg-config
    need libopenblas-dev links -llapack -lblas
    need libfftw3-dev pkg-config --exists fftw3 fftw3f
    need libnetcdf-dev pkg-config --exists netcdf
    need libnetcdff-dev pkg-config --exists netcdf-fortran
    need libudunits2-dev header_udunits
    need librandom123-dev header Random123/philox.h
    need libboost-dev header boost/math/special_functions/gamma.hpp
    need zlib1g-dev header zlib.h
    need libsuitesparse-dev header_cholmod
    need netcdf-bin command -v ncdump
    need python3 command -v python3
    need 'python3-matplotlib python3-netcdf4' plots
}

look
if [ -n "$missing" ]; then
    echo "rsc: missing:$missing"
    if ! command -v apt-get > /dev/null 2>&1; then
        echo "rsc: please install these (the names are Debian's) and run the command again." >&2
        exit 1
    elif [ "$(id -u)" = 0 ]; then
        as_root=
    elif command -v sudo > /dev/null 2>&1 && sudo -n true 2> /dev/null; then
        as_root=sudo
    else
        echo "rsc: please install them first, for instance: sudo apt-get install$missing" >&2
        exit 1
    fi
    $as_root apt-get update
    # shellcheck disable=SC2086
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
    look
    if [ -n "$missing" ]; then
        echo "rsc: still missing after the installation:$missing" >&2
        exit 1
    fi
fi

cmake -S "$top" -B "$top/build" "$@"
cmake --build "$top/build" --parallel "$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)"
