"""output/plot/paper*.py on files whose answers are known: the numbers of the report. The pictures and the sentences are not tested.

usage: test_paper_report.py FOLDER_OF_PLOT
"""
import contextlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

try:
    import scipy  # noqa: F401
except ImportError:
    sys.exit(77)  # the reports need it, nothing else does

sys.path.insert(0, sys.argv.pop(1))
import paper_common  # noqa: E402
import paper_contact  # noqa: E402
import paper_pressure  # noqa: E402
import paper_surfaces  # noqa: E402
from result_files import write_result  # noqa: E402

ROOT = np.sqrt(2 * np.pi)
Z = np.array([4.0, 25 / 7, 22 / 7, 3.0, 19 / 7, 2.5, 16 / 7, 2.0, 13 / 7, 1.5, 10 / 7, 1.0])  # levels of the synthetic runs
STEP = {round(z, 2): k for k, z in enumerate(Z)}
BODY = ("surface%sigma", "surface%L_lambda_s", "surface%L_lambda_l", "solids%R", "surface%n", "surface%hurst")


def report_of(*functions, folder=None):
    """The report of figures of the paper; the figures are not looked at."""
    report = paper_common.Report()
    with contextlib.ExitStack() as stack:
        for module in (paper_surfaces, paper_contact, paper_pressure):
            stack.enter_context(unittest.mock.patch.object(module, "save", lambda figure, folder, name: paper_common.plt.close(figure)))
        for function in functions:
            function(folder, report)
    return report


def row(report, start):
    """The words behind a row's name: paper's number, ours, error, difference."""
    found = [text for text in report.lines if text.startswith("  " + start)]
    assert len(found) == 1, (start, found)
    return found[0][58:].split()


def expected_row(paper_number, ours, error, digits=4):
    text = paper_common.text
    first = [text(paper_number), text(float(ours)), text(float(error), 2)]
    if paper_number is None:
        return first
    d = ours - paper_number
    return first + text(d, 3).split() + [f"({100 * d / paper_number:+.1f}", "%)"]


class Case(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.rng = folder.name, np.random.default_rng(6)

    def row_is(self, report, start, paper_number, ours, error):
        self.assertEqual(row(report, start), " ".join(expected_row(paper_number, ours, error)).split(), start)


class Common(Case):
    def test_estimators(self):
        v = np.array([1.0, 2.0, 4.0, 9.0])
        mean, error = paper_common.mean_and_error(v)
        self.assertAlmostEqual(mean, 4.0)
        self.assertAlmostEqual(error, np.sqrt((9 + 4 + 0 + 25) / 3 / 4))
        self.assertTrue(np.isnan(paper_common.mean_and_error([3.0])[1]))
        full, spread = paper_common.jackknife(4, lambda keep: v[keep].mean())  # of a mean it is the standard error
        self.assertAlmostEqual(full, mean)
        self.assertAlmostEqual(spread, error)
        self.assertTrue(np.isnan(paper_common.jackknife(1, lambda keep: 3.0)[1]))


class Surfaces(Case):
    def test_greenwood(self):
        """Greenwood's density: integral 1 over kappa1 > kappa2 taken twice, mode ratio 2.2153, mean 1.356; its mode is found again in a histogram of it."""
        k = (np.arange(2000) + 0.5) / 200
        k1, k2 = np.meshgrid(k, k, indexing="ij")
        self.assertAlmostEqual(paper_surfaces.greenwood(k1, k2).sum() / 200**2, 1, delta=1e-3)
        mode = paper_surfaces.exact_mode()
        self.assertAlmostEqual(mode[0] / mode[1], 2.2153, delta=1e-4)
        self.assertAlmostEqual(paper_surfaces.mean_of_formula(), 1.356, delta=1e-3)
        m1, m2 = np.meshgrid(paper_surfaces.MIDDLE, paper_surfaces.MIDDLE, indexing="ij")
        again = paper_surfaces.mode_of(np.where(m1 > m2, 2e5 * paper_surfaces.greenwood(m1, m2), 0))
        self.assertTrue(np.allclose(again, mode, rtol=2e-3), (again, mode))

class Area(Case):
    """Members of the area studies: areas of lone contacts by a radius r and of the second regime by a beta, both known, with some scatter."""

    M = 5

    def setUp(self):
        super().setUp()
        self.made = {}
        plan = [("area_001", 0.01, 64, 8, 2.5), ("area_002", 0.02, 64, 8, 2.5), ("area_003", 0.005, 64, 8, 2.5), ("area_004", 0.01, 32, 8, 2.5), ("area_005", 0.02, 32, 8, 2.5), ("area_006", 0.005, 32, 8, 2.5),
                ("area_R5_001", 0.01, 64, 8, 5.0), ("area_l48_001", 0.01, 64, 16, 2.5)]
        for k, (name, sigma, waves, low, R) in enumerate(plan):
            E, m2, m4 = 80.0 + k, 0.3 * (1 + 0.1 * k) * (sigma / 0.01) ** 2, 3.0e4 * (waves / 32) ** 2
            unit = m2**1.5 * E / m4
            levels = unit * np.concatenate([np.geomspace(0.1, 3, 6), np.geomspace(600, 4000, 6)]) if name != "area_l48_001" else unit * np.geomspace(0.1, 5, 12)
            N = levels * self.rng.uniform(0.9, 1.1, (self.M, 12))
            beta, r = 0.6 + 0.05 * k, 0.02 + 0.002 * k
            A = beta * ROOT * N / (np.sqrt(2 * m2) * E) * self.rng.uniform(0.98, 1.02, N.shape)
            contacts = np.tile([0, 1, 1, 2, 3, 5, 9, 20, 30, 50, 80, 120.0], (self.M, 1))
            contacts[0, 1] = 0  # not all of them rest on one asperity at once
            N[contacts == 0], A[contacts == 0] = 0, 0
            lone = contacts == 1
            A[lone] = np.pi * (3 * r * N[lone] / (4 * E)) ** (2 / 3) * self.rng.uniform(0.97, 1.03, lone.sum())
            self.made[name] = dict(sigma=sigma, waves=waves, low=low, R=R, E=E, m2=m2, m4=m4, unit=unit, N=N, A=A, contacts=contacts, slope=np.sqrt(2 * m2),
                                   range=slice(6, 12) if name != "area_l48_001" else np.flatnonzero(N.mean(axis=0) >= 0.5 * N.mean(axis=0).max()))
            write_result(self.folder, name, dict(zip(BODY, (sigma, waves, low, f"Infinity, {R}", 256, 0.8))),
                         {"force": ("realization step", N), "contact_area": ("realization step", A), "contacts": ("realization step", contacts), "force_mean": ("step", N.mean(axis=0)), "contact_area_mean": ("step", A.mean(axis=0)),
                          "force_std": ("step", N.std(axis=0, ddof=1)), "contact_area_std": ("step", A.std(axis=0, ddof=1)), "separation_sigma": ("step", Z), "e_star": ("", E), "m2_theory": ("", m2), "m4_theory": ("", m4),
                          "m2": ("realization", np.full(self.M, m2 * 1.1)), "m2_grid": ("realization", np.full(self.M, m2 * 0.9))})
        self.report = report_of(paper_contact.area, folder=self.folder)

    @staticmethod
    def left_out(values):
        """Standard error by leaving out one value at a time."""
        values = np.asarray(values)
        return np.sqrt((len(values) - 1) / len(values) * ((values - values.mean()) ** 2).sum())

    def beta(self, m):
        of = lambda keep: np.exp(np.mean(np.log(m["A"][keep].mean(axis=0)[m["range"]] / m["N"][keep].mean(axis=0)[m["range"]]))) * m["slope"] * m["E"] / ROOT
        return of(np.arange(self.M)), self.left_out([of(np.delete(np.arange(self.M), k)) for k in range(self.M)])

    def transitions(self, m):
        beta, error = self.beta(m)
        formula = 9 / 16 * 0.737**2 * np.pi**1.5 / beta**3
        lone = [np.mean([a / n ** (2 / 3) for n, a, c in zip(*row) if c == 1]) for row in zip(m["N"], m["A"], m["contacts"])]
        factor, factor_error = np.mean(lone), np.std(lone, ddof=1) / np.sqrt(self.M)
        data = (factor * m["slope"] * m["E"] / (beta * ROOT)) ** 3 / m["unit"]
        return formula, 3 * formula * error / beta, data, 3 * data * np.hypot(error / beta, factor_error / factor)

    def test_report(self):
        base = [self.made[f"area_00{k}"] for k in range(1, 7)]
        betas = np.array([self.beta(m)[0] for m in base])
        self.assertTrue(np.allclose(betas, 0.6 + 0.05 * np.arange(6), rtol=0.02))
        self.row_is(self.report, "beta, mean of the six members", 0.2, betas.mean(), betas.std(ddof=1) / np.sqrt(6))
        formulas, datas = zip(*[(f, d) for f, _, d, _ in map(self.transitions, base)])
        self.row_is(self.report, "N*/(m2^(3/2) E*/m4), A_I by r_g = 0.737/sqrt(m4)", 212.66, np.mean(formulas), np.std(formulas, ddof=1) / np.sqrt(6))
        self.row_is(self.report, "the same, A_I by the lone contacts of the data", 212.66, np.mean(datas), np.std(datas, ddof=1) / np.sqrt(6))
        rows = [line.split() for line in self.report.lines if line.count(" +- ") == 2 and " .. " in line]
        self.assertEqual(len(rows), 8)
        for found, m in zip(rows, self.made.values()):
            beta, error = self.beta(m)
            formula, df, data, dd = self.transitions(m)
            kappa = m["A"].mean(axis=0)[m["range"]] * m["slope"] * m["E"] / m["N"].mean(axis=0)[m["range"]]
            wanted = (f"{m['sigma']:g} {m['waves']} {m['low']} {m['R']:.1f} {beta:.4f} {error:.4f} {kappa[0]:.3f} .. {kappa[-1]:.3f} {formula:.2f} +- {df:.2f} {data:.2f} +- {dd:.2f} {data * m['unit']:.3g} {212.66 * m['unit']:.4g}")
            self.assertEqual(found, wanted.split())



class Maps(Case):
    M = 6

    def setUp(self):
        super().setUp()
        self.runs = {}
        x = (np.arange(12) + 0.5) / 12
        for k, name in enumerate(("maps", "maps_plateau")):
            N = (20 + 10 * k) * np.exp(-2 * (Z - 2)) * self.rng.uniform(0.8, 1.2, (self.M, 12))
            self.pressure = self.rng.uniform(0, 5, (12, 12, 12))
            r = (np.arange(40) + 0.5) / 80
            E, R = 90.0e3, 2.5
            a0 = (3 * N.mean(axis=0) * R / (4 * E)) ** (1 / 3)
            radial = np.array([(30 + s) * np.sqrt(np.maximum(1 - (r / 0.3) ** 2, 0)) if s % 2 else (30 + s) * np.exp(-(r**2) / (2 * 0.1**2)) for s in range(12)])
            self.runs[name] = N, self.pressure, radial, a0, r
            write_result(self.folder, name, {"surface%plateau": (".false.", ".true.")[k]},
                         {"force": ("realization step", N), "force_mean": ("step", N.mean(axis=0)), "separation_sigma": ("step", Z), "x": ("x", x), "map_pressure": ("step y x", self.pressure), "area_hertz": ("step", np.pi * a0**2),
                          "radius": ("radius", r), "radial_pressure": ("step radius", radial)})

    def test_radial(self):
        """Pressures that are Gaussian or Hertz's themselves: the fits find them."""
        report = report_of(paper_contact.radial, folder=self.folder)
        N, _, radial, a0, r = self.runs["maps"]
        mean = N.mean(axis=0)
        rows = [line.replace("|", " ").split() for line in report.lines if line.count("|") == 3 and "Hertz" not in line]
        levels = (4.0, 25 / 7, 22 / 7, 19 / 7, 16 / 7, 13 / 7, 10 / 7, 1.0)
        self.assertEqual(len(rows), len(levels))
        for k, (found, z) in enumerate(zip(rows, levels)):
            s = STEP[round(z, 2)]
            self.assertEqual(found[:4], [f"{z:.2f}", f"{mean[s]:.4g}", f"{a0[s]:.4f}", f"{1.5 * mean[s] / (np.pi * a0[s] ** 2):.4g}"])
            a, p0, d, width, pg, dg = map(float, found[4:])
            truth = (a, p0, d, 0.3) if s % 2 else (width, pg, dg, 0.1)
            self.assertTrue(abs(truth[0] / truth[3] - 1) < 2e-3 and abs(truth[1] / (30 + s) - 1) < 2e-3 and truth[2] < 2e-3, (z, found))
            self.assertTrue((dg if s % 2 else d) > 0.005, found)



class Contacts(unittest.TestCase):
    def test_each_contact_once(self):
        """Mean pressures all alike: the density at a point is Hertz's 2 p/p0^2, whose exponent alpha is 1 and which ends sharply, beta large."""
        bins, counts = (np.arange(60) + 0.5) / 6, np.zeros(60)
        counts[30] = 4000
        (alpha, beta), _ = paper_pressure.each_contact_once(bins, counts, np.random.default_rng(1))
        self.assertTrue(0.9 < alpha < 1.1 and beta > 10, (alpha, beta))
        # Rayleigh's mean pressures: alpha between 0.5 and 0.8, beta between 1.2 and 1.7 (100 times finer bins give 0.62 and 1.43).
        counts = np.round(20000 * bins / 2**2 * np.exp(-(bins**2) / 8) / 6)
        (alpha, beta), error = paper_pressure.each_contact_once(bins, counts, np.random.default_rng(1))
        twice, smaller = paper_pressure.each_contact_once(bins, 4 * counts, np.random.default_rng(1))
        self.assertTrue(np.allclose(twice, (alpha, beta), rtol=1e-3) and 0.5 < alpha < 0.8 and 1.2 < beta < 1.7, (alpha, beta))
        self.assertTrue(np.all(error > 0) and np.all(error < 0.1) and np.all(smaller < 0.8 * error), (error, smaller))


if __name__ == "__main__":
    unittest.main()
