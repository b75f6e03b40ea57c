"""A law of law.py in CalculiX: an elastic block on a rigid base through the rough interface. Force against displacement is that of bulk and
contact in series, to 1 %.

usage: test_calculix.py FOLDER_OF_EXPORT CCX        (RSC_PROGRAM in the environment)
"""
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, sys.argv[1])
import law  # noqa: E402

E, NU, SIDE, HEIGHT = 7.8e4, 0.3, 1.0, 2.0  # the block [N/mm2, mm]
STEPS = 10
TOLERANCE = 0.01  # of the force; what is left is CalculiX's own tolerance of an increment and, with the spring, the finite strain of the block


def flats(folder):
    """Two flats, by rsc."""
    path = os.path.join(folder, "flats.nc")
    case = ("&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.001 / &solids E=2.1e5,Infinity nu=0.3,0.0 R=Infinity,Infinity / &run realizations=3 / "
            "&indentation boundary='periodic' start=4.0 stop=1.5 steps=26 /")
    subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path], input=case, text=True, capture_output=True, check=True)
    return path, "rsc, periodic"


def box(first, x0, x1, nx, z0, z1, nz):
    """Nodes {number: place} and C3D8 elements (lists of node numbers) of a box with a square base."""
    xs, zs = np.linspace(x0, x1, nx + 1), np.linspace(z0, z1, nz + 1)
    number = {(i, j, k): first + i + (nx + 1) * (j + (nx + 1) * k) for k in range(nz + 1) for j in range(nx + 1) for i in range(nx + 1)}
    nodes = {n: (xs[i], xs[j], zs[k]) for (i, j, k), n in number.items()}
    elements = [[number[i + a, j + b, k + c] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for k in range(nz) for j in range(nx) for i in range(nx)]
    return nodes, elements, number


def lines_of(numbers):
    return [", ".join(map(str, numbers[k : k + 10])) for k in range(0, len(numbers), 10)]


def run_ccx(folder, name, deck):
    with open(os.path.join(folder, name + ".inp"), "w", encoding="utf-8") as out:
        out.write("\n".join(deck) + "\n")
    done = subprocess.run([sys.argv[2], name], cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode != 0 or "ERROR" in done.stdout or not os.path.exists(os.path.join(folder, name + ".dat")):
        sys.exit(f"ccx failed on {name}: {done.stdout[-2000:]}{done.stderr[-500:]}")
    with open(os.path.join(folder, name + ".dat"), encoding="utf-8") as out:
        text = out.read()
    return np.array([[float(time), -float(rows.split()[2])] for time, rows in re.findall(r"total force \(fx,fy,fz\) for set TOP and time\s+(\S+)\s+(\S.*)", text)])


def base_deck(block, extra_nodes, extra_elements, top, u):
    nodes, elements, number = block
    return (["*NODE"] + [f"{n}, {x:.9g}, {y:.9g}, {z:.9g}" for n, (x, y, z) in {**nodes, **extra_nodes}.items()]
            + ["*ELEMENT, TYPE=C3D8, ELSET=BLOCK"] + [f"{k + 1}, " + ", ".join(map(str, e)) for k, e in enumerate(elements)] + extra_elements
            + ["*MATERIAL, NAME=ELASTIC", "*ELASTIC", f"{E}, {NU}", "*SOLID SECTION, ELSET=BLOCK, MATERIAL=ELASTIC", "*NSET, NSET=TOP"] + lines_of(top))


def step_deck(fixed, u, nlgeom):
    return ([f"*STEP, NLGEOM={nlgeom}, INC=1000", "*STATIC, DIRECT", f"{1 / STEPS}, 1.", "*BOUNDARY", f"TOP, 3, 3, {-u:.9g}"] + fixed
            + ["*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1", "RF", "*END STEP"])


def block_on_flats(folder):
    """Force by CalculiX, and in series: u = p HEIGHT/E + c(p)."""
    path, origin = flats(folder)
    found = law.Law(path)
    nx = 2
    block = box(1, 0.0, SIDE, nx, 0.0, HEIGHT, 4)
    # The base is larger than the block, and stiff because all its nodes are held.
    base = box(1001, -SIDE, 2 * SIDE, 1, -1.0, 0.0, 1)
    top = [n for (i, j, k), n in block[2].items() if k == 4]
    bottom_faces = [f"{1 + e}, S1" for e in range(nx * nx)]
    deck = base_deck(block, base[0], ["*ELEMENT, TYPE=C3D8, ELSET=BASE", "1001, " + ", ".join(map(str, base[1][0])), "*SOLID SECTION, ELSET=BASE, MATERIAL=ELASTIC"], top, 0)
    # The material stands behind the section above in the deck: CalculiX reads it all before it looks.
    deck += ["*NSET, NSET=HELD"] + lines_of(list(base[0])) + ["*SURFACE, NAME=LOWER, TYPE=ELEMENT"] + bottom_faces + ["*SURFACE, NAME=UPPER, TYPE=ELEMENT", "1001, S2"]
    deck += law.calculix(found, "ROUGH") + ["*CONTACT PAIR, INTERACTION=ROUGH, TYPE=NODE TO SURFACE", "LOWER, UPPER"]
    pressure = found.load[-1] * 0.9
    u = pressure * HEIGHT / E + np.interp(pressure, found.load, found.approach)
    corner = block[2][0, 0, 0]
    beside = block[2][nx, 0, 0]
    rows = run_ccx(folder, "block", deck + step_deck(["HELD, 1, 3", f"{corner}, 1, 2", f"{beside}, 2, 2"], u, "NO"))
    series_u = found.load * HEIGHT / E + found.approach  # piecewise linear in p, so interpolation is exact
    return f"block, {origin}", rows[:, 0] * u, rows[:, 1], np.interp(rows[:, 0] * u, series_u, found.load) * SIDE**2, found


def main():
    with tempfile.TemporaryDirectory() as folder:
        name, u, force, series, found = block_on_flats(folder)
    error = np.abs(force / series - 1)
    share = np.interp(force, found.load, found.approach) / u
    print(f"{name}: {force.size} increments, force up to {force.max():.4g} N; contact is {100 * np.min(share):.0f} to {100 * np.max(share):.0f} % of the displacement; "
          f"largest difference from the series {100 * error.max():.3g} %")
    if force.size != STEPS or not error.max() <= TOLERANCE or not np.all(np.diff(force) > 0):
        sys.exit(str(np.column_stack([u, force, series])))


main()
