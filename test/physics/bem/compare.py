#!/usr/bin/env python3
"""Boundary elements on the very surfaces rsc makes: load and contact area of a sphere at given separations.

    compare.py RSC OUTPUT [--cases 64:1,128:1] [--finest 4096,4096] [--work DIR]

RSC is the program, which makes the heights; OUTPUT receives a row a case, grid and level. Every surface is solved on the grid
`finest` (per L/lambda_s) and on the one twice as coarse, where the pressures also give the finer grid its start.
"""
import argparse
import os
import subprocess
import tempfile
import time
import netCDF4
import numpy as np
import bem

LEVELS = 3.0, 2.5, 2.0, 1.5, 1.0  # Z0/sigma
SIGMA, R, L = 0.01, 2.5, 1.0


def heights(rsc, folder, ratio, seed, n):
    """The height map and E* of the paper's gold surface with L/lambda_s = ratio."""
    file = os.path.join(folder, f"heights_{ratio}_{seed}_{n}.nc")
    settings = [f"run%seed={seed}", f"surface%n={n}", f"surface%L_lambda_s={ratio}", "indentation%steps=1", f"output%file='{file}'",
                "output%heights=.true.", "output%contacts='none'", "output%compression=0", "run%threads=1"]
    subprocess.run([rsc, "-q", *(word for s in settings for word in ("-s", s))], input="&run /\n", text=True, check=True,
                   stdout=subprocess.DEVNULL)
    with netCDF4.Dataset(file) as d:
        z, E_star = np.array(d["height"][:]), float(d["e_star"][:])
        assert float(d["r_star"][:]) == R and abs(d["height_x"][1] - L / n) < 1e-15
    os.remove(file)
    return z, E_star


def indent(z, E_star, coarse, report):
    """Pressures (with their place in the grid) at every level; `coarse`: those of the grid twice as coarse, or None."""
    n = z.shape[0]
    h = L / n
    x = np.arange(n) * h - L / 2
    under = z - (x[None, :]**2 + x[:, None]**2) / (R + np.sqrt(R * R - x[None, :]**2 - x[:, None]**2))
    answers, last = [], np.zeros((n, n), np.float32)
    for k, level in enumerate(LEVELS):
        began = time.process_time()
        rows, columns = (np.flatnonzero((under > level * SIGMA).any(axis=a)) for a in (1, 0))
        window = np.s_[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]
        overlap = under[window] - level * SIGMA
        start = last if coarse is None else np.repeat(np.repeat(coarse[k], 2, axis=0), 2, axis=1)
        p, iterations, error = bem.solve(bem.HalfSpace(*overlap.shape, h, E_star), overlap, start[window].astype(float), 1e-6)
        whole = np.zeros((n, n), np.float32)
        whole[window] = p
        last = whole
        answers.append(whole)
        report(n, level, p.sum() * h * h, *bem.areas(p, h), iterations, error, time.process_time() - began, p.shape)
    return answers


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("rsc")
    parser.add_argument("output")
    parser.add_argument("--cases", default="64:1,128:1")
    parser.add_argument("--finest", default="4096,4096", help="grid for L/lambda_s = 64, 128")
    parser.add_argument("--work")
    options = parser.parse_args()
    finest = dict(zip((64, 128), map(int, options.finest.split(","))))
    with open(options.output, "a") as out, tempfile.TemporaryDirectory(dir=options.work) as folder:
        for case in options.cases.split(","):
            ratio, seed = map(int, case.split(":"))

            def report(n, level, N, A, corrected, iterations, error, seconds, shape):
                line = f"{ratio:4d} {seed:4d} {level:4.1f} {n:6d} {N:14.8e} {A:14.8e} {corrected:14.8e} {seconds:7.1f}"
                print(line, f"  {iterations} iterations, error {error:.0e}, window {shape}", flush=True)
                print(line, file=out, flush=True)

            coarse = None
            for n in (finest[ratio] // 2, finest[ratio]):
                z, E_star = heights(options.rsc, folder, ratio, seed, n)
                coarse = indent(z, E_star, coarse, report)


if __name__ == "__main__":
    main()
