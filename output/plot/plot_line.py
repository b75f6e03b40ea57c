"""Line contact (boundary = 'periodic_x' or 'periodic_y'): pressure across the axis beside that of Hertz's smooth cylinder."""

import numpy as np

from plot_style import GREY, Page, STYLES, amount, label


def _across(result, level):
    """Coordinates across the axis from the tip, the mean pressure along the axis, and the smallest and largest of it, at one level."""
    along_y = "periodic_y" in result.case["indentation%boundary"]
    where = None
    if "field_pressure" in result:
        steps = result["field_step"].astype(int) - 1
        at = np.flatnonzero(steps == level)
        where = int(at[0]) if at.size else None
    if where is not None:
        x, y, pressure = result["field_x"], result["field_y"], result["field_pressure"][where]
    else:
        x, y, pressure = result["x"], result["y"], np.nan_to_num(result["map_pressure"][level])
    if not along_y:
        pressure = pressure.T
    across = x if along_y else y
    tip = float(result["tip_x" if along_y else "tip_y"])
    return across - tip, pressure.mean(axis=0), pressure.min(axis=0), pressure.max(axis=0)


def _radius(result):
    """The radius of the cylinder in the unit of the pictures; None for other shapes."""
    if "paraboloid" not in result.case.get("indenter%shape", ""):
        return None
    radii = [float(r) for r in result.case["indenter%radii"].split(",")]
    finite = [r for r in radii if np.isfinite(r)]
    return finite[0] * result.factor("separation") if len(finite) == 1 else None


def line(results, options):
    """Mean pressure along the axis, against the distance from it, at up to three levels."""
    results = [r for r in results if "force_per_length" in r]
    if len(results) != 1 or not results[0].loaded().size:
        return None
    result = results[0]
    page = Page(options)
    axis = page.axes[0]
    R, E = _radius(result), float(result["e_star"])
    P = result.mean("force_per_length")
    widest = 0
    for level, (_, _, colour) in zip(result.chosen(3, options.step), STYLES):
        x, mean, low, high = _across(result, level)
        step = x[1] - x[0]
        axis.step(x, mean, where="mid", color=colour)
        name = f"$N/L$ = {amount(P[level], result.dimension('force_per_length'))}"
        page.entry(name, color=colour)
        touched = np.flatnonzero(mean > 0)
        if touched.size:
            widest = max(widest, np.abs(x[touched]).max() + step)
        if R:
            b = 2 * np.sqrt(P[level] * R / (np.pi * E))
            t = np.linspace(-1, 1, 201)
            axis.plot(b * t, 2 * P[level] / (np.pi * b) * np.sqrt(1 - t**2), ":", color=colour)
            page.entry("smooth cylinder (Hertz)", color=GREY, ls=":")
            widest = max(widest, b)
    axis.set_xlim(-1.3 * widest, 1.3 * widest)
    axis.set_ylim(0, None)
    label(axis, "x", "distance from the axis", result.dimension("separation"))
    label(axis, "y", "mean pressure along the axis", result.dimension("map_pressure"))
    return page.finish(result.heading("Pressure across the axis"))
