"""Asperities against elements (&compare): the spots of both over each other, the pressure of both along a line, and the error at every level compared."""

import numpy as np
from matplotlib.collections import EllipseCollection

from plot_results import names
from plot_style import STYLES, plt

SIDE = 60  # pixels shown on either side of the one with the highest pressure


def _spots(result, step):
    """x, y, radius, force, ratio of the axes and angle of the asperities in contact at level `step`, and whether they yield; None where the file does not hold them."""
    if "contact_asperity" not in result or int(result["contact_count"][step]) == 0:
        return None
    at = int(result["contact_start"][step]) - 1 + np.arange(int(result["contact_count"][step]))
    asperity = np.asarray(result["contact_asperity"])[at].astype(int) - 1
    ratio, angle = np.ones(asperity.size), np.zeros(asperity.size)
    if "asperity_kappa1" in result and result.case.get("asperities%law", "'hertz'").strip("'") != "hertz":
        ratio = (np.asarray(result["asperity_kappa1"])[asperity] / np.asarray(result["asperity_kappa2"])[asperity]) ** (2 / 3)  # near enough for a picture
        angle = np.asarray(result["asperity_angle"])[asperity]
    return (np.asarray(result["asperity_x"])[asperity], np.asarray(result["asperity_y"])[asperity], np.asarray(result["contact_radius"])[at],
            np.asarray(result["contact_force"])[at], ratio, angle, np.asarray(result["contact_yields"])[at] if "contact_yields" in result else np.zeros(at.size))


def _line(spots, y, x0, x1):
    """Hertz's pressures of the spots along the line at y from x0 to x1; those that yield carry theirs everywhere."""
    x = np.linspace(x0, x1, 2000)
    p = np.zeros_like(x)
    for sx, sy, a, f, ratio, angle, yields in zip(*spots):
        major, minor = a * np.sqrt(ratio), a / np.sqrt(ratio)
        u = (x - sx) * np.cos(angle) + (y - sy) * np.sin(angle)
        v = -(x - sx) * np.sin(angle) + (y - sy) * np.cos(angle)
        inside = 1 - (u / major) ** 2 - (v / minor) ** 2
        p += np.where(inside > 0, f / (np.pi * a * a) * (1 if yields else 1.5 * np.sqrt(np.maximum(inside, 0))), 0)
    return x, p


def compare(results, options):
    """What &compare found, of the first result that has it."""
    with_elements = [r for r in results if "compare_step" in r]
    if not with_elements:
        return None
    result = with_elements[0]
    if len(with_elements) > 1:
        options.say(f"compare: {names(results)[results.index(result)]} is drawn, give one file at a time for the others")
    steps = np.asarray(result["compare_step"]).astype(int) - 1
    pixels = "compare_pixel_x" in result
    figure, axes = plt.subplots(1, 3 if pixels else 1, figsize=(options.width / 25.4, options.width / 25.4 * (0.40 if pixels else 0.7)), constrained_layout=True, squeeze=False)
    axes = axes[0]
    errors = axes[-1]
    for k, (name, label) in enumerate([("force_error", "$N$"), ("area_error", "$A$"), ("contacts_error", "contacts")]):
        marker, line, colour = STYLES[k]
        errors.plot(np.asarray(result["separation_sigma"])[steps] if np.ndim(result["separation_sigma"]) == 1 else steps + 1, 100 * np.asarray(result[name]), marker + line, color=colour, ms=3,
                    label=label)
    errors.axhline(0, color="k", lw=0.6)
    errors.set_xlabel(r"$Z_0/\sigma$" if np.ndim(result["separation_sigma"]) == 1 else "level")
    errors.set_ylabel("asperities over elements $-$ 1 [%]", fontsize=7)
    errors.legend()
    step = int(steps[-1])
    if not pixels:
        figure.suptitle(result.heading("Errors of the asperity model"), fontsize=8)
        return figure
    # Around the pixel of the highest pressure.
    px, py, pressure = (np.asarray(result["compare_pixel_" + name]) for name in ("x", "y", "pressure"))
    hx, hy = (float(result.attribute("compare_pixel_" + name, "pixel_size")[0]) for name in ("x", "y"))
    spots = _spots(result, step)
    peak = int(np.argmax(pressure))
    if spots is not None and np.sum(pressure == pressure[peak]) > 1:  # many at the hardness: in the spot of the largest force
        strongest = int(np.argmax(spots[3]))
        peak = int(np.argmin(np.hypot(px - spots[0][strongest], py - spots[1][strongest])))
    # As many pixels on either side of that one; their places are the middles of the cells of the image.
    x0, x1, y0, y1 = px[peak] - (SIDE + 0.5) * hx, px[peak] + (SIDE + 0.5) * hx, py[peak] - (SIDE + 0.5) * hy, py[peak] + (SIDE + 0.5) * hy
    near = (px > x0) & (px < x1) & (py > y0) & (py < y1)
    axis = axes[0]
    image = np.zeros((2 * SIDE + 1, 2 * SIDE + 1))
    image[((py[near] - y0) / hy).astype(int), ((px[near] - x0) / hx).astype(int)] = 1
    axis.imshow(image, extent=(x0, x1, y0, y1), cmap="Greys", vmin=0, vmax=2, interpolation="nearest")
    if spots is not None:
        x, y, a, _, ratio, angle, _ = spots
        reach = a * np.sqrt(ratio)
        some = (x > x0 - reach) & (x < x1 + reach) & (y > y0 - reach) & (y < y1 + reach)
        axis.add_collection(EllipseCollection(2 * (a * np.sqrt(ratio))[some], 2 * (a / np.sqrt(ratio))[some], np.degrees(angle)[some], units="x", offsets=np.c_[x, y][some],
                                              transOffset=axis.transData, facecolors="none", edgecolors="#c1440e", linewidths=0.8))
    axis.axhline(py[peak], color="#0b3c5d", lw=0.6, ls=":")
    axis.set(xlim=(x0, x1), ylim=(y0, y1), xlabel=f"$x${result.unit('compare_pixel_x')}", ylabel=f"$y${result.unit('compare_pixel_y')}")
    axis.set_title("grey: elements; red: asperities", fontsize=7)
    axis.tick_params(labelsize=6)
    line = axes[1]
    at = near & (np.abs(py - py[peak]) < 0.25 * hy)
    values = np.zeros(2 * SIDE + 1)
    values[((px[at] - x0) / hx).astype(int)] = pressure[at]
    line.stairs(values, x0 + hx * np.arange(2 * SIDE + 2), color="#0b3c5d", label="elements")
    top = values.max()
    if spots is not None:
        x, p = _line(spots, py[peak], x0, x1)
        line.plot(x, p, "--", color="#c1440e", label="asperities")
        top = max(top, p.max())
    line.set_ylim(0, 1.4 * top)  # room for the legend above the peak
    line.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
    line.set(xlabel=f"$x${result.unit('compare_pixel_x')}", ylabel=f"pressure{result.unit('compare_pixel_pressure')}", xlim=(x0, x1))
    line.tick_params(labelsize=6)
    line.legend(loc="upper right")
    figure.suptitle(result.heading(f"Spots and pressure at {result.level_name(step)}, errors of the asperity model"), fontsize=8)
    return figure
