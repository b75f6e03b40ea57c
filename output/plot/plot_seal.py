"""Two flats with output%flow: the hydraulic gap against the pressure, and where the fluid flows."""

import numpy as np
from matplotlib.colors import LogNorm

from plot_curves import begin, curve, title
from plot_style import GREY, amount, label, plt

CLOSED = 0.42  # A/A0 where gaps of isotropic surfaces close (Persson; Dapp and others 2012)

LEAST = 0.1  # smallest flux that is drawn, over its mean


def geometric_mean(gaps):
    """Over the realizations whose gap is open, 0 where none is."""
    is_open = gaps > 0
    logs = np.log(np.where(is_open, gaps, 1.0)).sum(axis=0)
    count = is_open.sum(axis=0)
    return np.where(count, np.exp(logs / np.maximum(count, 1)), 0.0)


def seal(results, options):
    """The hydraulic gap along x and y and the mean gap against the nominal pressure."""
    results = [r for r in results if "hydraulic_gap" in r and r.loaded().size and r.load_varies()]
    if not results:
        return None
    page, looks = begin(results, options, 1)
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
        share = result.mean("area_fraction")[at]
        if share.min() < CLOSED < share.max():
            limit = np.exp(np.interp(CLOSED, share, np.log(pressure[at])))
            axis.axvline(limit, color=GREY, ls="-.", lw=1.0, label=f"$A/A_0$ = {CLOSED} (Persson)")
    axis.set_xscale("log")
    axis.set_yscale("log")
    label(axis, "x", "nominal pressure $p$", results[0].dimension("pressure"))
    label(axis, "y", "gap", results[0].dimension("hydraulic_gap"))
    return page.finish(title(results, "What leaks: hydraulic gap against nominal pressure"))


def constriction(gap):
    """(row, column) of the narrowest point of the widest way along x around the periodic cell; None if there is none. Points are opened from the
    widest gap on, until a set of neighbours meets itself one period further."""
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
    """The flux for a pressure gradient along x over the gap, at up to three levels of the first result with the fields."""
    results = [r for r in results if "field_flow" in r and "field_gap" in r]
    if not results:
        return None
    result = results[0]
    steps = result["field_step"].astype(int) - 1
    drawn = np.unique(np.linspace(0, steps.size - 1, min(3, steps.size)).astype(int))
    figure, axes = plt.subplots(
        1,
        drawn.size,
        figsize=(options.width / 25.4, (options.width / drawn.size * 0.98 + 8) / 25.4),
        constrained_layout=True,
        squeeze=False,
    )
    colours = plt.get_cmap("plasma").copy()
    colours.set_bad(alpha=0)
    x, y = result["field_x"], result["field_y"]
    dx, dy = (x[-1] - x[0]) / (x.size - 1) / 2, (y[-1] - y[0]) / (y.size - 1) / 2
    extent = (x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy)
    for axis, k in zip(axes[0], drawn):
        gap, flux = result["field_gap"][k], result["field_flow"][k]
        grey = plt.get_cmap("Greys_r").copy()
        grey.set_bad("k")
        lightest = 1.6 * gap.max()
        axis.imshow(
            np.where(gap > 0, gap, np.nan),
            origin="lower",
            extent=extent,
            cmap=grey,
            vmin=-lightest,
            vmax=lightest / 1.6,
        )
        text = "closed"
        mean = result["permeability"][0, steps[k], 0]
        if mean > 0:
            flux = flux / mean
            image = axis.imshow(
                np.where(flux > LEAST, flux, np.nan),
                origin="lower",
                extent=extent,
                cmap=colours,
                norm=LogNorm(LEAST, flux.max()),
            )
            bar = figure.colorbar(image, ax=axis, orientation="horizontal", shrink=0.9)
            bar.set_label("flux over its mean along x", fontsize=7)
            bar.ax.tick_params(labelsize=6)
            narrowest = constriction(gap)
            if narrowest:
                row, column = narrowest
                axis.plot(x[column], y[row], "o", ms=11, mfc="none", mec="#00a0ff", mew=1.4)
                text = "ring: " + amount(gap[row, column], result.dimension("field_gap"))
        label(axis, "x", "$x$", result.dimension("field_x"))
        label(axis, "y", "$y$", result.dimension("field_y"))
        axis.set_title(f"{result.level_name(steps[k])}\n{text}", fontsize=7)
    figure.suptitle(
        result.heading(
            "Flow along x through the gap (grey; black: contact; ring: critical constriction)"
        ),
        fontsize=8,
    )
    return figure
