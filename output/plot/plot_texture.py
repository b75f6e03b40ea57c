"""The texture of a measured map: its spectrum by direction, and its curve of Abbott and
Firestone."""

import numpy as np
from matplotlib.colors import LogNorm

from plot_style import Page, STYLES, label


def texture(results, options):
    """The texture of the first result with a measured map."""
    first = next((r for r in results if "psd_plane" in r), None)
    if first is None:
        return None
    drawn = [
        draw
        for name, draw in (
            ("psd_plane", _spectrum),
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
    axis.set(yscale="log", ylim=(edges[0], edges[-1]), title="spectrum by direction")
    axis.set_xticks([0, 45, 90, 135])
    label(axis, "x", "direction of the wave vector [degree]")
    label(axis, "y", "wavenumber $k$", result.dimension("plane_wavenumber"))


def _ratio(page, axis, result):
    from math import erfc

    share = 100 * np.array([0.5 * erfc(score / np.sqrt(2)) for score in result["normal_score"]])
    height, dimension = result["height_quantile"], result.dimension("height_quantile")
    axis.plot(share, height, color=STYLES[0][2])
    page.entry("material ratio (Abbott and Firestone)", color=STYLES[0][2])
    axis.set(xlim=(0, 100))
    label(axis, "x", "material ratio [%]")
    label(axis, "y", "height about the mean", dimension)
