#!/bin/sh
# The first run: installs missing packages, builds, runs input/first.nml and draws its result.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
cd "$top"
sh input/setup.sh -DRSC_TESTS=OFF
cp build/rsc ./rsc
./rsc < input/first.nml
python3 output/plot/plot.py output/first.nc
