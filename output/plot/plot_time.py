"""Relaxing bodies: levels against time."""

import numpy as np

from plot_curves import begin, title
from plot_style import label


def time(results, options):
    """Force and contact area (of two flats nominal pressure and area fraction) against the time
    since the first level on a logarithmic axis, the first level as a dotted line; under force
    control the separation instead of the force."""
    results = [r for r in results if "time" in r and "energy_lost" in r and r.steps > 2]
    if not results:
        return None
    flat = all("pressure" in r for r in results)
    carried = [("pressure", "nominal pressure $p$")] if flat else [("force", "force $N$")]
    if all(r.control() != "separation" for r in results):
        carried = [("separation", "separation $Z_0$")]
    page, looks = begin(results, options, 2)
    for axis, (name, text) in zip(
        page.axes,
        carried
        + [
            ("area_fraction", "true contact area $A/A_0$")
            if flat
            else ("contact_area", "true contact area $A$")
        ],
    ):
        for result, (line, colour, called) in zip(results, looks):
            t, y = result["time"] - result["time"][0], result.mean(name)
            axis.plot(t[1:], y[1:], ls=line, color=colour, marker=".", ms=3, gid="curve")
            axis.axhline(y[0], ls=":", color=colour, lw=1)
            if called:
                page.entry(called, color=colour, ls=line)
            page.status(axis, t, np.where(t > 0, y, np.nan), result, colour)
        page.entry("first level, applied at once", color="0.3", ls=":")
        axis.set_xscale("log")
        label(axis, "x", "time since the first level", results[0].dimension("time"))
        label(axis, "y", text, results[0].dimension(name))
    return page.finish(
        title(results, f"{carried[0][1].split(' $')[0].capitalize()} and contact area against time")
    )
