"""Distributions over contacts with their fits, if a file has them."""

import numpy as np

from plot_curves import panel_looks, title
from plot_fits import exponential, generalised_gamma, rayleigh
from plot_results import names
from plot_style import FEW, Page, label

# With fewer contacts a distribution of 60 bins has less than one contact per bin.
ENOUGH = 60


# A fit is drawn where no cumulative share is off by more than what the scatter of the contacts
# explains (Kolmogorov and Smirnov, 5 %), or by more than five points in a hundred.
CLOSE = 0.05


def _holds(fit, contacts):
    return fit.ks_distance <= max(CLOSE, 1.36 / np.sqrt(contacts))


# Fits in the units of the file: (values, fit, text of the parameters).
def _rayleigh(result, k, p):
    fit = rayleigh(result, k)
    s = fit.scale
    return p / s**2 * np.exp(-(p**2) / (2 * s**2)), fit, ""


def _gamma(result, k, p):
    fit = generalised_gamma(result, k)
    return (
        fit.factor * p**fit.alpha * np.exp(-((p / fit.delta) ** fit.beta)),
        fit,
        rf"; $\alpha$ = {fit.alpha:.2f}, $\beta$ = {fit.beta:.2f}"
        if np.isfinite(fit.alpha)
        else "",
    )


def _exponential(result, k, a):
    fit = exponential(result, k)
    return np.exp(-a / fit.scale) / fit.scale, fit, ""


def _grouped(centre, density, contacts):
    """Bins in groups, so that a group holds several contacts: at most the root of their number."""
    size = -(-density.size // int(max(8, np.sqrt(contacts))))
    padded = np.append(density, np.zeros(-density.size % size)).reshape(-1, size)
    width = centre[1] - centre[0]
    middles = centre[0] - width / 2 + size * width * (np.arange(len(padded)) + 0.5)
    return middles, padded.mean(axis=1)


PANELS = [
    (
        "pressure_pdf",
        "pressure_bin",
        "pressure in the contact area",
        r"lines: $\gamma p^\alpha \exp(-(p/\delta)^\beta)$",
        _gamma,
    ),
    (
        "pressure_mean_pdf",
        "pressure_mean_bin",
        "mean pressure of a contact",
        "lines: Rayleigh",
        _rayleigh,
    ),
    ("spot_area_pdf", "spot_area_bin", "area of a contact", "lines: exponential", _exponential),
]


def contacts_behind(result):
    """Number of contacts in the distributions of each pdf level."""
    return np.nansum(result["spot_area_count"], axis=1) + result.attribute(
        "spot_area_count", "overflow"
    )


def distributions(results, options):
    """The three distributions over contacts: the levels of one result, or for several results the
    level with the most contacts; only with enough contacts."""
    results = [r for r in results if "spot_area_count" in r]
    shown = []
    for result, name in zip(results, names(results) if results else []):
        counts = contacts_behind(result)
        # Several pdf_levels may have the same nearest level; step 0: it differs between
        # realizations.
        steps = np.where(result["pdf_step"] < 1, -np.arange(counts.size), result["pdf_step"])
        distinct = np.unique(steps, return_index=True)[1]
        levels = np.sort(distinct[counts[distinct] >= ENOUGH])
        for k in levels if len(results) == 1 else levels[np.argsort(counts[levels])[-1:]]:
            step, z = int(result["pdf_step"][k]) - 1, result["pdf_separation_sigma"][k]
            level = (
                result.level_name(step) + result.warning(step)
                if step >= 0
                else rf"$Z_0/\sigma$ = {z:.3g}"
                if np.isfinite(z)
                else f"level {k + 1}"
            )
            shown.append(
                (
                    result,
                    int(k),
                    f"{level}: {counts[k]:.0f} contacts"
                    if len(results) == 1
                    else f"{name}; {level}",
                )
            )
    if not shown:
        if results:
            options.say(
                f"distributions: fewer than {ENOUGH} contacts at every level of output%pdf_levels: "
                "not drawn"
            )
        return None
    page = Page(options, 3, aspect=1.0)
    one = len(results) == 1
    looks = panel_looks(
        page,
        [r for r, _, _ in shown],
        [what + (_gamma(r, k, np.ones(1))[2] if one else "") for r, k, what in shown],
    )
    refused = False
    for axis, (name, bins, text, law, fit) in zip(page.axes, PANELS):
        end, smallest, drawn = 0.0, np.inf, False
        ends = [r[bins][r[name][k] > 0].max() for r, k, _ in shown if (r[name][k] > 0).any()]
        decades = len(ends) > 1 and max(ends) > 20 * min(ends)  # such as elastic and yielding
        for (result, k, _), (marker, line, colour) in zip(shown, looks):
            contacts = contacts_behind(result)[k]
            centre, density = _grouped(result[bins], result[name][k], contacts)
            good = density > 0
            if not good.any():
                continue
            x = (np.geomspace if decades else np.linspace)(centre[0] / 10, centre[good].max(), 300)
            values, found, _ = fit(result, k, x / result.factor(bins))
            fitted = np.isfinite(values).all() and _holds(found, contacts)
            drawn, refused = drawn or fitted, refused or not fitted
            if len(shown) <= FEW or not fitted:  # points of many would hide the lines
                points = dict(ms=2.5, mfc="none", mew=0.7, color=colour)
                axis.plot(centre[good], density[good], marker, **points)
            if fitted:
                axis.plot(x, values * result.factor(name), line, color=colour, lw=1.0, gid="fit")
            end, smallest = max(end, centre[good].max()), min(smallest, density[good].min())
        axis.set_title(law if drawn else "no fit")
        if decades:
            axis.set(
                xscale="log",
                yscale="log",
                xlim=(min(ends) / 30, end * 1.3),
                ylim=(smallest / 3, None),
            )
        else:
            axis.set_xlim(0, end * 1.05 if end > 0 else None)
            if name == "spot_area_pdf" and np.isfinite(smallest):
                axis.set_yscale("log")
                axis.set_ylim(bottom=smallest / 2)
            else:
                axis.set_ylim(bottom=0)
            axis.locator_params(axis="x", nbins=5)
        label(axis, "x", text, shown[0][0].dimension(bins))
        label(axis, "y", "probability density", shown[0][0].dimension(name))
    if refused:
        page.entry("no line where the law does not fit", ls="none")
    return page.finish(title(results, "Distributions over contacts"))
