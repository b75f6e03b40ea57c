"""Contacts of an indenter with asperities or elements, alone and many at once."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._case import Case
from ._library import (
    ArgumentError,
    Error,
    NotConverged,
    _array,
    _call,
    _given,
    _number,
    _numbers,
    _Object,
    _refuse,
)
from ._surface import Asperities


class Level(NamedTuple):
    """Solver data of a level."""

    status: int  # its name: rsc.LEVELS[status]
    candidates: int  # asperities that the sphere would penetrate without interaction
    iterations: int
    overlapping_pairs: int  # of contact spots
    residual: float  # relative [1]


class Spots(NamedTuple):
    """Contacts; arrays of shape (n,)."""

    asperity: NDArray[np.int32] | None  # index from 0; None for all asperities
    force: NDArray[np.float64]  # [force]
    radius: NDArray[np.float64]  # contact radius a, the area being pi a^2 [length]
    penetration: NDArray[np.float64]  # [length]


class Answer(NamedTuple):
    """The results of a level: see Contact.answer."""

    separation: float
    force: float
    stiffness: float
    area: float
    energy: float
    lateral_x: float
    lateral_y: float
    status: int
    contacts: int
    overlapping_pairs: int
    large_contacts: int
    beyond_law: int
    edge_contacts: int


class _Result(NamedTuple):
    separation: float
    force: float
    area: float
    contacts: int


class Contact(_Object):
    """A rigid smooth sphere over an elastic half-space that carries asperities (the equivalent
    problem of two bodies), and the last level computed.

    Contact(asperities, E_star, R, x0, y0, case): E_star: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
    [force/length^2]; R: radius, inf for a flat [length]; x0, y0: position of the tip [length];
    case: keys of &solver, asperities%law, indentation%selection, ...; None for the defaults. Raises
    ArgumentError with the name of the wrong argument, Error (no memory). Contact.from_case takes
    E*, R and the tip from a case."""

    __slots__ = ()
    _kind = "contact"

    def _about(self) -> str:
        return "Z0 = {:.6g}, N = {:.6g}, A = {:.6g}, {} contacts".format(*self._result())

    def __init__(
        self,
        asperities: Asperities,
        E_star: float,
        R: float,
        x0: float = 0.0,
        y0: float = 0.0,
        case: Case | None = None,
    ) -> None:
        self._create(
            "rsc_contact_create", _given("asperities", asperities), E_star, R, x0, y0, case
        )

    @classmethod
    def from_case(cls, asperities: Asperities, case: Case | None = None) -> Contact:
        """A contact with E* and R from the keys of &solids and the tip at indentation%centre, by
        default above the middle. asperities: an Asperities; case: a Case, None for the defaults.
        Raises ArgumentError for keys that are refused, Error (no memory)."""
        return cls._make("rsc_contact_create_from_case", _given("asperities", asperities), case)

    def asperities(self) -> Asperities:
        """The asperities to which the indices of spots() refer: those of the constructor or, with
        law = 'elliptic' or 'fourth_order' on a surface, the summits of the difference between
        surface and indenter for the present position of the tip. Raises ArgumentError for a contact
        of elements, ValueError (closed)."""
        return Asperities._make("rsc_contact_asperities", self)

    def indent(self, separation: float, time: float | None = None) -> float:
        """Computes the contact at a separation and returns the force [force]. The result depends on
        the separation and the tip only, unless the case has hardness, adhesion or a body that
        relaxes. separation: Z0, height of the tip above z = 0 [length]; time: of the level, for a
        body that relaxes (solids%relaxation_share): loads change linearly with time from the last
        level; None: the time of the last level [time]. Raises ArgumentError if one is not finite,
        or the time is before the last level; NotConverged (the last iterate can be read), Error."""
        self._at(time)
        return _number("rsc_contact_indent", self, separation)

    def press(self, force: float, time: float | None = None) -> float:
        """Finds the separation at which the sphere carries a force, computes the contact there, and
        returns the separation Z0 [length]. force: N >= 0; 0 gives the separation of first touch
        [force]; time: as for indent. Raises ArgumentError if the force is negative or not finite,
        or no asperity is under the sphere; NotConverged (also if the force jumps over N), Error."""
        self._at(time)
        return _number("rsc_contact_press", self, force)

    def set_time(self, time: float) -> None:
        """Sets the time of the following levels, for a body that relaxes [time]. Raises
        ArgumentError if it is not finite or before the last level."""
        _call("rsc_contact_set_time", self, time)

    def set_distance(self, distance: float) -> None:
        """Sets the distance that has been slid at the following levels, for a body that wears
        (solids%wear_coefficient) [length]. Raises ArgumentError if it is not finite or less than
        that of the last level."""
        _call("rsc_contact_set_distance", self, distance)

    def _at(self, time: float | None) -> None:
        if time is not None:
            self.set_time(time)

    def curve(
        self,
        separations: ArrayLike | None = None,
        forces: ArrayLike | None = None,
        progress: Callable[[int, int], object] | None = None,
    ) -> dict[str, NDArray[Any]]:
        """A level for each of the separations [length], or of the forces [force] (one of the two,
        shape (n,)). Returns a dictionary of arrays of shape (n,), named as in a result file:
        separation [length], force [force], contact_area [length^2], contacts, status. Levels that
        did not converge have status 4 and raise no error here. progress: called as progress(done,
        n) after each level; an exception ends the curve. Raises ArgumentError as indent and press
        do."""
        if (separations is None) == (forces is None):
            _refuse("separations", "either separations or forces are expected")
        what, call, values = (
            ("separations", self.indent, separations)
            if forces is None
            else ("forces", self.press, forces)
        )
        numbers = _array(what, values, (None,))
        n = numbers.size
        levels: dict[str, NDArray[Any]] = {
            "separation": np.empty(n),
            "force": np.empty(n),
            "contact_area": np.empty(n),
            "contacts": np.empty(n, np.int64),
            "status": np.empty(n, np.int32),
        }
        for k, number in enumerate(numbers):
            with contextlib.suppress(NotConverged):
                call(float(number))
            for name, found in zip(levels, (*self._result(), self.level().status)):
                levels[name][k] = found
            if progress is not None:
                progress(k + 1, n)
        return levels

    def _result(self) -> _Result:
        return _Result(*_numbers("rsc_contact_result", self))

    @property
    def separation(self) -> float:
        """Z0 of the last level [length]. Raises Error (no result)."""
        return self._result().separation

    @property
    def force(self) -> float:
        """N of the last level [force]. Raises Error (no result)."""
        return self._result().force

    @property
    def area(self) -> float:
        """True contact area A of the last level [length^2]. Raises Error (no result)."""
        return self._result().area

    @property
    def contacts(self) -> int:
        """Number of asperities in contact at the last level. Raises Error (no result)."""
        return self._result().contacts

    def level(self) -> Level:
        """Solver data of the last level, a Level. Raises Error (no result)."""
        return Level(*_numbers("rsc_contact_level", self))

    def answer(self) -> Answer:
        """The last level in one call, an Answer: separation Z0 [length], force N [force], stiffness
        dN/dZ0 [force/length], area A [length^2], energy W [force length], lateral_x and lateral_y,
        the lateral force on the sphere, -dW/d(x0, y0) [force], status (of LEVELS), and numbers:
        contacts, overlapping_pairs, large_contacts, beyond_law, edge_contacts. Raises Error (no
        result)."""
        return Answer(*_numbers("rsc_contact_answer", self))

    def value(self, name: str) -> float:
        """One quantity of the last level by its name in the result file, as "residual" or
        "large_contacts", or "lateral_force_x", ... Raises ArgumentError for an unknown name, whose
        message lists all, Error (no result)."""
        return _number("rsc_contact_value", self, name)

    def error(self, name: str) -> float:
        """The expected error of a quantity of the last level, by its name as in value(): relative,
        except for "separation" [length]; not exceeded in nine of ten cases. Raises ArgumentError
        for an unknown name, Error (no result), also if no error of it is stated."""
        return _number("rsc_contact_error", self, name)

    def stiffness(self) -> float:
        """dN/dZ0 of the last level, negative, 0 without contact [force/length]. Raises Error (no
        result)."""
        return _number("rsc_contact_stiffness", self)

    def energy(self) -> float:
        """Elastic energy W of the last level, dW/dZ0 = -N [force length]. Raises Error (no
        result)."""
        return _number("rsc_contact_energy", self)

    @property
    def tip(self) -> tuple[float, float]:
        """The position (x0, y0) of the tip [length]. Setting it moves the sphere sideways; results
        remain those of the last level until the next one. Raises ArgumentError if it is not finite,
        or over asperities that are attached, yielded or relax, where laws 'elliptic' and
        'fourth_order' have other summits at each place (an indenter of more than 0.2 of the
        surface's rms slope)."""
        return _numbers("rsc_contact_tip", self)

    @tip.setter
    def tip(self, place: Sequence[float]) -> None:
        place = _array("tip", place, (2,))
        _call("rsc_contact_move_tip", self, float(place[0]), float(place[1]))

    def commit(self) -> None:
        """Stores tip, last level and loading history (solids%hardness, solids%adhesion) for
        rollback(). Raises Error (no memory)."""
        _call("rsc_contact_commit", self)

    def rollback(self) -> None:
        """Restores the state of the last commit(), or that of the new contact. Raises Error."""
        _call("rsc_contact_rollback", self)

    def first_touch(self) -> float:
        """The separation of first contact in loading [length]. Raises ArgumentError if no asperity
        is under the sphere."""
        return _number("rsc_contact_first_touch", self)

    def spots(self) -> Spots:
        """The contacts of the last level by increasing index of asperity, Spots: arrays of shape
        (contacts,). Raises Error (no result)."""
        n = self.contacts
        spots = Spots(np.empty(n, np.int32), *np.empty((3, n)))
        _call("rsc_contact_spots", self, n, *spots)
        return spots

    def per_asperity(self) -> Spots:
        """Results of every asperity, Spots without `asperity`: arrays of shape (len(asperities),),
        0 where there is no contact. Raises Error (no result)."""
        n = len(self.asperities())
        spots = Spots(None, *np.empty((3, n)))
        _call("rsc_contact_per_asperity", self, n, *spots[1:])
        return spots

    def save(self, path: str | os.PathLike[str]) -> None:
        """Saves tip, options, last level, path and committed state in a file, from which restore()
        continues as this contact does. path: of the file; an existing file is replaced only if it
        is a save. Raises Error (file)."""
        _call("rsc_contact_save", self, os.fspath(path))

    @classmethod
    def restore(cls, asperities: Asperities, path: str | os.PathLike[str]) -> Contact:
        """Reads a contact from a file of save(). asperities: those it was saved with; path: of the
        file. Raises ArgumentError for other asperities or another file, Error."""
        return cls._make("rsc_contact_restore", _given("asperities", asperities), os.fspath(path))

    def deflection(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64] | float:
        """The deflection of the surface by the contact forces [length], positive down. x, y:
        positions [length], numbers or arrays of float64, which are broadcast against each other:
        deflection(x[None, :], y[:, None]) is a map. Returns an array of their common shape, a
        number for numbers. Raises ArgumentError if they are not finite or cannot be broadcast,
        Error (no result)."""
        places = [_array("x", x), _array("y", y)]
        try:
            places = list(np.broadcast_arrays(*places))
        except ValueError:
            shapes = [place.shape for place in places]
            _refuse(
                "y", f"the shape {shapes[1]} cannot be broadcast against that of x, {shapes[0]}"
            )
        deflection = np.empty(places[0].shape)
        places = [np.ascontiguousarray(place) for place in places]
        _call("rsc_contact_deflection", self, deflection.size, *places, deflection)
        return deflection if deflection.ndim else float(deflection)


def press_all(
    contacts: Sequence[Contact], forces: ArrayLike, threads: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Contact.press for many contacts, distributed among threads. contacts: different Contacts;
    forces: N >= 0 of each, shape (n,) [force]; threads: their number, 0 for all of the machine
    (results do not depend on it). Returns (separations, statuses), arrays of shape (n,): Z0 of each
    [length], NaN after a failure, and SUCCESS, NOT_CONVERGED or another status of rsc.h for each.
    Raises ArgumentError for a contact given twice, a force that is negative or not finite, or a
    contact without asperities under its sphere."""
    return _all("rsc_contacts_press", contacts, "forces", forces, threads)


def indent_all(
    contacts: Sequence[Contact], separations: ArrayLike, threads: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Contact.indent for many contacts, as press_all. contacts: different Contacts; separations: Z0
    of each, shape (n,) [length]; threads: their number, 0 for all. Returns (forces, statuses): N of
    each [force]. Raises ArgumentError as press_all does."""
    return _all("rsc_contacts_indent", contacts, "separations", separations, threads)


def step_all(
    contacts: Sequence[Contact],
    forces: ArrayLike | None = None,
    separations: ArrayLike | None = None,
    tips: ArrayLike | None = None,
    stiffness: bool = False,
    threads: int = 0,
) -> dict[str, NDArray[Any]]:
    """A step of many contacts: each tip moved to tips, then pressed with forces or indented to
    separations, one of the two. contacts: different Contacts; forces, separations: shape (n,);
    tips: shape (n, 2), None to leave them [length]; stiffness: True to compute it; threads: their
    number, 0 for all. Returns a dictionary of arrays of shape (n,): separation, force, stiffness if
    requested, lateral_x, lateral_y, moment_x, moment_y, NaN if there is no result, level_status,
    and status, as press_all's. Raises ArgumentError."""
    objects = _different(contacts)
    if (forces is None) == (separations is None):
        _refuse("forces, separations", "one of the two is expected")
    n = len(objects)
    values = _array(
        "separations" if forces is None else "forces",
        separations if forces is None else forces,
        (n,),
    )
    x = y = None
    if tips is not None:
        x, y = np.ascontiguousarray(_array("tips", tips, (n, 2)).T)
    order = ["separation", "force", "stiffness", "lateral_x", "lateral_y", "moment_x", "moment_y"]
    answers: dict[str, NDArray[Any]] = {
        name: np.full(n, np.nan) for name in order if stiffness or name != "stiffness"
    }
    answers.update(level_status=np.zeros(n, np.int32), status=np.zeros(n, np.int32))
    with _of_one(answers["status"]):
        _call(
            "rsc_contacts_step",
            n,
            objects,
            x,
            y,
            int(forces is not None),
            values,
            *[answers.get(name) for name in order],
            *list(answers.values())[-2:],
            threads,
        )
    return answers


def _all(function: str, contacts: Any, name: str, values: Any, threads: int) -> Any:
    contacts = _different(contacts)
    values = _array(name, values, (len(contacts),))
    answers, statuses = np.full(len(contacts), np.nan), np.zeros(len(contacts), np.int32)
    with _of_one(statuses, ArgumentError):
        _call(function, len(contacts), contacts, values, answers, statuses, threads)
    return answers, statuses


def _different(contacts: Any) -> list[Contact]:
    contacts = list(contacts)
    if len({id(contact) for contact in contacts}) < len(contacts):
        _refuse("contacts", "different contacts are expected: one is given twice")
    return contacts


@contextlib.contextmanager
def _of_one(statuses: NDArray[np.int32], *raised: type[Error]) -> Iterator[None]:
    """Suppresses the error of one contact, which its status states, unless it is of the kinds
    `raised`."""
    try:
        yield
    except Error as error:
        if isinstance(error, raised) or not statuses.any():
            raise
