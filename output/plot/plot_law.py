"""The law of an interface of two flats beside the formulas that it replaces."""

import os
import sys

import numpy as np

from plot_curves import begin, title
from plot_style import GREY, label

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "export"))


def law(results, options):
    """Pressure and flow factors against the mean gap, of the first result with permeability and
    shear flow; Greenwood and Tripp (1970) with the surface's own summits, Persson (2007), Patir and
    Cheng (1978, 1979)."""
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
    if interface.summits:
        page.entry("Greenwood, Tripp: own summits", color=GREY, ls="--")
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
    label(page.axes[1], "y", r"pressure flow factor $12 K/h^3$")
    page.axes[1].set_ylim(0, None)
    label(page.axes[2], "y", r"shear flow factor $(h - 2 S)/\sigma$")
    return page.finish(title(results[:1], "The law of the interface, and the formulas"))


def _pressure(axis, interface, ratio, H, colour):
    """Over E*, in decades that contact reaches."""
    modulus = interface.e_star
    load = interface["pressure"].values / modulus
    touches = load > 0
    axis.plot(ratio[touches], load[touches], color=colour, marker=".", ms=4)
    if interface.summits:
        density, radius, deviation = interface.summits
        axis.plot(
            truncated(H),
            greenwood_tripp(H, density, radius, interface.sigma),
            "--",
            color=GREY,
            lw=1.0,
        )
    axis.set_yscale("log")
    axis.set_ylim(0.5 * load[touches].min(), 3 * load[touches].max())
    label(axis, "y", "pressure $p/E^*$")


def _normal(H):
    return np.exp(-(H**2) / 2) / np.sqrt(2 * np.pi)


def truncated(H):
    """Mean gap over sigma of rigid Gaussian heights cut off at the distance H sigma."""
    s = np.linspace(-9, 9, 9001)
    above = np.cumsum(_normal(s)) * (s[1] - s[0])  # probability of heights below s
    return H * np.interp(H, s, above) + _normal(H)


def greenwood_tripp(H, density, radius, sigma):
    """p/E* = (16 sqrt(2) pi/15) (density radius sigma)^2 sqrt(sigma/radius) F(H), with F the mean
    of (s - H)^(5/2) over Gaussian s > H (Greenwood and Tripp 1970)."""
    t = np.linspace(0, 9, 2001)
    F = np.array([t[1] * np.sum(t**2.5 * _normal(t + h)) for h in H])
    product = density * radius * sigma
    return 16 * np.sqrt(2) * np.pi / 15 * product**2 * np.sqrt(sigma / radius) * F


def patir_cheng_pressure(H):
    return 1 - 0.9 * np.exp(-0.56 * H)


def patir_cheng_shear(H):
    """Of a rough face at rest below a smooth moving one (Patir and Cheng 1979, table 1)."""
    near = 1.899 * H**0.98 * np.exp(-0.92 * H + 0.05 * H**2)
    return np.where(H <= 5, near, 1.126 * np.exp(-0.25 * H))
