"""The evaluators of a law: exact laws, slopes, monotonicity and limits in Python; the same numbers,
statuses and lines in C and in Fortran.

usage: test_law_values.py C_PROGRAM FORTRAN_PROGRAM
"""
import math
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

from rsc.law import Law, LawError

FORTRAN, C = sys.argv.pop(), sys.argv.pop()
SUCCESS, FILE, FORM, COLUMN, ARGUMENT = range(5)
GAP = np.linspace(0.4, 5, 24)
# Exact laws, tables with zeros (no contact, closed), a rough table, and columns with limits.
COLUMNS = [
    ("gap", "- logarithmic", GAP),
    ("pressure", "exponential -", np.where(GAP > 4, 0, 3 * np.exp(-2 * GAP))),
    ("power", "power power", 0.1 * GAP**3.2),
    ("straight", "linear logarithmic", 2 - 0.3 * GAP),
    ("closed", "power power", np.where(GAP < 1, 0, (GAP - 0.9) ** 2)),
    ("steps", "exponential power", np.cumsum(np.random.default_rng(3).integers(0, 4, 24) ** 2)),
    ("factor", "power-to-1 power-to-1", 1 - 0.1 / (GAP + 0.2) ** 2),
    ("waves", "logarithmic logarithmic", np.sin(3 * GAP)),
]
HEAD = "# rsc law 1\n# column a mm - linear: x\n# column b MPa power -: y\n"


def written(path, columns):
    with open(path, "w", encoding="utf-8") as out:
        out.write("# rsc law 1\n# a comment: # column\n")
        for name, words, _ in columns:
            out.write(f"# column {name} 1 {words}: meaning of {name}\n")
        for row in zip(*(values for _, _, values in columns)):
            out.write(" ".join(f"{v:.17g}" for v in row) + "\n")
    return path


def setUpModule():
    global FOLDER, PATH, LAW
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name
    PATH = written(os.path.join(FOLDER, "made.law"), COLUMNS)
    LAW = Law(PATH)


def arguments(n=10000):
    """Within and beyond the rows."""
    return np.sort(np.random.default_rng(7).uniform(0.02, 9, n))


def every_pair():
    for name, words, _ in COLUMNS:
        for axis, word in enumerate(words.split()):
            if word != "-":
                yield name, ("gap", "pressure")[axis]


def other(program, name, axis, x):
    """(status, line), rows of value, slope, where."""
    done = subprocess.run(
        [program, PATH, name, str(1 + ("gap", "pressure").index(axis)), str(x.size)],
        input=" ".join(f"{v:.17g}" for v in x),
        text=True,
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    return tuple(int(v) for v in lines[0].split()), np.array([l.split() for l in lines[1:]], float)


class Numbers(unittest.TestCase):
    def test_exact_laws(self):
        x = arguments()
        p = x[x < 3.8]  # a pressure of 0 follows
        within = GAP[GAP <= 4]
        for name, at, value, slope in (
            ("pressure", p, 3 * np.exp(-2 * p), -6 * np.exp(-2 * p)),
            ("power", x, 0.1 * x**3.2, 0.32 * x**2.2),
        ):
            v, d, where = LAW.evaluate(name, gap=at)
            last = within[-2] if name == "pressure" else np.inf
            good = at <= last
            self.assertLess(abs(v / value - 1)[good].max(), 1e-12)
            self.assertLess(abs(d / slope - 1)[good].max(), 1e-11)
            self.assertTrue(
                np.array_equal(where, np.where(at < GAP[0], -1, np.where(at > GAP[-1], 1, 0)))
            )
        pressures = 3 * np.exp(-2 * x[x < 5])
        v, d, _ = LAW.evaluate("gap", pressure=pressures)
        self.assertLess(abs(v - x[x < 5])[v > GAP[0]].max(), 1e-12)
        self.assertLess(abs(d * pressures + 0.5)[v > GAP[0]].max(), 1e-11)
        self.assertTrue(np.all(v > 0))

    def test_rows_are_reproduced(self):
        for name, _, values in COLUMNS[1:]:
            found = LAW.evaluate(name, gap=GAP)
            self.assertLess(abs(found[0] - values).max(), 1e-13 * abs(values).max())
            self.assertFalse(found[2].any())

    def test_slopes(self):
        """Central differences; both sides of each row have the same slope."""
        h = 1e-5
        for name, axis in every_pair():
            x = arguments(2000) if axis == "gap" else np.geomspace(1e-4, 2, 2000)
            step = h if axis == "gap" else h * x
            slope = LAW.evaluate(name, **{axis: x})[1]
            difference = (
                LAW.evaluate(name, **{axis: x + step})[0]
                - LAW.evaluate(name, **{axis: x - step})[0]
            ) / (2 * step)
            scale = abs(slope * step).max() if axis == "pressure" else abs(slope).max()
            error = abs(slope - difference) * (step if axis == "pressure" else 1)
            self.assertLess(error.max(), 1e-3 * scale, (name, axis))  # kinks of the second slope
            self.assertLess(np.median(error), 1e-7 * scale, (name, axis))
            nodes = GAP if axis == "gap" else 3 * np.exp(-2 * GAP[GAP <= 4])
            sides = [LAW.evaluate(name, **{axis: nodes * (1 + e)})[1] for e in (-1e-9, 1e-9)]
            self.assertLess(
                abs((sides[1] - sides[0]) * nodes).max(), 1e-6 * abs(sides[0] * nodes).max()
            )

    def test_monotonic(self):
        for name, axis, sign in (
            ("pressure", "gap", -1),
            ("closed", "gap", 1),
            ("steps", "gap", 1),
            ("factor", "gap", 1),
            ("gap", "pressure", -1),
            ("closed", "pressure", -1),
            ("steps", "pressure", -1),
        ):
            x = arguments() if axis == "gap" else np.exp(np.sort(arguments()) - 8)
            value, slope, _ = LAW.evaluate(name, **{axis: x})
            rounding = 1e-14 * abs(value[:-1])
            self.assertTrue(np.all(sign * np.diff(value) >= -rounding), (name, axis))
            self.assertTrue(np.all(sign * slope >= -1e-14 * abs(slope).max()), (name, axis))

    def test_beyond(self):
        factor = LAW.evaluate("factor", gap=[50.0, 5000.0])[0]
        self.assertTrue(np.all(factor <= 1) and abs(factor[0] - 1) < 2e-4)
        self.assertLess(1 - factor[1], 1e-6)
        self.assertEqual(LAW.evaluate("pressure", gap=[4.5, 100])[0].tolist(), [0, 0])
        self.assertEqual(LAW.evaluate("closed", gap=[0.5, 0.0, -1])[0].tolist(), [0, 0, 0])
        self.assertEqual(LAW.evaluate("power", gap=0.0), (0, 0, -1))
        far = LAW.evaluate("gap", pressure=[1e3, 1e9])[0]
        self.assertTrue(0 <= far[1] < far[0] < GAP[0])
        for x in (0.0, -1.0, math.nan):
            with self.assertRaisesRegex(LawError, "no value at pressure"):
                LAW.evaluate("gap", pressure=[0.1, x])

    def test_threads(self):
        x, found = arguments(), [None] * 8

        def work(k):
            found[k] = LAW.evaluate("steps", gap=x)[0]

        threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for values in found:
            self.assertTrue(np.array_equal(values, found[0]))


class Languages(unittest.TestCase):
    def test_same_numbers(self):
        for name, axis in every_pair():
            x = arguments() if axis == "gap" else np.exp(arguments() - 8)
            expected = LAW.evaluate(name, **{axis: x})
            for program in (C, FORTRAN):
                status, rows = other(program, name, axis, x)
                self.assertEqual(status, (SUCCESS, 0))
                # Values relative to themselves, or to the rows where they pass through 0 or fall
                # to it; slopes times the argument also relative to the values.
                column = next(abs(v) for n, _, v in COLUMNS if n == name)
                least = column.max() if name == "waves" else column[column > 0].min()
                scale = np.maximum(abs(expected[0]), least)
                for k, by in ((0, 1), (1, x)):
                    difference = abs(rows[:, k] - expected[k]) * by / scale
                    self.assertLess(difference.max(), 1e-13, (program, name, axis, k))
                    scale = scale + abs(expected[1]) * x
                self.assertTrue(np.array_equal(rows[:, 2], expected[2]))

    def test_no_value(self):
        x = np.array([0.1, 0.0, -1.0, math.inf, math.nan, 0.2])
        for program in (C, FORTRAN):
            status, rows = other(program, "gap", "pressure", x)
            self.assertEqual(status, (ARGUMENT, 0))
            self.assertEqual(rows[:, 2].tolist(), [0, 2, 2, 1, 2, 0])
            self.assertEqual(np.isnan(rows[:, 0]).tolist(), (rows[:, 2] == 2).tolist())
            self.assertEqual(other(program, "power", "gap", -x[:3])[0], (SUCCESS, 0))
            self.assertEqual(other(program, "nothing", "gap", x)[0][0], COLUMN)
            self.assertEqual(other(program, "pressure", "pressure", x)[0][0], COLUMN)
        with self.assertRaisesRegex(LawError, "power against gap"):
            LAW.evaluate("nothing", gap=1.0)

    def test_refused(self):
        rows = "1 2\n2 3\n"
        for text, line in (
            ("", None),
            ("x" + HEAD + rows, 1),
            ("# rsc law 2\n" + rows, 1),
            (HEAD.replace("power -:", "power:") + rows, 3),
            (HEAD + rows + "3 x\n", 6),
            (HEAD + rows + "3\n", 6),
            (HEAD + rows + "3 4 5\n", 6),
            (HEAD + rows + "3 nan\n", 6),
            (HEAD + rows + "3 1e999\n", 6),
            (HEAD + "1 2\n", 0),
            ("# rsc law 1\n" + rows, 2),
            (HEAD + rows + "2 4\n", 0),  # not increasing
            (HEAD + rows + "3 -1\n", 0),  # no logarithm
            (HEAD.replace("power", "pow") + rows, 0),
            (HEAD.replace("power", "power-to-2") + rows, 0),
        ):
            path = os.path.join(FOLDER, "bad.law")
            with open(path, "w", encoding="utf-8") as out:
                out.write(text)
            with self.assertRaises(LawError) as caught:
                Law(path)
            self.assertIn(path, str(caught.exception))
            if line:
                self.assertIn(f"line {line}:", str(caught.exception))
            for program in (C, FORTRAN):
                done = subprocess.run([program, path], text=True, capture_output=True)
                status = [int(v) for v in done.stdout.split()]
                self.assertEqual(status, [FORM, line or 0], (program, text))
        for program in (C, FORTRAN):
            done = subprocess.run([program, path + "x"], text=True, capture_output=True)
            self.assertEqual(done.stdout.split(), [str(FILE), "0"])
        with self.assertRaises(OSError):
            Law(path + "x")


if __name__ == "__main__":
    unittest.main()
