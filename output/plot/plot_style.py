"""Style of the pictures: colours, suitable units, marks of levels, legends beside the data. Data
are drawn in SI units; axes and colour bars use the unit with short numbers (nm, um, mm; mN, N, kN;
MPa, GPa)."""

import re

import matplotlib

matplotlib.use("Agg")  # needs no display
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import (
    FixedLocator,
    FuncFormatter,
    LogFormatterSciNotation,
    LogLocator,
    MaxNLocator,
)

# Curves differ by line and marker as well as by colour, so that pictures are readable in grey.
STYLES = [
    ("o", "-", "#0b3c5d"),
    ("s", "--", "#c1440e"),
    ("^", "-.", "#4b8b3b"),
    ("D", ":", "#6a4c93"),
    ("v", "-", "#777777"),
    ("P", "--", "#b08d00"),
    ("X", "-.", "#000000"),
    ("<", ":", "#1f9e9e"),
    (">", "-", "#a03060"),
]
FEW = 6  # maximum number of curves with individual colours
GREY = "0.4"  # theories and laws drawn beside the results
# The mark of a level by its status, from 1 on; larger ones are more serious.
MARKS = ["", "o", "s", "^", "x"]
STATUSES = ["", "with doubts", "with overlapping spots", "not unique", "not converged"]
WIDTHS = {"single": 85.0, "onehalf": 130.0, "double": 175.0}  # columns of journals [mm]
# Areas without contact are white.
COLOURS = matplotlib.colormaps["viridis_r"].copy()
COLOURS.set_bad("w")

plt.rcParams.update(
    {
        "font.size": 8,
        "axes.titlesize": 8,
        "legend.fontsize": 7.5,
        "image.origin": "lower",
        "axes.formatter.useoffset": False,
        "svg.fonttype": "none",
        "pdf.fonttype": 42,
        "lines.linewidth": 1.3,
        "axes.linewidth": 0.7,
        "figure.titlesize": 9,
    }
)

# Units of pictures, from small to large: (size in SI, text). Keys are results of _reduced().
_SHOWN = {
    "m": [(1e-9, "nm"), (1e-6, "µm"), (1e-3, "mm"), (1.0, "m")],
    "m2": [(1e-18, "nm²"), (1e-12, "µm²"), (1e-6, "mm²"), (1.0, "m²")],
    "m3": [(1e-27, "nm³"), (1e-18, "µm³"), (1e-9, "mm³"), (1.0, "m³")],
    "m3 s-1": [(1e-18, "µm³/s"), (1e-12, "nl/s"), (1e-9, "mm³/s"), (1e-6, "cm³/s")],
    "m4": [(1e-36, "nm⁴"), (1e-24, "µm⁴"), (1e-12, "mm⁴"), (1.0, "m⁴")],
    "m-1": [(1.0, "1/m"), (1e3, "1/mm"), (1e6, "1/µm"), (1e9, "1/nm")],
    "m-2": [(1.0, "1/m²"), (1e6, "1/mm²"), (1e12, "1/µm²"), (1e18, "1/nm²")],
    "N": [(1e-9, "nN"), (1e-6, "µN"), (1e-3, "mN"), (1.0, "N"), (1e3, "kN"), (1e6, "MN")],
    "N m": [(1e-9, "nJ"), (1e-6, "µJ"), (1e-3, "mJ"), (1.0, "J"), (1e3, "kJ")],
    "N m-1": [(1.0, "N/m"), (1e3, "N/mm"), (1e6, "N/µm"), (1e9, "kN/µm")],
    "N m-2": [(1.0, "Pa"), (1e3, "kPa"), (1e6, "MPa"), (1e9, "GPa")],
    "N m-3": [(1e9, "MPa/mm"), (1e12, "MPa/µm"), (1e15, "GPa/µm"), (1e18, "GPa/nm")],
    "N-1 m2": [(1e-9, "1/GPa"), (1e-6, "1/MPa"), (1e-3, "1/kPa"), (1.0, "1/Pa")],
    # A case does not specify electrical or thermal resistivities.
    "ohm": [
        (size, f"{p}Ω; thermal: {p}K/W")
        for size, p in ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"), (1e6, "M"))
    ],
}
_PREFIXES = {"": 1.0, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6}
_BASES = {
    prefix + base: (size, base)
    for base in ("m", "N", "ohm", "s")
    for prefix, size in _PREFIXES.items()
}
_BASES |= {
    name: (size, "m")
    for names, size in (
        ("inch in inches", 0.0254),
        ("ft foot feet", 0.3048),
        ("mil", 2.54e-5),
        ("nanometer", 1e-9),
        ("angstrom", 1e-10),
        ("micron micrometer", 1e-6),
        ("millimeter", 1e-3),
        ("meter", 1.0),
    )
    for name in names.split()
}
_BASES |= {
    "lbf": (4.4482216152605, "N"),
    "kgf": (9.80665, "N"),
    "gf": (9.80665e-3, "N"),
    "dyne": (1e-5, "N"),
    "newton": (1.0, "N"),
}


def si(text):
    """(factor to SI, dimension) of a unit of result files: 'N mm-2' is (1e6, 'N m-2'). An unknown
    unit is its own dimension, with factor 1."""
    factor, powers = 1.0, {}
    for word in text.split():
        name, power = re.fullmatch(r"(.*?)(-?\d*)", word).groups()
        if name == "" and power == "1":
            continue
        if name not in _BASES:
            return 1.0, text
        size, base = _BASES[name]
        factor *= size ** int(power or 1)
        powers[base] = powers.get(base, 0) + int(power or 1)
    order = sorted((base for base in powers if powers[base]), key=["N", "ohm", "m", "s"].index)
    return factor, " ".join(
        base + (str(powers[base]) if powers[base] != 1 else "") for base in order
    )


def fitting(dimension, values):
    """(size in SI, text) of the unit with a short number for the largest value."""
    top = np.nanmax(np.abs(np.where(np.isfinite(values), values, 0.0)), initial=0.0)
    known = _SHOWN.get(dimension)
    if not known:
        return 1.0, re.sub(r"(?<=[A-Za-z)])(-?\d+)\b", r"$^{\1}$", dimension)
    reach = 10.0 if dimension == "m2" else 1.0001  # 0.1 mm² rather than 100000 µm²
    return (
        max(
            (unit for unit in known if unit[0] <= top * reach),
            key=lambda unit: unit[0],
            default=known[0],
        )
        if top > 0
        else min(known, key=lambda unit: abs(np.log10(unit[0])))
    )


def middle(dimension, ends):
    """The same for a logarithmic axis over decades: of the units within its ends the one nearest to
    its middle."""
    within = [unit for unit in _SHOWN.get(dimension, []) if 0 < ends[0] <= unit[0] <= ends[1]]
    return (
        min(within, key=lambda unit: abs(np.log(unit[0] ** 2 / (ends[0] * ends[1]))))
        if within
        else fitting(dimension, ends)
    )


def amount(value, dimension, digits=3):
    """'4.53 N': a number with a suitable unit."""
    size, text = fitting(dimension, np.array([value]))
    return f"{short(value / size, digits)} {text}".strip()


def short(value, digits=3):
    """A number with the given number of digits, without a power of ten up to a million: 49600, not
    4.96e+04."""
    return f"{float(f'{value:.{digits}g}'):.6g}"


class _LogTicks(LogFormatterSciNotation):
    """Plain numbers near one, powers of ten elsewhere; matplotlib selects the ticks with labels,
    except where `all_of_them` is set."""

    size, all_of_them = 1.0, False

    def __call__(self, x, pos=None):
        if x <= 0 or not (self.all_of_them or super().__call__(x, pos)):
            return ""
        value = x / self.size
        power = int(np.floor(np.log10(value) + 1e-9))
        lead = value / 10.0**power
        if power < -1 and abs(lead - 3) < 1e-6:  # long labels, which would touch those of 4
            return ""
        if 0.9e-3 < value < 0.99e5:
            return f"{value:.5g}"
        return f"$10^{{{power}}}$" if abs(lead - 1) < 1e-6 else f"${lead:.3g}\\times10^{{{power}}}$"


def label(axis, which, text, dimension="", like=None):
    """Writes the label of an axis ('x' or 'y') and its numbers in a unit suitable for its range, or
    in that of another axis of the same quantity."""
    side = getattr(axis, which + "axis")
    within = []
    for of in (
        which if axis.get_aspect() == "auto" else "xy"
    ):  # both axes of a map have the same unit
        lo, hi = sorted(getattr(axis, f"get_{of}lim")())
        drawn = getattr(axis.dataLim, "interval" + of)  # the axis extends a little beyond it
        within += (
            [max(lo, drawn.min()), min(hi, drawn.max())] if np.isfinite(drawn).all() else [lo, hi]
        )
    size, unit = (middle if side.get_scale() == "log" else fitting)(dimension, within)
    if like:
        size, unit = getattr(like, which + "axis").in_unit
    side.in_unit = size, unit
    side.set_label_text(text + (f" [{unit}]" if unit else ""))
    if side.get_scale() == "log":
        for setter in (side.set_major_formatter, side.set_minor_formatter):
            ticks = _LogTicks(minor_thresholds=(1.6, 0.45))
            ticks.size = size
            setter(ticks)
    else:
        side.set_major_formatter(FuncFormatter(lambda v, _: _number(v / size, hi / size)))


def _number(value, top):
    """A tick of a linear axis: a plain number, or a power of ten if that would be long."""
    if abs(value) < 1e-9 * abs(top):
        return "0"
    if 1e-3 <= abs(top) < 1e5:
        return f"{value:.6g}"
    power = int(np.floor(np.log10(abs(top))))
    return f"${value / 10.0**power:.3g}\\times10^{{{power}}}$"


def colour_bar(figure, image, axes, text, dimension="", more="", **how):
    """A colour bar in a suitable unit, right of the axes; more: a second line of its label."""
    low, high = image.get_clim()
    size, unit = fitting(dimension, np.array([low, high]))
    bar = figure.colorbar(
        image,
        ax=axes,
        label=text + (f" [{unit}]" if unit else "") + more,
        format=FuncFormatter(lambda v, _: _number(v / size, max(abs(low), abs(high)) / size)),
        ticks=MaxNLocator(5),
        **how,
    )
    bar.size = size
    return bar


class Page:
    """A figure of `count` panels of one height with a title and one legend below all of them,
    outside the data. With one panel the page is at most 130 mm wide. aspect: height over width of a
    panel; columns: number of columns."""

    def __init__(self, options, count=1, aspect=0.72, columns=None, least=52.0):
        self.width = min(options.width, 130.0) if count == 1 else options.width
        columns = columns or max(1, min(count, int(self.width // least)))
        self.rows = -(-count // columns)
        self.body = self.rows * self.width / columns * aspect
        self.figure = plt.figure(
            figsize=(self.width / 25.4, self.body / 25.4), constrained_layout=True
        )
        self.outer = self.figure.add_gridspec(2, 1, height_ratios=[1, 1e-3])
        grid = self.outer[0].subgridspec(self.rows, columns)
        self.axes = [self.figure.add_subplot(grid[k // columns, k % columns]) for k in range(count)]
        self.columns, self.entries, self.causes = columns, {}, set()

    def entry(self, text, **looks):
        """A line of the legend."""
        self.entries.setdefault(text, Line2D([], [], **looks))

    def status(self, axis, x, y, result, colour):
        """Marks the levels of a result by their status."""
        status = result.level_status()
        for value, text in enumerate(STATUSES):
            at = np.flatnonzero((status == value) & np.isfinite(x) & np.isfinite(y))
            if not value or at.size == 0:
                continue
            last = value == len(MARKS) - 1
            looks = dict(ls="none", marker=MARKS[value], mfc="w", color="r" if last else colour)
            size = 5 if last else 3.5
            axis.plot(x[at], y[at], ms=size, mew=0.8, zorder=3, gid="status", **looks)
            if value == 1:
                self.causes |= result.causes(at)
            self.entry("level " + text, **{**looks, "color": "r" if last else "k", "ms": 4})

    def scale(self, scale):
        """The colour scale of many results, (name of the key, texts of its values, colours), right
        of all panels."""
        name, texts, colours = scale
        colours = matplotlib.colors.ListedColormap(colours)
        image = matplotlib.cm.ScalarMappable(
            matplotlib.colors.BoundaryNorm(np.arange(len(texts) + 1) - 0.5, len(texts)), colours
        )
        bar = self.figure.colorbar(image, ax=self.axes, label=name, aspect=30, pad=0.01)
        some = np.arange(0, len(texts), max(1, -(-len(texts) // 16)))
        bar.set_ticks(some)
        bar.set_ticklabels([texts[k] for k in some])
        bar.ax.minorticks_off()

    def finish(self, title):
        """Writes title and legend and sets the height of the figure accordingly."""
        for axis in self.axes:
            for handle, text in zip(*axis.get_legend_handles_labels()):
                self.entries.setdefault(text, handle)
        self.entries = dict(
            sorted(self.entries.items(), key=lambda entry: entry[0].startswith("level "))
        )
        if self.causes:
            doubts = self.entries.pop("level with doubts")
            self.entries[f"level with doubts: {', '.join(sorted(self.causes))}"] = doubts
        self.figure.suptitle(wrapped(self.figure, title, self.width, "figure.titlesize"))
        strip, handles = 0.1, list(self.entries.values())
        if handles:
            below = self.figure.add_subplot(self.outer[1])
            below.axis("off")
            texts = [
                wrapped(
                    self.figure,
                    text,
                    62 if text.startswith("level ") and len(self.entries) > 1 else self.width - 10,
                    "legend.fontsize",
                )
                for text in self.entries
            ]
            for rows in range(1, len(texts) + 1):  # as few as fit the width
                legend = below.legend(
                    handles,
                    texts,
                    loc="center",
                    ncol=-(-len(texts) // rows),
                    borderaxespad=0,
                    frameon=False,
                )
                box = legend.get_window_extent()
                if box.width < self.figure.bbox.width:
                    break
            strip = box.height / self.figure.dpi * 25.4
        self.figure.set_size_inches(
            self.width / 25.4,
            (self.body + strip + 4.2 * (1 + self.figure._suptitle.get_text().count("\n"))) / 25.4,
        )
        self.outer.set_height_ratios([self.body, strip])
        settle(self.figure)
        return self.figure


def wrapped(figure, text, width, size):
    """The text in lines of at most `width` millimetres; formulas are not broken. size: name of the
    font size in rcParams, or points."""
    probe = figure.text(0, 0, "", fontsize=plt.rcParams.get(size, size))
    lines = []
    for line in filter(None, text.split("\n")):
        lines.append("")
        for word in re.findall(r"(?:\$[^$]*\$|[^ ])+", line):
            probe.set_text(f"{lines[-1]} {word}".strip())
            fits = probe.get_window_extent().width < 0.98 * width / 25.4 * figure.dpi
            lines[-1:] = [probe.get_text()] if fits or not lines[-1] else [lines[-1], word]
    probe.remove()
    return "\n".join(lines)


def settle(figure):
    """Wraps the titles of axes half way to the next axes or at the edge of the figure, makes the
    figure higher by the lines that this adds, and takes ticks away until their labels are apart."""
    figure.draw_without_rendering()  # for the positions of the axes
    titled = [
        (axis, sum(axis.get_position().intervalx) / 2, axis.get_subplotspec().rowspan.start)
        for axis in figure.axes
        if axis.get_title()
    ]
    added = {}  # lines of each row of axes
    for axis, centre, row in titled:
        beside = [abs(centre - x) / 2 for other, x, r in titled if other is not axis and r == row]
        half = min([centre, 1 - centre, *beside])
        text = wrapped(
            figure,
            axis.get_title(),
            1.88 * half * 25.4 * figure.get_figwidth(),
            axis.title.get_fontsize(),
        )
        added[row] = max(added.get(row, 0), text.count("\n") - axis.get_title().count("\n"))
        axis.title.set_text(text)
    figure.set_figheight(figure.get_figheight() + sum(added.values()) * 3.4 / 25.4)
    figure.draw_without_rendering()  # with the widths of the tick labels
    for axis in figure.axes:
        words = axis.yaxis.label  # in lines that are no longer than the axis is high
        high = 25.4 * axis.get_window_extent().height / figure.dpi
        words.set_text(wrapped(figure, words.get_text(), max(high, 20), words.get_fontsize()))
        for side in (axis.xaxis, axis.yaxis):
            _space(side)


def _space(side):
    """Takes ticks of an axis away until their labels are apart."""
    log = side.get_scale() == "log"
    for bins in (5, 4, 3, 2, 1):
        texts = [text for text in side.get_ticklabels(which="both") if text.get_text()]
        boxes = [text.get_window_extent().padded(0 if log else 1.5) for text in texts]
        if not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k]):
            return
        if isinstance(side.get_major_locator(), FixedLocator):  # every second one, with the last
            ticks, words = side.get_majorticklocs(), [t.get_text() for t in side.get_ticklabels()]
            side.set_ticks(ticks[::-2][::-1], labels=words[: len(ticks)][::-2][::-1])
        elif log:
            side.set_minor_locator(LogLocator(subs=(2.0, 5.0) if bins == 5 else ()))
            side.get_minor_formatter().all_of_them = True
            if bins < 5:
                side.set_major_locator(LogLocator(numticks=bins))
        else:
            side.set_major_locator(MaxNLocator(bins))
