"""The texture of a measured map: its spectrum by direction, its autocorrelation, the curve of Abbott and Firestone (ISO 25178-2)."""

import numpy as np
from matplotlib.colors import LogNorm

from plot_style import GREY, Page, STYLES, amount, colour_bar, label

FALLEN = 0.2  # level of the autocorrelation for Sal and Str


def texture(results, options):
    """The texture of the first result with a measured map."""
    first = next((r for r in results if "psd_plane" in r), None)
    if first is None:
        return None
    drawn = [
        draw
        for name, draw in (
            ("psd_plane", _spectrum),
            ("autocorrelation", _autocorrelation),
            ("height_quantile", _ratio),
        )
        if name in first
    ]
    page = Page(options, len(drawn), aspect=0.9)
    for axis, draw in zip(page.axes, drawn):
        draw(page, axis, first)
    return page.finish(first.title)


def _spectrum(page, axis, result):
    wavenumber, angle, psd = result["plane_wavenumber"], result["angle"], result["psd_plane"]
    step = angle[1] - angle[0]
    edges = np.sqrt(wavenumber[1:] * wavenumber[:-1])
    edges = np.concatenate(
        [[wavenumber[0] ** 2 / edges[0]], edges, [wavenumber[-1] ** 2 / edges[-1]]]
    )
    top = psd.max()
    # Six decades contain nearly all the power; smaller values have the lowest colour.
    image = axis.pcolormesh(
        np.append(angle, angle[-1] + step) - step / 2,
        edges,
        np.maximum(psd, 1e-6 * top),
        norm=LogNorm(1e-6 * top, top),
        cmap="viridis",
        rasterized=True,
    )
    bar = page.figure.colorbar(
        image, ax=axis, fraction=0.06, pad=0.03, aspect=20, label=r"$\Phi$ over its largest"
    )
    bar.set_ticks(
        [top, 1e-2 * top, 1e-4 * top, 1e-6 * top],
        labels=["1", "$10^{-2}$", "$10^{-4}$", "$10^{-6}$"],
    )
    bar.ax.minorticks_off()
    across = (float(result["std"]) + 90) % 180
    axis.axvline(across, color="w", ls="--", lw=1)
    axis.set(
        yscale="log",
        ylim=(edges[0], edges[-1]),
        title="spectrum by direction\n(dashed: across the lay)",
    )
    axis.set_xticks([0, 45, 90, 135])
    label(axis, "x", "direction of the wave vector [degree]")
    label(axis, "y", "wavenumber $k$", result.dimension("plane_wavenumber"))


def _autocorrelation(page, axis, result):
    x, y, values = result["lag_x"], result["lag_y"], result["autocorrelation"]
    image = axis.pcolormesh(
        x, y, values, cmap="RdBu_r", vmin=-1, vmax=1, shading="nearest", rasterized=True
    )
    axis.contour(x, y, values, [FALLEN], colors="k", linewidths=0.8)
    page.entry(f"autocorrelation falls to {FALLEN:g}", color="k", lw=0.8)
    reach = min(x[-1], y[-1])
    lay = np.radians(float(result["std"])) if "std" in result else 0.0
    axis.plot(
        reach * np.array([-1, 1]) * np.cos(lay),
        reach * np.array([-1, 1]) * np.sin(lay),
        color=STYLES[1][2],
        ls="--",
        lw=1,
    )
    page.entry("lay", color=STYLES[1][2], ls="--", lw=1)
    axis.set_aspect("equal")
    colour_bar(page.figure, image, axis, "autocorrelation", fraction=0.06, pad=0.03, aspect=20)
    words = (
        [f"Sal {amount(float(result['sal']), result.dimension('sal'))}"] if "sal" in result else []
    )
    words += [f"Str {float(result['str']):.2f}"] if "str" in result else []
    axis.set_title(", ".join(words + [f"lay {float(result['std']):.0f}°"]))
    axis.locator_params(
        axis="x", nbins=5 if x[-1] > 0.6 * y[-1] else 2
    )  # a narrow map has no room for more labels
    axis.locator_params(axis="y", nbins=5 if y[-1] > 0.3 * x[-1] else 2)
    label(axis, "x", "lag $x$", result.dimension("lag_x"))
    label(axis, "y", "lag $y$", result.dimension("lag_y"))


def _ratio(page, axis, result):
    from math import erfc

    share = 100 * np.array([0.5 * erfc(score / np.sqrt(2)) for score in result["normal_score"]])
    height, dimension = result["height_quantile"], result.dimension("height_quantile")
    axis.plot(share, height, color=STYLES[0][2])
    page.entry("material ratio (Abbott and Firestone)", color=STYLES[0][2])
    sk, spk, svk = (float(result[name]) for name in ("sk", "spk", "svk"))
    # The core has the height Sk; the peaks begin at its upper end.
    order = np.argsort(share)
    curve = np.interp(np.linspace(0, 100, 1001), share[order], height[order])
    first = int(np.argmin(curve[:601] - curve[400:]))
    upper = curve[first] + (curve[first] - curve[first + 400]) / 400 * first
    axis.plot([0, 100], [upper, upper - sk], color=GREY, ls="--", lw=1)
    page.entry("core Sk", color=GREY, ls="--", lw=1)
    axis.set(
        xlim=(0, 100),
        title=f"Sk {amount(sk, dimension)}, Spk {amount(spk, dimension)},\nSvk {amount(svk, dimension)}",
    )
    label(axis, "x", "material ratio [%]")
    label(axis, "y", "height about the mean", dimension)
