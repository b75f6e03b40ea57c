"""Every picture of plot.py and plot_surface.py as a whole: all that is drawn and written in it is compared with what is computed here from the file's own
variables, and what is not expected fails. The files have everything different from everything else: units, sides, tip, realizations, statuses.

usage: test_every_picture.py FOLDER_OF_PLOT        (RSC_PROGRAM in the environment)
"""
import functools
import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
import unittest.mock

import netCDF4
import numpy as np

sys.path.insert(0, sys.argv.pop(1))
import plot  # noqa: E402
import plot_surface  # noqa: E402
from figure_contents import ANYTHING, band, contents, differences, ellipses, legend_of, line, picture  # noqa: E402
from plot_results import Result  # noqa: E402
from plot_style import plt  # noqa: E402

# What the pictures promise to look like: markers, lines and colours by curve, marks by status.
STYLES = [("o", "-", "#0b3c5d"), ("s", "--", "#c1440e"), ("^", "-.", "#4b8b3b"), ("D", ":", "#6a4c93"), ("v", "-", "#777777"), ("P", "--", "#b08d00"), ("X", "-.", "#000000"),
          ("<", ":", "#1f9e9e"), (">", "-", "#a03060")]
MARKS = {1: ("o", "level out of validity"), 2: ("s", "level overlapping"), 3: ("^", "level not unique"), 4: ("x", "level not converged")}
WORDS = {1: " (out of validity)", 2: " (overlapping)", 3: " (not unique)", 4: " (not converged)", 0: ""}

SURFACE = "&surface n=256 L=1200.0 L_lambda_l=8 L_lambda_s=64 sigma=12.0 /"
UNITS = "length_unit='um' force_unit='mN'"
PLACE = "centre=500.0,680.0"
BALL = "&solids E=78.0,200.0 R=Infinity,3000.0 nu=0.42,0.3 resistivity=2.0e-5,3.0e-5 /"
CASES = {
    "one": SURFACE + BALL + f"&run title='One surface' {UNITS} / &indentation {PLACE} start=5.0 stop=0.0 steps=26 / &output map_cells=23 heights=.true. pdf_levels=0.0,0.6,3.0 /",
    "many": SURFACE + BALL.replace("3000", "4000") + f"&run realizations=5 {UNITS} / &indentation {PLACE} start=3.5 stop=0.5 steps=13 / &output map_cells=21 pdf_levels=0.5,1.0 /",
    "forced": SURFACE + BALL + f"&run realizations=3 {UNITS} / &indentation control='force' start=5.0 stop=5000.0 steps=6 spacing='log' / &output map_cells=20 pdf_levels=1.0 /",
    "flat": SURFACE + f"&solids R=Infinity,Infinity / &run {UNITS} / &indentation start=3.0 stop=1.0 steps=4 / &output map_cells=20 pdf_levels=1.0 /",
    "light": SURFACE + BALL + f"&run {UNITS} / &indentation start=3.2 stop=2.5 steps=3 /",
    "listed": "&surface source='asperities' file='LIST' L=1000.0 / &solids R=Infinity,3000.0 / &indentation unit='length' start=14.0 stop=2.0 steps=7 / &output map_cells=20 /"
              f"&run {UNITS} /",
    "middle": SURFACE + BALL + f"&run {UNITS} / &indentation start=2.0 stop=1.7 steps=3 /",
    "deep": SURFACE + BALL + f"&run {UNITS} / &indentation levels=-3.0,-3.5 /",
    "failed": SURFACE + BALL + f"&run {UNITS} / &indentation start=2.0 stop=0.0 steps=5 / &solver tolerance=1.0e-14 max_iterations=1 /",
    "yielding": SURFACE + BALL.replace("resistivity", "hardness=50.0 resistivity") + f"&run {UNITS} / &indentation {PLACE} levels=2.5,1.0 / &output heights=.true. /",
    "soft": SURFACE + BALL.replace("resistivity", "hardness=0.4 resistivity") + f"&run {UNITS} / &indentation {PLACE} levels=2.5,0.5 / &output pdf_levels=0.5 /",
    "pressed": "&surface n=128 L=700.0 L_lambda_l=4 L_lambda_s=32 sigma=0.9 / &solids R=Infinity,Infinity / &indentation boundary='periodic' control='pressure' unit='relative' levels=0.001,0.004,0.01 /"
               f"&run realizations=3 title='Pressed' {UNITS} /",
    "pressed_2": "&surface n=128 L=700.0 L_lambda_l=4 L_lambda_s=32 sigma=0.5 / &solids R=Infinity,Infinity / &indentation boundary='periodic' control='pressure' unit='relative' levels=0.002,0.005 /"
                 f"&run {UNITS} /",
    "slid": SURFACE + f"&solids friction=0.3 nu=0.3,0.25 E=200.0,100.0 R=Infinity,3000.0 / &run title='Slid' {UNITS} / &indentation {PLACE} start=3.0 stop=1.0 steps=41 /",
    "compared": "&surface n=128 L=1.3 L_lambda_l=4 L_lambda_s=16 sigma=0.01 / &asperities law='fourth_order' / &indentation levels=2.0,1.5,1.0 centre=0.7,0.6 / &compare levels=2.0,1.0 / &run title='Both' /",
    "compared_hertz": "&surface n=128 L=1.3 L_lambda_l=4 L_lambda_s=16 sigma=0.01 / &solids hardness=3.0e3 / &indentation levels=1.5,1.0 / &compare levels=1.5,1.0 /",
    "study": SURFACE + BALL + f"&run {UNITS} / &indentation start=2.0 stop=0.5 steps=4 / &study surface%sigma=5.0,10.0,20.0 surface%hurst=0.5,0.8 /",
}


def write_map(name):
    """Waves on a rectangle with other steps along x than along y; a plane tilts them."""
    rng = np.random.default_rng(5)
    x, y = (np.arange(130) + 0.5) * 1500 / 130, (np.arange(90) + 0.5) * 900 / 90
    z = 0.004 * x[None, :] - 0.002 * y[:, None]
    for _ in range(150):
        k, turn, phase = rng.uniform(0.022, 0.07), rng.uniform(0, 2 * np.pi), rng.uniform(0, 2 * np.pi)
        z = z + 0.002 * k**-1.8 * np.cos(k * (np.cos(turn) * x[None, :] + np.sin(turn) * y[:, None]) + phase)
    with netCDF4.Dataset(path(name), "w") as file:
        for axis, values in (("y", y), ("x", x)):
            file.createDimension(axis, values.size)
            file.createVariable(axis, "f8", (axis,))[:] = values
            file[axis].units = "um"
        file.createVariable("height", "f8", ("y", "x"))[:] = z
        file["height"].units = "um"


def setUpModule():
    global FOLDER
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name
    write_map("heights")
    for law, model in (("map", "asperities"), ("map_elements", "elements")):
        CASES[law] = (f"&surface source='heights' file='{path('heights')}' / &solids R=Infinity,9000.0 / &indentation centre=700.0,400.0 levels=1.5,1.0,0.5 / &solver model='{model}' /"
                      f"&output map_cells=20 heights=.true. contacts='all' / &run title='A map' {UNITS} /")
    CASES["compared_map"] = CASES["map"] + "&compare levels=1.0,0.5 /"
    rng = np.random.default_rng(3)
    np.savetxt(path("list"), np.column_stack([rng.uniform(100, 900, (80, 2)), rng.normal(0, 4, 80), rng.uniform(20, 60, 80)]))
    CASES["listed"] = CASES["listed"].replace("LIST", path("list"))
    for name, case in CASES.items():
        done = subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path(name)], input=case, text=True, capture_output=True)
        assert done.returncode == (1 if name == "failed" else 0), (name, done.stderr)
    without("one", "stripped", "separation_sigma", "status", "transition_force", "area_II", "height", "asperity_x")


def without(name, new, *dropped):
    """A copy of a file that lacks some variables."""
    with netCDF4.Dataset(path(name)) as whole, netCDF4.Dataset(path(new), "w") as bare:
        bare.setncatts({a: whole.getncattr(a) for a in whole.ncattrs()})
        for dimension, size in whole.dimensions.items():
            bare.createDimension(dimension, len(size))
        for key, variable in whole.variables.items():
            if key not in dropped:
                bare.createVariable(key, variable.dtype, variable.dimensions, fill_value=getattr(variable, "_FillValue", None))[...] = variable[...]
                bare[key].setncatts({a: variable.getncattr(a) for a in variable.ncattrs() if a != "_FillValue"})


def path(name):
    return os.path.join(FOLDER, name + ".nc")


@functools.lru_cache(None)
class Raw:
    """A file's variables by name as doubles, without the code under test."""

    def __init__(self, name):
        with netCDF4.Dataset(path(name)) as file:
            self.values = {key: np.ma.filled(np.ma.asarray(v[...]).astype(float), np.nan) for key, v in file.variables.items()}
            self.attributes = {(key, a): v.getncattr(a) for key, v in file.variables.items() for a in v.ncattrs()}
            self.title = file.title

    def __getattr__(self, name):
        return self.values[name]

    def status_of_levels(self):
        return self.values["status"].max(axis=0).astype(int) if "status" in self.values else np.zeros(self.separation.size, int)

    def touching(self):
        return np.flatnonzero(self.values["force"].mean(axis=0) > 0)

    def in_sigma(self):
        return "separation_sigma" in self.values

    def z(self):
        z = self.values["separation_sigma" if self.in_sigma() else "separation"]
        return z if z.ndim == 1 else z.mean(axis=0)

    def z_label(self):
        return r"separation $Z_0/\sigma$" if self.in_sigma() else "separation $Z_0$ [um]"

    def at(self, step):
        return rf"$Z_0/\sigma$ = {self.z()[step]:.3g}" if self.in_sigma() else f"$Z_0$ = {self.z()[step]:.3g} um"

    def warned(self, step):
        return self.at(step) + WORDS[self.status_of_levels()[step]]

    def spots(self, step):
        """Asperity (or None), x, y, radius, force, yields of the contacts of a level."""
        part = slice(int(self.contact_start[step]) - 1, int(self.contact_start[step]) - 1 + int(self.contact_count[step]))
        which = self.contact_asperity[part].astype(int) - 1 if "contact_asperity" in self.values else None
        x, y = (self.contact_x[part], self.contact_y[part]) if which is None else (self.asperity_x[which], self.asperity_y[which])
        yields = self.contact_yields[part] > 0 if "contact_yields" in self.values else np.zeros(x.size, bool)
        return which, x, y, self.contact_radius[part], self.contact_force[part], yields


def marks(x, y, status, colour):
    found = []
    for value, (mark, _) in MARKS.items():
        at = np.flatnonzero(status == value)
        if at.size:
            at = at if value == 4 else at[:: -(-at.size // 20)]
            found.append(line(x[at], y[at], "None", "r" if value == 4 else colour, marker=mark, filled="w"))
    return found


def marks_of_legend(status):
    return [line([], [], "None", "r" if value == 4 else "k", label=MARKS[value][1], marker=MARKS[value][0], filled="w") for value in sorted(set(status) - {0})]


def heading(what, raw, many=None):
    return f"{what} ({f'mean over {many} realizations' if many else 'one realization'})\n{raw.title}"


# What a legend calls the results: what differs between them.
MANY_ONE = ["realizations = 5, $R$ = 4000 um, start = 3.5, stop = 0.5, steps = 13", "realizations = 1, $R$ = 3000 um, start = 5, stop = 0, steps = 26"]
CHECKED = set()


@functools.lru_cache(None)
def opened(name):
    return Result(path(name))


class Pictures(unittest.TestCase):
    maxDiff = None

    def compare(self, picture_name, files, expected, tolerance=1e-9, **options):
        """The picture of these files, all of it; None where nothing is to be drawn. Returns what was said."""
        said = []
        figure = plot.PICTURES[picture_name]([opened(name) for name in files], plot.Options(say=said.append, **options))
        CHECKED.add(picture_name)
        if expected is None:
            self.assertIsNone(figure)
            return said
        self.assertIsNotNone(figure)
        wrong = differences(expected, contents(figure), tolerance=tolerance)
        plt.close(figure)
        self.assertFalse(wrong, "\n" + "\n".join(wrong[:12]))
        return said

    # --- curves

    def load_axes(self, raws, labels, names, ylabels, flip=1.0, bands=True, with_marks=True, legends=True):
        axes, met = [], []
        for name, ylabel in zip(names, ylabels):
            drawn, filled = [], []
            for k, (raw, label) in enumerate(zip(raws, labels)):
                _, style, colour = STYLES[k]
                at = raw.touching()
                values = flip * raw.values[name].mean(axis=0)[at] if name == "stiffness" else raw.values[name].mean(axis=0)[at]
                drawn.append(line(raw.z()[at], values, style, colour, label if name == names[0] or with_marks else None))
                if with_marks:
                    drawn += marks(raw.z()[at], values, raw.status_of_levels()[at], colour)
                    met += list(raw.status_of_levels()[at])
                if bands and raw.values[name].shape[0] > 2 and len(raws) < 4:
                    low, high = np.percentile(raw.values[name][:, at], [16, 84], axis=0)
                    filled.append(band(raw.z()[at], np.where(low > 0, low, np.nan), high, colour))
            axes.append({"xlabel": raws[0].z_label(), "ylabel": ylabel, "yscale": "log", "xlim": "reversed", "lines": drawn, **({"bands": filled} if filled else {})})
        entries = [entry for entry in axes[0]["lines"] if "label" in entry] + (marks_of_legend(met) if with_marks else [])
        if legends and entries:
            axes[0]["legend"] = legend_of(*entries)
        return axes

    def test_load(self):
        names, ylabels = ("force", "contacts"), ("force $N$ [mN]", "number of contacts")
        one, many, forced, flat, failed = map(Raw, ("one", "many", "forced", "flat", "failed"))
        self.assertTrue({1, 2, 3} & set(one.status_of_levels()) and 4 in failed.status_of_levels() and 0 < one.touching()[0])
        self.assertNotEqual(len(set(many.force[:, 3])), 1)
        what = "Force and contacts against separation"
        self.compare("load", ["one"], {"title": heading(what, one), "axes": self.load_axes([one], [None], names, ylabels)})
        self.compare("load", ["failed"], {"title": heading(what, failed), "axes": self.load_axes([failed], [None], names, ylabels)})
        band_note = "; band: two thirds of the realizations"
        self.compare("load", ["many"], {"title": heading(what + band_note, many, 5), "axes": self.load_axes([many], [None], names, ylabels)})
        self.compare("load", ["forced"], {"title": heading(what + band_note, forced, 3), "axes": self.load_axes([forced], [None], names, ylabels)})
        self.compare("load", ["many", "forced", "many"], {"title": f"{what} (means over 3/5 realizations{band_note})", "axes": self.load_axes([many, forced, many], ["many", "forced", "many"], names, ylabels)})
        for name in ("listed", "stripped"):
            raw = Raw(name)
            self.compare("load", [name], {"title": heading(what, raw), "axes": self.load_axes([raw], [None], names, ylabels)})
        # Four and more: the legend has an axis of its own, and no bands.
        four = self.load_axes([one, many, flat, failed], ["one", "many", "flat", "failed"], names, ylabels)
        four.append({"legend": four[0].pop("legend")})
        self.compare("load", ["one", "many", "flat", "failed"], {"title": f"{what} (means over 5 realizations)", "axes": four})

    def area_line(self, raw, k, label):
        force, area = raw.force_mean, raw.contact_area_mean
        at = (force > 0) & (area > 0)
        at = np.flatnonzero(at)[np.argsort(force[at])]
        _, style, colour = STYLES[k]
        return [line(force[at], area[at], style, colour, label)] + marks(force[at], area[at], raw.status_of_levels()[at], colour), force[at], raw.status_of_levels()[at]

    def area_band(self, raw, force, colour):
        curves = []
        for n, a in zip(raw.force, raw.contact_area):
            good = np.flatnonzero((n > 0) & (a > 0))
            good = good[np.argsort(n[good])]
            curves.append([np.exp(np.interp(np.log(f), np.log(n[good]), np.log(a[good]))) if n[good[0]] <= f <= n[good[-1]] else np.nan for f in force])
        low, high = np.percentile(curves, [16, 84], axis=0)
        return band(force, low, high, colour)

    def laws(self, raw, force, elastic=True):
        """The straight lines of the paper's regimes and of the smooth sphere, by their formulas."""
        of = [float(raw.values.get(m + "_theory", np.nan)) for m in ("m2", "m4")]
        E, (m2, m4) = float(raw.e_star), of if np.isfinite(of).all() else (raw.m2.mean(), raw.m4.mean())
        crossing = 9 / 16 * 0.737**2 * np.pi**1.5 / 0.2**3 * m2**1.5 * E / m4
        ends = np.array([force.min(), force.max()])
        near = "transition_force" in raw.values and ends[0] / 30 < crossing < ends[1] * 30
        if near:
            ends = np.array([min(ends[0], crossing / 2), max(ends[1], crossing * 2)])
        second = lambda N: 0.2 * np.sqrt(2 * np.pi) * N / (np.sqrt(2 * m2) * E)
        drawn = [] if not np.isfinite(m2) else [line(ends, np.pi * (3 * 0.737 / np.sqrt(m4) * ends / (4 * E)) ** (2 / 3), "--", "0.35", r"$A_I\propto N^{2/3}$, one asperity"),
                 line(ends, second(ends), "-.", "0.35", r"$A_{II}\propto N$, $\beta=0.2$")]
        drawn = drawn if "area_II" in raw.values else drawn[:1]
        if np.isfinite(raw.r_star):
            drawn.append(line(ends, np.pi * (3 * float(raw.r_star) * ends / (4 * E)) ** (2 / 3), ":", "0.35", "smooth sphere (Hertz)"))
        if near and "area_II" in raw.values:
            drawn.append(line([crossing], [second(crossing)], "None", "k", rf"crossing, $N^*$ = {crossing:.3g} mN", "*", "w"))
        return drawn

    def test_area(self):
        what = "Contact area against force"
        axis = {"xscale": "log", "yscale": "log", "xlabel": "force $N$ [mN]", "ylabel": "contact area $A$ [um$^{2}$]"}
        crossings = []
        for name, note, many in (("one", "", None), ("many", "; band: two thirds of the realizations", 5), ("flat", "", None), ("failed", "", None), ("light", "", None), ("middle", "", None), ("deep", "", None), ("map", "", None), ("listed", "", None), ("stripped", "", None)):
            raw = Raw(name)
            drawn, force, status = self.area_line(raw, 0, "rsc")
            drawn += self.laws(raw, force)
            bands = {"bands": [self.area_band(raw, force, STYLES[0][2])]} if many else {}
            crossings.append("*" in [d.get("marker") for d in drawn])
            if name == "deep":
                self.assertTrue(crossings[-1] and force.min() > 3 * float(raw.transition_force))
            if name == "middle":  # the crossing lies beyond the levels, and is drawn as it is within a factor of 30
                self.assertTrue(crossings[-1] and force.max() < float(raw.transition_force) / 3)
            entries = [d for d in drawn if "label" in d] + marks_of_legend(status)
            expected = {"title": heading(what + note, raw, many), "axes": [{**axis, **bands, "lines": drawn, "legend": legend_of(*entries)}]}
            self.compare("area", [name], expected, tolerance=1e-5)  # 212.66 in the file has five figures
            # Narrow: the legend below.
            expected["axes"] = [{**axis, **bands, "lines": drawn}, {"legend": legend_of(*entries)}]
            self.compare("area", [name], expected, tolerance=1e-5, width=85.0)
        self.assertTrue(any(crossings) and not all(crossings), crossings)
        one, many = Raw("one"), Raw("many")
        a, _, status_a = self.area_line(one, 0, "one")
        b, force, status_b = self.area_line(many, 1, "many")
        met = marks_of_legend([*status_a, *status_b])
        b[0]["label"], a[0]["label"] = MANY_ONE
        self.compare("area", ["one", "many"], {"title": f"{what} (means over 5 realizations; band: two thirds of the realizations)",
                                               "axes": [{**axis, "lines": a + b, "bands": [self.area_band(many, force, STYLES[1][2])], "legend": legend_of(a[0], b[0], *met)}]})

    def test_area_compared(self):
        raw = Raw("compared")
        drawn, force, status = self.area_line(raw, 0, "rsc")
        drawn += self.laws(raw, force) + [line(raw.compare_force, raw.compare_contact_area, "None", STYLES[0][2], "elements", "D", "w")]
        self.compare("area", ["compared"], {"title": heading("Contact area against force", raw),
                                            "axes": [{"xscale": "log", "yscale": "log", "xlabel": "force $N$ [N]", "ylabel": "contact area $A$ [mm$^{2}$]", "lines": drawn,
                                                      "legend": legend_of(*[d for d in drawn if "label" in d], *marks_of_legend(status))}]}, tolerance=1e-5)

    def test_flats(self):
        what = "Nominally flat surfaces: area and separation against pressure"
        first, second = Raw("pressed"), Raw("pressed_2")

        def curves(raw, k, label):
            p = raw.pressure.mean(axis=0)
            x = p / (float(raw.e_star) * raw.rms_slope.mean())
            kappa = raw.area_fraction.mean(axis=0) / x
            _, style, colour = STYLES[k]
            status = raw.status_of_levels()
            theories = [line(x, raw.values[name] / x, style, "0.35", words) for name, style, words in (("area_persson", "--", "Persson"), ("area_bgt", ":", "Bush, Gibson, Thomas"))]
            return [line(x, kappa, style, colour, label), *marks(x, kappa, status, colour)], theories, [line(x, raw.z(), style, colour), *marks(x, raw.z(), status, colour)], status

        axis = {"xscale": "log", "xlabel": "pressure $p/(E^*h')$"}
        kappa = r"$\kappa = A\,E^*h'/N$"
        for raw, name, many in ((first, "pressed", 3), (second, "pressed_2", None)):
            a, theories, z, status = curves(raw, 0, "rsc")
            self.assertTrue(np.isfinite([t["y"] for t in theories]).all())
            self.assertTrue(np.allclose(theories[1]["y"], np.sqrt(2 * np.pi), rtol=0.1))  # the asymptote by its definition; the slope of the spectrum is not quite that of a surface
            self.compare("flats", [name], {"title": heading(what, raw, many), "axes": [{**axis, "ylabel": kappa, "ylim": [0, None], "lines": a + theories, "legend": legend_of(a[0], *theories, *marks_of_legend(status))},
                                                                                       {**axis, "ylabel": r"separation $Z_0/\sigma$", "lines": z}]})
        a, _, z, status = curves(first, 0, r"realizations = 3, $\sigma$ = 0.9 um, levels = 0.001, 0.004, 0.01")
        b, _, w, other = curves(second, 1, r"realizations = 1, $\sigma$ = 0.5 um, levels = 0.002, 0.005")
        self.compare("flats", ["pressed", "pressed_2"], {"title": f"{what} (means over 3 realizations)",
                                                         "axes": [{**axis, "ylabel": kappa, "ylim": [0, None], "lines": a + b, "legend": legend_of(a[0], b[0], *marks_of_legend([*status, *other]))},
                                                                  {**axis, "ylabel": r"separation $Z_0/\sigma$", "lines": z + w}]})
        self.compare("flats", ["one"], None)

    def test_stiffness_and_resistance(self):
        names, ylabels = ("force", "stiffness"), ("force $N$ [mN]", "stiffness $-dN/dZ_0$ [mN um$^{-1}$]")
        for files in (["one"], ["many", "one"]):
            raws = [Raw(name) for name in files]
            labels = [None] if len(files) == 1 else MANY_ONE
            self.compare("stiffness", files, {"title": "Force and stiffness against separation",
                                              "axes": self.load_axes(raws, labels, names, ylabels, flip=-1.0, bands=False, with_marks=False)})
            with np.errstate(divide="ignore"):  # where a realization has no contact
                drawn = [line(raw.force.mean(axis=0)[raw.touching()], (5.0e-5 / raw.conductance_length[:, raw.touching()]).mean(axis=0), STYLES[k][1], STYLES[k][2], label)
                         for k, (raw, label) in enumerate(zip(raws, labels))]
            drawn[0]["y"][~np.isfinite(drawn[0]["y"])] = np.nan
            self.assertTrue(np.isfinite(drawn[0]["y"]).any())
            self.compare("resistance", files, {"title": "Resistance against force", "axes": [{"xscale": "log", "yscale": "log", "xlabel": "force $N$ [mN]", "ylabel": "constriction resistance [ohm]",
                                                                                              "lines": drawn, **({"legend": legend_of(*drawn)} if len(files) > 1 else {})}]})
        self.compare("resistance", ["flat"], None)

    # --- places

    def square(self, raw, step):
        side = float(raw.map_cell_side)
        rows, columns = np.nonzero(raw.map_pressure[step] > 0)
        whole = [raw.x[0] - side / 2, raw.x[-1] + side / 2, raw.y[0] - side / 2, raw.y[-1] + side / 2]
        x0, x1, y0, y1 = raw.x[columns.min()] - side / 2, raw.x[columns.max()] + side / 2, raw.y[rows.min()] - side / 2, raw.y[rows.max()] + side / 2
        half = 0.65 * max(x1 - x0, y1 - y0, 4 * side)
        return whole, [max((x0 + x1) / 2 - half, whole[0]), min((x0 + x1) / 2 + half, whole[1])], [max((y0 + y1) / 2 - half, whole[2]), min((y0 + y1) / 2 + half, whole[3])]

    def map_of(self, raw, step, name, title):
        whole, xlim, ylim = self.square(raw, step)
        field = raw.values[name][step]
        top = np.percentile(field[field > 0], 99)
        circles = []
        if np.isfinite(raw.r_star):
            a = (3 * raw.force_mean[step] * float(raw.r_star) / (4 * float(raw.e_star))) ** (1 / 3)
            circles = [{"centre": [float(raw.tip_x), float(raw.tip_y)], "radius": a, "line": "--", "colour": "#ff0000"}]
        axis = {"xlabel": "$x$ [um]", "ylabel": "$y$ [um]", "xlim": xlim, "ylim": ylim, "aspect": 1.0, "images": [picture(np.where(field > 0, field, np.nan), whole, 0, top, "viridis_r")]}
        label = "area fraction $A'$" if name == "map_area_fraction" else "pressure $p$ [mN um$^{-2}$]"
        return {**axis, **({"circles": circles} if circles else {}), **({"title": title} if title else {})}, {"bar": label, **({"extend": "max"} if field.max() > top else {})}

    def test_map(self):
        few = [int(np.flatnonzero((Raw("one").map_pressure > 0).sum(axis=(1, 2)))[0]) + 1]  # a cell or two
        for name, width, step in (*(("one", 150.0, step) for step in few), ("one", 150.0, None), ("one", 85.0, None), ("one", 150.0, 20), ("many", 150.0, None), ("map", 150.0, None), ("map_elements", 150.0, 3), ("stripped", 150.0, 22), ("flat", 150.0, None)):
            raw = Raw(name)
            loaded, count = raw.touching(), 3 if width >= 120 else 2
            levels = [step - 1] if step else [int(loaded[round((loaded.size - 1) * (k + 1) / count)]) for k in range(count)]
            levels = sorted(set(levels))
            grid = {"map_area_fraction": [], "map_pressure": []}
            bars = []
            for level in levels:
                for q in grid:
                    words = "\n".join(textwrap.wrap(raw.warned(level), 34)) + f"\n$N$ = {raw.force_mean[level]:.3g} mN"
                    axis, bar = self.map_of(raw, level, q, words if q == "map_area_fraction" else None)
                    grid[q].append(axis)
                    bars.append((bar, q, len(grid[q]) - 1))
            axes = grid["map_area_fraction"] + grid["map_pressure"]
            axes += [{**bar, "of": k + (len(levels) if q == "map_pressure" else 0)} for bar, q, k in bars]
            sphere = np.isfinite(raw.r_star)
            many = raw.force.shape[0] if raw.force.shape[0] > 1 else None
            self.compare("map", [name], {"title": heading("Area fraction and pressure" + ("; dashed: Hertz contact of the smooth sphere" if sphere else ""), raw, many), "axes": axes}, width=width, step=step)
        self.assertNotEqual(Raw("map").x.size, Raw("map").y.size)

    def test_maps_of_several(self):
        files = ["one", "many", "flat"]
        axes, bars = [], []
        for k, name in enumerate(files):
            raw = Raw(name)
            level = int(raw.touching()[-1])
            axis, bar = self.map_of(raw, level, "map_pressure", "\n".join(textwrap.wrap(f"{name}, {raw.warned(level)}", 34)) + f"\n$N$ = {raw.force_mean[level]:.3g} mN")
            axes.append(axis)
            bars.append({**bar, "of": k})
        self.compare("map", files, {"title": "Pressure; dashed: Hertz contact of the smooth sphere", "axes": axes + bars})
        said = []
        figure = plot.PICTURES["map"]([Result(path("one"))] * 10, plot.Options(say=said.append))
        self.assertEqual(len([axis for axis in figure.axes if axis.get_images()]), 9)
        self.assertEqual(said, ["map: 10 results; the first 9 are drawn"])
        plt.close(figure)

    def radial_axes(self, shown):
        axes = [{"xlabel": "distance from the tip $r$ [um]", "ylabel": "pressure $p$ [mN um$^{-2}$]", "lines": []} for _ in range(2)]
        axes[1]["yscale"] = "log"
        ends, all_of = [], []
        for k, (raw, level, label) in enumerate(shown):
            marker, style, colour = STYLES[k]
            r, p = raw.radius, raw.radial_pressure[level]
            N, R, E = raw.force_mean[level], float(raw.r_star), float(raw.e_star)
            a = (3 * N * R / (4 * E)) ** (1 / 3)
            ends.append(max(r[p > 0].max(), 1.3 * a if np.isfinite(a) else 0))
            all_of.append(p[p > 0])
            for axis, some in zip(axes, (np.isfinite(p), p > 0)):
                axis["lines"].append(line(r[some], p[some], "None", colour, label, marker, "no"))
                if np.isfinite(a):
                    s = a * np.sin(np.linspace(0, np.pi / 2, 200))[: None if axis is axes[0] else -1]
                    axis["lines"].append(line(s, 1.5 * N / (np.pi * a**2) * np.sqrt(np.maximum(1 - (s / a) ** 2, 0)), style, colour))
        all_of = np.concatenate(all_of)
        for axis in axes:
            axis["xlim"] = [0, min(1.05 * max(ends), shown[0][0].radius[-1])]
        axes[0]["ylim"], axes[1]["ylim"] = [0, None], [max(all_of.min(), all_of.max() / 1e4) / 2, 2 * all_of.max()]
        entries = legend_of(*[d for d in axes[0]["lines"] if "label" in d])
        if len(shown) > 3:
            axes.append({"legend": entries})
        else:
            axes[0]["legend"] = entries
        return axes

    def test_radial(self):
        for name, step in (("one", None), ("one", 26), ("many", None), ("map", 2), ("listed", 7)):
            raw = Raw(name)
            loaded = raw.touching()
            levels = [step - 1] if step else sorted({int(loaded[round((loaded.size - 1) * (k + 1) / 3)]) for k in range(3)})
            many = raw.force.shape[0] if raw.force.shape[0] > 1 else None
            self.compare("radial", [name], {"title": heading("Radial mean of the pressure; points: rsc; lines: Hertz", raw, many), "axes": self.radial_axes([(raw, l, raw.warned(l)) for l in levels])}, step=step,
                         tolerance=1e-7)
        for files in (["one", "many"], ["one", "many", "flat", "failed"]):
            shown = [(raw, int(raw.touching()[-1])) for raw in map(Raw, files)]
            self.compare("radial", files, {"title": "Radial mean of the pressure; points: rsc; lines: Hertz",
                                           "axes": self.radial_axes([(raw, l, f"{name}, {raw.warned(l)}") for name, (raw, l) in zip(MANY_ONE[::-1] if len(files) == 2 else files, shown)])}, tolerance=1e-7)
        self.compare("radial", ["flat"], None)

    def test_spots(self):
        for name, step in (("one", None), ("one", 20), ("yielding", None), ("map", None), ("map_elements", 2), ("flat", None), ("listed", None), ("compared", None)):
            raw = Raw(name)
            level = step - 1 if step else int(np.flatnonzero(raw.contact_count)[-1])
            which, x, y, a, _, yields = raw.spots(level)
            big = int(np.argmax(a))
            half = 0.55 * max((x + a).max() - (x - a).min(), (y + a).max() - (y - a).min())
            windows = [(((x - a).min() + (x + a).max()) / 2, ((y - a).min() + (y + a).max()) / 2, half), (x[big], y[big], min(14 * a[big], half))]
            unit = "[mm]" if name == "compared" else "[um]"
            axes, bars = [], []
            for k, (cx, cy, h) in enumerate(windows):
                axis = {"xlabel": f"$x$ {unit}", "ylabel": f"$y$ {unit}", "xlim": [cx - h, cx + h], "ylim": [cy - h, cy + h], "aspect": 1.0,
                        "ellipses": [ellipses(x[some], y[some], 2 * a[some], 2 * a[some], 0.0, colour, "k" if k else colour) for some, colour in ((~yields, "#d62728"), (yields, "#f2b400")) if some.any()],
                        "lines": [], "title": "around the largest" if k else f"{x.size} contact spots, true to size" + (f"; {yields.sum()} yield" if "contact_yields" in raw.values else "")}
                if "height" in raw.values:
                    hx, hy = (raw.values["height_" + c] if "height_" + c in raw.values else raw.values[c] for c in "xy")
                    i, j = np.flatnonzero(abs(hx - cx) <= h), np.flatnonzero(abs(hy - cy) <= h)
                    if min(i.size, j.size) > 1:
                        z, dx, dy = raw.height[np.ix_(j, i)], hx[1] - hx[0], hy[1] - hy[0]
                        low, high = z.min(), z.max()
                        axis["images"] = [picture(z, [hx[i[0]] - dx / 2, hx[i[-1]] + dx / 2, hy[j[0]] - dy / 2, hy[j[-1]] + dy / 2], low - 0.8 * (high - low), high, "gray")]
                        bars.append({"bar": f"height $z$ {unit}", "of": k, "shown": [low, high]})
                if k and "asperity_x" in raw.values:
                    inside = (abs(raw.asperity_x - cx) <= h) & (abs(raw.asperity_y - cy) <= h)
                    axis["lines"] = [line(raw.asperity_x[inside], raw.asperity_y[inside], "None", "#0b6fa4", "summits", "+")]
                if not k:
                    axis["lines"] = [line([float(raw.tip_x)], [float(raw.tip_y)], "None", "k", "tip", "x")]
                    if "contact_yields" in raw.values:
                        axis["lines"] += [line([], [], "None", colour, label, "o") for colour, label in (("#f2b400", "yields"), ("#d62728", "elastic"))]
                if axis["lines"]:
                    axis["legend"] = legend_of(*axis["lines"])
                else:
                    del axis["lines"]
                axes.append(axis)
            force = f"{raw.force_mean[level]:.3g} {'N' if name == 'compared' else 'mN'}"
            self.compare("spots", [name], {"title": heading(f"Contact spots at {raw.warned(level)}, $N$ = {force}", raw), "axes": axes + bars}, step=step)
        yielding = Raw("yielding")
        self.assertTrue(0 < yielding.spots(1)[5].sum() < yielding.spots(1)[5].size)
        self.compare("spots", ["one", "flat"], None)
        self.compare("spots", ["many"], None)

    # --- sideways

    def test_loop(self):
        raw = Raw("slid")
        m = ((1 - 0.15) * 1.3 / 200 + (1 - 0.125) * 1.25 / 100) / ((1 - 0.09) / 200 + (1 - 0.0625) / 100)  # normal over tangential compliance's inverse: Mindlin
        for step in (40, None):
            level = (step or 41) - 1
            N, R, E = raw.force_mean[level], float(raw.r_star), float(raw.e_star)
            self.assertAlmostEqual(-raw.stiffness[0, level] / raw.tangential_stiffness[level] / m, 1, delta=1e-9)
            full = 0.3 * m * (3 * N / (4 * E * np.sqrt(R))) ** (2 / 3)
            drop = lambda t: 0.3 * N * (1 - np.maximum(1 - t, 0) ** 1.5)
            t, back = np.linspace(0, 1, 61), np.linspace(0, 0.9, 61)
            x = full * np.concatenate([t, 0.9 - 2 * back, -0.9 + 2 * back])
            Q = np.concatenate([drop(t), drop(0.9) - 2 * drop(back), -drop(0.9) + 2 * drop(back)])
            drawn = [line(raw.tangential_displacement[level], raw.tangential_force[level], "-", STYLES[0][2], "rough"), line(x, Q, "--", STYLES[1][2], "smooth sphere (Mindlin)")]
            self.compare("loop", ["slid"], {"title": heading(f"Friction at {raw.at(level)}, $N$ = {N:.3g} mN", raw),
                                            "axes": [{"xlabel": "displacement [um]", "ylabel": "tangential force $Q$ [mN]", "lines": drawn, "legend": legend_of(*drawn)}]}, step=step, tolerance=1e-8)
        self.compare("loop", ["slid", "one"], ANYTHING)
        self.compare("loop", ["slid"], None, step=1)  # nothing touches at 3 sigma, or what touches slid nowhere
        self.compare("loop", ["one"], None)

    def test_stick(self):
        raw = Raw("slid")
        level = 39
        slides = 0.3 / (raw.tangential_stiffness[level] / -raw.stiffness[0, level]) * (raw.separation - raw.separation[level])
        full = raw.tangential_displacement[level].max()
        inner = int(np.argmin(abs(slides - full / 2)))
        self.assertTrue(0 < inner < level)
        (_, x, y, a, _, _), (_, u, v, b, _, _) = raw.spots(level), raw.spots(inner)
        self.assertTrue(0 < b.size < a.size)
        margin = 0.05 * max(np.ptp(x), np.ptp(y), 2 * a.max())
        words = [line([], [], "None", STYLES[k][2], label, "o") for k, label in ((1, "slips"), (0, "sticks"))]
        expected = {"title": heading(f"Spots at {raw.at(level)}, slide {slides[inner] / full:.0%} of full slip", raw),
                    "axes": [{"xlabel": "$x$ [um]", "ylabel": "$y$ [um]", "xlim": [x.min() - margin, x.max() + margin], "ylim": [y.min() - margin, y.max() + margin], "aspect": 1.0, "lines": words, "legend": legend_of(*words),
                              "ellipses": [ellipses(x, y, 2 * a, 2 * a, 0.0, STYLES[1][2]), ellipses(u, v, 2 * b, 2 * b, 0.0, STYLES[0][2])]}]}
        self.compare("stick", ["slid"], expected, step=40)
        self.compare("stick", ["one"], None)

    # --- asperities beside elements

    def test_compare(self):
        for name, law in (("compared", "fourth_order"), ("compared_hertz", "hertz"), ("compared_map", "hertz")):
            raw = Raw(name)
            unit, force_unit = ("um", "mN") if name == "compared_map" else ("mm", "N")
            steps = raw.compare_step.astype(int) - 1
            self.assertTrue(np.allclose(raw.compare_separation, raw.separation[steps], rtol=1e-12))
            with np.errstate(invalid="ignore"):  # where nothing touches
                found = [raw.values[v][0, steps] / raw.values["compare_" + v] for v in ("force", "contact_area", "contacts")]
            errors = [line(raw.separation_sigma[steps], 100 * (ratio - 1), style, colour, label, marker) for ratio, (marker, style, colour), label in zip(found, STYLES, ("$N$", "$A$", "contacts"))]
            third = {"xlabel": r"$Z_0/\sigma$", "ylabel": "asperities over elements $-$ 1 [%]", "lines": errors + [line([0, 1], [0, 0], "-", "k")], "legend": legend_of(*errors)}

            which, x, y, a, f, yields = raw.spots(steps[-1])
            ratio, angle = np.ones(x.size), np.zeros(x.size)
            if law != "hertz":
                ratio, angle = (raw.asperity_kappa1[which] / raw.asperity_kappa2[which]) ** (2 / 3), raw.asperity_angle[which]
                self.assertTrue((ratio > 1.2).any() and (abs(np.sin(2 * angle)) > 0.1).any())
            px, py, pressure = raw.compare_pixel_x, raw.compare_pixel_y, raw.compare_pixel_pressure
            hx, hy = (float(np.ravel(raw.attributes["compare_pixel_" + c, "pixel_size"])[0]) for c in "xy")
            self.assertEqual(hx == hy, name != "compared_map")
            peak = int(np.argmax(pressure))
            if (pressure == pressure.max()).sum() > 1:
                strongest = int(np.argmax(f))
                peak = int(np.argmin(np.hypot(px - x[strongest], py - y[strongest])))
            self.assertEqual((pressure == pressure.max()).sum() > 1, name == "compared_hertz")  # many at the hardness
            # Pixels about that one, 60 on either side: by their numbers along x and y.
            i, j = np.rint((px - px[peak]) / hx).astype(int), np.rint((py - py[peak]) / hy).astype(int)
            near = (abs(i) <= 60) & (abs(j) <= 60)
            image = np.zeros((121, 121))
            image[j[near] + 60, i[near] + 60] = 1
            xlim, ylim = [px[peak] - 60.5 * hx, px[peak] + 60.5 * hx], [py[peak] - 60.5 * hy, py[peak] + 60.5 * hy]
            long, short = a * np.sqrt(ratio), a / np.sqrt(ratio)
            some = (x > xlim[0] - long) & (x < xlim[1] + long) & (y > ylim[0] - long) & (y < ylim[1] + long)
            first = {"title": "grey: elements; red: asperities", "xlabel": f"$x$ [{unit}]", "ylabel": f"$y$ [{unit}]", "xlim": xlim, "ylim": ylim, "aspect": 1.0, "images": [picture(image, [*xlim, *ylim], 0, 2, "Greys")],
                     "lines": [line([0, 1], [py[peak]] * 2, ":", "#0b3c5d")],
                     "ellipses": [ellipses(x[some], y[some], 2 * long[some], 2 * short[some], np.degrees(angle[some]), edge="#c1440e")]}
            row = np.zeros(121)
            same = near & (j == 0)
            row[i[same] + 60] = pressure[same]
            at = np.linspace(*xlim, 2000)
            total = np.zeros(at.size)
            for k in range(x.size):
                u = (at - x[k]) * np.cos(angle[k]) + (py[peak] - y[k]) * np.sin(angle[k])
                v = (py[peak] - y[k]) * np.cos(angle[k]) - (at - x[k]) * np.sin(angle[k])
                depth = 1 - (u / long[k]) ** 2 - (v / short[k]) ** 2
                mean = f[k] / (np.pi * a[k] ** 2)
                total += np.where(depth > 0, mean if yields[k] else 1.5 * mean * np.sqrt(np.maximum(depth, 0)), 0)
            curve = line(at, total, "--", "#c1440e", "asperities")
            elements = {"text": "elements", "colour": "#0b3c5d", "line": "-"}
            second = {"xlabel": f"$x$ [{unit}]", "ylabel": f"pressure [{force_unit} {unit}$^{{-2}}$]", "xlim": xlim, "ylim": [0, 1.4 * max(row.max(), total.max())], "lines": [curve], "legend": {"entries": [elements, *legend_of(curve)["entries"]]},
                      "stairs": [{"values": row, "edges": px[peak] + (np.arange(122) - 60.5) * hx, "colour": "#0b3c5d", "label": "elements"}]}
            self.compare("compare", [name], {"title": heading(f"Spots and pressure at {raw.at(steps[-1])}, errors of the asperity model", raw), "axes": [first, second, third]}, tolerance=1e-8)
        self.assertTrue(Raw("compared_hertz").spots(1)[5].any())
        self.compare("compare", ["one"], None)
        self.assertEqual(self.compare("compare", ["one", "compared", "compared_hertz"], ANYTHING), ["compare: Both is drawn, give one file at a time for the others"])

    # --- distributions

    def test_distributions(self):
        fits = {"pressure_mean_pdf": "Rayleigh", "pressure_pdf": r"$\gamma p^\alpha \exp(-(p/\delta)^\beta)$", "spot_area_pdf": "exponential"}
        labels = {"pressure_mean_pdf": "mean pressure of a contact [mN um$^{-2}$]", "pressure_pdf": "pressure in the contact area [mN um$^{-2}$]", "spot_area_pdf": "area of a contact [um$^{2}$]"}

        def expected(shown, words):
            axes = []
            for name, law in fits.items():
                bins = name.replace("_pdf", "_bin")
                lines, ends, least = [], [], []
                tops = [raw.values[bins][raw.values[name][k] > 0].max() for raw, k in shown]
                wide = max(tops) > 20 * min(tops)
                for i, ((raw, k), word) in enumerate(zip(shown, words)):
                    marker, style, colour = STYLES[i]
                    p, density = raw.values[bins], raw.values[name][k]
                    good = density > 0
                    x = (np.geomspace if wide else np.linspace)(p[0] / 10, p[good].max(), 300)
                    of = lambda a: float(np.ravel(raw.attributes[name, a])[k])
                    if name == "pressure_mean_pdf":
                        y = x / of("rayleigh_scale") ** 2 * np.exp(-0.5 * (x / of("rayleigh_scale")) ** 2)
                    elif name == "spot_area_pdf":
                        y = np.exp(-x / of("mean")) / of("mean")  # of the maximum likelihood
                    elif of("alpha") > 1e36:  # no fit
                        y = None
                    else:
                        y = of("gamma") * x ** of("alpha") * np.exp(-((x / of("delta")) ** of("beta")))
                        word = rf"$\alpha$ = {of('alpha'):.2f}, $\beta$ = {of('beta'):.2f}"
                    lines += [line(p[good], density[good], "None", colour, word, marker, "no")] + ([line(x, y, style, colour)] if y is not None else [])
                    ends.append(p[good].max())
                    least.append(density[good].min())
                axis = {"xlabel": labels[name], "ylabel": "probability density [" + ("um$^{-2}$]" if name == "spot_area_pdf" else "um$^{2}$ mN$^{-1}$]"), "title": f"points: rsc; lines: {law}", "lines": lines}
                if wide:
                    axis.update(xscale="log", yscale="log", xlim=[min(ends) / 30, max(ends) * 1.3], ylim=[min(least) / 3, None])
                else:
                    axis.update(xlim=[0, 1.05 * max(ends)], ylim=[min(least) / 2, None] if name == "spot_area_pdf" else [0, None])
                    if name == "spot_area_pdf":
                        axis["yscale"] = "log"
                if name != "spot_area_pdf":
                    axis["legend"] = legend_of(*[d for d in lines if "label" in d])
                axes.append(axis)
            return axes

        one, many = Raw("one"), Raw("many")
        counts = one.spot_area_count.sum(axis=1) + np.ravel(one.attributes["spot_area_count", "overflow"])
        levels = np.flatnonzero(counts >= 60)
        self.assertTrue(0 < levels.size < counts.size, counts)
        self.assertTrue(np.array_equal(counts, one.contacts[0, one.pdf_step.astype(int) - 1]))
        words_of = lambda levels, counts: [rf"$Z_0/\sigma$ = {one.pdf_separation_sigma[k]:.3g}{WORDS[one.status_of_levels()[int(one.pdf_step[k]) - 1]]}, {counts[k]:.0f} contacts" for k in levels]
        words = words_of(levels, counts)
        self.compare("distributions", ["one"], {"title": heading("Distributions over contacts", one), "axes": expected([(one, k) for k in levels], words)}, tolerance=1e-6)
        both = [(raw, int(np.argmax(raw.spot_area_count.sum(axis=1)))) for raw in (one, many)]
        self.compare("distributions", ["one", "many"], {"title": "Distributions over contacts", "axes": expected(both, MANY_ONE[::-1])}, tolerance=1e-6)
        # A fit that failed: no line, and the level by its name.
        shutil.copy(path("one"), path("unfitted"))
        with netCDF4.Dataset(path("unfitted"), "a") as file:
            file["pressure_pdf"].alpha = np.full(counts.size, 9.96920996838687e36)
            file["spot_area_count"].overflow = np.arange(7.0, 7 + counts.size)  # and contacts beyond the last bin
        more = counts + 7 + np.arange(counts.size)
        self.assertGreater((more >= 60).sum(), levels.size)
        levels = np.flatnonzero(more >= 60)
        words = words_of(levels, more)
        axes = expected([(Raw("unfitted"), k) for k in levels], words)
        self.assertEqual(len(axes[1]["lines"]), levels.size)
        self.compare("distributions", ["unfitted"], {"title": heading("Distributions over contacts", one), "axes": axes}, tolerance=1e-6)
        wide = expected([(one, both[0][1]), (Raw("soft"), 0)], ["elastic, start = 5, stop = 0, steps = 26, levels at default", "$H_0$ = 0.4 mN um$^{-2}$, start = 4, stop = 1, steps = 100, levels = 2.5, 0.5"])
        self.assertEqual([axis.get("xscale") for axis in wide], ["log", "log", None])  # pressures that lie decades apart
        self.compare("distributions", ["one", "soft"], {"title": "Distributions over contacts", "axes": wide}, tolerance=1e-6)
        self.assertEqual(self.compare("distributions", ["compared"], None), ["distributions: fewer than 60 contacts at every level of &output pdf_levels: not drawn"])

    def test_spectrum(self):
        raw = Raw("map")
        k, psd, fit = raw.wavenumber, raw.psd, raw.psd_fit
        inside = fit > 0
        self.assertTrue(0 < inside.sum() < k.size)
        drawn = [line(k[psd > 0], psd[psd > 0], "None", STYLES[0][2], "heights", "o", "no"), line(k[inside], fit[inside], "-", "#c1440e", f"fit, $H$ = {raw.attributes['psd_fit', 'hurst']:.3g}")]
        seen = psd[psd > 1e-12 * psd.max()]
        axis = {"xscale": "log", "yscale": "log", "xlabel": "wavenumber $k$ [um$^{-1}$]", "ylabel": r"spectrum $\Phi$ [um$^{4}$]", "ylim": [seen.min() / 3, 3 * psd.max()]}
        self.compare("spectrum", ["map"], {"title": heading("Spectrum of the heights", raw), "axes": [{**axis, "lines": drawn, "legend": legend_of(*drawn)}]})
        both = [entry for n, (marker, style, colour) in enumerate(STYLES[:2])
                for entry in (line(k[psd > 0], psd[psd > 0], "None", colour, ("model = asperities", "model = elements")[n], marker, "no"), line(k[inside], fit[inside], style, colour))]
        self.compare("spectrum", ["map", "map_elements"], {"title": "Spectrum of the heights", "axes": [{**axis, "lines": both, "legend": legend_of(*[d for d in both if "label" in d])}]})
        self.compare("spectrum", ["one"], None)

    # --- a study

    def test_study(self):
        files = [f"study_00{k}" for k in range(1, 7)]
        for step in (None, 2):
            level = (step or 4) - 1
            raws = [Raw(name) for name in files]
            axes, bars = [], []
            for q, (name, label) in enumerate((("force", "force $N$ [mN]"), ("contact_area", "contact area $A$ [um$^{2}$]"), ("contacts", "number of contacts"))):
                values = np.array([raw.values[name][0, level] for raw in raws]).reshape(3, 2).T  # sigma is the first key of &study and varies slowest; hurst stands first in the case
                middle = (values.min() + values.max()) / 2
                texts = [{"text": f"{values[i, j]:.3g}", "at": [j, i], "colour": "#000000" if values[i, j] > middle else "#ffffff"} for i in range(2) for j in range(3)]
                axes.append({"images": [picture(values, [-0.5, 2.5, -0.5, 1.5], values.min(), values.max(), "cividis")], "texts": texts, "aspect": "auto", "xlabel": r"$\sigma$ [um]", "ylabel": "$H$",
                             "xticks": ["5", "10", "20"], "yticks": ["0.5", "0.8"]})
                bars.append({"bar": label, "of": q})
            self.compare("study", files, {"title": f"Study at $Z_0/\\sigma$ = {raws[0].separation_sigma[level]:.3g}", "axes": axes + bars}, step=step)
        self.compare("study", files[:3], None)
        self.compare("study", ["one", "many", "flat", "failed"], None)


class Surface(unittest.TestCase):
    def drawn(self, result, *twins):
        figures = []
        with unittest.mock.patch.object(plt.Figure, "savefig", lambda figure, to: figures.append((figure, str(to)))), unittest.mock.patch.object(sys, "argv", ["plot_surface.py", path(result), *map(path, twins)]):
            with unittest.mock.patch("builtins.print") as said:
                plot_surface.main()
        (figure, to), = figures
        self.assertEqual((to, str(said.call_args.args[0])), (path(result)[:-3] + "_surface.png",) * 2)
        found = contents(figure)
        plt.close(figure)
        return found

    def test_map(self):
        raw, twin = Raw("map"), Raw("many")
        z = raw.height
        hx, hy = raw.height_x, raw.height_y
        dx, dy = hx[1] - hx[0], hy[1] - hy[0]
        self.assertGreater(abs(dx - dy), 0.1 * dx)
        of = {a: raw.attributes["psd_fit", a] for a in ("hurst", "hurst_error", "ks", "kl")}
        k, psd, fit = raw.wavenumber, raw.psd, raw.psd_fit
        inside = fit > 0
        spectrum = [line(k, psd, "None", "#0b3c5d", "measured", "."),
                    line(k[inside], fit[inside], "-", "#c1440e", f"fit: H = {of['hurst']:.2f} ± {of['hurst_error']:.2f}, $\\lambda_s$ = {2 * np.pi / of['ks']:.3g}, $\\lambda_l$ = {2 * np.pi / of['kl']:.3g}")]
        words = [f"many.nc: rms slope {twin.rms_slope.mean():.3g} ± {np.sqrt(((twin.rms_slope - twin.rms_slope.mean()) ** 2).sum() / 4):.2g} (5)", f"map: rms slope {float(raw.sdq):.3g}, {float(raw.points_per_wave):.1f} points a wave"]
        sq, bins, density = float(raw.sq), raw.height_bin, raw.height_pdf
        self.assertAlmostEqual(sq / z.std(), 1, delta=1e-9)
        width = bins[1] - bins[0]
        gauss = line(bins, np.exp(-0.5 * (bins / sq) ** 2) / (np.sqrt(2 * np.pi) * sq), "-", "#c1440e", "Gaussian of this rms")
        skew, kurtosis = (np.mean(((z - z.mean()) / z.std()) ** p) for p in (3, 4))
        expected = {"title": "", "axes": [
            {"xlabel": "x [um]", "ylabel": "y [um]", "aspect": 1.0, "title": f"Sq {sq:.3g} um, 0 points filled", "images": [picture(z, [hx[0] - dx / 2, hx[-1] + dx / 2, hy[0] - dy / 2, hy[-1] + dy / 2], z.min(), z.max(), "viridis")]},
            {"xscale": "log", "yscale": "log", "xlabel": "wavenumber k [um-1]", "ylabel": "power spectral density [um4]", "ylim": [max(psd[psd > 0].min(), fit[inside].min() * 1e-4), 5 * psd.max()],
             "lines": spectrum + [ANYTHING, ANYTHING], "legend": legend_of(*spectrum, *words)},
            {"xlabel": "height about the mean [um]", "ylabel": "probability density [um-1]", "title": f"skewness {skew:.2f} (0), kurtosis {kurtosis:.2f} (3)", "lines": [gauss], "legend": legend_of("measured", gauss),
             "stairs": [{"values": density, "edges": np.append(bins - width / 2, bins[-1] + width / 2), "colour": "#0b3c5d", "label": "measured"}]},
            {"bar": "height [um]", "of": 0}]}
        found = self.drawn("map", "many")
        for entry in found["axes"][1]["legend"]["entries"][2:]:
            entry.pop("colour")
            entry.pop("line", None)
        for entry in found["axes"][2]["legend"]["entries"][:1] + expected["axes"][2]["legend"]["entries"][:1]:
            entry.pop("colour", None)
        wrong = differences(expected, found)
        self.assertFalse(wrong, "\n".join(wrong))

    def test_without_heights(self):
        without("map", "bare", "height", "psd_fit")
        found = self.drawn("bare")
        self.assertEqual([t["text"] for t in found["axes"][0]["texts"]], ["the file holds no heights\n(&output heights = .true.)"])
        self.assertEqual(len(found["axes"][1]["lines"]), 2)

    def test_refused(self):
        for name, message in (("one", "holds no psd"), ("nothing", "No such file")):
            with unittest.mock.patch.object(sys, "argv", ["plot_surface.py", path(name)]), self.assertRaises(SystemExit) as stop:
                plot_surface.main()
            self.assertIn(message, str(stop.exception.code))


def tearDownModule():
    missed = set(plot.PICTURES) - CHECKED
    if missed and len(sys.argv) == 1:
        raise AssertionError(f"pictures that no test looks at: {sorted(missed)}")


if __name__ == "__main__":
    unittest.main()
