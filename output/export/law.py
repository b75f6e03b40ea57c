#!/usr/bin/env python3
"""The law of an interface from a result file of rsc, for finite-element, lubrication and particle
codes.

    law.py RESULT.nc --calculix     for an input deck of CalculiX, to standard output or -o FILE
    law.py RESULT.nc --abaqus       for an input deck of Abaqus
    law.py RESULT.nc --table        columns with the scatter, for modules/example/uinter.f90
    law.py RESULT.nc --text         every column, for modules/rsc_law.f90, rsc_law.h and rsc.law
    law.py RESULT.nc --lubrication  the same, which must have flow factors
    law.py RESULT.nc --netcdf -o F  every column with its errors and scatter, the case, the version

With --conductance the decks also have the thermal conductance of flats (*GAP CONDUCTANCE).

A sphere or another indenter becomes a nonlinear spring, force against approach; two flats
(boundary='periodic') pressure against overclosure. The law is the mean over realizations and
increases from level to level; levels that did not converge, or at which it would decrease, are
excluded and counted, as are with solids%hardness the levels after the first loading. Approach and
overclosure begin where the first asperity touches; a comment states this separation. Needs numpy
and netCDF4 (Debian: python3-numpy python3-netcdf4)."""

import argparse
import os
import re
import signal
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "plot"))
    from plot_python import needs

    needs("numpy", "netCDF4")

import numpy as np

from table import GRAVITY, NOT_CONVERGED, Refused, open_result


class Law:
    """approach (from 0), load and load_std (force, or pressure of flats), area and area_std
    (contact area, or area fraction), arrays over the points; origin: the separation where the
    approach is 0; numbers of excluded levels."""

    def __init__(self, path):
        with open_result(path) as file:
            self.path, self.title, self.source = (
                path,
                getattr(file, "title", ""),
                getattr(file, "source", ""),
            )
            variables = file.variables
            for name in ("separation", "force", "status"):
                if name not in variables:
                    raise Refused(
                        f"{path!r} is no result of indentation: it lacks the variable {name!r}"
                    )
            if "pull_off_force" in variables:
                raise Refused(
                    f"{path!r} has adhesion (solids%adhesion): loading and unloading differ, "
                    "and a table has only one curve"
                )
            self.flats = "pressure" in variables
            if "time" in variables and "energy_lost" in variables:
                raise Refused(
                    f"{path!r} has bodies that relax (solids%relaxation_time): the load "
                    "depends on time, and a table has only one curve"
                )
            if not self.flats and getattr(file, "indenter", "") == "flat":
                raise Refused(
                    f"{path!r} is of two flats with a border: a law of an interface needs "
                    "&indentation boundary='periodic'"
                )
            self.yields = "plastic_contacts" in variables
            load, area = ("pressure", "area_fraction") if self.flats else ("force", "contact_area")
            self.realizations = len(file.dimensions["realization"])
            self.units = {
                "approach": _unit(variables["separation"]),
                "load": _unit(variables[load]),
                "area": _unit(variables[area]) if area in variables else "1",
            }
            meanings = [
                word.replace("_", " ") for word in variables["status"].flag_meanings.split()
            ]
            table = {
                name: self._by_realization(variables[name])
                for name in {"separation", load, area, "status"} & set(variables)
            }
        z, n = table["separation"], table[load]
        a = table.get(area, np.full_like(n, np.nan))
        bad = (table["status"] == NOT_CONVERGED).any(axis=0)
        depth = -z.mean(axis=0)
        steps = np.arange(depth.size)
        later = self.yields & (depth <= np.fmax.accumulate(np.append(-np.inf, depth[:-1])))
        self.later, bad, z, n, a = (
            int(later.sum()),
            bad[~later],
            z[:, ~later],
            n[:, ~later],
            a[:, ~later],
        )
        table["status"] = table["status"][:, ~later]
        self.unconverged = int(bad.sum())
        status = table["status"].astype(int)
        worst = status[GRAVITY[status].argmax(axis=0), np.arange(status.shape[1])][
            ~bad & (n.mean(axis=0) > 0)
        ]
        self.statuses = ", ".join(
            f"{(worst == k).sum()} {word}" for k, word in enumerate(meanings) if (worst == k).any()
        )
        self._points(z[:, ~bad], n[:, ~bad], a[:, ~bad], steps[~later][~bad])

    def _by_realization(self, variable):
        """(realization, step), with the same row for all if a variable depends on steps only."""
        values = np.ma.filled(variable[:].astype(float), np.nan)
        return (
            np.broadcast_to(values, (self.realizations, values.shape[-1])).copy()
            if values.ndim == 1
            else values
        )

    def _points(self, z, n, a, steps):
        """The mean curve: loads at given separations, or separations at given loads, as prescribed
        in the run. `steps` of the file: without contact, and those of the law."""
        spread = [
            np.std(v, axis=0, ddof=1) if np.any(np.ptp(v, axis=0) > 0) else np.zeros(v.shape[1])
            for v in (z, n, a)
        ]
        self.prescribed = "separation" if not np.any(spread[0] > 0) else "load"
        depth, load, area = (v.mean(axis=0) for v in (-z, n, a))
        order = np.argsort(depth, kind="stable")
        depth, load, area, std = depth[order], load[order], area[order], [s[order] for s in spread]
        touching = load > 0
        if touching.sum() < 2:
            raise Refused(
                f"{self.path!r} has {touching.sum()} levels with contact: a law needs at least two"
            )
        first = int(np.argmax(touching))
        keep = []
        for k in range(first, depth.size):
            if load[k] > 0 and (
                not keep or load[k] > load[keep[-1]] and depth[k] > depth[keep[-1]]
            ):
                keep.append(k)
        self.without_contact = list(steps[order][:first])
        self.levels = list(steps[order][keep])
        self.not_increasing = int(touching.sum()) - len(keep)
        if len(keep) < 2:
            raise Refused(f"{self.path!r}: the load does not increase with the approach")
        self.extrapolated = first == 0
        if first > 0:
            start = depth[first - 1]  # the last level without contact
        else:  # the first level has a load: continue to zero by Hertz's law
            ratio = (load[keep[1]] / load[keep[0]]) ** (2 / 3)
            start = depth[keep[0]] - (depth[keep[1]] - depth[keep[0]]) / (ratio - 1)
        self.origin = -start
        self.approach, self.load = np.append(0.0, depth[keep] - start), np.append(0.0, load[keep])
        self.load_std, self.area = np.append(0.0, std[1][keep]), np.append(0.0, area[keep])
        self.area_std, self.separation_std = np.append(0.0, std[2][keep]), np.append(
            0.0, std[0][keep]
        )

    def comment(self):
        """Comments for the reader of the deck."""
        many = (
            f"mean over {self.realizations} realizations"
            if self.realizations > 1
            else "one realization"
        )
        load, approach = ("pressure", "overclosure") if self.flats else ("force", "approach")
        lines = [
            f"{self.title or os.path.basename(self.path)}: {load} against {approach}, {many}",
            f"units: {load} {self.units['load']}, {approach} {self.units['approach']}",
            f"{approach} = {self.origin:.9g} - separation of the "
            f"{'mean planes' if self.flats else 'tip from the mean plane'}"
            + (
                f" (no level without contact: continued to zero {load} by its 2/3 power)"
                if self.extrapolated
                else f" (the last level without contact)"
            ),
            f"{self.approach.size} points, {load} increasing; excluded: {self.unconverged} "
            f"levels not converged, {self.not_increasing} not increasing"
            + (
                f", {self.later} after the first loading (solids%hardness): unloading differs"
                if self.yields
                else ""
            ),
            f"status of the levels, the worst of the realizations: {self.statuses}",
            f"beyond the last point, {approach} {self.approach[-1]:.6g}, nothing was "
            f"computed: most programs keep the {load} constant there",
        ]
        if self.realizations > 1:
            relative = (
                self.load_std[-1] / self.load[-1]
                if self.prescribed == "separation"
                else self.separation_std[-1] / self.approach[-1]
            )
            lines.append(
                f"scatter over realizations at the last point: {100 * relative:.2g} % of the "
                f"{load if self.prescribed == 'separation' else approach} (standard "
                "deviation); "
                "all of it with --table"
            )
        lines.append(f"from {os.path.basename(self.path)}, {self.source}")
        # Texts of the file must neither end a comment nor contain terminal commands.
        return [re.sub(r"[\x00-\x1f\x7f-\x9f]", "?", line) for line in lines]


def _unit(variable):
    return getattr(variable, "units", "1")


def _deck(law, name, comment):
    """The keywords common to CalculiX and Abaqus."""
    lines = [f"** {line}" for line in comment]
    if law.flats:
        lines += [
            f"*SURFACE INTERACTION, NAME={name}",
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR",
        ]
        lines += [f"{p:.10g}, {c:.10g}" for c, p in zip(law.approach, law.load)]
    else:
        # In compression elongation and force are negative, and the table is in order of increasing
        # elongation.
        lines += [
            "** a spring between the tip and the plane (element type SPRINGA), longer than "
            "the whole approach; without tensile force",
            f"*SPRING, ELSET={name}, NONLINEAR",
            "",
        ]
        lines += [
            f"{0.0 - n:.10g}, {0.0 - d:.10g}" for d, n in zip(law.approach[::-1], law.load[::-1])
        ]
        lines += [f"0., {law.approach[-1]:.10g}"]
    return lines


def calculix(law, name):
    faces = [
        "the slave surface must be of element faces (*SURFACE, TYPE=ELEMENT): with one of "
        "nodes CalculiX gave 44 % more force"
    ]
    return _deck(law, name, law.comment() + (faces if law.flats else []))


def abaqus(law, name):
    lines = _deck(law, name, law.comment())
    if law.flats:
        pairs = [f"{v:.10g}" for point in zip(law.approach, law.load) for v in point]
        lines += [
            "** the same for modules/example/uinter.f90, pairs of overclosure and pressure:",
            f"** *SURFACE INTERACTION, NAME={name}, USER, PROPERTIES={len(pairs) + 1}, UNSYMM",
        ]
        values = ["0."] + pairs  # the first property: 0, a table follows
        lines += ["** " + ", ".join(values[k : k + 8]) for k in range(0, len(values), 8)]
    return lines


def conducting(path, write, name):
    """A deck with the thermal conductance per area against pressure. In CalculiX 2.20 this works
    with SURFACE TO SURFACE alone, where a tabular pressure-overclosure law transmits no pressure:
    the law is replaced by a straight line of its largest slope."""
    from interface_law import Interface

    law = Interface(path)
    lines, card = write(law, name), "*GAP CONDUCTANCE, PRESSURE"
    if write is calculix and law.flats:
        slope = np.max(np.diff(law.load) / np.diff(law.approach))
        card = "*GAP CONDUCTANCE"
        lines = [f"** {line}" for line in law.comment()] + [
            "** for heat: use it with *CONTACT PAIR, TYPE=SURFACE TO SURFACE. The slope is the "
            "largest of the law; with the table the interface would not conduct (ccx 2.20)",
            f"*SURFACE INTERACTION, NAME={name}",
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
            f"{slope:.10g}",
        ]
    column = law["conductance"]
    if not law.flats or column is None or not law.resistivity:
        raise Refused(
            f"{path!r}: --conductance needs two flats and their thermal resistivities, "
            "solids%resistivity [K/W times the unit of length]"
        )
    rows = [(v, p) for v, p in zip(column.values, law["pressure"].values) if p > 0][::-1]
    return lines + [
        f"** conductance per area [{column.unit}], pressure [{law['pressure'].unit}]",
        card,
        *(f"{v:.10g}, {p:.10g}" for v, p in [(0.0, 0.0)] + rows),
    ]


def text(law, name):
    from interface_law import Interface, text as lines_of

    return lines_of(Interface(law.path), name)


def lubrication(law, name):
    from interface_law import Interface, lubrication as lines_of

    return lines_of(Interface(law.path), name)


def table(law, name):
    load, area = ("pressure", "area_fraction") if law.flats else ("force", "contact_area")
    approach = "overclosure" if law.flats else "approach"
    header = [
        f"{approach} [{law.units['approach']}]",
        f"{load} [{law.units['load']}]",
        f"{load}_std",
        f"{area} [{law.units['area']}]",
        f"{area}_std",
        f"{approach}_std",
    ]
    rows = zip(law.approach, law.load, law.load_std, law.area, law.area_std, law.separation_std)
    return (
        [f"# {line}" for line in law.comment()]
        + ["# " + "  ".join(header)]
        + ["  ".join(f"{v:.12e}" for v in row) for row in rows]
    )


def main(words=None):
    parser = argparse.ArgumentParser(
        description=(
            "The law of an interface from a result file of rsc: for finite elements an indenter "
            "as a nonlinear spring, flats as pressure against overclosure; for other codes every "
            "quantity against the gap or the approach."
        )
    )
    parser.add_argument("result", help="result file (NetCDF)")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument(
        "--calculix",
        dest="write",
        action="store_const",
        const=calculix,
        help="keywords for a deck of CalculiX",
    )
    kind.add_argument(
        "--abaqus",
        dest="write",
        action="store_const",
        const=abaqus,
        help="keywords for a deck of Abaqus",
    )
    kind.add_argument(
        "--table",
        dest="write",
        action="store_const",
        const=table,
        help="columns: approach or overclosure, load, its scatter, area, its scatter",
    )
    kind.add_argument(
        "--text",
        dest="write",
        action="store_const",
        const=text,
        help="the text that modules/rsc_law.f90, modules/rsc_law.h and rsc.law evaluate",
    )
    kind.add_argument(
        "--lubrication",
        dest="write",
        action="store_const",
        const=lubrication,
        help="the same, with the flow factors of two flats (output%%flow)",
    )
    kind.add_argument(
        "--netcdf",
        action="store_true",
        help="a NetCDF file (-o) with every column, its errors and scatter",
    )
    parser.add_argument(
        "--conductance",
        action="store_true",
        help="with --calculix or --abaqus: also the thermal conductance of flats",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="file to write (default: standard output)"
    )
    parser.add_argument(
        "--name",
        default="ROUGH",
        help="name of the interaction or of the element set (default ROUGH)",
    )
    arguments = parser.parse_args(words)
    if arguments.netcdf and not arguments.output:
        parser.error("--netcdf needs -o FILE")
    if arguments.conductance and arguments.write not in (calculix, abaqus):
        parser.error("--conductance needs --calculix or --abaqus")
    try:
        if arguments.netcdf:
            from interface_law import Interface, write_netcdf

            write_netcdf(Interface(arguments.result), arguments.output)
            print(arguments.output)
            return
        if arguments.conductance:
            lines = conducting(arguments.result, arguments.write, arguments.name)
        else:
            lines = arguments.write(Law(arguments.result), arguments.name)
        if arguments.output:
            with open(arguments.output, "w", encoding="utf-8") as out:
                out.write("\n".join(lines) + "\n")
            print(arguments.output)
        else:
            print("\n".join(lines))
    except Refused as reason:
        sys.exit(f"law.py: {reason}")
    except OSError as error:
        sys.exit(f"law.py: cannot write: {error}")


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly in a pipe to head
    main()
