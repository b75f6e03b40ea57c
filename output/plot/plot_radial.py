"""Pressure about the tip."""

import numpy as np

from plot_map import shown
from plot_curves import panel_looks, title
from plot_spots import hertz_radius
from plot_style import GREY, Page, amount, label


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
    pulls = any(r.pulls() for r, _, _ in panels)
    page = Page(options, 1 if pulls else 2)  # tension has no logarithm
    end, all_pressures, smooth = 0.0, [], {}
    for (result, level, _), (marker, line, colour) in zip(
        panels, panel_looks(page, [r for r, _, _ in panels], [name for _, _, name in panels])
    ):
        radius, pressure = result["radius"], result["radial_pressure"][level]
        a, force = np.nan, result.mean("force")[level]
        if _of_sphere(result, level):
            a = hertz_radius(result, level)
            smooth.setdefault((f"{a:.3g}", f"{force:.3g}"), []).append((a, force, line, colour))
        all_pressures.append(pressure[pressure > 0])
        end = max(end, radius[np.nan_to_num(pressure) != 0].max(initial=0), 1.3 * a)
        good = np.isfinite(pressure) & (pressure != 0)  # rings without contact have none
        for axis in page.axes:
            axis.plot(
                radius[good], pressure[good], marker, ms=2.5, color=colour, mfc="none", mew=0.7
            )
    _hertz(page, smooth)
    for entry in page.entries.values():
        if entry.get_marker() not in ("None", "", None) and (not smooth or len(panels) > 1):
            entry.set_linestyle("-" if _own_lines(smooth) else "none")
    positive = np.concatenate(all_pressures)
    if not pulls:
        page.axes[1].set_yscale("log")
    if positive.size and not pulls:
        page.axes[1].set_ylim(max(positive.min(), positive.max() * 1e-4) / 2, positive.max() * 2)
    for axis in page.axes:
        axis.set_xlim(0, min(1.05 * end, results[0]["radius"][-1]))
        axis.dataLim.update_from_data_x(axis.get_xlim(), ignore=False)  # common unit
        label(axis, "x", "distance from the tip $r$", results[0].dimension("radius"))
    if not pulls:
        page.axes[0].set_ylim(bottom=0)
    for axis, like in zip(page.axes, (None, page.axes[0])):
        label(axis, "y", "pressure $p$", results[0].dimension("radial_pressure"), like)
    return page.finish(
        title(results, "Radial mean of the pressure" + (f" at {common}" if common else ""))
    )


def _own_lines(smooth):
    """True if each result or level has a smooth contact of its own, in its own colour."""
    return len(smooth) > 1


def _hertz(page, smooth):
    """The pressures of Hertz, in the colour of their results, or in grey if they are all the
    same."""
    for these in smooth.values():
        a, force, line, colour = these[0]
        if not _own_lines(smooth):
            line, colour = ":", GREY
        for axis in page.axes:
            r = a * np.sin(np.linspace(0, np.pi / 2, 200)[:-1])
            p = 1.5 * force / (np.pi * a * a) * np.sqrt(1 - (r / a) ** 2)
            axis.plot(r, p, line, color=colour, gid="hertz")
    if smooth:
        name = "lines: smooth sphere (Hertz)" if _own_lines(smooth) else "smooth sphere (Hertz)"
        page.entry(name, color=GREY, ls="none" if _own_lines(smooth) else ":")
