"""rsc for Python: the elastic contact of a sphere with a rough surface of asperities. It provides all functions of rsc.h;
see there for details of every argument.

    import rsc
    case = rsc.Case({"surface": {"sigma": 0.01, "n": 1024, "L_lambda_s": 256}})
    asperities = rsc.Asperities.make(case)
    contact = rsc.Contact.from_case(asperities, case)
    force = contact.indent(separation=0.02)
    print(force, contact.area, contact.stiffness())

Needs numpy and librsc, nothing else; nothing is compiled. librsc is searched for in the environment variable RSC_LIBRARY (its full
path), then beside the installation of this file (or in build/ of a clone), then in the library path of the system.

Any consistent units may be used: [length], [force], moduli in [force/length^2]. Arrays are numpy arrays of float64;
two-dimensional ones are [y, x], x running fastest. A list or tuple of numbers is converted; a numpy array of another dtype, shape
or order is refused, to avoid hidden copies (data stored by the library are copied once). Indices count from 0.

Errors: Error with the library's message; ArgumentError, which is also a ValueError, for a wrong argument, with its name in the
message; NotConverged if the solver did not reach its tolerance (the last iterate can be read).

Objects own memory of the library until close(), the end of a `with` block, or garbage collection. A call on a closed object raises
ValueError. Calls release the GIL: calls on different objects run in parallel, as do read-only calls on one object; a call that changes
an object waits for the others.
"""

import collections
import contextlib
import ctypes
import ctypes.util
import glob
import itertools
import operator
import os
import re
import sys
import threading
import zlib

try:
    import numpy as np
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"rsc needs numpy, which {sys.executable} lacks: install it there, or use another Python that has it "
        "(Debian: package python3-numpy, /usr/bin/python3)",
        name=error.name,
    ) from None

import _rsc_h
from _rsc_h import (
    FILE,
    INTERNAL,
    LEVEL_CONVERGED,
    LEVEL_NOT_CONVERGED,
    LEVEL_NOT_UNIQUE,
    LEVEL_OUT_OF_VALIDITY,
    LEVEL_OVERLAPPING,
    LEVELS,
    NO_MEMORY,
    NO_RESULT,  # noqa: F401
    NOT_CONVERGED,
    STOPPED,
    SUCCESS,
)

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

# ---- rsc.h ---------------------------------------------------------------------------------------------------------------------
# The arguments of each function, as declared in rsc.h (all return int32_t). They determine the ctypes, the checks of the arguments by
# name, and whether a call reads (const) or changes an object.
_Argument = collections.namedtuple("_Argument", "const type stars name")
_INTEGERS = {
    "int32_t": (ctypes.c_int32, np.int32, 2**31),
    "int64_t": (ctypes.c_int64, np.int64, 2**63),
}


class Error(Exception):
    """A call of the library failed. str(error) is the library's message; error.status its status: above 0, a NOT_CONVERGED, NO_MEMORY,
    FILE, NO_RESULT or INTERNAL of this module; below 0, the number of the wrong argument in rsc.h (see ArgumentError).
    """

    def __init__(self, message, status=0):
        super().__init__(message)
        self.status = status


class ArgumentError(Error, ValueError):
    """An argument is wrong; the message names it. Both an Error and a ValueError. error.status is below 0 if the library found it."""


class NotConverged(Error):
    """The solver did not reach its tolerance. The last iterate of the object can be read; after Case.run the file is written,
    and error.failed_levels is the number of levels that failed."""

    failed_levels = None


def _parse(prototypes):
    """{function: [_Argument, ...]} of prototypes in C."""
    functions = {}
    for name, arguments in re.findall(r"(\w+)\((.*?)\)", prototypes, flags=re.DOTALL):
        functions[name] = []
        for argument in filter(None, arguments.split(",")):
            const, kind, stars, word = re.fullmatch(
                r"\s*(const )?(\w+)(\**)\s+(\w+)", argument
            ).groups()
            functions[name].append(_Argument(bool(const), kind, len(stars), word))
    return functions


_FUNCTIONS = _parse(_rsc_h.PROTOTYPES)


def _ctype(argument):
    """The argument types for ctypes: numbers by value; everything else is an address, created and checked by _convert."""
    if argument.stars or argument.type.startswith("rsc_"):  # an address, or a callback
        return ctypes.c_void_p
    return ctypes.c_double if argument.type == "double" else _INTEGERS[argument.type][0]


def _library_paths():
    if os.environ.get("RSC_LIBRARY"):
        yield os.environ["RSC_LIBRARY"]
        return
    folder = os.path.dirname(os.path.abspath(__file__))
    for _ in range(5):
        for pattern in (
            "lib/librsc.so",
            "lib/*-linux-gnu/librsc.so",
            "lib64/librsc.so",
            "build/librsc.so",
            "lib/librsc.dylib",
            "build/librsc.dylib",
        ):
            # An installation without the files for developers has librsc.so.X.Y only.
            yield from sorted(
                glob.glob(os.path.join(glob.escape(folder), pattern))
                or glob.glob(os.path.join(glob.escape(folder), pattern) + ".*")
            )[:1]
        folder = os.path.dirname(folder)
    found = ctypes.util.find_library("rsc")
    if found:
        yield found


def _load():
    path = next(_library_paths(), None)
    if path is None:
        raise ImportError(
            "rsc: librsc was not found; install it (cmake --install build) or set RSC_LIBRARY to the path of librsc.so"
        )
    try:
        library = ctypes.CDLL(path)  # lets other threads run during calls
    except OSError as error:
        raise ImportError(f"rsc: {path} cannot be loaded: {error}") from None
    for name, arguments in _FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(
                f"rsc: {path} has no function {name}: its version differs from that of rsc.py"
            ) from None
        function.argtypes = [_ctype(a) for a in arguments]
        function.restype = ctypes.c_int32
    return library, path


_library, _library_path = _load()
_Watch = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_double, ctypes.c_double, ctypes.c_void_p)


# ---- one call ------------------------------------------------------------------------------------------------------------------
class _Lock:
    """Lock for many readers or one writer. A waiting writer blocks new readers."""

    def __init__(self):
        self._gate, self._busy, self._count = threading.Lock(), threading.Lock(), threading.Lock()
        self._readers = 0

    def acquire(self, shared):
        with self._gate:
            if not shared:
                self._busy.acquire()
                return
            with self._count:
                if self._readers == 0:
                    self._busy.acquire()
                self._readers += 1

    def release(self, shared):
        if not shared:
            self._busy.release()
            return
        with self._count:
            self._readers -= 1
            if self._readers == 0:
                self._busy.release()


class _Object:
    """Owner of a handle of the library."""

    __slots__ = ("_handle", "_lock", "__weakref__")  # contact.tpi = ... is an error
    _kind = None  # "case" of rsc_case

    def __init__(self):
        raise TypeError(f"rsc.{type(self).__name__}: use one of its class methods")

    def _create(self, function, *arguments):
        self._handle, self._lock = ctypes.c_void_p(), _Lock()
        _call(function, ctypes.byref(self._handle), *arguments)

    @classmethod
    def _make(cls, function, *arguments):
        self = cls.__new__(cls)
        self._create(function, *arguments)
        return self

    def copy(self):
        """An independent copy of this object, that of a contact with its last level, path and committed state. Raises Error (no memory),
        ValueError (closed)."""
        return type(self)._make(f"rsc_{self._kind}_copy", self)

    def close(self):
        """Releases the memory, after calls of other threads on this object. Closing twice is allowed; any other use afterwards raises
        ValueError."""
        if getattr(self, "_handle", None):
            self._lock.acquire(shared=False)
            try:
                if self._handle:
                    getattr(_library, f"rsc_{self._kind}_destroy")(ctypes.byref(self._handle))
            finally:
                self._lock.release(shared=False)

    @property
    def closed(self):
        """True after close()."""
        return not getattr(self, "_handle", None)

    def __repr__(self):
        try:
            about = "closed" if self.closed else self._about()
        except Error as error:
            about = str(error)
        return f"<rsc.{type(self).__name__}: {about}>"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        with contextlib.suppress(Exception):  # the interpreter may be shutting down
            self.close()

    def __reduce__(self):
        raise TypeError(
            f"rsc.{type(self).__name__} cannot be pickled, because it belongs to this process; pickle the text of its case or its arrays"
        )

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, _):
        return self.copy()


def _refuse(name, what):
    raise ArgumentError(f"{name}: {what}")


def _array(name, value, shape=None, dtype=np.float64):
    """The array itself if it needs no conversion; lists and numbers are converted. 1-D slices with a stride are copied."""
    if not isinstance(value, np.ndarray):
        try:
            value = np.array(value, dtype=dtype)
        except (TypeError, ValueError):
            _refuse(name, "numbers are expected")
    if value.dtype != dtype:
        _refuse(
            name,
            f"an array of {np.dtype(dtype).name} is expected, not of {value.dtype}; numpy.asarray({name}, '{np.dtype(dtype).name}') makes one",
        )
    if shape is not None and (
        value.ndim != len(shape)
        or any(want not in (None, have) for want, have in zip(shape, value.shape))
    ):
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        _refuse(
            name,
            f"the shape ({wanted}{',' if len(shape) == 1 else ''}) is expected, not {value.shape}",
        )
    if value.ndim == 1 and not value.flags.c_contiguous:
        value = np.ascontiguousarray(value)
    return value


def _convert(argument, value):
    """A Python value converted for ctypes, and objects that must exist until the end of the call."""
    name, kind = argument.name, argument.type
    if argument.stars == 0 and kind.startswith("rsc_"):  # a callback
        return ctypes.cast(value, ctypes.c_void_p), value
    if argument.stars == 0:
        if kind == "double":
            if isinstance(value, (str, bytes)):
                _refuse(name, "a number is expected, not a text")
            try:
                return float(value), None
            except (TypeError, ValueError, OverflowError):
                _refuse(name, f"a number is expected, not {value!r:.80}")
        try:
            number = operator.index(value)
        except TypeError:
            _refuse(name, f"a whole number is expected, not {value!r:.80}")
        limit = _INTEGERS[kind][2]
        if not -limit <= number < limit:
            _refuse(name, f"{number} is too large")
        return number, None
    if value is None:
        return None, None
    if kind == "char" and argument.const:
        if not isinstance(value, str):
            _refuse(name, f"a text is expected, not {value!r:.80}")
        if "\0" in value:
            _refuse(name, "a text without null characters is expected")
        text = ctypes.create_string_buffer(value.encode("utf-8", "surrogateescape"))
        return ctypes.addressof(text), text
    if isinstance(value, np.ndarray):
        if np.ma.is_masked(value):
            _refuse(name, "some of its values are masked: fill or remove them")
        wanted = np.float64 if kind == "double" else _INTEGERS[kind][1]
        if value.dtype != wanted:
            _refuse(name, f"an array of {np.dtype(wanted).name} is expected, not of {value.dtype}")
        if not value.flags.c_contiguous:
            _refuse(
                name,
                f"an array in C order is expected (x fastest, no gaps); numpy.ascontiguousarray({name}) makes one",
            )
        if not argument.const and not value.flags.writeable:
            _refuse(name, "the array is read-only")
        return value.ctypes.data, value
    if isinstance(value, ctypes._SimpleCData) or isinstance(value, ctypes.Array):
        return ctypes.addressof(value), value
    return value, value  # byref of a handle


def _handles(value):
    """The handle of an object, or a list of handles."""
    if isinstance(value, list):
        return (ctypes.c_void_p * len(value))(*[one._handle.value for one in value])
    return value._handle if isinstance(value, _Object) else value


def _call(function, *values):
    """Calls a function of rsc.h: converts and checks the values, locks the objects among them, raises errors."""
    arguments = _FUNCTIONS[function]
    converted, alive, objects = [], [], []
    for argument, value in zip(arguments, values):
        many = argument.stars == 2 and isinstance(value, list)
        if argument.type.startswith("rsc_") and (argument.stars == 1 or many):
            if value is None:
                converted.append(None)
                continue
            for one in value if many else [value]:
                if not isinstance(one, _Object) or "rsc_" + one._kind != argument.type:
                    _refuse(
                        argument.name,
                        f"an object of rsc.{argument.type[4:].capitalize()} is expected, not {type(one).__name__}",
                    )
                objects.append((one, argument.const, argument.name))
            converted.append(value)
        else:
            value, owner = _convert(argument, value)
            converted.append(value)
            alive.append(owner)
    objects.sort(key=lambda entry: id(entry[0]))  # the same order in all threads
    held = []
    try:
        for value, const, _ in objects:
            value._lock.acquire(const)
            held.append((value, const))
        for value, _, name in objects:
            if not value._handle:
                _refuse(name, "this object is closed")
        status = getattr(_library, function)(*[_handles(v) for v in converted])
    finally:
        for value, const in held:
            value._lock.release(const)
    if status != SUCCESS:
        message = _text("rsc_message") or f"{function}: status {status}"
        kind = ArgumentError if status < 0 else NotConverged if status == NOT_CONVERGED else Error
        raise kind(message, status)


def _text(function, *values):
    """The text output of a function."""
    size = 4096
    while True:
        buffer, length = ctypes.create_string_buffer(size), ctypes.c_int64()
        _call(function, *values, buffer, size, length)
        if length.value < size:
            return buffer.value.decode("utf-8", "replace")
        size = length.value + 1


def _numbers(function, *values):
    """The scalar outputs of a function that follow the values, a tuple."""
    outputs = [_ctype(a._replace(stars=0))() for a in _FUNCTIONS[function][len(values) :]]
    _call(function, *values, *outputs)
    return tuple(o.value for o in outputs)


def _number(function, *values):
    """The same for a single output."""
    return _numbers(function, *values)[0]


# ---- results of calls ---------------------------------------------------------------------------------------------------------
def _record(name, fields, doc):
    kind = collections.namedtuple(name, fields)
    kind.__doc__ = doc
    return kind


Grid = _record(
    "Grid",
    "nx ny dx dy x0 y0 periodic",
    "The grid of a surface: points nx, ny; steps dx, dy and position x0, y0 of the first point [length]; periodic.",
)
Moments = _record(
    "Moments",
    "m0 m2 m4",
    "Spectral moments of a surface: m0 [length^2], m2 [1], m4 [1/length^2]; the rms slope is sqrt(2 m2).",
)
Summits = _record(
    "Summits",
    "x y z radius",
    "Asperities: positions x, y, heights z and radii, arrays of shape (n,) [length].",
)
Curvatures = _record(
    "Curvatures",
    "kappa1 kappa2 angle",
    "Principal curvatures kappa1 >= kappa2 [1/length] of asperities and the direction of the "
    "kappa2 axis from x [rad]; arrays of shape (n,).",
)
Level = _record(
    "Level",
    "status candidates iterations overlapping_pairs residual",
    "Solver data of a level: status (its name: rsc.LEVELS[status]); candidates, "
    "number of asperities that the sphere would penetrate without interaction; iterations; overlapping pairs of spots; relative residual [1].",
)
Spots = _record(
    "Spots",
    "asperity force radius penetration",
    "Contacts: indices of the asperities from 0 (int32; None for all asperities), force [force], "
    "contact radius a, the area being pi a^2 [length], and penetration [length]; arrays of shape (n,).",
)
FrictionState = _record(
    "FrictionState",
    "separation x y force force_x force_y energy tangential_energy lost stick_separation",
    "State of the path of a Friction: separation Z0 and slide x, y [length]; force N, tangential force Q as force_x, force_y [force]; elastic energy of the normal problem and of the slide, work lost to friction since the start of the path [force length]; separation at which the contact area would equal the stick area [length].",
)
SpotSlip = _record(
    "SpotSlip",
    "asperity radius stick_radius force_x force_y",
    "Arrays with one value for each spot: index of the asperity, contact radius, radius of the part that sticks [length], share of the tangential force [force].",
)
Answer = _record(
    "Answer",
    "separation force stiffness area energy lateral_x lateral_y status contacts overlapping_pairs large_contacts beyond_law edge_contacts",
    "The results of a level: see Contact.answer.",
)
_Result = collections.namedtuple("_Result", "separation force area contacts")


# ---- cases ---------------------------------------------------------------------------------------------------------------------
def version():
    """The version of librsc, a text 'major.minor.patch'."""
    return _text("rsc_version")


def keys():
    """The names of all keys of a case, 'group%key', a list of texts in the order of the documentation (rsc --describe)."""
    return [_text("rsc_key_name", k) for k in range(_number("rsc_key_count"))]


__version__ = version()


def _namelist_value(name, value):
    """A Python value in namelist syntax."""
    if value is None:
        return ""
    if isinstance(value, (bool, np.bool_)):
        return ".true." if value else ".false."
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return {"inf": "Infinity", "-inf": "-Infinity", "nan": "NaN"}.get(
            repr(float(value)), repr(float(value))
        )
    if isinstance(value, (list, tuple, np.ndarray)) and np.ndim(value) == 1 and len(value):
        return ", ".join(_namelist_value(name, v) for v in value)
    _refuse(
        name,
        f"a number, a text, True, False, None or a list of these is expected, not {value!r:.80}",
    )


def _python_value(text):
    """The value of a key from the text of the library, in Python's types."""
    values = []
    for token in re.findall(r"'(?:[^']|'')*'|[^,\s]+", text):
        if token.startswith("'"):
            values.append(token[1:-1].replace("''", "'"))
        elif token.lower() in (".true.", ".false."):
            values.append(token.lower() == ".true.")
        elif re.fullmatch(r"[+-]?\d+", token):
            values.append(int(token))
        else:
            values.append(float(token))
    return None if not values else values[0] if len(values) == 1 else tuple(values)


class Case(_Object):
    """Every option, by the names of the program's namelist (rsc --describe); all initially at their defaults.

    Case(source): source is a dictionary {"surface": {"sigma": 0.01}} or {"surface%sigma": 0.01}, a namelist text as the program reads it
    ("&surface sigma=0.01 /"), another Case, a path (pathlib.Path) of a namelist file, or None. Values are numbers, texts, True, False, lists
    of these, or None for the default. case["surface%sigma"] reads a value (None: not set; a tuple: several) and sets it. str(case) is the whole case as a namelist.
    Raises ArgumentError with a line for every invalid key or value."""

    __slots__ = ()
    _kind = "case"

    def _about(self):
        default = Case()
        changed = [k for k in keys() if self[k] != default[k]]
        return ", ".join(f"{k} = {self[k]!r}" for k in changed) or "the defaults"

    def __init__(self, source=None):
        if isinstance(source, Case):
            self._create("rsc_case_copy", source)
            return
        self._create("rsc_case_create")
        if isinstance(source, os.PathLike):
            self.read_file(source)
        elif isinstance(source, str):
            self.read(source)
        elif source is not None:
            self.update(source)

    def read(self, text):
        """Sets all keys from the namelist `text`; keys that are not in it get their defaults. Raises ArgumentError; the case is then
        unchanged."""
        _call("rsc_case_read", self, text)

    def read_file(self, path):
        """Sets all keys from the namelist in the file `path`. Raises ArgumentError as read does, and for a file that cannot be read."""
        _call("rsc_case_read_file", self, os.fspath(path))

    def update(self, source):
        """Sets the keys of a dictionary `source`, {"surface": {"sigma": 0.01}} or {"surface%sigma": 0.01}. Raises ArgumentError, the case then
        being unchanged."""
        try:
            items = [
                (f"{group}%{key}", value)
                for group, inner in source.items()
                if isinstance(inner, dict)
                for key, value in inner.items()
            ]
            items += [(key, value) for key, value in source.items() if not isinstance(value, dict)]
        except (AttributeError, TypeError):
            _refuse(
                "source", f"a dictionary, a namelist text or a Case is expected, not {source!r:.80}"
            )
        with self.copy() as trial:  # all or nothing
            for target in (trial, self):
                for key, value in items:
                    target[key] = value

    def __setitem__(self, name, value):
        """Sets one key: `name` "group%key", "group%key(2)" or "group%key(1:2)", `value` as above. Raises ArgumentError."""
        _call("rsc_case_set", self, name, _namelist_value(name, value))

    def __getitem__(self, name):
        """The value of the key `name`; None if it is not set. Raises ArgumentError for an unknown name."""
        return _python_value(_text("rsc_case_get", self, name))

    def text(self):
        """All keys with their values, as namelist text for the program and read()."""
        return _text("rsc_case_text", self)

    __str__ = text

    def __eq__(self, other):
        return isinstance(other, Case) and self.text() == other.text()

    __hash__ = None

    def run(self, file=None, progress=None):
        """Runs the case as the program does, writes its result file and returns the path of it; read(path) reads it. Prints nothing.
        file: path of the result file; by default that of the key output%file. Paths are relative to the working directory. progress: called
        as progress(done, total) by this thread about twenty times a second, with numbers of levels, or of realizations if there are several. Its
        exceptions, and Ctrl-C, stop the run and are raised again; then no result is written.
        Raises ArgumentError for an invalid case, NotConverged if some levels did not converge (the file is written; the number is
        error.failed_levels), Error for a file that cannot be written or lack of memory."""
        case = self
        if file is not None:
            case = self.copy()
            case["output%file"] = os.fspath(file)
        # Python handles Ctrl-C only in its main thread, and not during a library call; therefore another thread runs the case.
        # Not Thread.join: if Ctrl-C interrupts it, Python 3.11 considers the thread as ended.
        failed, stop, done, seen, raised = (
            ctypes.c_int64(),
            threading.Event(),
            threading.Event(),
            [],
            [],
        )

        def watch(done, total, _):
            seen[:] = [done, total]
            return stop.is_set()

        def work():
            try:
                _call("rsc_case_run_watched", case, _Watch(watch), None, failed)
            except BaseException as error:
                raised.append(error)
            finally:
                done.set()

        with lock():  # NetCDF suppresses HDF5's messages in the first thread that uses it, the lock in this one, which may read the result
            threading.Thread(target=work).start()
        try:
            while not done.wait(0.05):
                if progress is not None and seen:
                    progress(*seen)
        finally:
            stop.set()
            done.wait()
        for error in raised:
            if isinstance(error, NotConverged):
                error.failed_levels = failed.value
            raise error
        return case["output%file"]


# ---- surfaces ------------------------------------------------------------------------------------------------------------------
class Surface(_Object):
    """Heights on a regular grid, created by synthesize or take."""

    __slots__ = ()
    _kind = "surface"

    def _about(self):
        grid = self.grid()
        return f"{grid.nx} x {grid.ny} points, dx = {grid.dx:.6g}"

    @classmethod
    def synthesize(cls, case=None, realization=1):
        """A random surface from the keys of &surface and run%seed, identical to realization number `realization` of the program. It is periodic,
        on x = i L/n, y = j L/n. case: None for the defaults. Raises ArgumentError for invalid keys, Error (no memory).
        """
        return cls._make("rsc_surface_synthesize", case, realization)

    @classmethod
    def take(cls, heights, dx, dy=None, x0=0.0, y0=0.0, periodic=False):
        """A surface from an array of heights, which is copied. Separations are measured from z = 0: see detrend.
        heights: float64, shape (ny, nx), C order, finite, 3 points or more each way [length]; dx, dy: grid steps > 0, dy = dx by default
        [length]; x0, y0: position of the first point [length]; periodic: True for a periodic surface.
        Raises ArgumentError with the name of the wrong argument, Error (no memory)."""
        heights = _array("heights", heights, (None, None))
        ny, nx = heights.shape
        return cls._make(
            "rsc_surface_take",
            nx,
            ny,
            dx,
            dx if dy is None else dy,
            x0,
            y0,
            bool(periodic),
            heights,
        )

    def detrend(self, how="plane"):
        """Subtracts a form fitted by least squares. how: 'none', 'mean', 'plane', 'quadratic' or 'sphere'. Returns the remaining rms height
        [length]. Raises ArgumentError for another word, or a sphere that cannot be fitted."""
        return _number("rsc_surface_detrend", self, how)

    def filter(self, cutoff):
        """Gaussian low-pass filter (ISO 16610-61): waves of length cutoff > 0 [length] keep half of their amplitude. Raises ArgumentError."""
        _call("rsc_surface_filter", self, cutoff)

    def grid(self):
        """The grid, a Grid. Raises ValueError if closed."""
        g = Grid(*_numbers("rsc_surface_grid", self))
        return g._replace(periodic=bool(g.periodic))

    def heights(self, out=None):
        """The heights [length], shape (ny, nx). out: an array of float64 of that shape to fill instead of a new one. Raises ArgumentError if
        it does not fit."""
        grid = self.grid()
        out = (
            np.empty((grid.ny, grid.nx)) if out is None else _output("out", out, (grid.ny, grid.nx))
        )
        _call("rsc_surface_heights", self, out.size, out)
        return out

    def moments(self):
        """Spectral moments by finite differences on the grid, Moments: m0 [length^2], m2 [1], m4 [1/length^2]. Raises ValueError if closed."""
        return Moments(*_numbers("rsc_surface_moments", self))


def _output(name, array, shape):
    if not isinstance(array, np.ndarray):
        _refuse(name, "a numpy array is expected")
    if not array.flags.c_contiguous:
        _refuse(name, "an array in C order is expected")
    return _array(name, array, shape)


# ---- asperities ----------------------------------------------------------------------------------------------------------------
class Asperities(_Object):
    """Summits: positions, heights, radii and possibly curvatures. Created by find, make or take; immutable. len(asperities) is their number."""

    __slots__ = ()
    _kind = "asperities"

    def _about(self):
        return f"{len(self)} summits"

    @classmethod
    def find(cls, surface, case=None):
        """The summits of a surface. surface: a Surface; case: asperities%curvature and asperities%law select the method, None for the defaults.
        Raises ArgumentError for a surface without summits or one too coarse for the law, Error (no memory).
        """
        return cls._make("rsc_asperities_find", surface, case)

    @classmethod
    def make(cls, case=None, realization=1):
        """The asperities of Surface.synthesize(case, realization), found without storing the surface. case: None for the defaults; realization:
        number of the surface. Raises ArgumentError for keys that are refused, Error (no memory)."""
        return cls._make("rsc_asperities_make", case, realization)

    @classmethod
    def take(cls, x, y, z, radius, kappa1=None, kappa2=None, angle=None, biharmonic=None):
        """Asperities from arrays, which are copied. x, y, z, radius: float64, shape (n,), radius > 0 [length]; kappa1 >= kappa2 > 0: principal curvatures
        [1/length] and angle: direction of the kappa2 axis from x [rad], all three or none; biharmonic: nabla^4 z at the summits
        [1/length^3], if the law needs it. Raises ArgumentError with the name of the wrong array, Error (no memory).
        """
        x = _array("x", x, (None,))
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
            None if v is None and k not in ("y", "z", "radius") else _array(k, v, (x.size,))
            for k, v in rest.items()
        ]
        return cls._make("rsc_asperities_take", x.size, x, *arrays)

    def __len__(self):
        return _number("rsc_asperities_count", self)

    def get(self):
        """Positions, heights and radii, Summits: arrays of shape (n,) [length]. Raises ValueError if closed."""
        arrays = Summits(*np.empty((4, len(self))))
        _call("rsc_asperities_get", self, len(self), *arrays)
        return arrays

    def curvatures(self):
        """Principal curvatures, Curvatures: arrays of shape (n,) [1/length], [rad]. Raises ArgumentError for asperities without curvatures."""
        arrays = Curvatures(*np.empty((3, len(self))))
        _call("rsc_asperities_curvatures", self, len(self), *arrays)
        return arrays


# ---- contact -------------------------------------------------------------------------------------------------------------------
class Contact(_Object):
    """A rigid smooth sphere over an elastic half-space that carries asperities (the equivalent problem of two bodies), and the last level
    computed.

    Contact(asperities, E_star, R, x0, y0, case): E_star: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [force/length^2]; R: radius, inf for a flat
    [length]; x0, y0: position of the tip [length]; case: keys of &solver, asperities%law, indentation%selection, ...; None for the defaults.
    Raises ArgumentError with the name of the wrong argument, Error (no memory). Contact.from_case takes E*, R and the tip from a case.
    """

    __slots__ = ()
    _kind = "contact"

    def _about(self):
        return "Z0 = {:.6g}, N = {:.6g}, A = {:.6g}, {} contacts".format(*self._result())

    def __init__(self, asperities, E_star, R, x0=0.0, y0=0.0, case=None):
        self._create(
            "rsc_contact_create", _given("asperities", asperities), E_star, R, x0, y0, case
        )

    @classmethod
    def from_case(cls, asperities, case=None):
        """A contact with E* and R from the keys of &solids and the tip at indentation%centre, by default above the middle. asperities: an
        Asperities; case: a Case, None for the defaults. Raises ArgumentError for keys that are refused, Error (no memory).
        """
        return cls._make("rsc_contact_create_from_case", _given("asperities", asperities), case)

    def asperities(self):
        """The asperities to which the indices of spots() refer: those of the constructor or, with law = 'elliptic' or
        'fourth_order' on a surface, the summits of the difference between surface and indenter for the present position of the tip. Raises
        ArgumentError for a contact of elements, ValueError (closed)."""
        return Asperities._make("rsc_contact_asperities", self)

    def indent(self, separation, time=None):
        """Computes the contact at a separation and returns the force [force]. The result depends on the separation and the tip only, unless
        the case has hardness, adhesion or a body that relaxes.
        separation: Z0, height of the tip above z = 0 [length]; time: of the level, for a body that relaxes (solids%relaxation_share): loads
        change linearly with time from the last level; None: the time of the last level [time]. Raises ArgumentError if one is not finite, or the
        time is before the last level; NotConverged (the last iterate can be read), Error."""
        self._at(time)
        return _number("rsc_contact_indent", self, separation)

    def press(self, force, time=None):
        """Finds the separation at which the sphere carries a force, computes the contact there, and returns the separation Z0 [length].
        force: N >= 0; 0 gives the separation of first touch [force]; time: as for indent. Raises ArgumentError if the force is negative or not
        finite, or no asperity is under the sphere; NotConverged (also if the force jumps over N), Error.
        """
        self._at(time)
        return _number("rsc_contact_press", self, force)

    def _at(self, time):
        if time is not None:
            _call("rsc_contact_set_time", self, time)

    def curve(self, separations=None, forces=None, progress=None):
        """A level for each of the separations [length], or of the forces [force] (one of the two, shape (n,)). Returns a dictionary of arrays of
        shape (n,), named as in a result file: separation [length], force [force], contact_area [length^2], contacts, status. Levels that did
        not converge have status 4 and raise no error here. progress: called as progress(done, n) after each level; an exception ends the
        curve. Raises ArgumentError as indent and press do."""
        if (separations is None) == (forces is None):
            _refuse("separations", "either separations or forces are expected")
        what, call, values = (
            ("separations", self.indent, separations)
            if forces is None
            else ("forces", self.press, forces)
        )
        values = _array(what, values, (None,))
        n = values.size
        levels = {
            "separation": np.empty(n),
            "force": np.empty(n),
            "contact_area": np.empty(n),
            "contacts": np.empty(n, np.int64),
            "status": np.empty(n, np.int32),
        }
        for k, value in enumerate(values):
            with contextlib.suppress(NotConverged):
                call(float(value))
            for name, number in zip(levels, (*self._result(), self.level().status)):
                levels[name][k] = number
            if progress is not None:
                progress(k + 1, n)
        return levels

    def _result(self):
        return _Result(*_numbers("rsc_contact_result", self))

    separation = property(
        lambda self: self._result().separation,
        doc="Z0 of the last level [length]. Raises Error (no result).",
    )
    force = property(
        lambda self: self._result().force,
        doc="N of the last level [force]. Raises Error (no result).",
    )
    area = property(
        lambda self: self._result().area,
        doc="True contact area A of the last level [length^2]. Raises Error (no result).",
    )
    contacts = property(
        lambda self: self._result().contacts,
        doc="Number of asperities in contact at the last level. Raises Error (no result).",
    )

    def level(self):
        """Solver data of the last level, a Level. Raises Error (no result)."""
        return Level(*_numbers("rsc_contact_level", self))

    def answer(self):
        """The last level in one call, an Answer: separation Z0 [length], force N [force], stiffness dN/dZ0 [force/length], area A [length^2],
        energy W [force length], lateral_x and lateral_y, the lateral force on the sphere, -dW/d(x0, y0) [force], status (of
        LEVELS), and numbers: contacts, overlapping_pairs, large_contacts, beyond_law, edge_contacts. Raises Error (no result).
        """
        return Answer(*_numbers("rsc_contact_answer", self))

    def value(self, name):
        """One quantity of the last level by its name in the result file, as "residual" or "large_contacts", or "lateral_force_x", ... Raises
        ArgumentError for an unknown name, whose message lists all, Error (no result)."""
        return _number("rsc_contact_value", self, name)

    def stiffness(self):
        """dN/dZ0 of the last level, negative, 0 without contact [force/length]. Raises Error (no result)."""
        return _number("rsc_contact_stiffness", self)

    def energy(self):
        """Elastic energy W of the last level, dW/dZ0 = -N [force length]. Raises Error (no result)."""
        return _number("rsc_contact_energy", self)

    @property
    def tip(self):
        """The position (x0, y0) of the tip [length]. Setting it moves the sphere sideways; results remain those of the last level until the next
        one. Raises ArgumentError if it is not finite, or over asperities that are attached, yielded or relax, where laws 'elliptic' and
        'fourth_order' have other summits at each place (an indenter of more than 0.2 of the surface's rms slope).
        """
        return _numbers("rsc_contact_tip", self)

    @tip.setter
    def tip(self, place):
        place = _array("tip", place, (2,))
        _call("rsc_contact_move_tip", self, float(place[0]), float(place[1]))

    def commit(self):
        """Stores tip, last level and loading history (solids%hardness, solids%adhesion) for rollback(). Raises Error (no memory)."""
        _call("rsc_contact_commit", self)

    def rollback(self):
        """Restores the state of the last commit(), or that of the new contact. Raises Error."""
        _call("rsc_contact_rollback", self)

    def first_touch(self):
        """The separation of first contact in loading [length]. Raises ArgumentError if no asperity is under the sphere."""
        return _number("rsc_contact_first_touch", self)

    def spots(self):
        """The contacts of the last level by increasing index of asperity, Spots: arrays of shape (contacts,). Raises Error (no result)."""
        n = self.contacts
        spots = Spots(np.empty(n, np.int32), *np.empty((3, n)))
        _call("rsc_contact_spots", self, n, *spots)
        return spots

    def per_asperity(self):
        """Results of every asperity, Spots without `asperity`: arrays of shape (len(asperities),), 0 where there is no contact. Raises Error
        (no result)."""
        n = len(self.asperities())
        spots = Spots(None, *np.empty((3, n)))
        _call("rsc_contact_per_asperity", self, n, *spots[1:])
        return spots

    def save(self, path):
        """Saves tip, options, last level, path and committed state in a file, from which restore() continues as this contact does. path: of the
        file; an existing file is replaced only if it is a save. Raises Error (file)."""
        _call("rsc_contact_save", self, os.fspath(path))

    @classmethod
    def restore(cls, asperities, path):
        """Reads a contact from a file of save(). asperities: those it was saved with; path: of the file. Raises ArgumentError for other
        asperities or another file, Error."""
        return cls._make("rsc_contact_restore", _given("asperities", asperities), os.fspath(path))

    def deflection(self, x, y):
        """The deflection of the surface by the contact forces [length], positive down, in the shape of x. x, y: positions [length], numbers or
        arrays of float64 of equal shape. Raises ArgumentError if they are not finite or differ in shape, Error (no result).
        """
        x = _array("x", x)
        y = _array("y", y, x.shape)
        deflection = np.empty(x.shape)
        _call("rsc_contact_deflection", self, x.size, x, y, deflection)
        return deflection if deflection.ndim else float(deflection)


# ---- friction ------------------------------------------------------------------------------------------------------------------
class Friction(_Object):
    """A contact with friction along any path of separations and slides (x, y). For the assumptions see rsc.h, section friction.

    Friction(contact, mu, ratio): contact: a Contact, for its asperities, sphere, tip and options; mu: coefficient of friction >= 0;
    ratio: m = 4 G*/E*, see stiffness_ratio. Raises ArgumentError with the name of the wrong argument, Error (no memory). Friction.from_case takes mu
    and m from a case. copy() also copies the path."""

    __slots__ = ()
    _kind = "friction"

    def _about(self):
        return ", ".join(f"{k} = {v:.6g}" for k, v in self.state()._asdict().items())

    def __init__(self, contact, mu, ratio):
        self._create("rsc_friction_create", _given("contact", contact), mu, ratio)

    @classmethod
    def from_case(cls, contact, case=None):
        """Friction with mu from solids%friction and m from solids%E and solids%nu. contact: a Contact; case: a Case, None for the defaults.
        Raises ArgumentError for keys that are refused, Error (no memory)."""
        return cls._make("rsc_friction_create_from_case", _given("contact", contact), case)

    def update(self, separation, x=0.0, y=0.0):
        """Moves the contact on a straight path to (separation, x, y) and returns (N, Q_x, Q_y, work lost in this step). The first call defines
        the start of the path. separation: Z0; x, y: slide, of which only differences matter [length]. Q is initially along the slide: the
        force on the sphere is -Q. Raises ArgumentError if a number is not finite, NotConverged (the state is that of the last iterates), Error.
        """
        return _numbers("rsc_friction_update", self, separation, x, y)

    def state(self):
        """State of the path, a FrictionState. Raises Error (no result) before the first update."""
        return FrictionState(*_numbers("rsc_friction_state", self))

    def move_tip(self, x0, y0):
        """Moves the tip at the separation of the last update, for a sphere that rolls onto other asperities: those in contact at both positions
        keep their share of the tangential force, the rest is lost (rsc.h). x0, y0: the new position [length]. Raises ArgumentError,
        NotConverged, Error."""
        _call("rsc_friction_move_tip", self, x0, y0)

    def stiffness(self):
        """Tangential stiffness dQ/d(x, y) for a further slide in the present direction of slip, an array of shape (2, 2) [force/length]. Raises
        NotConverged, Error."""
        return np.array(_numbers("rsc_friction_stiffness", self)).reshape(2, 2)

    def commit(self):
        """Stores the state for rollback(). Raises Error (no memory)."""
        _call("rsc_friction_commit", self)

    def rollback(self):
        """Restores the state of the last commit. Raises Error (no memory)."""
        _call("rsc_friction_rollback", self)

    def first_loading(self, slide):
        """Tangential force Q of a contact pressed to the last separation without slide and then slid [force], in the shape of slide; the path is not changed. slide: >= 0,
        float64, shape (n,) [length]. Raises ArgumentError for a slide that is negative or not finite, NotConverged, Error (no result without
        contact)."""
        slide = _array("slide", slide, (None,))
        force = np.empty(slide.shape)
        _call("rsc_friction_first_loading", self, slide.size, slide, force, None)
        return force

    def slide(self, force):
        """The slide of first loading at which the tangential force is Q [length]. force: 0 <= Q <= mu N [force]. Raises ArgumentError out of range,
        NotConverged, Error (no result without contact)."""
        return _number("rsc_friction_slide", self, force)

    def full_slip(self):
        """The slide of full slip in first loading [length] and the force mu N [force]. Raises Error (no result without contact)."""
        return _numbers("rsc_friction_full_slip", self)

    def spots(self):
        """Friction at the spots of the last update by increasing index of asperity, SpotSlip. Raises NotConverged, Error (no result)."""
        count = ctypes.c_int64()
        with contextlib.suppress(ArgumentError):  # only for the number
            _call("rsc_friction_spots", self, 0, count, None, None, None, None, None)
        n = count.value
        spots = SpotSlip(np.empty(n, np.int32), *np.empty((4, n)))
        _call("rsc_friction_spots", self, n, count, *spots)
        return spots

    def save(self, path):
        """Saves the path and the committed state in a file, from which restore() continues bit for bit. path: of the file. Raises Error (file)."""
        _call("rsc_friction_save", self, os.fspath(path))

    @classmethod
    def restore(cls, asperities, path):
        """Reads friction from a file of save(). asperities: those it was saved with; path: of the file. Raises ArgumentError for other
        asperities or another file, Error."""
        return cls._make("rsc_friction_restore", _given("asperities", asperities), os.fspath(path))


def stiffness_ratio(E, nu):
    """m = 4 G*/E* of two bodies, the ratio of tangential to normal stiffness of any of their contacts. E: two Young's moduli, inf: rigid
    [force/length^2]; nu: two Poisson's ratios. Raises ArgumentError with the name of the wrong argument.
    """
    return _number("rsc_stiffness_ratio", _array("E", E, (2,)), _array("nu", nu, (2,)))


def _given(name, value):
    if value is None:
        _refuse(name, "an object is expected, not None")
    return value


# ---- results and studies -------------------------------------------------------------------------------------------------------
def read(path, xarray=None):
    """Reads a result file. path: its path. xarray: True for an xarray.Dataset (which needs Debian's python3-xarray), False for a
    dictionary {variable: numpy array} with the file's attributes under the empty name ""; None, the default, for the Dataset if xarray
    is installed. For the manifest of a study, the members are read as one cube: every variable that all of them have gets a dimension for each
    key that varies, with the values of the key; if the members do not form a full grid, one dimension 'member'. Needs netCDF4 (Debian's
    python3-netcdf4). Shapes, units and meanings are those of the file (ncdump -h); missing reals are NaN. Raises Error if the file cannot be
    read, ImportError if a package is missing."""
    path = os.fspath(path)
    import netCDF4
    from _rsc_cube import attributes_of, filled

    _check_sound(path)
    try:
        with lock(), netCDF4.Dataset(path) as file:
            variables = {name: filled(variable[...]) for name, variable in file.variables.items()}
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            if xarray is not False:
                about = {
                    name: (v.dimensions, attributes_of(v)) for name, v in file.variables.items()
                }
                coordinates = [
                    name for name, v in file.variables.items() if v.dimensions == (name,)
                ]
    except OSError as error:
        raise Error(f"{path}: cannot be read: {error.strerror or error}", FILE) from None
    if xarray is not False:
        try:
            import xarray as package
        except ImportError:
            if xarray:
                raise
            xarray = False
    if "member" in variables and "file" in variables:
        return _cube(path, xarray is not False)
    if xarray is not False:
        data = {
            name: (about[name][0], values, about[name][1]) for name, values in variables.items()
        }
        if "separation" in data and data["separation"][0] == ("step",):
            coordinates.append("separation")
        return package.Dataset(
            {k: v for k, v in data.items() if k not in coordinates},
            {k: data[k] for k in coordinates},
            attributes,
        )
    variables[""] = attributes
    return variables


def _cube(path, dataset):
    """The members of a study as one object: a Dataset, or a dictionary of arrays with {name: dimensions} under the name "dimensions"."""
    import _rsc_cube

    try:
        with lock():
            cube = _rsc_cube.cube(path, _check_sound)
    except OSError as error:
        raise Error(f"{path}: a member cannot be read: {error.strerror or error}", FILE) from None
    if not dataset:
        return {name: values for name, (_, values, _) in cube.variables.items()} | {
            "": cube.attributes,
            "dimensions": {name: d for name, (d, _, _) in cube.variables.items()},
        }
    import xarray

    coordinates = {
        name
        for name, (dimensions, _, _) in cube.variables.items()
        if dimensions == (name,) or name in cube.keys
    }
    return xarray.Dataset(
        {k: v for k, v in cube.variables.items() if k not in coordinates},
        {k: cube.variables[k] for k in coordinates},
        cube.attributes,
    )


def _check_sound(path):
    """Checks the checksum in the last line of a result before HDF5 opens the file, because HDF5 crashes on some damaged files."""
    start = b"\nrsc: CRC-32 of all before this line: "
    try:
        content = np.memmap(path, np.uint8, "r")
    except (OSError, ValueError):
        return  # reported when it is read
    line = bytes(content[-len(start) - 9 :])
    if line.startswith(start) and line != start + b"%08x\n" % zlib.crc32(content[: -len(line)]):
        raise Error(
            f"{path}: is damaged, or was changed since rsc wrote it: its checksum is wrong", FILE
        )


@contextlib.contextmanager
def lock():
    """with rsc.lock(): prevents rsc from calling NetCDF, HDF5 and FFTW's planner while this thread uses them (netCDF4, h5py), because they are
    not thread-safe. read() takes the lock itself."""
    _call("rsc_lock")
    try:
        yield
    finally:
        _call("rsc_unlock")


def press_all(contacts, forces, threads=0):
    """Contact.press for many contacts, distributed among threads. contacts: different Contacts; forces: N >= 0 of each, shape (n,) [force];
    threads: their number, 0 for all of the machine (results do not depend on it). Returns (separations, statuses), arrays of shape (n,):
    Z0 of each [length], NaN after a failure, and SUCCESS, NOT_CONVERGED or another status of rsc.h for each. Raises ArgumentError for a
    contact given twice, a force that is negative or not finite, or a contact without asperities under its sphere.
    """
    return _all("rsc_contacts_press", contacts, "forces", forces, threads)


def indent_all(contacts, separations, threads=0):
    """Contact.indent for many contacts, as press_all. contacts: different Contacts; separations: Z0 of each, shape (n,) [length];
    threads: their number, 0 for all. Returns (forces, statuses): N of each [force]. Raises ArgumentError as press_all does.
    """
    return _all("rsc_contacts_indent", contacts, "separations", separations, threads)


def step_all(contacts, forces=None, separations=None, tips=None, stiffness=False, threads=0):
    """A step of many contacts: each tip moved to tips, then pressed with forces or indented to separations, one of the two. contacts: different
    Contacts; forces, separations: shape (n,); tips: shape (n, 2), None to leave them [length]; stiffness: True to compute it; threads: their
    number, 0 for all. Returns a dictionary of arrays of shape (n,): separation, force, stiffness if requested, lateral_x, lateral_y, moment_x,
    moment_y, NaN if there is no result, level_status, and status, as press_all's. Raises ArgumentError.
    """
    contacts = _different(contacts)
    if (forces is None) == (separations is None):
        _refuse("forces, separations", "one of the two is expected")
    n = len(contacts)
    values = _array(
        "separations" if forces is None else "forces",
        separations if forces is None else forces,
        (n,),
    )
    x, y = (None, None) if tips is None else np.ascontiguousarray(_array("tips", tips, (n, 2)).T)
    order = ["separation", "force", "stiffness", "lateral_x", "lateral_y", "moment_x", "moment_y"]
    answers = {name: np.full(n, np.nan) for name in order if stiffness or name != "stiffness"}
    answers.update(level_status=np.zeros(n, np.int32), status=np.zeros(n, np.int32))
    with _of_one(answers["status"]):
        _call(
            "rsc_contacts_step",
            n,
            contacts,
            x,
            y,
            int(forces is not None),
            values,
            *[answers.get(name) for name in order],
            *list(answers.values())[-2:],
            threads,
        )
    return answers


def _all(function, contacts, name, values, threads):
    contacts = _different(contacts)
    values = _array(name, values, (len(contacts),))
    answers, statuses = np.full(len(contacts), np.nan), np.zeros(len(contacts), np.int32)
    with _of_one(statuses, ArgumentError):
        _call(function, len(contacts), contacts, values, answers, statuses, threads)
    return answers, statuses


def _different(contacts):
    contacts = list(contacts)
    if len({id(contact) for contact in contacts}) < len(contacts):
        _refuse("contacts", "different contacts are expected: one is given twice")
    return contacts


@contextlib.contextmanager
def _of_one(statuses, *raised):
    """Suppresses the error of one contact, which its status tells, unless it is of the kinds `raised`."""
    try:
        yield
    except Error as error:
        if isinstance(error, raised) or not statuses.any():
            raise


def study(case, over, run, mode="product", threads=1, progress=None):
    """Runs a function on every member of a study and returns a list of (values, result), in the order of the members.
    case: a Case, or an argument of Case(); over: {"surface%sigma": [0.005, 0.01], ...}, lists of values for keys; run: called as
    run(member) with the Case of the member, for instance a function that returns a contact's curve; mode: 'product' for every
    combination (the last key varying fastest), 'zip' for the k-th values of all lists together; threads: number of members at a time; progress:
    called as progress(done, n, values) after each member, always in the caller's thread. Exceptions of run and progress end the study and are
    raised again. Raises ArgumentError for invalid keys or values, before anything runs."""
    case = Case(case)
    lists = [list(values) for values in over.values()]
    if mode == "zip":
        if len({len(values) for values in lists}) > 1:
            _refuse("over", "lists of equal length are expected with mode='zip'")
        combinations = list(zip(*lists))
    elif mode == "product":
        combinations = list(itertools.product(*lists))
    else:
        _refuse("mode", f"'product' or 'zip' is expected, not {mode!r}")
    members = []
    for combination in combinations:
        values = dict(zip(over, combination))
        member = case.copy()
        member.update(values)
        members.append((values, member))
    results = [None] * len(members)
    with contextlib.ExitStack() as stack:
        if threads > 1:
            from concurrent.futures import ThreadPoolExecutor, as_completed

            pool = ThreadPoolExecutor(threads)
            stack.callback(pool.shutdown, cancel_futures=True)
            futures = {pool.submit(run, member): k for k, (_, member) in enumerate(members)}
            finished = ((futures[future], future.result()) for future in as_completed(futures))
        else:
            finished = ((k, run(member)) for k, (_, member) in enumerate(members))
        for done, (k, result) in enumerate(finished, 1):
            results[k] = result
            if progress is not None:
                progress(done, len(members), members[k][0])
    return [(values, result) for (values, _), result in zip(members, results)]


# ---- functions of rsc.h without a method above ------------------------------------------------------------------------
def _plain(function):
    """A method that only calls `function`: inputs as arguments; returns its output, a tuple of several outputs, or None without outputs.
    None if there is no rule for its arguments."""
    rest = _FUNCTIONS[function][1:]
    inputs = [a for a in rest if a.stars == 0 or a.const]
    outputs = [a for a in rest if a.stars == 1 and not a.const]
    if any(
        a.stars > 1 or a.name == "n" or a.type in ("char", "void")
        for a in outputs + inputs
        if not a.const
    ) or any(
        a.type not in ("double", "int32_t", "int64_t", "char") and not a.stars for a in inputs
    ):
        return None

    def method(self, *values):
        if len(values) != len(inputs):
            raise TypeError(
                f"{function[4:]} takes {', '.join(a.name for a in inputs) or 'no argument'}"
            )
        given, made = iter(values), [_ctype(a._replace(stars=0))() for a in outputs]
        back = iter(made)
        _call(function, self, *[next(given) if a in inputs else next(back) for a in rest])
        return tuple(o.value for o in made) if len(made) > 1 else made[0].value if made else None

    method.__name__ = function[4:].partition("_")[2]
    method.__doc__ = f"{function} of rsc.h. values: {', '.join(a.name for a in inputs) or 'none'}. Returns {', '.join(a.name for a in outputs) or 'nothing'}; errors: see there."
    return method


for _class in (Surface, Asperities, Contact, Friction):
    for _name in [
        n
        for n in _FUNCTIONS
        if n.startswith(f"rsc_{_class._kind}_")
        and _FUNCTIONS[n][0].stars == 1
        and not n.endswith("_result")
    ]:
        _verb = _name[len(f"rsc_{_class._kind}_") :]
        if not hasattr(_class, _verb) and _verb not in ("count", "move_tip") and _plain(_name):
            setattr(_class, _verb, _plain(_name))
