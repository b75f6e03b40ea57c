"""The contact spots of a level over the heights."""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_rgb

from plot_style import Page, amount, colour_bar, label

ELASTIC, YIELDING, PULLING = "#d62728", "#f2b400", "#1f6fd0"


def heights(result, axis, window=None, bright=0.0, most=900):
    """Draws the heights in a window, at most `most` points in each direction; returns the image, or None if the file has no heights. bright:
    share of the darker end of the colours that is not used."""
    if "height" not in result:
        return None
    hx, hy = (
        result[next(n for n in found if n in result)]
        for found in (("height_x", "x"), ("height_y", "y"))
    )
    window = window or (hx[0], hx[-1], hy[0], hy[-1])
    dx, dy = hx[1] - hx[0], hy[1] - hy[0]
    i, j = np.flatnonzero((hx > window[0] - dx) & (hx < window[1] + dx)), np.flatnonzero(
        (hy > window[2] - dy) & (hy < window[3] + dy)
    )
    if i.size < 2 or j.size < 2:
        return None
    stride = max(1, max(i.size, j.size) // most)
    z = result.window("height", slice(j[0], j[-1] + 1, stride), slice(i[0], i[-1] + 1, stride))
    low, high = float(np.nanmin(z)), float(np.nanmax(z))
    return axis.imshow(
        z,
        vmin=low - bright * (high - low),
        vmax=high,
        extent=[hx[i[0]] - dx / 2, hx[i[-1]] + dx / 2, hy[j[0]] - dy / 2, hy[j[-1]] + dy / 2],
        cmap="gray",
        interpolation="nearest",
    )


def spots_of(result, step):
    """x, y, major and minor semi-axes, angle of the major one, force and yielding of the spots of a level; None if the file has no spots."""
    if (
        "contact_start" not in result
        or "contact_radius" not in result
        or not result["contact_count"][step] > 0
    ):
        return None
    first, count = int(result["contact_start"][step]) - 1, int(result["contact_count"][step])
    span = slice(first, first + count)
    yields = (
        result.window("contact_yields", span) > 0
        if "contact_yields" in result
        else np.zeros(count, bool)
    )
    force = result.window("contact_force", span)
    if "contact_major" in result:
        return (
            *(
                result.window("contact_" + name, span)
                for name in ("spot_x", "spot_y", "major", "minor", "angle")
            ),
            force,
            yields,
        )
    if "contact_x" in result:
        x, y = result.window("contact_x", span), result.window("contact_y", span)
    elif "contact_asperity" in result:
        which = result.window("contact_asperity", span).astype(int) - 1
        x, y = result["asperity_x"][which], result["asperity_y"][which]
    else:
        return None
    a = result.window("contact_radius", span)
    return x, y, a, a, 0 * a, force, yields


def pixels_of(result, step):
    """(extent, area fraction) on the points of a level solved by elements, from the fields of the file, or else in the cells of
    the map; None for asperities, and if the file has neither."""
    if not result.by_elements():
        return None
    at = (
        np.flatnonzero(result["field_step"].astype(int) == step + 1)
        if "field_pressure" in result
        else np.array([], int)
    )
    if at.size:
        x, y, share = (
            result["field_x"],
            result["field_y"],
            1.0
            * (
                result.window(
                    "field_contact" if "field_contact" in result else "field_pressure", int(at[0])
                )
                > 0
            ),
        )
    elif "map_area_fraction" in result:
        share, (x0, x1, y0, _) = result.cells("map_area_fraction", step)
        return (x0, x1, y0, y0 + len(share) * float(result["map_cell_side"])), np.clip(share, 0, 1)
    else:
        return None
    dx, dy = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
    return (x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy), np.clip(share, 0, 1)


def draw_spots(axis, spots, least=0.0, edge=0.0):
    """Spots as ellipses, elastic ones, those that yield and those under tension in different colours; least: the smallest semi-axis drawn."""
    x, y, major, minor, angle, f, yields = spots
    for some, colour, name in (
        (~yields & (f >= 0), ELASTIC, "spots"),
        (yields, YIELDING, "yielding spots"),
        (~yields & (f < 0), PULLING, "pulling spots"),
    ):
        if some.any():  # matplotlib 3.6 draws an empty EllipseCollection as one big ellipse
            wide, high = (2 * np.maximum(axes[some], least) for axes in (major, minor))
            axis.add_collection(
                EllipseCollection(
                    wide,
                    high,
                    np.degrees(angle[some]),
                    units="xy",
                    offsets=np.column_stack([x[some], y[some]]),
                    transOffset=axis.transData,
                    facecolors=colour,
                    edgecolors="k",
                    linewidths=edge,
                    gid=name,
                )
            )


def spots(results, options):
    """The contact spots of a level over the heights: all of them, and those around the largest at true size. The level is the deepest one, with
    adhesion the one with the force nearest to zero on the way up, where some spots push and others pull.
    """
    result = results[0]
    if len(results) > 1 or "contact_count" not in result or not (result["contact_count"] > 0).any():
        return None
    touching = np.flatnonzero(result["contact_count"] > 0)
    depth = -result.mean("separation")[touching] if "separation" in result else touching
    step = (
        options.step - 1
        if options.step is not None
        else int(touching[np.flatnonzero(depth >= depth.max())[-1]])
    )  # deepest penetration
    if options.step is None and "pull_off_force" in result and touching[-1] > step:
        after = touching[touching >= step]
        step = int(after[np.argmin(abs(result.mean("force")[after]))])
    found = spots_of(result, step)
    if found is None:
        return None
    x, y, a, _, _, f, yields = found
    big = int(np.argmax(a))
    low, high = np.array([(x - a).min(), (y - a).min()]), np.array([(x + a).max(), (y + a).max()])
    half = 0.54 * (high - low).max()
    page = Page(options, 2, aspect=0.86)
    pixels = pixels_of(result, step)
    most = pixels[1].max() if pixels else 1.0  # cells much larger than spots would be pale
    if pixels:  # at least some points around few ones
        side = (pixels[0][1] - pixels[0][0]) / pixels[1].shape[1]
        half = max(half + 2 * side, 6 * side)
    near = max(half / 4, 4 * side) if pixels else min(max(14 * np.median(a), 4 * a[big]), half)
    rim = bool(pixels) and a[big] > near  # the inside of the largest would have one colour
    image = None
    for axis, centre, h in zip(
        page.axes, ((low + high) / 2, np.array([x[big] + rim * a[big], y[big]])), (half, near)
    ):
        if "x" in result:  # stay on the surface if it is large enough
            ends = np.array(result.cells("map_area_fraction", step)[1]).reshape(2, 2)
            centre = np.where(
                ends[:, 1] - ends[:, 0] > 2 * h,
                np.clip(centre, ends[:, 0] + h, ends[:, 1] - h),
                centre,
            )
        window = (centre[0] - h, centre[0] + h, centre[1] - h, centre[1] + h)
        drawn = heights(result, axis, window, bright=0.8)
        image = image or drawn
        if pixels:
            axis.imshow(
                np.dstack(
                    [np.broadcast_to(c, pixels[1].shape) for c in to_rgb(ELASTIC)]
                    + [pixels[1] / (most or 1.0)]
                ),
                extent=pixels[0],
                interpolation="nearest",
                gid="pixels",
            )
        else:
            draw_spots(
                axis,
                found,
                least=0.006 * h if axis is page.axes[0] else 0.0,
                edge=0.0 if axis is page.axes[0] else 0.3,
            )
        if axis is page.axes[1] and "asperity_x" in result:
            ax, ay = result["asperity_x"], result["asperity_y"]
            inside = (abs(ax - centre[0]) <= h) & (abs(ay - centre[1]) <= h)
            axis.plot(ax[inside], ay[inside], "+", color="#0b6fa4", ms=4, mew=0.7, label="summits")
        axis.set(xlim=window[:2], ylim=window[2:], aspect="equal")
        axis.locator_params(nbins=5)
        label(axis, "x", "$x$", result.dimension("x") if "x" in result else "m")
        label(axis, "y", "$y$", result.dimension("y") if "y" in result else "m")
    if drawn is not None:
        drawn.set_clim(image.get_clim())
        low, high = image.get_array().min(), image.get_array().max()
        bar = colour_bar(
            page.figure,
            image,
            page.axes[1],
            "height $z$",
            result.dimension("height"),
            shrink=0.85,
            aspect=25,
        )
        bar.ax.set_ylim(low, high)  # the darker half of the greys is for the spots
    if (
        result.has_tip()
        and max(
            abs(float(result["tip_x"]) - sum(page.axes[0].get_xlim()) / 2),
            abs(float(result["tip_y"]) - sum(page.axes[0].get_ylim()) / 2),
        )
        < half
    ):
        page.axes[0].plot(
            float(result["tip_x"]),
            float(result["tip_y"]),
            "kx",
            ms=6,
            label="tip",
            ls="none",
            zorder=4,
        )
    if pixels or (~yields & (f >= 0)).any():
        page.entry(
            "elastic" if "contact_yields" in result and not pixels else "contact",
            marker="o",
            color=ELASTIC,
            ls="none",
            ms=5,
        )
    if (f < 0).any() and not pixels:
        page.entry("contact under tension", marker="o", color=PULLING, ls="none", ms=5)
    if yields.any() and not pixels:
        page.entry("yielding", marker="o", color=YIELDING, ls="none", ms=5)
    what = (
        "discs of their area"
        if result.by_elements() and not pixels
        else "points in contact"
        if pixels and "field_pressure" in result
        else f"share of each cell in contact, at most {most:.2g}"
        if pixels
        else "true to size"
    )
    page.axes[0].set_title(
        f"{x.size} spot{'s' if x.size > 1 else ''}"
        + (f", {yields.sum()} yield" if "contact_yields" in result else "")
        + ("" if pixels else "; the smallest are drawn larger")
    )
    page.axes[1].set_title(
        f"{'at the rim of' if rim else 'in' if pixels else 'around'} the largest: {what}"
    )
    force = (
        ""
        if result.control() == "force"
        else f", $N$ = {amount(result.mean('force')[step], result.dimension('force'))}"
    )
    return page.finish(
        result.heading(f"Contact spots at {result.level_name(step)}{force}{result.warning(step)}")
    )
