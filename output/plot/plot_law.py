"""The law of an interface of two flats beside the formulas that it replaces."""

import math
import os
import sys

import numpy as np

from plot_curves import begin, title
from plot_style import GREY, label

_erf = np.vectorize(math.erf)
PALE = "0.65"
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "export"))


def law(results, options):
    """Pressure and flow factors against the mean gap, of the first result with permeability and
    shear flow; Greenwood and Williamson (1966), Greenwood and Tripp (1970) with the own
    summits of the surface, Persson (2007), Patir and Cheng (1978, 1979)."""
    results = [r for r in results if "permeability" in r and "shear_flow" in r and "pressure" in r]
    if not results:
        return None
    from interface_law import Interface
    from table import Refused

    result = results[0]
    try:
        interface = Interface(result.path)
    except Refused:
        return None
    page, looks = begin(results[:1], options, 3)
    colour = looks[0][1]
    ratio = interface["gap"].values / interface.sigma
    H = np.linspace(0.0, max(6.0, ratio.max()), 2000)
    page.entry("rsc, along x", color=colour)
    page.entry("rsc, along y", color=colour, ls=":")
    _pressure(page.axes[0], interface, ratio, H, colour)
    widths, pressures = persson(result, interface)
    if widths is not None:
        page.axes[0].plot(widths, pressures, ":", color=GREY, lw=1.2)
        page.entry("Persson", color=GREY, ls=":")
    if interface.summits:
        page.entry("Greenwood, Williamson", color=GREY, ls="--")
        page.entry("Greenwood, Tripp", color=PALE)
    page.entry("Patir, Cheng: isotropic", color=GREY, ls="-.")
    # Patir and Cheng's h is the distance of the mean planes of rigid, truncated surfaces.
    mean = truncated(H)
    valid = H >= 0.5  # the range of their fits
    for axis, name, fit in (
        (page.axes[1], "flow_factor_pressure", patir_cheng_pressure(H) * (H / mean) ** 3),
        (page.axes[2], "flow_factor_shear", patir_cheng_shear(H)),
    ):
        axis.plot(mean[valid], fit[valid], "-.", color=GREY, lw=1.0)
        for along, line in (("_x", "-"), ("_y", ":")):
            axis.plot(ratio, interface[name + along].values, line, color=colour, marker=".", ms=4)
    for axis in page.axes:
        label(axis, "x", r"mean gap over rms height, $h/\sigma$")
        axis.set_xlim(0, min(6.0, 1.05 * ratio.max()))
    label(page.axes[1], "y", r"$\phi_p = 12 K/h^3$")
    page.axes[1].set_ylim(0, None)
    label(page.axes[2], "y", r"$\phi_s = (h - 2 S)/\sigma$")
    return page.finish(title(results[:1], "The law of the interface, and the formulas"))


def _pressure(axis, interface, ratio, H, colour):
    """Over E*, in decades that contact reaches."""
    modulus = interface.e_star
    load = interface["pressure"].values / modulus
    touches = load > 0
    axis.plot(ratio[touches], load[touches], color=colour, marker=".", ms=4)
    if interface.summits:
        density, radius, deviation, height = interface.summits
        sigma, mean = interface.sigma, truncated(H)
        one = greenwood_williamson((sigma * H - height) / deviation, density, radius, deviation)
        axis.plot(mean, one, "--", color=GREY, lw=1.0)
        # As in codes for lubrication: of the surfaces' mean planes and rms height.
        axis.plot(mean, greenwood_tripp(H, density, radius, sigma), color=PALE, lw=1.0)
    axis.set_yscale("log")
    axis.set_ylim(0.5 * load[touches].min(), 3 * load[touches].max())
    label(axis, "y", "pressure $p/E^*$")


def _normal(H):
    return np.exp(-(H**2) / 2) / np.sqrt(2 * np.pi)


def truncated(H):
    """Mean gap over sigma of rigid Gaussian heights cut off at the distance H sigma."""
    return H * (1 + _erf(H / np.sqrt(2))) / 2 + _normal(H)


def greenwood_williamson(t, density, radius, deviation):
    """p/E* = (4/3) density sqrt(radius deviation^3) F(t), with F the mean of (s - t)^(3/2) over
    Gaussian s > t; t: distance from the summits' mean plane over the deviation of their heights."""
    return 4 / 3 * density * np.sqrt(radius * deviation**3) * _above(t, 1.5)


def greenwood_tripp(H, density, radius, sigma):
    """p/E* = (16 sqrt(2) pi/15) (density radius sigma)^2 sqrt(sigma/radius) F(H), with F the mean
    of (s - H)^(5/2) over Gaussian s > H (Greenwood and Tripp 1970)."""
    product = density * radius * sigma
    return 16 * np.sqrt(2) * np.pi / 15 * product**2 * np.sqrt(sigma / radius) * _above(H, 2.5)


def _above(H, power):
    """The mean of (s - H)^power over Gaussian s > H."""
    t = np.linspace(0, 12, 2001)
    return np.array([t[1] * np.sum(t**power * _normal(t + h)) for h in H])


def persson(result, interface):
    """Mean gaps over sigma and p/E* of self-affine surfaces, with gamma = 0.45 (Yang and Persson,
    J. Phys.: Condens. Matter 20, 215214, 2008); None, None for other surfaces."""
    case = result.case
    made = case.get("surface%source") == "'synthetic'" and case.get("surface%plateau") == ".false."
    if not made or float(case["surface%aspect"]) != 1 or not interface.sigma > 0:
        return None, None
    gamma = 0.45
    hurst, first, last = (
        float(case["surface%" + key]) for key in ("hurst", "L_lambda_l", "L_lambda_s")
    )
    # Waves in units of the longest; sigma^2 = 2 pi int q C dq = 1.
    t = np.linspace(0, np.log(last / first), 400)[1:]
    q, dq = np.exp(t), np.exp(t) * (t[1] - t[0])
    C = q ** (-2 * (1 + hurst))
    C /= 2 * np.pi * np.sum(q * C * dq)
    w = 1 / np.sqrt(np.pi * np.cumsum(q**3 * C * dq))
    load = interface["pressure"].values
    load = load[load > 0] / interface.e_star
    # Slopes are sigma times the longest wave in these units.
    steepness = interface.sigma * 2 * np.pi * first / float(case["surface%L"])
    ends = np.log([load.min() / steepness, 20 / w.min()])
    s = np.linspace(*ends, 600)
    p = np.exp(s)[:, None]
    inner = (gamma + 3 * (1 - gamma) * _erf(w * p) ** 2) * np.exp(-((w * p) ** 2))
    tail = np.cumsum(inner[::-1], axis=0)[::-1] * (s[1] - s[0])  # int from p on of dp'/p'
    gap = np.sqrt(np.pi) * np.sum(q**2 * C * w * dq * tail, axis=1)
    return gap, p[:, 0] * steepness


def patir_cheng_pressure(H):
    return 1 - 0.9 * np.exp(-0.56 * H)


def patir_cheng_shear(H):
    """Of a rough face at rest below a smooth moving one (Patir and Cheng 1979, table 1)."""
    near = 1.899 * H**0.98 * np.exp(-0.92 * H + 0.05 * H**2)
    return np.where(H <= 5, near, 1.126 * np.exp(-0.25 * H))
