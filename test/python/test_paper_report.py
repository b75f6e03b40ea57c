"""output/plot/paper*.py on files whose answers are known: the numbers of the report. The pictures and the sentences are not tested.

usage: test_paper_report.py FOLDER_OF_PLOT
"""
import contextlib
import re
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
import paper_laws  # noqa: E402
import paper_pressure  # noqa: E402
import paper_surfaces  # noqa: E402
from result_files import write_result  # noqa: E402

COLOURS = ["#0b3c5d", "#c1440e", "#4b8b3b", "#6a4c93", "#777777", "#b08d00", "#000000", "#1f9e9e"]
MARKERS, LINES = ["o", "s", "^", "D", "v", "P", "X", "<"], ["-", "--", "-.", ":", "-", "--", "-.", ":"]
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

    def test_density(self):
        grid, top = 4096, 1000  # the grid of the paper, and its largest bandwidth
        data, number = {}, 0
        for h in (0.2, 0.9):
            for waves in (16, 20, top):
                number += 1
                summits, theory = self.rng.uniform(90, 130, 4) * waves, 100.0 * waves * (1 + 0.3 * h)
                m2g, m4g = self.rng.uniform(1, 2, 4), 3e4 * self.rng.uniform(1, 2, 4)
                data[h, waves] = summits, theory, m2g, m4g
                write_result(self.folder, f"density_00{number}", {"surface%hurst": h, "surface%L_lambda_s": waves, "surface%L_lambda_l": 8, "surface%n": grid},
                             {"summits": ("realization", summits), "density_theory": ("", theory), "m2_theory": ("", 0.1), "saddles": ("realization", np.arange(4.0)), "m2_grid": ("realization", m2g), "m4_grid": ("realization", m4g)})
        for k, (h, n) in enumerate(((0.2, 256), (0.2, 1024), (0.9, 256))):
            write_result(self.folder, f"density_grid_00{k + 1}", {"surface%hurst": h, "surface%n": n}, {"summits": ("realization", np.array([90.0, 110.0]) + k), "density_theory": ("", 120.0)})
        report = report_of(paper_surfaces.density, folder=self.folder)
        for h in (0.9, 0.2):
            summits, theory, m2g, m4g = data[h, top]
            mean, error = summits.mean(), summits.std(ddof=1) / 2
            self.row_is(report, f"grid error, n = {grid}, L/lambda_s = {top}, H = {h}", 8.0 if h == 0.9 else 15.0, abs(100 * (1 - mean / theory)), 100 * error / theory)

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

    def test_maps(self):
        report = report_of(paper_contact.maps, folder=self.folder)
        s = STEP[1.43]
        for name, words in (("maps", "no plateau"), ("maps_plateau", "plateau")):
            N = self.runs[name][0][:, s]
            self.row_is(report, f"N at Z0/sigma = 1.43 [N], {words} ", 116.6, N.mean(), N.std(ddof=1) / np.sqrt(self.M))
        self.assertEqual(row(report, "area fraction beyond which spots would merge")[:3], ["19.6", "19.63", "0"])

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

class Contacts(Case):
    """Densities over contacts, hardness, spots, the paper's method."""

    M = 4
    LEVELS = np.array([2.0, 2.5, 3.0])

    def setUp(self):
        super().setUp()
        self.runs = {}
        for k, name in enumerate(("maps", "maps_plateau")):
            contacts = np.round((200 + 50 * k) * np.exp(-2 * (Z - 2)) * self.rng.uniform(0.8, 1.2, (self.M, 12)) + 1)
            run = dict(contacts=contacts, p=(np.arange(30) + 0.5) * 1500.0, q=(np.arange(30) + 0.5) * 2000.0, a=(np.arange(30) + 0.5) * 2e-7, count_p=self.rng.integers(0, 40, (3, 30)).astype(float), count_a=self.rng.integers(0, 60, (3, 30)).astype(float),
                       pdf_q=self.rng.uniform(0, 3e-5, (3, 30)), over=np.array([3.0, 5.0, 7.0]), slope=self.rng.uniform(4, 5, self.M), kappa=self.rng.uniform(5e3, 6e3, self.M))
            run["count_p"][:, 20:] = 0
            # Of each fit its parameters, all different.
            run["of"] = {("pressure_mean_pdf", a): (v + np.arange(3.0)) * f for a, v, f in (("rayleigh_scale", 11.0, 1e3), ("rayleigh_scale_error", 1.0, 11.0), ("ks_distance", 1.0, 0.01), ("skewness", 6.0, 0.1), ("mean", 13.0, 1e3))}
            run["of"] |= {("pressure_pdf", a): (v + np.arange(3.0)) * f for a, v, f in (("alpha", 9.0, 0.1), ("alpha_error", 2.0, 0.01), ("beta", 14.0, 0.1), ("beta_error", 3.0, 0.01), ("delta", 15.0, 1e3), ("mean", 16.0, 1e3), ("ks_distance", 4.0, 0.01),
                                                                                        ("independent_contacts", 300.0, 1.0))}
            run["of"] |= {("spot_area_pdf", a): (v + np.arange(3.0)) * f for a, v, f in (("exponential_scale", 8.0, 1e-7), ("exponential_scale_error", 1.0, 1e-8), ("ks_distance", 7.0, 0.01), ("standard_deviation", 12.0, 1e-7), ("mean", 8.0, 1e-7))}
            run["of"]["pressure_pdf", "alpha"][2] = 9.96920996838687e36 if k else run["of"]["pressure_pdf", "alpha"][2]
            self.runs[name] = run
            run["m2"], run["m4"] = 10.0 + k, 1.6e7 * (1 + k)
            write_result(self.folder, name, {"surface%plateau": (".false.", ".true.")[k]},
                         {"contacts": ("realization step", contacts), "separation_sigma": ("step", Z), "pdf_level": ("pdf_level", self.LEVELS), "pdf_separation_sigma": ("pdf_level", self.LEVELS), "pressure_mean_bin": ("bin", run["p"]),
                          "pressure_mean_count": ("pdf_level bin", run["count_p"]), "pressure_mean_pdf": ("pdf_level bin", run["count_p"]), "pressure_bin": ("bin", run["q"]), "pressure_pdf": ("pdf_level bin", run["pdf_q"]),
                          "spot_area_bin": ("bin", run["a"]), "spot_area_count": ("pdf_level bin", run["count_a"]), "spot_area_pdf": ("pdf_level bin", run["count_a"]), "rms_slope": ("realization", run["slope"]),
                          "mean_kappa_g": ("realization", run["kappa"]), "m2_theory": ("", run["m2"]), "m4_theory": ("", run["m4"])},
                         {**run["of"], ("pressure_mean_count", "overflow"): run["over"], ("spot_area_count", "overflow"): run["over"] + 1})

    def test_mean_pressure(self):
        report = report_of(paper_pressure.pressures, folder=self.folder)
        for z in self.LEVELS:
            for name, words in (("maps", "no plateau"), ("maps_plateau", "plateau")):
                c = self.runs[name]["contacts"][:, STEP[z]]
                self.row_is(report, f"contacts at Z0/sigma = {z:g}, 4 real., {words} ", None, c.sum(), c.std(ddof=1) * 2)
        run = self.runs["maps"]
        for k, z in enumerate(self.LEVELS):
            scale, error = (run["of"]["pressure_mean_pdf", a][k] for a in ("rayleigh_scale", "rayleigh_scale_error"))
            self.row_is(report, f"Rayleigh scale at Z0/sigma = {z:g} [N/mm2]", None, scale, error)

    def test_full_pressure(self):
        with unittest.mock.patch.object(paper_pressure, "each_contact_once", lambda bins, counts, rng: ((0.6 + counts.sum() / 1e4, 1.3 + bins[0] / 1e4), (0.01, 0.02))):
            report = report_of(paper_pressure.full_pressure, folder=self.folder)
        run, other = self.runs["maps"], self.runs["maps_plateau"]
        for k, z in enumerate(self.LEVELS):
            for r, name in ((run, "no plateau"), (other, "plateau")):
                for a, number in (("alpha", 2 / 3), ("beta", 1.5)):
                    value, error = r["of"]["pressure_pdf", a][k], r["of"]["pressure_pdf", a + "_error"][k]
                    if value > 1e30:
                        self.assertEqual(row(report, f"exponent {a} at Z0/sigma = {z:g}, {name} ")[:2], ["0.6667", "-"])
                    else:
                        self.row_is(report, f"exponent {a} at Z0/sigma = {z:g}, {name} ", number, value, error)
            for a, number, value, error in (("alpha", 2 / 3, 0.6 + run["count_p"][k].sum() / 1e4, 0.01), ("beta", 1.5, 1.3 + 750 / 1e4, 0.02)):
                self.row_is(report, f"exponent {a} at Z0/sigma = {z:g}, each contact once", number, value, error)

    def test_each_contact_once(self):
        """Mean pressures all alike: the density at a point is Hertz's 2 p/p0^2, whose exponent alpha is 1 and which ends sharply, beta large. Twice the contacts: the same."""
        bins, counts = (np.arange(60) + 0.5) / 6, np.zeros(60)
        counts[30] = 4000
        (alpha, beta), error = paper_pressure.each_contact_once(bins, counts, np.random.default_rng(1))
        self.assertTrue(0.9 < alpha < 1.1 and beta > 10, (alpha, beta))
        # Rayleigh's mean pressures: alpha between 0.5 and 0.8, beta between 1.3 and 1.7 (the density of p is an integral over Rayleigh's; 100 times finer bins give 0.62 and 1.43).
        counts = np.round(20000 * bins / 2**2 * np.exp(-(bins**2) / 8) / 6)
        (alpha, beta), error = paper_pressure.each_contact_once(bins, counts, np.random.default_rng(1))
        twice, smaller = paper_pressure.each_contact_once(bins, 4 * counts, np.random.default_rng(1))
        self.assertTrue(np.allclose(twice, (alpha, beta), rtol=1e-3) and 0.5 < alpha < 0.8 and 1.2 < beta < 1.7, (alpha, beta))
        self.assertTrue(np.all(error > 0) and np.all(error < 0.1) and np.all(smaller < 0.8 * error), (error, smaller))

    def test_hardness(self):
        made = []
        for k in range(2):
            count = np.array([40 + k, 55 + k])
            asperity, radius = self.rng.integers(1, 21, count.sum()), self.rng.uniform(1e-4, 1e-3, 20)
            a, p = self.rng.uniform(1e-5, 3e-4, count.sum()), self.rng.uniform(100, 1500, count.sum())
            made.append((count, asperity, radius, a, p))
            write_result(self.folder, f"contacts_00{k + 1}", {}, {"contact_start": ("step", [1, 1 + count[0]]), "contact_count": ("step", count), "contact_radius": ("contact", a), "contact_force": ("contact", p * np.pi * a**2), "contact_asperity": ("contact", asperity),
                                                                  "asperity_radius": ("asperity", radius), "separation_sigma": ("step", [2.6, 1.9])})
        e, y = self.rng.uniform(90, 110, (2, self.M, 12))
        contacts, plastic = self.rng.integers(90, 110, (self.M, 12)), self.rng.integers(60, 80, (self.M, 12))
        contacts[:, STEP[3.0]] = plastic[:, STEP[3.0]] = 0  # nothing touches there
        for name, N, more in (("yielding_001", e, {}), ("yielding_002", y / 9, {"plastic_contacts": ("realization step", plastic)})):
            write_result(self.folder, name, {}, {"force": ("realization step", N), "contact_area": ("realization step", N**2), "contacts": ("realization step", contacts), "separation_sigma": ("step", Z), **more})
        report = report_of(paper_pressure.hardness, folder=self.folder)
        self.row_is(report, "hardness at r = 0.18 um [N/mm2]", 1200, 550, 0.0)
        for name, text in (("maps", "no plateau"), ("maps_plateau", "plateau")):
            r = 1e3 / self.runs[name]["kappa"]
            self.row_is(report, f"r_g = 1/<kappa_g> [um], {text}, of the grid", 0.18, r.mean(), r.std(ddof=1) / 2)
        for z in (2.5, 2.0, 10 / 7, 1.0):
            s = STEP[round(z, 2)]
            share = plastic[:, s].sum() / contacts[:, s].sum()
            self.assertEqual(row(report, f"contacts that yield at Z0/sigma = {z:.3g} [%]"), ["-", f"{100 * share:.2f}", f"{100 * np.sqrt(share * (1 - share) / contacts[:, s].sum()):.2g}"])
            for name, N in (("elastic", e), ("yielding", y / 9)):
                self.row_is(report, f"N at Z0/sigma = {z:.3g} [N], {name}", None, N[:, s].mean(), N[:, s].std(ddof=1) / 2)
        slope = self.runs["maps"]["slope"]
        self.row_is(report, "rms slope of the gold surface", 4.7, slope.mean(), slope.std(ddof=1) / 2)



class Laws(Case):
    def test_everything(self):
        E, m2 = 90.0, 0.4
        factor = np.sqrt(2 * m2) * E / ROOT
        made = {}
        for k, (name, model, law, waves, n, plateau, count) in enumerate((("laws_001", "asperities", "hertz", 64, 256, False, 4), ("laws_002", "asperities", "hertz", 128, 512, False, 4), ("laws_003", "asperities", "elliptic", 128, 512, False, 4),
                                                                      ("laws_004", "asperities", "fourth_order", 128, 512, False, 3), ("laws_005", "asperities", "hertz", 128, 1024, False, 4), ("laws_006", "asperities", "elliptic", 128, 1024, False, 4),
                                                                      ("laws_007", "asperities", "fourth_order", 128, 1024, False, 4), ("elements_001", "elements", "hertz", 64, 1, False, 4), ("elements_002", "elements", "hertz", 128, 1, False, 3),
                                                                      ("elements_003", "elements", "hertz", 128, 1, True, 4), ("maps", "asperities", "hertz", 512, 2048, False, 6), ("maps_plateau", "asperities", "hertz", 512, 2048, True, 5))):
            base = 30 * np.exp(-2 * (Z - 2)) * np.ones((count, 1))
            N, A = base * self.rng.uniform(0.9, 1.1, (count, 12)), base / factor * self.rng.uniform(0.7, 0.9, (count, 12))
            contacts = np.round(10 * base * self.rng.uniform(0.9, 1.1, (count, 12))) + 1
            beyond = np.round(0.1 * (k + 1) / 8 * contacts)
            made[name] = dict(N=N, A=A, contacts=contacts, beyond=beyond, count=count, law="elements" if model == "elements" else law, waves=waves, points=8.0 + k if model == "elements" else n / waves)
            write_result(self.folder, name, {"solver%model": f"'{model}'", "asperities%law": f"'{law}'", "surface%L_lambda_s": waves, "surface%n": n, "elements%points_per_wave": 8.0 + k, "surface%plateau": ".true." if plateau else ".false."},
                         {"force": ("realization step", N), "contact_area": ("realization step", A), "contacts": ("realization step", contacts), "beyond_law": ("realization step", beyond), "separation_sigma": ("step", Z), "e_star": ("", E), "m2_theory": ("", m2)})
        report = report_of(paper_laws.laws, folder=self.folder)

        def beta(m, z, keep=None):
            keep = np.arange(m["count"]) if keep is None else keep
            return factor * m["A"][keep, STEP[z]].mean() / m["N"][keep, STEP[z]].mean()

        def with_error(count, of):
            left = np.array([of(np.delete(np.arange(count), k)) for k in range(count)])
            return of(np.arange(count)), np.sqrt((count - 1) / count * ((left - left.mean()) ** 2).sum())

        # beta of every run, and over that of elements on as many of the same surfaces.
        rows = [text.split() for text in report.lines if re.match(r" {6,} *(64|128) +[0-9]+ [a-z]", text)]
        wanted = []
        for truth, runs in (("elements_001", ["laws_001"]), ("elements_002", [f"laws_00{k}" for k in range(2, 8)])):
            for name in runs + [truth]:
                m, t = made[name], made[truth]
                count = min(m["count"], t["count"])
                words_of = f"{m['waves']} {m['points']:.0f} {m['law']}"
                for z in (2.0, 1.5, 1.0):
                    v, e = with_error(count, lambda keep: beta(m, z, keep))
                    words_of += f" {v:.4f} +- {e:.4f}"
                if name != truth:
                    for z in (2.0, 1.0):
                        v, e = with_error(count, lambda keep: beta(m, z, keep) / beta(t, z, keep))
                        words_of += f" {v:.4f} +- {e:.4f}"
                wanted.append(words_of.split())
        self.assertEqual(rows, wanted)
        for name in ("laws_005", "laws_006", "laws_007", "elements_002"):
            m = made[name]
            self.row_is(report, f"beta at 1 sigma, L/lambda_s = 128, {m['law']} ", 0.2, *with_error(m["count"], lambda keep: beta(m, 1.0, keep)))
        t = made["elements_002"]
        s = STEP[1.43]
        for name, truth, run in (("no plateau", "elements_002", "maps"), ("plateau", "elements_003", "maps_plateau")):
            t, r = made[truth], made[run]
            count = min(t["count"], r["count"])
            ratio, error = with_error(count, lambda keep: t["N"][keep, s].sum() / r["N"][keep, s].sum())
            mean, of_mean = r["N"][:, s].mean(), r["N"][:, s].std(ddof=1) / np.sqrt(r["count"])
            self.row_is(report, f"N at Z0/sigma = 1.43 [N], {name}, elements", 116.6, mean * ratio, mean * ratio * np.hypot(of_mean / mean, error / ratio))


if __name__ == "__main__":
    unittest.main()
