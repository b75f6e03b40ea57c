"""Two flats under a nominal pressure, beside the theories of rough contact."""

import numpy as np

from plot_curves import begin, curve, title
from plot_style import GREY, label


def flats(results, options):
    """kappa = A E* h'/N and the mean separation against the nominal pressure over E* h'."""
    results = [
        r
        for r in results
        if "pressure" in r
        and "area_fraction" in r
        and r.loaded().size
        and (r.mean("pressure")[r.carrying()] > 0).all()
        and r.load_varies()
    ]
    if not results:
        return None
    page, looks = begin(results, options, 2)
    left, right = page.axes
    for result, look in zip(results, looks):
        relative = result.mean("pressure") / (
            float(result["e_star"]) * float(np.mean(result["rms_slope"]))
        )
        at = result.loaded()
        if len(results) == 1:
            page.entry("rsc", color=look[1], ls=look[0])
            for name, line, text in (
                ("area_persson", "--", "Persson"),
                ("area_bgt", ":", "Bush, Gibson, Thomas"),
                ("area_gw", "-.", "Greenwood, Williamson"),
            ):
                if name in result and np.isfinite(result.mean(name)[at]).any():
                    left.plot(
                        relative[at],
                        result.mean(name)[at] / relative[at],
                        line,
                        color=GREY,
                        lw=1.0,
                        label=text,
                    )
        with np.errstate(invalid="ignore", divide="ignore"):
            curve(
                page,
                left,
                result,
                look,
                relative,
                result.mean("area_fraction") / relative,
                "contact_area",
                alone=len(results) == 1,
            )
        name = "separation_sigma" if "separation_sigma" in result else "separation"
        curve(page, right, result, look, relative, result.depth()[0], name, alone=len(results) == 1)
    for axis in page.axes:
        axis.set_xscale("log")
        label(axis, "x", r"nominal pressure $p/(E^*h')$")
    left.set_ylim(0, None)
    label(left, "y", r"$\kappa = A\,E^*h'/N$")
    label(right, "y", *results[0].depth()[1:])
    return page.finish(
        title(results, "Two flats: true area and separation against nominal pressure")
    )
