#!/usr/bin/env python3
"""Draws the Stribeck curve that the program bearing (bearing.f90) prints.

    bearing steel.law > stribeck.txt
    bearing.py stribeck.txt            draws stribeck.png

Needs numpy and matplotlib."""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


def main(path):
    speed, gap, share, friction = np.loadtxt(path, unpack=True)
    figure, axis = plt.subplots(figsize=(4.6, 3.2), constrained_layout=True)
    axis.loglog(speed, friction, "k-", label="friction coefficient")
    axis.set_xlabel(r"$\eta U/W$ (viscosity, speed, load per width)")
    axis.set_ylabel("friction coefficient")
    other = axis.twinx()
    other.loglog(speed, gap, "C0--", label="gap at the trailing edge")
    other.set_ylabel("gap at the trailing edge", color="C0")
    mixed = speed[(share > 0.01) & (share < 0.99)]
    if mixed.size:
        axis.axvspan(mixed.min(), mixed.max(), color="0.92", zorder=0)
        axis.text(
            np.sqrt(mixed.min() * mixed.max()),
            0.97,
            "film and contacts",
            transform=axis.get_xaxis_transform(),
            ha="center",
            va="top",
            fontsize=8,
        )
    lines = axis.lines + other.lines
    names = [line.get_label() for line in lines]
    axis.legend(lines, names, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2)
    target = os.path.splitext(path)[0] + ".png"
    figure.savefig(target, dpi=150)
    print(target)


main(sys.argv[1])
