#!/usr/bin/env python3
"""The fields of a result (&output fields) for other programs.

    fields.py RESULT.nc                 RESULT_fields_3.vti: VTK image data of level 3, for ParaView
                                        and PyVista; stresses also as a volume, _stresses_3.vtr
    fields.py RESULT.nc --format csv    a table x, y, pressure, ... of each level
    fields.py RESULT.nc --format png    a picture of each level

A .vti file contains all fields of one level on its points, in the units of the result. Needs numpy
and netCDF4, for pictures matplotlib (Debian: python3-numpy python3-netcdf4 python3-matplotlib)."""

import argparse
import base64
import os
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "plot"))
    from plot_python import needs

    needs(
        "numpy",
        "netCDF4",
        *(["matplotlib"] if "png" in sys.argv[1:] or "--format=png" in sys.argv[1:] else []),
    )

import numpy as np

from table import Refused, open_result

NAMES = {
    "field_pressure": "pressure",
    "field_gap": "gap",
    "field_contact": "contact",
    "field_height": "height",
    "field_flow": "flow",
}
STRESSES = ("mises", "shear", "tension")


def read(path):
    """(x, y, {number of the level: {name: (values [y][x], unit)}}, unit of length)"""
    with open_result(path) as file:
        if "field_step" not in file.variables:
            raise Refused(
                f"{path!r} has no fields; a case with &output fields = 'pressure', 'gap' "
                "writes them"
            )
        at = (
            lambda name, k: np.ma.filled(file[name][k].astype(float), np.nan)
            if "field_step" in file[name].dimensions
            else file[name][:]
        )
        there = [name for name in NAMES if name in file.variables]
        levels = {
            int(step): {NAMES[name]: (np.asarray(at(name, k)), file[name].units) for name in there}
            for k, step in enumerate(file["field_step"][:])
        }
        for name in STRESSES:
            if "field_" + name not in file.variables:
                continue
            stress = file["field_" + name]
            for k, fields in enumerate(levels.values()):
                for d, depth in enumerate(file["depth"][:]):
                    fields[f"{name} at depth {depth:.6g}"] = np.asarray(stress[k, d]), stress.units
        return (
            np.asarray(file["field_x"][:]),
            np.asarray(file["field_y"][:]),
            levels,
            file["field_x"].units,
        )


def write_vti(path, x, y, fields):
    """VTK's XML image data: points on a grid, x fastest, every array as the base64 of its length in
    bytes and its numbers."""
    step = lambda v: float(v[1] - v[0]) if v.size > 1 else 1.0
    encoded = lambda values: base64.b64encode(
        np.uint64(8 * values.size).tobytes() + values.astype("<f8").tobytes()
    ).decode()
    arrays = "".join(
        f'<DataArray type="Float64" Name="{name} [{unit}]" format="binary">'
        f"{encoded(values)}</DataArray>\n"
        for name, (values, unit) in fields.items()
    )
    extent = f"0 {x.size - 1} 0 {y.size - 1} 0 0"
    with open(path, "w", encoding="ascii") as out:
        out.write(
            '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" '
            f'header_type="UInt64">\n<ImageData WholeExtent="{extent}" '
            f'Origin="{float(x[0])!r} {float(y[0])!r} 0" Spacing="{step(x)!r} {step(y)!r} 1">\n'
            f'<Piece Extent="{extent}">\n<PointData>\n{arrays}</PointData>\n</Piece>\n'
            "</ImageData>\n</VTKFile>\n"
        )


def read_volume(path):
    """(depth, {number of the level: {name: (stresses [depth][y][x], unit)}}), empty if there are
    none."""
    with open_result(path) as file:
        there = [name for name in STRESSES if "field_" + name in file.variables]
        if not there:
            return None, {}
        return np.asarray(file["depth"][:]), {
            int(step): {
                name: (np.asarray(file["field_" + name][k]), file["field_" + name].units)
                for name in there
            }
            for k, step in enumerate(file["field_step"][:])
        }


def write_vtr(path, x, y, depth, fields):
    """VTK's XML rectilinear grid, for depths at uneven distances: z is minus the depth, from the
    deepest plane up."""
    encoded = lambda values: base64.b64encode(
        np.uint64(8 * values.size).tobytes() + np.ascontiguousarray(values, "<f8").tobytes()
    ).decode()
    array = lambda name, values: (
        f'<DataArray type="Float64" Name="{name}" format="binary">'
        f"{encoded(values)}</DataArray>\n"
    )
    extent = f"0 {x.size - 1} 0 {y.size - 1} 0 {depth.size - 1}"
    coordinates = array("x", x) + array("y", y) + array("z", -depth[::-1])
    arrays = "".join(
        array(f"{name} [{unit}]", values[::-1]) for name, (values, unit) in fields.items()
    )
    with open(path, "w", encoding="ascii") as out:
        out.write(
            '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian" '
            f'header_type="UInt64">\n<RectilinearGrid WholeExtent="{extent}">\n'
            f'<Piece Extent="{extent}">\n<Coordinates>\n{coordinates}</Coordinates>\n'
            f"<PointData>\n{arrays}</PointData>\n</Piece>\n</RectilinearGrid>\n</VTKFile>\n"
        )


def write_csv(path, x, y, fields, length):
    columns = [np.tile(x, y.size), np.repeat(y, x.size)] + [
        values.ravel() for values, _ in fields.values()
    ]
    heading = [f"x [{length}]", f"y [{length}]"] + [
        f"{name} [{unit}]" if unit != "1" else name for name, (_, unit) in fields.items()
    ]
    np.savetxt(
        path,
        np.column_stack(columns),
        fmt="%.9g",
        delimiter=",",
        header=",".join(heading),
        comments="",
    )


def write_png(path, x, y, fields, length, title):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "plot"))
    from plot_style import COLOURS, Page, colour_bar, label, plt, si

    page = Page(
        argparse.Namespace(width=180.0), len(fields), aspect=0.82, columns=min(2, len(fields))
    )
    factor, dimension = si(length)
    x, y = x * factor, y * factor
    half = [(v[1] - v[0]) / 2 if v.size > 1 else 0.5 for v in (x, y)]
    for axis, (name, (values, unit)) in zip(page.axes, fields.items()):
        scale, of = si("" if unit == "1" else unit)
        values = np.ma.masked_invalid(values * scale)
        pulls = name == "pressure" and bool(
            (values < 0).any()
        )  # adhesion: blue, and the pressure red
        drawn = (
            np.ma.masked_where(values == 0 if pulls else ~(values > 0), values)
            if name in ("pressure", "contact")
            else values
        )
        top = float(
            np.ma.filled(
                np.percentile(np.abs(drawn.compressed()) if pulls else drawn.compressed(), 99.5)
                if drawn.count()
                else 1.0,
                1.0,
            )
        )  # excludes a few outliers
        limits = {"pressure": (-top if pulls else 0, top), "gap": (0, top), "contact": (0, 1)}.get(
            name, (None, None)
        )
        image = axis.imshow(
            drawn,
            extent=[x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1]],
            interpolation="nearest",
            vmin=limits[0],
            vmax=limits[1],
            cmap="coolwarm" if pulls else COLOURS if name in ("pressure", "contact") else "viridis",
        )
        if name != "contact":
            colour_bar(
                page.figure,
                image,
                axis,
                name,
                of,
                fraction=0.06,
                pad=0.03,
                aspect=20,
                extend="both"
                if pulls
                else "max"
                if name in ("pressure", "gap") and drawn.count() and drawn.max() > top
                else "neither",
            )
        axis.set_title(name)
        axis.locator_params(nbins=5)
        label(axis, "x", "$x$", dimension)
        label(axis, "y", "$y$", dimension)
    page.finish(title).savefig(path, dpi=150)
    plt.close(page.figure)


def main(words=None):
    parser = argparse.ArgumentParser(
        description=(
            "The fields of a result of rsc as VTK image data, CSV tables or pictures, "
            "one file for each level."
        )
    )
    parser.add_argument("result", help="result file with fields")
    parser.add_argument(
        "--format", choices=["vti", "csv", "png"], default="vti", help="vti by default"
    )
    parser.add_argument(
        "-o", "--output", metavar="FOLDER", help="folder of the files (default: that of the result)"
    )
    arguments = parser.parse_args(words)
    try:
        x, y, levels, length = read(arguments.result)
        folder, stem = (
            arguments.output or os.path.dirname(arguments.result) or ".",
            os.path.splitext(os.path.basename(arguments.result))[0],
        )
        os.makedirs(folder, exist_ok=True)
        for step, fields in levels.items():
            path = os.path.join(folder, f"{stem}_fields_{step}.{arguments.format}")
            if arguments.format == "vti":
                write_vti(path, x, y, fields)
            elif arguments.format == "csv":
                write_csv(path, x, y, fields, length)
            else:
                write_png(path, x, y, fields, length, f"Fields of level {step}")
            print(path)
        if arguments.format == "vti":
            depth, volumes = read_volume(arguments.result)
            for step, fields in volumes.items():
                path = os.path.join(folder, f"{stem}_stresses_{step}.vtr")
                write_vtr(path, x, y, depth, fields)
                print(path)
    except Refused as reason:
        sys.exit(f"fields.py: {reason}")
    except OSError as error:
        sys.exit(f"fields.py: cannot write: {error}")


if __name__ == "__main__":
    main()
