"""What the Python package has beyond the calls of the C interface (door/calls): arrays, curves,
lifetimes, threads, studies, result files, documentation."""
import gc
import math
import os
import threading
import time
import unittest

import numpy as np

import rsc
from result_files import InFolder

E, U = 2.0e5, 1.0e-3
SMALL = {
    "surface": {"n": 128, "L_lambda_l": 4.0, "L_lambda_s": 32.0, "sigma": 0.01},
    "solver": {"method": "direct"},
    "asperities": {"law": "hertz"},
}


def one_asperity(case=None):
    return rsc.Contact(rsc.Asperities.take([0.0], [0.0], [0.0], [0.3]), E, 5.0, case=case)


class Values(unittest.TestCase):
    def test_arrays(self):
        """Places, order and kind of every array: heights [y, x], asperities, spots, sums."""
        case = rsc.Case(SMALL)
        surface = rsc.Surface.synthesize(case, 2)
        z = surface.heights()
        grid = surface.grid()
        self.assertEqual(
            (z.shape, z.dtype, grid.nx, grid.periodic), ((128, 128), np.float64, 128, True)
        )
        self.assertAlmostEqual(math.sqrt(surface.moments().m0) / 0.01, 1, delta=1e-10)
        asperities = rsc.Asperities.find(surface, case)
        x, y, height, radius = asperities.get()
        j, i = np.rint(y / grid.dy).astype(int), np.rint(x / grid.dx).astype(int)
        self.assertTrue(np.array_equal(height, z[j, i]))  # not z[i, j]
        self.assertTrue(
            np.array_equal(np.stack(asperities.get()), np.stack(rsc.Asperities.make(case, 2).get()))
        )
        again = rsc.Surface.take(z, grid.dx, periodic=True)
        out = np.empty_like(z)
        self.assertIs(again.heights(out), out)
        self.assertTrue(np.array_equal(out, z))
        tilted = rsc.Surface.take(np.add.outer(np.arange(4.0), 10 * np.arange(5.0)), 1.0)
        self.assertAlmostEqual(tilted.detrend(), 0, delta=1e-12)  # a plane, unless told otherwise
        self.assertIs(tilted.grid().periodic, False)
        xyzr = np.column_stack(asperities.get())  # columns are 1-D slices with a stride
        self.assertTrue(np.array_equal(np.stack(rsc.Asperities.take(*xyzr.T).get()), xyzr.T))

    def test_defaults_and_representations(self):
        """None is the default; every object says what it is, and has no attribute by mistake."""
        case = rsc.Case(SMALL)
        self.assertIn("surface%n = 128", repr(case))
        for key in rsc.keys():
            case[key] = None
        self.assertEqual(case.text(), rsc.Case().text())
        self.assertIn("defaults", repr(case))
        contact = one_asperity()
        self.assertIn("rsc.Contact", repr(contact))
        contact.indent(-U)
        self.assertIn(f"N = {contact.force:.6g}", repr(contact))
        self.assertIn("1 summits", repr(contact.asperities()))
        with self.assertRaises(AttributeError):
            contact.tpi = (0.0, 1.0)
        contact.close()
        self.assertIn("closed", repr(contact))
        self.assertIn("no result", repr(one_asperity()))
        self.assertEqual(rsc.__version__, rsc.version())

    def test_cases(self):
        case = rsc.Case(
            {
                "surface": {"sigma": 0.02, "n": 4096, "plateau": True},
                "solver%method": "direct",
                "solids": {"E": [1 / 3, math.inf]},
            }
        )
        self.assertEqual(
            [
                case[k]
                for k in (
                    "surface%sigma",
                    "surface%n",
                    "surface%plateau",
                    "solver%method",
                    "solids%E",
                    "solids%E(2)",
                )
            ],
            [0.02, 4096, True, "direct", (1 / 3, math.inf), math.inf],
        )
        self.assertIsNone(case["indentation%levels"])
        self.assertEqual(rsc.Case(str(case)), case)
        case["run%title"] = "it's"
        self.assertEqual(case["run%title"], "it's")
        other = rsc.Case(case)
        other["surface%sigma"] = np.float64(0.03)
        other["surface%n"] = np.int32(2048)
        self.assertEqual((case["surface%sigma"], other["surface%n"]), (0.02, 2048))
        self.assertNotEqual(case, other)
        with self.assertRaisesRegex(rsc.ArgumentError, "simga.*sigma"):
            other.update({"surface%sigma": 0.5, "surface%simga": 1})
        self.assertEqual(other["surface%sigma"], 0.03)  # all or nothing
        self.assertIn("surface%sigma", rsc.keys())
        for name in rsc.keys():  # every default comes back as a value that is accepted
            if rsc.Case()[name] is not None:
                other[name] = rsc.Case()[name]

    def test_curve(self):
        calls = []
        contact = one_asperity()
        z = np.linspace(0.001, -0.001, 5)
        curve = contact.curve(z, progress=lambda done, n: calls.append((done, n)))
        self.assertTrue(np.array_equal(curve["separation"], z))
        self.assertTrue(
            np.allclose(
                curve["force"], 4 / 3 * E * math.sqrt(0.3) * np.maximum(-z, 0) ** 1.5, rtol=1e-12
            )
        )
        self.assertEqual(curve["contacts"].tolist(), [0, 0, 0, 1, 1])
        self.assertEqual(calls, [(k, 5) for k in range(1, 6)])
        pressed = contact.curve(forces=curve["force"][3:])
        self.assertTrue(
            np.allclose(pressed["separation"], z[3:], rtol=1e-5)
        )  # solver%tolerance is 1e-6 of the force

        def enough(done, n):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            contact.curve(z, progress=enough)
        with self.assertRaisesRegex(ValueError, "separations"):
            contact.curve()

    def test_deflection_is_broadcast(self):
        """Rows and columns make the map that their full grids make."""
        contact = one_asperity()
        contact.indent(-U)
        x, y = np.linspace(-0.1, 0.1, 5), np.linspace(-0.2, 0.2, 3)
        whole = contact.deflection(*(np.ascontiguousarray(a) for a in np.meshgrid(x, y)))
        self.assertTrue(np.array_equal(contact.deflection(x[None, :], y[:, None]), whole))
        self.assertTrue(np.array_equal(contact.deflection(x, 0.2), whole[2]))
        self.assertEqual(contact.deflection(0.0, 0.0), whole[1, 2])
        with self.assertRaisesRegex(ValueError, "y: "):
            contact.deflection(x, y)


class Lifetimes(unittest.TestCase):
    def test_close(self):
        case = rsc.Case()
        with rsc.Asperities.take([0.0], [0.0], [0.0], [1.0]) as asperities:
            contact = rsc.Contact.from_case(asperities, case)
        self.assertTrue(asperities.closed and not contact.closed)
        contact.indent(0.0)  # outlives its asperities
        contact.close()
        contact.close()
        for use in (
            lambda: contact.indent(0.0),
            lambda: contact.force,
            contact.copy,
            contact.spots,
            lambda: len(asperities),
            lambda: rsc.Contact.from_case(asperities),
            lambda: contact.curve([0.0]),
        ):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()

    def test_garbage(self):
        """What nobody holds is given back: the number of live handles, not the machine's memory,
        which other tests share."""
        before = sum(isinstance(o, rsc.Asperities) for o in gc.get_objects())
        for _ in range(50):
            rsc.Contact.from_case(rsc.Asperities.take([0.0], [0.0], [0.0], [1.0])).indent(-0.1)
        self.assertEqual(sum(isinstance(o, rsc.Asperities) for o in gc.get_objects()), before)


class Threads(unittest.TestCase):
    def test_readers_and_writers(self):
        """On one object, calls that read are in the library together, and one that changes it
        is there alone."""
        contact, library = one_asperity(), rsc._library.shared_object
        contact.indent(-U)
        meeting = threading.Barrier(2, timeout=30)
        inside, alone = [0], []

        class Watched:
            def __getattr__(self, name):
                function = getattr(library, name)

                def watched(*arguments):
                    if name == "rsc_contact_result":
                        meeting.wait()  # for another reader
                    inside[0] += 1
                    time.sleep(0.002)  # long enough for others to come in if they may
                    if name == "rsc_contact_indent":
                        alone.append(inside[0] == 1)
                    inside[0] -= 1
                    return function(*arguments)

                return watched

        wrong = []

        def guarded(work, count):
            try:
                for _ in range(count):
                    work()
            except Exception as error:
                wrong.append(error)

        rsc._library.shared_object = Watched()
        try:
            threads = [
                threading.Thread(target=guarded, args=(work, 5))
                for work in (
                    contact.level,
                    lambda: contact.force,
                    lambda: contact.force,
                    lambda: contact.indent(-U),
                    lambda: contact.indent(-U),
                )
            ]
            for t in threads[1:3]:
                t.start()
            for t in threads[1:3]:
                t.join()
            for t in threads[:1] + threads[3:]:
                t.start()
            for t in threads[:1] + threads[3:]:
                t.join()
        finally:
            rsc._library.shared_object = library
        self.assertEqual(wrong, [])
        self.assertEqual(alone, [True] * 10)


class Files(InFolder):
    def setUp(self):
        super().setUp()
        self.case = rsc.Case(SMALL)
        self.case.update(
            {
                "indentation": {"start": 3.0, "stop": 1.0, "steps": 5},
                "output%file": self.path("a.nc"),
            }
        )

    def test_run_and_read(self):
        path = self.case.run()
        self.assertEqual(path, self.case["output%file"])
        plain = rsc.read(path, xarray=False)
        self.assertEqual((plain["force"].shape, plain["map_pressure"].ndim), ((1, 5), 3))
        self.assertTrue(np.isnan(plain["force_std"]).all())  # one realization has none
        self.assertEqual(rsc.Case(plain[""]["case"])["surface%sigma"], 0.01)
        contact = rsc.Contact.from_case(rsc.Asperities.make(self.case), self.case)
        curve = contact.curve(plain["separation"])
        for name in ("force", "contact_area", "contacts", "status"):
            self.assertTrue(np.array_equal(curve[name], plain[name][0]), name)
        other = self.case.run(file=self.path("b.nc"))
        self.assertTrue(os.path.exists(other))
        self.assertEqual(other, self.path("b.nc"))
        self.assertEqual(self.case["output%file"], path)  # as it was
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.assertIsInstance(rsc.read(path), dict)
            return
        data = rsc.read(path)
        self.assertEqual(data["force"].dims, ("realization", "step"))
        self.assertEqual(data["force"].attrs["units"], "N")
        self.assertTrue(np.array_equal(data["force"].values, plain["force"]))
        self.assertIn("separation", data.coords)
        self.assertIn("case", data.attrs)

    def test_resumed(self):
        """A campaign that is stopped and resumed, or extended, has the forces of one run."""
        self.case.update({"run": {"realizations": 60, "threads": 1}, "surface%n": 1024})
        whole = rsc.read(self.case.run(self.path("whole.nc")), xarray=False)

        def stop(done, total):
            if done >= 1:
                raise InterruptedError

        with self.assertRaises(InterruptedError):
            self.case.run(self.path("part.nc"), stop)
        self.assertTrue(os.path.exists(self.path("part.nc.checkpoint")))
        part = rsc.read(self.case.run(self.path("part.nc"), resume=True), xarray=False)
        self.assertTrue(np.array_equal(part["force"], whole["force"]))
        case = rsc.Case(self.path_of_case())
        case["run%realizations"] = 62
        more = rsc.read(case.run(self.path("whole.nc"), resume=True), xarray=False)
        self.assertEqual(more["force"].shape[0], 62)
        self.assertTrue(np.array_equal(more["force"][:60], whole["force"]))

    def path_of_case(self):
        with open(self.path("case.nml"), "w") as file:
            file.write(str(self.case))
        return self.path("case.nml")

    def test_failures(self):
        with self.assertRaises(rsc.Error) as unread:
            rsc.read(self.path("nothing.nc"))
        self.assertEqual(unread.exception.status, rsc.FILE)
        with self.assertRaisesRegex(rsc.Error, "folder"):
            self.case.run(file=os.path.join(self.folder, "folder", "a.nc"))
        self.case.update({"solver%tolerance": 1e-14, "solver%max_iterations": 1})
        with self.assertRaises(rsc.NotConverged) as caught:
            self.case.run()
        self.assertGreater(caught.exception.failed_levels, 0)

    def test_study(self):
        calls = []

        def force(case):
            return rsc.Contact.from_case(rsc.Asperities.make(case), case).indent(0.01)

        over = {"surface%sigma": [0.005, 0.01], "solids%R(2)": [1.0, 2.0, 4.0]}
        members = rsc.study(
            self.case, over, force, progress=lambda done, n, values: calls.append((done, n, values))
        )
        self.assertEqual(
            [tuple(v.values()) for v, _ in members],
            [(s, r) for s in over["surface%sigma"] for r in over["solids%R(2)"]],
        )
        self.assertEqual(calls, [(k + 1, 6, members[k][0]) for k in range(6)])
        self.assertEqual(rsc.study(self.case, over, force, threads=2), members)
        self.assertEqual(members[3][1], force(rsc.Case({**SMALL, "solids%R(2)": 1.0})))
        pairs = rsc.study(
            self.case,
            {"surface%sigma": [0.005, 0.01], "surface%hurst": [0.5, 0.8]},
            force,
            mode="zip",
        )
        self.assertEqual(len(pairs), 2)
        self.assertEqual(self.case["surface%sigma"], 0.01)
        with self.assertRaisesRegex(ValueError, "hurst"):
            rsc.study(self.case, {"surface%hurst": [0.5, 2.5]}, self.fail)

        def broken(case):
            raise RuntimeError("mine")

        for threads in (1, 2):
            with self.assertRaisesRegex(RuntimeError, "mine"):
                rsc.study(self.case, over, broken, threads=threads)


if __name__ == "__main__":
    unittest.main()
