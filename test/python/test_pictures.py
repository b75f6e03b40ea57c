"""The pictures: the numbers drawn are those of the file, labels carry their units, levels not to be relied on are marked, what a file does not hold is not drawn.

usage: test_pictures.py FOLDER_OF_PLOT        (RSC_PROGRAM in the environment: the program that makes the results)
"""
import contextlib
import io
import os
import shutil
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
import plot_curves  # noqa: E402
import plot_distributions  # noqa: E402
import plot_maps  # noqa: E402
import plot_sideways  # noqa: E402
import plot_study  # noqa: E402
from plot_results import Result, names  # noqa: E402
from plot_style import MARKS, plt  # noqa: E402
import rsc  # noqa: E402

SURFACE = "&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.01 /"
CASES = {
    # Levels without contact, converged ones, and worse: a surface so rough that every status up to not_unique comes.
    "one": SURFACE + "&indentation start=5.0 stop=0.0 steps=26 / &output map_cells=20 heights=.true. pdf_levels=0.0,3.0 / &run title='One surface' /",
    "many": SURFACE + "&run realizations=8 / &indentation start=3.5 stop=0.5 steps=13 /",
    "flat": SURFACE + "&solids R=Infinity,Infinity / &indentation steps=4 /",
    "yielding": SURFACE + "&solids hardness=5.0e4 / &indentation levels=2.5,1.0 /",
    "far": SURFACE + "&indentation start=9.0 stop=7.0 steps=3 /",
    "failed": SURFACE + "&indentation start=2.0 stop=0.0 steps=5 / &solver tolerance=1.0e-14 max_iterations=1 /",
    "pressed": "&surface n=128 L_lambda_l=4 L_lambda_s=32 sigma=0.001 / &solids R=Infinity,Infinity / &indentation boundary='periodic' control='pressure' unit='relative' levels=0.001,0.004,0.01 /",
    "slid": SURFACE + "&solids friction=0.3 nu=0.3,0.25 E=2.0e5,1.0e5 / &indentation start=3.0 stop=1.0 steps=41 /",
    "compared": "&surface n=128 L_lambda_l=4 L_lambda_s=16 sigma=0.01 / &asperities law='fourth_order' / &indentation levels=2.0,1.0 / &compare levels=2.0,1.0 /",
    "study": SURFACE + "&indentation start=2.0 stop=0.5 steps=4 / &study surface%sigma=0.005,0.01,0.02 surface%hurst=0.5,0.8 /",
}


def setUpModule():
    global FOLDER
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name
    for name, case in CASES.items():
        done = subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path(name)], input=case, text=True, capture_output=True)
        assert done.returncode == (1 if name == "failed" else 0), done.stderr
    measured = f"&surface source='heights' file='{path('one')}' / &indentation steps=2 /"
    subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path("measured")], input=measured, text=True, capture_output=True, check=True)


def path(name):
    return os.path.join(FOLDER, name + ".nc")


def results(*which):
    return [Result(path(name)) for name in which]


def raw(name, variable):
    with netCDF4.Dataset(path(name)) as file:
        return np.ma.filled(file.variables[variable][:].astype(float), np.nan)


def run(*words):
    """(exit status, what was printed, files) of the command."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            status = plot.main(list(words))
        except SystemExit as stop:
            status = stop.code
    return status, out.getvalue()


def curves(axis):
    """Lines that are data: no marks, no fits."""
    return [line for line in axis.get_lines() if line.get_gid() is None]


OPTIONS = plot.Options()


class Curves(unittest.TestCase):
    def test_load(self):
        figure = plot_curves.load(results("one"), OPTIONS)
        force, contacts = figure.axes[:2]
        at = raw("one", "force_mean") > 0
        self.assertTrue(0 < at.sum() < at.size)
        for axis, name in ((force, "force"), (contacts, "contacts")):
            line = curves(axis)[0]
            self.assertTrue(np.array_equal(line.get_xdata(), raw("one", "separation_sigma")[at]))
            self.assertTrue(np.array_equal(line.get_ydata(), raw("one", name)[0][at]))
            self.assertIn(r"Z_0/\sigma", axis.get_xlabel())
        self.assertEqual(force.get_ylabel(), "force $N$ [N]")
        self.assertGreater(*force.get_xlim())  # the sphere comes down from left to right
        self.assertIn("One surface", figure._suptitle.get_text())

    def test_marks(self):
        """Every level that is not converged carries the mark of its status, and the legend says which."""
        for name, values in (("one", {1, 2, 3}), ("failed", {4})):
            status, force = raw(name, "status")[0], raw(name, "force")[0]
            z = raw(name, "separation_sigma")
            met = set(status[force > 0].astype(int)) - {0}
            self.assertTrue(met & values, f"{name}: {met}")  # the test has something to look at
            figure = plot_curves.load(results(name), OPTIONS)
            marks = [line for line in figure.axes[0].get_lines() if line.get_gid() == "status"]
            self.assertEqual({MARKS.index(line.get_marker()) for line in marks}, met)
            for line in marks:
                of = (status == MARKS.index(line.get_marker())) & (force > 0)
                self.assertTrue(np.array_equal(line.get_xdata(), z[of]) and np.array_equal(line.get_ydata(), force[of]))
            legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
            meanings = results(name)[0].level_status()[1]
            self.assertEqual([t for t in legend if t.startswith("level")], [f"level {meanings[v]}" for v in sorted(met)])

    def test_area(self):
        axis = plot_curves.area(results("one"), OPTIONS).axes[0]
        lines = {line.get_label(): line for line in curves(axis)}
        force, area = raw("one", "force_mean"), raw("one", "contact_area_mean")
        self.assertTrue(np.array_equal(lines["rsc"].get_xdata(), force[force > 0]) and np.array_equal(lines["rsc"].get_ydata(), area[force > 0]))
        for label, name in (("one asperity", "area_I"), (r"\beta", "area_II"), ("Hertz", "area_hertz")):
            line = next(v for k, v in lines.items() if label in k)
            x, y = line.get_xdata(), line.get_ydata()  # straight on these axes: through every level of the file
            drawn = np.exp(np.interp(np.log(force[force > 0]), np.log(x), np.log(y)))
            self.assertTrue(np.allclose(drawn, raw("one", name)[force > 0], rtol=1e-9), label)
        self.assertEqual((axis.get_xlabel(), axis.get_ylabel()), ("force $N$ [N]", "contact area $A$ [mm$^{2}$]"))

    def test_band(self):
        """The band holds what two thirds of the realizations have, at the force of the mean."""
        result = results("many")[0]
        low, high = plot_curves._area_at_force(result, result["force_mean"][result["force_mean"] > 0])
        n, a = result["force"], result["contact_area"]
        last = -3  # a level that all realizations reach
        at_mean = [np.exp(np.interp(np.log(result["force_mean"][last]), np.log(f[f > 0]), np.log(s[f > 0]))) for f, s in zip(n, a)]
        self.assertTrue(np.allclose((low[last], high[last]), np.percentile(at_mean, [16, 84])))
        figure = plot_curves.area([result], OPTIONS)
        self.assertEqual(len(figure.axes[0].collections), 1)
        self.assertIn("8 realizations", figure._suptitle.get_text())

    def test_several(self):
        figure = plot_curves.load(results("one", "flat"), OPTIONS)
        lines = [line for line in curves(figure.axes[0]) if line.get_xdata().size]
        self.assertEqual([line.get_label() for line in lines], names(results("one", "flat")))
        self.assertIn("$R$ = 2.5 mm", lines[0].get_label())
        self.assertIn("$R$ = inf mm", lines[1].get_label())
        self.assertTrue(np.array_equal(lines[1].get_ydata(), raw("flat", "force_mean")[raw("flat", "force_mean") > 0]))


class Places(unittest.TestCase):
    def test_map(self):
        figure = plot_maps.maps(results("one"), plot.Options(step=26))
        fraction, pressure = [axis for axis in figure.axes if axis.get_images() and axis.get_visible()]
        for axis, name in ((fraction, "map_area_fraction"), (pressure, "map_pressure")):
            drawn, field = axis.get_images()[0].get_array(), raw("one", name)[25]
            self.assertTrue(np.array_equal(drawn.filled(0), field))
            x, side = raw("one", "x"), raw("one", "map_cell_side")
            self.assertTrue(np.allclose(axis.get_images()[0].get_extent()[:2], (x[0] - side / 2, x[-1] + side / 2)))
        self.assertEqual(pressure.get_xlabel(), "$x$ [mm]")
        self.assertTrue(any("[N mm$^{-2}$]" in axis.get_xlabel() for axis in figure.axes))  # the colour bar
        circle = fraction.patches[0]
        self.assertAlmostEqual(np.pi * circle.get_radius() ** 2 / raw("one", "area_hertz")[25], 1, delta=1e-12)
        self.assertEqual(circle.get_center(), (raw("one", "tip_x"), raw("one", "tip_y")))

    def test_window(self):
        """All that is touched lies inside; little else."""
        x = np.arange(50.0)
        field = np.zeros((50, 50))
        field[20:24, 30:40] = 1.0  # rows are y
        x0, x1, y0, y1 = plot_maps.contact_window(x, x, field, 1.0)
        self.assertTrue(x0 <= 29.5 and x1 >= 39.5 and y0 <= 19.5 and y1 >= 23.5)
        self.assertLess(x1 - x0, 15)
        self.assertAlmostEqual(x1 - x0, y1 - y0)

    def test_spots(self):
        figure = plot_maps.spots(results("one"), plot.Options(step=20))
        collection = next(c for c in figure.axes[0].collections if c.get_gid() == "spots")
        first, count = int(raw("one", "contact_start")[19]) - 1, int(raw("one", "contact_count")[19])
        which = raw("one", "contact_asperity")[first : first + count].astype(int) - 1
        self.assertTrue(np.array_equal(collection.get_offsets(), np.column_stack([raw("one", "asperity_x")[which], raw("one", "asperity_y")[which]])))
        self.assertTrue(np.allclose(collection._widths * 2, 2 * raw("one", "contact_radius")[first : first + count]))  # half widths, in units of x
        self.assertEqual(collection._units, "xy")
        self.assertIn(f"{count} contact spots", figure.axes[0].get_title())
        self.assertTrue(any("[mm]" in axis.get_xlabel() and "height" in axis.get_xlabel() for axis in figure.axes))

    def test_yielding_spots(self):
        figure = plot_maps.spots(results("yielding"), plot.Options())
        of = {c.get_gid(): len(c.get_offsets()) for c in figure.axes[0].collections}
        first, count = int(raw("yielding", "contact_start")[1]) - 1, int(raw("yielding", "contact_count")[1])
        yields = int(raw("yielding", "contact_yields")[first : first + count].sum())
        self.assertTrue(0 < yields < count)
        self.assertEqual(yields, int(raw("yielding", "plastic_contacts")[0, 1]))
        self.assertEqual(of, {"spots": count - yields, "yielding spots": yields})
        self.assertIn(f"{yields} yield", figure.axes[0].get_title())
        self.assertEqual(names(results("one", "yielding"))[0][:7], "elastic")

    def test_radial(self):
        figure = plot_maps.radial(results("one"), plot.Options(step=26))
        points = curves(figure.axes[0])[0]
        meaning = results("one")[0].level_status()[1][int(raw("one", "status")[0, 25])]
        self.assertNotEqual(meaning, "converged")
        self.assertIn(f"({meaning})", points.get_label())
        self.assertTrue(np.array_equal(points.get_ydata(), raw("one", "radial_pressure")[25]))
        smooth = next(line for line in figure.axes[0].get_lines() if line.get_gid() == "hertz")
        hertz = raw("one", "hertz_pressure")[25]
        inside = hertz > 0
        self.assertTrue(np.allclose(np.interp(raw("one", "radius")[inside], smooth.get_xdata(), smooth.get_ydata()), hertz[inside], rtol=2e-3))  # drawn at 200 points

    def test_no_sphere(self):
        """Flat on flat: nothing of Hertz, in no picture."""
        self.assertIsNone(plot_maps.radial(results("flat"), OPTIONS))
        for picture in (plot_curves.area, plot_maps.maps):
            figure = picture(results("flat"), OPTIONS)
            texts = [figure._suptitle.get_text()] + [t.get_text() for axis in figure.axes if axis.get_legend() for t in axis.get_legend().get_texts()]
            self.assertFalse(any("Hertz" in text for text in texts), texts)
            self.assertFalse(any(axis.patches for axis in figure.axes if axis.get_images()))


    def test_flats(self):
        """kappa = A E* h'/N over p/(E* h'), of the run and of the theories in the file."""
        axis = plot_curves.flats(results("pressed"), OPTIONS).axes[0]
        lines = {line.get_label(): line for line in curves(axis)}
        relative = raw("pressed", "pressure")[0] / (float(raw("pressed", "e_star")) * raw("pressed", "rms_slope")[0])
        for label, share in (("rsc", raw("pressed", "area_fraction")[0]), ("Persson", raw("pressed", "area_persson")), ("Bush, Gibson, Thomas", raw("pressed", "area_bgt"))):
            self.assertTrue(np.allclose(lines[label].get_xdata(), relative, rtol=1e-12) and np.allclose(lines[label].get_ydata(), share / relative, rtol=1e-12), label)
        # The asymptote is sqrt(2 pi) by its definition; the spectrum's slope is not quite that of one surface.
        self.assertTrue(np.allclose(lines["Bush, Gibson, Thomas"].get_ydata(), np.sqrt(2 * np.pi), rtol=0.1))


class Sideways(unittest.TestCase):
    STEP = 40

    def test_loop(self):
        """The rough loop is the file's; the smooth one, Mindlin's, slips fully at mu N after (mu/m) delta and closes."""
        rough, smooth = curves(plot_sideways.loop(results("slid"), plot.Options(step=self.STEP)).axes[0])
        at = self.STEP - 1
        self.assertTrue(np.array_equal(rough.get_xdata(), raw("slid", "tangential_displacement")[at]) and np.array_equal(rough.get_ydata(), raw("slid", "tangential_force")[at]))
        N, m = raw("slid", "force_mean")[at], rsc.stiffness_ratio([2e5, 1e5], [0.3, 0.25])
        delta = (3 * N / (4 * float(raw("slid", "e_star")) * np.sqrt(float(raw("slid", "r_star"))))) ** (2 / 3)
        x, Q = smooth.get_xdata(), smooth.get_ydata()
        self.assertAlmostEqual(Q.max() / (0.3 * N), 1, delta=1e-12)
        self.assertAlmostEqual(x[np.argmax(Q)] / (0.3 / m * delta), 1, delta=1e-9)
        self.assertTrue(np.allclose((x[-1], Q[-1]), (x[61], Q[61]), rtol=1e-9))

    def test_stick(self):
        """Spots true to size; what sticks is the spots of an earlier level, and lies in those of this one."""
        slips, sticks = plot_sideways.stick(results("slid"), plot.Options(step=self.STEP)).axes[0].collections
        at = self.STEP - 1
        first, count = int(raw("slid", "contact_start")[at]) - 1, int(raw("slid", "contact_count")[at])
        radius = raw("slid", "contact_radius")
        self.assertTrue(np.allclose(slips._widths, radius[first : first + count]))  # half widths
        widths = [raw("slid", "contact_radius")[int(s) - 1 : int(s) - 1 + int(n)] for s, n in zip(raw("slid", "contact_start"), raw("slid", "contact_count"))]
        self.assertTrue(any(w.size == sticks._widths.size and np.allclose(w, sticks._widths) for w in widths[:at]))

    def test_curves(self):
        """Force and stiffness, both positive, of the levels with contact."""
        force, stiffness = (curves(axis)[0] for axis in plot_sideways.stiffness(results("slid"), OPTIONS).axes[:2])
        at = raw("slid", "force_mean") > 0
        self.assertTrue(np.array_equal(force.get_ydata(), raw("slid", "force")[0][at]) and np.array_equal(stiffness.get_ydata(), -raw("slid", "stiffness")[0][at]))


class Compare(unittest.TestCase):
    def test_errors(self):
        axis = plot_compare.compare(results("compared"), OPTIONS).axes[-1]
        lines = {line.get_label(): line for line in axis.get_lines()}
        z = raw("compared", "separation_sigma")[raw("compared", "compare_step").astype(int) - 1]
        for label, name in (("$N$", "force_error"), ("$A$", "area_error"), ("contacts", "contacts_error")):
            self.assertTrue(np.array_equal(lines[label].get_xdata(), z) and np.allclose(lines[label].get_ydata(), 100 * raw("compared", name)), label)
        for error, model, elements in (("force_error", "force", "compare_force"), ("area_error", "contact_area", "compare_contact_area"), ("contacts_error", "contacts", "compare_contacts")):
            self.assertTrue(np.allclose(raw("compared", error), raw("compared", model)[0] / raw("compared", elements) - 1, rtol=1e-9), error)
        self.assertIn("%", axis.get_ylabel())
        self.assertEqual(raw("compared", "compare_step").tolist(), [1, 2])  # levels count from 1
        self.assertTrue(np.array_equal(raw("compared", "compare_separation"), raw("compared", "separation")))
        self.assertAlmostEqual(lines["$N$"].get_ydata()[0], 100 * (raw("compared", "force")[0, 0] / raw("compared", "compare_force")[0] - 1), delta=1e-9)

    def test_spots(self):
        """Ellipses of the area of the file, long along the axis of the smaller curvature; their pressure along all lines adds up to the force."""
        result = results("compared")[0]
        x, y, a, f, ratio, angle, yields = plot_compare._spots(result, 1)
        which = raw("compared", "contact_asperity")[int(raw("compared", "contact_start")[1]) - 1 :].astype(int) - 1
        self.assertTrue(np.array_equal(x, raw("compared", "asperity_x")[which]) and np.array_equal(angle, raw("compared", "asperity_angle")[which]))
        self.assertTrue(np.all(ratio >= 1) and np.any(ratio > 1.2))
        self.assertFalse(np.any(yields))
        one = [[0.0], [0.0], [0.5], [3.0], [1.5], [0.4], [0]]
        lines = np.linspace(-0.8, 0.8, 401)
        total = 0
        for line in lines:
            along, pressure = plot_compare._line(result, one, line, -0.8, 0.8)
            total += pressure.sum() * (along[1] - along[0]) * (lines[1] - lines[0])
        self.assertAlmostEqual(total / 3.0, 1, delta=2e-3)
        _, middle = plot_compare._line(result, one, 0.0, -0.8, 0.8)
        self.assertAlmostEqual(middle.max() / (1.5 * 3.0 / (np.pi * 0.25)), 1, delta=1e-4)
        reach = [np.ptp(along[p > 0]) for along, p in (plot_compare._line(result, [[0.0], [0.0], [0.5], [3.0], [1.5], [t], [0]], 0.0, -0.8, 0.8) for t in (0.0, np.pi / 2))]
        self.assertTrue(np.allclose(reach, (2 * 0.5 * np.sqrt(1.5), 2 * 0.5 / np.sqrt(1.5)), atol=2e-3))
        _, flat = plot_compare._line(result, [*one[:6], [1]], 0.0, -0.8, 0.8)  # it yields: the same pressure everywhere
        self.assertTrue(np.allclose(flat[flat > 0], 3.0 / (np.pi * 0.25)) and np.array_equal(flat > 0, middle > 0))


class Distributions(unittest.TestCase):
    def test_numbers(self):
        counts = raw("one", "spot_area_count").sum(axis=1)
        self.assertTrue(counts[0] >= plot_distributions.ENOUGH > counts[1], counts)  # one level has enough, one has not
        figure = plot_distributions.distributions(results("one"), OPTIONS)
        for axis, (name, bins, *_) in zip(figure.axes, plot_distributions.PANELS):
            lines = curves(axis)
            self.assertEqual(len(lines), 1)
            density = raw("one", name)[0]
            self.assertTrue(np.array_equal(lines[0].get_xdata(), raw("one", bins)[density > 0]) and np.array_equal(lines[0].get_ydata(), density[density > 0]))
            self.assertIn("[mm", axis.get_ylabel())
            law = next(line for line in axis.get_lines() if line.get_gid() == "fit")
            x, y = law.get_xdata(), law.get_ydata()
            self.assertTrue(0.8 < np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(x)) < 1.02, name)  # a density, drawn as far as there are contacts

    def test_too_few(self):
        said = []
        self.assertIsNone(plot_distributions.distributions(results("flat"), plot.Options(say=said.append)) if raw("flat", "spot_area_count").sum(axis=1).max() < plot_distributions.ENOUGH
                          else None)
        self.assertIsNone(plot_distributions.distributions(results("far"), plot.Options(say=said.append)))
        self.assertIn("fewer than", said[-1])


class Spectrum(unittest.TestCase):
    def test_numbers(self):
        axis = plot_distributions.spectrum(results("measured"), OPTIONS).axes[0]
        k, psd, fit = (raw("measured", name) for name in ("wavenumber", "psd", "psd_fit"))
        drawn = curves(axis)[0]
        good = (k > 0) & (psd > 0)
        self.assertTrue(np.array_equal(drawn.get_xdata(), k[good]) and np.array_equal(drawn.get_ydata(), psd[good]))
        law = next(line for line in axis.get_lines() if line.get_gid() == "fit")
        self.assertTrue(np.array_equal(law.get_ydata(), fit[fit > 0]))
        low, high = axis.get_ylim()
        self.assertTrue(high > psd.max() and 1e-13 * psd.max() < low < fit[fit > 0].min())
        self.assertEqual(axis.get_xlabel(), "wavenumber $k$ [mm$^{-1}$]")


class Study(unittest.TestCase):
    def test_map(self):
        members, stem = plot.open_results([path("study_manifest")])
        self.assertEqual((len(members), stem), (6, "study"))
        figure = plot_study.study(members, OPTIONS)
        drawn = figure.axes[0].get_images()[0].get_array()
        keys = plot_study.differing_keys(members)
        self.assertEqual(set(keys), {"surface%sigma", "surface%hurst"})
        for member in members:
            i, j = (([0.005, 0.01, 0.02] if key == "surface%sigma" else [0.5, 0.8]).index(member.number(key)) for key in keys)
            self.assertEqual(drawn[i, j], member["force_mean"][-1])
        labels = figure.axes[0].get_ylabel(), figure.axes[0].get_xlabel()
        self.assertIn(r"$\sigma$ [mm]", labels)
        self.assertEqual(len(set(names(members))), 6)
        self.assertIn(r"$\sigma$ = 0.005 mm", names(members)[0])


class Command(unittest.TestCase):
    def setUp(self):
        self.dots = plt.rcParams["savefig.dpi"]
        plt.rcParams["savefig.dpi"] = 30  # saves time

    def tearDown(self):
        plt.rcParams["savefig.dpi"] = self.dots

    def test_all(self):
        for name, wanted in (("one", "load area map radial spots distributions stiffness"), ("many", "load area map radial distributions stiffness"), ("flat", "load area map spots stiffness")):
            # One result is drawn to the last point; of the others the figures are made and not rendered, which takes most of the time.
            with contextlib.nullcontext() if name == "one" else unittest.mock.patch.object(plt.Figure, "savefig", lambda _, file: shutil.copy(os.path.join(FOLDER, "pictures", "one_load.png"), file)):
                status, text = run(path(name), "-o", os.path.join(FOLDER, "pictures"))
            files = [word for word in text.split() if word.endswith(".png")]
            self.assertEqual((status, [os.path.basename(f) for f in files if not f.endswith("flat_distributions.png")]), (0, [f"{name}_{w}.png" for w in wanted.split()]))
            for file in files:
                with open(file, "rb") as picture:
                    self.assertEqual(picture.read(4), b"\x89PNG")
        status, text = run(path("study_manifest"), "-o", FOLDER, "--only", "study", "--only", "load", "--width", "double")
        self.assertEqual((status, text.split()), (0, [os.path.join(FOLDER, f"study_{w}.png") for w in ("study", "load")]))

    def test_formats(self):
        plt.rcParams["savefig.dpi"] = self.dots
        for kind, start in (("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")):
            status, text = run(path("one"), "-o", FOLDER, "--only", "load", "--format", kind, "--width", "single", "--name", "mine")
            self.assertEqual((status, text.strip()), (0, os.path.join(FOLDER, f"mine_load.{kind}")))
            with open(os.path.join(FOLDER, f"mine_load.{kind}"), "rb") as picture:
                self.assertEqual(picture.read(len(start)), start)
        with open(os.path.join(FOLDER, "mine_load.png"), "rb") as picture:
            width = int.from_bytes(picture.read(20)[16:20], "big")
        self.assertAlmostEqual(width / 300 * 25.4, 85.0, delta=0.2)

    def test_empty(self):
        with unittest.mock.patch.object(plt.Figure, "savefig"):
            status, text = run(path("one"), "-o", FOLDER, "--step", "1")
        self.assertRegex(text, r"--step 1: nothing touches at .*; levels \d+ to 26 have contact")
        self.assertEqual([w for w in text.split() if w.endswith(".png")][:1], [os.path.join(FOLDER, "one_load.png")])  # curves are of all levels
        self.assertFalse(any("map" in w or "spots" in w for w in text.split()))
        status, text = run(path("far"), "-o", FOLDER)
        self.assertEqual((status, "no level has contact" in text), (1, True))

    def test_refused(self):
        for words, message in (([path("one"), "--step", "99"], "levels 1 to 26"), ([path("nothing")], "cannot read"), ([path("one"), "--width", "7"], "millimetres"),
                               ([path("one"), "--only", "nonsense"], "invalid choice"), ([__file__], "cannot read"), ([path("one"), "--only", "loop", "-o", FOLDER], "does not hold")):
            status, text = run(*words)
            self.assertTrue(status not in (0, None) and message in (text + str(status)), (words, status, text))


if __name__ == "__main__":
    unittest.main()
