#!/usr/bin/env python3
"""Thirty bodies as engineers press them, by the default run and by the three laws of asperities,
against elements on a finer grid.

    /usr/bin/python3 input/trust/bodies.py [--rsc ./rsc] [NAME ...]

Measured maps are sampled from heights that are known on a grid twice as fine, on which the elements
they are compared with are solved; made surfaces are compared with elements at 12 points in the
shortest wave. Told: status, N over that of the elements minus 1, and the error that the run
expected, all in per cent; and at the end the numbers of status 0 that are more than 10 % off.
Minutes; needs numpy and netCDF4."""
import argparse
import math
import os
import subprocess
import tempfile
import zlib

import numpy as np

from trust import band_noise, write_map

STEEL, BEARING, SI3N4, SIC, BRASS, GOLD = (
    (206e3, 0.29),
    (210e3, 0.30),
    (310e3, 0.26),
    (410e3, 0.16),
    (103e3, 0.34),
    (78e3, 0.42),
)
GLASS, ALUMINIUM, RUBY, CARBON, PEEK, IRON, SILICON = (
    (64e3, 0.2),
    (71e3, 0.33),
    (435e3, 0.29),
    (24e3, 0.2),
    (3.9e3, 0.4),
    (110e3, 0.26),
    (160e3, 0.22),
)
POINTS = 128  # a side of a measured map


def grooves(x, y, angle, waves):
    """Phase of grooves across `angle`, so many in the side."""
    return 2 * math.pi * waves * (x * math.cos(angle) + y * math.sin(angle))


def measured(name, n):
    """Heights of unit rms of a map on n x n points of the unit square; the same ones for any n."""
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    y, x = np.meshgrid(np.arange(n) / n, np.arange(n) / n, indexing="ij")
    field = lambda longest, shortest, hurst, aspect=1.0, angle=0.0: band_noise(
        rng, n, longest, shortest, hurst, aspect, angle
    )
    if name == "ground raceway":
        z = field(2.5, 10, 0.7, 6.0, math.pi / 2)
    elif name == "ground shaft, oblique":
        z = field(2.5, 10, 0.6, 5.0, 0.4)
    elif name == "turned pin":
        z = np.abs(np.sin(grooves(x, y, 0.03, 5))) * 3 + 0.5 * field(4, 16, 0.8)
    elif name == "lapped seal face":
        z = -np.log(np.cosh(0.8 * field(3, 16, 0.5) + 1)) + 0.05 * field(3, 20, 0.5)
    elif name == "honed liner":
        z = (
            -np.exp(1.2 * field(3, 10, 0.7, 5.0, 0.7))
            - np.exp(1.2 * field(3, 10, 0.7, 5.0, -0.7))
            + 0.4 * field(3, 16, 0.6)
        )
    elif name == "EDM mould":
        z = field(3, 14, 0.9)
        for _ in range(60):
            i, j, r = rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0.03, 0.07)
            d2 = ((x - i) ** 2 + (y - j) ** 2) / r**2
            z = z + np.where(d2 < 8, 1.2 * (d2 - 1) * np.exp(-d2), 0)
    elif name == "coin":
        z = 3 * np.tanh(
            3 * (np.sin(grooves(x, y, 0.3, 2)) * np.cos(grooves(x, y, 1.9, 1.5)) - 0.2)
        ) + 0.3 * field(4, 20, 0.8)
    elif name == "polished wafer, rounded":
        z = np.round(4 * field(2, 16, 0.9)) / 4
    elif name == "lens, rounded":
        z = np.round(10 * field(1.5, 16, 0.9)) / 10
    elif name == "pitted gear flank":
        z = field(3, 16, 0.8)
        for _ in range(14):
            i, j, r = rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0.01, 0.04)
            z = z - 5 * np.exp(-((((x - i) ** 2 + (y - j) ** 2) / r**2) ** 2))
    elif name == "casting with pores":
        z = field(2, 16, 0.8)
        for _ in range(30):  # as wide as one point of the map
            i, j = (rng.integers(0, POINTS, 2) * n) // POINTS
            z[j : j + n // POINTS, i : i + n // POINTS] -= 8
    elif name == "printed layers":
        z = 1.5 * np.abs(np.sin(grooves(x, y, 0.1, 4))) + 0.15 * field(4, 16, 0.8)
    elif name == "gauge block, stepped":
        z = 2 * np.tanh((x - 0.55 + 0.04 * y) * 60) + 0.3 * field(3, 16, 0.7)
    elif name == "scratched sapphire":
        z = field(2, 16, 0.9)
        for _ in range(10):
            turn, place = rng.uniform(0, math.pi), rng.uniform(-0.4, 0.4)
            z = z - 3 * np.exp(
                -((((x - 0.5) * math.cos(turn) + (y - 0.5) * math.sin(turn) - place) * 60) ** 2)
            )
    elif name == "shot-peened blade":
        z = np.zeros_like(x)
        for _ in range(150):
            i, j, r = rng.uniform(-0.1, 1.1), rng.uniform(-0.1, 1.1), rng.uniform(0.06, 0.12)
            z = np.minimum(z, 2 * (((x - i) ** 2 + (y - j) ** 2) / r**2 - 1))
        z = z + 0.1 * field(4, 16, 0.8)
    elif name == "small window":
        z = field(1, 5, 0.8)
    else:
        raise KeyError(name)
    z = z - z.mean()
    return z / z.std()


# name, rough body, the other one, side [mm], rms height [mm], radius [mm]; pressed to so many rms
# heights, or by the force under which a smooth ball touches over so many times the side
MAPS = [
    ("ground raceway", BEARING, SI3N4, 0.4, 2.5e-4, 6.35, "force 0.15 0.35"),
    ("ground shaft, oblique", STEEL, BRASS, 0.5, 4e-4, 10, "force 0.1 0.3"),
    ("turned pin", BRASS, GOLD, 0.6, 1.2e-3, 4, "force 0.1 0.3"),
    ("lapped seal face", SIC, CARBON, 0.25, 8e-5, 20, "force 0.1 0.3"),
    ("honed liner", IRON, STEEL, 0.8, 6e-4, 25, "force 0.15 0.35"),
    ("EDM mould", STEEL, PEEK, 1.0, 2.5e-3, 8, "force 0.1 0.3"),
    ("coin", BRASS, STEEL, 2.0, 8e-3, 30, "sigma 1.5 1"),
    ("polished wafer, rounded", SILICON, RUBY, 0.05, 4e-7, 0.5, "force 0.1 0.3"),
    ("lens, rounded", GLASS, STEEL, 0.2, 2e-6, 12, "force 0.1 0.3"),
    ("pitted gear flank", STEEL, STEEL, 0.5, 6e-4, 15, "force 0.1 0.35"),
    ("casting with pores", IRON, BEARING, 1.0, 3e-3, 10, "sigma 2 1"),
    ("printed layers", ALUMINIUM, STEEL, 2.0, 1e-2, 20, "force 0.1 0.3"),
    ("gauge block, stepped", STEEL, RUBY, 0.3, 5e-5, 3, "force 0.1 0.3"),
    ("scratched sapphire", RUBY, STEEL, 0.2, 3e-5, 5, "force 0.1 0.3"),
    ("shot-peened blade", ALUMINIUM, RUBY, 1.0, 4e-3, 2.5, "force 0.1 0.3"),
    ("small window", GOLD, STEEL, 0.02, 2e-5, 10, "sigma 2 1"),
]
# the same, with L/lambda_l, L/lambda_s, H, plateau, points in the shortest wave, further keys of
# &solids
MADE = [
    (
        "bearing ball G5",
        SI3N4,
        BEARING,
        0.25,
        1.4e-5,
        6.35,
        "force 0.1 0.3",
        3,
        32,
        0.85,
        False,
        8,
        "",
    ),
    (
        "superfinished raceway",
        BEARING,
        BEARING,
        0.4,
        4e-5,
        12,
        "force 0.1 0.3",
        2,
        40,
        0.8,
        True,
        8,
        "",
    ),
    ("valve seat", STEEL, STEEL, 1.2, 5e-4, 4, "force 0.05 0.2", 6, 48, 0.7, False, 6, ""),
    (
        "relay contact",
        GOLD,
        GOLD,
        0.15,
        6e-4,
        1.0,
        "sigma 2.5 1.5",
        6,
        48,
        0.8,
        False,
        8,
        "hardness=900",
    ),
    ("spring pin", BRASS, GOLD, 0.2, 3e-4, 0.3, "sigma 3 2", 4, 32, 0.9, False, 8, ""),
    ("seal ring, PEEK", PEEK, STEEL, 2.0, 8e-4, 40, "force 0.1 0.35", 4, 32, 0.8, True, 6, ""),
    ("brake disc", IRON, CARBON, 4.0, 3e-3, 200, "force 0.1 0.3", 8, 48, 0.8, True, 6, ""),
    ("rail head", STEEL, STEEL, 8.0, 2e-3, 300, "force 0.1 0.3", 4, 40, 0.8, False, 6, ""),
    ("watch jewel", RUBY, STEEL, 0.05, 5e-6, 0.2, "force 0.1 0.3", 2, 24, 0.9, False, 8, ""),
    ("probe on wafer", SILICON, SIC, 0.02, 5e-7, 0.02, "sigma 3 1", 2, 32, 0.7, False, 8, ""),
    ("few contacts", STEEL, RUBY, 0.3, 1e-3, 1.5, "sigma 3.2 2.8", 8, 32, 0.8, False, 8, ""),
    (
        "gold bump on pad",
        GOLD,
        ALUMINIUM,
        0.08,
        4e-4,
        0.6,
        "sigma 2 1",
        3,
        24,
        0.9,
        True,
        5,
        "hardness=1200",
    ),
    ("machine joint", STEEL, IRON, 2.0, 1.5e-3, math.inf, "sigma 2.5 1.5", 8, 48, 0.8, True, 6, ""),
    ("optical flats", GLASS, GLASS, 0.5, 2e-6, math.inf, "sigma 2.5 1.5", 4, 32, 0.9, False, 8, ""),
]


def run(rsc, text, folder):
    """The variables of the result that matter here, or what the program says."""
    import netCDF4

    path = os.path.join(folder, "result.nc")
    if os.path.exists(path):
        os.remove(path)
    done = subprocess.run(
        [rsc, "-q", "--progress", "never", "-o", path], input=text, text=True, capture_output=True
    )
    if not os.path.exists(path):
        return done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "failed"
    with netCDF4.Dataset(path) as f:
        f.set_auto_mask(False)
        names = (
            "force",
            "contact_area",
            "status",
            "separation",
            "force_error_expected",
            "tip_x",
            "tip_y",
            "edge_contacts",
        )
        return {name: np.ravel(f[name][...]).astype(float) for name in names if name in f.variables}


def pressed(what, E, L, R, boundary):
    how, *values = what.split()
    if how == "sigma":
        return f"&indentation levels={', '.join(values)}{boundary} /\n"
    return (
        "&indentation control='force' levels="
        + ", ".join(repr(4 / 3 * E * (float(v) * L / 2) ** 3 / R) for v in values)
        + " /\n"
    )


def main():
    p = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    p.add_argument("names", nargs="*")
    p.add_argument("--rsc", default="./rsc")
    o = p.parse_args()
    o.rsc = os.path.abspath(o.rsc)
    count = {}
    with tempfile.TemporaryDirectory() as folder:
        for body in MAPS + MADE:
            name, (E1, nu1), (E2, nu2), L, sigma, R, what = body[:7]
            if o.names and name not in o.names:
                continue
            E = 1 / ((1 - nu1**2) / E1 + (1 - nu2**2) / E2)
            flats, extra = math.isinf(R), body[12] if len(body) > 7 else ""
            case = (
                f"&run threads=1 seed={zlib.crc32(name.encode()) % 1000} /\n&solids E={E1},"
                f" {E2} nu={nu1}, {nu2} R=Infinity, {'Infinity' if flats else R} {extra} /\n"
            )
            boundary = " boundary='periodic'" if flats else ""
            if len(body) == 7:
                fine, coarse = os.path.join(folder, "fine.nc"), os.path.join(folder, "map.nc")
                z = measured(name, 2 * POINTS) * sigma
                write_map(fine, z, L), write_map(coarse, z[::2, ::2], L)
                surface, resolved = (
                    f"&surface source='heights' file='{coarse}' /\n",
                    f"&surface source='heights' file='{fine}' /\n",
                )
            else:
                longest, shortest, hurst, plateau, points = body[7:12]
                surface = (
                    f"&surface L={L} sigma={sigma!r} L_lambda_l={longest} L_lambda_s={shortest} "
                    f"hurst={hurst} plateau={'.true.' if plateau else '.false.'} "
                    f"n={2 * math.ceil(points * shortest / 2)} /\n"
                )
                resolved = surface + "&elements points_per_wave=12 /\n"
            for law in ("default", "hertz", "elliptic", "fourth_order"):
                by = (
                    ""
                    if law == "default"
                    else f"&solver model='asperities' /\n&asperities law='{law}' /\n"
                )
                r = run(o.rsc, case + surface + pressed(what, E, L, R, boundary) + by, folder)
                if isinstance(r, str):
                    print(f"{name:25s} {law:13s} refused: {r[:150]}", flush=True)
                    continue
                levels = ", ".join(repr(float(v)) for v in r["separation"])
                tip = (
                    f"centre={float(r['tip_x'][0])!r}, {float(r['tip_y'][0])!r}"
                    if "tip_x" in r and not flats
                    else ""
                )
                t = run(
                    o.rsc,
                    case
                    + resolved
                    + f"&indentation unit='length' levels={levels} {tip}{boundary} /\n&solver"
                    " model='elements' /\n",
                    folder,
                )
                if isinstance(t, str):
                    print(f"{name:25s} {law:13s} elements refused: {t[:150]}", flush=True)
                    continue
                told = r.get("force_error_expected", np.full(len(r["force"]), np.nan))
                told = np.where(told > 1e30, np.nan, told)
                off = [
                    a / b - 1 if b > 0 else (0.0 if a == 0 else math.inf)
                    for a, b in zip(r["force"], t["force"])
                ]
                sure = [s == 0 for s in r["status"]]
                wrong = sum(s and abs(e) > 0.1 for s, e in zip(sure, off))
                total = count.setdefault(law, [0, 0, 0, 0, 0])
                for k, more in enumerate(
                    (
                        len(off),
                        sum(sure),
                        wrong,
                        sum(not math.isnan(b) for b in told),
                        sum(abs(e) <= b for e, b in zip(off, told)),
                    )
                ):
                    total[k] += more
                print(
                    (
                        f"{name:25s} {law:13s} status {' '.join(f'{int(s)}' for s in r['status'])} "
                        f" off {' '.join(f'{100 * e:7.1f}' for e in off)}  told "
                        f"{' '.join(f'{100 * b:6.1f}' for b in told)}  edge"
                        f" {' '.join(f'{int(v)}' for v in t['edge_contacts'])}"
                        f"{'  WRONG' if wrong else ''}"
                    ),
                    flush=True,
                )
    for law, (levels, sure, wrong, told, kept) in count.items():
        print(
            f"{law:13s} {levels} levels, {sure} of status 0, {wrong} of these more than 10 % off;"
            f" {kept} of {told} within what was told"
        )


if __name__ == "__main__":
    main()
