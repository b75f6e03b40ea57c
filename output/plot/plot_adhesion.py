"""Adhesion: the loop of force against separation in loading and unloading."""

import numpy as np

from plot_style import Page, STYLES, label


def pull(results, options):
    """The force against the separation in the order of the levels: loading, and unloading with attached asperities; the area between is
    the energy lost. All results are drawn, the loss is shaded for a single one."""
    found = [result for result in results if "pull_off_force" in result and result.steps > 1]
    if not found:
        return None
    page = Page(options)
    axis = page.axes[0]
    axis.axhline(0, color="0.6", lw=0.6)
    for k, result in enumerate(found):
        Z, N = result.mean("separation"), result.mean("force")
        turn = int(np.argmin(Z))
        colour = STYLES[k % len(STYLES)][2]
        name = "" if len(found) == 1 else f", $w$ = {result.number('solids%adhesion'):g}"
        axis.plot(Z[: turn + 1], N[: turn + 1], "-", color=colour, label="down" + name)
        axis.plot(Z[turn:], N[turn:], "--", color=colour, label="up" + name)
        if len(found) == 1 and turn + 1 < len(Z):
            if abs(Z[-1] - Z[0]) > 1e-9 * np.ptp(
                Z
            ):  # an open loop is shaded where both branches exist
                grid = np.linspace(Z[turn], min(Z[0], Z[-1]), 400)
            else:
                grid = np.union1d(Z[: turn + 1], Z[turn:])
            down, up = np.interp(grid, Z[turn::-1], N[turn::-1]), np.interp(
                grid, Z[turn:], N[turn:]
            )
            axis.fill_between(grid, up, down, color=colour, alpha=0.15, lw=0, label="work lost")
    label(axis, "x", "separation $Z_0$", found[0].dimension("separation"))
    label(axis, "y", "force $N$", found[0].dimension("force"))
    return page.finish(found[0].heading("Approach and pull-off"))
