"""The law of an interface as columns over the levels of a result, for lubrication, finite-element
and particle codes: its text, which modules/rsc_law.f90, modules/rsc_law.h and rsc.law read, and its
NetCDF form. law.py writes both."""

import os
import re

import numpy as np

import law as laws
from table import Refused, open_result

AXES = "_x", "_y"


class Column:
    """values, their expected relative errors and their standard deviations over realizations, a
    number for each row, NaN where it is not known; words: how the column is interpolated against
    the first and against the second one (modules/rsc/law.py)."""

    def __init__(self, name, unit, words, meaning, values, error=None, std=None):
        self.name, self.words, self.meaning = name, words, meaning
        self.unit = re.sub(r"\s+", ".", unit)  # one word; UDUNITS reads it, too
        none = np.full(len(values), np.nan)
        self.values = values
        self.error, self.std = (none if v is None else v for v in (error, std))


class Interface(laws.Law):
    """columns: those of the law, a row for each level, by increasing gap (flats) or approach."""

    def __init__(self, path):
        super().__init__(path)
        self.steps = (self.without_contact + self.levels)[::-1] if self.flats else self.levels
        with open_result(path) as file:
            self.file, self.columns = file, []
            self.case = getattr(file, "case", "")
            self.sigma = self._number("sigma")
            self.e_star = self._number("e_star")
            self.summits = self._summits()
            self.resistivity = "resistance" in file.variables
            self._flats() if self.flats else self._indenter()
            self.file = None

    def __getitem__(self, name):
        return next((column for column in self.columns if column.name == name), None)

    def _number(self, name):
        if name not in self.file.variables:
            return np.nan
        return float(np.mean(np.ma.filled(self.file[name][...].astype(float), np.nan)))

    def _summits(self):
        """Density, mean radius, standard deviation of heights and mean height of the summits, from
        the moments of the surface (Nayak 1971, McCool 1987); None without them."""
        m2, m4 = self._number("m2"), self._number("m4")
        if not (m2 > 0 and m4 > 0 and self.sigma > 0):
            return None
        bandwidth = self.sigma**2 * m4 / m2**2
        return (
            m4 / (6 * np.pi * np.sqrt(3) * m2),
            0.375 * np.sqrt(np.pi / m4),
            self.sigma * np.sqrt(max(1 - 0.8968 / bandwidth, 0)),
            4 * self.sigma / np.sqrt(np.pi * bandwidth),
        )

    def _rows(self, name, part=None):
        """(realization, row) of a variable; None if the file lacks it."""
        if name not in self.file.variables:
            return None
        values = np.ma.filled(self.file[name][...].astype(float), np.nan)
        if part is not None:
            values = values[..., part]
        return np.broadcast_to(values, (self.realizations, values.shape[-1]))[:, self.steps]

    def _add(self, name, words, meaning, of=None, part=None, factor=1.0, unit=None):
        """The column of the variable `of` (or of its component) times a factor, if the file has it:
        the mean over realizations. Permeabilities: the geometric mean of the open ones, or 0 where
        most are closed."""
        of = of or name
        rows = self._rows(of, part)
        if rows is None:
            return
        free = np.isin(self.steps, self.without_contact)
        rows = np.where(free & np.isnan(rows), 0, rows)  # nothing is stiff or conducts there
        values = rows.mean(axis=0)
        if of == "permeability":
            is_open = rows > 0
            logs = np.log(np.where(is_open, rows, 1)).sum(axis=0)
            count = is_open.sum(axis=0)
            values = np.where(2 * count > self.realizations, np.exp(logs / np.maximum(count, 1)), 0)
        std = rows.std(axis=0, ddof=1) if self.realizations > 1 else None
        errors = self._rows(of + "_error_expected", part)
        self.columns.append(
            Column(
                name + ("" if part is None else AXES[part]),
                unit or laws._unit(self.file[of]),
                words,
                meaning + ("" if part is None else f" along {'xy'[part]}"),
                factor * values,
                None if errors is None else errors.mean(axis=0),
                None if std is None else abs(factor) * std,
            )
        )

    def _shared(self, area, of_area):
        """Stiffness and conductance, over the nominal area of flats. Without resistivities the
        conductance is that of unit resistivities, a length."""
        variables = self.file.variables
        each = " per nominal area" if self.flats else ""
        words = "exponential power" if self.flats else "power power"
        if "stiffness" in variables:
            unit = laws._unit(variables["stiffness"]) + of_area
            self._add("stiffness", words, "normal stiffness" + each, None, None, -1 / area, unit)
        if "conductance_length" not in variables:
            return
        unit, sum_of_resistivities, note = laws._unit(variables["conductance_length"]), 1.0, ""
        if self.resistivity:
            product = self._rows("resistance") * self._rows("conductance_length")
            sum_of_resistivities = float(np.nanmean(product))
            unit = f"({laws._unit(variables['resistance'])})-1"
        else:
            note = " times the sum of both resistivities"
        self._add("conductance", words, "thermal or electrical conductance" + each + note,
                  "conductance_length", None, 1 / (area * sum_of_resistivities), unit + of_area)

    def _flats(self):
        gap = "gap_mean" if "gap_mean" in self.file.variables else "separation"
        if gap == "gap_mean":  # full contact has no logarithm
            rows = self._rows(gap).mean(axis=0)
            self.steps = [step for step, width in zip(self.steps, rows) if width > 0]
        self._add("gap", "- logarithmic", "mean gap, with its closed parts" if gap == "gap_mean"
                  else "separation of the mean planes", gap)
        self._add("pressure", "exponential -", "nominal pressure")
        self._add("area_fraction", "exponential-to-1 power-to-1", "true over nominal contact area")
        self._shared(self._number("nominal_area"), "/" + laws._unit(self.file["nominal_area"]))
        for part, axis in enumerate(AXES):
            self._add("permeability", "power power", "permeability K", part=part)
            self._add("shear_flow", "power power", "flow S of a sliding smooth face", part=part)
            self._factors(axis)
        width, load = self["gap"].values, self["pressure"].values
        touches = load > 0
        if np.any(np.diff(width) <= 0) or np.any(np.diff(load[touches]) >= 0):
            raise Refused(f"{self.path!r}: the mean gap does not decrease with the pressure")

    def _factors(self, axis):
        """Those of Patir and Cheng, of the mean gap h: 12 K/h^3 and (h - 2 S)/sigma; and 2 S/h,
        which like the first one is 1 in a wide gap."""
        K, S, h = self["permeability" + axis], self["shear_flow" + axis], self["gap"].values
        if K is not None:
            self.columns.append(Column(
                "flow_factor_pressure" + axis, "1", "power-to-1 power-to-1",
                f"12 K/gap^3 along {axis[1]}", 12 * K.values / h**3, K.error, 12 * K.std / h**3))
        if S is not None:
            self.columns.append(Column(
                "flow_factor_sliding" + axis, "1", "power-to-1 power-to-1",
                f"2 S/gap along {axis[1]}", 2 * S.values / h, S.error, 2 * S.std / h))
        if S is not None and self.sigma > 0:
            factor = (h - 2 * S.values) / self.sigma
            with np.errstate(divide="ignore", invalid="ignore"):
                error = abs(2 * S.values * S.error / self.sigma / factor)
            self.columns.append(Column(
                "flow_factor_shear" + axis, "1", "logarithmic logarithmic",
                f"(gap - 2 S)/sigma along {axis[1]}, sigma = {self.sigma:.9g}", factor, error,
                2 * S.std / self.sigma))

    def _indenter(self):
        approach, load = self.approach[1:], self.load[1:]
        self.columns = [
            Column("approach", self.units["approach"], "- power", "from the first touch",
                   approach, None, self.separation_std[1:]),
            Column("force", self.units["load"], "power -", "normal force", load, None,
                   self.load_std[1:]),
        ]
        self._add("contact_area", "power power", "true contact area")
        self._shared(1.0, "")
        ratio, stiffness = _tangential_ratio(self.case), self["stiffness"]
        if ratio and stiffness:
            self.columns.append(Column(
                "tangential_stiffness", stiffness.unit, "power power", "in full stick, "
                f"{ratio:.6g} of the normal one", ratio * stiffness.values, stiffness.error,
                ratio * stiffness.std))

    def notes(self):
        """What a reader of the law must know, a line each."""
        many = (f"means over {self.realizations} realizations" if self.realizations > 1
                else "one realization")
        lines = [
            f"{self.title or os.path.basename(self.path)}: {many}, {len(self.steps)} rows",
            f"excluded: {self.unconverged} levels not converged, {self.not_increasing} not "
            f"increasing, {self.later} after the first loading",
            f"status of the levels, the worst of the realizations: {self.statuses}",
        ]
        if self.summits:
            density, radius, deviation, height = self.summits
            lines.append(
                f"rms height {self.sigma:.6g}; summits (McCool 1987): density {density:.6g}, mean "
                f"radius {radius:.6g}, mean height {height:.6g}, deviation of heights "
                f"{deviation:.6g}, density x radius x deviation "
                f"{density * radius * deviation:.6g}; E* = {self.e_star:.6g}"
            )
        if self.yields:
            lines.append("first loading of bodies that yield (solids%hardness): unloading differs")
        if not self.flats:
            origin = f"{self.origin:.9g}"
            lines.append(f"approach = {origin} - separation of the tip from the mean plane")
        closed = len(self.without_contact + self.levels) - len(self.steps) if self.flats else 0
        if closed:
            lines.append(f"{closed} levels of full contact are left out: the gap is closed there")
        lines.append(f"from {os.path.basename(self.path)}, {self.source}")
        return [re.sub(r"[\x00-\x1f\x7f-\x9f]", "?", line) for line in lines]


def _tangential_ratio(case):
    """Tangential over normal stiffness (Mindlin 1949), from E and nu of the case; None: unknown."""
    pairs = []
    for key in ("E", "nu"):
        found = re.search(rf"^\s*{key}\s*=\s*([^,\s]+),\s*([^,\s]+)", case, re.M)
        if not found:
            return None
        pairs.append([float(word) for word in found.groups()])
    normal = sum((1 - nu * nu) / E for E, nu in zip(*pairs))
    tangential = sum((2 - nu) * (1 + nu) / E for E, nu in zip(*pairs))
    return 2 * normal / tangential if tangential > 0 else None


def text(law, name):
    """Lines of the text of the law. A column with an unknown value is left out, and named."""
    whole = [column for column in law.columns if np.all(np.isfinite(column.values))]
    missing = [column.name for column in law.columns if column not in whole]
    lines = ["# rsc law 1"] + [f"# {line}" for line in law.notes()]
    if missing:
        lines.append(f"# left out, because some level lacks them: {', '.join(missing)}")
    lines += [f"# column {c.name} {c.unit} {c.words}: {c.meaning}" for c in whole]
    rows = zip(*(column.values for column in whole))
    return lines + ["  ".join(f"{value + 0.0:.15e}" for value in row) for row in rows]  # no -0


def lubrication(law, name):
    """The text, of flats with flow."""
    if not law.flats or law["flow_factor_pressure_x"] is None:
        raise Refused(
            f"{law.path!r} has no permeability: a law for lubrication needs two flats by elements, "
            "&indentation boundary='periodic' and &output flow=.true."
        )
    return text(law, name)


def write_netcdf(law, path):
    """The law as one NetCDF file: a variable for each column with its unit, meaning and words of
    interpolation, NAME_error_expected and NAME_std where they are known, the case, the version."""
    import netCDF4

    missing = netCDF4.default_fillvals["f8"]
    partial = path + ".part"
    with netCDF4.Dataset(partial, "w") as file:
        file.createDimension("row", len(law.steps))
        whole = [column for column in law.columns if np.all(np.isfinite(column.values))]
        for column in law.columns:
            for suffix, values, unit, meaning in (
                ("", column.values, column.unit, column.meaning),
                ("_error_expected", column.error, "1", "expected relative error of "),
                ("_std", column.std, column.unit, "standard deviation over realizations of "),
            ):
                if suffix and not np.any(np.isfinite(values)):
                    continue
                variable = file.createVariable(
                    column.name + suffix, "f8", ("row",), fill_value=missing
                )
                variable[:] = np.where(np.isfinite(values), values, missing)
                variable.units = unit
                variable.long_name = meaning + (column.name if suffix else "")
                if not suffix:
                    variable.interpolation = column.words
        file.Conventions = "CF-1.10"
        file.title, file.source, file.case = law.title, law.source, law.case
        file.law = " ".join(column.name for column in whole)
        file.comment = "\n".join(law.notes())
        file.realizations = law.realizations
        if law.sigma > 0:
            file.sigma = law.sigma
    os.replace(partial, path)
