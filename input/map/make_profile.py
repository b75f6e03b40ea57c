#!/usr/bin/env python3
"""Makes profile.sdf, the trace of input/profile.nml: of a rough shaft across its lay, as a stylus
records it (ISO 25178-71, binary, one profile)."""

import os
import struct

import numpy as np

POINTS, STEP = 5600, 1e-6  # [m]
LONGEST, SHORTEST, HURST, RMS = 100e-6, 8e-6, 0.8, 0.4e-6
RADIUS, TILT, NOISE, RESOLUTION = 0.2, 2e-4, 2e-9, 1e-9

rng = np.random.default_rng(70)
# A profile of an isotropic surface with a plateau above LONGEST: C1(q) = 2 int Phi(sqrt(q2 + t2)) dt.
n = 4 * POINTS
q = 2 * np.pi * np.fft.rfftfreq(n, STEP)
t = np.linspace(0, 2 * np.pi / SHORTEST, 4001)
low, high = 2 * np.pi / LONGEST, 2 * np.pi / SHORTEST
power = np.zeros_like(q)
for i in np.flatnonzero(q < high):
    k = np.hypot(q[i], t)
    power[i] = 2 * np.trapz(np.where(k < high, np.maximum(k / low, 1) ** (-2 - 2 * HURST), 0), t)
modes = np.sqrt(power) * (rng.normal(size=q.size) + 1j * rng.normal(size=q.size))
modes[0] = 0
z = np.fft.irfft(modes, n)
z = z[:POINTS] * RMS / z.std()
x = STEP * (np.arange(POINTS) - POINTS / 2)
z += np.sqrt(RADIUS**2 - x**2) - RADIUS + TILT * x + NOISE * rng.normal(size=POINTS)
z[[1234, 4001]] += [4e-6, -6e-6]  # dust and a pore
counts = np.round(z / RESOLUTION).astype("<i2")
counts[2500:2506] = -(2**15)  # lost signal
head = struct.pack(
    "<8s10s12s12sHHddddBBB",
    b"bISO-1.0",
    b"rsc".ljust(10),
    b"010120260000",
    b"010120260000",
    POINTS,
    1,
    STEP,
    1.0,
    RESOLUTION,
    -1.0,
    0,
    5,
    0,
)
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "profile.sdf"), "wb") as file:
    file.write(head + counts.tobytes())
