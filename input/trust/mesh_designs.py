#!/usr/bin/env python3
"""Makes the table kDesigns of src/interaction/mesh_far.cpp.

    mesh_designs.py            for each row of the table: its error, and that of the best parameters
    mesh_designs.py WIDTH CUTOFF    the best shape and beta of one width and cutoff

The far part of 1/d is summed over random points on a mesh, as mesh_far.cpp does, and compared with
its direct sum. The error is that of the sum of both parts, relative to the sums of 1/d (2-norm), of
1600 points on 40 x 40 mesh spacings: the larger one of forces of random sign and of one sign. shape
and beta minimise it (Nelder and Mead). Needs numpy and scipy."""
import os
import re
import sys

import numpy as np
from scipy import optimize
from scipy.special import i0e

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.join(HERE, "..", "..", "src", "interaction", "mesh_far.cpp")
SIDE, POINTS, TARGETS = 40, 1600, 200
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def bell(beta, t):
    """The bell of Kaiser and Bessel over its value at 0."""
    root = np.sqrt(np.maximum(0, 1 - t * t))
    return i0e(beta * root) / i0e(beta) * np.exp(beta * (root - 1))


def far_part(beta, cutoff):
    """F as a function of the squared distance."""
    t = (NODES + 1) / 2
    half = WEIGHTS / 2
    whole = half @ bell(beta, t)
    fit = np.polynomial.chebyshev.Chebyshev.interpolate(
        lambda s: (half @ bell(beta, t[:, None] * np.sqrt(s)[None, :])) / whole, 44, domain=[0, 1]
    )

    def far(square):
        share = square / cutoff**2
        beyond = cutoff / np.sqrt(np.maximum(square, 1))
        return np.where(share < 1, fit(np.minimum(share, 1)), beyond)

    return lambda square: far(square) / cutoff


def smooth_square(x, period, bend, beta):
    """x^2 up to period/2 - bend, then bent smoothly to its image."""
    x = np.abs(x - period * np.round(x / period))
    from_ = (x - period / 2) / bend
    t = (from_[:, None] + 1) / 2 * (NODES + 1)[None, :] - 1
    whole = WEIGHTS @ bell(beta, NODES)
    ramp = ((bell(beta, t) * (from_[:, None] - t)) @ WEIGHTS) * (from_ + 1) / 2 / whole
    return x * x - np.where(from_ > -1, 2 * period * bend * ramp, 0)


def transform(k, width, shape):
    z = shape**2 - (width * k / 2) ** 2
    root = np.sqrt(np.abs(z)) + 1e-300
    # exp(shape) is scaled away, here and in i0e
    rising = (np.exp(root - shape) - np.exp(-root - shape)) / 2
    value = np.where(z > 0, rising, np.exp(-shape) * np.sin(root))
    return width * value / root / i0e(shape)


def error(width, cutoff, shape, beta, seed=1):
    random = np.random.default_rng(seed)
    place = random.uniform(0, SIDE, (POINTS, 2))
    period = 2 * int(np.ceil((2 * SIDE + 4 * cutoff + 2) / 2))
    far = far_part(beta, cutoff)
    x2 = smooth_square(np.arange(period, dtype=float), period, period / 2 - SIDE, beta)
    k = 2 * np.pi * np.fft.fftfreq(period)
    own = transform(k, width, shape)
    aliases = sum(transform(k + 2 * np.pi * m, width, shape) ** 2 for m in range(-2, 3))
    factor = (own / aliases) ** 2
    modes = np.fft.fft2(far(x2[:, None] + x2[None, :])).real * factor[:, None] * factor[None, :]
    first = np.ceil(place - width / 2).astype(int)
    offset = first[:, :, None] + np.arange(width)
    weight = bell(shape, (offset - place[:, :, None]) / (width / 2))
    cells = (offset[:, 0, :, None] % period) * period + offset[:, 1, None, :] % period
    cells = cells.reshape(POINTS, -1)
    weights = (weight[:, 0, :, None] * weight[:, 1, None, :]).reshape(POINTS, -1)
    d2 = ((place[:TARGETS, None, :] - place[None, :, :]) ** 2).sum(axis=2)
    with np.errstate(divide="ignore"):
        whole = np.where(d2 > 0, 1 / np.sqrt(d2), 0)
    direct = far(d2)
    worst = 0
    for force in (random.uniform(-1, 1, POINTS), random.uniform(0, 1, POINTS)):
        mesh = np.bincount(cells.ravel(), (weights * force[:, None]).ravel(), period * period)
        mesh = np.fft.ifft2(np.fft.fft2(mesh.reshape(period, period)) * modes).real
        potential = (mesh.ravel()[cells[:TARGETS]] * weights[:TARGETS]).sum(axis=1)
        worst = max(
            worst, np.linalg.norm(potential - direct @ force) / np.linalg.norm(whole @ force)
        )
    return worst


def best(width, cutoff, start):
    result = optimize.minimize(
        lambda p: np.log(error(width, cutoff, *p)), start, method="Nelder-Mead",
        options={"xatol": 0.02, "fatol": 0.01, "maxfev": 120},
    )
    return result.x, np.exp(result.fun)


def main():
    if len(sys.argv) == 3:
        width, cutoff = int(sys.argv[1]), float(sys.argv[2])
        (shape, beta), least = best(width, cutoff, (2.2 * width, 2.6 * cutoff))
        return print(f"{{{least:.1e}, {width}, {cutoff}, {shape:.2f}, {beta:.2f}}}")
    with open(SOURCE, encoding="utf-8") as file:
        rows = re.findall(r"\{(\d\.\de-\d+), (\d+), ([\d.]+), ([\d.]+), ([\d.]+)\}", file.read())
    for row in rows:
        stated, width, cutoff, shape, beta = (float(word) for word in row)
        here = error(int(width), cutoff, shape, beta)
        (s, b), least = best(int(width), cutoff, (shape, beta))
        print(
            f"width {int(width):2d}, cutoff {cutoff}: stated {stated:.1e}, found {here:.1e}; "
            f"best {least:.1e} at {s:.2f}, {b:.2f} (table {shape}, {beta})",
            flush=True,
        )


if __name__ == "__main__":
    main()
