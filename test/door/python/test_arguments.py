"""Bad input from Python: each of these is refused with a message that names the argument, and
nothing crashes."""
import copy
import math
import pickle
import unittest

import numpy as np

import rsc

NAN, GRID = math.nan, np.zeros((4, 5))
GRID[1:3, 2] = 0.1
ONES = np.ones(3)
LINE = np.arange(3.0)


def take(**changes):
    return rsc.Asperities.take(**{"x": LINE, "y": ONES, "z": ONES, "radius": ONES, **changes})


def asperities():
    return take()


def indented():
    contact = rsc.Contact(asperities(), 1.0, 1.0, 1.0, 1.0)
    contact.indent(0.5)
    return contact


def fortran(array):
    return np.asfortranarray(array)


MASKED = np.ma.masked_array(np.arange(6.0), [0, 0, 1, 0, 0, 0])
FORCES = np.ma.masked_array([1.0, 9.0, 2.0, 9.0], [0, 0, 1, 0])[::2]


def closed(thing):
    thing.close()
    return thing


# (what is done, the word the message must have)
CASES = [
    (lambda: take(x=LINE.astype(np.float32)), "x.*float32"),
    (lambda: take(y=np.arange(3)), "y.*int64"),
    (lambda: take(z=np.ones(3, complex)), "z.*complex"),
    (lambda: take(radius=np.ones(4)), "radius.*shape"),
    (lambda: take(x=np.ones((3, 1))), "x.*shape"),
    (lambda: take(x="abc"), "x"),
    (lambda: take(x=None), "x"),
    (lambda: take(y=None), "y"),
    (lambda: take(z=[1.0, NAN, 1.0]), "z.*finite"),
    (lambda: take(x=[], y=[], z=[], radius=[]), "n"),
    (lambda: take(x=[[1.0], [1.0, 2.0]]), "x"),
    (lambda: take(z=LINE.astype(">f8")), "z.*>f8"),
    (lambda: rsc.Surface.take(fortran(GRID), 1.0), "heights.*order"),
    (lambda: rsc.Surface.take(GRID[:, ::2], 1.0), "heights.*order"),
    (lambda: rsc.Surface.take(GRID.astype("f4"), 1.0), "heights.*float32"),
    (lambda: rsc.Surface.take(GRID.ravel(), 1.0), "heights.*shape"),
    (lambda: rsc.Surface.take(GRID, "1"), "dx"),
    (lambda: rsc.Surface.take(GRID[:2], 1.0), "ny"),
    (lambda: rsc.Surface.take(GRID, 1.0).heights(np.empty((5, 4))), "out.*shape"),
    (lambda: rsc.Surface.take(GRID, 1.0).heights(np.empty((4, 5), "f4")), "out.*float32"),
    (lambda: rsc.Surface.take(GRID, 1.0).heights(fortran(GRID)), "out.*order"),
    (lambda: rsc.Surface.take(GRID, 1.0).heights([1.0]), "out"),
    (lambda: rsc.Surface.take(GRID, 1.0).heights(np.broadcast_to(1.0, (4, 5))), "out"),
    (lambda: rsc.Surface.take(GRID, 1.0).detrend(None), "how"),
    (
        lambda: rsc.Surface.take(np.zeros((4, 4)), 1.0)
        and rsc.Asperities.find(rsc.Surface.take(np.zeros((4, 4)), 1.0)),
        "summit",
    ),
    (lambda: rsc.Asperities.find(None), "surface"),
    (lambda: rsc.Asperities.find(asperities()), "surface.*Asperities"),
    (lambda: rsc.Asperities.make(3), "a_case.*int"),
    (lambda: rsc.Asperities.make(None, 1.5), "realization"),
    (lambda: rsc.Asperities.make(None, 2**63), "realization"),
    (lambda: rsc.Contact(None, 1.0, 1.0), "asperities"),
    (lambda: rsc.Contact(asperities(), 1.0, 1.0, 0, 0, "x"), "a_case"),
    (lambda: rsc.Contact(closed(asperities()), 1.0, 1.0), "asperities.*closed|closed"),
    (lambda: rsc.Contact(asperities(), 1.0, 1.0, case=closed(rsc.Case())), "a_case.*closed"),
    (lambda: indented().indent(None), "separation"),
    (lambda: indented().indent([1.0, 2.0]), "separation"),
    (lambda: indented().press("1"), "force"),
    (lambda: indented().curve(np.ones((2, 2))), "separations"),
    (lambda: indented().curve(forces=["a"]), "forces"),
    (lambda: indented().deflection(LINE, ONES[:2]), "y.*shape"),
    (lambda: setattr(indented(), "tip", 1.0), "tip"),
    (lambda: rsc.Case({"surface": 3}), "surface"),
    (lambda: rsc.Case(3), "source"),
    (lambda: rsc.Case({"surface%sigma": "abc"}), "sigma"),
    (lambda: rsc.Case({"surface%sigma": NAN}), "sigma"),
    (lambda: rsc.Case({"surface%sigma": object()}), "sigma"),
    (lambda: rsc.Case({"surface%n": 2.5}), "n"),
    (lambda: rsc.Case({3: 1}), "name"),
    (lambda: rsc.Case({"surface%file": "a\0b"}), "null"),
    (lambda: rsc.Case()[3], "name"),
    (lambda: rsc.Case().read(None), "text"),
    (lambda: rsc.Case("&study surface%sigma = 1.0, 2.0 /"), "study"),
    (lambda: rsc.study(rsc.Case(), {}, None, mode="sum"), "mode"),
    (
        lambda: rsc.study(rsc.Case(), {"surface%n": [64, 128], "run%seed": [1]}, None, mode="zip"),
        "over",
    ),
    (lambda: rsc.press_all([indented()] * 2, [1.0, 2.0]), "twice"),
    (lambda: rsc.indent_all([indented()], [1.0, 2.0]), "separations.*shape"),
    (lambda: rsc.press_all([indented()], ["a"]), "forces"),
    (lambda: rsc.press_all([indented()], [1.0], -1), "threads"),
    (lambda: rsc.press_all([None], [1.0]), "contacts.*None"),
    (lambda: rsc.press_all([closed(indented())], [1.0]), "closed"),
    (lambda: indented().curve(), "separations"),
    (lambda: indented().curve([1.0], [1.0]), "separations"),
    (lambda: rsc.Friction(None, 1.0, 1.0), "contact"),
    (lambda: rsc.Friction.from_case(None), "contact"),
    (lambda: rsc.stiffness_ratio([1.0], [0.2, 0.3]), "E.*shape"),
    (lambda: rsc.Contact.restore(None, "x"), "asperities"),
    (lambda: rsc.Friction.restore(None, "x"), "asperities"),
    (lambda: rsc.read("no/such/file.nc", xarray=False), "no/such/file.nc"),
    (lambda: rsc.Case().update(3), "source"),
    (lambda: take(kappa1=[1.0, 2.0]), "kappa1.*shape"),
    # Masked values: of arrays with and without a stride, in lists, of numbers.
    (lambda: take(x=MASKED[::2]), "x.*masked"),
    (lambda: take(biharmonic=MASKED[:3]), "biharmonic.*masked"),
    (lambda: take(z=[1.0, np.ma.masked, 1.0]), "z.*masked"),
    (lambda: rsc.Surface.take(np.ma.masked_equal(GRID, 0.1), 1.0), "heights.*masked"),
    (lambda: indented().deflection(MASKED, 0.5), "x.*masked"),
    (lambda: indented().indent(MASKED[2]), "separation.*masked"),
    (lambda: indented().curve(MASKED[::2]), "separations.*masked"),
    (lambda: setattr(indented(), "tip", MASKED[1:3]), "tip.*masked"),
    (lambda: rsc.press_all([indented(), indented()], FORCES), "forces.*masked"),
    (lambda: rsc.step_all([indented()] * 1, FORCES[1:]), "forces.*masked"),
    (lambda: rsc.stiffness_ratio(FORCES, [0.2, 0.3]), "E.*masked"),
    (lambda: rsc.Case({"solids%E": FORCES}), "E.*masked"),
]


class Arguments(unittest.TestCase):
    def test_refused(self):
        for k, (action, word) in enumerate(CASES):
            with self.subTest(number=k, word=word):
                with self.assertRaisesRegex((ValueError, rsc.Error), word):
                    action()

    def test_state(self):
        with self.assertRaises(rsc.Error) as caught:
            rsc.Contact(asperities(), 1.0, 1.0).force
        self.assertEqual(caught.exception.status, rsc.NO_RESULT)
        for kind in (rsc.Surface, rsc.Asperities):
            with self.assertRaisesRegex(
                TypeError, f"^rsc.{kind.__name__}: use one of its class methods$"
            ):
                kind()
        with self.assertRaisesRegex(
            TypeError,
            "^rsc.Case cannot be pickled, because it belongs to this process; "
            "pickle the text of its case or its arrays$",
        ):
            pickle.dumps(rsc.Case())
        self.assertIsNot(copy.copy(indented()), copy.deepcopy(indented()))
        self.assertEqual(copy.deepcopy(rsc.Case({"surface%n": 64}))["surface%n"], 64)


if __name__ == "__main__":
    unittest.main()
