"""Curves over the levels: force and number of contacts against separation, stiffness and resistance against force. Also draws the
additions to all curves: marks of levels, scatter over realizations, expected error, unloading."""

import numpy as np

from plot_results import Looks
from plot_style import FEW, Page, STYLES, label, plt


def curve(page, axis, result, look, x, y, scatter=None, error=None, alone=True):
    """Draws y over x, both over all levels, in the colour and line of `look`. scatter: name of the variable of which y is the mean; error:
    name of the variable whose expected error is drawn, if the result is the only one; alone: True for a single result.
    """
    line, colour, name = look
    status, meanings = result.level_status()
    drawn = (
        np.isfinite(x + y)
        & np.isin(np.arange(y.size), result.carrying())
        & ((y > 0) | (result.pulls() & (y < 0)))
    )
    for at, parting in result.branches():
        at = at[drawn[at]]
        axis.plot(
            x[at],
            y[at],
            ls=(0, (2, 1.5)) if parting and alone else ":" if parting else line,
            color=colour,
            lw=0.9 if parting else None,
            gid="unloading" if parting else "curve",
        )
        if parting and at.size:
            page.entry(
                "unloading",
                color=colour if alone else "0.3",
                ls=(0, (2, 1.5)) if alone else ":",
                lw=0.9,
            )
        if alone and scatter and result.realizations > 2 and not parting:
            low, high = np.nanpercentile(result[scatter][:, at], [16, 84], axis=0) * np.sign(
                np.nansum(y * result.mean(scatter))
            )
            band(page, axis, x[at], np.minimum(low, high), np.maximum(low, high), colour)
        if alone and error:
            error_band(
                page,
                axis,
                x[at],
                y[at],
                result.error(error)[at],
                "expected error of the model",
                color="#c1440e",
                alpha=0.18,
            )
    if name:
        page.entry(name, color=colour, ls=line)
    page.status(axis, x, np.where(drawn, y, np.nan), status, meanings, colour)


def band(page, axis, x, low, high, colour):
    """The scatter over realizations, if it is wide enough to be visible."""
    low = np.where(low != 0, low, np.nan)
    if (
        np.isfinite(low[1:] + low[:-1]).any()
        and np.nanmax((high - low) / abs(low), initial=0) > 0.06
    ):
        _fill(axis, x, low, high, color=colour, alpha=0.25, gid="scatter")
        page.entry("two thirds of the realizations", color=colour, alpha=0.25, lw=5)


def error_band(page, axis, x, y, off, text, **looks):
    """The band of the relative error `off` of y. It extends the axes by y at most, so that curves remain visible beside larger errors."""
    if off.max(initial=0) > 0.03:  # less is not visible
        limits, size = axis.dataLim.frozen(), abs(y)
        ends = np.maximum(y - off * size, -np.inf if (y < 0).any() else 0.02 * y), y + off * size
        _fill(axis, x, *ends, gid="error", **looks)
        axis.dataLim.set(limits)
        for end in ends:
            axis.update_datalim(np.column_stack([x, np.clip(end, y - size, y + size)]))
        page.entry(text, lw=5, **looks)


def _fill(axis, x, low, high, **looks):
    """Fills between low and high; where x turns back, draws bars, because bands of two branches would overlap."""
    if {-1, 1} <= set(np.sign(np.round(np.diff(x) / (np.ptp(x) or 1), 3))):
        axis.vlines(x, low, high, lw=4, **looks)
    else:
        axis.fill_between(x, low, high, lw=0, **looks)


def begin(results, options, count=1, **how):
    """The page and the line styles of the results, with a colour scale for many results."""
    page, looks = Page(options, count, **how), Looks(results)
    if looks.scale:
        page.scale(looks.scale)
    return page, looks.of


def panel_looks(page, results, names):
    """(marker, line, colour) of each of several sets of points with the given results and names, with their entries in the legend or their
    colour scale: along the keys that differ for many results, along the levels for many levels of one.
    """
    if len(results) <= FEW:
        for (marker, line, colour), name in zip(STYLES, names):
            page.entry(name, color=colour, marker=marker, ls=line, lw=1.0, mfc="none", ms=3)
        return STYLES[: len(results)]
    if len({r.path for r in results}) < len(results):
        colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(results)))
        levels = [name.split(":")[0].split(" (")[0].partition(" = ") for name in names]
        page.scale((levels[0][0], [value or symbol for symbol, _, value in levels], colours))
        return [("o", "-", colour) for colour in colours]
    looks = Looks(results)
    page.scale(looks.scale)
    markers = {line: marker for marker, line, _ in STYLES[3::-1]}
    for line, colour, name in looks.of:
        if name:
            page.entry(name, color=colour, marker=markers[line], ls=line, lw=1.0, mfc="none", ms=3)
    return [(markers[line], line, colour) for line, colour, _ in looks.of]


def title(results, what):
    if len(results) == 1:
        return results[0].heading(what)
    many = sorted({r.realizations for r in results if r.realizations > 1})
    return what + (f" (means over {'/'.join(map(str, many))} realizations)" if many else "")


def _many_decades(values):
    values = np.concatenate(values)
    if (values < 0).any():  # tension
        return False
    values = values[np.isfinite(values) & (values > 0)]
    return values.size > 0 and values.max() > 8 * values.min()


def load(results, options):
    """Force (for two flats nominal pressure) and number of contacts against separation."""
    results = [r for r in results if "contacts" in r and r.loaded().size and r.load_varies()]
    if not results:
        return None
    flat = all("pressure" in r for r in results)
    first, error = ("pressure", "nominal pressure $p$") if flat else ("force", "force $N$")
    page, looks = begin(results, options, 2)
    alone = len(results) == 1
    for axis, name in zip(page.axes, (first, "contacts")):
        for result, look in zip(results, looks):
            curve(
                page,
                axis,
                result,
                look,
                result.depth()[0],
                result.mean(name),
                scatter=name,
                error="force" if name == first else None,
                alone=alone,
            )
        axis.dataLim.update_from_data_x(
            page.axes[0].dataLim.intervalx, ignore=False
        )  # both over the same separations
        axis.set_yscale(
            "log" if _many_decades([r.mean(name)[r.carrying()] for r in results]) else "linear"
        )
        if name == "contacts" and axis.get_yscale() == "linear":
            axis.yaxis.get_major_locator().set_params(integer=True)
        axis.invert_xaxis()  # the bodies approach from left to right
        label(axis, "x", *results[0].depth()[1:])
        label(
            axis, "y", error if name == first else "number of contacts", results[0].dimension(name)
        )
    return page.finish(
        title(results, f"{'Nominal pressure' if flat else 'Force'} and contacts against separation")
    )


def _against_force(results, options, name, sign, text, what):
    results = [
        r
        for r in results
        if name in r and np.isfinite(r.mean(name)[r.loaded()]).any() and r.load_varies()
    ]
    if not results:
        return None
    page, looks = begin(results, options)
    axis = page.axes[0]
    for result, look in zip(results, looks):
        curve(
            page,
            axis,
            result,
            look,
            result.mean("force"),
            sign * result.mean(name),
            scatter=name,
            alone=len(results) == 1,
        )
    for which, values, by in (("x", "force", 1), ("y", name, sign)):
        getattr(axis, f"set_{which}scale")(
            "log"
            if _many_decades([by * r.mean(values)[r.carrying()] for r in results])
            else "linear"
        )
    label(axis, "x", "force $N$", results[0].dimension("force"))
    label(axis, "y", text, results[0].dimension(name))
    return page.finish(title(results, what))


def stiffness(results, options):
    """Normal stiffness against force."""
    return _against_force(
        results,
        options,
        "stiffness",
        -1,
        r"stiffness $-\mathrm{d}N/\mathrm{d}Z_0$",
        "Stiffness against force",
    )


def resistance(results, options):
    """Constriction resistance against force, if resistivities are given."""
    return _against_force(
        results,
        options,
        "resistance",
        1,
        "constriction resistance",
        "Constriction resistance against force",
    )
