"""What the programs of modules/example print, against the library called from Python; motions by
the same forces; conservation.

usage: test_examples.py FOLDER_OF_EXAMPLES        (RSC_PROGRAM in the environment)
"""
import functools
import os
import re
import subprocess
import sys
import unittest

import numpy as np

import rsc

EXAMPLES = sys.argv.pop(1)


def printed(name, *words, command=()):
    """Lines of numbers of an example; the words between them are left out."""
    path = os.path.join(EXAMPLES, "example_" + name)
    if not os.path.exists(path):
        raise unittest.SkipTest(f"no {path}")
    done = subprocess.run([*command, path, *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()


def numbers(line):
    return [float(word) for word in line.split()]


class Spheres:
    """The asperities of a case under its sphere."""

    def __init__(self, text, realization=1):
        case = rsc.Case(text)
        case["solver%tolerance"] = 1e-11
        asperities = rsc.Asperities.make(case, realization)
        self.count, self.contact = len(asperities), rsc.Contact.from_case(asperities, case)
        self.touch = self.contact.first_touch()

    def solve(self, Z0):
        """Force, stiffness dN/dZ0, area, number of contacts."""
        return (
            self.contact.indent(Z0),
            self.contact.stiffness(),
            self.contact.area,
            self.contact.contacts,
        )


SMALL = "&solver model='asperities' / &surface n=256, L_lambda_l=8, L_lambda_s=64, sigma={} /"


class Presses(unittest.TestCase):
    def close(self, found, expected, digits):
        """A printed number with so many digits behind its leading one."""
        self.assertAlmostEqual(
            found / expected, 1, delta=0.6 * 10.0**-digits, msg=f"{found}, {expected}"
        )

    def test_press(self):
        lines = printed("press")
        case = (
            "&solver model='asperities' / "
            "&surface n=512, L_lambda_l=8, L_lambda_s=128, sigma=0.005 / "
            "&solids E=70d3, 210d3, nu=0.33, 0.3 /"
        )
        spheres = Spheres(case)
        version = subprocess.run(
            [os.environ["RSC_PROGRAM"], "--version"], capture_output=True, text=True
        ).stdout.strip()
        self.assertEqual(lines[:2], [version, f"{spheres.count} asperities"])
        self.assertEqual(len(lines), 9)
        for k, line in enumerate(lines[3:8]):
            N, Z0, A, contacts, stiffness = numbers(line)
            self.assertEqual(N, 0.125 * 4**k)
            Z = spheres.contact.press(N)
            _, slope, area, count = spheres.solve(Z)
            self.assertAlmostEqual(Z0, Z, delta=1e-6)
            self.close(A, area, 3)
            self.assertEqual(contacts, count)
            self.close(stiffness, slope, 3)
        self.assertAlmostEqual(float(lines[8].split()[-1]), 32, delta=1e-4)

    def test_ranks(self):
        command = os.environ.get("RSC_MPIEXEC", "").split()
        if not command:
            raise unittest.SkipTest("no MPI")
        lines = sorted(printed("ranks", command=command))
        patches = [Spheres(SMALL.format(0.005) + " &solids R=2*Infinity /", k) for k in (1, 2)]
        low, high = min(p.touch for p in patches) - 0.05, max(p.touch for p in patches)
        for _ in range(60):
            Z0 = (low + high) / 2
            low, high = (Z0, high) if sum(p.solve(Z0)[0] for p in patches) > 40 else (low, Z0)
        for k, patch in enumerate(patches):
            N, _, area, count = patch.solve(Z0)
            words = re.fullmatch(
                r"rank (\d): force +(\S+) N, area +(\S+) mm2, contacts (\d+)", lines[k]
            )
            self.assertEqual((words[1], words[4]), (str(k), str(count)))
            self.assertAlmostEqual(float(words[2]), N, delta=1e-4)
            self.assertAlmostEqual(float(words[3]), area, delta=6e-6)
        words = re.fullmatch(r"together at +(\S+) mm: +(\S+) N", lines[2])
        self.assertAlmostEqual(float(words[1]), Z0, delta=2e-8)
        self.assertAlmostEqual(float(words[2]), 40, delta=1e-5)


MASS = 7.8e-9 * 4 / 3 * np.pi * 2.5**3


@functools.lru_cache(None)
def ball():
    return Spheres(
        SMALL.format("1.0e-3") + " &solids E=210d3, 210d3, nu=0.3, 0.3, R=Infinity, 2.5 /"
        " &asperities law='hertz' /"
    )


class Motions(unittest.TestCase):
    def depth_of(self, energy, gravity=0.0):
        """Depth below the first touch where the work of the contact force, less that of gravity, is
        this; and the force there."""
        depth = np.linspace(0, 1, 400) ** 1.5 * 4e-4
        force = np.array([ball().solve(ball().touch - d)[0] for d in depth])
        work = (
            np.append(0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(depth)))
            - gravity * depth
        )
        at = np.interp(energy, work, depth)
        return at, np.interp(at, depth, force)

    def test_bouncing(self):
        lines = printed("bouncing", "12")
        self.assertRegex(lines[0], r"^12 bounces in \d+ steps$")
        weight = MASS * 9.81e3
        depth, _ = self.depth_of(weight * 1e-3, weight)
        self.assertAlmostEqual(float(lines[1].split()[-2]) / depth, 1, delta=2e-3)
        self.assertEqual(lines[1].split()[-1], "mm")
        self.assertLess(float(re.search(r"energy +(\S+) of", lines[2])[1]), 1e-6)

    def test_impact(self):
        lines = printed("impact")
        rows = np.array([numbers(line) for line in lines[1:]])
        self.assertTrue(np.array_equal(rows[:, 0], [1, 3, 10, 30, 100, 300]))
        coming = 0.5 * MASS * rows[:, 0] ** 2
        # What is left is what the ball came with, less the plastic work.
        self.assertTrue(np.allclose(rows[:, 1] ** 2, 1 - rows[:, 4], atol=2e-4))
        self.assertTrue(
            np.all(rows[:2, 1] == 1) and np.all(rows[2:, 1] < 0.95) and np.all(rows[:, 5] < 1e-5)
        )
        depth, force = self.depth_of(coming[0])  # elastic
        self.assertAlmostEqual(rows[0, 2] / (1e3 * depth), 1, delta=2e-3)
        self.assertAlmostEqual(rows[0, 3] / force, 1, delta=5e-3)  # printed with three figures

    def test_rolling(self):
        """Sliding: Q = mu N, the velocity falls by the impulse of it, the spin by two and a half
        times as much; what is lost is the work of Q."""
        lines = printed("rolling")
        rows = np.array([numbers(line) for line in lines[1:-1]])
        self.assertEqual(rows.shape, (10, 6))
        self.assertTrue(
            np.allclose(
                rows[:, 0],
                (1000 * 5e-9 + (3000 * np.arange(1, 11) - 1000) * 2.5e-7) * 1e3,
                atol=6e-4,
            )
        )
        self.assertTrue(
            np.allclose(rows[:, 2], -2.5 * rows[:, 1], atol=3e-6)
        )  # momentum about the place of contact is kept: it began as nothing
        self.assertTrue(np.allclose(rows[:4, 4], 0.3 * rows[:4, 3], atol=1e-5))
        self.assertTrue(np.all(abs(rows[4:, 4]) <= 0.3 * rows[4:, 3] + 1e-5))
        self.assertTrue(np.all(np.diff(rows[:, 5]) > 0) and np.all(abs(rows[5:, 1]) < 0.2))
        self.assertLess(float(re.search(r"kept to +(\S+) of", lines[-1])[1]), 1e-6)


if __name__ == "__main__":
    unittest.main()
