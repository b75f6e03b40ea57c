"""The rough surface: its heights, their spectrum with its fit, their distribution."""

import numpy as np

from plot_curves import title
from plot_results import names
from plot_spots import height_names, heights
from plot_style import Page, STYLES, amount, colour_bar, label


def surface(results, options):
    """Heights, spectrum and distribution of heights of the first result that has any of them; for
    comparison the heights of up to two further results beside them (a map and its twins), the
    spectra of all, and all rms slopes in the legend."""
    first = next((r for r in results if height_names(r) or "psd" in r), None)
    if first is None:
        return None
    spectra = [r for r in results if "psd" in r and "wavenumber" in r]
    maps = [(r, name) for r, name in zip(results, names(results)) if height_names(r)][:3]
    drawn = ["map"] * len(maps) + [
        name
        for name, there in (
            ("spectrum", spectra),
            ("distribution", "height_pdf" in first or height_names(first)),
        )
        if there
    ]
    page = Page(options, len(drawn), aspect=0.92 if len(drawn) > 1 else 0.72)
    for axis, (result, name) in zip(page.axes, maps):
        _map(page, axis, result, f"{name}\n" if len(maps) > 1 else "")
    for axis, name in list(zip(page.axes, drawn))[len(maps) :]:
        {"spectrum": _spectrum, "distribution": _distribution}[name](page, axis, first, results)
    slopes = (
        [(name, r["rms_slope"]) for name, r in zip(names(results), results) if "rms_slope" in r]
        if len(results) > 1
        else []
    )
    for name, slope in slopes:
        page.entry(
            f"{name}: rms slope {np.mean(slope):.3g}" + _scatter(slope),
            ls="none",
        )
    return page.finish(first.title if len(results) == 1 else title(results, "Surfaces"))


def _scatter(values):
    if values.size < 2:
        return ""
    return f" ± {np.std(values, ddof=1):.2g} ({values.size} surfaces)"


def _map(page, axis, result, name):
    image, variable = heights(result, axis), height_names(result)[0]
    dimension = result.dimension(variable)
    image.set_cmap("viridis")
    low, high = np.nanpercentile(np.ma.filled(image.get_array(), np.nan), [0.1, 99.9])
    image.set_clim(low, high)
    colour_bar(
        page.figure,
        image,
        axis,
        "height",
        dimension,
        fraction=0.06,
        pad=0.03,
        aspect=20,
        extend="both",
    )
    axis.locator_params(nbins=5)
    for which in "xy":
        label(axis, which, f"${which}$", dimension)
    sq = float(result["sq"]) if "sq" in result else float(np.nanstd(result[variable]))
    filled = int(result["filled_points"]) if "filled_points" in result else 0
    worn = "worn, " if "worn_volume" in result and result.mean("worn_volume")[-1] > 0 else ""
    axis.set_title(
        f"{name}{worn}rms height {amount(sq, dimension)}"
        + (f",\n{filled} points filled" if filled else "")
    )


def _spectrum(page, axis, _, results):
    results = [r for r in results if "psd" in r and "wavenumber" in r]
    axis.set(xscale="log", yscale="log")
    lows, tops = [], []
    for k, (result, name) in enumerate(zip(results, names(results))):
        marker, line, colour = STYLES[k % len(STYLES)]
        q, psd = result["wavenumber"], result["psd"].reshape(-1, result["wavenumber"].size).mean(
            axis=0
        )
        good = (q > 0) & (psd > 0)
        axis.plot(q[good], psd[good], marker, ms=2, mew=0.5, mfc="none", color=colour)
        page.entry(
            name if len(results) > 1 else "from the profile" if "profile" in result else "measured",
            color=colour,
            marker=marker,
            ls="none",
            mfc="none",
            ms=3,
        )
        lows, tops = lows + [psd[psd > 1e-12 * psd.max()].min()], tops + [
            psd.max()
        ]  # smaller values are rounding errors
        if "psd_fit" in result:
            fit, about = np.ravel(result["psd_fit"])[: q.size], result.file.variables["psd_fit"]
            axis.plot(
                q[fit > 0],
                fit[fit > 0],
                line,
                color=STYLES[1][2] if len(results) == 1 else colour,
                gid="fit",
                zorder=3,
            )
            if len(results) == 1 and "hurst" in about.ncattrs():
                waves = [
                    2 * np.pi / (getattr(about, name) * result.factor("wavenumber"))
                    for name in ("ks", "kl")
                ]
                length = result.dimension("wavenumber").removesuffix("-1")
                page.entry(
                    f"fit: $H$ = {about.hurst:.2f}"
                    + (f" ± {about.hurst_error:.2f}" if "hurst_error" in about.ncattrs() else "")
                    + rf", waves {' to '.join(amount(wave, length) for wave in waves)}",
                    color=STYLES[1][2],
                    ls="-",
                )
            lows.append(max(fit[fit > 0].min() * 1e-4, lows[-1]) if (fit > 0).any() else lows[-1])
    axis.set_ylim(max(lows) / 3, max(tops) * 3)
    axis.set_title("power spectral density")
    label(axis, "x", "wavenumber $k$", results[0].dimension("wavenumber"))
    label(axis, "y", r"$\Phi$", results[0].dimension("psd"))


def _distribution(page, axis, result, _):
    if "height_pdf" in result:
        z, density = result["height_bin"], result["height_pdf"]
        edges, sq = np.append(z, 2 * z[-1] - z[-2]) - (z[1] - z[0]) / 2, float(result["sq"])
        words = f"skewness {float(result['ssk']):.2f}, kurtosis {float(result['sku']):.2f}"
    else:
        heights_ = result[height_names(result)[0]]
        heights_ = heights_[np.isfinite(heights_)]
        heights_ = heights_ - heights_.mean()
        density, edges = np.histogram(heights_, 60, density=True)
        z, sq = (edges[1:] + edges[:-1]) / 2, heights_.std()
        third, fourth = (np.mean((heights_ / sq) ** power) for power in (3, 4))
        words = f"skewness {third:.2f}, kurtosis {fourth:.2f}"
    axis.stairs(density, edges, fill=True, color=STYLES[0][2], alpha=0.4)
    axis.plot(z, np.exp(-(z**2) / (2 * sq**2)) / (np.sqrt(2 * np.pi) * sq), color=STYLES[1][2])
    page.entry("heights", color=STYLES[0][2], alpha=0.4, lw=5)
    page.entry("Gaussian of the same rms", color=STYLES[1][2])
    axis.set(ylim=(0, None), title=words)
    axis.locator_params(axis="x", nbins=5)
    length = result.dimension("height_bin" if "height_bin" in result else height_names(result)[0])
    label(axis, "x", "height about the mean", length)
    label(axis, "y", "probability density", length + "-1")
