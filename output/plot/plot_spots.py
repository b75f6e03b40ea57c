"""The contact of a level over the heights: pixels of elements, spots of asperities."""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_rgba

from plot_results import edges
from plot_style import Page, amount, colour_bar, label, short

ELASTIC, YIELDING, PULLING = "#d62728", "#f2b400", "#1f6fd0"
# Of the flags of contact_mask.
FLAGS = [
    (None, (0, 0, 0, 0)),
    ("contact", to_rgba(ELASTIC)),
    ("yielding", to_rgba(YIELDING)),
    ("attracted", to_rgba(PULLING)),
]


def height_names(result):
    """The variables of the heights and their points: the whole surface, or the window of
    fields = 'heights'; None if the file has neither."""
    if "profile" in result:  # constant along y
        return None
    if "height" in result:
        return "height", *(("height_x", "height_y") if "height_x" in result else ("x", "y"))
    return ("field_height", "field_x", "field_y") if "field_height" in result else None


def heights_extent(result):
    """The sides x0, x1, y0, y1 of the stored heights; None if the file has none."""
    names = height_names(result)
    return edges(result[names[1]], result[names[2]]) if names else None


def heights(result, axis, window=None, bright=0.0, most=900):
    """Draws the heights in a window, at most `most` points in each direction; returns the image, or
    None if the file has no heights. bright: share of the darker end of the colours that is not
    used."""
    names = height_names(result)
    if not names:
        return None
    name, hx, hy = names[0], result[names[1]], result[names[2]]
    window = window or (hx[0], hx[-1], hy[0], hy[-1])
    dx, dy = hx[1] - hx[0], hy[1] - hy[0]
    i = np.flatnonzero((hx > window[0] - dx) & (hx < window[1] + dx))
    j = np.flatnonzero((hy > window[2] - dy) & (hy < window[3] + dy))
    if i.size < 2 or j.size < 2:
        return None
    stride = max(1, max(i.size, j.size) // most)
    last = (-1,) * (result.file.variables[name].ndim - 2)  # of a surface that wears
    z = result.window(name, *last, slice(j[0], j[-1] + 1, stride), slice(i[0], i[-1] + 1, stride))
    low, high = float(np.nanmin(z)), float(np.nanmax(z))
    return axis.imshow(
        z,
        vmin=low - bright * (high - low),
        vmax=high,
        extent=edges(hx[i], hy[j]),
        cmap="gray",
        interpolation="nearest",
    )


def spots_of(result, step):
    """x, y, major and minor semi-axes, angle of the major one, force and yielding of the spots of a
    level; None if the file has no spots."""
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


def spot_at(mask, wanted, row, column):
    """(rows, columns) of the pixels of the spot nearest to a place that has about half of the
    wanted number of pixels or more; a spot is connected by the sides of its pixels."""
    ny, nx = mask.shape
    touches = mask.ravel() > 0
    seen, largest = np.zeros(touches.size, bool), np.zeros(0, int)
    pixels = np.flatnonzero(touches)
    order = np.argsort((pixels // nx - row) ** 2 + (pixels % nx - column) ** 2, kind="stable")
    for k in pixels[order]:
        if seen[k]:
            continue
        front, parts = np.array([k]), []
        while front.size:
            seen[front] = True
            parts.append(front)
            i, j = front % nx, front // nx
            sides = [front[i > 0] - 1, front[i < nx - 1] + 1]
            near = np.concatenate(sides + [front[j > 0] - nx, front[j < ny - 1] + nx])
            front = np.unique(near[touches[near] & ~seen[near]])
        spot = np.concatenate(parts)
        largest = max(largest, spot, key=len)
        if 2 * largest.size >= wanted:
            break
    return largest // nx, largest % nx


def ellipses(axis, x, y, major, minor, angle, **looks):
    """Draws ellipses of these semi-axes; none if there are none, which matplotlib 3.6 draws as one
    big ellipse."""
    if not np.size(x):
        return None
    wide, high, turn = 2 * major, 2 * minor, np.degrees(angle)
    places = dict(units="xy", offsets=np.column_stack([x, y]), transOffset=axis.transData)
    return axis.add_collection(EllipseCollection(wide, high, turn, **places, **looks))


def draw_spots(axis, spots, least=0.0, edge=0.0, page=None):
    """Spots as ellipses, elastic ones, those that yield and those under tension in different
    colours, with entries in the legend of a page; least: the smallest semi-axis drawn."""
    x, y, major, minor, angle, f, yields = spots
    major, minor = np.maximum(major, least), np.maximum(minor, least)
    for some, colour, name in (
        (~yields & (f >= 0), ELASTIC, "contact"),
        (~yields & (f < 0), PULLING, "contact under tension"),
        (yields, YIELDING, "yielding"),
    ):
        if page and some.any():
            page.entry(name, marker="o", color=colour, ls="none", ms=5)
        looks = dict(facecolors=colour, edgecolors="k", linewidths=edge, gid=name)
        ellipses(axis, *(v[some] for v in (x, y, major, minor, angle)), **looks)


def draw_pixels(page, axis, result, step):
    """The pixels in contact of a level by elements; False if the file has none."""
    pixels = result.pixels(step)
    if not pixels:
        return False
    mask, extent = pixels
    axis.imshow(np.array([colour for _, colour in FLAGS])[mask], extent=extent, gid="pixels")
    for flag in np.unique(mask[mask > 0]):
        page.entry(FLAGS[flag][0], marker="o", color=FLAGS[flag][1], ls="none", ms=5)
    return True


def hertz_radius(result, step):
    """Radius of the contact of the smooth indenter; NaN if it is no circle."""
    if not result.has_sphere() or result.shape() == "paraboloid":
        return np.nan
    return float(np.sqrt(result["area_hertz"][step] / np.pi))


def with_smooth(result, step, low, high):
    """The corners of a window that also contains the contact of the smooth indenter."""
    a = hertz_radius(result, step)
    tip = np.array([float(result["tip_" + of]) for of in "xy"]) if np.isfinite(a) else low
    a = np.nan_to_num(a)
    return np.minimum(low, tip - a), np.maximum(high, tip + a)


def draw_smooth(page, axis, result, step):
    """The outline of the contact of the smooth indenter under the same force."""
    half = result.half_width(step)
    if np.isfinite(half):
        along_y = result.along_y()
        tip = float(result["tip_x" if along_y else "tip_y"])
        for place in (tip - half, tip + half):
            (axis.axvline if along_y else axis.axhline)(place, ls="--", lw=1.0, color="k")
        page.entry("smooth cylinder (Hertz)", ls="--", lw=1.0, color="k")
    elif np.isfinite(hertz_radius(result, step)):
        t = np.linspace(0, 2 * np.pi, 181)
        a = hertz_radius(result, step)
        x, y = (float(result["tip_" + of]) for of in "xy")
        axis.plot(
            x + a * np.cos(t),
            y + a * np.sin(t),
            "k--",
            lw=1.0,
            label=result.smooth() + ", same force",
            gid="smooth",
        )


def square(low, high, sides, margin=0.08, least=0.0):
    """(x0, x1, y0, y1) of the square about low ... high with a margin, within the surface."""
    half = max(np.max(high - low) * (0.5 + margin), least)
    window = []
    for centre, ends in zip((low + high) / 2, np.reshape(sides, (2, 2)) if sides else (None,) * 2):
        if ends is None:
            window += [centre - half, centre + half]
        elif 2 * half >= ends[1] - ends[0]:
            window += list(ends)
        else:
            centre = np.clip(centre, ends[0] + half, ends[1] - half)
            window += [centre - half, centre + half]
    return np.array(window)


def drawn_level(result, step):
    """The wanted level (from 1), otherwise the deepest one, with adhesion the one on the way up
    with the force nearest to zero, where some spots push and others pull."""
    if step is not None:
        return step - 1
    touching = np.flatnonzero(result["contact_count"] > 0)
    depth = -result.mean("separation")[touching] if "separation" in result else touching
    deepest = int(touching[np.flatnonzero(depth >= depth.max())[-1]])
    after = touching[touching >= deepest]
    if result.pulls() and after.size > 1:
        return int(after[np.argmin(abs(result.mean("force")[after]))])
    return deepest


def spots(results, options):
    """The contact of a level over the heights: all of it, and around the largest spot."""
    result = results[0]
    if len(results) > 1 or "contact_count" not in result or "profile" in result:
        return None
    if not (result["contact_count"] > 0).any():
        return None
    step = drawn_level(result, options.step)
    found = spots_of(result, step)
    if found is None:
        return None
    x, y, a, _, _, _, yields = found
    big = int(np.argmax(a))
    pixels, sides = result.pixels(step), result.sides()
    if pixels:
        mask, extent = pixels
        rows, columns = np.nonzero(mask)
        dx, dy = ((extent[k + 1] - extent[k]) / n for k, n in zip((0, 2), mask.shape[::-1]))
        spot = spot_at(
            mask,
            np.pi * a[big] ** 2 / (dx * dy),
            (y[big] - extent[2]) / dy,
            (x[big] - extent[0]) / dx,
        )
        corner, side = np.array([extent[0], extent[2]]), np.array([dx, dy])
        low, high, first, last = (
            corner + side * place
            for j, i in ((rows, columns), spot)
            for place in ((i.min(), j.min()), (i.max() + 1, j.max() + 1))
        )
        least = 6 * max(dx, dy)
    else:
        low = np.array([(x - a).min(), (y - a).min()])
        high = np.array([(x + a).max(), (y + a).max()])
        place = np.array([x[big], y[big]])
        first, last = place - a[big], place + a[big]
        least = max(14 * np.median(a), 4 * a[big])
    low, high = with_smooth(result, step, low, high)
    known = heights_extent(result)
    if known and (low >= known[::2]).all() and (high <= known[1::2]).all():
        sides = known  # no white beside the heights
    whole = square(low, high, sides, least=least if pixels else 0.0)
    half = (whole[1] - whole[0]) / 2
    rim = (last - first).max() > 1.2 * half  # the largest fills the left panel
    if rim:
        middle = np.array([last[0], (first[1] + last[1]) / 2])
        first, last = middle - half / 4, middle + half / 4
    windows = whole, square(first, last, sides, least=min(least, half))
    page = Page(options, 2, aspect=1.0 if height_names(result) is None else 0.9)
    images = []
    for axis, window in zip(page.axes, windows):
        left = axis is page.axes[0]
        images.append(heights(result, axis, tuple(window), bright=0.8))
        if not draw_pixels(page, axis, result, step):
            size = (window[1] - window[0]) / 2
            draw_spots(axis, found, 0.006 * size if left else 0.0, 0.0 if left else 0.3, page)
        draw_smooth(page, axis, result, step)
        if not left and "asperity_x" in result:
            ax, ay = result["asperity_x"], result["asperity_y"]
            inside = (ax >= window[0]) & (ax <= window[1]) & (ay >= window[2]) & (ay <= window[3])
            axis.plot(ax[inside], ay[inside], "+", color="#0b6fa4", ms=4, mew=0.7, label="summits")
        axis.set(xlim=window[:2], ylim=window[2:], aspect="equal")
        axis.locator_params(nbins=5)
        for which in "xy":
            label(axis, which, f"${which}$", result.dimension(which) if which in result else "m")
    if images[1] is not None:
        images[1].set_clim(images[0].get_clim())
        low, high = images[0].get_array().min(), images[0].get_array().max()
        dimension = result.dimension(height_names(result)[0])
        how = dict(shrink=0.85, aspect=25)
        bar = colour_bar(page.figure, images[0], page.axes[1], "height $z$", dimension, **how)
        bar.ax.set_ylim(low, high)  # the darker half of the greys is for the spots
    if result.has_tip():
        tip = [float(result["tip_x"]), float(result["tip_y"])]
        if whole[0] < tip[0] < whole[1] and whole[2] < tip[1] < whole[3]:
            page.axes[0].plot(*tip, "kx", ms=6, label="tip", ls="none", zorder=4)
    page.axes[0].set_title(
        f"{x.size} spot{'s' if x.size > 1 else ''}"
        + (f", {yields.sum()} yield" if yields.any() and not pixels else "")
        + (
            f", {short(100 * np.mean(mask[mask > 0] == 2), 2)} % of the area yields"
            if yields.any() and pixels
            else ""
        )
        + ("" if pixels else "; the smallest are drawn larger")
    )
    page.axes[1].set_title(f"{'at the rim of' if rim else 'around'} the largest")
    force = (
        ""
        if result.control() in ("force", "pressure")
        else f", $N$ = {amount(result.mean('force')[step], result.dimension('force'))}"
    )
    return page.finish(
        result.heading(f"Contact at {result.level_name(step)}{force}{result.warning(step)}")
    )
