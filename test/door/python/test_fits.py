"""The fits of the plot scripts (plot_fits.py), against distributions in closed form. usage: test_fits.py FOLDER of the scripts"""
import os
import sys
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop(1) if len(sys.argv) > 1 else os.curdir)
import plot_fits

try:
    import scipy  # noqa: F401
except ImportError:
    scipy = None


class Gamma(unittest.TestCase):
    @unittest.skipUnless(scipy, "without scipy")
    def test_weibull(self):
        """With alpha = beta - 1 the bins have the shares of 1 - exp(-(x/delta)^beta), and the mean is delta Gamma(1 + 1/beta)."""
        from math import gamma

        for beta, delta in ((1.0, 3.0), (1.7, 0.02), (2.5, 40.0)):
            edges = np.linspace(0, 4 * delta, 41)
            below = -np.expm1(-((edges / delta) ** beta))
            share = np.append(np.diff(below), 1 - below[-1])
            fit = plot_fits.fit_gamma(edges, share, delta * gamma(1 + 1 / beta), 1e4)
            self.assertLess(abs(fit.alpha - (beta - 1)), 1e-4)
            self.assertLess(abs(fit.beta / beta - 1), 1e-4)
            self.assertLess(abs(fit.delta / delta - 1), 1e-4)
            self.assertLess(abs(fit.factor * delta**beta / beta - 1), 1e-3)
            self.assertLess(fit.ks_distance, 1e-6)
            # Four times the contacts, half the error.
            more = plot_fits.fit_gamma(edges, share, delta * gamma(1 + 1 / beta), 4e4)
            self.assertLess(abs(2 * more.beta_error / fit.beta_error - 1), 1e-9)

    def test_too_little(self):
        for share, contacts in ((np.array([0.5, 0.25, 0, 0.25, 0]), 1e4), (np.full(20, 0.05), 9)):
            fit = plot_fits.fit_gamma(np.arange(share.size), share, 1.5, contacts)
            self.assertTrue(np.isnan(fit.alpha) and np.isnan(fit.beta_error))


if __name__ == "__main__":
    unittest.main()
