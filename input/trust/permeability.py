#!/usr/bin/env python3
"""Calibrates the expected error of the permeability: `part` of src/physics/flow/flow.cpp.

    permeability.py [--rsc ./rsc] [--surfaces 8]

The error is stated as part |ln(K/K_c)|, where K_c is the permeability of the same gap on every
second point. Flats with 8 points in the shortest wave are solved again with 24, at three pressures
each; printed are the part that holds for 90 % of the values, and what the present one holds for.
Needs numpy and netCDF4; takes some minutes."""
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
with open(os.path.join(HERE, "..", "..", "src", "physics", "flow", "flow.cpp")) as source:
    PART = float(re.search(r"double part = ([\d.]+)", source.read())[1])
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
        K = np.ma.filled(file["permeability"][0], np.nan)[:, :2]
        error = np.ma.filled(file["permeability_error_expected"][0], np.nan)[:, :2]
        return K, error, np.array(file["area_fraction"][0])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rsc", default="./rsc")
    parser.add_argument("--surfaces", type=int, default=8)
    o = parser.parse_args()
    ratios, change = [], []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(o.surfaces):
            K, error, share = solved(o, number, 8, folder)
            finer = solved(o, number, 24, folder)[0]
            with np.errstate(divide="ignore", invalid="ignore"):
                off = np.log(finer / K)
            good = np.isfinite(off) & (error > 0)
            ratios += list((np.abs(off) / error)[good])
            change += list(off[good])
            print(f"surface {number}: A/A0 {share.round(2)}, ln(K fine/K) {off.round(3).tolist()}")
    ratios = np.array(ratios)
    print(
        f"{len(ratios)} values: 90 % within part = {PART * np.quantile(ratios, 0.9):.2f}; part ="
        f" {PART}: {100 * np.mean(ratios <= 1):.0f} % within, stated over true"
        f" {np.median(1 / ratios):.1f} in the median; K is low by {np.median(change):.3f}"
    )


if __name__ == "__main__":
    main()
