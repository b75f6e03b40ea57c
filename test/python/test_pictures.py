"""The numbers that plot.py and plot_surface.py hand to matplotlib, computed here from the variables of the file, and one run of the
commands. How a picture looks is not tested here.

usage: test_pictures.py FOLDER_OF_PLOT        (RSC_PROGRAM in the environment: the program that makes the results)
"""
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import netCDF4
import numpy as np

sys.path.insert(0, sys.argv.pop(1))
import plot  # noqa: E402
import plot_compare  # noqa: E402
import plot_surface  # noqa: E402
from plot_results import Result, names  # noqa: E402
from plot_style import plt  # noqa: E402

SURFACE = "&surface n=256 L=1200.0 L_lambda_l=8 L_lambda_s=64 sigma=12.0 / &run length_unit='um' force_unit='mN' REALIZATIONS /"
BALL = "&solids E=78.0,200.0 R=Infinity,3000.0 nu=0.42,0.3 resistivity=2.0e-5,3.0e-5 /"
CASES = {
    "one": SURFACE + BALL + "&indentation centre=500.0,680.0 start=5.0 stop=0.0 steps=26 / &output map_cells=23 heights=.true. pdf_levels=0.0,0.6 /",
    "many": SURFACE.replace("REALIZATIONS", "realizations=5") + BALL + "&indentation start=3.5 stop=0.5 steps=13 / &output map_cells=21 /",
    "slid": SURFACE + BALL.replace("resistivity", "friction=0.3 resistivity") + "&indentation centre=500.0,680.0 start=3.0 stop=1.0 steps=41 /",
    "compared": "&surface n=128 L=1.3 L_lambda_l=4 L_lambda_s=16 sigma=0.01 / &asperities law='fourth_order' / &indentation levels=2.0,1.5,1.0 / &compare levels=2.0,1.0 /",
    "pressed": "&surface n=128 L_lambda_l=4 L_lambda_s=32 sigma=0.0009 / &solids R=Infinity,Infinity / &run realizations=3 /"
               "&indentation boundary='periodic' control='pressure' unit='relative' levels=0.001,0.004,0.01 /",
    "study": SURFACE + BALL + "&indentation start=2.0 stop=0.5 steps=4 / &study surface%sigma=5.0,10.0,20.0 surface%hurst=0.5,0.8 /",
    "map": "&surface source='heights' file='HEIGHTS' / &solids R=Infinity,9000.0 / &indentation levels=1.5,1.0,0.5 / &output heights=.true. /",
}


def path(name):
    return os.path.join(FOLDER, name + ".nc")


def setUpModule():
    global FOLDER
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name
    rng = np.random.default_rng(5)
    x, y = (np.arange(130) + 0.5) * 1500 / 130, (np.arange(90) + 0.5) * 900 / 90  # other steps along x than along y
    waves = [(k, turn, phase) for k, turn, phase in rng.uniform((0.022, 0, 0), (0.07, 2 * np.pi, 2 * np.pi), (150, 3))]
    with netCDF4.Dataset(path("heights"), "w") as file:
        for axis, values in (("y", y), ("x", x)):
            file.createDimension(axis, values.size)
            file.createVariable(axis, "f8", (axis,))[:] = values
            file[axis].units = "um"
        file.createVariable("height", "f8", ("y", "x"))[:] = sum(0.002 * k**-1.8 * np.cos(k * (np.cos(t) * x[None, :] + np.sin(t) * y[:, None]) + p) for k, t, p in waves)
        file["height"].units = "um"
    for name, case in CASES.items():
        case = case.replace("REALIZATIONS", "").replace("HEIGHTS", path("heights"))
        done = subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path(name)], input=case, text=True, capture_output=True)
        assert done.returncode == 0, (name, done.stderr)


def raw(name):
    """{variable: doubles} of a file, and {(variable, attribute): value}."""
    with netCDF4.Dataset(path(name)) as file:
        values = {key: np.ma.filled(np.ma.asarray(v[...]).astype(float), np.nan) for key, v in file.variables.items()}
        return values, {(key, a): v.getncattr(a) for key, v in file.variables.items() for a in v.ncattrs()}


def run(*words):
    """(exit status, what was printed) of plot.py."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            status = plot.main(list(words))
        except SystemExit as stop:
            status = stop.code
    return status, out.getvalue()


class Numbers(unittest.TestCase):
    def figure(self, picture, *files, step=None):
        figure = plot.PICTURES[picture]([Result(path(name)) for name in files], plot.Options(step=step, say=lambda text: None))
        self.addCleanup(plt.close, figure)
        self.assertIsNotNone(figure)
        return figure

    def has_curve(self, figure, x, y, tolerance=1e-9):
        """Some line of the figure is this one."""
        good = np.isfinite(x) & np.isfinite(y)
        x, y = np.asarray(x)[good], np.asarray(y)[good]
        for line in (line for axis in figure.axes for line in axis.get_lines()):
            u, v = (np.asarray(a, float) for a in line.get_data())
            there = np.isfinite(u) & np.isfinite(v)
            if there.sum() == x.size and np.allclose(u[there], x, rtol=tolerance) and np.allclose(v[there], y, rtol=tolerance, atol=tolerance * np.abs(y).max()):
                return
        self.fail("this curve is not drawn")

    def has_image(self, figure, values, extent=None):
        for image in (image for axis in figure.axes for image in axis.get_images()):
            shown = np.ma.filled(np.ma.asarray(image.get_array()).astype(float), np.nan)
            if shown.shape == values.shape and np.allclose(shown, values, rtol=1e-9, equal_nan=True):
                self.assertEqual(image.origin, "lower")
                if extent is not None:
                    self.assertTrue(np.allclose(image.get_extent(), extent), image.get_extent())
                return
        self.fail("this map is not drawn")

    def test_curves(self):
        for name in ("one", "many"):
            v, _ = raw(name)
            at = np.flatnonzero(v["force"].mean(axis=0) > 0)
            z, force, area = v["separation_sigma"], v["force"].mean(axis=0), v["contact_area"].mean(axis=0)
            load = self.figure("load", name)
            for quantity in ("force", "contacts"):
                self.has_curve(load, z[at], v[quantity].mean(axis=0)[at])
            self.has_curve(self.figure("area", name), force[at], area[at])
            self.has_curve(self.figure("stiffness", name), z[at], -v["stiffness"].mean(axis=0)[at])
            # R = (rho_1 + rho_2)/L by the electrical analogy.
            with np.errstate(divide="ignore"):
                ohm = (5.0e-5 / v["conductance_length"][:, at]).mean(axis=0)
            self.has_curve(self.figure("resistance", name), force[at], np.where(np.isfinite(ohm), ohm, np.nan))

    def test_laws_of_the_area(self):
        v, _ = raw("one")
        force = v["force_mean"][v["force_mean"] > 0]
        drawn = {line.get_label(): line.get_data() for line in self.figure("area", "one").axes[0].get_lines()}
        x, y = next(data for label, data in drawn.items() if "Hertz" in label)
        self.assertTrue(np.allclose(y, np.pi * (3 * float(v["r_star"]) * x / (4 * float(v["e_star"]))) ** (2 / 3)))
        self.assertLessEqual(x[0], force.min())
        x, y = next(data for label, data in drawn.items() if r"\beta=0.2" in label)
        self.assertTrue(np.allclose(y, 0.2 * np.sqrt(np.pi / float(v["m2_theory"])) * x / float(v["e_star"]), rtol=1e-5))

    def test_flats(self):
        v, _ = raw("pressed")
        x = v["pressure"].mean(axis=0) / (float(v["e_star"]) * v["rms_slope"].mean())
        figure = self.figure("flats", "pressed")
        for name in ("area_persson", "area_bgt"):
            self.has_curve(figure, x, v[name] / x)
        self.has_curve(figure, x, v["area_fraction"].mean(axis=0) / x)
        self.has_curve(figure, x, v["separation_sigma"].mean(axis=0) if v["separation_sigma"].ndim > 1 else v["separation_sigma"])

    def test_maps(self):
        v, _ = raw("one")
        side = float(v["map_cell_side"])
        extent = [v["x"][0] - side / 2, v["x"][-1] + side / 2, v["y"][0] - side / 2, v["y"][-1] + side / 2]
        figure = self.figure("map", "one", step=22)
        for name in ("map_pressure", "map_area_fraction"):
            self.has_image(figure, np.where(v[name][21] > 0, v[name][21], np.nan), extent)
        p, r = v["radial_pressure"][21], v["radius"]
        self.has_curve(self.figure("radial", "one", step=22), r[np.isfinite(p)], p[np.isfinite(p)])

    def test_spots(self):
        v, _ = raw("one")
        part = slice(int(v["contact_start"][21]) - 1, int(v["contact_start"][21] + v["contact_count"][21]) - 1)
        which, a = v["contact_asperity"][part].astype(int) - 1, v["contact_radius"][part]
        drawn = [c for c in self.figure("spots", "one", step=22).axes[0].collections if hasattr(c, "_widths")]
        self.assertTrue(any(np.allclose(c.get_offsets(), np.column_stack([v["asperity_x"][which], v["asperity_y"][which]])) and np.allclose(c._widths, a) for c in drawn))

    def test_friction(self):
        v, _ = raw("slid")
        figure = self.figure("loop", "slid", step=40)
        self.has_curve(figure, v["tangential_displacement"][39], v["tangential_force"][39])
        # The smooth sphere by Mindlin: full slip at (mu N/k)(3/2), k the tangential stiffness of its contact.
        N, R, E = v["force_mean"][39], float(v["r_star"]), float(v["e_star"])
        m = ((1 - 0.42**2) / 78 + (1 - 0.3**2) / 200) * 4 / (2 * (2 - 0.42) * 1.42 / 78 + 2 * (2 - 0.3) * 1.3 / 200)
        full = 1.5 * 0.3 * N / (2 * E * (3 * N * R / (4 * E)) ** (1 / 3) * m)
        x, Q = next(line.get_data() for line in figure.axes[0].get_lines() if "Mindlin" in line.get_label())
        self.assertAlmostEqual(np.interp(0.5 * full, x[:60], Q[:60]) / (0.3 * N * (1 - 0.5**1.5)), 1, delta=1e-3)
        self.figure("stick", "slid", step=40)

    def test_compare(self):
        v, _ = raw("compared")
        steps = v["compare_step"].astype(int) - 1
        figure = self.figure("compare", "compared")
        for name in ("force", "contact_area", "contacts"):
            self.has_curve(figure, v["separation_sigma"][steps], 100 * (v[name][0, steps] / v["compare_" + name] - 1))
        # The pressure of one elliptic spot along all lines adds up to its force.
        lines = np.linspace(-0.8, 0.8, 401)
        drawn = [plot_compare._line([[0.0], [0.0], [0.5], [3.0], [1.5], [0.4], [0]], line, -0.8, 0.8) for line in lines]
        self.assertAlmostEqual(sum(p.sum() * (x[1] - x[0]) for x, p in drawn) * (lines[1] - lines[0]) / 3.0, 1, delta=2e-3)

    def test_distributions(self):
        v, of = raw("one")
        figure = self.figure("distributions", "one")
        for name in ("pressure_mean_pdf", "pressure_pdf", "spot_area_pdf"):
            p, density = v[name.replace("_pdf", "_bin")], v[name][0]
            self.has_curve(figure, p[density > 0], density[density > 0])
        x = np.linspace(v["spot_area_bin"][0] / 10, v["spot_area_bin"][v["spot_area_pdf"][0] > 0].max(), 300)
        mean = float(np.ravel(of["spot_area_pdf", "mean"])[0])
        self.has_curve(figure, x, np.exp(-x / mean) / mean, 1e-6)

    def test_spectrum(self):
        v, _ = raw("map")
        k, psd, fit = v["wavenumber"], v["psd"], v["psd_fit"]
        figure = self.figure("spectrum", "map")
        self.has_curve(figure, k[psd > 0], psd[psd > 0])
        self.has_curve(figure, k[fit > 0], fit[fit > 0])
        figures = []
        with unittest.mock.patch.object(plt.Figure, "savefig", lambda figure, to: figures.append(figure)), unittest.mock.patch("builtins.print"), \
                unittest.mock.patch.object(sys, "argv", ["plot_surface.py", path("map")]):
            plot_surface.main()
        self.has_image(figures[0], v["height"])
        self.has_curve(figures[0], k[fit > 0], fit[fit > 0])

    def test_study(self):
        files = [f"study_00{k}" for k in range(1, 7)]
        figure = self.figure("study", *files, step=2)
        for name in ("force", "contact_area", "contacts"):
            self.has_image(figure, np.array([raw(file)[0][name][0, 1] for file in files]).reshape(3, 2).T)  # sigma varies slowest
        members, stem = plot.open_results([path("study_manifest")])
        self.assertEqual((len(set(names(members))), stem), (6, "study"))


class Command(unittest.TestCase):
    def test_run(self):
        status, text = run(path("one"), "-o", os.path.join(FOLDER, "pictures"))
        files = [word for word in text.split() if word.endswith(".png")]
        self.assertEqual(status, 0)
        self.assertGreater(len(files), 5)
        for file in files:
            self.assertGreater(np.std(plt.imread(file)), 0.01, file)
        status, text = run(path("one"), "-o", FOLDER, "--only", "load", "--format", "pdf", "--width", "single", "--name", "mine")
        self.assertEqual((status, text.strip()), (0, os.path.join(FOLDER, "mine_load.pdf")))

    def test_refused(self):
        for words, word in (([path("one"), "--step", "99"], "1 to 26"), ([path("one"), "--step", "0"], "1 to 26"), ([path("nothing")], "nothing"), ([path("one"), "--width", "7"], "millimetres"),
                            ([path("one"), "--only", "nonsense"], "nonsense"), ([__file__], "read"), ([path("one"), "--only", "loop", "-o", FOLDER], "loop")):
            status, text = run(*words)
            self.assertTrue(status not in (0, None) and word in text + str(status), (words, status, text))


if __name__ == "__main__":
    unittest.main()
