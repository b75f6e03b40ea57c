"""Boundary elements for a frictionless elastic half-space: the reference rsc is held against.

Square cells of uniform pressure (Love 1929; Johnson 1985, section 3.4), free boundary, so that nothing is periodic: the
convolution runs through Fourier transforms of twice the size (DC-FFT, Liu, Wang and Liu, Wear 243, 2000). The contact condition
p >= 0, gap >= 0, p gap = 0 by constrained conjugate gradients (Polonsky and Keer, Wear 231, 1999) at a given separation.
Only numpy and scipy; one thread.
"""
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
        quadrant = love(h * np.arange(j.max() + 1)[None, :], h * np.arange(i.max() + 1)[:, None], h) / (np.pi * E_star)
        self.kernel = fft.rfft2(quadrant[i][:, j]).real.copy()

    def __call__(self, p):
        ny, nx = self.shape
        t = fft.fft(fft.rfft(p, self.Nx, axis=1), self.Ny, axis=0, overwrite_x=True)  # rows of zeros are not transformed
        t *= self.kernel
        return fft.irfft(fft.ifft(t, axis=0, overwrite_x=True)[:ny], self.Nx, axis=1)[:, :nx]


def solve(operator, overlap, start, tolerance=1e-6, most=1000):
    """Pressures of the minimum of p'Kp/2 - overlap'p over p >= 0 (overlap: penetration without deformation).

    Stops where |p gap| and the penetrations left are below `tolerance` of the scale sum(p overlap). Returns p, iterations, error."""
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
    A - (pi - 1 + ln 2)/24 S_d h (Yastrebov, Anciaux and Molinari, J. Mech. Phys. Solids 107, 2017)."""
    c = np.pad(p > 0, 1)
    edges = np.count_nonzero(c[1:] != c[:-1]) + np.count_nonzero(c[:, 1:] != c[:, :-1])
    A = np.count_nonzero(c) * h * h
    return A, A - (np.pi - 1 + np.log(2)) / 24 * edges * h * h
