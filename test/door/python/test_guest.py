"""The library as a guest of Python: Ctrl-C, many contacts, arrays with holes, damaged results."""
import os
import signal
import subprocess
import sys
import threading
import unittest
import unittest.mock

import numpy as np

import rsc
from result_files import InFolder

SMALL = {
    "surface": {"n": 64, "L_lambda_l": 2, "L_lambda_s": 8},
    "solids": {"R": [float("inf"), 2.5]},
}


class Guest(InFolder):
    def test_interrupt(self):
        # Levels of elements that would take minutes.
        case = rsc.Case(
            "&surface L_lambda_l=2 L_lambda_s=16 / &solver model='elements' tolerance=1e-9 /"
            "&elements points_per_wave=8 / &indentation start=2 stop=-2 steps=20000 /"
        )
        seen = []

        def progress(done, total):
            seen.append((done, total))
            if len(seen) == 3:
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            case.run(self.path("long.nc"), progress)
        self.assertEqual(os.listdir(self.folder), [])

        # Also while nothing else happens; the call of the library has ended then, not only the
        # waiting for it.
        ended, call = [], rsc._case._call

        def noted(function, *values):
            try:
                return call(function, *values)
            finally:
                ended.append(function)

        threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
        with unittest.mock.patch("rsc._case._call", noted), self.assertRaises(KeyboardInterrupt):
            case.run(self.path("long.nc"))
        self.assertIn("rsc_case_run_watched", ended)

        def refuse(done, total):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            case.run(self.path("long.nc"), refuse)

    def test_end_of_the_interpreter(self):
        program = """
import rsc, threading, time
case = rsc.Case({"surface": {"n": 512, "L_lambda_s": 128}, "run": {"realizations": 100000}})
levels = rsc.Contact.from_case(rsc.Asperities.make(rsc.Case()), rsc.Case())
def press():
    while True:
        levels.press(1.0)
for work in (press, lambda: case.run("endless.nc")):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
"""
        ended = subprocess.run(
            [sys.executable, "-c", program], cwd=self.folder, stderr=subprocess.PIPE, timeout=60
        )
        self.assertEqual(ended.returncode, 0, ended.stderr)  # 134: aborted

    def test_fork_during_a_call(self):
        case = rsc.Case(SMALL)
        busy, free = (rsc.Contact.from_case(rsc.Asperities.make(case), case) for _ in range(2))
        stop = threading.Event()

        def work():
            while not stop.is_set():
                busy.press(2.0)
                busy.indent(0.01)

        other = threading.Thread(target=work)
        other.start()
        refused = 0
        for _ in range(10):
            child = os.fork()
            if child == 0:
                signal.alarm(20)  # a child that hangs is killed
                free.press(1.0)
                try:
                    busy.press(1.0)
                except rsc.Error as error:
                    os._exit(1 if "forked" in str(error) else 2)
                os._exit(0)
            status = os.waitpid(child, 0)[1]
            self.assertIn(status, (0, 1 << 8))
            refused += status != 0
        stop.set()
        other.join()
        self.assertGreater(refused, 0)

    def test_holes(self):
        heights = np.ma.masked_greater(np.random.default_rng(1).normal(size=(8, 8)), 0.5)
        with self.assertRaisesRegex(rsc.ArgumentError, "masked"):
            rsc.Surface.take(heights, dx=0.1)
        with self.assertRaisesRegex(rsc.ArgumentError, "heights"):
            rsc.Surface.take(np.ma.getdata(np.ma.filled(heights, 9.969209968386869e36)), dx=0.1)

    def test_step(self):
        case = rsc.Case(SMALL)
        asperities = rsc.Asperities.make(case)
        contacts = [rsc.Contact.from_case(asperities, case) for _ in range(3)]
        tips = np.array([[0.4, 0.5], [0.5, 0.6], [0.45, 0.55]])
        answers = rsc.step_all(
            contacts, forces=[1.0, 2.0, 3.0], tips=tips, stiffness=True, threads=2
        )
        for k, (force, tip) in enumerate(zip([1.0, 2.0, 3.0], tips)):
            alone = rsc.Contact.from_case(asperities, case)
            alone.tip = tip
            self.assertAlmostEqual(answers["separation"][k], alone.press(force), delta=1e-7)
            self.assertAlmostEqual(
                answers["lateral_x"][k], alone.value("lateral_force_x"), delta=1e-5 * force
            )
            self.assertAlmostEqual(answers["stiffness"][k] / alone.stiffness(), 1, delta=1e-4)
        with self.assertRaises(rsc.ArgumentError):
            rsc.step_all(contacts, forces=[1.0, 2.0, 3.0], separations=[0.0, 0.0, 0.0])


if __name__ == "__main__":
    unittest.main()
