"""Result files for pictures: variables by name with absent values as NaN, units fit for a label, what a case says, and what tells
several results apart."""

import os
import re
import sys

try:
    import netCDF4
    import numpy as np
except ImportError as missing:
    sys.exit(f"The Python module {missing.name!r} is missing; on Debian: apt install python3-numpy python3-matplotlib python3-netcdf4")

# Keys that do not change what is computed.
_NO_MATTER = ("run%title", "run%threads", "output%")
# How a key is written in a legend, and the unit of its values: "length", "force", "modulus" or none.
_SYMBOLS = {
    "surface%sigma": (r"$\sigma$", "length"), "surface%hurst": ("$H$", ""), "surface%L": ("$L$", "length"), "surface%n": ("$n$", ""),
    "surface%L_lambda_l": (r"$L/\lambda_l$", ""), "surface%L_lambda_s": (r"$L/\lambda_s$", ""), "solids%R": ("$R$", "length"), "solids%E": ("$E$", "modulus"),
    "solids%nu": (r"$\nu$", ""), "solids%hardness": ("$H_0$", "modulus"), "solids%friction": (r"$\mu$", ""), "asperities%law": ("law", ""),
    "solver%model": ("model", ""), "solver%method": ("method", ""), "solver%interaction": ("interaction", ""), "run%seed": ("seed", ""),
}


def pretty_unit(text):
    """ 'N mm-2' as 'N mm$^{-2}$'."""
    return re.sub(r"(?<=[A-Za-z)])(-?\d+)\b", r"$^{\1}$", text)


def plain(unit):
    """' [N]' as ' N', behind a number."""
    return unit.replace("[", "").replace("]", "")


class Result:
    """One result file. result[name] is a variable as an array of doubles; name in result; result.mean(name) over realizations. OSError if there is
    no such file."""

    def __init__(self, path):
        self.path = path
        self.file = netCDF4.Dataset(path)
        self.cache = {}
        self.title = getattr(self.file, "title", "")
        self.realizations = len(self.file.dimensions["realization"]) if "realization" in self.file.dimensions else 1
        self.steps = len(self.file.dimensions["step"]) if "step" in self.file.dimensions else 0
        self.case = _keys(getattr(self.file, "case", ""))

    def __contains__(self, name):
        return name in self.file.variables

    def __getitem__(self, name):
        if name not in self.cache:
            self.cache[name] = self.window(name, Ellipsis)
        return self.cache[name]

    def window(self, name, *slices):
        """A part of a variable, without reading the rest."""
        return np.ma.filled(np.ma.asarray(self.file.variables[name][slices]).astype(float), np.nan)

    def mean(self, name):
        """A variable over steps: its mean over realizations where it has them."""
        values = self[name]
        return values.mean(axis=self.file.variables[name].dimensions.index("realization")) if "realization" in self.file.variables[name].dimensions else values

    def unit(self, name):
        """' [mm]' for a label; empty for a pure number."""
        text = getattr(self.file.variables[name], "units", "1")
        return "" if text == "1" else f" [{pretty_unit(text)}]"

    def attribute(self, name, attribute):
        """One value a pdf level; absent values as NaN."""
        values = np.atleast_1d(np.asarray(getattr(self.file.variables[name], attribute), dtype=float))
        return np.where(values > 9e36, np.nan, values)

    def number(self, key):
        """A key of the case as a number; of several values the last (of R: the sphere's)."""
        return float(self.case[key].split(",")[-1])

    def level(self, z):
        """Index of the level at Z0/sigma = z; None if the run has none within 0.02."""
        distance = abs(self["separation_sigma"] - z)
        return int(np.argmin(distance)) if distance.min() < 0.02 else None

    def depth(self):
        """The separation of each level for an axis, (values, label): in sigma where the file knows it."""
        sigma = self.mean("separation_sigma") if "separation_sigma" in self else np.full(self.steps, np.nan)
        if np.isfinite(sigma).all():
            return sigma, r"separation $Z_0/\sigma$"
        return self.mean("separation"), "separation $Z_0$" + self.unit("separation")

    def level_name(self, step):
        values, label = self.depth()
        name, _, unit = label.partition(" ")[2].partition(" [")
        return f"{name} = {values[step]:.3g}" + (f" {unit[:-1]}" if unit else "")

    def level_status(self):
        """The worst status of each level over realizations, 0 where nothing touches, and the names of the numbers."""
        if "status" not in self:
            return np.zeros(self.steps, int), ["converged"]
        variable = self.file.variables["status"]
        return np.nan_to_num(self["status"].reshape(-1, self.steps)).max(axis=0).astype(int), [name.replace("_", " ") for name in variable.flag_meanings.split()]

    def warning(self, step):
        """What is to be said about a level, for a legend: ' (overlapping)'; nothing for a converged one."""
        status, meanings = self.level_status()
        return f" ({meanings[status[step]]})" if status[step] > 0 else ""

    def loaded(self):
        """The levels with contact."""
        return np.flatnonzero(self["force_mean"] > 0) if "force_mean" in self else np.array([], int)

    def heading(self, what):
        many = f"mean over {self.realizations} realizations" if self.realizations > 1 else "one realization"
        return f"{what} ({many})\n{self.title}"

    def has_sphere(self):
        """False for a flat on a flat: nothing of Hertz then."""
        return "area_hertz" in self and bool(np.isfinite(self["area_hertz"]).any())


def _keys(text):
    """{group%key: value as text} of the namelist in a file."""
    case, group = {}, ""
    for line in text.splitlines():
        if line.startswith("&"):
            group = line[1:].strip()
        elif "=" in line and group != "study":
            key, value = line.split("=", 1)
            case[f"{group}%{key.strip()}"] = value.split("!")[0].strip().rstrip(",")
    return case


def differing_keys(results):
    """The keys in which the results differ, in the order of the first file."""
    keys = [key for key in results[0].case if not key.startswith(_NO_MATTER)]
    return [key for key in keys if len({r.case.get(key) for r in results}) > 1]


def key_label(key, result):
    """(symbol, unit) of a key."""
    symbol, kind = _SYMBOLS.get(key, (key.split("%")[1].replace("_", " "), ""))
    length, force = (result.case.get(f"run%{k}_unit", "").strip("'") for k in ("length", "force"))
    return symbol, {"length": length, "force": force, "modulus": f"{force} {length}$^{{-2}}$", "": ""}[kind]


def value_text(value):
    """One value of a key, or several, short: 'Infinity, 2.5' as 'inf, 2.5'; of a rigid or flat body the other one only."""
    parts = [part.strip() for part in value.split(",")]
    finite = [re.sub(r"\.0$", "", part) for part in parts if part != "Infinity"]
    return ", ".join(finite or ["inf"]).strip("'")


def names(results):
    """What each result is called in a legend: what varies between them; their titles or file names where nothing does."""
    if len(results) < 2:
        return [r.title or os.path.basename(r.path) for r in results]
    keys = differing_keys(results)
    if keys:
        texts = []
        for result in results:
            parts = [(*key_label(key, result), value_text(result.case.get(key, ""))) for key in keys]
            texts.append(", ".join("elastic" if key == "solids%hardness" and value == "inf" else f"{symbol} = {value}" + (f" {unit}" if unit else "") if value else f"{symbol} at default"
                                   for key, (symbol, unit, value) in zip(keys, parts)))
        if len(set(texts)) == len(texts) and max(map(len, texts)) < 90:
            return texts
    titles = [result.title for result in results]
    return titles if len(set(titles)) == len(titles) and all(titles) else [os.path.splitext(os.path.basename(result.path))[0] for result in results]


def members_of_manifest(path):
    """The results of a study that its manifest names; None for another file. Members that are not there yet are told and left out."""
    try:
        with netCDF4.Dataset(path) as file:
            if "member" not in file.dimensions or "file" not in file.variables:
                return None
            listed = [name.strip("\0 ") for name in np.atleast_1d(netCDF4.chartostring(file.variables["file"][:]))]
    except OSError:
        return None
    paths = [os.path.join(os.path.dirname(path), name) for name in listed]
    missing = [p for p in paths if not os.path.exists(p)]
    if missing:
        print(f"plot.py: {len(missing)} of {len(paths)} members have no result yet: {os.path.basename(missing[0])}, ...", file=sys.stderr)
    return [p for p in paths if os.path.exists(p)]
