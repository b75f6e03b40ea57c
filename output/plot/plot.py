#!/usr/bin/env python3
"""Pictures of a result file of rsc.

    python3 output/plot/plot.py output/rsc.nc [-o FOLDER] [--step N]

writes PNG files beside the result file, or into FOLDER: the contact area against the force, maps, radial pressure, and, where the
file holds them, asperities and distributions. Needs numpy, matplotlib and netCDF4 (Debian: python3-matplotlib, python3-netcdf4).
"""

import argparse
import os
import re
import sys

try:
    import matplotlib

    matplotlib.use("Agg")  # works without a screen
    import matplotlib.pyplot as plt
    import netCDF4
    import numpy as np
    from matplotlib.collections import EllipseCollection
except ImportError as missing:
    sys.exit(f"plot.py: the Python module {missing.name!r} is missing; on Debian: apt install python3-numpy python3-matplotlib python3-netcdf4")

# Every curve differs by line style or marker as well as by colour: the pictures are readable in grey.
LEVEL_STYLES = [("o", "-", "#0b3c5d"), ("s", "--", "#c1440e"), ("^", "-.", "#4b8b3b"), ("D", ":", "#6a4c93"), ("v", "-", "#777777")]

plt.rcParams.update({"figure.dpi": 130, "font.size": 9, "axes.titlesize": 9, "legend.fontsize": 8, "legend.framealpha": 0.9,
                     "image.origin": "lower", "axes.grid": False})


class Result:
    """Variables by name, with absent values as NaN and units fit for an axis."""

    def __init__(self, path):
        try:
            self.file = netCDF4.Dataset(path)
        except OSError as error:
            sys.exit(f"plot.py: cannot read {path!r}: {error.strerror or error}; a result file of rsc (NetCDF) is expected")
        lacking = [name for name in ("force", "contact_area", "map_pressure", "separation_sigma") if name not in self]
        if lacking:
            sys.exit(f"plot.py: {path!r} is no result file of rsc: it lacks the variable {lacking[0]!r}")
        self.title = getattr(self.file, "title", "")
        self.realizations = len(self.file.dimensions["realization"])
        self.steps = len(self.file.dimensions["step"])

    def __contains__(self, name):
        return name in self.file.variables

    def __getitem__(self, name):
        values = np.ma.asarray(self.file.variables[name][:])
        return np.ma.filled(values.astype(float), np.nan)

    def window(self, name, *slices):
        return np.ma.filled(np.ma.asarray(self.file.variables[name][slices]).astype(float), np.nan)

    def unit(self, name):
        text = re.sub(r"(?<=[A-Za-z)])(-?\d+)\b", r"$^{\1}$", self.file.variables[name].units)
        return "" if text == "1" else f" [{text}]"

    def attribute(self, name, attribute):
        """One value a pdf level; absent values as NaN."""
        values = np.atleast_1d(np.asarray(getattr(self.file.variables[name], attribute), dtype=float))
        return np.where(values > 9e36, np.nan, values)

    def separation_sigma(self):
        values = self["separation_sigma"]
        return values.mean(axis=0) if values.ndim == 2 else values

    def level_name(self, step):
        z = self.separation_sigma()[step]
        return rf"$Z_0/\sigma$ = {z:.3g}" if np.isfinite(z) else f"level {step + 1}"

    def heading(self, what):
        many = f"mean over {self.realizations} realizations" if self.realizations > 1 else "one realization"
        return f"{what} ({many})\n{self.title}"


def chosen_levels(result, count, step):
    """The level asked for, or `count` levels with contact, evenly spread and ending with the last."""
    if step is not None:
        return [step - 1]
    loaded = np.flatnonzero(result["force_mean"] > 0)
    if loaded.size == 0:
        return []
    return sorted({int(s) for s in loaded[np.linspace(0, loaded.size - 1, count + 1).round().astype(int)[1:]]})


def plot_area(result):
    """A(N) with both regimes, their crossing, and the smooth sphere."""
    force, area = result["force_mean"], result["contact_area_mean"]
    loaded = (force > 0) & (area > 0)
    if not loaded.any():
        return None
    figure, axes = plt.subplots(figsize=(5.2, 4.2), constrained_layout=True)
    force_std, area_std = result["force_std"][loaded], result["contact_area_std"][loaded]
    if np.isfinite(area_std).all():
        # On logarithmic axes a bar must not reach zero.
        below = [np.minimum(s, 0.95 * v) for s, v in ((area_std, area[loaded]), (force_std, force[loaded]))]
        axes.errorbar(force[loaded], area[loaded], yerr=[below[0], area_std], xerr=[below[1], force_std], fmt="ko", ms=3, lw=0.6, capsize=1.5,
                      label="mean and standard deviation")
    else:
        axes.plot(force[loaded], area[loaded], "ko", ms=3, label="rsc")
    crossing = float(result["transition_force"])
    ends = np.array([force[loaded].min(), force[loaded].max()])
    if np.isfinite(crossing):
        ends = np.array([min(ends[0], crossing / 3), max(ends[1], crossing * 3)])
    last = np.flatnonzero(loaded)[-1]
    laws = [("area_I", 2 / 3, "--", r"$A_I\propto N^{2/3}$, one asperity"), ("area_II", 1, "-.", r"$A_{II}\propto N$, $\beta=0.2$"),
            ("area_hertz", 2 / 3, ":", "smooth sphere (Hertz)")]
    for name, exponent, style, label in laws:
        value = result[name][last]
        if np.isfinite(value) and value > 0:
            axes.plot(ends, value * (ends / force[last]) ** exponent, style, color="0.35", lw=1.3, label=label)
    if np.isfinite(crossing) and np.isfinite(result["area_II"][last]):
        axes.plot(crossing, result["area_II"][last] * crossing / force[last], "k*", ms=11, mfc="w", label=rf"crossing, $N^*$ = {crossing:.3g}")
    axes.set(xscale="log", yscale="log", xlabel="force $N$" + result.unit("force"), ylabel="contact area $A$" + result.unit("contact_area"),
             title=result.heading("Contact area against force"))
    axes.legend()
    return figure


def hertz_radius(result, step):
    return float(np.sqrt(result["area_hertz"][step] / np.pi))


def plot_map(result, step):
    """Area fraction and pressure in the cells, with the circle of the smooth sphere under the same force."""
    levels = chosen_levels(result, 3, step)
    if not levels:
        return None
    x, y, side = result["x"], result["y"], float(result["map_cell_side"])
    extent = [x[0] - side / 2, x[-1] + side / 2, y[0] - side / 2, y[-1] + side / 2]
    figure, axes = plt.subplots(2, len(levels), figsize=(3.1 * len(levels) + 0.6, 5.6), constrained_layout=True, squeeze=False, sharex=True, sharey=True)
    for row, (name, label) in enumerate((("map_area_fraction", "area fraction $A'$"), ("map_pressure", "pressure $p$"))):
        for column, level in enumerate(levels):
            axis = axes[row, column]
            image = axis.imshow(result.window(name, level), extent=extent, cmap="cividis", vmin=0, interpolation="nearest")
            figure.colorbar(image, ax=axis, shrink=0.8, label=label + result.unit(name))
            radius = hertz_radius(result, level)
            if np.isfinite(radius):
                angle = np.linspace(0, 2 * np.pi, 200)
                for style in ({"color": "k", "lw": 2.2}, {"color": "w", "lw": 1.1, "ls": "--"}):
                    axis.plot(float(result["tip_x"]) + radius * np.cos(angle), float(result["tip_y"]) + radius * np.sin(angle), **style)
            axis.set(xlim=extent[:2], ylim=extent[2:])
            if row == 0:
                axis.set_title(f"{result.level_name(level)}, $N$ = {result['force_mean'][level]:.3g}")
            else:
                axis.set_xlabel("$x$" + result.unit("x"))
            if column == 0:
                axis.set_ylabel("$y$" + result.unit("y"))
    figure.suptitle(result.heading("Maps of area fraction and pressure; dashed: Hertz contact of the smooth sphere"), fontsize=9)
    return figure


def plot_radial(result, step):
    """Pressure about the tip, linear and logarithmic, with Hertz for the same force."""
    levels = chosen_levels(result, 4, step)
    if not levels or "radius" not in result:
        return None
    radius, pressure, hertz = result["radius"], result["radial_pressure"], result["hertz_pressure"]
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 3.8), constrained_layout=True)
    for axis, logarithmic in zip(axes, (False, True)):
        for (marker, style, colour), level in zip(LEVEL_STYLES, levels):
            shown = pressure[level] > 0 if logarithmic else np.full(radius.size, True)
            axis.plot(radius[shown], pressure[level][shown], marker, ms=3, color=colour, mfc="none", label=result.level_name(level))
            smooth = hertz[level] > 0
            if smooth.any():
                a = hertz_radius(result, level)
                r = a * np.sin(np.linspace(0, np.pi / 2, 200)[: -1 if logarithmic else None])
                peak = 1.5 * result["force_mean"][level] / (np.pi * a * a)
                axis.plot(r, peak * np.sqrt(1 - (r / a) ** 2), style, color=colour, lw=1.2)
        axis.set(xlabel="distance from the tip $r$" + result.unit("radius"), ylabel="pressure $p$" + result.unit("radial_pressure"))
        axis.set_xlim(0, radius[-1])
    positive = pressure[levels][pressure[levels] > 0]
    axes[0].set_ylim(bottom=0)
    axes[1].set_yscale("log")
    if positive.size:
        axes[1].set_ylim(max(positive.min(), positive.max() * 1e-5) / 2, None)
    axes[0].legend(title="points: rsc, lines: Hertz")
    figure.suptitle(result.heading("Radial mean of the pressure"), fontsize=9)
    return figure


def plot_asperities(result, step):
    """Summits as the ellipses of their curvatures over the heights, and the contacts of a level, in a window about the tip."""
    if "asperity_x" not in result:
        return None
    x, y, radius = result["asperity_x"], result["asperity_y"], result["asperity_radius"]
    tip = np.array([float(result["tip_x"]), float(result["tip_y"])])
    # A window with some 400 asperities, around the tip.
    distance = np.maximum(abs(x - tip[0]), abs(y - tip[1]))
    half = np.sort(distance)[min(400, x.size - 1)] * 1.02 or 1.0
    inside = distance <= half
    kappa1 = result["asperity_kappa1"] if "asperity_kappa1" in result else 1 / radius
    kappa2 = result["asperity_kappa2"] if "asperity_kappa2" in result else 1 / radius
    angle = result["asperity_angle"] if "asperity_angle" in result else np.zeros_like(x)
    # The contour of the paraboloid at a depth h below its summit has half axes sqrt(2 h/kappa); h such that a typical ellipse covers a fifth of the
    # room an asperity has.
    share = (2 * half) ** 2 / max(inside.sum(), 1)
    depth = 0.2 * share / (2 * np.pi * np.median(1 / np.sqrt(kappa1 * kappa2)))

    figure, axis = plt.subplots(figsize=(6.2, 5.6), constrained_layout=True)
    if "height" in result:
        hx, hy = result["height_x"], result["height_y"]
        i, j = np.flatnonzero(abs(hx - tip[0]) <= half), np.flatnonzero(abs(hy - tip[1]) <= half)
        if i.size > 1 and j.size > 1:
            stride = max(1, max(i.size, j.size) // 1500)
            z = result.window("height", slice(j[0], j[-1] + 1, stride), slice(i[0], i[-1] + 1, stride))
            dx, dy = hx[1] - hx[0], hy[1] - hy[0]
            image = axis.imshow(z, extent=[hx[i[0]] - dx / 2, hx[i[-1]] + dx / 2, hy[j[0]] - dy / 2, hy[j[-1]] + dy / 2], cmap="gray", interpolation="nearest")
            figure.colorbar(image, ax=axis, shrink=0.8, label="height $z$" + result.unit("height"))
    ellipses = EllipseCollection(2 * np.sqrt(2 * depth / kappa2[inside]), 2 * np.sqrt(2 * depth / kappa1[inside]), np.degrees(angle[inside]), units="xy",
                                 offsets=np.column_stack([x[inside], y[inside]]), transOffset=axis.transData, facecolors="none",
                                 edgecolors="#0b6fa4", linewidths=0.8)
    axis.add_collection(ellipses)
    what = f"{int(inside.sum())} of {x.size} asperities as contours of their paraboloids"
    if "contact_asperity" in result and "contact_start" in result:
        count = result["contact_count"].astype(int)
        level = step - 1 if step is not None else result.steps - 1
        if count[level] > 0:
            span = slice(int(result["contact_start"][level]) - 1, int(result["contact_start"][level]) - 1 + count[level])
            which = result.window("contact_asperity", span).astype(int) - 1
            a = result.window("contact_radius", span)
            axis.add_collection(EllipseCollection(2 * a, 2 * a, np.zeros_like(a), units="xy", offsets=np.column_stack([x[which], y[which]]),
                                                  transOffset=axis.transData, facecolors="#c1440e", edgecolors="k", linewidths=0.4))
            what += f"; filled: contact spots at {result.level_name(level)}"
    axis.plot(*tip, "k+", ms=9)
    axis.set(xlim=(tip[0] - half, tip[0] + half), ylim=(tip[1] - half, tip[1] + half), aspect="equal", xlabel="$x$" + result.unit("asperity_x"),
             ylabel="$y$" + result.unit("asperity_y"), title=f"{what}\n{result.title}")
    return figure


def plot_distributions(result):
    """The three distributions over contacts with their fits."""
    if "pdf_level" not in result:
        return None

    def rayleigh(p, k):
        s = result.attribute("pressure_mean_pdf", "rayleigh_scale")[k]
        return p / s**2 * np.exp(-(p**2) / (2 * s**2)), ""

    def gamma(p, k):
        alpha, beta, delta, factor = (result.attribute("pressure_pdf", a)[k] for a in ("alpha", "beta", "delta", "gamma"))
        if not np.isfinite(alpha):  # too few contacts for a fit
            return np.full_like(p, np.nan), ""
        return factor * p**alpha * np.exp(-((p / delta) ** beta)), rf": $\alpha$ = {alpha:.2f}, $\beta$ = {beta:.2f}"

    def exponential(a, k):
        s = result.attribute("spot_area_pdf", "exponential_scale")[k]
        return np.exp(-a / s) / s, ""

    panels = [("pressure_mean_pdf", "pressure_mean_bin", "mean pressure of a contact", "Rayleigh", rayleigh),
              ("pressure_pdf", "pressure_bin", "pressure in the contact area", r"$\gamma p^\alpha \exp(-(p/\delta)^\beta)$", gamma),
              ("spot_area_pdf", "spot_area_bin", "area of a contact", "exponential", exponential)]
    used = result["pdf_separation_sigma"]
    figure, axes = plt.subplots(1, 3, figsize=(12.2, 3.9), constrained_layout=True)
    drawn = False
    for axis, (name, bins, label, law, fit) in zip(axes, panels):
        centre, density = result[bins], result[name]
        x = np.linspace(centre[0] / 10, centre[-1], 400)
        logarithmic = name == "spot_area_pdf"
        end = 0.0
        for k, (marker, style, colour) in zip(range(len(used)), LEVEL_STYLES):
            if not np.isfinite(density[k]).any():
                continue
            drawn = True
            shown = density[k] > 0
            curve, parameters = fit(x, k)
            axis.plot(centre[shown], density[k][shown], marker, ms=3.5, mfc="none", color=colour, label=rf"$Z_0/\sigma$ = {used[k]:.3g}{parameters}")
            if np.isfinite(curve).all():
                axis.plot(x, curve, style, color=colour, lw=1.2)
            end = max(end, centre[shown].max() if shown.any() else 0)
        axis.set(xlabel=label + result.unit(bins), ylabel="probability density" + result.unit(name), title=f"points: rsc; lines: {law}")
        if end > 0:
            axis.set_xlim(0, end * 1.05)
        axis.ticklabel_format(axis="both", scilimits=(-2, 4), useMathText=True)
        if logarithmic:
            smallest = density[density > 0]
            axis.set_yscale("log")
            if smallest.size:
                axis.set_ylim(smallest.min() / 2, None)
        else:
            axis.set_ylim(bottom=0)
        if axis.get_legend_handles_labels()[0]:
            axis.legend()
    figure.suptitle(result.heading("Distributions over contacts"), fontsize=9)
    if not drawn:
        plt.close(figure)
        return None
    return figure


def main():
    parser = argparse.ArgumentParser(description="Pictures of a result file of rsc, as PNG.")
    parser.add_argument("result", help="result file (NetCDF)")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="folder of the pictures (default: that of the result file)")
    parser.add_argument("--step", type=int, metavar="N", help="draw maps, radial means and contacts of level N (from 1) only")
    arguments = parser.parse_args()

    result = Result(arguments.result)
    if arguments.step is not None and not 1 <= arguments.step <= result.steps:
        sys.exit(f"plot.py: --step {arguments.step}: the file has levels 1 to {result.steps}")
    folder = arguments.output or os.path.dirname(arguments.result) or "."
    stem = os.path.join(folder, os.path.splitext(os.path.basename(arguments.result))[0])
    pictures = {"area": lambda: plot_area(result), "map": lambda: plot_map(result, arguments.step), "radial": lambda: plot_radial(result, arguments.step),
                "asperities": lambda: plot_asperities(result, arguments.step), "distributions": lambda: plot_distributions(result)}
    try:
        os.makedirs(folder, exist_ok=True)
        for name, draw in pictures.items():
            figure = draw()
            if figure is None:
                continue
            figure.savefig(f"{stem}_{name}.png")
            plt.close(figure)
            print(f"{stem}_{name}.png")
    except OSError as error:
        sys.exit(f"plot.py: cannot write the pictures: {error}")


if __name__ == "__main__":
    main()
