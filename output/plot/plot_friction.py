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
    loops = np.flatnonzero(np.isfinite(results[0]["tangential_force"][:, -1, 0]))
    step = options.step - 1 if options.step is not None else int(loops[-1]) if loops.size else None
    return (results[0], step) if step in loops else None


def _stiffness_ratio(result):
    """m = 4 G*/E*: the tangential over the normal stiffness of a round contact."""
    (E, F), (nu, other) = ((float(v) for v in result.case[f"solids%{k}"].split(","))
                           for k in ("E", "nu"))
    normal = (1 - nu * nu) / E + (1 - other * other) / F
    return 2 * normal / ((2 - nu) * (1 + nu) / E + (2 - other) * (1 + other) / F)


def _along(result):
    """The direction of the cycles, a unit vector."""
    words = result.case.get("output%sliding_direction", "0")
    angle = np.radians(float(words)) if words.strip() else 0.0
    return np.array([np.cos(angle), np.sin(angle)])


def _smooth(result, step):
    """Tangential displacement and force of first loading of the smooth body, from 0 to full slip:
    Mindlin's sphere or Cattaneo's roller; and the name. None for other shapes."""
    N, mu, t = result.mean("force")[step], result.number("solids%friction"), np.linspace(0, 1, 61)
    R, E = float(result["r_star"]), float(result["e_star"])
    if "force_per_length" in result:
        b, D = result.half_width(step), result.line_reference()
        along = abs(_along(result)[1 if result.along_y() else 0])
        if not np.isfinite(b) or 1e-9 < along < 1 - 1e-9:
            return None
        # The load P lowers a cylinder by 2 P/(pi E*) [ln(2 D/b) + 1/2], and b^2 is as P.
        P = result.mean("force_per_length")[step]
        lowers = lambda load, half: 2 * load / np.pi / E * (
            np.log(2 * D / np.maximum(half, 1e-300)) + 0.5)
        inner = 1 - t
        x = mu * (lowers(P, b) - lowers(P * inner, b * np.sqrt(inner)))
        if along > 0.5:  # along the axis the body is softer, for equal bodies by 1/(1 - nu)
            x = x * (2 / _stiffness_ratio(result) - 1)
        return x, mu * N * t, "smooth cylinder (Cattaneo)"
    if not (np.isfinite(R) and R < 1e27) or result.shape() not in ("sphere", "paraboloid"):
        return None
    full = mu / _stiffness_ratio(result) * (3 * N / (4 * E * np.sqrt(R))) ** (2 / 3)
    return full * t, mu * N * (1 - np.clip(1 - t, 0, None) ** 1.5), "smooth sphere (Mindlin)"


def loop(results, options):
    """The loop of friction of a level, with that of a smooth sphere or roller of the same radius,
    moduli and load; of a path in two directions the tangential force along it."""
    found = _level(results, options)
    if not found:
        return None
    result, step = found
    page = Page(options)
    axis = page.axes[0]
    xi, force = result["tangential_displacement"][step], result["tangential_force"][step]
    N, mu = result.mean("force")[step], result.number("solids%friction")
    text = "" if result.control() == "force" else f", $N$ = {amount(N, result.dimension('force'))}"
    if "cycle" in result:
        along = _along(result)
        # First loading and the cycles are two slides, each from rest.
        first = result.file["point"].cycle[0] - 1
        axis.plot(np.insert(xi @ along, first, np.nan), np.insert(force @ along, first, np.nan),
                  color=STYLES[0][2], label="rough")
        smooth = _smooth(result, step)
        if smooth:
            x, Q, name = smooth
            reach = min((xi @ along)[first], x[-1])
            back = np.interp(np.linspace(0, reach, 61), x, Q)
            half = np.linspace(0, reach, 61)
            axis.plot(
                np.concatenate([x, [np.nan], reach - 2 * half, 2 * half - reach]),
                np.concatenate([Q, [np.nan], back[-1] - 2 * np.interp(half, x, Q),
                                2 * np.interp(half, x, Q) - back[-1]]),
                STYLES[1][1], color=STYLES[1][2], label=name,
            )
        label(axis, "x", "tangential displacement", result.dimension("tangential_displacement"))
        label(axis, "y", "tangential force $Q$", result.dimension("tangential_force"))
    else:
        axis.plot(*force.T, color=STYLES[0][2], label="along the path")
        angle = np.linspace(0, 2 * np.pi, 181)
        axis.plot(mu * N * np.cos(angle), mu * N * np.sin(angle), STYLES[1][1],
                  color=STYLES[1][2], label="full slip")
        axis.set_aspect("equal")
        for which in "xy":
            label(axis, which, f"tangential force $Q_{which}$",
                  result.dimension("tangential_force"))
    return page.finish(result.heading(f"Friction at {result.level_name(step)}{text}"))


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
    return "slide 50 % of full slip" if "cycle" in result else "end of the path"


def _sticking_spots(page, axis, result, step):
    """The same for asperities: the stick region is the spot of an earlier level, Z0', with the
    slide (mu/m) (Z0' - Z0)."""
    if "contact_radius" not in result or result.by_elements():
        return None
    Z, count = result.mean("separation"), result["contact_count"].astype(int)
    full = float(result["full_slip"][step])
    slides = result.number("solids%friction") / _stiffness_ratio(result) * (Z - Z[step])
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
