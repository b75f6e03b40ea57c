#!/bin/sh
# Twins of ground surfaces against the ensemble that these came from (a minute):
# sh input/trust/twins.sh RSC FOLDER [PYTHON]
# 100 surfaces with a lay and valleys are pressed by a ball. Ten others of the same ensemble are
# stored as maps, read again as if they had been measured, and each has ten twins, made from the
# file of its run alone. Printed: means of both, with standard errors.
set -e
rsc=$1 to=$2 python=${3:-python3}
mkdir -p "$to"
case="&solids E=210e3,210e3 nu=0.3,0.3 R=Infinity,20 /
&solver model='asperities' / &asperities law='fourth_order' / &output map_cells=10 /
&surface L=1 sigma=1e-3 L_lambda_l=4 L_lambda_s=24 n=320
         aspect=4 direction=30 skewness=-0.8 kurtosis=4 /
&indentation unit='length' levels=1e-3, 0 /"
echo "$case" > "$to/ground.nml"
$rsc -q "$to/ground.nml" -s run%realizations=100 -s run%seed=1 -o "$to/ensemble.nc"
for k in 1 2 3 4 5 6 7 8 9 10; do
    $rsc -q "$to/ground.nml" -s run%seed=2 -s run%first_realization=$k -s output%heights=.true. \
        -o "$to/map$k.nc"
    echo "$case" | sed '/surface/,/kurtosis/d' > "$to/measured$k.nml"
    $rsc -q "$to/measured$k.nml" -s surface%source=heights -s surface%file="'$to/map$k.nc'" \
        -s surface%detrend=none -o "$to/measured$k.nc"
    $rsc -q "$to/measured${k}_twins.nml" -s run%realizations=10 -s run%seed=$((k + 2)) \
        -s surface%normalise=sample -o "$to/twins$k.nc"
done
$python - "$to" <<'END'
import sys
import netCDF4
import numpy as np

def read(name, variable):
    with netCDF4.Dataset(f"{sys.argv[1]}/{name}.nc") as file:
        return np.asarray(file[variable][:])

for what, variable, level in [
    ("N at 1 sigma", "force", 0), ("N at 0", "force", 1),
    ("A at 1 sigma", "contact_area", 0), ("A at 0", "contact_area", 1),
    ("Sdq", "rms_slope", None), ("Ssk", "skewness", None), ("Sku", "kurtosis", None),
]:
    pick = lambda name: read(name, variable) if level is None else read(name, variable)[:, level]
    ensemble = pick("ensemble")
    # A map is one sample, as its twins share its spectrum.
    twins = np.array([pick(f"twins{k}").mean() for k in range(1, 11)])
    error = [of.std(ddof=1) / np.sqrt(of.size) for of in (ensemble, twins)]
    off = (twins.mean() - ensemble.mean()) / np.hypot(*error)
    print(f"{what:14s} {ensemble.mean():11.5g} +- {error[0]:.2g}   twins {twins.mean():11.5g} "
          f"+- {error[1]:.2g}   difference {off:+.1f} standard errors")
END
