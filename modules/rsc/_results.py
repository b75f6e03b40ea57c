"""Result files and studies as arrays."""

from __future__ import annotations

import os
from typing import Any

from ._h import FILE
from ._library import Error, lock


def read(path: str | os.PathLike[str], xarray: bool | None = None) -> Any:
    """Reads a result file. path: its path. xarray: True for an xarray.Dataset (which needs Debian's
    python3-xarray), False for a dictionary {variable: numpy array} with the file's attributes under
    the empty name ""; None, the default, for the Dataset if xarray is installed. For the manifest
    of a study, the members are read as one cube: every variable that all of them have gets a
    dimension for each key that varies, with the values of the key; if the members do not form a
    full grid, one dimension 'member'. Needs netCDF4 (Debian's python3-netcdf4). Shapes, units and
    meanings are those of the file (ncdump -h); missing reals are NaN. Raises Error if the file
    cannot be read, is cut or damaged, ImportError if a package is missing."""
    path = os.fspath(path)
    from ._cube import attributes_of, filled
    from ._sound import open_result

    try:
        with lock(), open_result(path) as file:
            variables = {name: filled(variable[...]) for name, variable in file.variables.items()}
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            if xarray is not False:
                about = {
                    name: (v.dimensions, attributes_of(v)) for name, v in file.variables.items()
                }
                coordinates = [
                    name for name, v in file.variables.items() if v.dimensions == (name,)
                ]
    except OSError as error:
        raise Error(f"{path}: cannot be read: {error.strerror or error}", FILE) from None
    if xarray is not False:
        try:
            import xarray as package
        except ImportError:
            if xarray:
                raise
            xarray = False
    if "member" in variables and "file" in variables:
        return _cube(path, xarray is not False)
    if xarray is not False:
        data = {
            name: (about[name][0], values, about[name][1]) for name, values in variables.items()
        }
        if "separation" in data and data["separation"][0] == ("step",):
            coordinates.append("separation")
        return package.Dataset(
            {k: v for k, v in data.items() if k not in coordinates},
            {k: data[k] for k in coordinates},
            attributes,
        )
    variables[""] = attributes
    return variables


def _cube(path: str, dataset: bool) -> Any:
    """The members of a study as one object: a Dataset, or a dictionary of arrays with {name:
    dimensions} under the name "dimensions"."""
    from . import _cube as cubes

    try:
        with lock():
            cube = cubes.cube(path)
    except OSError as error:
        name = error.filename or path
        raise Error(f"{name}: cannot be read: {error.strerror or error}", FILE) from None
    if not dataset:
        return {name: values for name, (_, values, _) in cube.variables.items()} | {
            "": cube.attributes,
            "dimensions": {name: d for name, (d, _, _) in cube.variables.items()},
        }
    import xarray

    coordinates = {
        name
        for name, (dimensions, _, _) in cube.variables.items()
        if dimensions == (name,) or name in cube.keys
    }
    return xarray.Dataset(
        {k: v for k, v in cube.variables.items() if k not in coordinates},
        {k: cube.variables[k] for k in coordinates},
        cube.attributes,
    )
