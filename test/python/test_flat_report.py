"""output/plot/flat.py on files whose answers are known: every number of the report.

usage: test_flat_report.py FOLDER_OF_PLOT
"""
import contextlib
import io
import os
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
import flat  # noqa: E402
from result_files import write_result  # noqa: E402

COLOURS = ["#0b3c5d", "#c1440e", "#4b8b3b"]
MARKERS, LINES = "os^", ["-", "--", "-."]


def write(folder, realizations):
    rng = np.random.default_rng(4)
    made = {"alpha": [], "size": []}
    for k, alpha in enumerate((2.0, 10.0, 90.0)):
        for model, start, fall in (("elements", 2.4, -0.2), ("asperities", 2.7, -0.5)):
            E, slope = 50.0 + 10 * k, rng.uniform(0.3, 0.6, realizations)
            kappa = start + fall * np.log10(alpha) + rng.normal(0, 0.03, realizations)
            N = rng.uniform(3, 9, (realizations, 1))
            write_result(folder, f"alpha_{model}_00{k + 1}", {"surface%L_lambda_l": 8 - k, "surface%L_lambda_s": 32 * (k + 1), "indentation%levels": 0.02},
                         {"contact_area": ("realization step", kappa[:, None] * N / (E * slope[:, None]), "mm2"), "force": ("realization step", N, "N"), "e_star": ("", E), "rms_slope": ("realization", slope),
                          "nayak_theory": ("", alpha)})
            made["alpha"].append((model, 8 - k, 32 * (k + 1), alpha, kappa))
    p = np.geomspace(1e-4, 5e-2, 6)
    for k, waves in enumerate((2, 4, 8)):
        for model, factor in (("elements", 1.0), ("asperities", 1.1)):
            E, m2, sigma = 60.0, 0.02 * (k + 1), 0.003 * (k + 2)
            pressure = p * E * np.sqrt(2 * m2) * np.ones((realizations, 1))
            force = pressure * 1.7
            K = factor * (2 + 3 / waves * (p / 1e-4) ** -0.4) * rng.normal(1, 0.02, (realizations, 1))
            write_result(folder, f"size_{model}_00{k + 1}", {"surface%L_lambda_l": waves, "surface%sigma": sigma, "surface%hurst": 0.8},
                         {"pressure": ("realization step", pressure, "N mm-2"), "force": ("realization step", force, "N"), "stiffness": ("realization step", -K * force / sigma, "N mm-1"), "e_star": ("", E), "m2_theory": ("", m2)})
            made["size"].append((model, waves, K))
    with open(os.path.join(folder, "times.txt"), "w", encoding="utf-8") as out:
        out.write("alpha_elements 70\nsize_elements 33 resumed\n")
    return p, made


class Flat(unittest.TestCase):
    maxDiff = None

    def run_on(self, realizations):
        with tempfile.TemporaryDirectory() as folder:
            p, made = write(folder, realizations)
            keep = lambda figure, folder, name: None
            with unittest.mock.patch.object(flat, "save", keep), unittest.mock.patch.object(sys, "argv", ["flat.py", folder]), contextlib.redirect_stdout(io.StringIO()) as said:
                flat.main()
            self.assertEqual(said.getvalue(), os.path.join(folder, "report.txt") + "\n")
            with open(os.path.join(folder, "report.txt"), encoding="utf-8") as report:
                return p, made, report.read()

    def test_kappa(self):
        _, made, text = self.run_on(5)
        mean = {m: np.array([k.mean() for model, *_, k in made["alpha"] if model == m]) for m in ("elements", "asperities")}
        error = {m: np.array([k.std(ddof=1) / np.sqrt(5) for model, *_, k in made["alpha"] if model == m]) for m in mean}
        alpha = np.array([2.0, 10.0, 90.0])
        rows = [line for line in text.splitlines() if line.endswith(" %")]
        for k, row in enumerate(rows):
            e, a = mean["elements"][k], mean["asperities"][k]
            self.assertEqual(row.split(), [f"{8 - k}", f"{32 * (k + 1)}", f"{alpha[k]:.1f}", f"{e:.3f}", "+-", f"{error['elements'][k]:.3f}", f"{a:.3f}", "+-", f"{error['asperities'][k]:.3f}", f"{100 * (a / e - 1):+.1f}", "%"])
        self.assertEqual(len(rows), 3)
        x = np.log10(alpha)
        for k, m in enumerate(mean):
            # A straight line by least squares through three points.
            slope = ((x - x.mean()) * mean[m]).sum() / ((x - x.mean()) ** 2).sum()
            start = mean[m].mean() - slope * x.mean()
            rest = np.sqrt(np.mean((mean[m] - start - slope * x) ** 2))
            self.assertIn(f"  {m}: kappa = {start:.3f} {slope:+.3f} log10 alpha, to {rest:.3f} rms (standard errors {np.sqrt(np.mean(error[m] ** 2)):.3f}).\n", text)
        self.assertIn("Persson's theory, which knows no alpha (1.596), and the asymptote of Bush, Gibson and Thomas (2.507).", " ".join(text.split()))
        self.assertIn("p/(E* h') = 0.02, h' the rms slope of each surface; mean of 5 surfaces", " ".join(text.split()))

    def test_stiffness(self):
        p, made, text = self.run_on(5)
        mean = {(m, w): K.mean(axis=0) for m, w, K in made["size"]}
        lines = text.splitlines()
        head = next(k for k, row in enumerate(lines) if row.split()[:1] == ["p/(E*"])
        self.assertEqual(lines[head].split(), "p/(E* h') L/lambda_l = 2 L/lambda_l = 4 L/lambda_l = 8".replace("h')", "h)").split())
        for k, row in enumerate(lines[head + 1 : head + 1 + p.size]):
            self.assertEqual(row.split(), [f"{p[k]:.2g}"] + [w for n in (2, 4, 8) for w in (f"{mean['elements', n][k]:.3f}", f"({mean['asperities', n][k]:.3f})")])
        flowing = " ".join(text.split())
        for n in (2, 4, 8):
            K = mean["elements", n]
            grows = (np.log(K[2] * p[2]) - np.log(K[0] * p[0])) / (np.log(p[2]) - np.log(p[0]))
            at = np.interp(np.log(0.005), np.log(p), K)
            self.assertIn(f"L/lambda_l = {n}: K sigma/p = {at:.2f} at p/(E* h') = 0.005; K ~ p^{grows:.2f} up to {p[2]:.1e} (a single self-affine contact: 1/(1 + H) = 0.556; many: 1).", flowing)


if __name__ == "__main__":
    unittest.main()
