"""The command plot.py: which pictures a file gives, their formats, sizes and names, what is refused; and pieces that are drawn from. What the pictures hold is
compared in test_every_picture.py.

usage: test_pictures.py FOLDER_OF_PLOT        (RSC_PROGRAM in the environment: the program that makes the results)
"""
import argparse
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
import plot_maps  # noqa: E402
import plot_results  # noqa: E402
import plot_study  # noqa: E402
import plot_style  # noqa: E402
from plot_results import Result, names  # noqa: E402
from plot_style import plt  # noqa: E402

SURFACE = "&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.01 /"
CASES = {
    # Levels without contact, converged ones, and worse: a surface so rough that every status up to not_unique comes.
    "one": SURFACE + "&indentation start=5.0 stop=0.0 steps=26 / &output map_cells=20 heights=.true. pdf_levels=0.0,3.0 / &run title='One surface' /",
    "many": SURFACE + "&run realizations=8 / &indentation start=3.5 stop=0.5 steps=13 /",
    "flat": SURFACE + "&solids R=Infinity,Infinity / &indentation steps=4 /",
    "far": SURFACE + "&indentation start=9.0 stop=7.0 steps=3 /",
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
        assert done.returncode == 0, done.stderr


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


class Places(unittest.TestCase):
    def test_window(self):
        """All that is touched lies inside; little else."""
        x = np.arange(50.0)
        field = np.zeros((50, 50))
        field[20:24, 30:40] = 1.0  # rows are y
        x0, x1, y0, y1 = plot_maps.contact_window(x, x, field, 1.0)
        self.assertTrue(x0 <= 29.5 and x1 >= 39.5 and y0 <= 19.5 and y1 >= 23.5)
        self.assertLess(x1 - x0, 15)
        self.assertAlmostEqual(x1 - x0, y1 - y0)
        self.assertAlmostEqual(x1 - x0, 1.3 * 10)  # the longer side, and 15 % on either side
        field[:] = 0
        field[22, 30] = 1.0  # a single cell: four of them, and the margin
        self.assertTrue(np.allclose(plot_maps.contact_window(x, x, field, 1.0), (30 - 2.6, 30 + 2.6, 22 - 2.6, 22 + 2.6)))
        self.assertEqual(plot_maps.contact_window(x, x + 5, 0 * field, 1.0), (-0.5, 49.5, 4.5, 54.5))  # nothing: the whole


class Compare(unittest.TestCase):
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
            along, pressure = plot_compare._line(one, line, -0.8, 0.8)
            total += pressure.sum() * (along[1] - along[0]) * (lines[1] - lines[0])
        self.assertAlmostEqual(total / 3.0, 1, delta=2e-3)
        _, middle = plot_compare._line(one, 0.0, -0.8, 0.8)
        self.assertAlmostEqual(middle.max() / (1.5 * 3.0 / (np.pi * 0.25)), 1, delta=1e-4)
        reach = [np.ptp(along[p > 0]) for along, p in (plot_compare._line([[0.0], [0.0], [0.5], [3.0], [1.5], [t], [0]], 0.0, -0.8, 0.8) for t in (0.0, np.pi / 2))]
        self.assertTrue(np.allclose(reach, (2 * 0.5 * np.sqrt(1.5), 2 * 0.5 / np.sqrt(1.5)), atol=2e-3))
        _, flat = plot_compare._line([*one[:6], [1]], 0.0, -0.8, 0.8)  # it yields: the same pressure everywhere
        self.assertTrue(np.allclose(flat[flat > 0], 3.0 / (np.pi * 0.25)) and np.array_equal(flat > 0, middle > 0))


class Study(unittest.TestCase):
    def test_members(self):
        members, stem = plot.open_results([path("study_manifest")])
        self.assertEqual((len(members), stem), (6, "study"))
        self.assertEqual(len(set(names(members))), 6)
        self.assertEqual(sorted(names(members)), sorted(rf"$H$ = {h}, $\sigma$ = {s} mm" for s in ("0.005", "0.01", "0.02") for h in ("0.5", "0.8")))

    def test_member_that_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            for k in ("manifest", "001", "003", "004", "005", "006"):
                shutil.copy(path(f"study_{k}"), folder)
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                members, _ = plot.open_results([os.path.join(folder, "study_manifest.nc")])
            self.assertEqual([os.path.basename(m.path) for m in members], [f"study_00{k}.nc" for k in (1, 3, 4, 5, 6)])
            self.assertEqual(said.getvalue(), "plot.py: 1 of 6 members have no result yet: study_002.nc, ...\n")
            figure = plot_study.study(members, plot.Options())  # a hole where the member is missing
            self.assertEqual(np.isnan(figure.axes[0].get_images()[0].get_array().filled(np.nan)).sum(), 1)
            self.assertEqual([len(axis.texts) for axis in figure.axes[:3]], [5, 5, 5])
            for k in ("001", "003", "004", "005", "006"):
                os.remove(os.path.join(folder, f"study_{k}.nc"))
            self.assertEqual(run(os.path.join(folder, "study_manifest.nc"))[0], "plot.py: the study has no results yet")


class Named:
    """What names() looks at."""

    def __init__(self, title="", path="x.nc", **case):
        self.title, self.path = title, path
        self.case = {"run%length_unit": "'um'", "run%force_unit": "'mN'", **{key.replace("__", "%"): value for key, value in case.items()}}


class Legends(unittest.TestCase):
    def test_keys(self):
        """Every key with its symbol and unit."""
        for key, value, text in (("surface__sigma", "0.5", r"$\sigma$ = 0.5 um"), ("surface__hurst", "0.8", "$H$ = 0.8"), ("surface__L", "2.0", "$L$ = 2 um"), ("surface__n", "64", "$n$ = 64"),
                                 ("surface__L_lambda_l", "8.0", r"$L/\lambda_l$ = 8"), ("surface__L_lambda_s", "64.5", r"$L/\lambda_s$ = 64.5"), ("solids__R", "Infinity, 2.5", "$R$ = 2.5 um"),
                                 ("solids__R", "3.0, 2.5", "$R$ = 3, 2.5 um"), ("solids__R", "Infinity, Infinity", "$R$ = inf um"), ("solids__E", "7.0, Infinity", "$E$ = 7 mN um$^{-2}$"), ("solids__nu", "0.3, 0.25", r"$\nu$ = 0.3, 0.25"),
                                 ("solids__hardness", "550.0", "$H_0$ = 550 mN um$^{-2}$"), ("solids__hardness", "Infinity", "elastic"), ("solids__friction", "0.2", r"$\mu$ = 0.2"),
                                 ("asperities__law", "'elliptic'", "law = elliptic"), ("solver__model", "'elements'", "model = elements"), ("solver__method", "'mesh'", "method = mesh"),
                                 ("solver__interaction", "'none'", "interaction = none"), ("run__seed", "7", "seed = 7"), ("surface__plateau", ".true.", "plateau = .true."),
                                 ("indentation__selection_factor", "2.0", "selection factor = 2"), ("surface__sigma", "", r"$\sigma$ at default")):
            self.assertEqual(names([Named(**{key: value}), Named(**{key: "other"})])[0], text)

    def test_what_tells_results_apart(self):
        two = lambda a, b: names([a, b])
        self.assertEqual(two(Named("A", surface__n="1", surface__hurst="0.5"), Named("B", surface__n="2", surface__hurst="0.6")), ["$n$ = 1, $H$ = 0.5", "$n$ = 2, $H$ = 0.6"])
        # Titles, numbers of threads and output do not count; the same case twice is told apart by titles, or by the names of the files.
        self.assertEqual(two(Named("A", run__threads="1", run__title="'A'", output__format="x"), Named("B", run__threads="2", run__title="'B'", output__format="y")), ["A", "B"])
        self.assertEqual(two(Named("A", "f/one.nc"), Named("A", "f/two.nc")), ["one", "two"])
        self.assertEqual(two(Named("", "f/one.nc"), Named("A", "f/two.nc")), ["one", "two"])
        long = {f"indentation__key_number_{k}": "1.5" for k in range(5)}
        self.assertEqual(two(Named("A", **long), Named("B", **{key: "2.5" for key in long})), ["A", "B"])
        self.assertEqual([names([Named("A")]), names([Named("", "f/one.nc")])], [["A"], ["one.nc"]])

    def test_styles(self):
        """Markers, lines and colours that differ; of more than nine curves colours from dark to light."""
        styles = [plot_style.style(k, 9) for k in range(9)]
        for part in (0, 2):
            self.assertEqual(len({s[part] for s in styles}), 9)
        self.assertEqual([s[0] + s[1] for s in styles], ["o-", "s--", "^-.", "D:", "v-", "P--", "X-.", "<:", ">-"])
        many = [plot_style.style(k, 12) for k in range(12)]
        self.assertEqual(many[11][0] + many[11][1], "^:")
        light = [np.dot(s[2][:3], (0.3, 0.6, 0.1)) for s in many]
        self.assertTrue(np.all(np.diff(light) > 0))
        self.assertEqual([plot_style.few(k) for k in (1, 3, 4, 9)], [0, 0, 6, 11])
        self.assertEqual(plot_style.MARKS[1:], ["o", "s", "^", "x"])
        self.assertEqual(plot_style.WIDTHS, {"single": 85.0, "onehalf": 130.0, "double": 175.0})

    def test_many_marks(self):
        """Some twenty marks of a kind at most, but all of what did not converge."""
        figure, axis = plt.subplots()
        x = np.arange(100.0)
        for value, count in ((1, 20), (4, 100)):
            self.assertEqual(plot_style.mark_levels(axis, x, 2 * x, np.full(100, value), "b"), {value})
            marks = axis.get_lines()[-1]
            self.assertEqual((len(marks.get_xdata()), marks.get_marker()), (count, plot_style.MARKS[value]))
            self.assertTrue(np.array_equal(marks.get_ydata(), 2 * marks.get_xdata()))
        self.assertEqual(plot_style.mark_levels(axis, x, np.full(100, np.nan), np.full(100, 1), "b"), set())
        plt.close(figure)

    def test_units(self):
        for text, shown in (("N mm-2", "N mm$^{-2}$"), ("um2 mN-1", "um$^{2}$ mN$^{-1}$"), ("1", "1"), ("mm", "mm"), ("um4", "um$^{4}$"), ("N mm-10", "N mm$^{-10}$")):
            self.assertEqual(plot_results.pretty_unit(text), shown)
        self.assertEqual(plot_results.plain(" [N mm$^{-2}$]"), " N mm$^{-2}$")

    def test_sizes(self):
        """Panels side by side where they are 62 mm wide at least, below each other otherwise."""
        for count, width, rows, columns in ((2, 150.0, 1, 2), (2, 85.0, 2, 1), (3, 175.0, 2, 2), (3, 190.0, 1, 3), (2, 123.9, 2, 1), (2, 124.0, 1, 2)):
            figure, axes = plot_style.panels(count, width)
            self.assertEqual(len(axes), count)
            self.assertTrue(np.allclose(figure.get_size_inches() * 25.4, (width, rows * 0.78 * width / columns + 8)))
            plt.close(figure)
        figure, axes = plot_style.panels(2, 150.0, entries=9)  # nine lines in two columns
        self.assertTrue(np.allclose(figure.get_size_inches() * 25.4, (150, 0.78 * 75 + 5 * 3.4 + 4 + 8)))
        self.assertEqual((len(axes), axes[-1].axison), (3, False))
        plt.close(figure)

    def test_title(self):
        """Lines of the title are broken where the picture is too narrow."""
        for width, lines in ((85.0, 3), (300.0, 2)):
            figure = plt.figure(figsize=(width / 25.4, 2))
            figure.suptitle("word " * 20 + "\nlast")
            plot.fit_title(figure)
            text = figure._suptitle.get_text().split("\n")
            self.assertEqual((len(text), text[-1], " ".join(text[:-1])), (lines, "last", ("word " * 20).strip()))
            self.assertLessEqual(max(map(len, text)), width / 1.5)
            plt.close(figure)


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

    def test_bounds(self):
        """What is refused begins right behind what is taken."""
        for text, value in (("40", 40.0), ("1000", 1000.0), ("single", 85.0), ("onehalf", 130.0), ("double", 175.0), ("62.5", 62.5)):
            self.assertEqual(plot.width(text), value)
        for text in ("39.9", "1000.1", "0", "-85", "nan", "wide", ""):
            with self.assertRaises(argparse.ArgumentTypeError):
                plot.width(text)
        with unittest.mock.patch.object(plt.Figure, "savefig"):
            self.assertEqual(run(path("one"), "-o", FOLDER, "--only", "load", "--step", "26")[0], 0)
            for step in ("0", "27", "-1"):
                self.assertEqual(run(path("one"), "-o", FOLDER, "--step", step)[0], f"plot.py: --step {step}: {path('one')} has levels 1 to 26")
            # Names: of one file, of the first and the last of several, or one's own; in the folder of the first.
            for files, words, name in ((["one"], [], "one"), (["one", "many", "flat"], [], "one_to_flat"), (["study_manifest", "one"], [], "study_to_one"), (["one"], ["--name", "mine"], "mine")):
                self.assertEqual(run(*map(path, files), "--only", "load", *words), (0, os.path.join(FOLDER, name + "_load.png") + "\n"))
        options = plot.parse(["x.nc"])
        self.assertEqual((options.format, options.width, options.step, options.only, options.name, options.output), ("png", 150.0, None, None, None, None))
        self.assertEqual((plt.rcParams["font.size"], plt.rcParams["svg.fonttype"], plt.rcParams["pdf.fonttype"], self.dots), (8.0, "none", 42, 300.0))

    def test_refused(self):
        for words, message in (([path("one"), "--step", "99"], "levels 1 to 26"), ([path("nothing")], "cannot read"), ([path("one"), "--width", "7"], "millimetres"),
                               ([path("one"), "--only", "nonsense"], "invalid choice"), ([__file__], "cannot read"), ([path("one"), "--only", "loop", "-o", FOLDER], "does not hold")):
            status, text = run(*words)
            self.assertTrue(status not in (0, None) and message in (text + str(status)), (words, status, text))


if __name__ == "__main__":
    unittest.main()
