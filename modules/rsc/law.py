"""The law of an interface: what lubrication, finite-element and particle codes need of a rough
contact, read from the text that output/export/law.py writes (--text), or from its NetCDF form.

    from rsc.law import Law                              # or copy this file: it needs numpy only
    law = Law("seal.law")
    p, dp_dgap, where = law.evaluate("pressure", gap=[0.5e-3, 1.0e-3])
    k, dk_dp, where = law.evaluate("permeability_x", pressure=0.2)

Form of the text: comments begin with #, each other line is a row of numbers, in the order of
increasing gap or approach. The first line is "# rsc law 1", and each column has a line

    # column NAME UNIT WORD WORD: meaning

whose words say how it is interpolated against the first and against the second column:

    power        its logarithm against that of the abscissa
    exponential  its logarithm against the abscissa
    logarithmic  the column itself against the logarithm of the abscissa
    linear       the column itself against the abscissa
    -            not against this column

In these coordinates it is a piecewise cubic with a continuous slope that never leaves the interval
between neighbouring rows (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980), and continues
straight on beyond the first and the last row. A column interpolated by its logarithm that is 0 at
one end of an interval is itself the cubic there. With the suffix "-to-1" (as in power-to-1) a
column does not cross 1 beyond the rows, but approaches it exponentially in these coordinates;
likewise a column that is logarithmic or linear approaches 0. modules/rsc_law.f90 and
modules/rsc_law.h evaluate the same text to the same numbers."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

_LOG_VALUE = {"power": True, "exponential": True, "logarithmic": False, "linear": False}
_LOG_ABSCISSA = {"power": True, "exponential": False, "logarithmic": True, "linear": False}
# What the coefficients of a piece are of: the value, its logarithm; beyond the rows also c0
# exp(c1/c0 t) as the value, or as its logarithm.
_VALUE, _LOGARITHM, _DECAY, _LOG_DECAY = range(4)


class LawError(ValueError):
    """A file is no law, or a column, word or argument is wrong; the message says which."""


class Column:
    """name, unit, meaning; words: how it is interpolated against the first two columns; values: a
    number for each row."""

    def __init__(self, name: str, unit: str, words: tuple[str, str], meaning: str) -> None:
        self.name, self.unit, self.words, self.meaning = name, unit, words, meaning
        self.values = np.empty(0)


class Law:
    """The law in a file; it does not change, so that any threads may share it."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """path: text of a law, or the NetCDF form, which needs netCDF4. Raises LawError with the
        file and the line if it is not a law, OSError if it cannot be read."""
        self.path = os.fspath(path)
        with open(self.path, "rb") as file:
            start = file.read(4)
        netcdf = start == b"\x89HDF" or start[:3] == b"CDF"
        self.columns = _of_netcdf(self.path) if netcdf else _of_text(self.path)
        self._index = {column.name: k for k, column in enumerate(self.columns)}
        self._curves: dict[tuple[int, int], _Curve] = {}
        for k, column in enumerate(self.columns):
            for axis in (0, 1):
                word = column.words[axis]
                if word != "-" and axis != k:
                    try:
                        self._curves[k, axis] = _Curve(
                            self.columns[axis].values, column.values, word
                        )
                    except LawError as error:
                        raise LawError(f"{self.path}: column {column.name}: {error}") from None

    def __repr__(self) -> str:
        names = ", ".join(column.name for column in self.columns)
        return f"<Law {self.path!r}: {len(self.columns[0].values)} rows of {names}>"

    def evaluate(self, name: str, **at: Any) -> tuple[Any, Any, Any]:
        """The column `name` at values of one of the first two columns, which is named as in
        evaluate("pressure", gap=[...]). Returns the values, their slopes with respect to the
        argument, and integers: -1 below the rows, 0 within, 1 beyond; arrays of the argument's
        shape, or numbers. Raises LawError for unknown columns, and for arguments without a finite
        value: NaN, 0 where the column has no limit, too far beyond the rows."""
        if len(at) != 1:
            raise LawError("evaluate() needs one argument such as gap=[...]")
        axis, argument = next(iter(at.items()))
        curve = self._curves.get((self._index.get(name, -1), self._index.get(axis, -1)))
        if curve is None:
            known = ", ".join(
                f"{self.columns[k].name} against {self.columns[a].name}" for k, a in self._curves
            )
            raise LawError(f"{self.path} has no {name} against {axis}; it has {known}")
        x = np.asarray(argument, dtype=float)
        value, slope, where = curve.evaluate(x.ravel())
        wrong = ~(np.isfinite(value) & np.isfinite(slope))
        if wrong.any():
            raise LawError(
                f"{self.path}: {name} has no value at {axis} = {x.ravel()[wrong][0]!r}"
            )
        if x.ndim == 0:
            return float(value[0]), float(slope[0]), int(where[0])
        return value.reshape(x.shape), slope.reshape(x.shape), where.reshape(x.shape)


class _Curve:
    """A column against an abscissa: nodes, and for the piece before, between and after them its
    form and its coefficients in the distance from its node."""

    def __init__(self, x: Any, y: Any, word: str) -> None:
        word, _, self.to_one = word.partition("-")
        if word not in _LOG_VALUE or self.to_one not in ("", "to-1"):
            raise LawError(f"the word {word!r} is none of {', '.join(_LOG_VALUE)}, -")
        self.log_value, self.log_x = _LOG_VALUE[word], _LOG_ABSCISSA[word]
        if x[0] > x[-1]:
            x, y = x[::-1], y[::-1]
        if self.log_x:
            x, y = x[x > 0], y[x > 0]
        if x.size < 2 or not np.all(np.diff(x) > 0):
            raise LawError("the abscissa does not increase or decrease over two rows or more")
        if self.log_value and np.any(y < 0):
            raise LawError("negative, but interpolated by its logarithm")
        self.x, self.y = np.log(x) if self.log_x else x, y
        # Where the column is 0 it has no logarithm.
        self.positive = y > 0 if self.log_value else np.full(y.shape, True)
        self.raised = np.log(np.where(self.positive, y, 1)) if self.log_value else y
        self._pieces()

    def _secant(self, k: int, of: int) -> float:
        """Slope over the interval k in the coordinates of its end `of`, which is not 0 there."""
        h = self.x[k + 1] - self.x[k]
        if self.positive[k] and self.positive[k + 1]:
            return (self.raised[k + 1] - self.raised[k]) / h
        return (-1 if of == k else 1) / h

    def _slope(self, i: int) -> float:
        """That of a parabola through three nodes, limited so that each cubic is monotonic."""
        n = self.x.size
        if not self.positive[i]:
            return 0.0
        if 0 < i < n - 1:
            left, right = self._secant(i - 1, i), self._secant(i, i)
            before, after = self.x[i] - self.x[i - 1], self.x[i + 1] - self.x[i]
            m = (after * left + before * right) / (before + after)
            most = 3 * min(abs(left), abs(right)) if left * right > 0 else 0
            return max(-most, min(most, m))
        own, other = (0, 1) if i == 0 else (n - 2, n - 3)
        d = m = self._secant(own, i)
        neighbour = 1 if i == 0 else n - 2
        if n > 2 and self.positive[neighbour]:
            h, beyond = self.x[own + 1] - self.x[own], self.x[other + 1] - self.x[other]
            m = d + (d - self._secant(other, neighbour)) * h / (h + beyond)
        most = 3 * abs(d) if m * d > 0 else 0
        return max(-most, min(most, m))

    def _pieces(self) -> None:
        n = self.x.size
        slopes = [self._slope(i) for i in range(n)]
        self.form, self.c = np.full(n + 1, _VALUE, np.int8), np.zeros((4, n + 1))
        self.from_x = np.append(self.x[0], self.x)
        self.where = np.zeros(n + 1, int)
        self.where[0], self.where[-1] = -1, 1
        for k in range(n - 1):
            log = self.log_value and self.positive[k] and self.positive[k + 1]
            y = self.raised if log else self.y
            m = [
                slopes[i] * (1 if log or not self.log_value else self.y[i]) for i in (k, k + 1)
            ]
            h = self.x[k + 1] - self.x[k]
            d = (y[k + 1] - y[k]) / h
            self.form[k + 1] = _LOGARITHM if log else _VALUE
            self.c[:, k + 1] = (
                y[k],
                m[0],
                (3 * d - 2 * m[0] - m[1]) / h,
                (m[0] + m[1] - 2 * d) / (h * h),
            )
        for piece, i, side in ((0, 0, -1), (n, n - 1, 1)):
            if not self.positive[i]:
                continue
            y, m = self.raised[i], slopes[i]
            decays = (self.to_one or not self.log_value) and y * m * side < 0
            self.form[piece] = (_LOGARITHM if self.log_value else _VALUE) + 2 * int(decays)
            self.c[:2, piece] = y, m

    def _limit(self) -> float:
        """At abscissas of 0 and below, where the logarithm does not exist; NaN: none."""
        form, (y, m) = self.form[0], self.c[:2, 0]
        if m == 0:
            return float(np.exp(y) if form == _LOGARITHM else y)
        return {_VALUE: np.nan, _LOGARITHM: 0.0 if m > 0 else np.nan, _DECAY: 0.0}.get(form, 1.0)

    def evaluate(self, x: Any) -> tuple[Any, Any, Any]:
        """In parts that stay in the processor's cache."""
        parts = [self._part(x[k : k + 4096]) for k in range(0, max(x.size, 1), 4096)]
        value, slope, where = zip(*parts)
        return np.concatenate(value), np.concatenate(slope), np.concatenate(where)

    def _part(self, x: Any) -> tuple[Any, Any, Any]:
        with np.errstate(all="ignore"):
            at = np.log(x) if self.log_x else x
            piece = np.searchsorted(self.x[:-1], at, side="right")
            piece += at > self.x[-1]
            t = at - self.from_x[piece]
            c0, c1, c2, c3 = self.c[0][piece], self.c[1][piece], self.c[2][piece], self.c[3][piece]
            value = ((c3 * t + c2) * t + c1) * t + c0
            slope = (3 * c3 * t + 2 * c2) * t + c1
            form = self.form[piece]
            if form.max() >= _DECAY:
                decays = form >= _DECAY
                factor = np.exp(c1[decays] / c0[decays] * t[decays])
                value[decays], slope[decays] = c0[decays] * factor, c1[decays] * factor
            if self.log_value:
                raised, logs = np.exp(value), form % 2 == 1
                value = np.where(logs, raised, value)
                slope *= np.where(logs, raised, 1)
            if self.log_x:
                slope /= x
                if not x.min() > 0:
                    none = x <= 0
                    value[none], slope[none], piece[none] = self._limit(), 0, 0
        return value, slope, self.where[piece]


def _of_text(path: str) -> list[Column]:
    columns: list[Column] = []
    rows: list[list[float]] = []
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            where = f"{path}, line {number}: "
            if number == 1 and words != ["#", "rsc", "law", "1"]:
                raise LawError(where + "the text of a law begins with '# rsc law 1'")
            if words[:2] == ["#", "column"]:
                head, _, meaning = line.partition(":")
                words = head.split()
                if len(words) != 6:
                    raise LawError(where + "expected '# column NAME UNIT WORD WORD: meaning'")
                columns.append(Column(words[2], words[3], (words[4], words[5]), meaning.strip()))
            elif words and not words[0].startswith("#"):
                try:
                    rows.append([float(word) for word in words])
                except ValueError:
                    raise LawError(where + "a word is not a number") from None
                if len(words) != len(columns) or not np.all(np.isfinite(rows[-1])):
                    raise LawError(where + f"expected {len(columns)} finite numbers")
    if len(columns) < 2 or len(rows) < 2:
        raise LawError(f"{path}: a law has two columns and two rows at least")
    for column, values in zip(columns, np.array(rows).T):
        column.values = values.copy()
    return columns


def _of_netcdf(path: str) -> list[Column]:
    from netCDF4 import Dataset

    columns = []
    with Dataset(path) as file:
        if "law" not in file.ncattrs():
            raise LawError(f"{path}: it is no law: it lacks the attribute 'law'")
        for name in file.law.split():
            variable = file[name]
            column = Column(
                name,
                variable.units,
                tuple(variable.interpolation.split()),
                variable.long_name,
            )
            column.values = np.ma.filled(variable[:].astype(float), np.nan)
            columns.append(column)
    return columns
