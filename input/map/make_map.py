#!/usr/bin/env python3
"""Generates map.sdf and map.gwy: a map as from a profilometer, of a known synthetic surface.

Heights: an isotropic self-affine Gaussian surface of period 600 um with waves from 100 to 16 um,
hurst 0.8, rms height 0.5 um (a sum of Fourier modes, so that nothing is periodic on the map
itself); on a dome of 20 mm radius; tilted by 0.8 % and -0.5 %; white noise of 4 nm rms; rounded to
1 nm. A scratch of missing points and some single ones. 160 x 128 points of 2.5 x 3.125 um: 400 x
400 um.

    python3 input/map/make_map.py     writes both files beside itself; needs only Python
"""

import cmath
import math
import pathlib
import random
import struct

NX, NY, DX, DY = 160, 128, 2.5, 3.125  # points, um
PERIOD, LONGEST, SHORTEST, HURST, SIGMA = 600.0, 100.0, 16.0, 0.8, 0.5  # um
RADIUS, TILT, NOISE, STEP = 20e3, (0.008, -0.005), 0.004, 0.001  # um
MISSING = -32768  # of 16-bit integers, ISO 25178-71


def roughness(noise):
    most = int(PERIOD / SHORTEST)
    modes, power = {}, 0.0
    for kx in range(most + 1):
        for ky in range(-most, most + 1):
            q = math.hypot(kx, ky)
            if not PERIOD / LONGEST <= q <= PERIOD / SHORTEST or (kx == 0 and ky <= 0):
                continue
            psd = q ** (-2 * (1 + HURST))
            modes[kx, ky] = complex(noise.gauss(0, 1), noise.gauss(0, 1)) * math.sqrt(psd / 2)
            power += 2 * psd
    rows = []
    for j in range(NY):
        column = [0j] * (most + 1)
        turn = [cmath.exp(2j * math.pi * ky * j * DY / PERIOD) for ky in range(-most, most + 1)]
        for (kx, ky), amplitude in modes.items():
            column[kx] += amplitude * turn[ky + most]
        row = []
        for i in range(NX):
            unit, wave, z = cmath.exp(2j * math.pi * i * DX / PERIOD), 1 + 0j, 0.0
            for amplitude in column:
                z += 2 * (amplitude * wave).real
                wave *= unit
            row.append(z * SIGMA / math.sqrt(power))
        rows.append(row)
    return rows


def missing(i, j):
    x, y = i * DX, j * DY
    scratch = (
        abs((x - 110) * 0.6 + (y - 300) * 0.8) < 6 and abs((x - 110) * 0.8 - (y - 300) * 0.6) < 45
    )
    return scratch or (i * 7919 + j * 104729) % 2503 == 0


def measured():
    """Heights in nanometres, whole numbers, rows from the top of the picture."""
    noise = random.Random(20)
    z = roughness(noise)
    rows = []
    for j in reversed(range(NY)):
        row = []
        for i in range(NX):
            x, y = (i + 0.5) * DX - NX * DX / 2, (j + 0.5) * DY - NY * DY / 2
            height = (
                z[j][i]
                + math.sqrt(RADIUS**2 - x * x - y * y)
                - RADIUS
                + TILT[0] * x
                + TILT[1] * y
                + noise.gauss(0, NOISE)
            )
            row.append(MISSING if missing(i, j) else round(height / STEP))
        rows.append(row)
    return rows


def write_sdf(path, rows):
    header = b"bISO-1.0" + b"rsc".ljust(10) + b"010120260000" * 2
    header += struct.pack(
        "<HHddddBBB", NX, NY, DX * 1e-6, DY * 1e-6, STEP * 1e-6, STEP * 1e-6, 0, 5, 0
    )
    # The first profile has the lowest y.
    path.write_bytes(header + b"".join(struct.pack(f"<{NX}h", *row) for row in reversed(rows)))


def write_gwy(path, rows):
    def named(name, kind, value):
        return name.encode() + b"\0" + kind + value

    def thing(name, parts):
        inside = b"".join(parts)
        return name.encode() + b"\0" + struct.pack("<I", len(inside)) + inside

    def field(unit, values):
        metre = thing("GwySIUnit", [named("unitstr", b"s", b"m\0")])
        return thing(
            "GwyDataField",
            [
                named("xres", b"i", struct.pack("<i", NX)),
                named("yres", b"i", struct.pack("<i", NY)),
                named("xreal", b"d", struct.pack("<d", NX * DX * 1e-6)),
                named("yreal", b"d", struct.pack("<d", NY * DY * 1e-6)),
                named("si_unit_xy", b"o", metre),
                named("si_unit_z", b"o", thing("GwySIUnit", [named("unitstr", b"s", unit)])),
                named(
                    "data",
                    b"D",
                    struct.pack("<I", len(values)) + struct.pack(f"<{len(values)}d", *values),
                ),
            ],
        )

    heights = [0.0 if v == MISSING else v * STEP * 1e-6 for row in rows for v in row]
    mask = [1.0 if v == MISSING else 0.0 for row in rows for v in row]
    path.write_bytes(
        b"GWYP"
        + thing(
            "GwyContainer",
            [
                named("/0/data", b"o", field(b"m\0", heights)),
                named("/0/data/title", b"s", b"Topography\0"),
                named("/0/mask", b"o", field(b"\0", mask)),
            ],
        )
    )


if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parent
    map_rows = measured()
    write_sdf(folder / "map.sdf", map_rows)
    write_gwy(folder / "map.gwy", map_rows)
