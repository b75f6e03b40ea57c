"""librsc loaded by ctypes: errors, locks of objects, and calls that convert and check arguments."""

from __future__ import annotations

import collections
import contextlib
import ctypes
import ctypes.util
import glob
import operator
import os
import re
import sys
import threading
from collections.abc import Iterator
from typing import Any, NoReturn, TypeVar

try:
    import numpy as np
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        f"rsc needs numpy, which {sys.executable} lacks: install it there, or use another Python "
        "that has it (Debian: package python3-numpy, /usr/bin/python3)",
        name=error.name,
    ) from None

from . import _h
from ._h import NO_RESULT, NOT_CONVERGED, SUCCESS

# The arguments of each function, as declared in rsc.h (all return int32_t). They determine the
# ctypes, the checks of the arguments by name, and whether a call reads (const) or changes an one.
_Argument = collections.namedtuple("_Argument", "const type stars name")


_INTEGERS = {
    "int32_t": (ctypes.c_int32, np.int32, 2**31),
    "int64_t": (ctypes.c_int64, np.int64, 2**63),
}


class Error(Exception):
    """A call of the library failed. str(error) is the library's message; error.status its status:
    above 0, a NOT_CONVERGED, NO_MEMORY, FILE, NO_RESULT or INTERNAL of this module; below 0, the
    number of the wrong argument in rsc.h (see ArgumentError)."""

    def __init__(self, message: str, status: int = 0) -> None:
        super().__init__(message)
        self.status = status


class ArgumentError(Error, ValueError):
    """An argument is wrong; the message names it. Both an Error and a ValueError. error.status is
    below 0 if the library found it."""


class NotConverged(Error):
    """The solver did not reach its tolerance. The last iterate of the object can be read; after
    Case.run the file is written, and error.failed_levels is the number of levels that failed."""

    failed_levels: int | None = None


def _parse(prototypes):
    """{function: [_Argument, ...]} of prototypes in C."""
    functions = {}
    for name, arguments in re.findall(r"(\w+)\((.*?)\)", prototypes, flags=re.DOTALL):
        functions[name] = []
        for argument in filter(None, " ".join(arguments.split()).split(",")):
            const, kind, stars, word = re.fullmatch(
                r"\s*(const )?(\w+)(\**)\s+(\w+)", argument
            ).groups()
            functions[name].append(_Argument(bool(const), kind, len(stars), word))
    return functions


_FUNCTIONS = _parse(_h.PROTOTYPES)


def _ctype(argument):
    """The argument types for ctypes: numbers by value; everything else is an address, created and
    checked by _convert."""
    if argument.stars or argument.type.startswith("rsc_"):  # an address, or a callback
        return ctypes.c_void_p
    return ctypes.c_double if argument.type == "double" else _INTEGERS[argument.type][0]


def _library_paths():
    if os.environ.get("RSC_LIBRARY"):
        yield os.environ["RSC_LIBRARY"]
        return
    folder = os.path.dirname(os.path.abspath(__file__))
    for _ in range(6):
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
            "rsc: librsc was not found; install it (cmake --install build) or set RSC_LIBRARY to "
            "the path of librsc.so"
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
                f"rsc: {path} has no function {name}: its version differs from that of this package"
            ) from None
        function.argtypes = [_ctype(a) for a in arguments]
        function.restype = ctypes.c_int32
    return library, path


shared_object, shared_object_path = _load()


_Watch = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_double, ctypes.c_double, ctypes.c_void_p)


_forks = 0  # of which this process is the child


def _count_fork():
    global _forks
    _forks += 1


os.register_at_fork(after_in_child=_count_fork)


class _Lock:
    """Lock for many readers or one writer. A waiting writer blocks new readers. In the child of a
    fork, a lock that another thread held can never be acquired."""

    def __init__(self):
        self._lost = False
        self._renew()

    def _renew(self):
        self._gate, self._busy, self._count = threading.Lock(), threading.Lock(), threading.Lock()
        self._readers = 0
        self._forks = _forks

    def acquire(self, shared):
        if self._forks != _forks:
            self._lost = self._lost or self._busy.locked()
            self._renew()
        if self._lost:
            raise Error(
                "this object was in use by another thread when the process was forked: its state "
                "in the child is unknown"
            )
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


_Same = TypeVar("_Same", bound="_Object")


class _Object:
    """Owner of a handle of the library."""

    __slots__ = ("_handle", "_lock", "__weakref__")  # contact.tpi = ... is an error
    _kind: str  # "case" of rsc_case

    def __init__(self, *_: object) -> None:
        raise TypeError(f"rsc.{type(self).__name__}: use one of its class methods")

    def _create(self, function: str, *arguments: Any) -> None:
        self._handle, self._lock = ctypes.c_void_p(), _Lock()
        _call(function, ctypes.byref(self._handle), *arguments)

    def _about(self) -> str:
        """What repr() says of an open object."""
        raise NotImplementedError

    @classmethod
    def _make(cls: type[_Same], function: str, *arguments: Any) -> _Same:
        self = cls.__new__(cls)
        self._create(function, *arguments)
        return self

    def copy(self: _Same) -> _Same:
        """An independent copy of this object, that of a contact with its last level, path and
        committed state. Raises Error (no memory), ValueError (closed)."""
        return type(self)._make(f"rsc_{self._kind}_copy", self)

    def close(self) -> None:
        """Releases the memory, after calls of other threads on this object. Closing twice is
        allowed; any other use afterwards raises ValueError."""
        if getattr(self, "_handle", None):
            self._lock.acquire(shared=False)
            try:
                if self._handle:
                    getattr(shared_object, f"rsc_{self._kind}_destroy")(ctypes.byref(self._handle))
            finally:
                self._lock.release(shared=False)

    @property
    def closed(self) -> bool:
        """True after close()."""
        return not getattr(self, "_handle", None)

    def __repr__(self) -> str:
        try:
            about = "closed" if self.closed else self._about()
        except Error as error:
            about = "no result yet" if error.status == NO_RESULT else str(error)
        return f"<rsc.{type(self).__name__}: {about}>"

    def __enter__(self: _Same) -> _Same:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self):
        with contextlib.suppress(Exception):  # the interpreter may be shutting down
            self.close()

    def __reduce__(self):
        raise TypeError(
            f"rsc.{type(self).__name__} cannot be pickled, because it belongs to this process; "
            "pickle the text of its case or its arrays"
        )

    def __copy__(self: _Same) -> _Same:
        return self.copy()

    def __deepcopy__(self: _Same, _: object) -> _Same:
        return self.copy()


def _refuse(name: str, what: str) -> NoReturn:
    raise ArgumentError(f"{name}: {what}")


def _given(name, value):
    if value is None:
        _refuse(name, "an object is expected, not None")
    return value


def _refuse_masked(name: str, value: Any) -> None:
    """Refuses masked arrays with masked values, also in a list."""
    values = value if isinstance(value, (list, tuple)) else [value]
    if any(isinstance(v, np.ma.MaskedArray) and np.ma.is_masked(v) for v in values):
        _refuse(name, "some of its values are masked: fill or remove them")


def _array(name: str, value: Any, shape: Any = None, dtype: Any = np.float64) -> Any:
    """The array itself if it needs no conversion; lists and numbers are converted. 1-D slices with
    a stride are copied."""
    _refuse_masked(name, value)
    if not isinstance(value, np.ndarray):
        try:
            value = np.array(value, dtype=dtype)
        except (TypeError, ValueError):
            _refuse(name, "numbers are expected")
    if value.dtype != dtype:
        wanted = np.dtype(dtype).name
        _refuse(
            name,
            f"an array of {wanted} is expected, not of {value.dtype}; "
            f"numpy.asarray({name}, '{wanted}') makes one",
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


def _output(name, array, shape):
    if not isinstance(array, np.ndarray):
        _refuse(name, "a numpy array is expected")
    if not array.flags.c_contiguous:
        _refuse(name, "an array in C order is expected")
    return _array(name, array, shape)


def _convert(argument, value):
    """A Python value converted for ctypes, and objects that must exist until the call ends."""
    name, kind = argument.name, argument.type
    _refuse_masked(name, value)
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
        wanted = np.float64 if kind == "double" else _INTEGERS[kind][1]
        if value.dtype != wanted:
            _refuse(name, f"an array of {np.dtype(wanted).name} is expected, not of {value.dtype}")
        if not value.flags.c_contiguous:
            _refuse(
                name,
                f"an array in C order is expected (x fastest, no gaps); "
                f"numpy.ascontiguousarray({name}) makes one",
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


def _call(function: str, *values: Any) -> None:
    """Calls a function of rsc.h: converts and checks the values, locks the objects among them,
    raises errors."""
    arguments = _FUNCTIONS[function]
    converted: list[Any] = []
    alive: list[Any] = []
    objects: list[tuple[_Object, bool, str]] = []
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
                        f"an object of rsc.{argument.type[4:].capitalize()} is expected, "
                        f"not {type(one).__name__}",
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
        status = getattr(shared_object, function)(*[_handles(v) for v in converted])
    finally:
        for value, const in held:
            value._lock.release(const)
    if status != SUCCESS:
        message = _text("rsc_message") or f"{function}: status {status}"
        kind = ArgumentError if status < 0 else NotConverged if status == NOT_CONVERGED else Error
        raise kind(message, status)


def _text(function: str, *values: Any) -> str:
    """The text output of a function."""
    size = 4096
    while True:
        buffer, length = ctypes.create_string_buffer(size), ctypes.c_int64()
        _call(function, *values, buffer, size, length)
        if length.value < size:
            return buffer.value.decode("utf-8", "replace")
        size = length.value + 1


def _numbers(function: str, *values: Any) -> Any:
    """The scalar outputs of a function that follow the values, a tuple."""
    outputs = [_ctype(a._replace(stars=0))() for a in _FUNCTIONS[function][len(values) :]]
    _call(function, *values, *outputs)
    return tuple(o.value for o in outputs)


def _number(function: str, *values: Any) -> Any:
    """The same for a single output."""
    return _numbers(function, *values)[0]


@contextlib.contextmanager
def lock() -> Iterator[None]:
    """with rsc.lock(): prevents rsc from calling NetCDF, HDF5 and FFTW's planner while this thread
    uses them (netCDF4, h5py), because they are not thread-safe. read() takes the lock itself."""
    _call("rsc_lock")
    try:
        yield
    finally:
        _call("rsc_unlock")


def version() -> str:
    """The version of librsc, a text 'major.minor.patch'."""
    return _text("rsc_version")
