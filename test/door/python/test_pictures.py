"""The pictures of plot.py: the numbers that they hand to matplotlib, computed here from the
variables of the file; and that every picture is drawn.

usage: test_pictures.py FOLDER_OF_PLOT        (RSC_PROGRAM in the environment: the program that
makes the results) """
import contextlib
import functools
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

import netCDF4
import numpy as np

PLOT = sys.argv.pop(1)
sys.path.insert(0, PLOT)
import plot  # noqa: E402
import plot_adhesion  # noqa: E402
import plot_compare  # noqa: E402
import plot_curves  # noqa: E402
import plot_map  # noqa: E402
import plot_python  # noqa: E402
import plot_spots  # noqa: E402
import plot_study  # noqa: E402
import plot_style  # noqa: E402
from plot_results import Looks, Result, names  # noqa: E402
from plot_style import plt  # noqa: E402

SURFACE = (
    "&surface n=256 L=1200.0 L_lambda_l=8 L_lambda_s=64 sigma=12.0 / "
    "&run length_unit='um' force_unit='mN' REALIZATIONS /"
)
BALL = "&solids E=78.0,200.0 R=Infinity,3000.0 nu=0.42,0.3 resistivity=2.0e-5,3.0e-5 /"
BY_ASPERITIES = "&solver model='asperities' / "
OF_PAPER = BY_ASPERITIES + "&asperities law='hertz' / "
SMALL = "&surface n=128 L_lambda_l=4 L_lambda_s=16 sigma=0.01 / "
CASES = {
    "one": OF_PAPER
    + SURFACE
    + BALL
    + (
        "&indentation centre=500.0,680.0 start=5.0 stop=0.0 steps=26 / &output map_cells=23 "
        "heights=.true. pdf_levels=0.0,0.6 /"
    ),
    "many": OF_PAPER
    + SURFACE.replace("REALIZATIONS", "realizations=5")
    + BALL
    + "&indentation start=3.5 stop=0.5 steps=13 / &output map_cells=21 /",
    "slid": OF_PAPER
    + SURFACE
    + BALL.replace("resistivity", "friction=0.3 resistivity")
    + "&indentation centre=500.0,680.0 start=3.0 stop=1.0 steps=41 /",
    "back": SMALL
    + (
        "&solver model='asperities' / &asperities law='hertz' / &solids hardness=1.5e4 / "
        "&indentation levels=2.5,2,1.5,1,1.2,1.4,1.6,1.8 /"
    ),
    "compared": SMALL
    + (
        "&asperities law='fourth_order' / &indentation levels=2.0,1.5,1.0 / &compare "
        "levels=2.0,1.0 /"
    ),
    "above": SMALL + "&indentation levels=9.0 / &compare levels=9.0 /",
    "elements": SMALL
    + "&solids hardness=2e3 / &solver model='elements' / &output fields='contact','heights' /"
    "&indentation control='force' start=1.0 stop=20.0 steps=3 spacing='log' /",
    "tiles": SMALL + "&solver model='elements' / &solids R=Infinity,Infinity friction=0.2 /"
    "&indentation boundary='periodic' control='pressure' unit='relative' levels=0.02,0.2 /",
    "line": SMALL + "&indenter shape='paraboloid' radii=5.0,Infinity / &solver model='elements' /"
    "&indentation boundary='periodic_y' control='force' levels=5,50 / &solids friction=0.1 /"
    "&output fields='pressure','traction' field_levels=50 /",
    "smooth": SMALL.replace("0.01", "1e-8") + "&indenter shape='paraboloid' radii=5.0,Infinity /"
    "&indentation boundary='periodic_y' control='force' levels=50,200 /",
    "pulled": SMALL.replace("0.01", "0.0001") + "&run realizations=3 /"
    "&solids E=200,Infinity R=Infinity,5 adhesion=2e-5 / &indentation levels=3,1,0,1,3,9 /"
    "&study surface%sigma=1e-4,2e-4,4e-4 /",
    "pressed": OF_PAPER
    + "&surface n=128 L_lambda_l=4 L_lambda_s=32 sigma=0.0009 / "
    "&solids R=Infinity,Infinity / &run realizations=3 /"
    "&indentation boundary='periodic' control='pressure' unit='relative' levels=0.001,0.004,0.01 /",
    "study": OF_PAPER
    + SURFACE
    + BALL
    + (
        "&indentation start=2.0 stop=0.5 steps=4 / &study surface%sigma=5.0,10.0,20.0 "
        "surface%hurst=0.5,0.8 /"
    ),
    "laws": BY_ASPERITIES
    + SURFACE
    + BALL
    + (
        "&indentation levels=1.0,0.5 / &study asperities%law='hertz','fourth_order' "
        "surface%sigma=5.0,10.0,20.0 /"
    ),
    "forced": SMALL
    + "&indentation control='force' levels=1.0,10.0 / &study run%seed=1,2,3,4,5,6,7,8,9,10,11,12 /",
    "cone": SMALL
    + (
        "&solids hardness=1.5e4 / &indenter shape='cone' slope=0.05 / &indentation "
        "control='force' levels=0.1,1,10,1 /"
    ),
    "creep": OF_PAPER
    + SMALL
    + (
        "&solids relaxation_share=0.5 relaxation_time=1.0 / &indentation control='force' "
        "levels=1,1,1,1 times=0,1,10,100 /"
    ),
    "keys": BY_ASPERITIES
    + SMALL
    + (
        "&indentation levels=1.0 / &study surface%sigma=0.01,0.02,0.03 surface%hurst=0.5,0.8 "
        "asperities%law='hertz','elliptic' /"
    ),
    "stuck": SMALL.replace("0.01", "0.001")
    + (
        "&solids E=2,Infinity R=Infinity,Infinity adhesion=2e-5 / &indentation "
        "boundary='periodic' levels=3.5,3,2.5,2,1.5,2,2.5,3,3.5 /"
    ),
    "attracted": SMALL.replace("0.01", "0.001")
    + (
        "&solids E=2,Infinity R=Infinity,5 adhesion=1e-5 adhesion_range=0.02 / &solver "
        "model='elements' / &indentation levels=3,2,1,0 / &run realizations=3 /"
    ),
    "worn": SMALL.replace("0.01", "0.001")
    + (
        "&solids E=210e3,Infinity nu=0.3,0.0 R=Infinity,Infinity hardness=3e3 / &asperities "
        "law='fourth_order' / &indentation boundary='periodic' levels=2,1.2,1.5,2 /"
    ),
    "map": "&surface source='heights' file='HEIGHTS' / &solids R=Infinity,9000.0 / "
    "&indentation levels=1.5,1.0,0.5 / &output heights=.true. /",
}
TO_SI = {
    "um": 1e-6,
    "mm": 1e-3,
    "mN": 1e-3,
    "N": 1.0,
    "ohm": 1.0,
    "radian": 1.0,
    "degree": np.pi / 180,
}


def path(name):
    return os.path.join(FOLDER, name + ".nc")


def setUpModule():
    global FOLDER
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name
    rng = np.random.default_rng(5)
    x, y = (np.arange(130) + 0.5) * 1500 / 130, (
        np.arange(90) + 0.5
    ) * 900 / 90  # other steps along x than along y
    waves = [
        (k, turn, phase)
        for k, turn, phase in rng.uniform((0.022, 0, 0), (0.07, 2 * np.pi, 2 * np.pi), (150, 3))
    ]
    with netCDF4.Dataset(path("heights"), "w") as file:
        for axis, values in (("y", y), ("x", x)):
            file.createDimension(axis, values.size)
            file.createVariable(axis, "f8", (axis,))[:] = values
            file[axis].units = "um"
        file.createVariable("height", "f8", ("y", "x"))[:] = sum(
            0.002 * k**-1.8 * np.cos(k * (np.cos(t) * x[None, :] + np.sin(t) * y[:, None]) + p)
            for k, t, p in waves
        )
        file["height"].units = "um"
    for name, case in CASES.items():
        case = case.replace("REALIZATIONS", "").replace("HEIGHTS", path("heights"))
        done = subprocess.run(
            [os.environ["RSC_PROGRAM"], "-q", "-o", path(name)],
            input=case,
            text=True,
            capture_output=True,
        )
        assert done.returncode == 0, (name, done.stderr)


@functools.cache
def raw(name):
    """{variable: doubles in SI units} of a file, and {(variable, attribute): value} as it stands
    there."""
    with netCDF4.Dataset(path(name)) as file:
        values = {}
        for key, v in file.variables.items():
            units = getattr(v, "units", "1")
            factor = (
                np.prod(
                    [
                        TO_SI[unit] ** int(power or 1)
                        for unit, power in re.findall(r"([a-zA-Z]+)(-?\d*)", units)
                    ]
                )
                if units != "1"
                else 1.0
            )
            values[key] = np.ma.filled(np.ma.asarray(v[...]).astype(float), np.nan) * factor
        return values, {
            (key, a): v.getncattr(a) for key, v in file.variables.items() for a in v.ncattrs()
        }


def results(*files):
    return [Result(path(name), in_si=True) for name in files]


def members(name, count):
    return [f"{name}_{k:03}" for k in range(1, count + 1)]


def run(*words):
    """(exit status, what was printed) of plot.py."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            status = plot.main(list(words))
        except SystemExit as stop:
            status = stop.code
    return status, out.getvalue()


class Drawn(unittest.TestCase):
    def figure(self, picture, *files, step=None, width=180.0):
        figure = plot.PICTURES[picture](
            results(*files), plot.Options(width, step, say=lambda text: None)
        )
        self.addCleanup(plt.close, figure)
        self.assertIsNotNone(figure)
        self.check_texts(figure)
        return figure

    def check_texts(self, figure):
        """All texts that are drawn and the legends are within the figure, and no two texts overlap;
        a pixel of the rounded boxes is allowed."""
        texts = []

        def draw(text, renderer):
            if text.get_visible() and text.get_text().strip():
                texts.append((text.get_text(), text.get_window_extent(renderer).padded(-1)))

        with unittest.mock.patch.object(plt.matplotlib.text.Text, "draw", draw):
            figure.draw_without_rendering()
        legends = [
            ("legend", axis.get_legend().get_window_extent().padded(-1))
            for axis in figure.axes
            if axis.get_legend()
        ]
        beyond = [
            name
            for name, box in texts + legends
            if box.x0 < 0 or box.y0 < 0 or box.x1 > figure.bbox.x1 or box.y1 > figure.bbox.y1
        ]
        over = [
            (name, other)
            for k, (name, box) in enumerate(texts)
            for other, place in texts[:k]
            if box.overlaps(place)
        ]
        self.assertEqual((beyond, over), ([], []))


class Numbers(Drawn):
    def has_curve(self, figure, x, y, tolerance=1e-9):
        """Some line of the figure is this one."""
        good = np.isfinite(x) & np.isfinite(y)
        x, y = np.asarray(x)[good], np.asarray(y)[good]
        for line in (line for axis in figure.axes for line in axis.get_lines()):
            u, v = (np.asarray(a, float) for a in line.get_data())
            there = np.isfinite(u) & np.isfinite(v)
            if (
                there.sum() == x.size
                and np.allclose(u[there], x, rtol=tolerance)
                and np.allclose(v[there], y, rtol=tolerance, atol=tolerance * np.abs(y).max())
            ):
                return
        self.fail("this curve is not drawn")

    def has_image(self, figure, values, extent=None):
        for image in (image for axis in figure.axes for image in axis.get_images()):
            shown = np.ma.filled(np.ma.asarray(image.get_array()).astype(float), np.nan)
            if shown.shape == values.shape and np.allclose(
                shown, values, rtol=1e-9, atol=0, equal_nan=True
            ):
                self.assertEqual(image.origin, "lower")
                if extent is not None:
                    self.assertTrue(np.allclose(image.get_extent(), extent), image.get_extent())
                return
        self.fail("this map is not drawn")

    def test_curves(self):
        for name in ("one", "many"):
            v, _ = raw(name)
            at = np.flatnonzero(v["force"].mean(axis=0) > 0)
            force, area = v["force"].mean(axis=0), v["contact_area"].mean(axis=0)
            load = self.figure("load", name)
            for quantity in ("force", "contacts"):
                self.has_curve(load, -v["separation"][at], v[quantity].mean(axis=0)[at])
            self.has_curve(self.figure("area", name), force[at], area[at])
            if name == "many":  # the band
                ends = (
                    next(c for c in load.axes[0].collections if c.get_gid() == "scatter")
                    .get_paths()[0]
                    .vertices
                )
                drawn = ends[np.isclose(ends[:, 0], -v["separation"][at[-1]])][:, 1]
                self.assertTrue(
                    np.allclose(
                        [drawn.min(), drawn.max()], np.percentile(v["force"][:, at[-1]], [16, 84])
                    )
                )
                self.assertTrue(
                    np.allclose(
                        results("many")[0].error("force")[at],
                        np.nan_to_num(v["force_error_expected"] * v["force"]).max(axis=0)[at]
                        / v["force"].mean(axis=0)[at],
                    )
                )
            figure = self.figure("stiffness", name)
            self.has_curve(figure, force[at], -v["stiffness"].mean(axis=0)[at])
            # Hertz's ball: 2 E* a, a^3 = 3 N R/(4 E*).
            E, R, N = float(v["e_star"]), float(v["r_star"]), np.sort(force[at])
            self.has_curve(figure, N, 2 * E * (0.75 * N * R / E) ** (1 / 3))
        # R = (rho_1 + rho_2)/L by the electrical analogy.
        v, _ = raw("one")
        at = np.flatnonzero(v["force"][0] > 0)
        self.has_curve(
            self.figure("resistance", "one"),
            v["force"][0, at],
            5.0e-5 * 1e-6 / v["conductance_length"][0, at],
        )

    def test_there_and_back(self):
        v, _ = raw("back")
        figure = self.figure("area", "back")
        for part, gid in ((slice(0, 4), "curve"), (slice(3, 8), "unloading")):
            drawn = [line for line in figure.axes[0].get_lines() if line.get_gid() == gid]
            self.assertEqual(len(drawn), 1)
            force = v["force"][0, part]
            self.assertTrue(np.allclose(drawn[0].get_xdata(), force[force > 0]))
        texts = [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]
        first = v["force"][0][np.argmax(v["plastic_contacts"][0] > 0)]  # in the order of the levels
        self.assertIn("unloading", texts)
        every = (v["plastic_contacts"][0][v["force"][0] > 0] > 0).all()
        said = "contacts yield at all levels" if every else f"yield from {first:.3g} N"
        self.assertTrue(any(said in text for text in texts), texts)

    def test_laws_of_the_area(self):
        v, _ = raw("one")
        force = v["force_mean"][v["force_mean"] > 0]
        drawn = {
            line.get_label(): line.get_data()
            for line in self.figure("area", "one").axes[0].get_lines()
        }
        x, y = next(data for label, data in drawn.items() if "Hertz" in label)
        self.assertTrue(
            np.allclose(
                y, np.pi * (3 * float(v["r_star"]) * x / (4 * float(v["e_star"]))) ** (2 / 3)
            )
        )
        self.assertLessEqual(x[0], force.min())
        x, y = next(data for label, data in drawn.items() if "A_{II}" in label)
        self.assertTrue(
            np.allclose(
                y, 0.2 * np.sqrt(np.pi / float(v["m2_theory"])) * x / float(v["e_star"]), rtol=1e-5
            )
        )

    def test_cone(self):
        """A smooth cone carries the mean pressure E* slope/2; Hertz' pressures are of spheres.
        Levels before yielding have smaller forces."""
        v, _ = raw("cone")
        area = self.figure("area", "cone")
        x, y = next(
            line.get_data()
            for line in area.axes[0].get_lines()
            if line.get_label() == "smooth cone"
        )
        self.assertTrue(np.allclose(y, 2 * x / (0.05 * float(v["e_star"]))))
        said = next(
            text.get_text()
            for text in area.axes[-1].get_legend().get_texts()
            if "yield from" in text.get_text()
        )
        first = np.argmax(v["plastic_contacts"][0] > 0)
        self.assertGreater(first, 0)
        self.assertEqual(
            said.split(", up to ")[0],
            "contacts yield from {} on (none at {})".format(
                *(plot_style.amount(v["force"][0, k], "N") for k in (first, first - 1))
            ),
        )
        self.assertFalse(
            any(
                line.get_gid() == "hertz"
                for axis in self.figure("radial", "cone").axes
                for line in axis.get_lines()
            )
        )

    def test_names_of_levels(self):
        """Levels under one force are told apart by their times; members of a study by all keys that
        vary."""
        texts = [
            text.get_text()
            for text in self.figure("radial", "creep").axes[-1].get_legend().get_texts()
        ]
        self.assertEqual(
            [text.split(" (")[0] for text in texts], ["$t$ = 1 s", "$t$ = 10 s", "$t$ = 100 s"]
        )
        _, texts, _ = Looks(results(*members("keys", 12))).scale
        self.assertEqual(
            texts,
            [
                f"{sigma}, {hurst}, {law}"
                for sigma in (0.01, 0.02, 0.03)
                for hurst in (0.5, 0.8)
                for law in ("hertz", "elliptic")
            ],
        )

    def test_flats(self):
        v, _ = raw("pressed")
        x = v["pressure"].mean(axis=0) / (float(v["e_star"]) * v["rms_slope"].mean())
        figure, area = self.figure("flats", "pressed"), self.figure("area", "pressed")
        for name in ("area_persson", "area_bgt", "area_gw"):
            self.has_curve(figure, x, v[name] / x)
            self.has_curve(area, v["force"].mean(axis=0), v[name] * 1e-6)  # shares of 1 mm2
        self.has_curve(figure, x, v["area_fraction"].mean(axis=0) / x)
        self.assertFalse(
            any(
                "N^*" in line.get_label() or "A_I" in line.get_label()
                for line in area.axes[0].get_lines()
            )
        )

    def test_adhesion(self):
        """Attraction without contact has a force. Theories of flats know no tension."""
        self.assertIsNone(plot.PICTURES["flats"](results("stuck"), plot.Options()))
        v, _ = raw("attracted")
        self.assertTrue((v["force"] < 0).all() and not v["contact_area"][:, 0].any())
        figure = self.figure("load", "attracted")
        self.has_curve(figure, -v["separation"], v["force"].mean(axis=0))
        ends = (
            next(c for c in figure.axes[0].collections if c.get_gid() == "scatter")
            .get_paths()[0]
            .vertices[:, 1]
        )
        self.assertTrue(
            np.allclose(
                [ends.min(), ends.max()],
                [f(np.percentile(v["force"], q, axis=0)) for f, q in ((np.min, 16), (np.max, 84))],
            )
        )

    def test_errors(self):
        """Where the abscissa turns back, errors are bars. An error of many times the value goes out
        of the picture."""
        page = types.SimpleNamespace(entry=lambda *words, **looks: None)
        x, y = np.array([0.0, -1.0, 2.0, 3.0]), np.array([1.0, 2.0, 4.0, 5.0])
        figure, (back, large) = plt.subplots(1, 2)
        self.addCleanup(plt.close, figure)
        plot_curves.error_band(page, back, x, y, 0.5 * y, "error", color="r")
        self.assertTrue(
            np.allclose(
                back.collections[0].get_segments(),
                [[[x[k], 0.5 * y[k]], [x[k], 1.5 * y[k]]] for k in range(4)],
            )
        )
        large.plot(np.sort(x), y)
        plot_curves.error_band(page, large, np.sort(x), y, 5 * y, "error", color="r")
        end = large.collections[0].get_paths()[0].vertices[:, 1].max()
        self.assertTrue(y.max() < large.get_ylim()[1] < 2.2 * y.max() < end)

    def test_maps(self):
        v, _ = raw("many")  # means over realizations are drawn in cells
        side = float(v["map_cell_side"])
        extent = [
            v["x"][0] - side / 2,
            v["x"][-1] + side / 2,
            v["y"][0] - side / 2,
            v["y"][-1] + side / 2,
        ]
        figure = self.figure("map", "many", step=12)
        for name in ("map_pressure", "map_area_fraction"):
            self.has_image(figure, np.where(v[name][11] > 0, v[name][11], np.nan), extent)
        self.assertGreater(*figure.get_size_inches())  # one level fills no page
        shutil.copy(
            path("many"), path("oblong")
        )  # as if a quarter of the last row were on the surface
        with netCDF4.Dataset(path("oblong"), "a") as file:
            file.source = "changed: " + file.source
            file["y"].share_of_last_row, file["map_pressure"][11, -1] = (
                0.25,
                file["map_pressure"][11].max(),
            )
        figure = self.figure("map", "oblong", step=12)
        p = np.vstack(
            [v["map_pressure"][11, :-1], np.full(v["x"].size, 4 * v["map_pressure"][11].max())]
        )
        self.has_image(figure, np.where(p > 0, p, np.nan), extent)
        self.assertAlmostEqual(figure.axes[0].get_ylim()[1], extent[3] - 0.75 * side)
        v, _ = raw("one")  # its spots with their mean pressures
        part = slice(*np.cumsum([int(v["contact_start"][21]) - 1, int(v["contact_count"][21])]))
        (spots,) = self.figure("map", "one", step=22).axes[1].collections
        np.testing.assert_allclose(
            np.ma.getdata(spots.get_array()) * np.pi * v["contact_radius"][part] ** 2,
            v["contact_force"][part],
        )
        p, r = v["radial_pressure"][21], v["radius"]
        figure = self.figure("radial", "one", step=22)
        touched = np.isfinite(p) & (p != 0)
        self.has_curve(figure, r[touched], p[touched])
        r, p = next(
            line for line in figure.axes[0].get_lines() if line.get_gid() == "hertz"
        ).get_data()
        np.testing.assert_allclose(
            np.trapz(2 * np.pi * r * p, r), v["force"][0, 21], rtol=1e-3
        )  # the smooth sphere carries the same force
        many = self.figure(
            "map", *members("forced", 12)[-5:], width=100.0
        )  # the titles have wider lines than the maps
        self.assertEqual(sum(bool(axis.get_title()) for axis in many.axes), 5)
        images = [
            image
            for axis in self.figure("map", *members("forced", 4), "attracted", width=120.0).axes
            for image in axis.get_images()
        ]
        self.assertEqual(
            {(image.get_cmap().name, image.get_clim()) for image in images},
            {("coolwarm", (-images[0].get_clim()[1], images[0].get_clim()[1]))},
        )

    def test_pressure_at_pixels(self):
        """The pressures at the pixels in contact, from the cells of the map, sum up to the
        force but for the interpolation between cells, and exceed no hardness."""
        v, _ = raw("elements")
        pressure = plot_map._at_pixels(results("elements")[0], 2)
        pixel = np.prod([v["mask_" + a][1] - v["mask_" + a][0] for a in "xy"])
        self.assertTrue((pressure[v["contact_mask"][2] == 0] == 0).all())
        self.assertAlmostEqual(pressure.sum() * pixel / v["force"][0, 2], 1, delta=0.06)
        self.assertLess(pressure.max(), 2e9 * (1 + 1e-6))

    def test_smooth_cylinder(self):
        """Hertz's line of a roller is what elements find for a smooth one."""
        found = results("smooth")[0]
        force = plot_curves.hertz_line(found, -found.mean("separation"))
        np.testing.assert_allclose(force, found.mean("force"), rtol=0.01)

    def test_spots(self):
        v, _ = raw("one")
        part = slice(
            int(v["contact_start"][21]) - 1,
            int(v["contact_start"][21] + v["contact_count"][21]) - 1,
        )
        which, a = v["contact_asperity"][part].astype(int) - 1, v["contact_radius"][part]
        drawn = [
            c
            for c in self.figure("spots", "one", step=22).axes[1].collections
            if hasattr(c, "_widths")
        ]
        self.assertTrue(
            any(
                np.allclose(
                    c.get_offsets(),
                    np.column_stack([v["asperity_x"][which], v["asperity_y"][which]]),
                )
                and np.allclose(c._widths, a)
                for c in drawn
            )
        )

        # Yielding and elastic spots have the colours of the legend.
        v, _ = raw("back")
        yields = (
            v["contact_yields"][int(v["contact_start"][3]) - 1 :][: int(v["contact_count"][3])] > 0
        ).sum()
        figure = self.figure("spots", "back", step=4)
        colours = {
            text.get_text(): plt.matplotlib.colors.to_rgba(handle.get_color())
            for text, handle in zip(
                figure.axes[-1].get_legend().get_texts(), figure.axes[-1].get_legend().get_lines()
            )
        }
        drawn = {
            tuple(c.get_facecolor()[0]): len(c.get_offsets())
            for c in figure.axes[1].collections
            if hasattr(c, "_widths")
        }
        self.assertTrue(0 < yields < v["contact_count"][3])
        self.assertEqual(
            (drawn[colours["yielding"]], drawn[colours["contact"]]),
            (yields, v["contact_count"][3] - yields),
        )

    def test_pixels(self):
        """The contact of elements is drawn at its own pixels, those that yield in another colour;
        the windows are within the surface, and the largest spot is in the right one."""
        v, _ = raw("elements")
        mask = v["contact_mask"][2] > 0
        i, j = (np.searchsorted(v["field_" + a], v["mask_" + a] - 1e-12) for a in "xy")
        field = v["field_contact"][0]
        self.assertEqual(field.sum(), mask.sum())
        pixel = np.prod([v["mask_" + a][1] - v["mask_" + a][0] for a in "xy"])
        self.assertAlmostEqual(mask.sum() * pixel / v["contact_area_pixels"][0, 2], 1, 9)
        self.assertTrue((field[np.ix_(j, i)] == mask).all())
        yields = v["contact_mask"][2] == 2
        self.assertTrue(0 < yields.sum() < mask.sum())
        for picture in ("spots", "map"):
            figure = self.figure(picture, "elements")
            image = [
                image.get_array()
                for axis in figure.axes
                for image in axis.get_images()
                if image.get_gid() == "pixels"
            ][-1]
            colours = [plt.matplotlib.colors.to_rgba(c) for c in ("#d62728", "#f2b400")]
            for colour, pixels in zip(colours, (mask & ~yields, yields)):
                self.assertTrue(((image == colour).all(axis=-1) == pixels).all())
        for name in ("elements", "tiles", "line"):
            w, _ = raw(name)
            side, cell = 1e-3, float(w["mask_x"][1] - w["mask_x"][0]) * 1e-3
            for axis in self.figure("spots", name).axes[:2]:
                for low, high in (axis.get_xlim(), axis.get_ylim()):
                    self.assertTrue(-1e-9 < low < high < side + 1e-9, (name, low, high))
        # Three spots, of which the ring is the largest and the one inside nearest to its centre.
        drawn = np.zeros((12, 20), int)
        drawn[2:9, 3:10], drawn[3:8, 4:9], drawn[5, 6], drawn[1:4, 15:17] = 1, 0, 2, 1
        rows, columns = plot_spots.spot_at(drawn, 24, 5.4, 6.4)
        self.assertEqual(rows.size, 24)
        self.assertEqual([rows.min(), rows.max(), columns.min(), columns.max()], [2, 8, 3, 9])

    def test_smooth_bodies(self):
        """Hertz beside the load, Holm beside the resistance, JKR beside the pull-off, and the half
        width of a smooth cylinder, by their closed forms."""
        v, _ = raw("one")
        R, E = float(v["r_star"]), float(v["e_star"])
        result = results("one")[0]
        a = np.sqrt(R * 1e-6)  # the contact radius at an approach of 1 um
        self.assertAlmostEqual(
            plot_curves.hertz_force(result, 1e-6) / (4 * E * a**3 / (3 * R)), 1, delta=1e-12
        )
        at = np.flatnonzero(v["force"][0] > 0)
        spot = np.sqrt(v["contact_area"][0, at] / np.pi)
        holm = 5.0e-5 * 1e-6 / (4 * spot)
        self.has_curve(self.figure("resistance", "one"), v["force"][0, at], holm)
        w, ball = 2e-5 * 1e3, results(*members("pulled", 3))[0]
        force, _ = plot_adhesion.jkr(ball)
        self.assertAlmostEqual(-force.min() / (1.5 * np.pi * w * float(ball["r_star"])), 1, 5)
        line, u = results("line")[0], raw("line")[0]
        b = np.sqrt(4 * 50e3 * 5e-3 / (np.pi * float(u["e_star"])))
        self.assertAlmostEqual(line.half_width(1) / b, 1, delta=1e-3)
        marks = [
            axis_line.get_xdata()[0]
            for axis_line in self.figure("spots", "line").axes[0].get_lines()
            if axis_line.get_linestyle() == "--"
        ]
        self.assertAlmostEqual((marks[1] - marks[0]) / (2 * b), 1, delta=1e-3)
        self.figure("stick", "line")

    def test_pull_off(self):
        files = members("pulled", 3)
        figure = self.figure("pulloff", *files)
        found = [raw(name)[0]["pull_off_force"] for name in files]
        self.has_curve(figure, np.array([1e-4, 2e-4, 4e-4]), -np.array([f.mean() for f in found]))
        bars = next(c for c in figure.axes[0].collections if c.get_gid() == "bars")
        spread = [np.ptp(segment[:, 1]) / 2 for segment in bars.get_segments()]
        self.assertTrue(np.allclose(spread, [f.std(ddof=1) / np.sqrt(3) for f in found]))
        self.figure("pull", *files)

    def test_friction(self):
        v, _ = raw("slid")
        figure = self.figure("loop", "slid", step=40)
        self.has_curve(
            figure, v["tangential_displacement"][39, :, 0], v["tangential_force"][39, :, 0]
        )
        # The smooth sphere by Mindlin: full slip at (mu N/k)(3/2), k the tangential stiffness of
        # its contact.
        N, R, E = v["force_mean"][39], float(v["r_star"]), float(v["e_star"])
        m = (
            ((1 - 0.42**2) / 78 + (1 - 0.3**2) / 200)
            * 4
            / (2 * (2 - 0.42) * 1.42 / 78 + 2 * (2 - 0.3) * 1.3 / 200)
        )
        full = 1.5 * 0.3 * N / (2 * E * (3 * N * R / (4 * E)) ** (1 / 3) * m)
        x, Q = next(
            line.get_data() for line in figure.axes[0].get_lines() if "Mindlin" in line.get_label()
        )
        self.assertAlmostEqual(
            np.interp(0.5 * full, x[:60], Q[:60]) / (0.3 * N * (1 - 0.5**1.5)), 1, delta=1e-3
        )

    def test_not_converged(self):
        """Maps and radial means have nothing of a level that did not converge: the last one that
        did is drawn."""
        shutil.copy(path("one"), path("failed"))
        with netCDF4.Dataset(path("failed"), "a") as file:
            file.source = "changed: " + file.source
            file["status"][:, -2:] = 4
        self.assertEqual(Result(path("failed"), in_si=True).chosen(1, None), [23])

    def test_compare(self):
        v, _ = raw("compared")
        steps = v["compare_step"].astype(int) - 1
        figure = self.figure("compare", "compared")
        for name in ("force", "contact_area", "contacts"):
            self.has_curve(
                figure, v["force"][0, steps], 100 * (v[name][0, steps] / v["compare_" + name] - 1)
            )
        turned = [c for axis in figure.axes for c in axis.collections if c.get_gid() == "spots"]
        angles, ratios = v["contact_angle"], v["contact_major"] / v["contact_minor"]
        self.assertTrue(
            turned
            and all(
                (
                    np.isclose(np.cos(angles[:, None] - c._angles), 1, atol=1e-9)
                    & np.isclose(ratios[:, None], c._widths / c._heights, rtol=1e-9)
                )
                .any(axis=0)
                .all()
                for c in turned
            )
        )
        self.assertIsNone(
            plot_compare.compare(results("above"), plot.Options(180.0))
        )  # nothing touches
        # The pressure of one elliptic spot along all lines adds up to its force.
        lines = np.linspace(-0.8, 0.8, 401)
        drawn = [
            plot_compare.along_line(
                [[0.0], [0.0], [0.5 * 1.5**0.5], [0.5 / 1.5**0.5], [0.4], [3.0], [0]],
                line,
                -0.8,
                0.8,
            )
            for line in lines
        ]
        self.assertAlmostEqual(
            sum(p.sum() * (x[1] - x[0]) for x, p in drawn) * (lines[1] - lines[0]) / 3.0,
            1,
            delta=2e-3,
        )

    def test_distributions(self):
        v, _ = raw("one")
        figure = self.figure(
            "distributions", "one", width=85.0
        )  # the legend has wider lines than the figure
        for axis, name in zip(figure.axes, ("pressure_pdf", "pressure_mean_pdf", "spot_area_pdf")):
            p, density = v[name.replace("_pdf", "_bin")], v[name][0]
            x, drawn = axis.get_lines()[0].get_data()  # groups of bins hold the same contacts
            group = np.diff(x).min()
            self.assertAlmostEqual(drawn.sum() * group / (density.sum() * (p[1] - p[0])), 1)
            inside = abs(p - x[0]) < group / 2
            self.assertAlmostEqual(drawn[0] / density[inside].mean(), 1)
            units = [
                plot_style.si(raw("one")[1][(key, "units")])[0]
                for key in (name, name.replace("_pdf", "_bin"))
            ]
            self.assertAlmostEqual(units[0] * units[1], 1)  # a density is per unit of its bins
        with netCDF4.Dataset(path("one")) as file:
            mean = float(np.ravel(file["spot_area_pdf"].mean)[0]) * 1e-12
        x, fit = next(
            line.get_data() for line in figure.axes[2].get_lines() if line.get_gid() == "fit"
        )
        np.testing.assert_allclose(fit, np.exp(-x / mean) / mean, rtol=1e-6)
        x, density = next(
            line.get_data() for line in figure.axes[1].get_lines() if line.get_gid() == "fit"
        )
        scale = x[
            np.argmax(density)
        ]  # the mode of Rayleigh's density is its scale s, and the density there exp(-1/2)/s
        self.assertAlmostEqual(density.max() * scale, np.exp(-0.5), delta=1e-3)

    def test_surface(self):
        v, _ = raw("map")
        k, psd, fit = v["wavenumber"], v["psd"], v["psd_fit"]
        figure = self.figure("surface", "map")
        self.has_curve(figure, k[psd > 0], psd[psd > 0])
        self.has_curve(figure, k[fit > 0], fit[fit > 0])
        self.has_image(figure, v["height"])
        both = self.figure("surface", "map", "one")  # beside each other
        for name in ("map", "one"):
            self.has_image(both, raw(name)[0]["height"])

    def test_study(self):
        figure = self.figure("study", *members("study", 6), step=2)
        six = results(*members("study", 6))
        keys, texts, _, _ = plot_study._keys(six)
        panels = [plot_study._at_level(six, [1] * 6, q) for q in ("contact_area", "contacts")]
        table = plot_study._page(six, plot.Options(), (keys, texts, None, None), panels)
        table = table.finish("as a map")
        self.addCleanup(plt.close, table)
        for name in ("contact_area", "contacts"):
            values = [raw(file)[0][name][0, 1] for file in members("study", 6)]
            values = np.reshape(values, (3, 2)).T  # sigma varies slowest
            for of_hurst in values:
                self.has_curve(figure, np.array([5.0, 10.0, 20.0]), of_hurst)
            self.has_image(table, values)
        self.assertIn("1.5", figure._suptitle.get_text())
        laws = self.figure(
            "study", *members("laws", 6)
        )  # sigma is a number, law is not: a curve for each law, with its expected error
        for name in ("force", "contact_area"):
            values = np.array([raw(file)[0][name][0, -1] for file in members("laws", 6)]).reshape(
                2, 3
            )  # law varies slowest
            for of_law in values:
                self.has_curve(laws, np.array([5.0, 10.0, 20.0]), of_law)
        self.assertEqual(sum(len(axis.containers) for axis in laws.axes[:2]), 4)
        keys = self.figure(
            "study", *members("keys", 12)
        )  # of two keys of numbers the one with more values
        self.has_curve(
            keys,
            np.array([0.01, 0.02, 0.03]),
            np.array([raw(file)[0]["force"][0, -1] for file in members("keys", 12)[1::4]]),
        )
        at_load = plot.PICTURES["study"](
            results(*members("forced", 12)), plot.Options(180.0, at=10.0, say=print)
        )
        self.addCleanup(plt.close, at_load)
        seeds = np.arange(1.0, 13.0)
        for name in ("contact_area", "contacts"):  # 10 N is the second level
            values = [raw(file)[0][name][0, 1] for file in members("forced", 12)]
            self.has_curve(at_load, seeds, np.array(values))
        forced = self.figure(
            "study", *members("forced", 12)
        )  # the force is the same everywhere: the separation is drawn instead
        self.assertIn("10 N", forced._suptitle.get_text())
        self.assertIn("Z_0", forced.axes[0].get_ylabel())
        opened, stem = plot.open_results([path("study_manifest")])
        self.assertEqual((len(set(names(opened))), stem), (6, "study"))
        twice, _ = plot.open_results(
            [
                path("study_manifest"),
                path("study_002"),
                os.path.join(FOLDER, ".", "study_002.nc"),
                path("one"),
                path("one"),
            ]
        )
        self.assertEqual(
            [os.path.basename(result.path) for result in twice],
            [os.path.basename(path(name)) for name in [*members("study", 6), "one"]],
        )
        looks = Looks(results(*members("forced", 12)))
        self.assertEqual(
            (len({tuple(colour) for _, colour, _ in looks.of}), looks.scale[1]),
            (12, [str(k) for k in range(1, 13)]),
        )

    def test_units(self):
        _, axis = plt.subplots()
        axis.set(xlim=(0, 0.9e-3), ylim=(0, 1.1e-3), aspect="equal")
        for which in "xy":  # both axes of a map
            plot_style.label(axis, which, which, "m")
        self.assertEqual((axis.get_xlabel(), axis.get_ylabel()), ("x [mm]", "y [mm]"))
        plt.close(axis.figure)
        for text, factor, dimension in (
            ("N mm-2", 1e6, "N m-2"),
            ("um2", 1e-12, "m2"),
            ("mN um-1", 1e3, "N m-1"),
            ("mN-1 um2", 1e-9, "N-1 m2"),
            ("1", 1.0, ""),
            ("lbf inch-2", 6894.757293168, "N m-2"),
            ("furlong", 1.0, "furlong"),
        ):
            self.assertEqual(
                (round(plot_style.si(text)[0] / factor, 12), plot_style.si(text)[1]),
                (1.0, dimension),
            )
        for value, dimension, shown in (
            (2.5e-7, "m", "250 nm"),
            (3e-5, "m", "30 µm"),
            (4e9, "N m-2", "4 GPa"),
            (0.02, "N", "20 mN"),
            (0.5, "", "0.5"),
            (3e-10, "m2", "300 µm²"),
        ):
            self.assertEqual(plot_style.amount(value, dimension), shown)


class Command(unittest.TestCase):
    def test_run(self):
        status, text = run(
            path("one"),
            "-o",
            os.path.join(FOLDER, "pictures"),
            "--only",
            "load",
            "--only",
            "resistance",
        )
        self.assertEqual(
            (status, [os.path.basename(word) for word in text.split()]),
            (0, ["one_load.png", "one_resistance.png"]),
        )
        status, text = run(
            path("one"),
            "-o",
            FOLDER,
            "--only",
            "load",
            "--format",
            "pdf",
            "--width",
            "single",
            "--name",
            "mine",
        )
        self.assertEqual((status, text.strip()), (0, os.path.join(FOLDER, "mine_load.pdf")))

    def test_every_picture(self):
        status, text = run(path("one"), "-o", os.path.join(FOLDER, "all"), "--dpi", "75")
        self.assertTrue(
            status == 0
            and len(text.split()) >= 5
            and all(os.path.getsize(picture) > 2500 for picture in text.split()),
            text,
        )

    def test_refused(self):
        for words, word in (
            ([path("one"), "--step", "99"], "1 to 26"),
            ([path("one"), "--step", "0"], "1 to 26"),
            ([path("nothing")], "nothing"),
            ([path("one"), "--width", "7"], "millimetres"),
            ([path("one"), "--only", "nonsense"], "nonsense"),
            ([__file__], "read"),
            ([path("heights")], "no result"),
            ([path("one"), "--only", "loop", "-o", FOLDER], "loop"),
        ):
            status, text = run(*words)
            self.assertTrue(
                status not in (0, None) and word in text + str(status), (words, status, text)
            )

    def test_python_without_modules(self):
        """-S leaves out where the modules are: the script goes on with a Python that has them;
        where there is none it names the packages."""
        words = [
            sys.executable,
            "-S",
            os.path.join(PLOT, "plot.py"),
            path("compared"),
            "--only",
            "load",
            "-o",
            FOLDER,
        ]
        done = subprocess.run(
            words, text=True, capture_output=True, env={**os.environ, "PYTHON": sys.executable}
        )
        self.assertEqual(
            (done.returncode, done.stdout.strip()),
            (0, os.path.join(FOLDER, "compared_load.png")),
            done.stderr,
        )
        with unittest.mock.patch("shutil.which", return_value=None), self.assertRaises(
            SystemExit
        ) as stop:
            plot_python.needs("numpy", "a_module_that_is_not_there")
        self.assertIn("python3-numpy", str(stop.exception.code))


if __name__ == "__main__":
    unittest.main()
