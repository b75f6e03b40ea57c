"""What the pictures and the report of the paper share: result files by name, the rows of the report, styles."""

import glob
import os
import re
import sys
import textwrap

try:
    import matplotlib

    matplotlib.use("Agg")  # works without a screen
    import matplotlib.pyplot as plt
    import netCDF4
    import numpy as np
    import scipy  # noqa: F401  (the other files need it: say here that it is missing)
except ImportError as missing:
    sys.exit(f"paper.py: the Python module {missing.name!r} is missing; on Debian: apt install python3-scipy python3-matplotlib python3-netcdf4")

# Curves differ by marker and line style as well as by colour: the pictures are readable in grey.
STYLES = [("o", "-", "#0b3c5d"), ("s", "--", "#c1440e"), ("^", "-.", "#4b8b3b"), ("D", ":", "#6a4c93"), ("v", "-", "#777777"), ("P", "--", "#b08d00"),
          ("X", "-.", "#000000"), ("<", ":", "#1f9e9e"), (">", "-", "#a03060")]

plt.rcParams.update({"figure.dpi": 130, "font.size": 9, "axes.titlesize": 9, "legend.fontsize": 7.5, "legend.framealpha": 0.9, "image.origin": "lower"})


class Result:
    """A result file: variables as arrays of doubles with absent values as NaN, and the keys of its case."""

    def __init__(self, path):
        self.path = path
        self.file = netCDF4.Dataset(path)
        self.cache = {}
        self.case = {}
        group = ""
        for line in self.file.case.splitlines():
            if line.startswith("&"):
                group = line[1:].strip()
            elif "=" in line:
                key, value = line.split("=", 1)
                self.case[f"{group}%{key.strip()}"] = value.split("!")[0].strip().rstrip(",")
        if "realization" in self.file.dimensions:
            self.realizations = len(self.file.dimensions["realization"])

    def __contains__(self, name):
        return name in self.file.variables

    def __getitem__(self, name):
        if name not in self.cache:
            self.cache[name] = np.ma.filled(np.ma.asarray(self.file.variables[name][:]).astype(float), np.nan)
        return self.cache[name]

    def attribute(self, name, attribute):
        values = np.atleast_1d(np.asarray(getattr(self.file.variables[name], attribute), dtype=float))
        return np.where(values > 9e36, np.nan, values)

    def number(self, key):
        """A key of the case as a number; of several values the last (of R: the sphere's)."""
        return float(self.case[key].split(",")[-1])

    def level(self, z):
        """Index of the level at Z0/sigma = z; None if the run has none within 0.02."""
        distance = abs(self["separation_sigma"] - z)
        return int(np.argmin(distance)) if distance.min() < 0.02 else None


def members(folder, name):
    """The result files of a study, in order."""
    return [Result(path) for path in sorted(glob.glob(os.path.join(folder, f"{name}_[0-9]*.nc")))]


def mean_and_error(values):
    """Mean and its standard error."""
    values = np.asarray(values, dtype=float)
    return values.mean(), values.std(ddof=1) / np.sqrt(values.size) if values.size > 1 else np.nan


def jackknife(count, estimate):
    """estimate(keep) with all, and its standard error by leaving out one of `count` parts at a time. `keep` is a boolean mask."""
    full = estimate(np.ones(count, bool))
    if count < 2:
        return full, np.full_like(full, np.nan)
    parts = np.array([estimate(np.arange(count) != k) for k in range(count)])
    return full, np.sqrt((count - 1) / count * ((parts - parts.mean(axis=0)) ** 2).sum(axis=0))


def text(value, digits=4):
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return "-"
    if isinstance(value, str):
        return value
    if value != 0 and abs(value) >= 1e4:
        return f"{value:,.0f}".replace(",", " ")
    return f"{value:.{digits}g}"


class Report:
    """The report, section by section. A row: what, the paper's number, ours, its standard error, and a word on it."""

    def __init__(self):
        self.lines = []
        self.full = True  # not the shortened version

    def heading(self, title):
        self.lines += ["", title, "-" * len(title)]

    def columns(self):
        self.lines.append(f"  {'':56s} {'paper':>12s} {'ours':>12s} {'+-':>10s} {'difference':>18s}")

    def row(self, what, paper, ours, error=np.nan, remark=None):
        difference = ""
        if isinstance(paper, (int, float)) and isinstance(ours, (int, float, np.floating)) and np.isfinite(ours):
            d = float(ours) - paper
            difference = f"{text(d, 3)} ({100 * d / paper:+.1f} %)" if paper else text(d, 3)
        self.lines.append(f"  {what:56s} {text(paper):>12s} {text(float(ours) if not isinstance(ours, str) else ours):>12s} "
                          f"{text(float(error), 2):>10s} {difference:>18s}".rstrip())
        if remark:
            self.note(remark, indent=6)

    def note(self, words, indent=2):
        self.lines += textwrap.wrap(re.sub(r"\s+", " ", words.strip()), width=110, initial_indent=" " * indent, subsequent_indent=" " * indent)

    def finding(self, words):
        """A note on what the full numbers say; of the shortened version's nobody has looked whether they say the same."""
        if self.full:
            self.note(words)

    def raw(self, line):
        self.lines.append("  " + line)

    def write(self, path):
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(self.lines).lstrip("\n") + "\n")


def save(figure, folder, name):
    path = os.path.join(folder, f"{name}.png")
    figure.savefig(path)
    plt.close(figure)
    print(path)


def judge(ours, error, paper):
    """'agrees within sampling' or how far off in standard errors."""
    if not np.isfinite(error) or error == 0:
        return ""
    pull = abs(ours - paper) / error
    return "agrees within sampling" if pull < 2.5 else f"{pull:.0f} standard errors apart"
