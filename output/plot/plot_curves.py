"""Curves over the levels: force and number of contacts against approach, stiffness and resistance
against force. Also draws the additions to all curves: marks of levels, scatter over realizations,
errors, unloading."""

import numpy as np

from plot_results import Looks
from plot_style import FEW, GREY, Page, STYLES, label, plt


def curve(page, axis, result, look, x, y, name=None, over=None, alone=True):
    """Draws y over x, both over all levels, in the colour and line of `look`. name: the variable of
    which y is the mean, or a multiple of it, for its scatter and error; over: the variable of which
    x is the mean, if it differs between realizations; alone: True for a single result."""
    line, colour, text = look
    drawn = (
        np.isfinite(x + y)
        & np.isin(np.arange(y.size), result.carrying())
        & ((y > 0) | (result.pulls() & (y < 0)))
    )
    few = dict(marker=".", ms=4) if result.steps <= 30 else {}
    for at, parting in result.branches():
        at = at[drawn[at]]
        axis.plot(
            x[at],
            y[at],
            ls=(0, (2, 1.5)) if parting and alone else ":" if parting else line,
            color=colour,
            lw=0.9 if parting else None,
            gid="unloading" if parting else "curve",
            **few,
        )
        if parting and at.size:
            page.entry(
                "unloading",
                color=colour if alone else "0.3",
                ls=(0, (2, 1.5)) if alone else ":",
                lw=0.9,
            )
        if not name or at.size == 0 or result[name].ndim < 2:
            continue
        errors = result.error(name)[at] * abs(y[at])
        if result.realizations > 2 and not parting:
            values = _realizations(result, name, over, x, y, at)
            low, high = np.nanpercentile(values, [16, 84], axis=0)
            if page.results <= FEW:  # bands of more would cover each other
                band(page, axis, x[at], low, high, colour, 0.25 if alone else 0.12)
            if not alone:
                errors = result.standard_error(values)
        if alone:
            error_band(
                page,
                axis,
                x[at],
                y[at],
                errors,
                "expected error of the model",
                color="#c1440e",
                alpha=0.18,
            )
        elif (errors > 0.01 * abs(y[at])).any():
            bars(page, axis, x[at], y[at], errors, result, colour)
    if text:
        page.entry(text, color=colour, ls=line)
    page.status(axis, x, np.where(drawn, y, np.nan), result, colour)


def bars(page, axis, x, y, errors, result, colour):
    """Error bars, of at most the value itself where axes are logarithmic."""
    if axis.get_yscale() == "log":
        errors = [np.minimum(errors, 0.9 * abs(y)), errors]
    every = slice(None, None, -(-x.size // 15))
    x, y, errors = x[every], y[every], np.atleast_2d(errors)[:, every]
    looks = dict(ecolor=colour, elinewidth=0.8, capsize=1.5, gid="bars")
    axis.errorbar(x, y, np.broadcast_to(errors, (2, x.size)), fmt="none", **looks)
    many = result.realizations > 2
    what = "standard error of the mean" if many else "expected error of one realization"
    page.entry("bars: " + what, marker="|", color=GREY, ls="none", ms=6)


def _realizations(result, name, over, x, y, at):
    """The values of y of every realization at these levels; where x differs between realizations,
    moved to the mean of x along the tangent of the curve."""
    mean = result.mean(name)[at]
    values = result[name][:, at] * np.divide(y[at], mean, out=np.ones(at.size), where=mean != 0)
    if over and at.size > 1 and (x[at] > 0).all() and (y[at] > 0).all():
        apart = np.gradient(np.log(x[at]))
        slope = np.gradient(np.log(y[at])) / np.where(apart != 0, apart, np.inf) * y[at] / x[at]
        values = values - slope * (result[over][:, at] - x[at])
    return np.where(np.isnan(values).all(axis=0), y[at], values)


def band(page, axis, x, low, high, colour, alpha):
    """The scatter over realizations, if it is wide enough to be visible."""
    low = np.where(low != 0, low, np.nan)
    if axis.get_yscale() == "log":
        low = np.where(low > 0, low, np.nan)
    if (
        np.isfinite(low[1:] + low[:-1]).any()
        and np.nanmax((high - low) / abs(low), initial=0) > 0.06
    ):
        _fill(axis, x, low, high, color=colour, alpha=alpha, gid="scatter")
        page.entry("two thirds of the realizations", color=colour, alpha=0.25, lw=5)


def error_band(page, axis, x, y, off, text, **looks):
    """The band of the error `off` of y. It extends the axes by y at most, so that curves remain
    visible beside larger errors."""
    size = abs(y)
    if (off > 0.06 * size).any():  # less is not visible
        limits = axis.dataLim.frozen()
        ends = np.maximum(y - off, -np.inf if (y < 0).any() else 0.02 * y), y + off
        _fill(axis, x, *ends, gid="error", **looks)
        axis.dataLim.set(limits)
        for end in ends:
            axis.update_datalim(np.column_stack([x, np.clip(end, y - size, y + size)]))
        if text:
            page.entry(text, lw=5, **looks)
        else:
            page.entry("bands: expected error of the model", color=GREY, lw=5, alpha=0.25)


def _fill(axis, x, low, high, **looks):
    """Fills between low and high; where x turns back, draws bars, because bands of two branches
    would overlap."""
    if {-1, 1} <= set(np.sign(np.round(np.diff(x) / (np.ptp(x) or 1), 3))):
        axis.vlines(x, low, high, lw=4, **looks)
    else:
        axis.fill_between(x, low, high, lw=0, **looks)


def begin(results, options, count=1, **how):
    """The page and the line styles of the results, with a colour scale for many results."""
    page, looks = Page(options, count, **how), Looks(results)
    page.results = len(results)
    if looks.scale:
        page.scale(looks.scale)
    return page, looks.of


def panel_looks(page, results, names):
    """(marker, line, colour) of each of several sets of points with the given results and names,
    with their entries in the legend or their colour scale: along the keys that differ for many
    results, along the levels for many levels of one."""
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


def hertz_force(result, approach):
    """Force of the smooth ball at an approach, of which the mean plane is the origin."""
    return 4 / 3 * result["e_star"] * np.sqrt(result["r_star"]) * np.maximum(approach, 0) ** 1.5


def hertz_line(result, approach):
    """Force of the smooth cylinder in line contact at an approach. A load P per length, pressed on
    the width 2 b with the pressure of Hertz, lowers the middle by 2 P/(pi E*) [ln(2 D/b) + 1/2],
    where D is line_reference (output/README). Results before 0.5 lack it: their D is
    2 L exp(-0.5772)."""
    length = np.nanmax(result.mean("force") / result.mean("force_per_length"))
    reference = 2 * length * np.exp(-np.euler_gamma)
    if "line_reference" in result:
        reference = float(result["line_reference"])
    # The approach grows with the load up to half-widths of D.
    loads = np.geomspace(1e-6, 1, 500) * np.pi * result["e_star"] * reference
    loads = loads[result.half_width_under(loads) < reference]
    lowered = np.log(2 * reference / result.half_width_under(loads)) + 0.5
    known = 2 * loads / (np.pi * result["e_star"]) * lowered
    return np.interp(approach, known, loads * length, left=np.nan, right=np.nan)


def load(results, options):
    """Force (for two flats nominal pressure) and number of contacts against the approach, that of a
    ball or a cylinder beside that of the smooth one (Hertz)."""
    results = [r for r in results if "contacts" in r and r.loaded().size and r.load_varies()]
    if not results:
        return None
    flat = all("pressure" in r for r in results)
    first, text = ("pressure", "nominal pressure $p$") if flat else ("force", "force $N$")
    page, looks = begin(results, options, 2)
    for axis, name in zip(page.axes, (first, "contacts")):
        loads = np.concatenate([r.mean(name)[r.carrying()] for r in results])
        axis.set_yscale("log" if _many_decades([loads]) else "linear")
        for result, look in zip(results, looks):
            approach = -result.mean("separation")
            curve(
                page,
                axis,
                result,
                look,
                approach,
                result.mean(name),
                name,
                alone=len(results) == 1,
            )
        if name == "contacts" and axis.get_yscale() == "linear":
            axis.set_ylim(0, 1.1 * loads.max())
            axis.yaxis.get_major_locator().set_params(integer=True)
    smooth = {(float(r["e_star"]), float(r["r_star"])): r for r in results if r.is_ball()}
    lines = [r for r in results if np.isfinite(r.half_width(r.loaded()[-1]))]
    if len(results) == len(lines) == 1:
        smooth[None] = lines[0]
    deep = page.axes[0].dataLim.x1 > 0  # Hertz's force begins at the mean plane
    if len(smooth) == 1 and deep and not any(r.pulls() for r in results):
        page.axes[0].autoscale_view()  # Hertz's force vanishes at the origin
        limits = page.axes[0].get_ylim()
        x = np.linspace(0, page.axes[0].dataLim.x1, 300)[1:]
        for result in smooth.values():
            if lines:
                y, name = hertz_line(result, x), "smooth cylinder (Hertz)"
            else:
                y, name = hertz_force(result, x), result.smooth()
            page.axes[0].plot(x, y, ":", color=GREY, lw=1.0, label=name)
        page.axes[0].set_ylim(limits)
    page.axes[1].set_xlim(page.axes[0].get_xlim())
    for axis, words, name in zip(page.axes, (text, "number of contacts"), (first, "contacts")):
        label(axis, "x", "approach of the mean planes $-Z_0$" if flat else "approach $-Z_0$", "m")
        label(axis, "y", words, results[0].dimension(name))
    what = "Nominal pressure" if flat else "Force"
    return page.finish(title(results, f"{what} and contacts against approach"))


def _against_load(results, options, name, sign, text, what, theory=None):
    """sign times a variable against the force; of two flats, both per nominal area. theory(axis,
    result) draws the line of a single result, or of several with the same smooth body."""
    results = [
        r
        for r in results
        if name in r and np.isfinite(r.mean(name)[r.loaded()]).any() and r.load_varies()
    ]
    if not results:
        return None
    page, looks = begin(results, options)
    axis = page.axes[0]
    flat = all("pressure" in r for r in results) and name == "stiffness"
    load, load_text = ("pressure", "nominal pressure $p$") if flat else ("force", "force $N$")
    dimension = "N m-3" if flat else results[0].dimension(name)
    values = [sign * r.mean(name) / (r.mean("nominal_area") if flat else 1) for r in results]
    for which, drawn in (
        ("x", [r.mean(load)[r.carrying()] for r in results]),
        ("y", [y[r.carrying()] for r, y in zip(results, values)]),
    ):
        getattr(axis, f"set_{which}scale")("log" if _many_decades(drawn) else "linear")
    alone = len(results) == 1
    for result, look, y in zip(results, looks, values):
        curve(page, axis, result, look, result.mean(load), y, name, load, alone)
    if theory:
        theory(axis, results)
    label(axis, "x", load_text, results[0].dimension(load))
    label(axis, "y", text + (" per area" if flat else ""), dimension)
    return page.finish(title(results, what.replace("force", "pressure") if flat else what))


def smooth_areas(results):
    """(forces, areas) of the contact of the smooth indenter at the loads of results, in the order
    of the forces; None if they do not have the same one."""
    bodies = {
        (float(r["e_star"]), r.shape(), float(r["r_star"])) if r.has_sphere() else None
        for r in results
    }
    if len(bodies) > 1 or None in bodies:
        return None
    force = np.concatenate([r.mean("force")[r.loaded()] for r in results])
    area = np.concatenate([r["area_hertz"][r.loaded()] for r in results])
    order = np.argsort(force)
    return force[order], area[order]


def _smooth_stiffness(axis, results):
    """That of the smooth indenter, if it is the same for all results: 2 E* a, or of a cylinder of
    length L and half-width b pi E* L/(2 ln(2 D/b)), where D is line_reference."""
    if any(r.pulls() for r in results):
        return
    first, lines = results[0], ["line_reference" in r for r in results]
    if all(lines) and np.isfinite(first.half_width(first.loaded()[-1])):
        same = {(float(r["e_star"]), float(r["line_reference"])) for r in results}
        at = first.loaded()[np.argsort(first.mean("force")[first.loaded()])]
        force, per_length = first.mean("force")[at], first.mean("force_per_length")[at]
        width = first.half_width_under(per_length)
        log = np.log(2 * float(first["line_reference"]) / width)
        if len(same) == 1 and (log > 0).all():
            y = np.pi * float(first["e_star"]) * force / per_length / (2 * log)
            axis.plot(force, y, ":", color=GREY, lw=1.0, label="smooth cylinder (Hertz)")
    elif smooth := smooth_areas(results):
        force, area = smooth
        y = 2 * float(results[0]["e_star"]) * np.sqrt(area / np.pi)
        axis.plot(force, y, ":", color=GREY, lw=1.0, label=results[0].smooth())


def stiffness(results, options):
    """Normal stiffness against force, that of two flats per area against pressure."""
    return _against_load(
        results,
        options,
        "stiffness",
        -1,
        r"stiffness $-\mathrm{d}N/\mathrm{d}Z_0$",
        "Stiffness against force",
        _smooth_stiffness,
    )


def _holm(axis, results):
    """Of a single result, Holm's constriction rho/(2 a) of a single round spot of the true area, of
    that of the smooth indenter, and of the area N/H of bodies that yield."""
    if len(results) > 1:
        return
    result = results[0]
    at = result.loaded()
    at = at[np.argsort(result.mean("force")[at])]
    force = result.mean("force")[at]
    both = float(np.nanmean((result.mean("resistance") * result.mean("conductance_length"))[at]))
    areas = [(result.mean("contact_area")[at], "--", "one spot of the true area (Holm)")]
    if result.has_sphere():
        areas.append((result["area_hertz"][at], ":", result.smooth()))
    hardness = result.hardness()
    if np.isfinite(hardness):
        areas.append((force / hardness, "-.", r"one spot of area $N/H$ (Holm)"))
    for area, line, text in areas:
        spot = 0.25 * both * np.sqrt(np.pi / area)
        axis.plot(force, spot, line, color=GREY, lw=1.0, label=text)


def resistance(results, options):
    """Constriction resistance against force, if resistivities are given."""
    return _against_load(
        results,
        options,
        "resistance",
        1,
        "constriction resistance",
        "Constriction resistance against force",
        _holm,
    )
