"""Asperities against elements (&compare): contact spots of both models, pressures along a line, and
the error at every compared level."""

import numpy as np
from matplotlib.colors import ListedColormap

from plot_results import names
from plot_spots import ellipses, spots_of
from plot_style import Page, STYLES, amount, label


def along_line(spots, y, x0, x1):
    """Hertz's pressures of the spots along the line at y from x0 to x1; in yielding spots the
    pressure is constant."""
    x = np.linspace(x0, x1, 2000)
    p = np.zeros_like(x)
    for sx, sy, a, b, t, f, yields in zip(*spots):
        u = (x - sx) * np.cos(t) + (y - sy) * np.sin(t)
        v = -(x - sx) * np.sin(t) + (y - sy) * np.cos(t)
        inside = 1 - (u / a) ** 2 - (v / b) ** 2
        p += np.where(
            inside > 0,
            f / (np.pi * a * b) * (1 if yields else 1.5 * np.sqrt(np.maximum(inside, 0))),
            0,
        )
    return x, p


def compare(results, options):
    """The comparison by &compare, for the first result that has it."""
    having = [r for r in results if "compare_step" in r]
    if not having or not having[0].mean("force")[having[0]["compare_step"].astype(int) - 1].any():
        return None
    result = having[0]
    if len(having) > 1:
        options.say(
            f"compare: {names(results)[results.index(result)]} is drawn; plot the other files "
            "one by one"
        )
    steps = result["compare_step"].astype(int) - 1
    step, pixels, spots = (
        int(steps[-1]),
        "compare_pixel_x" in result,
        spots_of(result, int(steps[-1])),
    )
    page = Page(options, 3 if pixels else 1, aspect=0.9 if pixels else 0.72)
    errors = page.axes[-1]
    for k, (name, text) in enumerate(
        [("force_error", "$N$"), ("area_error", "$A$"), ("contacts_error", "contacts")]
    ):
        if name not in result:  # under force control both have the same force
            continue
        marker, line, colour = STYLES[k]
        errors.plot(
            result.mean("force")[steps],
            100 * result[name],
            marker,
            ls=line,
            color=colour,
            ms=3.5,
            label=f"error of {text}",
        )
    errors.axhline(0, color="k", lw=0.6)
    errors.set_xscale("log")
    if steps.size == 1:
        errors.set_xlim(result.mean("force")[steps[0]] / 3, result.mean("force")[steps[0]] * 3)
    label(errors, "x", "force $N$", result.dimension("force"))
    label(errors, "y", "error [%]")
    if not pixels:
        return page.finish(result.heading("Errors of the asperity model"))
    px, py, pressure = (result["compare_pixel_" + name] for name in ("x", "y", "pressure"))
    scale = result.factor("compare_pixel_x")
    hx, hy = (
        float(result.attribute("compare_pixel_" + name, "pixel_size")[0]) * scale
        for name in ("x", "y")
    )
    # Around the spot of the largest force, or without stored spots around the highest pressure.
    peak, reach = int(np.argmax(pressure)), 0.0
    if spots is not None:
        strongest = int(np.argmax(spots[5]))
        peak, reach = int(
            np.argmin(np.hypot(px - spots[0][strongest], py - spots[1][strongest]))
        ), 4 * np.sqrt(spots[2][strongest] * spots[3][strongest])
    n = int(np.clip(reach / hx, 20, 200))  # pixels on either side of it
    x0, x1, y0, y1 = (
        px[peak] - (n + 0.5) * hx,
        px[peak] + (n + 0.5) * hx,
        py[peak] - (n + 0.5) * hy,
        py[peak] + (n + 0.5) * hy,
    )
    near = (px > x0) & (px < x1) & (py > y0) & (py < y1)
    axis, line = page.axes[:2]
    image = np.full((2 * n + 1, 2 * n + 1), np.nan)
    image[((py[near] - y0) / hy).astype(int), ((px[near] - x0) / hx).astype(int)] = 1
    axis.imshow(
        np.ma.masked_invalid(image),
        extent=(x0, x1, y0, y1),
        cmap=ListedColormap(["0.65"]),
        interpolation="nearest",
        gid="pixels",
    )
    page.entry("elements", color="0.65", marker="s", ls="none")
    values = np.zeros(2 * n + 1)
    at = near & (np.abs(py - py[peak]) < 0.25 * hy)
    values[((px[at] - x0) / hx).astype(int)] = pressure[at]
    line.stairs(values, x0 + hx * np.arange(2 * n + 2), color="0.5", fill=True, alpha=0.5)
    if spots is not None:
        x, y, a, b, angle = spots[:5]
        some = (abs(x - px[peak]) < n * hx + a) & (abs(y - py[peak]) < n * hy + a)
        looks = dict(facecolors="none", edgecolors="#c1440e", linewidths=1.0, gid="spots")
        ellipses(axis, *(v[some] for v in (x, y, a, b, angle)), **looks)
        page.entry("asperities", color="#c1440e", ls="-", lw=1.0)
        line.plot(
            *along_line([v[some] for v in spots], py[peak], x0, x1), "-", color="#c1440e", lw=1.0
        )
    axis.axhline(py[peak], color="#0b3c5d", lw=0.6, ls=":")
    axis.set(xlim=(x0, x1), ylim=(y0, y1), title="spots around the strongest")
    line.set(xlim=(x0, x1), title="pressure along the dotted line")
    line.set_ylim(0, None)
    errors.set_title("asperities over elements $-$ 1")
    for panel in (axis, line):
        panel.locator_params(axis="x", nbins=4)
        label(panel, "x", "$x$", result.dimension("compare_pixel_x"))
    label(axis, "y", "$y$", result.dimension("compare_pixel_y"))
    label(line, "y", "pressure $p$", result.dimension("compare_pixel_pressure"))
    force = (
        ""
        if result.control() == "force"
        else f", $N$ = {amount(result.mean('force')[step], result.dimension('force'))}"
    )
    return page.finish(
        result.heading(f"Asperities and elements at {result.level_name(step)}{force}")
    )
