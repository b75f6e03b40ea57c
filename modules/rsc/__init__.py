"""rsc for Python: the elastic contact of rough surfaces. It provides all functions of rsc.h, which
has details of every argument.

    import rsc
    case = rsc.Case({"surface": {"sigma": 0.01, "n": 1024, "L_lambda_s": 256}})
    asperities = rsc.Asperities.make(case)
    contact = rsc.Contact.from_case(asperities, case)
    force = contact.indent(separation=0.02)
    print(force, contact.area, contact.stiffness())

Needs numpy and librsc, nothing else; nothing is compiled. librsc is searched for in the environment
variable RSC_LIBRARY (its full path), then beside the installation of this file (or in build/ of a
clone), then in the library path of the system.

Any consistent units may be used: [length], [force], moduli in [force/length^2]. Arrays are numpy
arrays of float64; two-dimensional ones are [y, x], x running fastest. A list or tuple of numbers is
converted; a numpy array of another dtype, shape or order is refused, to avoid hidden copies (data
stored by the library are copied once). Indices count from 0.

Errors: Error with the library's message; ArgumentError, which is also a ValueError, for a wrong
argument, with its name in the message; NotConverged if the solver did not reach its tolerance (the
last iterate can be read).

Objects own memory of the library until close(), the end of a `with` block, or garbage collection. A
call on a closed object raises ValueError. Calls release the GIL: calls on different objects run in
parallel, as do read-only calls on one object; a call that changes an object waits for the others.
"""

from __future__ import annotations

from . import law as law
from ._case import Case, keys, study
from ._case import Source as Source, Value as Value
from ._contact import Answer, Contact, Level, Spots, indent_all, press_all, step_all
from ._friction import Friction, FrictionState, SpotSlip, stiffness_ratio
from ._h import (
    FILE as FILE,
    INTERNAL as INTERNAL,
    LEVEL_CONVERGED as LEVEL_CONVERGED,
    LEVEL_NOT_CONVERGED as LEVEL_NOT_CONVERGED,
    LEVEL_NOT_UNIQUE as LEVEL_NOT_UNIQUE,
    LEVEL_OUT_OF_VALIDITY as LEVEL_OUT_OF_VALIDITY,
    LEVEL_OVERLAPPING as LEVEL_OVERLAPPING,
    LEVELS as LEVELS,
    NO_MEMORY as NO_MEMORY,
    NO_RESULT as NO_RESULT,
    NOT_CONVERGED as NOT_CONVERGED,
    STOPPED as STOPPED,
    SUCCESS as SUCCESS,
)
from ._library import (
    ArgumentError,
    Error,
    NotConverged,
    lock,
    version,
)
from ._results import read
from ._surface import Asperities, Curvatures, Grid, Moments, Summits, Surface

__version__ = version()

__all__ = [
    "Case",
    "Surface",
    "Asperities",
    "Contact",
    "Friction",
    "Error",
    "ArgumentError",
    "NotConverged",
    "Grid",
    "Moments",
    "Summits",
    "Curvatures",
    "Level",
    "Answer",
    "Spots",
    "FrictionState",
    "SpotSlip",
    "LEVELS",
    "law",
    "read",
    "stiffness_ratio",
    "study",
    "press_all",
    "indent_all",
    "step_all",
    "lock",
    "version",
    "keys",
]
