"""Contacts with friction."""

from __future__ import annotations

import contextlib
import ctypes
import os
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._case import Case
from ._contact import Contact
from ._library import ArgumentError, _array, _call, _given, _number, _numbers, _Object
from ._surface import Asperities


class FrictionState(NamedTuple):
    """State of the path of a Friction."""

    separation: float  # Z0 [length]
    x: float  # tangential displacement [length]
    y: float
    force: float  # N [force]
    force_x: float  # tangential force Q [force]
    force_y: float
    energy: float  # elastic, of the normal problem [force length]
    tangential_energy: float  # elastic, of (x, y) [force length]
    lost: float  # work lost to friction since the start of the path [force length]
    stick_separation: float  # where the contact area would equal the stick area [length]


class SpotSlip(NamedTuple):
    """Friction at the contact spots; arrays of shape (n,)."""

    asperity: NDArray[np.int32]  # index from 0
    radius: NDArray[np.float64]  # contact radius [length]
    stick_radius: NDArray[np.float64]  # of the part that sticks [length]
    force_x: NDArray[np.float64]  # share of the tangential force [force]
    force_y: NDArray[np.float64]


class Friction(_Object):
    """A contact with friction along any path of separations and tangential displacements (x, y).
    For the assumptions see rsc.h, section friction.

    Friction(contact, mu, ratio): contact: a Contact, for its asperities, sphere, tip and options;
    mu: coefficient of friction >= 0; ratio: m = 4 G*/E*, see stiffness_ratio. Raises ArgumentError
    with the name of the wrong argument, Error (no memory). Friction.from_case takes mu and m from a
    case. copy() also copies the path."""

    __slots__ = ()
    _kind = "friction"

    def _about(self) -> str:
        return ", ".join(f"{k} = {v:.6g}" for k, v in self.state()._asdict().items())

    def __init__(self, contact: Contact, mu: float, ratio: float) -> None:
        self._create("rsc_friction_create", _given("contact", contact), mu, ratio)

    @classmethod
    def from_case(cls, contact: Contact, case: Case | None = None) -> Friction:
        """Friction with mu from solids%friction and m from solids%E and solids%nu. contact: a
        Contact; case: a Case, None for the defaults. Raises ArgumentError for keys that are
        refused, Error (no memory)."""
        return cls._make("rsc_friction_create_from_case", _given("contact", contact), case)

    def update(
        self, separation: float, x: float = 0.0, y: float = 0.0
    ) -> tuple[float, float, float, float]:
        """Moves the contact on a straight path to (separation, x, y) and returns (N, Q_x, Q_y, work
        lost in this step). The first call defines the start of the path. separation: Z0; x, y:
        tangential displacement, of which only differences matter [length]. Q is initially in its
        direction; the force on the sphere is -Q. Raises ArgumentError if a number is not finite,
        NotConverged (the state is that of the last iterate), Error."""
        return _numbers("rsc_friction_update", self, separation, x, y)

    def state(self) -> FrictionState:
        """State of the path, a FrictionState. Raises Error (no result) before the first update."""
        return FrictionState(*_numbers("rsc_friction_state", self))

    def move_tip(self, x0: float, y0: float) -> None:
        """Moves the tip sideways at the separation of the last update. Use it when the sphere
        rolls onto other asperities: those in contact at both positions keep their share of the
        tangential force, the rest is lost (rsc.h). x0, y0: the new position [length]. Raises
        ArgumentError, NotConverged, Error."""
        _call("rsc_friction_move_tip", self, x0, y0)

    def stiffness(self) -> NDArray[np.float64]:
        """Tangential stiffness dQ/d(x, y) for further sliding in the present direction of slip, an
        array of shape (2, 2) [force/length]. Raises NotConverged, Error."""
        return np.array(_numbers("rsc_friction_stiffness", self)).reshape(2, 2)

    def commit(self) -> None:
        """Stores the state for rollback(). Raises Error (no memory)."""
        _call("rsc_friction_commit", self)

    def rollback(self) -> None:
        """Restores the state of the last commit. Raises Error (no memory)."""
        _call("rsc_friction_rollback", self)

    def first_loading(self, slide: ArrayLike) -> NDArray[np.float64]:
        """Tangential force Q of a contact pressed to the last separation without sliding and then
        slid [force], in the shape of slide; the path is not changed. slide: tangential
        displacements >= 0, float64, shape (n,) [length]. Raises ArgumentError if one is negative or
        not finite, NotConverged, Error (no result without contact)."""
        slides = _array("slide", slide, (None,))
        force = np.empty(slides.shape)
        _call("rsc_friction_first_loading", self, slides.size, slides, force, None)
        return force

    def slide(self, force: float) -> float:
        """The tangential displacement in first loading at which the tangential force is Q [length].
        force: 0 <= Q <= mu N [force]. Raises ArgumentError out of range, NotConverged, Error (no
        result without contact)."""
        return _number("rsc_friction_slide", self, force)

    def full_slip(self) -> tuple[float, float]:
        """The tangential displacement at the onset of full slip in first loading [length] and the
        force mu N [force]. Raises Error (no result without contact)."""
        return _numbers("rsc_friction_full_slip", self)

    def spots(self) -> SpotSlip:
        """Friction at the spots of the last update by increasing index of asperity, SpotSlip.
        Raises NotConverged, Error (no result)."""
        count = ctypes.c_int64()
        with contextlib.suppress(ArgumentError):  # only for the number
            _call("rsc_friction_spots", self, 0, count, None, None, None, None, None)
        n = count.value
        spots = SpotSlip(np.empty(n, np.int32), *np.empty((4, n)))
        _call("rsc_friction_spots", self, n, count, *spots)
        return spots

    def save(self, path: str | os.PathLike[str]) -> None:
        """Saves the path and the committed state in a file, from which restore() continues bit for
        bit. path: of the file. Raises Error (file)."""
        _call("rsc_friction_save", self, os.fspath(path))

    @classmethod
    def restore(cls, asperities: Asperities, path: str | os.PathLike[str]) -> Friction:
        """Reads friction from a file of save(). asperities: those it was saved with; path: of the
        file. Raises ArgumentError for other asperities or another file, Error."""
        return cls._make("rsc_friction_restore", _given("asperities", asperities), os.fspath(path))


def stiffness_ratio(E: ArrayLike, nu: ArrayLike) -> float:
    """m = 4 G*/E* of two bodies, the ratio of tangential to normal stiffness of any of their
    contacts. E: two Young's moduli, inf: rigid [force/length^2]; nu: two Poisson's ratios. Raises
    ArgumentError with the name of the wrong argument."""
    return _number("rsc_stiffness_ratio", _array("E", E, (2,)), _array("nu", nu, (2,)))
