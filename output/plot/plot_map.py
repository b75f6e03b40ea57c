"""Maps of the area fraction and of the pressure."""

import numpy as np

from plot_results import names
from plot_style import COLOURS, amount, colour_bar, label, plt, wrap_titles, wrapped

MOST = 36  # maps of several results on one page


def hertz_radius(result, step):
    """Radius of the contact of the smooth indenter; NaN if it is no circle."""
    return (
        float(np.sqrt(result["area_hertz"][step] / np.pi))
        if result.has_sphere() and result.shape() != "paraboloid"
        else np.nan
    )


def shown(results, options):
    """(result, level, name) of the panels: three levels of one result, or one level of each of several."""
    if len(results) == 1:
        count = 3 if options.width >= 120 else 2
        return [
            (results[0], level, results[0].level_name(level) + results[0].warning(level))
            for level in results[0].chosen(count, options.step)
        ]
    return [
        (r, level, f"{name}, {r.level_name(level)}{r.warning(level)}")
        for r, name in zip(results, names(results))
        for level in r.chosen(1, options.step)
    ]


def contact_window(x, y, field, side, whole, margin=0.15):
    """(x0, x1, y0, y1) of the smallest square that contains the cells where `field` is not zero, with a margin, within `whole`."""
    rows, columns = np.nonzero(field)
    if rows.size == 0:
        return whole
    ends = np.array(
        [
            x[columns.min()] - side / 2,
            x[columns.max()] + side / 2,
            y[rows.min()] - side / 2,
            y[rows.max()] + side / 2,
        ]
    )
    half = max(ends[1] - ends[0], ends[3] - ends[2], 4 * side) * (0.5 + margin)
    cx, cy = (ends[0] + ends[1]) / 2, (ends[2] + ends[3]) / 2
    return (
        max(cx - half, whole[0]),
        min(cx + half, whole[1]),
        max(cy - half, whole[2]),
        min(cy + half, whole[3]),
    )


def maps(results, options):
    """Area fraction and pressure in the cells at some levels of one result, or the pressure of several results; cropped to the contact. The circle
    is the contact of the smooth indenter under the same force."""
    panels = shown([r for r in results if "map_pressure" in r], options)
    if not panels:
        return None
    if len(panels) > MOST:
        options.say(f"map: {MOST} of {len(panels)} results are drawn, evenly spaced")
        panels = [panels[k] for k in np.linspace(0, len(panels) - 1, MOST).round().astype(int)]
    one = len(results) == 1
    quantities = (
        [("map_area_fraction", "area fraction $A'$"), ("map_pressure", "pressure $p$")]
        if one
        else [("map_pressure", "pressure $p$")]
    )
    beside = one and len(panels) == 1 and options.width >= 120  # both quantities in one row
    columns = (
        2
        if beside
        else len(panels)
        if one
        else int(np.ceil(np.sqrt((1.0 if len(panels) <= 9 else 1.6) * len(panels))))
    )
    rows = -(-len(panels) // columns)
    size = options.width / columns
    small = size < 46 and not one  # too small for its own colour bar and axes
    rows *= 1 if beside else len(quantities)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(
            options.width / 25.4,
            ((0.8 if not small else 1.05) * size * rows + (14 if one else 8 * rows)) / 25.4,
        ),
        constrained_layout=True,
        squeeze=False,
    )
    for axis in axes.ravel():
        axis.set_visible(False)
    images = []
    for k, (result, level, name) in enumerate(panels):
        for q, (variable, text) in enumerate(quantities):
            axis = axes[0, q] if beside else axes[q if one else k // columns, k % columns]
            axis.set_visible(True)
            image = _map(axis, result, level, variable)
            images.append(image)
            axis.locator_params(nbins=4 if size >= 46 else 2)
            if not small:
                colour_bar(
                    figure,
                    image,
                    axis,
                    text,
                    result.dimension(variable),
                    extend=image.extend,
                    fraction=0.06,
                    pad=0.03,
                    aspect=16,
                )
                label(axis, "y", "$y$", result.dimension("y"))
                label(axis, "x", "$x$", result.dimension("x"))
            else:
                axis.set(xticks=[], yticks=[])
            if q == 0 or beside:
                force = (
                    f"\n$N$ = {amount(result.mean('force')[level], result.dimension('force'))}"
                    if result.control() != "force" and not small
                    else ""
                )
                axis.set_title(name + force, fontsize=7 if not small else 5.5)
    if small:  # one scale for all
        lows, highs = zip(*(image.get_clim() for image in images))
        for image in images:
            image.set(
                cmap="coolwarm" if min(lows) < 0 else COLOURS,
                clim=(-max(highs) if min(lows) < 0 else 0, max(highs)),
            )
        colour_bar(
            figure,
            images[0],
            axes.ravel().tolist(),
            "pressure $p$",
            results[0].dimension("map_pressure"),
            extend="both" if min(lows) < 0 else "max",
            aspect=35,
        )
    smooth = sorted(
        {result.smooth() for result, level, _ in panels if np.isfinite(hertz_radius(result, level))}
    )
    what = ("Area fraction and pressure" if one else "Pressure") + (
        f"; dashed: {', '.join(smooth)} under the same force" if smooth else ""
    )
    figure.suptitle(
        wrapped(
            figure, results[0].heading(what) if one else what, options.width, "figure.titlesize"
        )
    )
    wrap_titles(figure)
    return figure


def _map(axis, result, level, name):
    (field, ends), x, y, side = (
        result.cells(name, level),
        result["x"],
        result["y"],
        float(result["map_cell_side"]),
    )
    # One per cent of the cells may be above the end of the scale, because they would hide the variation of all others.
    # Tension, with adhesion, is blue.
    end = np.percentile(np.abs(field[field != 0]), 99) if field.any() else 1.0
    pulls = field.min() < 0
    if name == "map_area_fraction":
        end = min(end, 1.0)  # above 1: a spot larger than the cell of its centre
    image = axis.imshow(
        np.ma.masked_equal(field, 0),
        extent=[x[0] - side / 2, x[-1] + side / 2, y[0] - side / 2, y[-1] + side / 2],
        cmap="coolwarm" if pulls else COLOURS,
        vmin=-end if pulls else 0,
        vmax=end,
        interpolation="nearest",
    )
    image.extend = (
        ("both" if field.min() < -end else "max")
        if field.max() > end
        else "min"
        if field.min() < -end
        else "neither"
    )
    radius = hertz_radius(result, level)
    if np.isfinite(radius):
        axis.add_patch(
            plt.Circle(
                (float(result["tip_x"]), float(result["tip_y"])),
                radius,
                fill=False,
                ls="--",
                lw=1.0,
                color="r",
            )
        )
    window = contact_window(x, y, result.cells("map_pressure", level)[0], side, ends)
    axis.set(xlim=window[:2], ylim=window[2:])
    return image
