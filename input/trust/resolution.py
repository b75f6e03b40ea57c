#!/usr/bin/env python3
"""Calibrates the expected errors of boundary elements: writes
src/trust/grid_error_table.hpp and src/physics/stress/stress_error_table.hpp.

    resolution.py solve [--first K] [--last K]    solves bodies on their grid and on one four times
                                                  finer (slow; finished bodies are skipped)
    resolution.py again [--first K] [--last K]    solves them again on their own grid only
    resolution.py border                          area of pixels, by Hertz's closed form
    resolution.py fit                             the constants, from every second body below 1000;
                                                  what they give for the others; writes the table
    resolution.py check                           what rsc stated for bodies from 1000 on
    resolution.py sliding                         tension behind a sliding ball, by Hamilton's
                                                  closed form

Options: --rsc ./rsc the program; --out DIR folder of the results (output/resolution).

The error of a quantity is taken as the root of the sum of two squares: of k b^p n^-q, b being
border_share (the sides of pixels on borders of contacts over the pixels in contact) and n the
number of contacts, and of c border_runs, the part by the straight parts of these borders, each of
which is known to half a pixel. The powers, the ratio of c to k and the factor of measured heights
are those of a grid of values for which the median of stated over true error is smallest, where k is
such that ALL levels and EACH kind are within; punches and cones, and yielding contacts, have a
factor each, which is 0 where they have no error (the largest pressure of a yielding contact is the
hardness). Near full contact of two flats, border_share is that of the gaps, and the error of an
area is taken relative to theirs. Bodies are determined by their
number: rough balls, flats and rollers, smooth bodies, maps of few points a wave (free and flat),
maps as instruments give them (means over cells, rounded), yielding and worn bodies, and punches; a
third has other units, and maps have even and odd numbers of points. Needs numpy and netCDF4."""
import argparse
import itertools
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

KINDS = (
    *("ball", "flat", "line", "smooth", "map", "hard", "mapflat", "edge", "instrument", "worn"),
)
NOT_FITTED = ("worn",)
E, NU = 1.0e5, 0.3
E_STAR = E / (2 * (1 - NU**2))
FINER = 4
BLIND = 1000  # bodies from here on take no part in the fit
# variable, and the others that have its error
QUANTITIES = {
    "force": (),  # or the separation, times the stiffness over N
    "contact_area": ("area_fraction",),
    "contact_area_pixels": (),
    "stiffness": ("conductance_length", "conductance_per_area", "resistance"),
    "energy": (),
    "pressure_max": ("wear_depth_max",),  # the depth is the integral of the pressure of a point
    "gap_mean": (),
}
AREAS = "contact_area", "contact_area_pixels"
CHECKED = (*QUANTITIES, "permeability", "wear_depth_max")
GRID = 1 << 2  # bit of the doubt


def draw(number):
    rng = np.random.default_rng([717, number])
    kind = KINDS[number % len(KINDS)]
    waves = int(rng.choice([6, 8, 12] if kind == "worn" else [8, 12, 16, 20, 28]))
    scale = float(rng.choice([1, 1, 1e-3]))
    longest = float(rng.choice([1, 2, 3, 4, 6]))
    while longest > waves / 2.5:
        longest /= 2
    points = float(rng.choice([4, 5, 6, 8, 10, 12]))
    while points * waves > 200:
        points -= 1
    return {
        "kind": kind,
        "scale": scale,
        "turned": bool(number // len(KINDS) % 2),
        "number": number,
        "waves": waves,
        "longest": longest,
        "points": points,
        "map_points": float(rng.choice([2.2, 2.5, 3, 4, 6])),
        "hurst": float(rng.uniform(0.2, 1)),
        "plateau": bool(rng.random() < 0.3),
        "sigma": scale * float(10 ** rng.uniform(-5, -2.5)),
        "R": scale * float(10 ** rng.uniform(-0.3, 2)),
        "aspect": float(rng.choice([1, 1, 1, 2, 5])),
        "direction": float(rng.choice([0, 90, 30, 77])),
        "skewness": float(rng.choice([0, 0, 0, -1, 0.8])),
        "seed": int(rng.integers(1, 10**6)),
        "by_force": bool(rng.random() < 0.6),
        "radii": sorted(scale * float(10 ** rng.uniform(-1.7, -0.7)) for _ in range(3)),
        "pressures": sorted(float(10 ** rng.uniform(-2.5, -0.2)) for _ in range(3)),
        "heights": sorted((float(rng.uniform(-2, 2.2)) for _ in range(3)), reverse=True),
        "n": int(rng.choice([41, 64, 97, 128])),
        "shape": str(rng.choice(["sphere", "paraboloid", "roller", "cone"])),
        "hardness": float(10 ** rng.uniform(-1, 0)),
        "odd": int(rng.integers(0, 2)),
        "wear": float(10 ** rng.uniform(-2, 0.5)),
    }


def rms_slope(b):
    q = np.arange(max(1, round(b["longest"])), b["waves"] + 1)
    psd = q ** (-2 * (1 + b["hurst"]))
    return b["sigma"] / b["scale"] * math.sqrt(np.sum(q**3 * psd) / np.sum(q * psd)) * 2 * math.pi


def heights(b, n):
    """Heights of a map on n x n points, and on FINER times as many."""
    rng = np.random.default_rng(b["seed"])
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
    if b["kind"] != "instrument":
        return z[::FINER, ::FINER], z
    means = z.reshape(n, FINER, n, FINER).mean(axis=(1, 3))
    step = b["sigma"] / 100
    return np.round(means / step) * step, z


def surface_keys(b, grid, folder):
    """The keys of the surface on a grid `grid` times finer, and the side of its pixels."""
    L = b["scale"]
    path = os.path.join(folder, "map.nc")
    if b["kind"] in ("smooth", "edge"):
        n = b["n"] * grid
        write_map(path, np.zeros((n, n)), L)
        sigma = 1e-4 * L
    elif b["kind"] in ("map", "mapflat", "instrument"):
        n = round(b["waves"] * b["map_points"] * math.sqrt(b["aspect"]) / 2) * 2 + b["odd"]
        write_map(path, heights(b, n)[grid > 1], L)
        sigma = b["sigma"]
        n *= grid
    else:
        skewness = f" skewness={b['skewness']}" if b["skewness"] else ""
        return (
            f"&surface L={L!r} sigma={b['sigma']!r} L_lambda_l={b['longest']}"
            f" L_lambda_s={b['waves']} hurst={b['hurst']!r}"
            f" plateau={'T' if b['plateau'] else 'F'} aspect={b['aspect']}"
            f" direction={b['direction']}{skewness} /\n"
            f"&elements points_per_wave={b['points'] * grid!r} /\n",
            L / (b["points"] * grid * b["waves"] * math.sqrt(b["aspect"])),
        )
    return (
        f"&surface source='heights' file='{path}' detrend='none' sigma={sigma!r} /\n",
        L / n,
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
    if kind == "worn":  # by up to a rms height under the pressures of rough spots
        hard = f" wear_coefficient={0.3 * b['wear'] * b['sigma'] / (E_STAR * slope * b['scale'])!r}"
    solids = f"&solids E={E},{E} nu={NU},{NU} R=Infinity,{'Infinity' if flat or line else repr(R)}"
    solids += hard + " /\n"
    distances = f" distances=0,{0.2 * b['scale']!r},{b['scale']!r}" if kind == "worn" else ""
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
    if kind == "worn":
        levels = "control='force' levels=" + joined(
            3 * [4 / 3 * E_STAR * b["radii"][1] ** 3 / R]
        )
    elif b["by_force"] or kind == "edge":
        levels = "control='force' levels=" + joined(
            4 / 3 * E_STAR * a**3 / R for a in b["radii"]
        )
    else:
        levels = "unit='length' levels=" + joined(
            z * rough - d for z, d in zip(b["heights"], approaches)
        )
    return solids + (
        f"&indentation centre={0.4871 * b['scale']!r},{0.5139 * b['scale']!r}"
        f" {levels}{distances} /\n"
    )


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


def case_of(b, grid, folder):
    surface, side = surface_keys(b, grid, folder)
    b.setdefault("side", side)
    unit = b["radii"][0] if b["kind"] in ("smooth", "edge") else 0.4 * b["scale"] / b["waves"]
    b["depths"] = [0.05 * unit, 0.25 * unit, unit]
    flow = b["kind"] in ("flat", "mapflat") and b["scale"] / b["side"] * FINER < 400
    depths = "" if b["kind"] == "worn" else f" stress_depths={','.join(map(repr, b['depths']))}"
    return (
        f"&run threads=1 seed={b['seed']} /\n{surface}{body_keys(b)}"
        "&output contacts='none' map_cells=4"
        f" radial_bins=4{depths}{' flow=T' if flow else ''} /\n"
    )


def solve(o):
    for number in range(o.first, o.last):
        path = o.out / f"{number}.json"
        if path.exists() != (o.what == "again"):
            continue
        b = draw(number)
        with tempfile.TemporaryDirectory() as folder:
            coarse = solved(o.rsc, case_of(b, 1, folder), folder)
            if o.what == "again":
                fine = json.loads(path.read_text())["results"][1]
            else:
                fine = solved(o.rsc, case_of(b, FINER, folder), folder)
        path.write_text(json.dumps({"body": b, "results": [coarse, fine]}))
        print(number, b["kind"], [r.get("failed", "solved") for r in (coarse, fine)], flush=True)


class Row:
    """A level: what its errors are taken to depend on, the true errors by quantity, and those that
    rsc stated."""

    def __init__(self, b, a, t):
        self.kind, self.body, self.level = b["kind"], b, a
        punch = b["kind"] == "edge" and b["shape"] in ("sphere", "cone")
        self.edged = punch or b["kind"] == "smooth" and b["shape"] == "cone"
        self.yields = a.get("plastic_contacts", [0])[0] > 0
        self.share, self.runs, self.contacts = (
            a[name][0] for name in ("border_share", "border_runs", "contacts")
        )
        fraction = a.get("area_fraction", [0])[0]
        self.over_gap = fraction / (1 - fraction) if 0.5 < fraction < 1 else 1
        self.true, self.stated = {}, {}
        for name in CHECKED:
            if name in a and name in t and t[name][0] != 0:
                self.true[name] = abs(a[name][0] / t[name][0] - 1)
                self.stated[name] = a.get(name + "_error_expected", [np.nan])[0]
        self.stated["contact_area"] = a.get("area_error_expected", [np.nan])[0]
        if "permeability" in self.true and t["permeability"][0] > 0 < a["permeability"][0]:
            self.true["permeability"] = abs(math.log(a["permeability"][0] / t["permeability"][0]))
        N, S = a["force"][0], abs(a["stiffness"][0])
        self.by_force = self.true["force"] < 1e-5
        if self.by_force:
            self.true["force"] = abs(a["separation"][0] - t["separation"][0]) * S / N
            self.stated["force"] = a.get("separation_error_expected", [np.nan])[0] * S / N
        else:
            self.stated["force"] = a.get("force_error_expected", [np.nan])[0]
        self.status, self.doubts = int(a["status"][0]), int(a["doubts"][0])
        self.stresses = []
        for c, depth in enumerate(b["depths"] if "mises_max" in a else ()):
            mises = a["mises_max"][c]
            off = [abs(a[what][c] / t[what][c] - 1) for what in ("mises_max", "shear_max")]
            off.append(abs(a["tension_max"][c] - t["tension_max"][c]) / mises)
            self.stresses.append((depth / b["side"], *off))
            for what, error in zip(("mises_max", "shear_max", "tension_max"), off):
                self.true[f"{what} {c}"] = error
                self.stated[f"{what} {c}"] = a[what + "_error_expected"][c] * (
                    abs(a["tension_max"][c]) / mises if what == "tension_max" else 1
                )


def levels_of(out, first, last):
    for path in sorted(out.glob("*.json"), key=lambda p: int(p.stem)):
        study = json.loads(path.read_text())
        b, (coarse, fine) = study["body"], study["results"]
        if not first <= b["number"] < last or "failed" in coarse or "failed" in fine:
            continue
        for k in range(len(coarse["force"])):
            a, t = ({n: v[k] for n, v in r.items() if len(v) > k} for r in (coarse, fine))
            border = a.get("border_share", [np.nan])[0]
            if a["force"][0] > 0 < t["force"][0] and border > 0 and a["status"][0] != 4:
                yield Row(b, a, t)


def shares(within):
    """For all levels and by kind: number, share within, median of stated over true."""
    for kind in ("all", *KINDS):
        mine = [(s, e) for row, s, e in within if kind in ("all", row.kind)]
        if mine:
            s, e = np.array(mine).T
            yield kind, len(mine), 100 * np.mean(e <= s), np.median(s / np.maximum(e, 1e-9))


def report(name, within):
    print(f"{name}")
    for kind, n, share, over in shares(within):
        print(f"    {kind:10s} {n:4d} levels, {share:3.0f} % within, stated over true {over:.1f}")


POWERS = (1.0, 1.5, 2.0)
AVERAGING = (0.0, 0.25, 0.5)
RUNS = (0.0, 0.5, 1.0, 2.0, 4.0)  # c over k
MEASURED = (1.0, 1.5, 2.0, 3.0, 4.0)
DEEPER = (0.5, 0.75, 1.0, 1.5)
READ_KINDS = ("map", "mapflat", "instrument")
# Shares of levels within the stated error, of all and of each kind. More than nine in ten, because
# the levels that are not fitted have somewhat larger errors.
ALL, EACH = 0.93, 0.9


class Levels:
    """What the errors of some levels are taken to depend on."""

    def __init__(self, rows):
        self.kinds = np.array([r.kind for r in rows])
        self.share, self.runs, self.contacts = np.array(
            [(r.share, r.runs, r.contacts) for r in rows]
        ).T
        self.read = np.isin(self.kinds, READ_KINDS)
        self.edged = np.array([r.edged for r in rows])
        self.yields = np.array([r.yields for r in rows])

    def shape(self, power, averaging, runs, read):
        share = self.share**power * self.contacts**-averaging
        return np.hypot(share, runs * self.runs) * np.where(self.read, read, 1)


class Fit:
    """The choice for which the median of stated over true error is smallest, its factor k, and the
    factors of edges and of yielding."""

    def __init__(self, levels, errors, shape, *choices):
        plain = ~levels.edged & ~levels.yields
        kinds = sorted(set(levels.kinds[plain]))
        found = []
        for choice in itertools.product(*choices):
            over = errors / shape(*choice)
            k = max(
                np.quantile(over[plain], ALL),
                *(np.quantile(over[plain & (levels.kinds == kind)], EACH) for kind in kinds),
            )
            found.append((np.median(k / np.maximum(over[plain], 1e-9)), k, choice))
        self.over, self.k, self.choice = min(found)
        over = errors / (self.k * shape(*self.choice))
        self.edged, self.yielding = (
            self.factor(over[some]) for some in (levels.edged, levels.yields)
        )

    @staticmethod
    def factor(over):
        """Of a class of bodies with these errors over those of the others."""
        if over.size == 0:
            return 1.0
        most = np.quantile(over, EACH)
        return max(1.0, most) if most > 1e-6 else 0.0

    def stated(self, levels, shape):
        return (
            self.k
            * shape(*self.choice)
            * np.where(levels.edged, self.edged, 1)
            * np.where(levels.yields, self.yielding, 1)
        )

    def factors(self):
        return braces(self.choice[-1], self.edged, self.yielding)

    def __str__(self):
        return (
            f"k {self.k:.4g}, choice {self.choice}, edges {self.edged:.2g}, yielding"
            f" {self.yielding:.2g}; stated over true {self.over:.1f}; others:"
        )


def halves(rows, known):
    """The levels with an error: those that are fitted, and the others."""
    rows = [r for r in rows if known(r)]
    first = [r for r in rows if r.body["number"] // len(KINDS) % 2 == 0]
    return [r for r in first if r.kind not in NOT_FITTED], [r for r in rows if r not in first]


def braces(*values):
    return "{" + ", ".join(v if isinstance(v, str) else f"{v:.3g}" for v in values) + "}"


def fit(o):
    rows = list(levels_of(o.out, 0, BLIND))
    print(len(rows), "levels")
    lines = ["inline constexpr ResolutionError kResolutionErrors[] = {"]
    for name, others in QUANTITIES.items():
        mine, held = halves(rows, lambda r: np.isfinite(r.true.get(name, np.nan)))
        true = lambda r: r.true[name] * (r.over_gap if name in AREAS else 1)
        errors = np.array([true(r) for r in mine])
        of = Levels(mine)
        found = Fit(of, errors, of.shape, POWERS, AVERAGING, RUNS, MEASURED)
        of = Levels(held)
        report(
            f"{name}: {found}",
            list(zip(held, found.stated(of, of.shape), map(true, held))),
        )
        power, averaging, runs, _ = found.choice
        for each in (name, *others):
            lines.append(
                "    "
                + braces(
                    f'"{each}"',
                    *(found.k, power, averaging, found.k * runs, found.factors()),
                    *(["true"] if name in AREAS else []),
                )
                + ","
            )
    lines.append("};")
    write_table(o.table, "inline constexpr ResolutionError kRes", lines)
    fit_stresses(o, rows)


def fit_stresses(o, rows):
    for what, name in enumerate(("Mises", "Shear", "Tension"), 1):
        mine, held = halves(rows, lambda r: r.stresses)

        def levels(some):
            of = Levels([r for r in some for _ in r.stresses])
            depth = np.array([s[0] for r in some for s in r.stresses])
            return of, lambda power, deeper, read: (
                of.share**power * (1 + 2 * depth) ** -deeper * np.where(of.read, read, 1)
            )

        errors = np.array([s[what] for r in mine for s in r.stresses])
        found = Fit(levels(mine)[0], errors, levels(mine)[1], (0.5, *POWERS), DEEPER, MEASURED)
        report(
            f"{name}: {found}",
            list(
                zip(
                    (r for r in held for _ in r.stresses),
                    found.stated(*levels(held)),
                    (s[what] for r in held for s in r.stresses),
                )
            ),
        )
        start = f"inline constexpr StressError k{name}Error"
        values = braces(found.k, *found.choice[:-1], found.factors())
        write_table(o.stress_table, start, [f"{start} = {values};"])


def write_table(path, start, lines):
    """Replaces a definition of the table."""
    text = path.read_text()
    first = text.index(start)
    end = text.index(";\n", first) + 2
    path.write_text(text[:first] + "\n".join(lines) + "\n" + text[end:])


def check(o):
    rows = list(levels_of(o.out, BLIND, 10**9))
    names = sorted({name for r in rows for name in r.true})
    bodies = {r.body["number"] for r in rows}
    print(f"{len(bodies)} bodies, {len(rows)} levels")
    for name in names:
        report(
            name,
            [
                (r, r.stated[name], r.true[name])
                for r in rows
                if 0 <= r.stated.get(name, np.nan) < 1e30 and np.isfinite(r.true[name])
            ],
        )
    good = [r for r in rows if r.true["force"] <= 0.01 and r.true["contact_area"] <= 0.05]
    marked = sum(bool(r.doubts & GRID) for r in good)
    print(f"N within 1 % and A within 5 %: {len(good)} levels, of these with `grid`: {marked}")
    sure = [r for r in rows if r.status == 0]
    wrong = sum(r.true["force"] > 0.05 for r in sure)
    print(f"status 0: {len(sure)} levels, of these N off by more than 5 %: {wrong}")


def border(o):
    """Pixels in contact of smooth balls beyond Hertz's area, over the sides of their borders."""
    rng = np.random.default_rng(5)
    found = []
    n, R = 96, 10.0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "smooth.nc")
        write_map(path, np.zeros((n, n)))
        for _ in range(40):
            x, y = 0.45 + 0.1 * rng.random(2)
            a = np.sort(10 ** rng.uniform(math.log10(5 / n), math.log10(35 / n), 8))
            forces = ",".join(repr(float(4 / 3 * E_STAR * v**3 / R)) for v in a)
            case = (
                f"&solids E={E},{E} nu={NU},{NU} R=Infinity,{R} /\n"
                f"&surface source='heights' file='{path}' detrend='none' sigma=1e-4 /\n"
                "&indenter shape='paraboloid' /\n"
                f"&indentation control='force' levels={forces} centre={x},{y} /\n"
                "&output contacts='none' /\n"
            )
            r = solved(o.rsc, case, folder)
            for radius, pixels, share in zip(a, r["contact_area_pixels"], r["border_share"]):
                beyond = pixels[0] - math.pi * radius**2
                found.append(beyond / (share[0] * pixels[0]))
    print(f"{np.mean(found):.4f} +- {np.std(found) / math.sqrt(len(found)):.4f} of a pixel a side")


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
    k = np.quantile(found, 0.9)
    print(f"error over the root of border_share: {k:.3f}")
    start = "inline constexpr StressError kSlidingEdgeError"
    write_table(o.stress_table, start, [f"{start} = {braces(k, 0.5, 1.0, braces(1.0, 1.0, 1.0))};"])


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    p = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    p.add_argument("what", choices=["solve", "again", "border", "fit", "check", "sliding"])
    p.add_argument("--rsc", default="./rsc")
    p.add_argument("--out", type=pathlib.Path, default=here / "output" / "resolution")
    p.add_argument("--table", type=pathlib.Path, default=here / "src/trust/grid_error_table.hpp")
    table = here / "src/physics/stress/stress_error_table.hpp"
    p.add_argument("--stress_table", type=pathlib.Path, default=table)
    p.add_argument("--first", type=int, default=0)
    p.add_argument("--last", type=int, default=240)
    o = p.parse_args()
    o.rsc = os.path.abspath(o.rsc)
    o.out.mkdir(parents=True, exist_ok=True)
    what = {"solve": solve, "again": solve, "border": border, "fit": fit, "check": check}
    what.get(o.what, sliding)(o)


if __name__ == "__main__":
    main()
