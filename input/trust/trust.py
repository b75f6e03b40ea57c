#!/usr/bin/env python3
"""Measures how far asperities are from elements, and fits the bounds that rsc prints as N = 1.23 +- 5 %.

    python3 input/trust/trust.py elements    solves surfaces by elements on two grids: what asperities are measured by (slow; may be stopped
                                             and called again, finished surfaces are kept)
    python3 input/trust/trust.py asperities  solves the same levels by the three laws (likewise)
    python3 input/trust/trust.py fit         fits the bounds to the first of the surfaces, tells how often they hold on the others, group by
                                             group, and writes src/contact/expected_error_table.hpp

Options: --rsc ./rsc  the program;  --out DIR  where results are kept (output/trust);  --surfaces N  how many (500; 540 with the broad spectra);  --first K.
Needs numpy, scipy and netCDF4. All surfaces are drawn here from their number, so that a study is the same wherever it runs.

A surface has three levels. Synthetic ones are made by rsc itself; the others are height maps made here on a grid twice as fine as the map
that asperities are found on, and elements are solved on both. Levels at which N of elements changes by more than
4 % from one grid to the other are left out, as are those with contacts cut by the border.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

LAWS = ("hertz", "elliptic", "fourth_order")
CALIBRATED = 300          # the first so many surfaces are fitted, the others held out
RICH, RICH_FITTED = 500, 530  # from this number on surfaces with broad spectra, pressed as the paper does; fitted up to the second
RESOLVED = 0.02   # change of N with the grid of elements
FITTED_SHARE = 0.94       # of the levels fitted that keep the bound, so that nine of ten of the others do
E_STAR = 1.0e5


def band_noise(rng, n, longest, shortest, hurst, aspect=1.0, angle=0.0, plateau=False):
    """A Gaussian field of rms 1 on n x n points of a unit square with waves from L/longest to L/shortest, stretched along `angle`."""
    k = np.fft.fftfreq(n) * n
    kx, ky = np.meshgrid(k, k)
    u, v = kx * math.cos(angle) + ky * math.sin(angle), ky * math.cos(angle) - kx * math.sin(angle)
    q = np.hypot(u * math.sqrt(aspect), v / math.sqrt(aspect))
    amplitude = np.zeros_like(q)
    inside = (q >= longest * (1 - 1e-9)) & (q <= shortest)
    amplitude[inside] = q[inside] ** -(1 + hurst)
    if plateau:
        amplitude[(q > 0) & (q < longest)] = longest ** -(1 + hurst)
    # The same modes whatever n is: noise is drawn on a grid of its own.
    m = int(2 * shortest * math.sqrt(aspect)) + 4
    noise = rng.standard_normal((2, m, m))
    full = np.zeros((n, n), complex)
    h = min(m // 2, n // 2) - 1
    index = np.arange(-h, h + 1)
    full[np.ix_(index % n, index % n)] = (noise[0] + 1j * noise[1])[np.ix_(index % m, index % m)]
    z = np.fft.ifft2(full * amplitude).real
    z -= z.mean()
    return z / z.std()


def draw(number):
    """What surface `number` is: group, keys of the case, and for maps how they are made."""
    rng = np.random.default_rng([20260, number])
    kind = rng.choice(["isotropic", "anisotropic", "skewed", "stepped", "pitted", "flats"], p=[0.46, 0.18, 0.11, 0.07, 0.07, 0.11])
    shortest = int(rng.choice([12, 16, 24, 32, 48], p=[0.2, 0.3, 0.3, 0.15, 0.05]))
    if kind not in ("isotropic", "flats"):
        shortest = min(shortest, 16 if kind == "anisotropic" else 24)
    longest = float(rng.choice([1, 2, 4, 8, 16]))
    while longest > shortest / 3:
        longest /= 2
    s = {"group": str(kind), "seed": int(rng.integers(1, 10**6)), "shortest": shortest, "longest": longest,
         "hurst": round(float(rng.uniform(0.2, 1.0)), 3), "plateau": bool(rng.random() < 0.3),
         "sigma": float(10 ** rng.uniform(-6, -2)), "R": float(10 ** rng.uniform(-1, 2)), "points": float(rng.choice([4, 5, 6, 8]))}
    if number >= RICH:
        kind = "rich"
        s.update(group="rich", shortest=int(rng.choice([96, 128])), longest=float(rng.choice([2, 4, 8, 16])), hurst=round(float(rng.uniform(0.5, 1.0)), 3),
                 sigma=float(10 ** rng.uniform(-2.7, -1.7)), R=float(rng.uniform(1, 5)), points=float(rng.choice([4, 6])))
    levels = [2.5, 1.5, 0.5] if rng.random() < 0.7 else [1.5, 0.5, -0.5]
    if kind == "flats":
        levels = [2.5, 1.8, 1.2]
    # Users press: the smooth sphere's contact radius, over L, to which the separation is lowered.
    pressed = float(10 ** rng.uniform(-2, math.log10(0.2))) if rng.random() < 0.5 and kind not in ("flats", "rich") else 0.0
    s["levels"] = [c * s["sigma"] - (pressed * (0.6, 0.8, 1.0)[i]) ** 2 / s["R"] for i, c in enumerate(levels)]
    # rms slope of the band, roughly, to scale the hardness by
    if rng.random() < 0.2 and kind != "rich":
        s["hardness"] = float(10 ** rng.uniform(-1, 0))
    s["aspect"], s["angle"] = 1.0, 0.0
    if kind == "anisotropic":
        s["aspect"], s["angle"] = float(10 ** rng.uniform(0.2, 0.9)), float(rng.choice([0, math.pi / 2, rng.uniform(0, math.pi)]))
        s["longest"] = max(s["longest"], 2.0 * math.sqrt(s["aspect"])) if s["shortest"] > 8 * math.sqrt(s["aspect"]) else s["longest"]
    return s


def height_map(s, fine):
    """The heights of a surface that is made here, on fine x (points a wave) x shortest points a side."""
    rng = np.random.default_rng(s["seed"])
    n = int(round(s["points"] * s["shortest"] * math.sqrt(s["aspect"]) / 2)) * 2 * fine
    z = band_noise(rng, n, s["longest"], s["shortest"], s["hurst"], s["aspect"], s["angle"], s["plateau"])
    x = np.arange(n) / n
    if s["group"] == "skewed":
        tail = (0.25, -0.25, 0.5, -0.5)[s["seed"] % 4]  # log-normal, one way or the other
        z = (np.exp(tail * z) - 1) / tail
    if s["group"] == "stepped":
        for place in rng.uniform(0.2, 0.8, 2):
            z = z + 2 * np.tanh((x[None, :] - place) * s["shortest"] * 2)
    if s["group"] == "pitted":
        coarse = n // fine
        for i, j in zip(rng.integers(0, coarse, 20), rng.integers(0, coarse, 20)):
            z[j * fine:(j + 1) * fine, i * fine:(i + 1) * fine] -= 10
    z = z - z.mean()
    return z / z.std() * s["sigma"]


def write_map(path, z, L=1.0):
    import netCDF4
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_DATA") as f:
        f.createDimension("y", z.shape[0]), f.createDimension("x", z.shape[1])
        for axis in "xy":
            v = f.createVariable(axis, "f8", (axis,))
            v.units = "mm"
            v[:] = np.arange(z.shape[0]) / z.shape[0] * L
        v = f.createVariable("height", "f8", ("y", "x"))
        v.units = "mm"
        v[:] = z


def case_text(s, folder, model, law, extra):
    flats = s["group"] == "flats"
    text = f"&run threads=1 /\n&solids E={E_STAR!r}, Infinity nu=0, 0 R=Infinity, {'Infinity' if flats else repr(s['R'])}"
    if "hardness_value" in s:
        text += f" hardness={s['hardness_value']!r}"
    text += f" /\n&indentation unit='length' levels={', '.join(repr(z) for z in s['levels'])} centre=0.5, 0.5"
    text += " boundary='periodic' /\n" if flats else " /\n"
    text += f"&solver model='{model}' /\n&asperities law='{law}' /\n&output file='{folder}/result.nc' map_cells=4 radial_bins=2 pdf_levels=2 compression=0 /\n"
    return text + extra


def run(rsc, text, folder):
    """The variables of the result, or None where the case is refused or fails."""
    import netCDF4
    path = os.path.join(folder, "result.nc")
    if os.path.exists(path):
        os.remove(path)
    done = subprocess.run([rsc, "-q", "--progress", "never"], input=text, text=True, capture_output=True)
    if not os.path.exists(path):
        return None if done.returncode == 2 else {"failed": done.stderr[-300:]}
    with netCDF4.Dataset(path) as f:
        f.set_auto_mask(False)
        return {name: f[name][...] for name in f.variables}


def surface_keys(s, points_per_wave=None, n=None):
    text = (f"&surface source='synthetic' L=1 n={n or int(math.ceil(s['points'] * s['shortest'] / 2)) * 2} hurst={s['hurst']!r} L_lambda_l={s['longest']!r} "
            f"L_lambda_s={s['shortest']} sigma={s['sigma']!r} plateau={'.true.' if s['plateau'] else '.false.'} /\n")
    return text + (f"&elements points_per_wave={points_per_wave} /\n" if points_per_wave else "")


def made_by_rsc(s):
    return s["group"] in ("isotropic", "flats", "rich")


def rms_slope(s):
    """Of the band in expectation, for the hardness: any scale would do, as long as both models have the same."""
    q = np.arange(max(1, round(s["longest"])), s["shortest"] + 1)
    psd = q ** (-2 * (1 + s["hurst"]))
    return s["sigma"] * math.sqrt(np.sum(q**3 * psd) / np.sum(q * psd)) * 2 * math.pi


def prepared(number):
    s = draw(number)
    if "hardness" in s:
        s["hardness_value"] = s["hardness"] * E_STAR * rms_slope(s)
    return s


def solve_elements(rsc, number, folder):
    s = prepared(number)
    answers = []
    for grid in (0, 1):  # coarse, fine
        if made_by_rsc(s):
            text = f"&run seed={s['seed']} threads=1 /\n" + case_text(s, folder, "elements", "hertz", surface_keys(s, (4.5, 9)[grid])).replace("&run threads=1 /\n", "")
        else:
            z = height_map(s, 2)
            path = os.path.join(folder, "map.nc")
            write_map(path, z[::2, ::2] if grid == 0 else z)
            text = case_text(s, folder, "elements", "hertz", f"&surface source='heights' file='{path}' detrend='none' sigma={s['sigma']!r} /\n")
        answers.append(run(rsc, text, folder))
        if answers[-1] is None or "failed" in answers[-1]:
            return {"number": number, "group": s["group"], "refused": True, "why": None if answers[-1] is None else answers[-1]["failed"]}
    coarse, fine = answers
    take = lambda a, name: [float(v) for v in np.ravel(a[name])]
    return {"number": number, "group": s["group"], "N": take(fine, "force"), "A": take(fine, "contact_area"), "N_coarse": take(coarse, "force"),
            "A_coarse": take(coarse, "contact_area"), "status": take(fine, "status"), "edge": take(fine, "edge_contacts"), "contacts": take(fine, "contacts")}


PREDICTORS = ("slope", "pressed", "overlap", "elongation", "crowding", "few", "coarse", "plastic", "flats")


def predictors(s, r, level):
    """The numbers a bound is made of, all known where asperities are solved (src/contact/expected_error.cpp)."""
    start, count = int(np.ravel(r["contact_start"])[level]) - 1, int(np.ravel(r["contact_count"])[level])
    if count == 0:
        return None
    which = np.ravel(r["contact_asperity"])[start:start + count].astype(int) - 1
    f, a = np.ravel(r["contact_force"])[start:start + count], np.ravel(r["contact_radius"])[start:start + count]
    share = f / f.sum()
    slope = float(np.ravel(r["slope_ratio"])[level]) if "slope_ratio" in r else None
    if slope is None:
        x, y = np.ravel(r["asperity_x"])[which] - 0.5, np.ravel(r["asperity_y"])[which] - 0.5
        rho = np.hypot(x, y).max()
        slope = 0.0 if s["group"] == "flats" else rho / math.sqrt(max(s["R"] ** 2 - rho**2, 1e-30)) / float(np.ravel(r["rms_slope"])[0])
    kappa1, kappa2 = np.ravel(r["asperity_kappa1"])[which], np.ravel(r["asperity_kappa2"])[which]
    ratio = kappa1 / kappa2
    biharmonic = np.ravel(r["asperity_biharmonic"])[which] if "asperity_biharmonic" in r else np.zeros(count)
    spacing = spacing_of(s, r)
    points = points_of(s, r)
    at = lambda name: float(np.ravel(r[name])[level])
    return {"slope": math.log1p(min(slope / 0.2, 50.0) ** 2), "pressed": float(np.sum(share * np.clip(biharmonic / (kappa1 + kappa2) * (a / math.pi) ** 2, 0, 1))), "overlap": math.log1p(at("overlapping_pairs") / count),
            "elongation": float(np.sum(share * np.log(np.minimum(ratio, 1e3)))), "crowding": math.log(max(float(np.sum(share * a)) / spacing, 1e-3)),
            "few": 1 / math.sqrt(count), "coarse": min(4 / points, 1.5) if points > 0 else 1.0,
            "plastic": at("plastic_contacts") / count if "plastic_contacts" in r else 0.0, "flats": 1.0 if s["group"] == "flats" else 0.0}


def spacing_of(s, r):
    if "density_theory" in r and made_by_rsc(s):
        return 1 / math.sqrt(float(r["density_theory"]))
    return 1 / math.sqrt(len(np.ravel(r["asperity_x"])))


def points_of(s, r):
    if made_by_rsc(s):
        return int(math.ceil(s["points"] * s["shortest"] / 2)) * 2 / s["shortest"]
    return float(r["points_per_wave"])


def solve_asperities(rsc, number, folder):
    s = prepared(number)
    out = {"number": number, "group": s["group"], "laws": {}}
    if made_by_rsc(s):
        keys = surface_keys(s)
    else:
        path = os.path.join(folder, "map.nc")
        write_map(path, height_map(s, 2)[::2, ::2])
        keys = f"&surface source='heights' file='{path}' detrend='none' sigma={s['sigma']!r} /\n"
    for law in LAWS:
        text = case_text(s, folder, "asperities", law, keys)
        if made_by_rsc(s):
            text = text.replace("&run threads=1 /", f"&run seed={s['seed']} threads=1 /")
        r = run(rsc, text, folder)
        if r is None or "failed" in r:
            continue
        take = lambda name: [float(v) for v in np.ravel(r[name])]
        out["laws"][law] = {"N": take("force"), "A": take("contact_area"), "status": take("status"), "edge": take("edge_contacts"),
                            "told": take("force_error_expected") if "force_error_expected" in r else None,
                            "x": [predictors(s, r, k) for k in range(len(s["levels"]))]}
    return out


def study(rsc, out, what, numbers):
    """Appends a line of JSON for each surface that has none yet."""
    path = out / f"{what}.jsonl"
    done = {json.loads(line)["number"] for line in path.read_text().splitlines()} if path.exists() else set()
    solve = solve_elements if what == "elements" else solve_asperities
    if what == "asperities":  # where elements have something to say
        numbers = [number for number, e in read(out, "elements").items() if number in numbers and any(usable(e, k) for k in range(3))]
    with tempfile.TemporaryDirectory() as folder, open(path, "a") as file:
        for number in numbers:
            if number in done:
                continue
            file.write(json.dumps(solve(rsc, number, folder)) + "\n")
            file.flush()


def read(out, what):
    return {r["number"]: r for r in map(json.loads, (out / f"{what}.jsonl").read_text().splitlines())}


def usable(e, k):
    """Whether elements carry load at level k, resolved and away from the border."""
    return not e.get("refused") and e["N"][k] > 0 and abs(e["N_coarse"][k] / e["N"][k] - 1) <= 2 * RESOLVED and e["edge"][k] == 0 and e["status"][k] != 4


def rows(elements, asperities, law):
    """A row a level: surface, group, predictors, errors of N and A, whether it touches."""
    found = []
    for number, e in sorted(elements.items()):
        if e.get("refused") or number not in asperities or law not in asperities[number]["laws"]:
            continue
        a = asperities[number]["laws"][law]
        for k in range(len(e["N"])):
            if not usable(e, k) or a["status"][k] == 4:
                continue
            found.append({"number": number, "group": e["group"], "x": a["x"][k], "N": a["N"][k] / e["N"][k] - 1, "A": a["A"][k] / e["A"][k] - 1,
                          "status": a["status"][k], "resolution": abs(e["N_coarse"][k] / e["N"][k] - 1) / 2})
    return found


LEAST, MOST = 0.003, 1000.0


def quantile_fit(X, y, share):
    """Coefficients b that make X b the share-quantile of y (Koenker and Bassett 1978), by linear programming; of predictors that can only
    harm, not below 0."""
    from scipy.optimize import linprog
    n, p = X.shape
    c = np.concatenate([np.zeros(p), share * np.ones(n), (1 - share) * np.ones(n)])
    A = np.hstack([X, np.eye(n), -np.eye(n)])
    signed = {"crowding"}
    bounds = [(None, None)] + [(None, None) if name in signed else (0, None) for name in PREDICTORS] + [(0, None)] * (2 * n)
    return linprog(c, A_eq=A, b_eq=y, bounds=bounds, method="highs").x[:p]


def matrix(found):
    return np.array([[1.0] + [r["x"][name] for name in PREDICTORS] for r in found])


def fit(out, header):
    elements, asperities = read(out, "elements"), read(out, "asperities")
    table, report = {}, []
    for law in LAWS:
        every = rows(elements, asperities, law)
        touching = [r for r in every if r["x"] is not None]
        calibrated = lambda r: r["number"] < CALIBRATED or RICH <= r["number"] < RICH_FITTED
        fitted = [r for r in touching if calibrated(r)]
        held = [r for r in touching if not calibrated(r)]
        for what in ("N", "A"):
            y = np.log(np.clip([abs(r[what]) for r in fitted], LEAST, MOST))
            b = quantile_fit(matrix(fitted), y, FITTED_SHARE)
            table[law, what] = b
            bound = lambda some: np.clip(np.exp(matrix(some) @ b), LEAST, MOST)
            line = f"{law:13s} {what}: {len(fitted)} levels fitted, {np.mean(np.abs([r[what] for r in fitted]) <= bound(fitted)):.3f} within"
            if held:
                ok = np.abs([r[what] for r in held]) <= bound(held)
                line += f"; held out {len(held)}: {ok.mean():.3f} within; median bound {np.median(bound(held)):.3f}"
                for group in sorted({r["group"] for r in held}):
                    mine = np.array([r["group"] == group for r in held])
                    line += f"; {group} {ok[mine].mean():.2f} of {mine.sum()}"
                sure = bound(held) <= 0.1
                wrong = np.abs([r[what] for r in held]) > 0.1
                line += f"; bound below 10 %: {sure.sum()}, of these beyond 10 %: {(wrong & sure).sum()}"
            report.append(line)
        missed = [r for r in every if r["x"] is None]
        report.append(f"{law:13s} nothing touches where elements carry load: {len(missed)} of {len(every)} levels")
    print("\n".join(report))
    (out / "report.txt").write_text("\n".join(report) + "\n")
    lines = ["// Written by input/trust/trust.py from its study of asperities against elements; do not edit.", "#pragma once", "",
             "namespace rsc {", "",
             f"// ln of the bound = sum of coefficient times predictor, the first one 1: {', '.join(PREDICTORS)}.",
             f"inline constexpr int kErrorPredictors = {len(PREDICTORS)};",
             f"inline constexpr double kLeastError = {LEAST}, kMostError = {MOST};",
             "inline constexpr double kErrorTable[3][2][kErrorPredictors + 1] = {", "    // hertz, elliptic, fourth_order; N, A"]
    for law in LAWS:
        lines.append("    {" + ", ".join("{" + ", ".join(f"{v:.4g}" for v in table[law, what]) + "}" for what in ("N", "A")) + "},")
    lines += ["};", "", "}  // namespace rsc", ""]
    pathlib.Path(header).write_text("\n".join(lines))


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("what", choices=["elements", "asperities", "fit"])
    p.add_argument("--rsc", default="./rsc")
    p.add_argument("--out", type=pathlib.Path, default=here / "output" / "trust")
    p.add_argument("--surfaces", type=int, default=500)
    p.add_argument("--first", type=int, default=0)
    p.add_argument("--table", default=here / "src" / "contact" / "expected_error_table.hpp")
    o = p.parse_args()
    o.out.mkdir(parents=True, exist_ok=True)
    if o.what == "fit":
        fit(o.out, o.table)
    else:
        study(os.path.abspath(o.rsc), o.out, o.what, range(o.first, o.surfaces))


if __name__ == "__main__":
    main()
