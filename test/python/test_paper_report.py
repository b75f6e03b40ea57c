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

Z = np.array([4.0, 25 / 7, 22 / 7, 3.0, 19 / 7, 2.5, 16 / 7, 2.0, 13 / 7, 1.5, 10 / 7, 1.0])  # levels of the synthetic runs
STEP = {round(z, 2): k for k, z in enumerate(Z)}


def report_of(*functions, folder=None):
    """The report of figures of the paper; the figures are not looked at."""
    report = paper_common.Report()
    with contextlib.ExitStack() as stack:
        for module in (paper_surfaces, paper_contact, paper_pressure):
            stack.enter_context(unittest.mock.patch.object(module, "save", lambda figure, folder, name: paper_common.plt.close(figure)))
        for function in functions:
            function(folder, report)
    return report


class Case(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.rng = folder.name, np.random.default_rng(6)


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
