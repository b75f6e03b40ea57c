"""Surfaces of heights, and their asperities."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._case import Case
from ._library import _array, _call, _number, _numbers, _Object, _output


class Grid(NamedTuple):
    """The grid of a surface: numbers of points, steps, position of the first point [length]."""

    nx: int
    ny: int
    dx: float
    dy: float
    x0: float
    y0: float
    periodic: bool


class Moments(NamedTuple):
    """Spectral moments of a surface: m0 [length^2], m2 [1], m4 [1/length^2]; the rms slope is
    sqrt(2 m2)."""

    m0: float
    m2: float
    m4: float


class Summits(NamedTuple):
    """Asperities: positions x, y, heights z and radii, arrays of shape (n,) [length]."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    z: NDArray[np.float64]
    radius: NDArray[np.float64]


class Curvatures(NamedTuple):
    """Principal curvatures kappa1 >= kappa2 [1/length] of asperities and the direction of the
    kappa2 axis from x [rad]; arrays of shape (n,)."""

    kappa1: NDArray[np.float64]
    kappa2: NDArray[np.float64]
    angle: NDArray[np.float64]


class Surface(_Object):
    """Heights on a regular grid, created by synthesize or take."""

    __slots__ = ()
    _kind = "surface"

    def _about(self) -> str:
        grid = self.grid()
        return f"{grid.nx} x {grid.ny} points, dx = {grid.dx:.6g}"

    @classmethod
    def synthesize(cls, case: Case | None = None, realization: int = 1) -> Surface:
        """A random surface from the keys of &surface and run%seed, identical to realization number
        `realization` of the program. It is periodic, on x = i L/n, y = j L/n. case: None for the
        defaults. Raises ArgumentError for invalid keys, Error (no memory)."""
        return cls._make("rsc_surface_synthesize", case, realization)

    @classmethod
    def take(
        cls,
        heights: ArrayLike,
        dx: float,
        dy: float | None = None,
        x0: float = 0.0,
        y0: float = 0.0,
        periodic: bool = False,
    ) -> Surface:
        """A surface from an array of heights, which is copied. Separations are measured from z = 0:
        see detrend. heights: float64, shape (ny, nx), C order, finite, 3 points or more each way
        [length]; dx, dy: grid steps > 0, dy = dx by default [length]; x0, y0: position of the first
        point [length]; periodic: True for a periodic surface. Raises ArgumentError with the name of
        the wrong argument, Error (no memory)."""
        z = _array("heights", heights, (None, None))
        ny, nx = z.shape
        return cls._make(
            "rsc_surface_take",
            nx,
            ny,
            dx,
            dx if dy is None else dy,
            x0,
            y0,
            bool(periodic),
            z,
        )

    def detrend(self, how: str = "plane") -> float:
        """Subtracts a form fitted by least squares. how: 'none', 'mean', 'plane', 'quadratic' or
        'sphere'. Returns the remaining rms height [length]. Raises ArgumentError for another word,
        or a sphere that cannot be fitted."""
        return _number("rsc_surface_detrend", self, how)

    def filter(self, cutoff: float) -> None:
        """Gaussian low-pass filter (ISO 16610-61): waves of length cutoff > 0 [length] keep half of
        their amplitude. Raises ArgumentError."""
        _call("rsc_surface_filter", self, cutoff)

    def grid(self) -> Grid:
        """The grid, a Grid. Raises ValueError if closed."""
        g = Grid(*_numbers("rsc_surface_grid", self))
        return g._replace(periodic=bool(g.periodic))

    def heights(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """The heights [length], shape (ny, nx). out: an array of float64 of that shape to fill
        instead of a new one. Raises ArgumentError if it does not fit."""
        grid = self.grid()
        out = (
            np.empty((grid.ny, grid.nx)) if out is None else _output("out", out, (grid.ny, grid.nx))
        )
        _call("rsc_surface_heights", self, out.size, out)
        return out

    def moments(self) -> Moments:
        """Spectral moments by finite differences on the grid, Moments: m0 [length^2], m2 [1], m4
        [1/length^2]. Raises ValueError if closed."""
        return Moments(*_numbers("rsc_surface_moments", self))


class Asperities(_Object):
    """What contacts are made on: summits (positions, heights, radii and possibly curvatures), or
    for solver%model = 'elements' the points of a surface, which have none. Created by find, make or
    take; immutable. len(asperities) is the number of summits."""

    __slots__ = ()
    _kind = "asperities"

    def _about(self) -> str:
        return f"{len(self)} summits"

    @classmethod
    def find(cls, surface: Surface, case: Case | None = None) -> Asperities:
        """A surface for contacts by the solver%model of the case ('auto' as in the program): its
        points, or its summits as asperities%curvature and asperities%law say. surface: a Surface;
        case: None for the defaults and the summits. Raises ArgumentError for a surface without
        summits or one too coarse for the law, Error (no memory)."""
        return cls._make("rsc_asperities_find", surface, case)

    @classmethod
    def make(cls, case: Case | None = None, realization: int = 1) -> Asperities:
        """The surface `realization` of a case for contacts by its solver%model: its points, or its
        summits, found without storing the surface. case: None for the defaults; realization:
        number of the surface. Raises ArgumentError for keys that are refused, Error (no
        memory)."""
        return cls._make("rsc_asperities_make", case, realization)

    @classmethod
    def take(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        radius: ArrayLike,
        kappa1: ArrayLike | None = None,
        kappa2: ArrayLike | None = None,
        angle: ArrayLike | None = None,
        biharmonic: ArrayLike | None = None,
    ) -> Asperities:
        """Asperities from arrays, which are copied. x, y, z, radius: float64, shape (n,), radius >
        0 [length]; kappa1 >= kappa2 > 0: principal curvatures [1/length] and angle: direction of
        the kappa2 axis from x [rad], all three or none; biharmonic: nabla^4 z at the summits
        [1/length^3], if the law needs it. Raises ArgumentError with the name of the wrong array,
        Error (no memory)."""
        first = _array("x", x, (None,))
        rest = {
            "y": y,
            "z": z,
            "radius": radius,
            "kappa1": kappa1,
            "kappa2": kappa2,
            "angle": angle,
            "biharmonic": biharmonic,
        }
        arrays = [
            None if v is None and k not in ("y", "z", "radius") else _array(k, v, (first.size,))
            for k, v in rest.items()
        ]
        return cls._make("rsc_asperities_take", first.size, first, *arrays)

    def __len__(self) -> int:
        return _number("rsc_asperities_count", self)

    def get(self) -> Summits:
        """Positions, heights and radii, Summits: arrays of shape (n,) [length]. Raises ValueError
        if closed."""
        arrays = Summits(*np.empty((4, len(self))))
        _call("rsc_asperities_get", self, len(self), *arrays)
        return arrays

    def curvatures(self) -> Curvatures:
        """Principal curvatures, Curvatures: arrays of shape (n,) [1/length], [rad]. Raises
        ArgumentError for asperities without curvatures."""
        arrays = Curvatures(*np.empty((3, len(self))))
        _call("rsc_asperities_curvatures", self, len(self), *arrays)
        return arrays
