"""Pressure about the tip."""

import numpy as np

from plot_map import shown
from plot_curves import panel_looks, title
from plot_spots import hertz_radius
from plot_style import Page, amount, label


def _of_sphere(result, level):
    return "hertz_pressure" in result and bool(np.isfinite(result["hertz_pressure"][level]).all())


def radial(results, options):
    """Radial mean of the pressure, linear and logarithmic, for a sphere with Hertz for the same
    force."""
    results = [r for r in results if "radial_pressure" in r and r.has_tip()]
    panels, common = shown(results, options)
    if not panels:
        return None
    if len({name for _, _, name in panels}) < len(panels):  # levels of equal separation
        panels = [
            (r, level, f"{name}, $N$ = {amount(r.mean('force')[level], r.dimension('force'))}")
            for r, level, name in panels
        ]
        panels = list({panel[2]: panel for panel in panels}.values())  # the rest is equal
    page = Page(options, 2)
    end, all_pressures, lines = 0.0, [], False
    for (result, level, _), (marker, line, colour) in zip(
        panels, panel_looks(page, [r for r, _, _ in panels], [name for _, _, name in panels])
    ):
        radius, pressure, a = (
            result["radius"],
            result["radial_pressure"][level],
            hertz_radius(result, level) if _of_sphere(result, level) else np.nan,
        )
        lines = lines or np.isfinite(a)
        all_pressures.append(pressure[pressure > 0])
        last = radius[np.nan_to_num(pressure) != 0].max(initial=0)
        end = max(end, last, 1.3 * a)
        for axis, logarithmic in zip(page.axes, (False, True)):
            good = pressure > 0 if logarithmic else np.isfinite(pressure) & (radius <= last)
            axis.plot(
                radius[good], pressure[good], marker, ms=2.5, color=colour, mfc="none", mew=0.7
            )
            if not np.isfinite(a):
                continue
            r = a * np.sin(np.linspace(0, np.pi / 2, 200)[: -1 if logarithmic else None])
            axis.plot(
                r,
                1.5 * result.mean("force")[level] / (np.pi * a * a) * np.sqrt(1 - (r / a) ** 2),
                line,
                color=colour,
                gid="hertz",
            )
    for entry in page.entries.values() if not lines else []:
        entry.set_linestyle("none")
    positive = np.concatenate(all_pressures)
    page.axes[1].set_yscale("log")
    if positive.size:
        page.axes[1].set_ylim(max(positive.min(), positive.max() * 1e-4) / 2, positive.max() * 2)
    for axis in page.axes:
        axis.set_xlim(0, min(1.05 * end, results[0]["radius"][-1]))
        axis.dataLim.update_from_data_x(axis.get_xlim(), ignore=False)  # common unit
        label(axis, "x", "distance from the tip $r$", results[0].dimension("radius"))
    page.axes[0].set_ylim(bottom=None if any(r.pulls() for r in results) else 0)
    for axis in page.axes:
        label(axis, "y", "pressure $p$", results[0].dimension("radial_pressure"))
    return page.finish(
        title(
            results,
            "Radial mean of the pressure"
            + (f" at {common}" if common else "")
            + ("; points: rsc, lines: smooth sphere (Hertz)" if lines else ""),
        )
    )
