"""Distributions over contacts with their fits, and the spectrum of heights, where a file holds them."""

import numpy as np

from plot_results import names
from plot_style import few, legend, panels, style

# Fewer contacts make no distribution: a bin of 60 would hold less than one.
ENOUGH = 60


def _rayleigh(result, k, p):
    s = result.attribute("pressure_mean_pdf", "rayleigh_scale")[k]
    return p / s**2 * np.exp(-(p**2) / (2 * s**2)), ""


def _gamma(result, k, p):
    alpha, beta, delta, factor = (result.attribute("pressure_pdf", a)[k] for a in ("alpha", "beta", "delta", "gamma"))
    if not np.isfinite(alpha):
        return np.full_like(p, np.nan), ""
    return factor * p**alpha * np.exp(-((p / delta) ** beta)), rf"$\alpha$ = {alpha:.2f}, $\beta$ = {beta:.2f}"


def _exponential(result, k, a):
    s = result.attribute("spot_area_pdf", "exponential_scale")[k]
    return np.exp(-a / s) / s, ""


PANELS = [("pressure_mean_pdf", "pressure_mean_bin", "mean pressure of a contact", "Rayleigh", _rayleigh),
          ("pressure_pdf", "pressure_bin", "pressure in the contact area", r"$\gamma p^\alpha \exp(-(p/\delta)^\beta)$", _gamma),
          ("spot_area_pdf", "spot_area_bin", "area of a contact", "exponential", _exponential)]


def contacts_behind(result):
    """How many contacts each pdf level's distributions are of."""
    return np.nansum(result["spot_area_count"], axis=1) + result.attribute("spot_area_count", "overflow")


def distributions(results, options):
    """The three distributions over contacts: the levels of one result, or of several the one with the most contacts; only where there are contacts enough."""
    results = [r for r in results if "spot_area_count" in r]
    shown = []
    for result, name in zip(results, names(results) if results else []):
        counts = contacts_behind(result)
        levels = np.flatnonzero(counts >= ENOUGH)
        for k in levels if len(results) == 1 else levels[np.argsort(counts[levels])[-1:]]:
            z = result["pdf_separation_sigma"][k]
            level = rf"$Z_0/\sigma$ = {z:.3g}" if np.isfinite(z) else f"level {k + 1}"
            step = int(result["pdf_step"][k]) - 1  # -1: it differs between realizations
            level += result.warning(step) if step >= 0 else ""
            shown.append((result, int(k), f"{level}, {counts[k]:.0f} contacts" if len(results) == 1 else name))
    if not shown:
        if results:
            options.say(f"distributions: fewer than {ENOUGH} contacts at every level of &output pdf_levels: not drawn")
        return None
    figure, axes = panels(3, options.width, aspect=0.8, entries=few(len(shown)))
    for axis, (name, bins, label, law, fit) in zip(axes, PANELS):
        end, smallest = 0.0, np.inf
        ends = [r[bins][r[name][k] > 0].max() for r, k, _ in shown if (r[name][k] > 0).any()]
        decades = len(ends) > 1 and max(ends) > 20 * min(ends)  # such as elastic and yielding
        for i, (result, k, title) in enumerate(shown):
            marker, line, colour = style(i, len(shown))
            centre, density = result[bins], result[name][k]
            good = density > 0
            if not good.any():
                continue
            x = (np.geomspace if decades else np.linspace)(centre[0] / 10, centre[good].max(), 300)
            curve, parameters = fit(result, k, x)
            axis.plot(centre[good], density[good], marker, ms=2.5, mfc="none", mew=0.7, color=colour, label=parameters or title)
            if np.isfinite(curve).all():
                axis.plot(x, curve, line, color=colour, lw=1.0, gid="fit")
            end, smallest = max(end, centre[good].max()), min(smallest, density[good].min())
        axis.set_xlabel(label + shown[0][0].unit(bins), labelpad=9)  # room for the power of ten
        axis.set(ylabel="probability density" + shown[0][0].unit(name), title=f"points: rsc; lines: {law}")
        if decades:
            axis.set(xscale="log", yscale="log", xlim=(min(ends) / 30, end * 1.3), ylim=(smallest / 3, None))
        else:
            axis.ticklabel_format(axis="both", scilimits=(-2, 4), useMathText=True)
            axis.set_xlim(0, end * 1.05 if end > 0 else None)
            if name == "spot_area_pdf":
                axis.set_yscale("log")
            axis.set_ylim(bottom=smallest / 2 if name == "spot_area_pdf" and np.isfinite(smallest) else None if name == "spot_area_pdf" else 0)
        if name == "pressure_mean_pdf":
            legend(axis, below=axes[3] if len(axes) > 3 else None)
        elif name == "pressure_pdf" and len(shown) <= 3:
            legend(axis)
    figure.suptitle(results[0].heading("Distributions over contacts") if len(results) == 1 else "Distributions over contacts", fontsize=8)
    return figure


def spectrum(results, options):
    """The spectrum of the heights, with its fit where the file has one."""
    results = [r for r in results if "psd" in r and "wavenumber" in r]
    if not results:
        return None
    figure, axes = panels(1, min(options.width, 130.0), least=30.0)
    for i, (result, title) in enumerate(zip(results, names(results))):
        marker, line, colour = style(i, len(results))
        k, psd = result["wavenumber"], result["psd"].reshape(-1, result["wavenumber"].size).mean(axis=0)
        good = (k > 0) & (psd > 0)
        axes[0].plot(k[good], psd[good], marker, ms=2, mew=0.5, mfc="none", color=colour, label="heights" if len(results) == 1 else title)
        if "psd_fit" in result:
            fit = np.ravel(result["psd_fit"])[: k.size]
            law = "fit" + (f", $H$ = {float(result.file.variables['psd_fit'].hurst):.3g}" if "hurst" in result.file.variables["psd_fit"].ncattrs() else "")
            axes[0].plot(k[fit > 0], fit[fit > 0], "-" if len(results) == 1 else line, color="#c1440e" if len(results) == 1 else colour, label=law if len(results) == 1 else None, gid="fit",
                         zorder=3)
    axes[0].set(xscale="log", yscale="log", xlabel="wavenumber $k$" + results[0].unit("wavenumber"), ylabel=r"spectrum $\Phi$" + results[0].unit("psd"))
    top = max(r["psd"].max() for r in results)
    low = min(r["psd"][r["psd"] > 1e-12 * top].min() for r in results)  # what is smaller is rounding
    axes[0].set_ylim(low / 3, top * 3)
    legend(axes[0])
    figure.suptitle(results[0].heading("Spectrum of the heights") if len(results) == 1 else "Spectrum of the heights", fontsize=8)
    return figure
