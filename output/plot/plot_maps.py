"""Where the contact is: maps of area fraction and pressure, pressure about the tip, spots over the heights."""

import textwrap

import matplotlib
import numpy as np
from matplotlib.collections import EllipseCollection

from plot_curves import chosen_levels
from plot_results import names, plain
from plot_style import few, legend, panels, plt, style

# Zero is white: what is not touched is not coloured.
_COLOURS = matplotlib.colormaps["viridis_r"].copy()
_COLOURS.set_bad("w")


def hertz_radius(result, step):
    return float(np.sqrt(result["area_hertz"][step] / np.pi)) if result.has_sphere() else np.nan


def _shown(results, options):
    """(result, level, name) of the panels: three levels of one result (two in a narrow picture), or one level of each of several."""
    if len(results) == 1:
        count = 3 if options.width >= 120 else 2
        return [(results[0], level, results[0].level_name(level) + results[0].warning(level)) for level in chosen_levels(results[0], count, options.step)]
    return [(r, level, f"{name}, {r.level_name(level)}{r.warning(level)}") for r, name in zip(results, names(results)) for level in chosen_levels(r, 1, options.step)]


def contact_window(x, y, field, side, margin=0.15):
    """(x0, x1, y0, y1) of the smallest square that holds the cells where `field` is above zero, and a margin; cut to the map."""
    rows, columns = np.nonzero(np.nan_to_num(field) > 0)
    whole = (x[0] - side / 2, x[-1] + side / 2, y[0] - side / 2, y[-1] + side / 2)
    if rows.size == 0:
        return whole
    ends = np.array([x[columns.min()] - side / 2, x[columns.max()] + side / 2, y[rows.min()] - side / 2, y[rows.max()] + side / 2])
    half = max(ends[1] - ends[0], ends[3] - ends[2], 4 * side) * (0.5 + margin)
    cx, cy = (ends[0] + ends[1]) / 2, (ends[2] + ends[3]) / 2
    return max(cx - half, whole[0]), min(cx + half, whole[1]), max(cy - half, whole[2]), min(cy + half, whole[3])


def maps(results, options):
    """Area fraction and pressure in the cells at some levels, or the pressure of several results; cropped to the contact. The circle is the contact of the smooth sphere
    under the same force."""
    shown = _shown([r for r in results if "map_pressure" in r], options)
    if not shown:
        return None
    if len(shown) > 9:
        options.say(f"map: {len(shown)} results; the first 9 are drawn")
        shown = shown[:9]
    quantities = [("map_area_fraction", "area fraction $A'$"), ("map_pressure", "pressure $p$")]
    if len(results) > 1:
        quantities = quantities[1:]
    columns = min(3, len(shown), max(1, int(options.width // 42)))
    rows = -(-len(shown) // columns)
    size = options.width / columns
    figure, axes = plt.subplots(rows * len(quantities), columns, figsize=(options.width / 25.4, (1.32 * size * rows * len(quantities) + 8) / 25.4), constrained_layout=True,
                                squeeze=False)
    for axis in axes.ravel():
        axis.set_visible(False)
    for k, (result, level, title) in enumerate(shown):
        for q, (name, label) in enumerate(quantities):
            axis = axes[k // columns + rows * q, k % columns]
            axis.set_visible(True)
            _map(figure, axis, result, level, name, label)
            if q == 0:
                axis.set_title("\n".join(textwrap.wrap(title, 34)) + f"\n$N$ = {result['force_mean'][level]:.3g}{plain(result.unit('force'))}", fontsize=7)
    what = ("Area fraction and pressure" if len(results) == 1 else "Pressure") + ("; dashed: Hertz contact of the smooth sphere" if any(r.has_sphere() for r, _, _ in shown) else "")
    figure.suptitle(results[0].heading(what) if len(results) == 1 else what, fontsize=8)
    return figure


def _map(figure, axis, result, level, name, label):
    field, x, y, side = result.window(name, level), result["x"], result["y"], float(result["map_cell_side"])
    # A hundredth of the cells may be above the end of the scale: they would hide all others.
    end = np.percentile(field[field > 0], 99) if (field > 0).any() else 1.0
    image = axis.imshow(np.ma.masked_where(~(field > 0), field), extent=[x[0] - side / 2, x[-1] + side / 2, y[0] - side / 2, y[-1] + side / 2], cmap=_COLOURS, vmin=0, vmax=end,
                        interpolation="nearest")
    bar = figure.colorbar(image, ax=axis, location="bottom", pad=0.02, aspect=25, extend="max" if field.max() > end else "neither", label=label + result.unit(name))
    bar.ax.locator_params(nbins=3)
    radius = hertz_radius(result, level)
    if np.isfinite(radius):
        axis.add_patch(plt.Circle((float(result["tip_x"]), float(result["tip_y"])), radius, fill=False, ls="--", lw=1.0, color="r"))
    window = contact_window(x, y, result.window("map_pressure", level), side)
    axis.set(xlim=window[:2], ylim=window[2:], xlabel="$x$" + result.unit("x"), ylabel="$y$" + result.unit("y"))
    axis.locator_params(nbins=4)


def radial(results, options):
    """Pressure about the tip, linear and logarithmic, with Hertz for the same force where there is a sphere."""
    shown = _shown([r for r in results if "radial_pressure" in r and (r.has_sphere() or len(results) > 1)], options)
    if not shown:
        return None
    figure, axes = panels(2, options.width, entries=few(len(shown)))
    ends, spheres = [], False
    for k, (result, level, title) in enumerate(shown):
        marker, line, colour = style(k, len(shown))
        radius, pressure = result["radius"], result["radial_pressure"][level]
        a = hertz_radius(result, level)
        above = radius[pressure > 0]
        ends.append(max(above[-1] if above.size else 0, 1.3 * a if np.isfinite(a) else 0))
        for axis, logarithmic in zip(axes, (False, True)):
            good = pressure > 0 if logarithmic else np.full(radius.size, True)
            axis.plot(radius[good], pressure[good], marker, ms=2.5, color=colour, mfc="none", mew=0.7, label=title)
            if np.isfinite(a):
                spheres = True
                r = a * np.sin(np.linspace(0, np.pi / 2, 200)[: -1 if logarithmic else None])
                axis.plot(r, 1.5 * result["force_mean"][level] / (np.pi * a * a) * np.sqrt(1 - (r / a) ** 2), line, color=colour, gid="hertz")
    result = shown[0][0]
    for axis in axes[:2]:
        axis.set(xlabel="distance from the tip $r$" + result.unit("radius"), ylabel="pressure $p$" + result.unit("radial_pressure"), xlim=(0, min(1.05 * max(ends), result["radius"][-1])))
    axes[0].set_ylim(bottom=0)
    axes[1].set_yscale("log")
    positive = np.concatenate([r["radial_pressure"][level] for r, level, _ in shown])
    positive = positive[positive > 0]
    if positive.size:
        axes[1].set_ylim(max(positive.min(), positive.max() * 1e-4) / 2, positive.max() * 2)
    legend(axes[0], below=axes[2] if len(axes) > 2 else None)
    what = "Radial mean of the pressure; points: rsc" + ("; lines: Hertz" if spheres else "")
    figure.suptitle(results[0].heading(what) if len(results) == 1 else what, fontsize=8)
    return figure


def _heights(result, axis, figure, window):
    """The heights under the spots, at most some 1500 points each way."""
    if "height" not in result:
        return
    hx, hy = (result[next(n for n in names if n in result)] for names in (("height_x", "x"), ("height_y", "y")))
    i, j = np.flatnonzero((hx >= window[0]) & (hx <= window[1])), np.flatnonzero((hy >= window[2]) & (hy <= window[3]))
    if i.size < 2 or j.size < 2:
        return
    stride = max(1, max(i.size, j.size) // 1500)
    z = result.window("height", slice(j[0], j[-1] + 1, stride), slice(i[0], i[-1] + 1, stride))
    dx, dy = hx[1] - hx[0], hy[1] - hy[0]
    low, high = float(np.nanmin(z)), float(np.nanmax(z))
    image = axis.imshow(z, vmin=low - 0.8 * (high - low), vmax=high, extent=[hx[i[0]] - dx / 2, hx[i[-1]] + dx / 2, hy[j[0]] - dy / 2, hy[j[-1]] + dy / 2], cmap="gray", interpolation="nearest")
    bar = figure.colorbar(image, ax=axis, location="bottom", pad=0.02, aspect=25, label="height $z$" + result.unit("height"))
    bar.ax.set_xlim(low, high)  # the darker half of the greys is left to the spots


def contacts_of(result, step):
    """Places and radii of the spots of a level, (x, y, a); None where the file keeps none."""
    if "contact_start" not in result or "contact_radius" not in result:
        return None
    first, count = int(result["contact_start"][step]) - 1, int(result["contact_count"][step])
    span = slice(first, first + count)
    if "contact_x" in result:
        x, y = result.window("contact_x", span), result.window("contact_y", span)
    elif "contact_asperity" in result:
        which = result.window("contact_asperity", span).astype(int) - 1
        x, y = result["asperity_x"][which], result["asperity_y"][which]
    else:
        return None
    return x, y, result.window("contact_radius", span)


def yields_of(result, step):
    """Which spots of a level yield; none where the file says nothing of it."""
    first, count = int(result["contact_start"][step]) - 1, int(result["contact_count"][step])
    if "contact_yields" not in result:
        return np.zeros(count, bool)
    return result.window("contact_yields", slice(first, first + count)) > 0


def spots(results, options):
    """The contact spots of a level, true to size, over the heights: all of them, and the neighbourhood of the largest with the summits that do not touch."""
    result = results[0]
    if len(results) > 1 or "contact_radius" not in result:
        return None
    counts = result["contact_count"]
    step = options.step - 1 if options.step is not None else int(np.flatnonzero(counts > 0)[-1]) if (counts > 0).any() else None
    if step is None or counts[step] == 0:
        return None
    x, y, a = contacts_of(result, step)
    yields = yields_of(result, step)
    big = int(np.argmax(a))
    centre, half = ((x - a).min() + (x + a).max()) / 2, 0.55 * max((x + a).max() - (x - a).min(), (y + a).max() - (y - a).min())
    middle = ((y - a).min() + (y + a).max()) / 2
    figure, axes = panels(2, options.width, aspect=1.3, least=60.0)
    near = min(14 * a[big], half)
    for axis, (cx, cy, h) in zip(axes, ((centre, middle, half), (x[big], y[big], near))):
        window = (cx - h, cx + h, cy - h, cy + h)
        _heights(result, axis, figure, window)
        for some, colour, name in ((~yields, "#d62728", "spots"), (yields, "#f2b400", "yielding spots")):
            axis.add_collection(EllipseCollection(2 * a[some], 2 * a[some], np.zeros(some.sum()), units="xy", offsets=np.column_stack([x[some], y[some]]), transOffset=axis.transData,
                                                  facecolors=colour, edgecolors="k" if axis is axes[1] else colour, linewidths=0.3, gid=name))
        if axis is axes[1] and "asperity_x" in result:
            ax, ay = result["asperity_x"], result["asperity_y"]
            inside = (abs(ax - cx) <= h) & (abs(ay - cy) <= h)
            axis.plot(ax[inside], ay[inside], "+", color="#0b6fa4", ms=5, label="summits")
            axis.legend(loc="upper right")
        axis.set(xlim=window[:2], ylim=window[2:], aspect="equal", xlabel="$x$" + result.unit("x"), ylabel="$y$" + result.unit("y"))
        axis.locator_params(nbins=5)
    axes[0].plot(float(result["tip_x"]), float(result["tip_y"]), "kx", ms=6, label="tip")
    if "contact_yields" in result:
        for colour, name in (("#f2b400", "yields"), ("#d62728", "elastic")):
            axes[0].plot([], [], "o", color=colour, ms=4, label=name)
    axes[0].legend(loc="upper right")
    axes[0].set_title(f"{x.size} contact spots, true to size" + (f"; {yields.sum()} yield" if "contact_yields" in result else ""))
    axes[1].set_title("around the largest")
    figure.suptitle(result.heading(f"Contact spots at {result.level_name(step)}{result.warning(step)}, $N$ = {result['force_mean'][step]:.3g}{plain(result.unit('force'))}"), fontsize=8)
    return figure
