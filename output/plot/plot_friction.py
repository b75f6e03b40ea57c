"""Friction: the loop of tangential force beside that of a smooth sphere under the same load, and
the stick and slip regions."""

import numpy as np
from matplotlib.colors import to_rgba

from plot_results import edges
from plot_spots import ellipses, spots_of, square
from plot_style import Page, STYLES, amount, label


def _level(results, options):
    """The result and the level to draw: the requested level, otherwise the last with a loop; None
    if there is none."""
    if len(results) != 1 or "tangential_force" not in results[0]:
        return None
    loops = np.flatnonzero(np.isfinite(results[0]["tangential_force"][:, -1]))
    step = options.step - 1 if options.step is not None else int(loops[-1]) if loops.size else None
    return (results[0], step) if step in loops else None


def _slide_per_depth(result, step):
    """mu/m: the slide of full slip over the approach since first touch; m is the ratio of
    tangential to normal stiffness."""
    return result.number("solids%friction") / (
        result["tangential_stiffness"][step]
        / -result["stiffness"].reshape(-1, result.steps)[0][step]
    )


def loop(results, options):
    """The loop of friction of a level, beside Mindlin's for a smooth sphere of the same radius,
    moduli and load."""
    found = _level(results, options)
    if not found:
        return None
    result, step = found
    page = Page(options)
    axis = page.axes[0]
    x, Q = result["tangential_displacement"][step], result["tangential_force"][step]
    axis.plot(x, Q, color=STYLES[0][2], label="rough")
    N, mu = result.mean("force")[step], result.number("solids%friction")
    R, E = float(result["r_star"]), float(result["e_star"])
    if np.isfinite(R) and R < 1e27:
        full = _slide_per_depth(result, step) * (3 * N / (4 * E * np.sqrt(R))) ** (2 / 3)
        drop = lambda t: mu * N * (1 - np.clip(1 - t, 0, None) ** 1.5)
        t, back, reach = np.linspace(0, 1, 61), np.linspace(0, 0.9, 61), drop(0.9)
        axis.plot(
            full * np.concatenate([t, 0.9 - 2 * back, -0.9 + 2 * back]),
            np.concatenate([drop(t), reach - 2 * drop(back), -reach + 2 * drop(back)]),
            STYLES[1][1],
            color=STYLES[1][2],
            label="smooth sphere (Mindlin)",
        )
    label(axis, "x", "tangential displacement", result.dimension("tangential_displacement"))
    label(axis, "y", "tangential force $Q$", result.dimension("tangential_force"))
    force = "" if result.control() == "force" else f", $N$ = {amount(N, result.dimension('force'))}"
    return page.finish(result.heading(f"Friction at {result.level_name(step)}{force}"))


def _sticking(page, axis, result, step):
    """Draws where a level by elements sticks and slips, from its fields; None without them."""
    if "field_traction" not in result or "field_pressure" not in result:
        return None
    at = np.flatnonzero(result["field_step"] == step + 1)
    if not at.size:
        return None
    pressure, traction = (result.window("field_" + n, int(at[0])) for n in ("pressure", "traction"))
    limit = result.number("solids%friction") * pressure
    slips = (pressure > 0) & (traction > (1 - 1e-6) * limit)
    kinds = [
        ((0, 0, 0, 0), None),
        (to_rgba(STYLES[0][2]), "sticks"),
        (to_rgba(STYLES[1][2]), "slips"),
    ]
    image = np.array([colour for colour, _ in kinds])[(pressure > 0) * 1 + slips]
    axis.imshow(image, extent=edges(result["field_x"], result["field_y"]))
    for colour, text in kinds[1:]:
        page.entry(text, marker="o", color=colour, ls="none")
    return "slide 50 % of full slip"


def _sticking_spots(page, axis, result, step):
    """The same for asperities: the stick region is the spot of an earlier level, Z0', with the
    slide (mu/m) (Z0' - Z0)."""
    if "contact_radius" not in result or result.by_elements():
        return None
    Z, count = result.mean("separation"), result["contact_count"].astype(int)
    full = result["tangential_displacement"][step].max()
    slides = _slide_per_depth(result, step) * (Z - Z[step])
    inner = int(np.argmin(abs(slides - 0.5 * full)))
    if not 0 < slides[inner] < full or count[step] == 0 or count[inner] == 0:
        return None
    for level, colour, text in ((step, STYLES[1][2], "slips"), (inner, STYLES[0][2], "sticks")):
        x, y, major = spots_of(result, level)[:3]
        looks = dict(facecolors=colour, edgecolors="none", gid=text)
        ellipses(axis, *spots_of(result, level)[:5], **looks)
        page.entry(text, marker="o", color=colour, ls="none")
        if level == step:
            low = np.array([(x - major).min(), (y - major).min()])
            high = np.array([(x + major).max(), (y + major).max()])
            window = square(low, high, None)
            axis.set(xlim=window[:2], ylim=window[2:], aspect="equal")
    return f"slide {slides[inner] / full:.0%} of full slip"


def stick(results, options):
    """Map of the stick and slip regions of a level at about half of the slide to full slip."""
    found = _level(results, options)
    if not found:
        return None
    result, step = found
    page = Page(options, aspect=0.85)
    axis = page.axes[0]
    slide = _sticking(page, axis, result, step) or _sticking_spots(page, axis, result, step)
    if not slide:
        return None
    for which in "xy":
        label(axis, which, f"${which}$", result.dimension("tip_" + which))
    return page.finish(result.heading(f"Contact at {result.level_name(step)}, {slide}"))
