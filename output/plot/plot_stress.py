"""Stresses below the surface (output%stress_depths): the largest at each depth, and a vertical
section through the worst point."""

import numpy as np

from plot_style import Page, STYLES, amount, colour_bar, label

KINDS = (
    ("mises", "von Mises"),
    ("shear", "shear"),
    ("tension", "tension"),
)


def _level(result, options):
    """The level to draw: the requested one, otherwise the last with stresses; None if there is
    none."""
    there = np.flatnonzero(np.isfinite(result["mises_max"]).any(axis=(0, 2)))
    if options.step is not None:
        return options.step - 1 if options.step - 1 in there else None
    return int(there[-1]) if there.size else None


def ball_axis(z, N, R, E, nu):
    """von Mises's stress under the centre of a smooth ball, and the largest shear stress there
    (Johnson 1985, section 3.4)."""
    a = (0.75 * N * R / E) ** (1 / 3)
    p0 = 1.5 * N / (np.pi * a**2)
    t = z / a
    with np.errstate(divide="ignore"):
        angle = np.where(t > 0, t * np.arctan(1 / np.where(t > 0, t, 1)), 0)
    axial = -1 / (1 + t**2)
    radial = -(1 + nu) * (1 - angle) + 0.5 / (1 + t**2)
    mises = p0 * np.abs(radial - axial)
    return mises, mises / 2


def cylinder_axis(z, load, half_width, nu):
    """The same under the middle of a smooth cylinder with this load per length, in plane strain
    (Johnson 1985, section 4.2)."""
    p0 = 2 * load / (np.pi * half_width)
    t = z / half_width
    root = np.sqrt(1 + t**2)
    across, down = 2 * t - (1 + 2 * t**2) / root, -1 / root
    along = nu * (across + down)
    mises = np.sqrt(((across - down) ** 2 + (down - along) ** 2 + (along - across) ** 2) / 2)
    return p0 * mises, p0 * np.ptp([across, down, along], axis=0) / 2


def smooth_axis(result, step, z):
    """These stresses under the smooth indenter of the same load, and its name; None if there is no
    closed form."""
    R, N = float(result["r_star"]), result.mean("force")[step]
    nu = float(result.case["solids%nu"].split(",")[0])
    if not N > 0:
        return None
    if np.isfinite(half_width := result.half_width(step)):
        load = result.mean("force_per_length")[step]
        return (*cylinder_axis(z, load, half_width, nu), "cylinder")
    if np.isfinite(R) and R < 1e27:
        return (*ball_axis(z, N, R, float(result["e_star"]), nu), "ball")
    return None


def stress(results, options):
    """The largest stresses at each depth at one level, beside those under a smooth ball or cylinder
    of the same load."""
    results = [r for r in results if "mises_max" in r]
    if len(results) != 1:
        return None
    result = results[0]
    step = _level(result, options)
    if step is None:
        return None
    page = Page(options)
    axis = page.axes[0]
    z = result["depth"]
    top = 0
    for (name, text), (_, line, colour) in zip(KINDS, STYLES):
        values = np.nanmean(result[name + "_max"][:, step], axis=0)
        drawn = np.where(values > 0, values, np.nan)
        axis.plot(drawn, z, line, color=colour, marker=".", label=text)
        top = max(top, np.nanmax(drawn, initial=0))
        if result.realizations == 1 and name + "_max_error_expected" in result:
            off = np.nan_to_num(result[name + "_max_error_expected"][0, step]) * values
            if (off > 0.06 * values).any():  # less is not visible
                looks = dict(color=colour, alpha=0.15, lw=0)
                axis.fill_betweenx(z, np.maximum(values - off, 0), values + off, **looks)
                page.entry("expected error of the model", color="0.7", lw=5)
    fine = np.linspace(0, z[-1], 400)
    if smooth := smooth_axis(result, step, fine):
        *both, body = smooth
        for values, (_, name), (_, _, colour) in zip(both, KINDS, STYLES):
            axis.plot(values, fine, ":", color=colour, label=f"{name}, axis of a smooth {body}")
    axis.set_yscale("symlog", linthresh=z[z > 0].min() if (z > 0).any() else 1, linscale=0.4)
    axis.set_ylim(z[-1], 0)
    axis.set_xlim(0, 1.05 * top)
    if (z > 0).any():
        powers = 10.0 ** np.arange(np.floor(np.log10(z[z > 0].min())), np.log10(z[-1]))
        ticks = (powers[:, None] * [1, 2, 5]).ravel()
        axis.set_yticks([0, *ticks[(ticks >= z[z > 0].min()) & (ticks <= z[-1])]], minor=False)
        axis.minorticks_off()
    label(axis, "x", "largest stress at the depth", result.dimension("mises_max"))
    label(axis, "y", "depth", result.dimension("depth"))
    return page.finish(result.heading(f"Stresses below the surface at {result.level_name(step)}"))


def section(results, options):
    """von Mises's stress (or the first stress there is) in the vertical plane along x through the
    worst point, and in the worst plane."""
    name = next(
        (k for k, _ in KINDS if len(results) == 1 and f"field_{k}" in results[0]),
        None,
    )
    if name is None:
        return None
    result, text = results[0], dict(KINDS)[name]
    depth = result["depth"]
    if depth.size < 2:
        return None
    x, y = result["field_x"], result["field_y"]
    steps = result["field_step"].astype(int) - 1
    where = len(steps) - 1
    if options.step is not None:
        if options.step - 1 not in steps:
            return None
        where = int(np.flatnonzero(steps == options.step - 1)[0])
    stresses = result[f"field_{name}"][where]
    worst = np.unravel_index(np.nanargmax(stresses), stresses.shape)
    page = Page(options, 2, aspect=0.9, columns=2)
    page.figure.get_layout_engine().set(wspace=0.1)
    side, plane = page.axes
    dimension = result.dimension(f"field_{name}")
    half = [(v[-1] - v[0]) / (v.size - 1) / 2 for v in (x, y)]
    most = stresses.max()
    cut = stresses[:, worst[1], :]
    # Down to where the stresses are small, and as far to both sides of the worst point. The depths
    # are not evenly spaced: between their planes the picture is interpolated.
    deepest = depth[np.flatnonzero(np.nanmax(cut, axis=1) > 0.1 * most)[-1]]
    deepest = min(max(deepest, depth[1]), x[-1] - x[0])
    z = np.linspace(0, deepest, 300)
    smooth = np.array([np.interp(z, depth, column) for column in cut.T]).T
    image = side.imshow(
        smooth,
        extent=[x[0] - half[0], x[-1] + half[0], z[-1], z[0]],
        origin="upper",
        cmap="inferno",
        vmin=0,
        vmax=most,
    )
    side.plot(x[worst[2]], depth[worst[0]], "o", ms=9, mfc="none", mec="c")
    side.set_xlim(
        max(x[0] - half[0], x[worst[2]] - deepest), min(x[-1] + half[0], x[worst[2]] + deepest)
    )
    label(side, "x", "$x$", result.dimension("field_x"))
    label(side, "y", "depth", result.dimension("depth"))
    side.set_title(f"$y$ = {amount(y[worst[1]], result.dimension('field_y'))}")
    plane.imshow(
        stresses[worst[0]],
        extent=[x[0] - half[0], x[-1] + half[0], y[0] - half[1], y[-1] + half[1]],
        origin="lower",
        cmap="inferno",
        vmin=0,
        vmax=most,
    )
    plane.plot(x[worst[2]], y[worst[1]], "o", ms=9, mfc="none", mec="c")
    plane.axhline(y[worst[1]], color="c", lw=0.6)
    label(plane, "x", "$x$", result.dimension("field_x"))
    label(plane, "y", "$y$", result.dimension("field_y"))
    plane.set_title(f"depth {amount(depth[worst[0]], result.dimension('depth'))}")
    colour_bar(page.figure, image, page.axes, f"{text} stress", dimension, shrink=0.8)
    page.entry("largest", ls="none", marker="o", ms=6, mfc="none", mec="c")
    return page.finish(
        result.heading(f"{text} stress below the surface at {result.level_name(steps[where])}")
    )
