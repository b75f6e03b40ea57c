"""Maps of the contact and of the pressure."""

import numpy as np
from matplotlib.colors import PowerNorm

from plot_curves import title
from plot_results import edges, names
from plot_spots import draw_pixels, draw_smooth, draw_spots, ellipses, heights, spots_of
from plot_spots import with_smooth
from plot_style import COLOURS, Page, amount, colour_bar, label

MOST = 36  # maps of several results on one page


def shown(results, options):
    """((result, level, name) of the panels, what is common to all names): three levels of one
    result, or one level of each of several."""
    if len(results) == 1:
        count = 3 if options.width >= 120 else 2
        levels = [(results[0], level) for level in results[0].chosen(count, options.step)]
        named = [""] * len(levels)
    else:
        chosen = [(r, name, r.chosen(1, options.step)) for r, name in zip(results, names(results))]
        levels = [(r, found[0]) for r, _, found in chosen if found]
        named = [name for _, name, found in chosen if found]
    texts = [r.level_name(level) + r.warning(level) for r, level in levels]
    common = texts[0] if len(results) > 1 and len(set(texts)) == 1 else ""
    return [
        (*panel, ", ".join(filter(None, (name, text if not common else ""))))
        for panel, name, text in zip(levels, named, texts)
    ], common


def _pressure(result, level, fields=True):
    """What the file has of the pressure at a level, the most detailed first: ('field', values,
    extent), ('pixels', means of the cells at the pixels in contact, extent), ('spots', mean
    pressures, spots), ('cells', values, extent)."""
    if fields and "field_pressure" in result and level + 1 in result["field_step"]:
        at = int(np.flatnonzero(result["field_step"] == level + 1)[0])
        values = result.window("field_pressure", at)
        return "field", values, edges(result["field_x"], result["field_y"])
    if result.pixels(level):
        return "pixels", _at_pixels(result, level), result.pixels(level)[1]
    spots = spots_of(result, level) if result.realizations == 1 else None
    if spots is not None:
        return "spots", spots[5] / (np.pi * spots[2] * spots[3]), spots
    return _of_cells(result, level)


def _of_cells(result, level):
    return "cells", result.cells("map_pressure", level)[0], edges(result["x"], result["y"])


def _overlap(x, step, first, side, count):
    """The share of each of `count` cells along an axis that each pixel covers, [cell, pixel]; what
    lies outside the map belongs to its first or last cell. In the map a pixel begins at its
    point."""
    low, high = (x - first) / side, (x + step - first) / side
    begin = np.arange(float(count))[:, None]
    end = begin + 1
    begin[0], end[-1] = -np.inf, np.inf
    return np.clip(np.minimum(high, end) - np.maximum(low, begin), 0, None)


def _at_pixels(result, level):
    """Force per area of the pixels in contact in a cell of the map, between cells linear."""
    mask, (x0, x1, y0, y1) = result.pixels(level)
    dx, dy = (x1 - x0) / mask.shape[1], (y1 - y0) / mask.shape[0]
    x, y = (
        start + d * (np.arange(n) + 0.5) for start, d, n in zip((x0, y0), (dx, dy), mask.T.shape)
    )
    pressure, (left, _, low, _) = result.cells("map_pressure", level)
    side = float(result["map_cell_side"])
    along_x = _overlap(x, dx, left, side, pressure.shape[1])
    along_y = _overlap(y, dy, low, side, pressure.shape[0])
    share = along_y @ (mask > 0) @ along_x.T
    share[-1] /= float(getattr(result.file["y"], "share_of_last_row", 1.0))

    def between(values):
        rows = np.array([np.interp(x + dx / 2, result["x"], row) for row in values])
        return np.array([np.interp(y + dy / 2, result["y"], column) for column in rows.T]).T

    share = between(share)
    found = np.divide(between(pressure), share, out=np.zeros(mask.shape), where=share > 0)
    return np.where(mask > 0, found, 0)


def _window(panels):
    """The smallest square that contains the contact of all panels, of a line contact across its
    axis, within the surface."""
    lows, highs, sides = [], [], panels[0][0].sides()
    for result, level, _ in panels:
        field, half = result.cells("map_pressure", level)[0], float(result["map_cell_side"]) / 2
        places = [result[of][k] for of, k in zip("yx", np.nonzero(field))][::-1]
        if places[0].size:
            low, high = (np.array([f(v) for v in places]) for f in (np.min, np.max))
            low, high = with_smooth(result, level, low - half, high + half)
            lows.append(low)
            highs.append(high)
    if not lows:
        return sides
    low, high = np.min(lows, axis=0), np.max(highs, axis=0)
    extent = high - low
    if "force_per_length" in panels[0][0]:  # a part of the length
        extent[1 if panels[0][0].along_y() else 0] = 0
    half = 0.62 * max(extent)
    centre = (low + high) / 2
    return (
        max(centre[0] - half, sides[0]),
        min(centre[0] + half, sides[1]),
        max(centre[1] - half, sides[2]),
        min(centre[1] + half, sides[3]),
    )


def maps(results, options):
    """Contact and pressure at some levels of one result, or the pressure of several results, with
    one colour scale, cropped to the contact. Contact is drawn at the pixels of elements or by the
    spots of asperities, and means over realizations in the cells of the map. Dashed: the contact of
    the smooth indenter under the same force."""
    # Means over pairs of flats are the same everywhere but for the noise of few surfaces.
    # Profiles are constant along y: the picture profile shows their contact.
    results = [
        r
        for r in results
        if "map_pressure" in r
        and "profile" not in r
        and not ("pressure" in r and r.realizations > 1)
    ]
    panels, common = shown(results, options)
    if not panels:
        return None
    if len(panels) > MOST:
        options.say(f"map: {MOST} of {len(panels)} results are drawn, evenly spaced")
        panels = [panels[k] for k in np.linspace(0, len(panels) - 1, MOST).round().astype(int)]
    one = len(results) == 1
    pressures = [_pressure(r, level) for r, level, _ in panels]
    if any(kind != "field" for kind, _, _ in pressures):
        pressures = [_pressure(r, level, fields=False) for r, level, _ in panels]
    if any(kind == "cells" for kind, _, _ in pressures):
        pressures = [_of_cells(r, level) for r, level, _ in panels]
    known = [r.pixels(level) or spots_of(r, level) for r, level, _ in panels]
    contact = all(found is not None for found in known) and panels[0][0].realizations == 1
    first = "contact" if one and contact else "map_area_fraction"
    quantities = [first, "map_pressure"] if one else ["map_pressure"]
    columns = (
        len(panels)
        if one
        else int(np.ceil(np.sqrt((1.0 if len(panels) <= 9 else 1.6) * len(panels))))
    )
    if one and len(panels) == 1:
        columns = 2  # both quantities in one row
    size = options.width / columns
    small = size < 30  # no room for axes
    same = len({tuple(np.round(r.sides(), 15)) for r, _, _ in panels}) == 1
    window = _window(panels) if same else None
    shape = (window[3] - window[2]) / (window[1] - window[0]) if same else 1.0
    rows = -(-len(panels) * len(quantities) // columns)
    title_room = (10 if one else 10 * rows) / rows
    page = Page(
        options, len(panels) * len(quantities), (0.8 * shape * size + title_room) / size, columns
    )
    grid = np.array(page.axes, dtype=object)
    for q, variable in enumerate(quantities):
        axes = grid[q * len(panels) : (q + 1) * len(panels)]
        drawn = pressures
        if variable == "map_area_fraction":
            drawn = [
                ("cells", r.cells(variable, level)[0], edges(r["x"], r["y"]))
                for r, level, _ in panels
            ]
        norm, extend = _scale([values for _, values, _ in drawn], variable)
        image = None
        for k, (axis, (result, level, name)) in enumerate(zip(axes, panels)):
            inside = window or _window([panels[k]])
            if variable == "contact":
                heights(result, axis, window, bright=0.8)
                if not draw_pixels(page, axis, result, level):
                    draw_spots(axis, spots_of(result, level), least=_visible(inside), page=page)
            else:
                image = _image(axis, *drawn[k], norm, _visible(inside)) or image
            draw_smooth(page, axis, result, level)
            axis.set(xlim=inside[:2], ylim=inside[2:], aspect="equal")
            axis.dataLim.set_points(np.reshape(inside, (2, 2)).T)  # for the unit of the labels
            if q == 0:
                axis.set_title(_heading(result, level, name), fontsize=5.5 if small else 7)
            place = q * len(panels) + k
            lowest = place + columns >= grid.size
            _axes(axis, result, small, same and place % columns > 0, same and not lowest)
        if image is not None:
            text = "area fraction $A'$" if variable == "map_area_fraction" else "pressure $p$"
            more = [{"pixels": "means of cells", "spots": "means of spots"}.get(drawn[0][0], "")]
            dimension = panels[0][0].dimension(variable)
            if extend != "neither":
                top = max(np.abs(values).max() for _, values, _ in drawn)
                more.append(f"up to {amount(top, dimension)}")
            more = ", ".join(filter(None, more))
            how = {
                "more": f"\n{more}" if more else "",
                "extend": extend,
                "pad": 0.01,
                "aspect": 16 if one else 30,
                "fraction": 0.08,
            }
            beside = list(axes)
            if first == "contact":  # the bar of all rows, so that they remain one below the other
                beside, how["shrink"], how["anchor"] = page.axes, 0.9 / page.rows, (0, 0)
            colour_bar(page.figure, image, beside, text, dimension, **how)
    what = "Contact" if first == "contact" else "Area fraction"
    what = f"{what} and pressure" if one else "Pressure"
    what += f" at {common}" if common else ""
    return page.finish(results[0].heading(what) if one else title(results, what))


def _heading(result, level, name):
    if result.control() in ("force", "pressure"):
        return name
    return f"{name}\n$N$ = {amount(result.mean('force')[level], result.dimension('force'))}"


def _axes(axis, result, small, inner, above):
    """Labels at the left and below only, where all panels show the same window."""
    if small:
        axis.set(xticks=[], yticks=[])
        return
    axis.locator_params(nbins=4)
    for which, hidden, side in (("x", above, "labelbottom"), ("y", inner, "labelleft")):
        label(axis, which, "" if hidden else f"${which}$", result.dimension(which))
        if hidden:
            getattr(axis, f"set_{which}label")("")
            axis.tick_params(**{side: False})


def _visible(window):
    """The smallest semi-axis of a spot that is drawn in a window."""
    return 0.006 * (window[1] - window[0])


def _scale(all_fields, variable):
    """(norm, extend) of one colour scale for all fields. One per cent of the pressures may be above
    its end, because they would hide the variation of all others; tension, with adhesion, is
    blue."""
    values = np.abs(np.concatenate([f[f != 0] for f in all_fields]))
    if variable == "map_area_fraction":
        end = min(values.max(initial=0), 1.0)  # above 1: a spot larger than the cell of its centre
    else:
        end = np.percentile(values, 99) if values.size else 1.0
    pulls = min(f.min() for f in all_fields) < 0
    tops = [f.max() for f in all_fields if f.max() > 0]
    # Between panels of different magnitude colours follow the root.
    gamma = 0.5 if tops and not pulls and max(tops) > 8 * min(tops) else 1.0
    beyond = variable == "map_pressure" and values.max(initial=0) > end
    extend = "both" if beyond and pulls else "max" if beyond else "neither"
    return PowerNorm(gamma, -end if pulls else 0, end or 1.0), extend


def _image(axis, kind, values, place, norm, least):
    """Draws the values of _pressure."""
    looks = dict(norm=norm, cmap="coolwarm" if norm.vmin < 0 else COLOURS)
    if kind == "spots":
        x, y, major, minor, angle = place[:5]
        major, minor = np.maximum(major, least), np.maximum(minor, least)
        return ellipses(axis, x, y, major, minor, angle, array=values, **looks)
    hidden = np.ma.masked_equal(values, 0)
    return axis.imshow(hidden, extent=place, interpolation="nearest", **looks)
