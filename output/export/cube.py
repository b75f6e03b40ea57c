#!/usr/bin/env python3
"""A study as one NetCDF file: every variable along the keys that vary.

    python3 output/export/cube.py output/study_manifest.nc               output/study_cube.nc

    import xarray
    xarray.open_dataset('output/study_cube.nc').force.sel(surface_sigma=0.01).mean('realization')

rsc.read('output/study_manifest.nc') in Python returns the same without a file. Needs numpy and
netCDF4 (Debian: python3-numpy python3-netcdf4)."""

import argparse
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "plot"), os.path.join(HERE, "..", "..", "modules")]
from plot_python import needs  # noqa: E402

if __name__ == "__main__":
    needs("numpy", "netCDF4")

import netCDF4  # noqa: E402

from rsc._cube import cube  # noqa: E402


def main(words=None):
    parser = argparse.ArgumentParser(
        description="A study of rsc as one NetCDF file, its variables along the keys that vary."
    )
    parser.add_argument("manifest", help="manifest of the study (..._manifest.nc)")
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="file to write (default: ..._cube.nc)"
    )
    arguments = parser.parse_args(words)
    path = (
        arguments.output
        or arguments.manifest.removesuffix(".nc").removesuffix("_manifest") + "_cube.nc"
    )
    try:
        found = cube(arguments.manifest)
        with netCDF4.Dataset(path, "w") as out:
            out.setncatts(found.attributes)
            for name, (dimensions, values, about) in found.variables.items():
                for dimension, size in zip(dimensions, values.shape):
                    if dimension not in out.dimensions:
                        out.createDimension(dimension, size)
                text = values.dtype.kind in "OU"
                variable = out.createVariable(
                    name,
                    str if text else values.dtype,
                    dimensions,
                    **({} if text else {"zlib": True}),
                )
                variable.setncatts(about)
                variable[...] = values.astype(object) if text else values
    except (OSError, IndexError, KeyError) as error:
        sys.exit(
            f"cube.py: {getattr(error, 'filename', None) or arguments.manifest}: "
            + (error.strerror or str(error) if isinstance(error, OSError) else "no list of members")
            + "; the manifest of a study (..._manifest.nc) is expected"
        )
    print(path)


if __name__ == "__main__":
    main()
