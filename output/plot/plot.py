#!/usr/bin/env python3
"""Pictures of result files of rsc.

    plot.py output/rsc.nc                     all pictures of the file, in its folder
    plot.py a.nc b.nc                         both in one picture, labelled by keys that differ
    plot.py output/study_manifest.nc          a study: curves, results against its keys
    plot.py output/study_manifest.nc --at 10  the study at the force 10 (of two flats: pressure)
    plot.py FILE --format pdf --width single  for a journal (single, onehalf, double, or mm)

Levels with doubts (variable `status`) have a mark, explained in the legend; a band is the expected
error, or the scatter over realizations. Needs numpy, matplotlib and netCDF4 (Debian:
python3-matplotlib, python3-netcdf4); if this Python lacks them, another one of this machine that
has them is used.
"""

import argparse
import os
import sys
from collections import namedtuple

from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "netCDF4", "matplotlib")

import plot_adhesion
import plot_area
import plot_compare
import plot_curves
import plot_distributions
import plot_flats
import plot_friction
import plot_law
import plot_line
import plot_map
import plot_profile
import plot_radial
import plot_seal
import plot_spots
import plot_stress
import plot_study
import plot_surface
import plot_texture
import plot_time
from plot_results import Result, members_of_manifest
from plot_style import WIDTHS, plt

# To add a picture, write a function of (results, options) that returns a figure, or None if the
# results lack its data.
PICTURES = {
    "load": plot_curves.load,
    "area": plot_area.area,
    "flats": plot_flats.flats,
    "seal": plot_seal.seal,
    "flow": plot_seal.flow,
    "law": plot_law.law,
    "study": plot_study.study,
    "pulloff": plot_study.pulloff,
    "map": plot_map.maps,
    "radial": plot_radial.radial,
    "line": plot_line.line,
    "spots": plot_spots.spots,
    "compare": plot_compare.compare,
    "distributions": plot_distributions.distributions,
    "surface": plot_surface.surface,
    "profile": plot_profile.profile,
    "texture": plot_texture.texture,
    "stiffness": plot_curves.stiffness,
    "resistance": plot_curves.resistance,
    "loop": plot_friction.loop,
    "stick": plot_friction.stick,
    "time": plot_time.time,
    "wear": plot_time.wear,
    "pull": plot_adhesion.pull,
    "stress": plot_stress.stress,
    "section": plot_stress.section,
}

Options = namedtuple(
    "Options",
    "width step say at",
    defaults=(180.0, None, lambda text: print(f"plot.py: {text}", file=sys.stderr), None),
)


def width(text):
    try:
        value = WIDTHS.get(text) or float(text)
    except ValueError:
        value = 0.0
    if not 40 <= value <= 1000:
        raise argparse.ArgumentTypeError(
            f"{text!r}: {', '.join(WIDTHS)} or 40 to 1000 millimetres are expected"
        )
    return value


def parse(words):
    parser = argparse.ArgumentParser(
        description="Pictures of result files of rsc: several files in one picture."
    )
    parser.add_argument(
        "result",
        nargs="+",
        help="result files (NetCDF), or the manifest of a study (..._manifest.nc)",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FOLDER",
        help="folder of the pictures (default: that of the first file)",
    )
    parser.add_argument(
        "--name",
        help=(
            "beginning of the names of the pictures (default: the name of the file, or of "
            "the first and last)"
        ),
    )
    parser.add_argument(
        "--only",
        metavar="PICTURE",
        action="append",
        choices=PICTURES,
        help="draw this picture only; repeatable: " + ", ".join(PICTURES),
    )
    parser.add_argument(
        "--step",
        type=int,
        metavar="N",
        help="draw maps, radial means, spots and friction of level N (from 1) only",
    )
    parser.add_argument(
        "--at",
        type=float,
        metavar="LOAD",
        help="draw the study at this force (of two flats: pressure), in the unit of the file",
    )
    parser.add_argument(
        "--format", choices=["png", "pdf", "svg"], default="png", help="png by default"
    )
    parser.add_argument(
        "--dpi",
        type=int,
        default=150,
        metavar="N",
        help="dots per inch of a png: 150 fit a screen (default), 300 or more a journal",
    )
    parser.add_argument(
        "--width",
        type=width,
        default=180.0,
        metavar="MM",
        help=(
            "width of the pictures: single (85 mm), onehalf (130), double (175) or a number "
            "of mm (default 180)"
        ),
    )
    return parser.parse_args(words)


def open_results(paths):
    """The results of all files, each once, with studies replaced by their members, and the
    beginning of the names of the pictures."""
    opened, stems = {}, []  # results by their real path
    for path in paths:
        members = members_of_manifest(path)
        for member in [path] if members is None else members:
            try:
                result = Result(member, in_si=True)
            except OSError as error:
                sys.exit(
                    f"plot.py: cannot read {member!r}: {error.strerror or error}; a result file "
                    "of rsc (NetCDF) is expected"
                )
            if "rsc" not in getattr(result.file, "source", ""):
                sys.exit(
                    f"plot.py: {member!r} is no result file of rsc: its attribute 'source' is "
                    "of another program"
                )
            opened.setdefault(os.path.realpath(member), result)
        stem = os.path.splitext(os.path.basename(path))[0]
        stems.append(stem if members is None else stem.removesuffix("_manifest"))
    return list(opened.values()), stems[0] if len(stems) == 1 else f"{stems[0]}_to_{stems[-1]}"


def main(words=None):
    arguments = parse(words)
    results, stem = open_results(arguments.result)
    options = Options(arguments.width, arguments.step, at=arguments.at)
    if not results:
        sys.exit("plot.py: the study has no results yet")
    for result in results if arguments.step is not None else []:
        if not 1 <= arguments.step <= result.steps:
            sys.exit(
                f"plot.py: --step {arguments.step}: {result.path} has levels 1 to {result.steps}"
            )
        if arguments.step - 1 not in result.loaded():
            touching = result.loaded() + 1
            options.say(
                f"--step {arguments.step}: nothing touches at this level of {result.path}; "
                + (
                    f"levels {touching.min()} to {touching.max()} have contact"
                    if touching.size
                    else "no level has contact"
                )
            )
    if not any(r.loaded().size for r in results) and "force" in results[0]:
        options.say("no level has contact, so there is little to draw")
    folder = arguments.output or os.path.dirname(arguments.result[0]) or "."
    drawn = 0
    try:
        os.makedirs(folder, exist_ok=True)
        for name in arguments.only or PICTURES:
            figure = PICTURES[name](results, options)
            if figure is None:
                if arguments.only:
                    options.say(f"{name}: the file has no data for this picture")
                continue
            path = os.path.join(folder, f"{arguments.name or stem}_{name}.{arguments.format}")
            figure.savefig(path, dpi=arguments.dpi)
            plt.close(figure)
            print(path)
            drawn += 1
    except OSError as error:
        sys.exit(f"plot.py: cannot write the pictures: {error}")
    if not drawn:
        options.say(f"nothing to draw in {', '.join(arguments.result)}")
    return 0 if drawn else 1


if __name__ == "__main__":
    sys.exit(main())
