"""A profile: its trace with form and filter, its spectrum with the fit and with the profiles of
synthesized surfaces, its amplitude curve."""

import numpy as np

from plot_curves import title
from plot_results import names
from plot_spots import ELASTIC, drawn_level, height_names
from plot_style import Page, STYLES, amount, label


def profile(results, options):
    """The first result with a profile; the heights of other results (its twins) are surfaces whose
    profiles are compared with it."""
    first = next((r for r in results if "profile_psd" in r), None)
    if first is None:
        return None
    page = Page(options, 4, aspect=0.72, columns=2)
    others = [r for r in results if r is not first]
    _trace(page, page.axes[0], first)
    _treated(page, page.axes[1], first, options.step)
    _spectrum(page, page.axes[2], first, others)
    _amplitudes(page.axes[3], first)
    return page.finish(first.title if len(results) == 1 else title(results, "Profile"))


def _trace(page, axis, result):
    x, z = result["trace_x"], result["trace"]
    axis.plot(x, z, color=STYLES[0][2], lw=0.6)
    axis.plot(x, result["trace_form"], color=STYLES[1][2])
    axis.set_title("trace as read")
    page.entry("trace", color=STYLES[0][2])
    page.entry("form", color=STYLES[1][2])
    label(axis, "x", "$x$", result.dimension("trace_x"))
    label(axis, "y", "$z$", result.dimension("trace"))


def _treated(page, axis, result, step):
    """What is left of the trace, and where it touches at a level."""
    x, length = result["profile_x"], result.dimension("profile")
    axis.plot(x, result["profile"], color=STYLES[2][2], lw=0.6)
    cutoffs = [float(result[name]) for name in ("filter_cutoff", "cutoff_long")]
    words = ", ".join(
        f"{name} = {amount(value, length)}"
        for name, value in zip((r"$\lambda_s$", r"$\lambda_c$"), cutoffs)
        if value > 0
    )
    axis.set_title(words or "without form, no filter")
    page.entry("without form, filtered" if words else "without form", color=STYLES[2][2])
    level = drawn_level(result, step)
    pixels = result.pixels(level)
    if pixels:
        mask = pixels[0][0] > 0
        touching = np.interp(result["mask_x"][mask], x, result["profile"])
        axis.plot(result["mask_x"][mask], touching, ".", color=ELASTIC, ms=2, zorder=3)
        page.entry(f"contact at {result.level_name(level)}", color=ELASTIC, marker=".", ls="none")
    axis.set_xlim(result["trace_x"][[0, -1]])
    label(axis, "x", "$x$", result.dimension("profile_x"))
    label(axis, "y", "$z$", length)


def _spectrum(page, axis, result, others):
    axis.set(xscale="log", yscale="log")
    q, psd = result["profile_wavenumber"], result["profile_psd"]
    axis.plot(q, psd, STYLES[0][0], ms=2, mew=0.5, mfc="none", color=STYLES[0][2])
    page.entry("trace", color=STYLES[0][2], marker=STYLES[0][0], ls="none", mfc="none", ms=3)
    if "profile_psd_fit" in result:
        fit, surface = result["profile_psd_fit"], result.file.variables["psd_fit"]
        axis.plot(q[fit > 0], fit[fit > 0], color=STYLES[1][2], gid="fit", zorder=3)
        page.entry(
            f"self-affine surface: $H$ = {surface.hurst:.2f} ± {surface.hurst_error:.2f}",
            color=STYLES[1][2],
        )
    for k, (other, name) in enumerate(zip(others, names([result] + others)[1:]), 3):
        if "height" not in other or "profile" in other:
            continue
        wave, power = profile_spectrum_of(other)
        axis.plot(wave, power, color=STYLES[k % len(STYLES)][2], lw=0.8)
        page.entry(f"profiles of {name}", color=STYLES[k % len(STYLES)][2])
    axis.set_ylim(psd[psd > 0].min() / 3, psd.max() * 5)
    axis.set_title("spectrum of the profile")
    label(axis, "x", "wavenumber $q$", result.dimension("profile_wavenumber"))
    label(axis, "y", "$C_1$", result.dimension("profile_psd"))


def profile_spectrum_of(result):
    """Mean density C1 of the rows of a periodic surface, in bands of some 8 %."""
    _, x, _ = height_names(result)
    z, x = np.asarray(result["height"], float), result[x]
    n, step = z.shape[1], 2 * np.pi / (z.shape[1] * (x[1] - x[0]))
    power = (np.abs(np.fft.rfft(z - z.mean(), axis=1)) ** 2).mean(axis=0) / n**2 / step
    bands = np.unique(np.round(1.08 ** np.arange(0, np.log(n / 2) / np.log(1.08))).astype(int))
    edges = np.append(bands, n // 2 + 1)
    middle = [np.exp(np.log(np.arange(a, b)).mean()) for a, b in zip(edges, edges[1:])]
    means = [power[a:b].mean() for a, b in zip(edges, edges[1:])]
    return np.array(middle) * step, np.array(means)


def _amplitudes(axis, result):
    """Material ratio: the share of the length where the profile is higher."""
    z = np.sort(result["profile"])[::-1]
    share = 100 * (np.arange(z.size) + 0.5) / z.size
    axis.plot(share, z, color=STYLES[2][2])
    rq, length = float(result["rq"]), result.dimension("profile")
    axis.set(
        xlim=(0, 100),
        title=f"Ra {amount(float(result['ra']), length)}, Rq {amount(rq, length)},\n"
        f"Rsk {float(result['rsk']):.2f}, Rku {float(result['rku']):.2f}",
    )
    label(axis, "x", "material ratio", "%")
    label(axis, "y", "$z$", length)
