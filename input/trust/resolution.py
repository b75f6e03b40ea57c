#!/usr/bin/env python3
"""Calibrates the expected errors of boundary elements: the constants error_factor of
src/contact/quantities.cpp, and those of stresses in src/physics/stress/stress_row.cpp.

    resolution.py solve [--first K] [--last K]    solves bodies on their grid and on one four times
                                                  finer (slow; finished bodies are skipped)
    resolution.py fit                             prints the constants, and by kind of body the
                                                  share of levels within the error and the median of
                                                  stated over true error
    resolution.py sliding                         tension behind a sliding ball, by Hamilton's
                                                  closed form

Options: --rsc ./rsc the program; --out DIR folder of the results (output/resolution).

The error of a quantity is taken as k b, where b is border_share: the sides of pixels on borders of
contacts over the pixels in contact. Of a sum over contacts it is divided by the fourth root of
their number. k is the 90 % quantile over all bodies but those with hardness or edges. Bodies are
determined by their number: rough balls, flats and rollers, smooth bodies, maps of few points a wave
(free and flat), yielding bodies, and punches. Needs numpy and netCDF4."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(
    0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "output", "plot")
)
from plot_python import needs

if __name__ == "__main__":
    needs("numpy", "netCDF4")

import numpy as np
from trust import band_noise, write_map

KINDS = ("ball", "flat", "line", "smooth", "map", "hard", "mapflat", "edge")
NOT_FITTED = ("hard", "edge")
E, NU = 1.0e5, 0.3
E_STAR = E / (2 * (1 - NU**2))
FINER = 4
READ = 1.5  # factor of heights from a file
# variable, whether it is a sum over contacts
QUANTITIES = {
    "force": True,  # or the separation, times the stiffness over N
    "contact_area": True,
    "stiffness": True,
    "energy": True,
    "pressure_max": False,
    "gap_mean": False,
}
DEPTHS = (0, 0.1, 0.3, 0.7, 1.5, 4, 99)  # in pixels


def draw(number):
    rng = np.random.default_rng([717, number])
    waves = int(rng.choice([8, 12, 16, 20, 28, 36]))
    longest = float(rng.choice([1, 2, 3, 4, 6]))
    while longest > waves / 2.5:
        longest /= 2
    return {
        "kind": KINDS[number % len(KINDS)],
        "turned": bool(number // len(KINDS) % 2),
        "number": number,
        "waves": waves,
        "longest": longest,
        "points": float(rng.choice([4, 5, 6, 8, 10, 12])),
        "map_points": float(rng.choice([2.2, 2.5, 3, 4, 6])),
        "hurst": float(rng.uniform(0.2, 1)),
        "plateau": bool(rng.random() < 0.3),
        "sigma": float(10 ** rng.uniform(-5, -2.5)),
        "R": float(10 ** rng.uniform(-0.3, 2)),
        "aspect": float(rng.choice([1, 1, 1, 2, 5])),
        "direction": float(rng.choice([0, 90, 30, 77])),
        "skewness": float(rng.choice([0, 0, 0, -1, 0.8])),
        "seed": int(rng.integers(1, 10**6)),
        "by_force": bool(rng.random() < 0.6),
        "radii": sorted(float(10 ** rng.uniform(-1.7, -0.7)) for _ in range(3)),
        "pressures": sorted(float(10 ** rng.uniform(-2.5, -0.2)) for _ in range(3)),
        "heights": sorted((float(rng.uniform(-2, 2.2)) for _ in range(3)), reverse=True),
        "n": int(rng.choice([41, 64, 97, 128])),
        "shape": str(rng.choice(["sphere", "paraboloid", "roller", "cone"])),
        "hardness": float(10 ** rng.uniform(-1, 0)),
    }


def rms_slope(b):
    q = np.arange(max(1, round(b["longest"])), b["waves"] + 1)
    psd = q ** (-2 * (1 + b["hurst"]))
    return b["sigma"] * math.sqrt(np.sum(q**3 * psd) / np.sum(q * psd)) * 2 * math.pi


def surface_keys(b, grid, folder):
    """The keys of the surface on a grid `grid` times finer, and the side of its pixels."""
    if b["kind"] in ("smooth", "edge"):
        n = b["n"] * grid
        path = os.path.join(folder, "smooth.nc")
        write_map(path, np.zeros((n, n)))
        sigma = 1e-4
    elif b["kind"] in ("map", "mapflat"):
        rng = np.random.default_rng(b["seed"])
        n = round(b["waves"] * b["map_points"] * math.sqrt(b["aspect"]) / 2) * 2
        z = band_noise(
            rng,
            FINER * n,
            b["longest"],
            b["waves"],
            b["hurst"],
            b["aspect"],
            math.radians(b["direction"]),
            b["plateau"],
        )
        if b["skewness"]:
            z = np.exp(0.4 * b["skewness"] * z)
        z = (z - z.mean()) / z.std() * b["sigma"]
        path = os.path.join(folder, "map.nc")
        write_map(path, z[:: FINER // grid, :: FINER // grid])
        sigma = b["sigma"]
        n *= grid
    else:
        skewness = f" skewness={b['skewness']}" if b["skewness"] else ""
        return (
            f"&surface L=1 sigma={b['sigma']!r} L_lambda_l={b['longest']} L_lambda_s={b['waves']}"
            f" hurst={b['hurst']!r} plateau={'T' if b['plateau'] else 'F'} aspect={b['aspect']}"
            f" direction={b['direction']}{skewness} /\n"
            f"&elements points_per_wave={b['points'] * grid!r} /\n",
            1 / (b["points"] * grid * b["waves"] * math.sqrt(b["aspect"])),
        )
    return (
        f"&surface source='heights' file='{path}' detrend='none' sigma={sigma!r} /\n",
        1 / n,
    )


def body_keys(b):
    """The keys of body 2 and of the levels."""
    kind, R = b["kind"], b["R"]
    smooth = kind in ("smooth", "edge")
    flat = kind in ("flat", "mapflat") or (kind == "hard" and b["turned"])
    line = kind == "line" or (smooth and b["shape"] == "roller")
    rough = 0 if smooth else b["sigma"]
    joined = lambda values: ",".join(repr(v) for v in values)
    slope = rms_slope(b)
    hard = f" hardness={b['hardness'] * E_STAR * slope!r}" if kind == "hard" else ""
    solids = f"&solids E={E},{E} nu={NU},{NU} R=Infinity,{'Infinity' if flat or line else repr(R)}"
    solids += hard + " /\n"
    if flat:
        if b["by_force"] or hard:
            scale = E_STAR * slope * (0.3 * b["hardness"] if hard else 1)
            levels = "control='pressure' unit='pressure' levels="
            levels += joined(p * scale for p in b["pressures"])
        else:
            levels = "unit='length' levels=" + joined(
                max(0.3 + 0.45 * (z + 2), 0.3) * b["sigma"] for z in b["heights"]
            )
        return solids + f"&indentation boundary='periodic' {levels} /\n"
    approaches = [a * a / R for a in b["radii"]]
    if line:
        solids += f"&indenter shape='paraboloid' radii={R!r},Infinity"
        solids += f" angle={0 if b['turned'] else 90} /\n"
        levels = f"boundary='periodic_{'y' if b['turned'] else 'x'}' "
        if b["by_force"]:
            levels += "control='force' levels=" + joined(
                math.pi * E_STAR * a**2 / (4 * R) for a in b["radii"]
            )
        else:
            levels += "unit='length' levels=" + joined(
                z * rough - d * (math.log(2 / a) / 2 + 0.25)
                for z, d, a in zip(b["heights"], approaches, b["radii"])
            )
        return solids + f"&indentation {levels} /\n"
    if smooth and b["shape"] == "paraboloid":
        solids += f"&indenter shape='paraboloid' radii={R!r},{2.5 * R!r} angle=20 /\n"
    if kind == "smooth" and b["shape"] == "cone":
        solids += "&indenter shape='cone' slope=0.05 /\n"
    if kind == "edge" and b["shape"] in ("sphere", "cone"):
        rim = 0 if b["turned"] else 0.3 * R
        solids += f"&indenter shape='punch' radius={b['radii'][0]!r} rim_radius={rim!r} /\n"
    if b["by_force"] or kind == "edge":
        levels = "control='force' levels=" + joined(
            4 / 3 * E_STAR * a**3 / R for a in b["radii"]
        )
    else:
        levels = "unit='length' levels=" + joined(
            z * rough - d for z, d in zip(b["heights"], approaches)
        )
    return solids + f"&indentation centre=0.4871,0.5139 {levels} /\n"


def solved(rsc, case, folder):
    """The variables of the levels, each with a list for its components or depths; or why not."""
    import netCDF4

    path = os.path.join(folder, "result.nc")
    done = subprocess.run(
        [rsc, "-q", "--progress", "never", "-o", path], input=case, text=True, capture_output=True
    )
    if not os.path.exists(path):
        return {"failed": done.stderr[-300:]}
    out = {}
    with netCDF4.Dataset(path) as file:
        steps = file.dimensions["step"].size
        for name, v in file.variables.items():
            if "step" in v.dimensions[:2] and v.dtype.kind in "fi":
                values = np.ma.filled(v[:].astype(float), np.nan)
                if values.shape[0] == 1 or v.dimensions[0] == "step":
                    out[name] = values.reshape(steps, -1).tolist()
    os.remove(path)
    return out


def solve(o):
    for number in range(o.first, o.last):
        path = o.out / f"{number}.json"
        if path.exists():
            continue
        b = draw(number)
        smooth = b["kind"] in ("smooth", "edge")
        unit = b["radii"][0] if smooth else 0.4 / b["waves"]
        b["depths"] = [0.05 * unit, 0.25 * unit, unit]
        results = []
        with tempfile.TemporaryDirectory() as folder:
            for grid in (1, FINER):
                surface, side = surface_keys(b, grid, folder)
                b.setdefault("side", side)
                case = (
                    f"&run threads=1 seed={b['seed']} /\n{surface}{body_keys(b)}"
                    "&solver model='elements' /\n&output contacts='none' map_cells=4"
                    f" radial_bins=4 stress_depths={','.join(map(repr, b['depths']))} /\n"
                )
                results.append(solved(o.rsc, case, folder))
        path.write_text(json.dumps({"body": b, "results": results}))
        print(number, b["kind"], [r.get("failed", "solved") for r in results], flush=True)


def levels_of(out):
    """Kind, border_share, number of contacts, and relative errors by quantity, of each level; of
    stresses the error, with the depth in pixels."""
    for path in sorted(out.glob("*.json"), key=lambda p: int(p.stem)):
        study = json.loads(path.read_text())
        b, (coarse, fine) = study["body"], (study["results"] + [{"failed": ""}] * 2)[:2]
        if "failed" in coarse or "failed" in fine:
            continue
        for k in range(len(coarse["force"])):
            a = {name: values[k] for name, values in coarse.items()}
            t = {name: values[k] for name, values in fine.items()}
            N, border = a["force"][0], a.get("border_share", [np.nan])[0]
            if not (N > 0 and t["force"][0] > 0 and border > 0) or a["status"][0] == 4:
                continue
            off = lambda name, c=0: abs(a[name][c] / t[name][c] - 1)
            errors = {name: off(name) for name in QUANTITIES if name in a and t[name][0] != 0}
            if errors["force"] < 1e-5 and "stiffness" in a:
                gap = a["separation"][0] - t["separation"][0]
                errors["force"] = abs(gap * a["stiffness"][0] / N)
            stresses = []
            for c, depth in enumerate(b["depths"]):
                mises = a["mises_max"][c]
                tension = abs(a["tension_max"][c] - t["tension_max"][c]) / mises
                stresses.append(
                    (depth / b["side"], off("mises_max", c), off("shear_max", c), tension)
                )
            yield b["kind"], border, a["contacts"][0], errors, stresses


def fit(o):
    levels = list(levels_of(o.out))
    print(len(levels), "levels")
    read = lambda kind: READ if kind.startswith("map") else 1.0
    for name, total in QUANTITIES.items():
        rows = [
            (kind, border * read(kind) * (count**-0.25 if total else 1), errors[name])
            for kind, border, count, errors, _ in levels
            if np.isfinite(errors.get(name, np.nan))
        ]
        fitted = [e / x for kind, x, e in rows if kind not in NOT_FITTED]
        k = np.quantile(fitted, 0.9)
        print(f"{name}: {k:.4f}")
        for kind in KINDS:
            mine = np.array([(x, e) for what, x, e in rows if what == kind])
            if len(mine):
                within = 100 * np.mean(mine[:, 1] <= k * mine[:, 0])
                over = np.median(k * mine[:, 0] / np.maximum(mine[:, 1], 1e-9))
                print(f"    {kind:8s} {len(mine):4d} levels, {within:3.0f} %, {over:.1f}")
    for what, name in enumerate(("von Mises", "shear", "tension over von Mises"), 1):
        for low, high in zip(DEPTHS, DEPTHS[1:]):
            part = [
                s[what] / (border * read(kind))
                for kind, border, _, _, stresses in levels
                for s in stresses
                if kind not in NOT_FITTED and low <= s[0] < high and np.isfinite(s[what])
            ]
            if len(part) > 9:
                print(f"{name}, depth {low} to {high} pixels: {np.quantile(part, 0.9):.4f}")


def sliding(o):
    """Tension at the trailing edge: p0 [(1 - 2 nu)/3 + pi mu (4 + nu)/8] (Hamilton 1983)."""
    found = []
    R, a = 10, 0.3
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "smooth.nc")
        for n in (48, 96, 160):
            write_map(path, np.zeros((n, n)))
            for nu in (0.1, 0.3, 0.45):
                for mu in (0.1, 0.3, 0.6):
                    modulus = E / (2 * (1 - nu**2))
                    N = 4 / 3 * modulus * a**3 / R
                    case = (
                        f"&solids E={E},{E} nu={nu},{nu} R=Infinity,{R} friction={mu} /\n"
                        f"&surface source='heights' file='{path}' detrend='none' sigma=1e-3 /\n"
                        f"&indentation control='force' levels={N!r} centre=0.48,0.47 /\n"
                        "&output contacts='none' stress_depths=0 sliding_direction=17 /\n"
                    )
                    r = solved(o.rsc, case, folder)
                    p0 = 3 * N / (2 * math.pi * a * a)
                    exact = p0 * ((1 - 2 * nu) / 3 + math.pi * mu * (4 + nu) / 8)
                    error = abs(r["tension_max"][0][0] / exact - 1)
                    found.append(error / math.sqrt(r["border_share"][0][0]))
    print(f"error over the root of border_share: {np.quantile(found, 0.9):.3f}")


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    p = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    p.add_argument("what", choices=["solve", "fit", "sliding"])
    p.add_argument("--rsc", default="./rsc")
    p.add_argument("--out", type=pathlib.Path, default=here / "output" / "resolution")
    p.add_argument("--first", type=int, default=0)
    p.add_argument("--last", type=int, default=240)
    o = p.parse_args()
    o.rsc = os.path.abspath(o.rsc)
    o.out.mkdir(parents=True, exist_ok=True)
    {"solve": solve, "fit": fit, "sliding": sliding}[o.what](o)


if __name__ == "__main__":
    main()
