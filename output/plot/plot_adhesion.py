"""Adhesion: the loop of force against separation in loading and unloading."""

import numpy as np

from plot_results import Looks
from plot_style import GREY, Page, STYLES, amount, label


def jkr(result):
    """(force, separation) of the smooth ball of Johnson, Kendall and Roberts from the pull-off on;
    None for other indenters."""
    if not result.is_ball():
        return None
    w = result.number("solids%adhesion") * result.factor("stiffness")
    R, E = float(result["r_star"]), float(result["e_star"])
    least = (9 * np.pi * w * R**2 / (8 * E)) ** (1 / 3)  # contact radius at pull-off
    a = least * np.geomspace(1, 30, 2000)
    pull = np.sqrt(8 * np.pi * w * E * a**3)
    return 4 * E * a**3 / (3 * R) - pull, np.sqrt(2 * np.pi * w * a / E) - a**2 / R


def pull(results, options):
    """The force against the separation in the order of the levels: loading, and unloading with
    attached asperities; the area between is the energy lost. All results are drawn; a single one
    with its loss
    shaded; beside the smooth ball (JKR), if it is the same in all of them."""
    found = [r for r in results if r.pulls() and r.steps > 1]
    if not found:
        return None
    page, looks = Page(options), Looks(found)
    if looks.scale:
        page.scale(looks.scale)
    axis = page.axes[0]
    axis.axhline(0, color="0.6", lw=0.6)
    markers = {line: marker for marker, line, _ in STYLES[3::-1]}
    for result, (line, colour, name) in zip(found, looks.of):
        # Lines tell loading from unloading, and markers the results.
        few = dict(marker="." if len(found) == 1 else markers[line], ms=3)
        Z, N = result.mean("separation"), result.mean("force")
        turn = int(np.argmin(Z))
        axis.plot(Z[: turn + 1], N[: turn + 1], "-", color=colour, **few)
        axis.plot(Z[turn:], N[turn:], "--", color=colour, **few)
        if name:
            page.entry(name, color=colour, **few)
        page.status(axis, Z, N, result, colour)
        if len(found) == 1 and turn + 1 < len(Z):
            # An open loop is shaded where both branches exist.
            grid = np.union1d(Z[: turn + 1], Z[turn:])
            grid = grid[grid <= min(Z[0], Z[-1])]
            down, up = (
                np.interp(grid, *v) for v in ((Z[turn::-1], N[turn::-1]), (Z[turn:], N[turn:]))
            )
            axis.fill_between(grid, up, down, color=colour, alpha=0.15, lw=0, label="work lost")
    colour = looks.of[0][1] if len(found) == 1 else "0.3"
    page.entry("down", color=colour, ls="-")
    page.entry("up", color=colour, ls="--")
    curves = [jkr(r) for r in found]
    alike = all(c is not None and c[0].min() == curves[0][0].min() for c in curves)
    smooth = curves[0] if alike else None
    if smooth:
        axis.autoscale_view()
        limits = axis.axis()
        axis.plot(smooth[1], smooth[0], ":", color=GREY, gid="jkr")
        axis.axis(limits)  # far larger than the loop where roughness keeps the bodies apart
        left, right, low, high = limits
        seen = (left < smooth[1]) & (smooth[1] < right) & (low < smooth[0]) & (smooth[0] < high)
        least = amount(abs(smooth[0].min()), found[0].dimension("force"))
        page.entry(
            f"smooth ball (JKR), pull-off {least}" + ("" if seen.any() else ": outside"),
            color=GREY,
            ls=":",
        )
    label(axis, "x", "separation $Z_0$", found[0].dimension("separation"))
    label(axis, "y", "force $N$", found[0].dimension("force"))
    what = "Approach and pull-off"
    return page.finish(found[0].heading(what) if len(found) == 1 else what)
