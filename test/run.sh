#!/bin/sh
# All tests: installs what is missing, builds everything, runs ctest. Arguments go to ctest, e.g. -L unit.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
sh input/setup.sh -DRSC_TESTS=ON
cd build
ctest --output-on-failure --parallel "$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)" "$@"
