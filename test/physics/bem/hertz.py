#!/usr/bin/env python3
"""The boundary elements' own check: a smooth sphere, whose contact is Hertz's, on grids of a/h = 4 ... 64 cells a contact radius.
The load converges as h^2 or so, the corrected area faster than the counted one; exits with 1 when they do not."""
import sys
import numpy as np
import bem

E_star, R, a = 1.0, 1.0, 0.05
delta, N, A = a * a / R, 4 / 3 * E_star * a**3 / R, np.pi * a * a
failed = False
print("  a/h   N/Hertz-1   A/Hertz-1   corrected   A: scatter over 9 grid offsets")
for cells in (4, 8, 16, 32, 64):
    h = a / cells
    n = int(2.4 * cells)
    rows = []
    operator = bem.HalfSpace(n, n, h, E_star)
    for ox in (0.0, 1 / 3, 0.5):
        for oy in (0.0, 0.21, 0.5):
            x, y = (np.arange(n) - n // 2 + ox) * h, (np.arange(n) - n // 2 + oy) * h
            overlap = delta - (x[None, :]**2 + y[:, None]**2) / (2 * R)
            p, _, _ = bem.solve(operator, overlap, np.zeros((n, n)), 1e-8)
            rows.append((p.sum() * h * h / N - 1, *(v / A - 1 for v in bem.areas(p, h))))
    load, counted, corrected = np.mean(rows, axis=0)
    print(f"{cells:5d}  {load:10.2e}  {counted:10.2e}  {corrected:10.2e}   {np.std(rows, axis=0)[1]:.1e}")
    failed |= abs(load) > 0.12 / cells**2 + 1e-6 or abs(corrected) > 0.15 / cells or abs(corrected) > abs(counted)
sys.exit(failed)
