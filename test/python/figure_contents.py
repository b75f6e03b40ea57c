"""Everything a figure shows, as plain lists and numbers, to be compared as a whole with what is expected: what is not expected is noticed as
well as what is missing.

    contents(figure)      -> {"title": text, "axes": [axis, ...]}; axes that are not visible or empty and switched off are left out
    differences(expected, found) -> what is not equal, as lines of text

An axis is {"xlabel", "ylabel", "title", "xscale", "yscale", "xlim", "ylim", "aspect", "ticks", "legend", "lines", "bands", "segments", "ellipses", "circles", "images",
"meshes", "stairs", "texts", "inset"}; what is empty or matplotlib's default is left out. Limits are left out where matplotlib chooses them
("reversed" where from right to left); None in an expected pair is any number that takes in all that is drawn. A colour bar is {"bar": label, "of": index of its
axis, ...}.
"""
import matplotlib.ticker
import numpy as np
from matplotlib import collections, colors, image, legend, lines, patches, spines, text
from matplotlib.axes import Axes
from matplotlib.axis import Axis

ANYTHING = object()  # where no value is asked for


def _colour(value):
    return colors.to_hex(value, keep_alpha=False)


def _line(line):
    x, y = (np.asarray(v, float) for v in line.get_data())
    label = line.get_label()
    assert line.get_visible() and (line.get_alpha() is None or line.get_alpha() > 0)
    found = {"x": x, "y": y, "line": line.get_linestyle() if line.get_linewidth() > 0 else "None", "colour": _colour(line.get_color())}
    if line.get_marker() not in ("None", None, ""):
        found["marker"] = line.get_marker()
        filled = line.get_markerfacecolor()
        found["filled"] = "no" if isinstance(filled, str) and filled == "none" else _colour(filled)
        assert line.get_markersize() > 0
    if label and not label.startswith("_"):
        found["label"] = label
    return found


def line(x, y, style="-", colour=None, label=None, marker=None, filled=None):
    """A line as contents() tells it. filled: 'no', a colour, or None for the colour of the line."""
    found = {"x": np.asarray(x, float), "y": np.asarray(y, float), "line": style, "colour": _colour(colour)}
    if marker:
        found["marker"], found["filled"] = marker, "no" if filled == "no" else _colour(filled or colour)
    if label:
        found["label"] = label
    return found


def band(x, low, high, colour):
    """A filled band over the points where both ends are numbers."""
    good = np.isfinite(low) & np.isfinite(high)
    order = np.flatnonzero(good)[np.argsort(np.asarray(x, float)[good])]
    return {"x": np.asarray(x, float)[order], "low": np.asarray(low)[order], "high": np.asarray(high)[order], "colour": _colour(colour)}


def _band(poly):
    ends = {}
    for path in poly.get_paths():
        for x, y in path.vertices:
            low, high = ends.get(x, (np.inf, -np.inf))
            ends[x] = (min(low, y), max(high, y))
    x = np.array(list(ends))
    assert 0 < poly.get_facecolor()[0][3] < 0.6  # what lies below it is seen
    return {"x": np.sort(x), "low": np.array([ends[v][0] for v in np.sort(x)]), "high": np.array([ends[v][1] for v in np.sort(x)]), "colour": _colour(poly.get_facecolor()[0])}


def bars(x, y, below, above, colour, along="y"):
    """Error bars of points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    ends = np.array([[(a, b - lo), (a, b + hi)] if along == "y" else [(a - lo, b), (a + hi, b)] for a, b, lo, hi in zip(x, y, below + 0 * x, above + 0 * x)])
    return {"ends": ends.reshape(-1, 2), "colour": _colour(colour)}


def _ellipses(axis, found):
    assert found.get_offset_transform() is axis.transData
    faces, edges = found.get_facecolor(), found.get_edgecolor()
    units = found._units
    assert units == "xy" or units == "x" and axis.get_aspect() == 1.0  # their axes are lengths of the picture's own axes
    return {"x": np.asarray(found.get_offsets())[:, 0], "y": np.asarray(found.get_offsets())[:, 1], "long": 2 * found._widths, "short": 2 * found._heights,
            "degrees": np.degrees(found._angles), "face": _colour(faces[0]) if len(faces) else "none", "edge": _colour(edges[0]) if len(edges) else "none"}


def ellipses(x, y, long, short, degrees, face="none", edge="none"):
    """long, short: whole axes."""
    x = np.asarray(x, float)
    return {"x": x, "y": np.asarray(y, float), "long": long + 0 * x, "short": short + 0 * x, "degrees": degrees + 0 * x, "face": face if face == "none" else _colour(face),
            "edge": edge if edge == "none" else _colour(edge)}


def _image(found):
    values = np.ma.filled(np.ma.asarray(found.get_array()).astype(float), np.nan)
    assert found.origin == "lower"
    return {"values": values, "extent": np.array(found.get_extent(), float), "range": np.array(found.get_clim(), float), "colours": found.get_cmap().name}


def picture(values, extent, low, high, colours):
    return {"values": np.asarray(values, float), "extent": np.array(extent, float), "range": np.array([low, high], float), "colours": colours}


def _legend(found):
    handles = getattr(found, "legend_handles", None) or found.legendHandles
    entries = []
    for label, handle in zip(found.get_texts(), handles):
        entry = {"text": label.get_text()}
        if isinstance(handle, lines.Line2D):
            entry["colour"] = _colour(handle.get_color())
            if handle.get_linestyle() != "None":
                entry["line"] = handle.get_linestyle()
            if handle.get_marker() not in ("None", None, ""):
                entry["marker"] = handle.get_marker()
        entries.append(entry)
    title = found.get_title().get_text()
    return {"entries": entries, **({"title": title} if title not in ("", "None") else {})}


def legend_of(*drawn, title=None):
    """The legend of lines that have a label; a text stands for an entry of which only the words are compared."""
    entries = []
    for item in drawn:
        if isinstance(item, str):
            entries.append({"text": item})
        elif "label" in item:
            entries.append({"text": item["label"], "colour": item["colour"], **({"line": item["line"]} if item["line"] != "None" else {}), **({"marker": item["marker"]} if "marker" in item else {})})
    return {"entries": entries, **({"title": title} if title else {})}


def _limits(axis, which):
    auto = axis.get_autoscalex_on() if which == "x" else axis.get_autoscaley_on()
    low, high = axis.get_xlim() if which == "x" else axis.get_ylim()
    if auto:
        return "reversed" if low > high else None
    return [low, high]


def _axis(axis, index):
    bar = getattr(axis, "_colorbar", None)
    if bar is not None:
        found = {"bar": axis.get_xlabel() or axis.get_ylabel(), "of": index[bar.mappable.axes]}
        if bar.extend != "neither":
            found["extend"] = bar.extend
        limits = sorted(axis.get_xlim() if bar.orientation == "horizontal" else axis.get_ylim())
        if not np.allclose(limits, sorted(bar.mappable.get_clim())):
            found["shown"] = limits
        return found
    found = {"lines": [], "bands": [], "segments": [], "ellipses": [], "circles": [], "images": [], "meshes": [], "stairs": [], "texts": [], "inset": []}
    for child in axis.get_children():
        if child is axis.patch or isinstance(child, (spines.Spine, Axis)):
            continue
        if child in (axis.title, axis._left_title, axis._right_title):
            assert child is axis.title or not child.get_text()
        elif isinstance(child, lines.Line2D):
            found["lines"].append(_line(child))
        elif isinstance(child, collections.EllipseCollection):
            if len(child.get_offsets()):
                found["ellipses"].append(_ellipses(axis, child))
        elif isinstance(child, collections.LineCollection):
            found["segments"].append({"ends": np.concatenate([s for s in child.get_segments() if len(s)] or [np.zeros((0, 2))]), "colour": _colour(child.get_edgecolor()[0])})
        elif isinstance(child, collections.PathCollection):  # a contour
            found["segments"].append({"ends": np.concatenate([path.vertices for path in child.get_paths()]), "colour": _colour(child.get_edgecolor()[0])})
        elif isinstance(child, collections.QuadMesh):
            found["meshes"].append({"values": np.ma.filled(child.get_array().astype(float), np.nan).ravel(), "corners": np.asarray(child.get_coordinates()), "range": np.array(child.get_clim()),
                                    "colours": child.get_cmap().name})
        elif isinstance(child, collections.PolyCollection):
            found["bands"].append(_band(child))
        elif isinstance(child, image.AxesImage):
            found["images"].append(_image(child))
        elif isinstance(child, patches.Circle):
            assert not child.get_fill() and child.get_transform().contains_branch(axis.transData)
            found["circles"].append({"centre": np.array(child.get_center(), float), "radius": child.get_radius(), "line": child.get_linestyle(), "colour": _colour(child.get_edgecolor())})
        elif isinstance(child, patches.StepPatch):
            values, edges, base = child.get_data()
            found["stairs"].append({"values": np.asarray(values, float), "edges": np.asarray(edges, float), "colour": _colour(child.get_edgecolor() if not child.get_fill() else child.get_facecolor()),
                                    "label": child.get_label()})
        elif isinstance(child, text.Text):
            where = child.xy if isinstance(child, text.Annotation) else child.get_position()
            found["texts"].append({"text": child.get_text(), "at": np.array(where, float), "colour": _colour(child.get_color())})
        elif isinstance(child, legend.Legend):
            found["legend"] = _legend(child)
        elif isinstance(child, Axes):
            found["inset"].append(_axis(child, index))
        else:
            raise AssertionError(f"an artist of a kind that is not looked at: {child}")
    found = {k: v for k, v in found.items() if v}
    if axis.axison:
        for which in "xy":
            label, scale = getattr(axis, f"get_{which}label")(), getattr(axis, f"get_{which}scale")()
            limits = _limits(axis, which)
            found.update({**({which + "label": label} if label else {}), **({which + "scale": scale} if scale != "linear" else {}), **({which + "lim": limits} if limits else {})})
            if isinstance(getattr(axis, which + "axis").get_major_locator(), matplotlib.ticker.FixedLocator):
                found[which + "ticks"] = [t.get_text() for t in getattr(axis, f"get_{which}ticklabels")()]
        if axis.get_aspect() != "auto" and not found.get("images"):
            found["aspect"] = axis.get_aspect()
        elif found.get("images"):
            found["aspect"] = axis.get_aspect()
    if axis.get_title():
        found["title"] = axis.get_title()
    return found


def contents(figure):
    shown = [axis for axis in figure.axes if axis.get_visible()]
    index = {axis: k for k, axis in enumerate(shown)}
    for child in figure.get_children():
        assert isinstance(child, Axes) or child in (figure.patch, figure._suptitle), f"not looked at: {child}"
    return {"title": figure._suptitle.get_text() if figure._suptitle else "", "axes": [found for found in (_axis(axis, index) for axis in shown) if found]}


def _data_limits(found, which):
    """Ends of all that is drawn along an axis, for limits that are only asked to take it in."""
    values = [entry[which] for entry in found.get("lines", []) if len(entry["x"]) != 2 or np.ptp(entry["x"]) * np.ptp(entry["y"]) != 0] + [np.zeros(0)]
    values = np.concatenate(values)
    values = values[np.isfinite(values)]
    if found.get(which + "scale") == "log":
        values = values[values > 0]
    return (values.min(), values.max()) if values.size else None


def differences(expected, found, where="figure", tolerance=1e-9):
    """Lines of text that tell where the two differ; empty where they are equal. Numbers to `tolerance` of the largest of their array."""
    if expected is ANYTHING:
        return []
    if isinstance(expected, dict):
        if not isinstance(found, dict):
            return [f"{where}: {expected!r} expected, {found!r} found"]
        wrong = [f"{where}: {key} is {_short(found[key])}, none is expected" for key in found if key not in expected]
        for key in expected:
            if key not in found:
                wrong.append(f"{where}: {key} is missing, {_short(expected[key])} is expected")
            elif key in ("xlim", "ylim") and isinstance(expected[key], (list, tuple)) and None in expected[key] and isinstance(found[key], list):
                ends = _data_limits(found, key[0])
                for k, (end, shown) in enumerate(zip(expected[key], found[key])):
                    if end is not None:
                        wrong += differences(end, shown, f"{where}.{key}[{k}]", tolerance)
                    elif ends and not (shown <= ends[0] if k == 0 else shown >= ends[1]):
                        wrong.append(f"{where}: {key} = {found[key]} cuts off what is drawn, {ends}")
            else:
                wrong += differences(expected[key], found[key], f"{where}.{key}", tolerance)
        return wrong
    if isinstance(expected, (list, tuple)) and not (expected and all(isinstance(v, (int, float, np.number)) for v in expected)):
        if not isinstance(found, (list, tuple)) or len(expected) != len(found):
            return [f"{where}: {len(expected)} expected, {len(found) if isinstance(found, (list, tuple)) else found!r} found: {_short(expected)} and {_short(found)}"]
        return [text for k, (e, f) in enumerate(zip(expected, found)) for text in differences(e, f, f"{where}[{k}]", tolerance)]
    if isinstance(expected, str) or expected is None or isinstance(found, str):
        return [] if expected == found else [f"{where}: {expected!r} expected, {found!r} found"]
    e, f = np.asarray(expected, float), np.asarray(found, float)
    if e.shape != f.shape:
        return [f"{where}: shape {e.shape} expected, {f.shape} found"]
    scale = np.abs(e[np.isfinite(e)]).max() if np.isfinite(e).any() else 1.0
    # Numbers of one array may span many powers of ten: each is asked for to 1e-9 of itself, or to rounding of the largest.
    same = np.isclose(f, e, rtol=tolerance, atol=1e-14 * scale, equal_nan=True)
    return [] if same.all() else [f"{where}: {e[~same][:3]} expected, {f[~same][:3]} found ({(~same).sum()} of {e.size})"]


def _short(value):
    text = repr(value)
    return text if len(text) < 300 else text[:300] + " ..."
