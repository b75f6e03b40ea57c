#!/usr/bin/env python3
"""A table of loads from result files of rsc: what the case computed at each level, with the
expected errors.

    table.py RESULT.nc                 every level: Markdown on a terminal, otherwise CSV
    table.py RESULT.nc --at 1,10,100   at these forces (pressures of two flats), in its unit
    table.py RESULT.nc --at 0.01 --by separation
    table.py RESULT.nc --columns force,pressure_max,mises_max
    table.py STUDY_manifest.nc --at 1  a row for every member and load

Values are means over the realizations that converged; *_stderr is the standard error of the mean,
the standard deviation over sqrt(number); *_error_expected is the expected error of the model if
the file has it, relative to the value (that of separation: a length). normal_stiffness is
-dN/dZ0 >= 0. Of stresses the depth where they are largest is
shown, with --columns every depth. Over several realizations permeability and
hydraulic_gap are geometric means, exp(mean of ln), of those whose gap is open, percolates is the
share of these, and *_ln_stderr the standard error of the mean of ln. Needs numpy and netCDF4
(Debian: python3-numpy python3-netcdf4)."""

import argparse
import csv
import os
import signal
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "plot"))
import plot_python  # noqa: E402

if __name__ == "__main__":
    plot_python.needs("numpy", "netCDF4")

import netCDF4  # noqa: E402
import numpy as np  # noqa: E402

DOUBTS, NOT_CONVERGED = 1, 4  # of the variable status
GRAVITY = np.array([0, 3, 1, 2, 4])  # out of validity overrides overlapping and not unique
# What is shown of a file that has it, in this order; the first is the load if it is there.
COLUMNS = [
    "pressure",
    "force",
    "force_per_length",
    "contact_area",
    "area_fraction",
    "separation",
    "time",
    "distance",
    "normal_stiffness",
    "pressure_max",
    "contacts",
    "gap_mean",
    "conductance_length",
    "resistance",
    "percolates",
    "permeability",
    "hydraulic_gap",
    "leak_rate",
    "plastic_contacts",
    "yielding_share",
    "plastic_work",
    "least_force",
    "energy_lost",
    "worn_volume",
    "wear_depth_max",
    "worn_rms",
    "tangential_stiffness",
    "cycle_work",
    "mises_max",
    "shear_max",
    "tension_max",
]
NEGATED = {"normal_stiffness": "stiffness"}  # columns that are minus a variable
GEOMETRIC = "permeability", "hydraulic_gap"
OPEN = "percolates", *GEOMETRIC
AXES = "_x", "_y"  # of the columns of a vector, or of the first two components of a tensor
EXPECTED = "_error_expected"
ROUNDING = 1e-9  # relative errors below it are those of the arithmetic, and not shown
DERIVED = EXPECTED, "_mean", "_std", "_stderr", "_count"  # variables that belong to another one


class Refused(Exception):
    """The file does not have what is asked for, for the reason in the message."""


class Table:
    """columns: {name: values over the levels}; units: {name: unit}; load: the column of --at;
    status: the most serious of each level."""

    def __init__(self, path, names=None):
        self.path = path
        with open_result(path) as file:
            variables = file.variables
            if "force" not in variables or "status" not in variables:
                raise Refused(
                    f"{path!r} is no result of indentation: it lacks the variable 'force' or "
                    "'status'"
                )
            self.meanings = variables["status"].flag_meanings.split()
            self.doubts = _doubts(variables["doubts"]) if "doubts" in variables else []
            self.remembers = "path" in file.ncattrs()  # levels depend on the levels before
            status = np.atleast_2d(np.ma.filled(variables["status"][:], NOT_CONVERGED)).astype(int)
            good = status != NOT_CONVERGED
            self.status = np.take_along_axis(status, GRAVITY[status].argmax(axis=0)[None], 0)[0]
            self.columns, self.units, self.counts = {}, {}, set()
            load = "pressure" if "pressure" in variables else "force"
            for name in dict.fromkeys([load, "separation", *names] if names else COLUMNS):
                variable = NEGATED.get(name, name)
                if variable in variables and "step" in variables[variable].dimensions:
                    self._read(file, name, variables[variable], good, bool(names))
                elif names:
                    raise Refused(
                        f"--columns: {path!r} has no {name!r} of its levels; it has "
                        + ", ".join(_of_levels(variables))
                    )
        self.words = [self._words([k]) for k in range(self.status.size)]
        self.load = "pressure" if "pressure" in self.columns else "force"

    def _read(self, file, name, variable, good, every_depth):
        """Adds the columns of a variable, one for each component, with their errors; of depths all
        or the one where the mean is largest."""
        every = -_numbers(variable) if name in NEGATED else _numbers(variable)
        unit = getattr(variable, "units", "1")
        errors = [
            (_numbers(file.variables[n]), getattr(file.variables[n], "units", "1"))
            for n in getattr(variable, "ancillary_variables", "").split()
        ]
        last = variable.dimensions[-1]
        if last == "step":
            parts = {"": ...}
        elif last == "cycle":  # the last one
            parts = {"": (..., -1)}
        elif last == "depth":
            depths = np.atleast_1d(_numbers(file.variables["depth"]))
            parts = {f"_at_{z:.4g}": (..., k) for k, z in enumerate(depths)}
            if not every_depth:
                parts, largest = self._largest(every, good)
                self._add(name + "_depth", depths[largest], file.variables["depth"].units)
        else:
            parts = {axis: (..., k) for k, axis in enumerate(AXES)}
        for suffix, part in parts.items():
            values, many = self._values(every[part], good)
            if not np.isfinite(values).any():
                continue
            column = name + suffix
            if many and name in GEOMETRIC:
                mean, stderr = _mean(np.log(np.where(values > 0, values, np.nan)))
                self._add(column, np.where(np.isfinite(mean), np.exp(mean), 0), unit)
                self._add(column + "_ln_stderr", stderr, "1")
            else:
                mean, stderr = _mean(values)
                self._add(column, mean, unit)
                if variable.dtype.kind in "iu" and not many:
                    self.counts.add(column)
                if many and (stderr > 1e-9 * abs(mean)).any():  # not a prescribed load
                    self._add(column + "_stderr", stderr, unit)
            for error, error_unit in errors:
                of_part = part if error.ndim == every.ndim else ...
                expected = _mean(self._values(error[of_part], good)[0])[0]
                if np.isfinite(expected).any():
                    self._add(column + EXPECTED, expected, error_unit)

    def _largest(self, every, good):
        """({"": index of the depth of each level where the mean is largest}, these depths)."""
        means = [_mean(self._values(values, good)[0])[0] for values in np.moveaxis(every, -1, 0)]
        largest = np.argmax(np.nan_to_num(means, nan=-np.inf), axis=0)
        return {"": (..., np.arange(largest.size), largest)}, largest

    def _words(self, levels):
        """The most serious status of some levels in words; that of doubts names them."""
        status = self.status[levels]
        worst = status[GRAVITY[status].argmax()]
        names = [name for name, doubted in self.doubts if doubted[levels].any()]
        return ", ".join(names) if worst == DOUBTS and names else self.meanings[worst]

    def _values(self, values, good):
        """(realization, step), with NaN for levels that did not converge; and True if there are
        several realizations."""
        many = values.ndim == 2 and values.shape[0] > 1
        return (
            np.where(
                good, values if values.ndim == 2 else np.broadcast_to(values, good.shape), np.nan
            ),
            many,
        )

    def _add(self, name, values, unit):
        self.columns[name], self.units[name] = values, unit

    def loading(self, by):
        """The levels by increasing load, so that every interpolation is unique; if levels depend on
        those before them, only the first loading."""
        load, depth = self.columns[self.load], -self.columns["separation"]
        levels = [k for k in range(load.size) if load[k] > 0 and np.isfinite(depth[k])]
        if not self.remembers:
            levels.sort(key=lambda k: load[k])
        kept = []
        for k in levels:
            if (
                not kept
                or load[k] > load[kept[-1]]
                and (by != "separation" or depth[k] > depth[kept[-1]])
            ):
                kept.append(k)
        if len(kept) < 2:
            raise Refused(
                f"{self.path!r} has fewer than two levels of increasing load: nothing can be "
                "interpolated"
            )
        return kept

    def at(self, wanted, by=None):
        """The table at these values of the load, or of the separation, as (columns, words of the
        status). Between levels positive quantities follow a power law of the load (of the
        separation: an exponential), others a straight line in its logarithm; interpolated values
        are between those of the two neighbours, and increasing quantities remain increasing;
        counts are rounded."""
        by = by or self.load
        levels = self.loading(by)
        known = self.columns[by][levels]
        ends = sorted((known[0], known[-1]))
        for value in wanted:  # a prescribed load is exact only to the solver's tolerance
            if not ends[0] - 1e-4 * abs(ends[0]) <= value <= ends[1] + 1e-4 * abs(ends[1]):
                raise Refused(
                    f"--at {value:g}: {self.path!r} has {by} from {ends[0]:.6g} to "
                    f"{ends[1]:.6g} {self.units[by]}; nothing is extrapolated"
                )
        wanted = np.asarray(wanted, float)
        x, at = (-known, -wanted) if by == "separation" else (np.log(known), np.log(wanted))
        right = np.clip(np.searchsorted(x, at), 1, x.size - 1)
        share = np.clip((at - x[right - 1]) / (x[right] - x[right - 1]), 0.0, 1.0)
        columns = {}
        for name, values in self.columns.items():
            a, b = values[levels][right - 1], values[levels][right]
            rounding = 1e-12 * np.nanmax(np.abs(values), initial=0)  # not of a closed gap, 0
            power = (a > rounding) & (b > rounding)
            safe_a, safe_b = np.where(power, a, 1.0), np.where(power, b, 1.0)
            between = np.where(power, safe_a * (safe_b / safe_a) ** share, a + share * (b - a))
            if name.startswith(OPEN):  # between an open and a closed gap nothing is known
                between = np.where((a > 0) == (b > 0), between, np.nan)
            if name in self.counts:
                between = np.round(between)
            columns[name] = np.where(share == 0, a, np.where(share == 1, b, between))
        columns[by] = wanted
        used = [
            [levels[r - 1]] if s == 0 else [levels[r]] if s == 1 else levels[r - 1 : r + 1]
            for r, s in zip(right, share)
        ]
        return columns, [self._words(np.array(some)) for some in used]


def _doubts(variable):
    """[(words of a doubt, whether a level has it in any realization)]."""
    bits = np.atleast_2d(np.ma.filled(variable[:], 0)).astype(int)
    bits = np.bitwise_or.reduce(bits, axis=0)
    names = variable.flag_meanings.split()
    masks = np.atleast_1d(variable.flag_masks).tolist()
    return [(name.replace("_", " "), bits & mask > 0) for name, mask in zip(names, masks)]


def _of_levels(variables):
    """Names of the variables with a value, a vector or depths at each level."""
    return [
        name
        for name, variable in variables.items()
        if "step" in variable.dimensions[-2:]
        and variable.dimensions[-1] in ("step", "component", "tensor_component", "depth")
        and not name.endswith(DERIVED)
    ]


def _numbers(variable):
    """The values of a variable, NaN where they are missing."""
    return np.ma.filled(np.ma.asarray(variable[:]).astype(float), np.nan)


def open_result(path):
    try:
        return plot_python.open_result(path)
    except OSError as error:
        raise Refused(f"cannot read {path!r}: {error.strerror or error}") from None


def _mean(values):
    """Mean and its standard error over the first axis without NaN; for fewer than two values the
    error is NaN."""
    there = np.isfinite(values)
    count = there.sum(axis=0)
    mean = np.where(there, values, 0.0).sum(axis=0) / np.where(count, count, np.nan)
    squares = np.where(there, (values - mean) ** 2, 0.0).sum(axis=0)
    return mean, np.sqrt(
        squares / np.where(count > 1, count - 1, np.nan) / np.where(count, count, np.nan)
    )


def members(path):
    """[(path, {key: value as text})] of a manifest of a study; None for another file."""
    with open_result(path) as file:
        if "member" not in file.dimensions or "file" not in file.variables:
            return None
        texts = lambda variable: [
            str(t).strip("\0 ") for t in np.atleast_1d(netCDF4.chartostring(variable[:]))
        ]
        keys = {
            v.key: texts(v) if v.dtype.kind == "S" else [f"{x:.9g}" for x in np.atleast_1d(v[:])]
            for v in file.variables.values()
            if hasattr(v, "key")
        }
        return [
            (
                os.path.join(os.path.dirname(path), name),
                {key: values[k] for key, values in keys.items()},
            )
            for k, name in enumerate(texts(file.variables["file"]))
        ]


def rows(paths, at=None, by=None, names=None):
    """(header, rows of texts) of the files, with studies replaced by their members; the first
    column is the file if there are several; names: the columns, by default COLUMNS."""
    found = []
    for path in paths:
        found += members(path) or [(path, {})]
    header, lines = {}, []
    for path, keys in found:
        table = Table(path, names)
        columns, words = table.at(at, by) if at else (table.columns, table.words)
        fixed = ({"file": os.path.basename(path)} if len(found) > 1 else {}) | keys
        titles = {
            name: f"{name} [{table.units[name]}]" if table.units[name] != "1" else name
            for name in columns
        }
        header |= {name: None for name in fixed} | {name: None for name in titles.values()}
        lines += [
            fixed
            | {
                titles[n]: f"{round(v[k], 2) if n == 'contacts' else v[k]:.6g}"
                if np.isfinite(v[k])
                else ""
                for n, v in columns.items()
            }
            | {"status": words[k]}
            for k in range(len(words))
        ]
    header = [*header, "status"]
    return header, [[line.get(name, "") for name in header] for line in lines]


def with_errors(header, lines):
    """The same with each expected error in the column of its value, as in "1.23 +- 4 %"."""
    place = {name.split(" [")[0]: k for k, name in enumerate(header)}
    error_of = {place[name[: -len(EXPECTED)]]: k for name, k in place.items() if EXPECTED in name}

    def cell(line, k):
        error = line[error_of[k]] if k in error_of else ""
        if not error or not line[k]:
            return line[k]
        relative = header[error_of[k]].endswith(EXPECTED)
        if float(error) < ROUNDING or not float(line[k]):
            return line[k]
        size = f"{100 * float(error):.2g} %" if relative else f"{float(error):.2g}"
        return f"{line[k]} +- {size}"

    shown = [k for k in range(len(header)) if k not in error_of.values()]
    return [header[k] for k in shown], [[cell(line, k) for k in shown] for line in lines]


def markdown(header, lines):
    """The text of a table whose values have their errors beside them."""
    header, lines = with_errors(header, lines)
    widths = [max(map(len, column)) for column in zip(header, *lines)]
    return (
        "\n".join(
            "| " + " | ".join(text.rjust(width) for text, width in zip(line, widths)) + " |"
            for line in [header, ["-" * (w - 1) + ":" for w in widths], *lines]
        )
        + "\n"
    )


def numbers(text):
    try:
        return [float(word) for word in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r}: numbers with commas between are expected"
        ) from None


def main(words=None):
    parser = argparse.ArgumentParser(
        description=(
            "A table of loads from result files of rsc, with standard errors and "
            "expected errors."
        )
    )
    parser.add_argument(
        "result",
        nargs="+",
        help="result files (NetCDF), or the manifest of a study (..._manifest.nc)",
    )
    parser.add_argument(
        "--at",
        type=numbers,
        metavar="N,N,...",
        help="at these loads, between levels by interpolation (default: every level)",
    )
    parser.add_argument(
        "--by",
        choices=["force", "pressure", "separation"],
        help="quantity of --at (default: force, for two flats pressure)",
    )
    parser.add_argument(
        "--columns",
        type=lambda text: text.split(","),
        metavar="NAME,NAME,...",
        help="variables of the levels to show (default: what answers the case); of stiffness also "
        "normal_stiffness, its negative",
    )
    parser.add_argument(
        "--format",
        choices=["csv", "markdown"],
        help="default: markdown on a terminal, csv elsewhere",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="file to write (default: standard output); markdown if it ends in .md",
    )
    arguments = parser.parse_args(words)
    try:
        header, lines = rows(
            arguments.result, arguments.at, arguments.by, arguments.columns
        )
        kind = arguments.format or (
            "markdown"
            if (arguments.output or "").endswith(".md")
            or not arguments.output
            and sys.stdout.isatty()
            else "csv"
        )
        out = (
            open(arguments.output, "w", encoding="utf-8", newline="")
            if arguments.output
            else sys.stdout
        )
        if kind == "markdown":
            out.write(markdown(header, lines))
        else:
            csv.writer(out, lineterminator="\n").writerows([header, *lines])
        if arguments.output:
            out.close()
            print(arguments.output)
    except Refused as reason:
        sys.exit(f"table.py: {reason}")
    except KeyError as name:
        sys.exit(f"table.py: --by {name}: the file has no such variable")
    except OSError as error:
        sys.exit(f"table.py: cannot write: {error}")


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # ends quietly in a pipe to head
    main()
