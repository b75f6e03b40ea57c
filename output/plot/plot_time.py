"""Bodies that relax or wear: levels against time, or the distance of sliding."""

import numpy as np

from plot_curves import begin, error_band, title
from plot_style import label


def _carried(results, flat):
    """What the levels do not prescribe, with its label."""
    if all(r.control() != "separation" for r in results):
        return "separation", "separation $Z_0$"
    return ("pressure", "nominal pressure $p$") if flat else ("force", "force $N$")


def _area(flat):
    if flat:
        return "area_fraction", "true contact area $A/A_0$"
    return "contact_area", "true contact area $A$"


def _against(clock, text, results, options, panels, first, columns=2, logarithmic=()):
    """Panels of quantities against the clock since the first level on a logarithmic axis, the
    first level as a dotted line."""
    page, looks = begin(results, options, len(panels), columns=columns)
    for axis, (name, name_text) in zip(page.axes, panels):
        for result, (line, colour, called) in zip(results, looks):
            t, y = result[clock] - result[clock][0], result.mean(name)
            axis.plot(t[1:], y[1:], ls=line, color=colour, marker=".", ms=3, gid="curve")
            if y[0] > 0 or name not in logarithmic:
                axis.axhline(y[0], ls=":", color=colour, lw=1)
            if result[name].ndim == 2:
                off = result.error(name) * abs(y)
                error_band(page, axis, t[1:], y[1:], off[1:], "", color=colour, alpha=0.2)
            if called:
                page.entry(called, color=colour, ls=line)
            page.status(axis, t, np.where(t > 0, y, np.nan), result, colour)
        page.entry(first, color="0.3", ls=":")
        axis.set_xscale("log")
        axis.set_yscale("log" if name in logarithmic else "linear")
        label(axis, "x", text, results[0].dimension(clock))
        label(axis, "y", name_text, results[0].dimension(name))
    return page


def time(results, options):
    """Force and contact area (of two flats nominal pressure and area fraction) against the time;
    under force control the separation instead of the force."""
    results = [r for r in results if "time" in r and "energy_lost" in r and r.steps > 2]
    if not results:
        return None
    flat = all("pressure" in r for r in results)
    panels = [_carried(results, flat), _area(flat)]
    page = _against(
        "time",
        "time since the first level",
        results,
        options,
        panels,
        "first level, applied at once",
    )
    return page.finish(
        title(results, f"{panels[0][1].split(' $')[0].capitalize()} and contact area against time")
    )


def wear(results, options):
    """Contact area, rms height, largest worn depth, worn volume, largest pressure and separation
    (or force) against the distance of sliding."""
    results = [r for r in results if "distance" in r and "worn_volume" in r and r.steps > 2]
    if not results:
        return None
    flat = all("pressure" in r for r in results)
    panels = [
        _area(flat),
        ("worn_rms", "rms height"),
        ("wear_depth_max", "largest worn depth"),
        ("worn_volume", "worn volume"),
        ("pressure_max", "largest pressure"),
        _carried(results, flat),
    ]
    page = _against(
        "distance",
        "distance of sliding",
        results,
        options,
        panels,
        "first level, without sliding",
        columns=3,
        logarithmic=(panels[0][0], "wear_depth_max", "worn_volume", "pressure_max"),
    )
    return page.finish(title(results, "Wear against the distance of sliding"))
