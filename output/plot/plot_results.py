"""Result files for pictures: variables by name with missing values as NaN, keys of the case, and
the keys that distinguish several results."""

import os
import re
import sys

import netCDF4
import numpy as np

from plot_python import open_result
from plot_style import FEW, STYLES, amount, plt, si

# Keys without effect on the numbers.
_NO_MATTER = ("run%title", "run%threads", "output%")
# Symbol of a key in a legend, and the unit of its values: "length", "force", "modulus" or none.
_SYMBOLS = {
    "surface%sigma": (r"$\sigma$", "length"),
    "surface%hurst": ("Hurst exponent $H$", ""),
    "surface%L": ("$L$", "length"),
    "surface%n": ("$n$", ""),
    "surface%L_lambda_l": (r"$L/\lambda_l$", ""),
    "surface%L_lambda_s": (r"$L/\lambda_s$", ""),
    "solids%R": ("$R$", "length"),
    "solids%E": ("$E$", "modulus"),
    "solids%nu": (r"$\nu$", ""),
    "solids%hardness": ("$H_0$", "modulus"),
    "solids%layer_thickness": ("layer thickness", "length"),
    "solids%layer_E": ("layer $E$", "modulus"),
    "solids%friction": (r"$\mu$", ""),
    "asperities%law": ("law", ""),
    "solver%model": ("model", ""),
    "solver%method": ("method", ""),
    "solver%interaction": ("interaction", ""),
    "run%seed": ("seed", ""),
}


class Result:
    """One result file. result[name] is a variable as an array of doubles; name in result;
    result.mean(name) over realizations. With in_si everything is in SI units, for any units of the
    file. OSError if there is no such file."""

    def __init__(self, path, in_si=False):
        self.path, self.in_si = path, in_si
        self.file = open_result(path)
        self.cache = {}
        self.title = getattr(self.file, "title", "")
        self.realizations = (
            len(self.file.dimensions["realization"]) if "realization" in self.file.dimensions else 1
        )
        self.steps = len(self.file.dimensions["step"]) if "step" in self.file.dimensions else 0
        self.case = _keys(getattr(self.file, "case", ""))

    def __contains__(self, name):
        return name in self.file.variables

    def __getitem__(self, name):
        if name not in self.cache:
            self.cache[name] = self.window(name, Ellipsis)
        return self.cache[name]

    def factor(self, name):
        return si(self.unit(name))[0] if self.in_si else 1.0

    def window(self, name, *slices):
        """A part of a variable, read alone."""
        return np.ma.filled(
            np.ma.asarray(self.file.variables[name][slices]).astype(float), np.nan
        ) * self.factor(name)

    def cells(self, name, level):
        """A map at one level, 0 where it has no value, and the sides x0, x1, y0, y1 of the surface.
        The last row may extend beyond the surface: its values are means over the part that does
        not."""
        field, side, share = (
            np.nan_to_num(self.window(name, level)),
            float(self["map_cell_side"]),
            float(getattr(self.file["y"], "share_of_last_row", 1.0)),
        )
        field[-1] /= share
        return field, (
            self["x"][0] - side / 2,
            self["x"][-1] + side / 2,
            self["y"][0] - side / 2,
            self["y"][-1] + (share - 0.5) * side,
        )

    def mean(self, name):
        """A variable over steps: its mean over the realizations that have a value, if it depends on
        realizations."""
        values = self[name]
        if "realization" not in self.file.variables[name].dimensions:
            return values
        axis = self.file.variables[name].dimensions.index("realization")
        there = np.isfinite(values)
        return np.where(there, values, 0).sum(axis=axis) / np.where(
            there.any(axis=axis), there.sum(axis=axis), np.nan
        )

    def worst(self, name):
        """The maximum of a variable over realizations, for each step."""
        return np.nan_to_num(self[name].reshape(-1, self.steps)).max(axis=0)

    def error(self, name):
        """The largest expected error of a variable over realizations relative to its mean, for each
        step; 0 if the file has none."""
        of, mean = ("area" if name == "contact_area" else name) + "_error_expected", abs(
            self.mean(name)
        )
        worst = 0 * mean
        if of in self:
            # An error with a unit (of a length) is absolute.
            size = 1.0 if self.unit(of) else self[name]
            worst = np.nan_to_num(abs(self[of] * size).reshape(-1, self.steps)).max(axis=0)
        return np.divide(worst, mean, out=np.zeros(self.steps), where=mean > 0)

    def standard_error(self, values):
        """Of the mean over realizations, the first axis of values; 0 for fewer than three."""
        there = np.isfinite(values)
        count = there.sum(axis=0)
        mean = np.where(there, values, 0).sum(axis=0) / np.maximum(count, 1)
        squares = np.where(there, (values - mean) ** 2, 0).sum(axis=0)
        return np.where(count > 2, np.sqrt(squares / np.maximum(count * (count - 1), 1)), 0)

    def unit(self, name):
        """The unit in the file; empty for a pure number."""
        text = getattr(self.file.variables[name], "units", "1")
        return "" if text == "1" else text

    def dimension(self, name):
        """'N m-2' of a pressure: the SI unit of a variable."""
        return si(self.unit(name))[1]

    def attribute(self, name, attribute):
        """One value for each pdf level; missing values as NaN."""
        values = np.atleast_1d(
            np.asarray(getattr(self.file.variables[name], attribute), dtype=float)
        )
        return np.where(values > 9e36, np.nan, values)

    def number(self, key):
        """A key of the case as a number, in the units of the case; of several values the last (for
        R, that of the sphere)."""
        return float(self.case[key].split(",")[-1])

    def level(self, z):
        """Index of the level at Z0/sigma = z; None if the run has none within 0.02."""
        distance = abs(self["separation_sigma"] - z)
        return int(np.argmin(distance)) if distance.min() < 0.02 else None

    def depth(self):
        """The separation of each level for an axis, (values, label, dimension): in sigma if the
        file has it."""
        sigma = (
            self.mean("separation_sigma")
            if "separation_sigma" in self
            else np.full(self.steps, np.nan)
        )
        if np.isfinite(sigma).all():
            return sigma, r"separation $Z_0/\sigma$", ""
        return self.mean("separation"), "separation $Z_0$", self.dimension("separation")

    def control(self):
        """'separation', 'force' or 'pressure': the controlled quantity of the levels."""
        return self.case.get("indentation%control", "separation").strip("'")

    def level_name(self, step):
        """Name of a level: the separation, force or pressure of the case unless it is constant in
        time, and the time or the distance of sliding if the file has it."""
        values, text, dimension = self.depth()
        symbol = text.partition(" ")[2]
        if self.control() in ("force", "pressure") and self.control() in self:
            values, symbol, dimension = (
                self.mean(self.control()),
                {"force": "$N$", "pressure": "$p$"}[self.control()],
                self.dimension(self.control()),
            )
        name = f"{symbol} = {amount(values[step], dimension)}"
        clock = next((c for c in ("time", "distance") if c in self), None)
        if not clock:
            return name
        symbol = "$t$" if clock == "time" else "$s$"
        time = f"{symbol} = {amount(self[clock][step], self.dimension(clock))}"
        # A prescribed load is exact only to the solver's tolerance.
        return (
            time
            if np.nanmax(values) - np.nanmin(values) <= 1e-3 * np.nanmax(abs(values))
            else f"{name}, {time}"
        )

    def level_status(self):
        """The worst status of each level over realizations, 0 without contact."""
        if "status" not in self:
            return np.zeros(self.steps, int)
        grave = np.array([0, 3, 1, 2, 4])  # doubts override overlapping and not unique
        status = np.nan_to_num(self["status"].reshape(-1, self.steps)).astype(int)
        return status[grave[status].argmax(axis=0), np.arange(self.steps)]

    def causes(self, steps):
        """What the status of these levels is, as a set of words: the doubts, or its name."""
        words, status = set(), self.level_status()
        for step in np.atleast_1d(steps):
            value = status[step]
            if value == 1 and "doubts" in self:
                names = self.file.variables["doubts"].flag_meanings.split()
                bits = np.bitwise_or.reduce(np.nan_to_num(self["doubts"][:, step]).astype(int))
                words |= {name for k, name in enumerate(names) if bits >> k & 1}
            elif value > 0:
                words.add(self.file.variables["status"].flag_meanings.split()[value])
        return {word.replace("_", " ") for word in words}

    def warning(self, step):
        """The causes of a level, ' (few points)'; empty for a converged one."""
        words = ", ".join(sorted(self.causes(step)))
        return f" ({words})" if words else ""

    def loaded(self):
        """The levels with contact; with adhesion their forces may be negative."""
        return (
            np.flatnonzero(
                np.nan_to_num(self.mean("contact_area" if self.pulls() else "force")) > 0
            )
            if "force" in self
            else np.array([], int)
        )

    def carrying(self):
        """The levels with contact or force: adhesion with a range attracts without contact."""
        return (
            np.union1d(self.loaded(), np.flatnonzero(np.nan_to_num(self.mean("force"))))
            if self.pulls()
            else self.loaded()
        )

    def pulls(self):
        """True for a contact with adhesion."""
        return "pull_off_force" in self

    def load_varies(self):
        """True if there is a curve over the load: of more than one level, and not constant as for
        creep."""
        force = self.mean("force")[self.loaded()] if "force" in self else np.zeros(0)
        return force.size > 1 and bool(np.ptp(force) > 1e-3 * force.max())

    def chosen(self, count, step):
        """The requested level, or `count` converged levels with contact, evenly spaced and ending
        with the last; none without contact."""
        loaded = self.loaded()
        if step is not None:
            return [step - 1] if step - 1 in loaded else []
        if "status" in self:  # maps and radial means have nothing of levels that did not converge
            loaded = loaded[(self["status"].reshape(-1, self.steps)[:, loaded] < 4).any(axis=0)]
        if loaded.size <= count:
            return [int(step) for step in loaded]
        return (
            sorted(
                {
                    int(s)
                    for s in loaded[
                        np.linspace(0, loaded.size - 1, count + 1).round().astype(int)[1:]
                    ]
                }
            )
            if loaded.size
            else []
        )

    def branches(self):
        """The levels with a force as branches of loading or unloading, [(levels, unloading)]. If
        levels do not depend on the levels before, the levels in order of their separation are one
        branch."""
        at, z = (
            self.carrying(),
            self.mean("separation") if "separation" in self else self.depth()[0],
        )
        remembers = (
            self.case.get("solids%hardness", "Infinity") != "Infinity"
            or ("jumps" in self and self.worst("jumps").any())
            or ("time" in self and "energy_lost" in self)
            or "worn_volume" in self
        )
        if not remembers or at.size < 2:
            return [(at[np.argsort(-z[at], kind="stable")], False)]
        away = np.diff(z[at]) > 0
        cuts = [0, *(np.flatnonzero(np.diff(away)) + 1), at.size - 1]
        return [(at[a : b + 1], bool(away[a])) for a, b in zip(cuts[:-1], cuts[1:])]

    def heading(self, what):
        many = (
            f"mean over {self.realizations} realizations"
            if self.realizations > 1
            else "one realization"
        )
        return f"{what} ({many})\n{self.title}"

    def has_sphere(self):
        """True if the file has the contact of the smooth indenter."""
        return "area_hertz" in self and bool(np.isfinite(self["area_hertz"]).any())

    def is_ball(self):
        """True if the smooth indenter is a ball on a half-space (Hertz)."""
        return self.has_sphere() and self.shape() == "sphere"

    def hardness(self):
        """The hardness in the unit of pressures; Infinity for elastic bodies."""
        return float(self.case.get("solids%hardness", "Infinity")) * self.factor("map_pressure")

    def has_tip(self):
        """True for a round indenter, also on layers and bodies that relax, where its smooth contact
        has no closed form."""
        return self.has_sphere() or "r_star" in self and bool(np.isfinite(self["r_star"]))

    def shape(self):
        return self.case.get("indenter%shape", "sphere").strip("'")

    def smooth(self):
        """Name of the smooth indenter."""
        return f"smooth {self.shape()}" + (
            " (Hertz)" if self.shape() in ("sphere", "paraboloid") else ""
        )

    def half_width(self, step):
        """Half the width of the contact of a smooth cylinder (Hertz); NaN for other contacts."""
        if "force_per_length" not in self:
            return np.nan
        return self.half_width_under(max(self.mean("force_per_length")[step], 0))

    def half_width_under(self, load):
        """The same for a load per length, or for several."""
        if self.shape() != "paraboloid":
            return np.nan
        radii = [*self.case["indenter%radii"].split(","), self.case["solids%R"].split(",")[0]]
        curvature = sum(1 / float(radius) for radius in radii) / self.factor("separation")
        return 2 * np.sqrt(load / curvature / np.pi / self["e_star"])

    def line_reference(self):
        """The distance from a line load at which it lowers nothing."""
        given = self.case.get("indentation%line_reference", "").strip()
        if given:
            return float(given) * self.factor("separation")
        x0, x1, y0, y1 = self.sides()
        return x1 - x0 if self.along_y() else y1 - y0

    def along_y(self):
        """True if the axis of a line contact is along y."""
        return "periodic_y" in self.case.get("indentation%boundary", "")

    def sides(self):
        """The sides x0, x1, y0, y1 of the surface; None if the file has no map."""
        return self.cells("map_area_fraction", 0)[1] if "map_area_fraction" in self else None

    def pixels(self, step):
        """(flags of contact_mask, extent) of a level by elements; None if the file has none."""
        at = np.flatnonzero(self["mask_step"] == step + 1) if "mask_step" in self else []
        if not len(at):
            return None
        mask = np.asarray(self.file.variables["contact_mask"][int(at[0])])
        return mask, edges(self["mask_x"], self["mask_y"])

    def by_elements(self):
        model, source = (
            self.case.get(key, "").strip("'") for key in ("solver%model", "surface%source")
        )
        stored = "border_share" in self or "contact_x" in self
        return stored or model == "elements" or (model == "auto" and source == "heights")


def edges(x, y):
    """(x0, x1, y0, y1) of the pixels with these centres."""
    dx, dy = ((v[-1] - v[0]) / max(v.size - 1, 1) / 2 for v in (x, y))
    dx, dy = dx or dy, dy or dx  # a single column or row
    return x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy


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
    return (
        symbol,
        {"length": length, "force": force, "modulus": f"{force} {length}$^{{-2}}$", "": ""}[kind],
    )


def axis_label(key, result):
    symbol, unit = key_label(key, result)
    return symbol + (f" [{unit}]" if unit else "")


def value_text(value):
    """Short text of one or several values of a key; for a rigid or flat body only the other
    value."""
    parts = [part.strip() for part in value.split(",")]
    finite = [_plain(part) for part in parts if part != "Infinity"]
    return ", ".join(finite or ["inf"]).strip("'")


def _plain(text):
    """A number without a power of ten if it is short: '3e-04' as '0.0003'."""
    try:
        return f"{float(text):.12g}"
    except ValueError:
        return text


def with_unit(key, text, result):
    """A value of a key with a suitable unit, as '5 µm'."""
    value, unit = value_text(text), key_label(key, result)[1]
    try:
        factor, dimension = si(unit.replace("$^{-2}$", "-2"))
        return amount(float(value) * factor, dimension) if unit else value
    except (ValueError, OverflowError):
        return f"{value} {unit}".strip()


def _value_name(key, result):
    """'H = 0.8': a key and its value in a result."""
    symbol, value = key_label(key, result)[0], result.case.get(key, "")
    if key == "solids%hardness" and value == "Infinity":
        return "elastic"
    return f"{symbol} = {with_unit(key, value, result)}" if value else f"{symbol} at default"


def names(results):
    """The name of each result in a legend: keys that vary between results, or their titles or file
    names if no key does."""
    if len(results) < 2:
        return [r.title or os.path.basename(r.path) for r in results]
    keys = differing_keys(results)
    if keys:
        texts = []
        for result in results:
            texts.append(", ".join(_value_name(key, result) for key in keys))
        if len(set(texts)) == len(texts) and max(map(len, texts)) < 90:
            return texts
    titles = [result.title for result in results]
    return (
        titles
        if len(set(titles)) == len(titles) and all(titles)
        else [os.path.splitext(os.path.basename(result.path))[0] for result in results]
    )


class Looks:
    """Line and colour of each of several results, and its entry in the legend: individual for up to
    six. More results are distinguished by a colour scale along the key with the most values, and by
    line styles along a second key."""

    def __init__(self, results):
        self.names = names(results)
        self.scale = None
        if len(results) <= FEW:
            self.of = [
                (STYLES[k][1], STYLES[k][2], name if len(results) > 1 else None)
                for k, name in enumerate(self.names)
            ]
            return
        keys = differing_keys(results)
        keys = sorted(keys, key=lambda key: -len({r.case.get(key) for r in results}))
        values = lambda key: sorted({r.case.get(key, "") for r in results}, key=_in_order)
        if len(keys) in (1, 2) and len(values(keys[-1])) <= (
            len(STYLES) if len(keys) == 2 else len(results)
        ):
            first, shown = keys[0], values(keys[0])
            texts, place = [with_unit(first, v, results[0]) for v in shown], [
                shown.index(r.case.get(first, "")) for r in results
            ]
            title, second = key_label(first, results[0])[0], keys[1] if len(keys) == 2 else None
        else:
            second = None
            texts, place, title = (
                [", ".join(value_text(r.case.get(key, "")) for key in keys) for r in results],
                list(range(len(results))),
                ", ".join(axis_label(key, results[0]) for key in keys),
            )
            if not keys or max(map(len, [title, *texts])) > 60:
                texts, title = [str(k + 1) for k in place], "member"
        colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(texts)))
        self.scale = title, texts, colours
        lines = [
            STYLES[values(second).index(r.case.get(second, ""))][1] if second else "-"
            for r in results
        ]
        said = [_value_name(second, r) if second else None for r in results]
        self.of = [(line, colours[k], text) for line, k, text in zip(lines, place, said)]


def _in_order(text):
    try:
        return 0, float(value_text(text).split(",")[-1]), text
    except ValueError:
        return 1, 0.0, text


def members_of_manifest(path):
    """The results of a study from its manifest; None for another file. Missing members are reported
    and omitted."""
    try:
        with open_result(path) as file:
            if "member" not in file.dimensions or "file" not in file.variables:
                return None
            listed = [
                name.strip("\0 ")
                for name in np.atleast_1d(netCDF4.chartostring(file.variables["file"][:]))
            ]
    except OSError:
        return None
    paths = [os.path.join(os.path.dirname(path), name) for name in listed]
    missing = [p for p in paths if not os.path.exists(p)]
    if missing:
        print(
            f"plot.py: {len(missing)} of {len(paths)} members have no result yet: "
            f"{os.path.basename(missing[0])}, ...",
            file=sys.stderr,
        )
    return [p for p in paths if os.path.exists(p)]
