"""Options by the names of the program's namelist, runs of the program, and studies."""

from __future__ import annotations

import atexit
import contextlib
import ctypes
import itertools
import os
import re
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypeVar, Union

import numpy as np

from ._library import (
    NotConverged,
    _call,
    _number,
    _Object,
    _refuse,
    _refuse_masked,
    _text,
    _Watch,
    lock,
)

#: What a key of a case may be set to, and what a Case may be made from.
Value = Union[float, str, bool, None, Sequence[Any], np.ndarray]
Source = Union["Case", Mapping[str, Any], str, "os.PathLike[str]", None]
_Result = TypeVar("_Result")


_running: set[tuple[threading.Event, threading.Event]] = set()  # to stop each run, and its end


@atexit.register
def _stop_runs() -> None:
    """Ends the runs of daemon threads while the interpreter still runs, which they call."""
    for stop, done in list(_running):
        stop.set()
        done.wait()


def keys() -> list[str]:
    """The names of all keys of a case, 'group%key', a list of texts in the order of the
    documentation (rsc --describe)."""
    return [_text("rsc_key_name", k) for k in range(_number("rsc_key_count"))]


def _namelist_value(name: str, value: Any) -> str:
    """A Python value in namelist syntax."""
    _refuse_masked(name, value)
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


def _python_value(text: str) -> Any:
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
    """Every option, by the names of the program's namelist (rsc --describe); all initially at their
    defaults.

    Case(source): source is a dictionary {"surface": {"sigma": 0.01}} or {"surface%sigma": 0.01}, a
    namelist text as the program reads it ("&surface sigma=0.01 /"), the path of a namelist file (a
    pathlib.Path, or a text without & and $), another Case, or None. Values are numbers, texts,
    True, False, lists of these, or None for the default. case["surface%sigma"] reads a value (None:
    not set; a tuple: several) and sets it. str(case) is the whole case as a namelist. Raises
    ArgumentError with a line for every invalid key or value."""

    __slots__ = ()
    _kind = "case"

    def _about(self) -> str:
        with Case() as default:
            changed = [k for k in keys() if self[k] != default[k]]
        return ", ".join(f"{k} = {self[k]!r}" for k in changed) or "the defaults"

    def __init__(self, source: Source = None) -> None:
        if isinstance(source, Case):
            self._create("rsc_case_copy", source)
            return
        self._create("rsc_case_create")
        if isinstance(source, str) and ("&" in source or "$" in source):
            self.read(source)
        elif isinstance(source, (str, os.PathLike)):
            self.read_file(source)
        elif source is not None:
            self.update(source)

    def read(self, text: str) -> None:
        """Sets all keys from the namelist `text`; keys that are not in it get their defaults.
        Raises ArgumentError; the case is then unchanged."""
        _call("rsc_case_read", self, text)

    def read_file(self, path: str | os.PathLike[str]) -> None:
        """Sets all keys from the namelist in the file `path`. Raises ArgumentError as read does,
        and for a file that cannot be read."""
        _call("rsc_case_read_file", self, os.fspath(path))

    def update(self, source: Mapping[str, Any]) -> None:
        """Sets the keys of a dictionary `source`, {"surface": {"sigma": 0.01}} or {"surface%sigma":
        0.01}. Raises ArgumentError, the case then being unchanged."""
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

    def __setitem__(self, name: str, value: Value) -> None:
        """Sets one key: `name` "group%key", "group%key(2)" or "group%key(1:2)", `value` as above.
        Raises ArgumentError."""
        _call("rsc_case_set", self, name, _namelist_value(name, value))

    def __getitem__(self, name: str) -> Any:
        """The value of the key `name`; None if it is not set. Raises ArgumentError for an unknown
        name."""
        return _python_value(_text("rsc_case_get", self, name))

    def text(self) -> str:
        """All keys with their values, as namelist text for the program and read()."""
        return _text("rsc_case_text", self)

    __str__ = text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self.text() == other.text()

    __hash__ = None  # type: ignore[assignment]

    def run(
        self,
        file: str | os.PathLike[str] | None = None,
        progress: Callable[[float, float], object] | None = None,
        resume: bool = False,
    ) -> str:
        """Runs the case as the program does, writes its result file and returns the path of it;
        read(path) reads it. Prints nothing.

        file: path of the result file; by default that of the key output%file. Paths are relative to
        the working directory. progress: called as progress(done, total) by this thread about twenty
        times a second, with numbers of levels, or of realizations if there are several. Its
        exceptions, and Ctrl-C, stop the run and are raised again; then no result is written.
        resume: True continues an interrupted campaign from its checkpoint, or adds realizations to
        a finished one.

        Raises ArgumentError for an invalid case, NotConverged if some levels did not converge (the
        file is written; the number is error.failed_levels), Error for a file that cannot be written
        or lack of memory."""
        case = self
        if file is not None:
            case = self.copy()
            case["output%file"] = os.fspath(file)
        # Python handles Ctrl-C only in its main thread, and not during a library call; therefore
        # another thread runs the case. Not Thread.join: if Ctrl-C interrupts it, Python 3.11
        # considers the thread as ended.
        failed, stop, done = ctypes.c_int64(), threading.Event(), threading.Event()
        seen: list[float] = []
        raised: list[BaseException] = []
        function = "rsc_case_resume" if resume else "rsc_case_run_watched"

        def watch(done, total, _):
            seen[:] = [done, total]
            return stop.is_set()

        def work():
            try:
                _call(function, case, _Watch(watch), None, failed)
            except BaseException as error:
                raised.append(error)
            finally:
                _running.discard((stop, done))
                done.set()

        # NetCDF suppresses HDF5's messages in the first thread that uses it, the lock in this one,
        # which may read the result.
        _running.add((stop, done))
        with lock():
            threading.Thread(target=work, daemon=True).start()
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


def study(
    case: Source,
    over: Mapping[str, Sequence[Any]],
    run: Callable[[Case], _Result],
    mode: Literal["product", "zip"] = "product",
    threads: int = 1,
    progress: Callable[[int, int, dict[str, Any]], object] | None = None,
) -> list[tuple[dict[str, Any], _Result]]:
    """Runs a function on every member of a study and returns a list of (values, result), in the
    order of the members. case: a Case, or an argument of Case(); over: {"surface%sigma": [0.005,
    0.01], ...}, lists of values for keys; run: called as run(member) with the Case of the member,
    for instance a function that returns a contact's curve; mode: 'product' for every combination
    (the last key varying fastest), 'zip' for the k-th values of all lists together; threads: number
    of members at a time; progress: called as progress(done, n, values) after each member, always in
    the caller's thread. Exceptions of run and progress end the study and are raised again. Raises
    ArgumentError for invalid keys or values, before anything runs."""
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
    results: list[Any] = [None] * len(members)
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
