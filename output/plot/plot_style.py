"""How pictures look: sizes for journals, styles of curves, marks of levels that are not to be relied on."""

import sys

try:
    import matplotlib

    matplotlib.use("Agg")  # works without a screen
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.lines import Line2D
except ImportError as missing:
    sys.exit(f"The Python module {missing.name!r} is missing; on Debian: apt install python3-numpy python3-matplotlib python3-netcdf4")

# Curves differ by marker and line style as well as by colour: the pictures are readable in grey.
STYLES = [("o", "-", "#0b3c5d"), ("s", "--", "#c1440e"), ("^", "-.", "#4b8b3b"), ("D", ":", "#6a4c93"), ("v", "-", "#777777"), ("P", "--", "#b08d00"),
          ("X", "-.", "#000000"), ("<", ":", "#1f9e9e"), (">", "-", "#a03060")]
# The mark of a level by its status, from 1 on: the larger is the more serious.
MARKS = ["", "o", "s", "^", "x"]
WIDTHS = {"single": 85.0, "onehalf": 130.0, "double": 175.0}  # columns of journals [mm]

plt.rcParams.update({"figure.dpi": 150, "savefig.dpi": 300, "font.size": 8, "axes.titlesize": 8, "legend.fontsize": 7, "legend.framealpha": 0.9, "image.origin": "lower",
                     "axes.grid": False, "svg.fonttype": "none", "pdf.fonttype": 42, "lines.linewidth": 1.2, "axes.linewidth": 0.7})


def style(k, count):
    """Marker, line style and colour of curve k of `count`."""
    if count <= len(STYLES):
        return STYLES[k]
    return STYLES[k % len(STYLES)][0], STYLES[k % 4][1], plt.get_cmap("viridis")(0.9 * k / max(count - 1, 1))


def panels(count, width, aspect=0.78, least=62.0, entries=0):
    """A figure `width` mm wide with `count` axes, as many side by side as are at least `least` mm wide each; aspect: height over width of one.
    entries: lines of a legend below all of them, for more curves than an axis has room for; its axes come last."""
    columns = max(1, min(count, int(width // least)))
    rows = -(-count // columns)
    heights = [width / columns * aspect] * rows + ([3.4 * -(-entries // max(1, int(width // 70))) + 4] if entries else [])
    figure = plt.figure(figsize=(width / 25.4, (sum(heights) + 8) / 25.4), constrained_layout=True)
    grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    axes = [figure.add_subplot(grid[k // columns, k % columns]) for k in range(count)]
    if entries:
        axes.append(figure.add_subplot(grid[-1, :]))
        axes[-1].axis("off")
    return figure, axes


def mark_levels(axis, x, y, status, colour):
    """Marks the levels that are flagged; returns the statuses met. At most some 20 marks of a kind, those of levels not converged all."""
    met = set()
    for value in range(1, len(MARKS)):
        at = np.flatnonzero((status == value) & np.isfinite(x) & np.isfinite(y))
        if at.size == 0:
            continue
        met.add(value)
        if value < len(MARKS) - 1:
            at = at[:: -(-at.size // 20)]
        axis.plot(np.asarray(x)[at], np.asarray(y)[at], MARKS[value], color="r" if value == len(MARKS) - 1 else colour, mfc="w", ms=5 if MARKS[value] == "x" else 3.5, mew=0.8, ls="none", zorder=3,
                  gid="status")
    return met


def legend(axis, met=(), meanings=(), below=None, **how):
    """The legend of a picture's curves, with a line for each kind of mark; in the axes `below` if given."""
    handles, labels = axis.get_legend_handles_labels()
    for value in sorted(met):
        handles.append(Line2D([], [], ls="none", marker=MARKS[value], mfc="w", color="r" if value == len(MARKS) - 1 else "k", ms=4))
        labels.append("level " + meanings[value])
    if handles and below is not None:
        width = below.figure.get_size_inches()[0] * 25.4
        below.legend(handles, labels, loc="center", ncol=max(1, int(width // 70)), borderaxespad=0, **how)
    elif handles:
        axis.legend(handles, labels, **how)


def few(count):
    """The `entries` of panels() for `count` curves: none while they fit into an axis."""
    return 0 if count <= 3 else count + 2
