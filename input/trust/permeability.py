#!/usr/bin/env python3
"""Calibrates the extrapolation and the expected errors of the permeability and of the shear flow:
the powers and parts in src/physics/flow/flow.hpp.

    permeability.py [--rsc ./rsc] [--surfaces 8]

K is extrapolated as K (K/K_c)^power, where K_c is that of the same gap on every second point, and
its error is stated as part |ln(K/K_c)|. Flats with 8 points in the shortest wave are solved again
with 24, at three pressures each; printed are the power of the least mean error, the part that holds
for 90 % of the values, and what the present one holds for. Needs numpy and
netCDF4; takes some minutes."""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(
    0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "output", "plot")
)
from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "netCDF4")

import netCDF4
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(HERE, "..", "..", "src", "physics", "flow", "flow.hpp")) as source:
    found = dict(re.findall(r"k(\w+) = ([\d.]+)", source.read()))
NAMES = {"permeability": "Permeability", "shear_flow": "Shear"}
PARTS = {name: float(found[key + "Part"]) for name, key in NAMES.items()}
POWERS = {name: float(found[key + "Power"]) for name, key in NAMES.items()}
RISE = {"permeability": 1, "shear_flow": -1}  # with finer grids
E_STAR = 1e4 / 0.91


def slope(sigma, hurst, first, last):
    """The rms slope of a self-affine surface on the side 1 (src/surface/spectrum.cpp)."""
    ratio = last / first
    part = lambda p: (ratio ** (p - 2 * hurst) - 1) / (p - 2 * hurst)
    return sigma * 2 * math.pi * first * math.sqrt(part(2) / part(0))


def solved(o, number, points, folder):
    hurst, first, sigma = 0.3 + 0.09 * (number % 8), 2 + number % 3, 1e-3
    last, path = 4 * first, os.path.join(folder, "seal.nc")
    unit = E_STAR * slope(sigma, hurst, first, last)
    case = (
        f"&run seed={number + 1} /\n&solids E=Infinity,1e4 nu=0,0.3 R=Infinity,Infinity /\n"
        f"&surface sigma={sigma} hurst={hurst} L_lambda_l={first} L_lambda_s={last}"
        f" n={points * last} /\n&solver model='elements' /\n&elements points_per_wave={points} /\n"
        f"&indentation boundary='periodic'"
        f" control='pressure' unit='pressure' levels={0.03 * unit},{0.08 * unit},{0.14 * unit} /\n"
        f"&output flow=.true. file='{path}' /\n"
    )
    subprocess.run([o.rsc, "-q", "--progress", "never"], input=case, text=True, check=True)
    with netCDF4.Dataset(path) as file:
        values = lambda name: np.ma.filled(file[name][0], np.nan)[:, :2]
        return {name: (values(name), values(name + "_error_expected")) for name in PARTS}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rsc", default="./rsc")
    parser.add_argument("--surfaces", type=int, default=8)
    o = parser.parse_args()
    offs, changes = ({name: [] for name in PARTS} for _ in range(2))
    with tempfile.TemporaryDirectory() as folder:
        for number in range(o.surfaces):
            coarse, fine = (solved(o, number, points, folder) for points in (8, 24))
            for name in PARTS:
                value, error = coarse[name]
                with np.errstate(divide="ignore", invalid="ignore"):
                    off = np.log(fine[name][0] / value)
                good = np.isfinite(off) & (error > 0)
                offs[name] += list(off[good])
                changes[name] += list(RISE[name] * (error / PARTS[name])[good])
                print(f"surface {number}, {name}: ln(fine/coarse) {off.round(3).tolist()}")
    for name, part in PARTS.items():
        off, change, power = np.array(offs[name]), np.array(changes[name]), POWERS[name]
        trials = np.arange(0, 1, 0.01)
        least = min(trials, key=lambda p: np.mean(np.abs(off + (power - p) * change)))
        ratio = np.abs(off / change) / part
        print(
            f"{name}, {len(off)} values: least error with the power {least:.2f} (now {power});"
            f" 90 % within part = {part * np.quantile(ratio, 0.9):.2f}; part = {part}:"
            f" {100 * np.mean(ratio <= 1):.0f} % within, stated over true"
            f" {np.median(1 / ratio):.1f} in the median; error {np.median(np.abs(off)):.4f},"
            f" without extrapolation {np.median(np.abs(off + power * change)):.4f}"
        )


if __name__ == "__main__":
    main()
