"""Line contact (boundary = 'periodic_x' or 'periodic_y'): pressure across the axis beside that of
Hertz's smooth cylinder."""

import numpy as np

from plot_style import GREY, Page, STYLES, amount, label


def _across(result, level):
    """Coordinates across the axis from the tip, and the mean pressure along the axis."""
    if "field_pressure" in result:
        at = int(np.flatnonzero(result["field_step"] == level + 1)[0])
        x, y, pressure = result["field_x"], result["field_y"], result.window("field_pressure", at)
    else:
        x, y, pressure = result["x"], result["y"], np.nan_to_num(result["map_pressure"][level])
    along_y = result.along_y()
    tip = float(result["tip_x" if along_y else "tip_y"])
    return (x if along_y else y) - tip, pressure.mean(axis=0 if along_y else 1)


def line(results, options):
    """Mean pressure along the axis, against the distance from it, at up to three levels."""
    results = [r for r in results if "force_per_length" in r]
    if len(results) != 1 or not results[0].loaded().size:
        return None
    result = results[0]
    page = Page(options)
    axis = page.axes[0]
    P = result.mean("force_per_length")
    levels = result.chosen(3, options.step)
    if "field_pressure" in result:  # levels without fields have coarse maps only
        levels = [k for k in result["field_step"].astype(int) - 1 if k in result.loaded()][-3:]
        levels = [k for k in levels if options.step in (None, k + 1)]
    widest = 0
    for level, (_, _, colour) in zip(levels, STYLES):
        x, mean = _across(result, level)
        axis.step(x, mean, where="mid", color=colour)
        name = f"$N/L$ = {amount(P[level], result.dimension('force_per_length'))}"
        page.entry(name + result.warning(level), color=colour)
        touched = np.flatnonzero(mean > 0)
        if touched.size:
            widest = max(widest, np.abs(x[touched]).max() + x[1] - x[0])
        b = result.half_width(level)
        if np.isfinite(b):
            t = np.linspace(-1, 1, 201)
            axis.plot(b * t, 2 * P[level] / (np.pi * b) * np.sqrt(1 - t**2), ":", color=colour)
            page.entry("smooth cylinder (Hertz)", color=GREY, ls=":")
            widest = max(widest, b)
    if not widest:
        return None
    axis.set_xlim(-1.3 * widest, 1.3 * widest)
    axis.set_ylim(0, None)
    label(axis, "x", "distance from the axis", result.dimension("separation"))
    label(axis, "y", "mean pressure along the axis", result.dimension("map_pressure"))
    return page.finish(result.heading("Pressure across the axis"))
