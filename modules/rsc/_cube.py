"""A study as one cube: its manifest and its members become arrays along the keys that vary. For
rsc.read and output/export/cube.py."""

import os
from collections import namedtuple

import netCDF4
import numpy as np

from ._sound import open_result

# variables: {name: (dimensions, values, attributes)}; keys: names of the variables with the values
# of the keys.
Cube = namedtuple("Cube", "variables keys attributes")


def filled(values):
    """Missing reals as NaN; missing integers keep the fill value of the file."""
    return (
        np.ma.filled(values, np.nan)
        if np.ma.isMaskedArray(values) and values.dtype.kind == "f"
        else np.ma.getdata(values)
    )


def attributes_of(variable):
    return {a: variable.getncattr(a) for a in variable.ncattrs() if a != "_FillValue"}


def cube(path):
    """The Cube of a manifest. Members without a result yet are NaN. Variables of different shape in
    the members are omitted, as are lists of asperities and contacts; a coordinate that differs
    between members is stored under its name with '_values'. The attribute source says that the cube
    is none of the files that rsc wrote. Raises OSError."""
    with open_result(path) as file:
        keys = {
            name: (
                filled(v[:])
                if v.dtype.kind != "S"
                else np.array(
                    [str(t).strip("\0 '") for t in np.atleast_1d(netCDF4.chartostring(v[:]))]
                ),
                attributes_of(v),
            )
            for name, v in file.variables.items()
            if "key" in v.ncattrs()
        }
        members = [
            os.path.join(os.path.dirname(path), str(t).strip("\0 "))
            for t in np.atleast_1d(netCDF4.chartostring(file["file"][:]))
        ]
        attributes = {a: file.getncattr(a) for a in file.ncattrs()}
    attributes["source"] = f"members of a study by {attributes.get('source', 'rsc')}"
    order = {
        name: list(dict.fromkeys(values.tolist())) for name, (values, _) in keys.items()
    }  # in order of appearance
    shape = tuple(len(values) for values in order.values())
    places = [
        tuple(order[name].index(keys[name][0][k].item()) for name in keys)
        for k in range(len(members))
    ]
    grid = bool(keys) and np.prod(shape) == len(members) == len(set(places))
    front = tuple(keys) if grid else ("member",)
    shape, places = (
        (shape, places) if grid else ((len(members),), [(k,) for k in range(len(members))])
    )
    variables = {
        name: ((name,), np.array(order[name]), about) if grid else (("member",), values, about)
        for name, (values, about) in keys.items()
    }
    variables["file"] = front, np.empty(shape, object), {"long_name": "result file of the member"}
    for place, member in zip(places, members):
        variables["file"][1][place] = member
    read = {}
    for place, member in zip(places, members):
        if os.path.exists(member):
            with open_result(member) as file:
                read[place] = {
                    name: (v.dimensions, filled(v[...]), attributes_of(v))
                    for name, v in file.variables.items()
                    if v.dtype.kind in "fiu"
                }
    if not read:
        return Cube(variables, list(keys), attributes)
    first = next(iter(read.values()))
    for name, (dimensions, values, about) in first.items():
        if (
            any(name not in m or m[name][1].shape != values.shape for m in read.values())
            or name.startswith(("asperity_", "contact_start", "contact_count"))
            or {"contact", "asperity"} & set(dimensions)
        ):
            continue
        if dimensions == (name,) and all(np.array_equal(m[name][1], values) for m in read.values()):
            variables[name] = dimensions, values, about
            continue
        whole = len(read) == len(members)
        stacked = (
            np.full(shape + values.shape, np.nan)
            if values.dtype.kind == "f" or not whole
            else np.zeros(shape + values.shape, values.dtype)
        )
        for place, m in read.items():
            stacked[place] = m[name][1]
        variables[name + "_values" if dimensions == (name,) else name] = (
            front + dimensions,
            stacked,
            about,
        )
    return Cube(variables, list(keys), attributes)
