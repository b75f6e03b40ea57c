"""Two flats with output%flow: the hydraulic gap against the pressure, and where the fluid flows."""

import numpy as np
from matplotlib.colors import LogNorm

from plot_curves import begin, curve, title
from plot_results import edges
from plot_style import GREY, Page, amount, label, plt

CLOSED = 0.42  # A/A0 where gaps of isotropic surfaces close (Persson; Dapp and others 2012)

LEAST = 0.1  # smallest flux that is drawn, over its mean


def geometric_mean(gaps):
    """Over the realizations whose gap is open, 0 where none is."""
    is_open = gaps > 0
    logs = np.log(np.where(is_open, gaps, 1.0)).sum(axis=0)
    count = is_open.sum(axis=0)
    return np.where(count, np.exp(logs / np.maximum(count, 1)), 0.0)


def seal(results, options):
    """The hydraulic gap along x and y, the mean gap and the leak rate against the nominal
    pressure."""
    results = [r for r in results if "hydraulic_gap" in r and r.loaded().size and r.load_varies()]
    if not results:
        return None
    leaks = all("leak_rate" in r for r in results)
    page, looks = begin(results, options, 2 if leaks else 1)
    axis = page.axes[0]
    alone = len(results) == 1
    for result, look in zip(results, looks):
        pressure, hydraulic = result.mean("pressure"), result["hydraulic_gap"]
        gaps = [geometric_mean(hydraulic[..., k]) for k in (0, 1)]
        curve(page, axis, result, look, pressure, gaps[0], alone=alone)
        if not alone:
            continue
        at = result.loaded()
        page.entry("hydraulic gap along x", color=look[1], ls=look[0])
        for values, line, text in (
            (gaps[1], ":", "along y"),
            (result.mean("gap_mean"), "--", "mean gap"),
        ):
            open_at = at[values[at] > 0]
            axis.plot(pressure[open_at], values[open_at], line, color=look[1], label=text)
        shut = at[gaps[0][at] <= 0]
        if shut.size and shut.size < at.size:
            last = pressure[at[gaps[0][at] > 0]].max()
            axis.axvspan(last, pressure[shut].max(), color="0.9", lw=0)
            closes = amount(last, result.dimension("pressure"))
            page.entry(f"closes above {closes}", color="0.9", lw=5)
        share = result.mean("area_fraction")[at]
        if share.min() < CLOSED < share.max():
            limit = np.exp(np.interp(CLOSED, share, np.log(pressure[at])))
            axis.axvline(limit, color=GREY, ls="-.", lw=1.0, label=f"$A/A_0$ = {CLOSED} (Persson)")
    axis.set_xscale("log")
    axis.set_yscale("log")
    label(axis, "x", "nominal pressure $p$", results[0].dimension("pressure"))
    label(axis, "y", "gap", results[0].dimension("hydraulic_gap"))
    if leaks:
        _leak(page, page.axes[1], results, looks)
    return page.finish(title(results, "What leaks: hydraulic gap against nominal pressure"))


def _leak(page, axis, results, looks):
    """The leak rate; levels whose gap is closed have none."""
    for result, look in zip(results, looks):
        pressure, rate = result.mean("pressure"), result.mean("leak_rate")
        curve(page, axis, result, (*look[:2], None), pressure, rate, "leak_rate", alone=False)
    axis.set(xscale="log", yscale="log", xlim=page.axes[0].get_xlim())
    label(axis, "x", "nominal pressure $p$", results[0].dimension("pressure"), page.axes[0])
    label(axis, "y", "leak rate", results[0].dimension("leak_rate"))


def constriction(gap):
    """(row, column) of the narrowest point of the widest way along x around the periodic cell; None
    if there is none. Points are opened from the widest gap on, until a set of neighbours meets
    itself one period further."""
    ny, nx = gap.shape
    parent, period = {}, {}

    def root(k):
        way = 0
        chain = []
        while parent[k] != k:
            chain.append((k, way))
            way += period[k]
            k = parent[k]
        for link, before in chain:
            parent[link], period[link] = k, way - before
        return k, way

    order = np.argsort(gap, axis=None)[::-1]
    for k in order[: np.count_nonzero(gap > 0)].tolist():
        parent[k], period[k] = k, 0
        row, column = divmod(k, nx)
        for l, step in (
            (row * nx + (column + 1) % nx, int(column + 1 == nx)),
            (row * nx + (column - 1) % nx, -int(column == 0)),
            ((row + 1) % ny * nx + column, 0),
            ((row - 1) % ny * nx + column, 0),
        ):
            if l not in parent:
                continue
            (a, x), (b, y) = root(k), root(l)
            if a == b and x + step - y != 0:
                return row, column
            if a != b:
                parent[b], period[b] = a, x + step - y
    return None


def flow(results, options):
    """The flux for a pressure gradient along x over the gap, at up to three levels of the first
    result with the fields."""
    results = [r for r in results if "field_flow" in r and "field_gap" in r]
    if not results:
        return None
    result = results[0]
    steps = result["field_step"].astype(int) - 1
    drawn = np.unique(np.linspace(0, steps.size - 1, min(3, steps.size)).astype(int))
    columns = drawn.size if options.width >= 120 else 1
    page = Page(options, drawn.size, aspect=0.95, columns=columns)
    x, y = result["field_x"], result["field_y"]
    gaps, fluxes, image = result["field_gap"][drawn], [], None
    for k in drawn:
        mean = result["permeability"][0, steps[k], 0]
        fluxes.append(result["field_flow"][k] / mean if mean > 0 else None)
    top = max((flux.max() for flux in fluxes if flux is not None), default=1)
    grey = plt.get_cmap("Greys_r").copy()
    grey.set_bad("k")
    for k, (axis, gap, flux) in enumerate(zip(page.axes, gaps, fluxes)):
        lightest = 1.6 * gap.max()
        how = dict(extent=edges(x, y), interpolation="nearest")
        shown = np.where(gap > 0, gap, np.nan)
        axis.imshow(shown, cmap=grey, vmin=-lightest, vmax=lightest / 1.6, **how)
        text = "closed"
        if flux is not None:
            norm = LogNorm(LEAST, top)
            image = axis.imshow(
                np.where(flux > LEAST, flux, np.nan), cmap="plasma", norm=norm, **how
            )
            narrowest = constriction(gap)
            if narrowest:
                row, column = narrowest
                axis.plot(x[column], y[row], "o", ms=11, mfc="none", mec="#00a0ff", mew=1.4)
                text = "ring: " + amount(gap[row, column], result.dimension("field_gap"))
        label(axis, "x", "$x$", result.dimension("field_x"))
        label(axis, "y", "$y$", result.dimension("field_y"))
        if k and columns > 1:
            axis.set_ylabel("")
            axis.tick_params(labelleft=False)
        axis.set_title(f"{result.level_name(steps[drawn[k]])}\n{text}", fontsize=7)
    if image is not None:
        how = dict(pad=0.01, fraction=0.05, aspect=25)
        page.figure.colorbar(image, ax=page.axes, label="flux over its mean along $x$", **how)
    page.entry("contact", marker="s", color="k", ls="none")
    page.entry("gap, light: wide", marker="s", color="0.7", ls="none")
    page.entry("critical constriction", marker="o", mfc="none", color="#00a0ff", ls="none", ms=8)
    return page.finish(result.heading("Flow along $x$ through the gap"))
