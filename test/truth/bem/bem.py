"""Boundary elements for a frictionless elastic half-space, the reference rsc is held against: load and contact area of a sphere on the very
surfaces rsc makes.

    bem.py RSC OUTPUT

RSC is the program, which makes the heights; OUTPUT receives a row a case, grid and level. Every surface is solved on 4096^2 points and on the
grid twice as coarse, whose pressures also give the finer grid its start.

Square cells of uniform pressure (Love 1929; Johnson 1985, section 3.4), free boundary, so that nothing is periodic: the
convolution runs through Fourier transforms of twice the size (DC-FFT, Liu, Wang and Liu, Wear 243, 2000). The contact condition
p >= 0, gap >= 0, p gap = 0 by constrained conjugate gradients (Polonsky and Keer, Wear 231, 1999) at a given separation.
Only numpy and scipy; one thread.
"""
import os
import subprocess
import sys
import tempfile
import time

import netCDF4
import numpy as np
import scipy.fft as fft


def love(x, y, h):
    """Deflection at (x, y) under unit pressure on the square cell |x|, |y| < h/2, times pi E*."""
    a, b, c, d = x + h / 2, x - h / 2, y + h / 2, y - h / 2
    root = np.hypot

    def term(u, v, w):
        return u * np.log((v + root(u, v)) / (w + root(u, w)))

    return term(a, c, d) + term(c, a, b) + term(b, d, c) + term(d, b, a)


class HalfSpace:
    """Deflections of an ny x nx window of cells of side h by pressures on the same cells."""

    def __init__(self, ny, nx, h, E_star):
        self.shape = ny, nx
        self.Ny, self.Nx = fft.next_fast_len(2 * ny), fft.next_fast_len(2 * nx, real=True)
        i, j = np.arange(self.Ny), np.arange(self.Nx)
        i, j = np.minimum(i, self.Ny - i), np.minimum(j, self.Nx - j)
        # The kernel is even: one quadrant is computed, the others are mirrors.
        quadrant = love(
            h * np.arange(j.max() + 1)[None, :], h * np.arange(i.max() + 1)[:, None], h
        ) / (np.pi * E_star)
        self.kernel = fft.rfft2(quadrant[i][:, j]).real.copy()

    def __call__(self, p):
        ny, nx = self.shape
        t = fft.fft(
            fft.rfft(p, self.Nx, axis=1), self.Ny, axis=0, overwrite_x=True
        )  # rows of zeros are not transformed
        t *= self.kernel
        return fft.irfft(fft.ifft(t, axis=0, overwrite_x=True)[:ny], self.Nx, axis=1)[:, :nx]


def solve(operator, overlap, start, tolerance=1e-6, most=1000):
    """Pressures of the minimum of p'Kp/2 - overlap'p over p >= 0 (overlap: penetration without deformation).

    Stops where |p gap| and the penetrations left are below `tolerance` of the scale sum(p overlap). Returns p, iterations, error.
    """
    p = np.where(overlap > 0, np.maximum(start, 0.0), 0.0)
    if not p.any():
        p = np.where(overlap > 0, overlap, 0.0)
        image = operator(p)
        p *= np.sum(p * overlap) / np.sum(p * image)
    direction, last, conjugate = np.zeros_like(p), 1.0, False
    gap = operator(p) - overlap
    for iteration in range(1, most + 1):
        inside = p > 0
        g = np.where(inside, gap, 0.0)
        norm = np.sum(g * g)
        direction = np.where(inside, g + (norm / last if conjugate else 0.0) * direction, 0.0)
        last = norm
        image = operator(direction)
        tau = np.sum(g * direction) / np.sum(direction * image)
        moved = p - tau * direction
        new = np.maximum(moved, 0.0)
        enter = (new == 0) & (gap < 0) & (overlap > 0)
        new[enter] = -tau * gap[enter]
        conjugate = not enter.any()
        if np.array_equal(new, moved):
            gap = gap - tau * image
        else:
            gap = operator(new) - overlap
        p = new
        # Complementarity: penetrations left and gaps under pressure, in the mean, over the mean overlap of the contact.
        bad = np.where(p > 0, np.abs(gap), np.maximum(-gap, 0.0))
        scale = np.sum(p * overlap) / np.sum(p)
        error = np.sqrt(np.sum(bad * bad) / max(1, np.count_nonzero(p))) / scale
        if error < tolerance:
            break
    return p, iteration, error


def areas(p, h):
    """Area of the cells under pressure, and the same corrected by their perimeter S_d (edges between cells with and without):
    A - (pi - 1 + ln 2)/24 S_d h (Yastrebov, Anciaux and Molinari, J. Mech. Phys. Solids 107, 2017).
    """
    c = np.pad(p > 0, 1)
    edges = np.count_nonzero(c[1:] != c[:-1]) + np.count_nonzero(c[:, 1:] != c[:, :-1])
    A = np.count_nonzero(c) * h * h
    return A, A - (np.pi - 1 + np.log(2)) / 24 * edges * h * h


LEVELS = 3.0, 2.5, 2.0, 1.5, 1.0  # Z0/sigma
SIGMA, R, L = 0.01, 2.5, 1.0


def heights(rsc, folder, ratio, seed, n):
    """The height map and E* of the paper's gold surface with L/lambda_s = ratio."""
    file = os.path.join(folder, f"heights_{ratio}_{seed}_{n}.nc")
    settings = [
        f"run%seed={seed}",
        f"surface%n={n}",
        f"surface%L_lambda_s={ratio}",
        "indentation%steps=1",
        f"output%file='{file}'",
        "output%heights=.true.",
        "output%contacts='none'",
        "output%compression=0",
        "run%threads=1",
    ]
    subprocess.run(
        [rsc, "-q", *(word for s in settings for word in ("-s", s))],
        input="&run /\n",
        text=True,
        check=True,
        stdout=subprocess.DEVNULL,
    )
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
    under = z - (x[None, :] ** 2 + x[:, None] ** 2) / (
        R + np.sqrt(R * R - x[None, :] ** 2 - x[:, None] ** 2)
    )
    answers, last = [], np.zeros((n, n), np.float32)
    for k, level in enumerate(LEVELS):
        began = time.process_time()
        rows, columns = (np.flatnonzero((under > level * SIGMA).any(axis=a)) for a in (1, 0))
        window = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        overlap = under[window] - level * SIGMA
        start = last if coarse is None else np.repeat(np.repeat(coarse[k], 2, axis=0), 2, axis=1)
        p, iterations, error = solve(
            HalfSpace(*overlap.shape, h, E_star), overlap, start[window].astype(float), 1e-6
        )
        whole = np.zeros((n, n), np.float32)
        whole[window] = p
        last = whole
        answers.append(whole)
        report(
            n,
            level,
            p.sum() * h * h,
            *areas(p, h),
            iterations,
            error,
            time.process_time() - began,
            p.shape,
        )
    return answers


def main():
    with open(sys.argv[2], "a") as out, tempfile.TemporaryDirectory() as folder:
        for ratio, seed in ((64, 1), (64, 2), (128, 1), (128, 2)):

            def report(n, level, N, A, corrected, iterations, error, seconds, shape):
                line = f"{ratio:4d} {seed:4d} {level:4.1f} {n:6d} {N:14.8e} {A:14.8e} {corrected:14.8e} {seconds:7.1f}"
                print(
                    line,
                    f"  {iterations} iterations, error {error:.0e}, window {shape}",
                    flush=True,
                )
                print(line, file=out, flush=True)

            coarse = None
            for n in (2048, 4096):
                z, E_star = heights(sys.argv[1], folder, ratio, seed, n)
                coarse = indent(z, E_star, coarse, report)


if __name__ == "__main__":
    main()
