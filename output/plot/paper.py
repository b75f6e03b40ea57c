#!/usr/bin/env python3
"""Pictures and report of the paper's figures from the result files of input/paper/run.sh.

    python3 output/plot/paper.py [FOLDER]

reads the result files in FOLDER (default output/paper) and writes paper_*.png and report.txt there.
Needs numpy, scipy, matplotlib and netCDF4 (Debian: python3-scipy, python3-matplotlib,
python3-netcdf4)."""

import argparse
import os
import sys

from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "scipy", "netCDF4", "matplotlib")

from paper_common import Report, Result
import paper_contact
import paper_laws
import paper_pressure
import paper_surfaces

FIGURES = [
    paper_surfaces.asperities,
    paper_surfaces.curvatures,
    paper_contact.area,
    paper_contact.maps,
    paper_contact.radial,
    paper_pressure.pressures,
    paper_pressure.hardness,
    paper_pressure.full_pressure,
    paper_pressure.spots,
    paper_surfaces.density,
    paper_pressure.paper_method,
    paper_laws.laws,
]


def preface(report, folder):
    first = Result(os.path.join(folder, "maps.nc"))
    report.lines += [
        "Comparison of rsc with the numbers of the paper",
        "===================================",
    ]
    report.note(
        "V. A. Yastrebov, The Elastic Contact of Rough Spheres Investigated Using a "
        "Deterministic Multi-Asperity Model, Journal of Multiscale Modelling (2018). "
        + first.file.source
        + "."
    )
    report.note(
        "Columns: quantity, the paper's number, ours, its standard error over realizations "
        "(or parts of a surface), ours minus the paper's. '-' in the first column: not stated "
        "in the paper; '-' in the "
        "third: no sampling error. "
        "No parameter is tuned; variants of what the paper does not state are tried, and "
        "those that agree are named."
    )
    report.full = first.realizations == 2000
    if not report.full:
        report.note(
            "This is the SHORTENED version: few realizations on small grids. It shows that "
            "the command works; its numbers must not be compared with the paper's."
        )


def times(report, folder):
    path = os.path.join(folder, "times.txt")
    if not os.path.exists(path):
        return
    report.heading("Time")
    with open(path, encoding="utf-8") as lines:
        rows = [line.split() for line in lines]
    again = [row[0] for row in rows if "resumed" in row]
    report.note(
        f"Cases {sum(int(row[1]) for row in rows)} s in all with {os.cpu_count()} processors: "
        + ", ".join(f"{row[0]} {row[1]} s" for row in rows)
        + "."
        + (f" Interrupted, with the time of the last run: {', '.join(again)}." if again else "")
    )


def main():
    parser = argparse.ArgumentParser(description="Pictures and report of the paper's figures.")
    parser.add_argument(
        "folder",
        nargs="?",
        default="output/paper",
        help="folder with the result files (default output/paper)",
    )
    folder = parser.parse_args().folder
    report = Report()
    try:
        preface(report, folder)
        for figure in FIGURES:
            figure(folder, report)
        times(report, folder)
        path = os.path.join(folder, "report.txt")
        report.write(path)
    except OSError as error:
        sys.exit(f"paper.py: {error}; the result files are written by input/paper/run.sh")
    print(path)


if __name__ == "__main__":
    main()
