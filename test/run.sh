#!/bin/sh
# The tests: installs what is missing, builds everything, runs ctest. Without arguments what takes
# long (labels fuzz, long) is left out; arguments go to ctest, e.g. -L rooms.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
# rsc_mpi is tested where there is an MPI; rsc itself needs none.
if echo '#include <mpi.h>' | mpicc -E -x c - > /dev/null 2>&1 &&
    command -v mpirun > /dev/null 2>&1; then
    mpi=ON
else
    mpi=OFF
fi
sh input/setup.sh -DRSC_TESTS=ON -DRSC_MPI=$mpi
cd build
[ $# -gt 0 ] || set -- -LE 'fuzz|long'
ctest --output-on-failure --parallel "$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)" "$@"
