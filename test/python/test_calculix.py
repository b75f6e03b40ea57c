"""The laws of law.py in CalculiX.

block    an elastic block on a rigid base through the rough interface: force against displacement is that of bulk and contact in series, to 1 %
sphere   a smooth elastic sphere of finite elements on a rigid base through the law of two rough flats, beside the mean of deterministic rough spheres

usage: test_calculix.py block|sphere FOLDER_OF_EXPORT CCX        (RSC_PROGRAM in the environment)
"""
import os
import re
import subprocess
import sys
import tempfile

import netCDF4
import numpy as np

sys.path.insert(0, sys.argv[2])
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


def run_ccx(folder, name, deck, axis=2):
    with open(os.path.join(folder, name + ".inp"), "w", encoding="utf-8") as out:
        out.write("\n".join(deck) + "\n")
    done = subprocess.run([sys.argv[3], name], cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode != 0 or "ERROR" in done.stdout or not os.path.exists(os.path.join(folder, name + ".dat")):
        sys.exit(f"ccx failed on {name}: {done.stdout[-2000:]}{done.stderr[-500:]}")
    with open(os.path.join(folder, name + ".dat"), encoding="utf-8") as out:
        text = out.read()
    return np.array([[float(time), -float(rows.split()[axis])] for time, rows in re.findall(r"total force \(fx,fy,fz\) for set TOP and time\s+(\S+)\s+(\S.*)", text)])


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


RADIUS, NU_SPHERE = 2.5, 0.42  # of rsc's default case
WEDGES = 180  # CalculiX makes a wedge of 2 degrees of an axisymmetric element
REALIZATIONS = 20
DISTANCE = 0.05  # of the mean load, from 2 sigma on; what is left there is the steps of displacement and the deflection between asperities


def sphere_on_law(folder, name, points, u):
    """Displacement of the equator and force of an elastic half sphere pressed on a rigid plane through a law (overclosure, pressure), by steps."""
    fine, growth, contact, outer = 0.01, 1.15, 0.35, 2.0
    r, s = [0.0], [0.0]
    while r[-1] < outer:
        r.append(r[-1] + max(fine, (growth - 1) * (r[-1] - contact)))
    while s[-1] < RADIUS:
        s.append(s[-1] + max(fine, (growth - 1) * s[-1]))
    r, s = np.array(r), np.array(s) / s[-1]
    m = r.size
    below = RADIUS - np.sqrt(RADIUS**2 - r**2)
    deck = ["*NODE"] + [f"{1 + i + m * j}, {r[i]:.9g}, {below[i] + s[j] * (RADIUS - below[i]):.9g}" for j in range(s.size) for i in range(m)]
    base = [m * s.size + k for k in (1, 2, 3, 4)]
    deck += [f"{n}, {x}, {y}" for n, x, y in zip(base, (0, outer, outer, 0), (-0.5, -0.5, 0, 0))] + ["*ELEMENT, TYPE=CAX4, ELSET=ALL"]
    corners = [[1 + i + m * j, 2 + i + m * j, 2 + i + m * (j + 1), 1 + i + m * (j + 1)] for j in range(s.size - 1) for i in range(m - 1)] + [base]
    deck += [f"{k}, " + ", ".join(map(str, nodes)) for k, nodes in enumerate(corners, 1)]
    deck += ["*MATERIAL, NAME=ELASTIC", "*ELASTIC", f"{E}, {NU_SPHERE}", "*SOLID SECTION, ELSET=ALL, MATERIAL=ELASTIC", "*NSET, NSET=TOP"]
    deck += lines_of([1 + i + m * (s.size - 1) for i in range(m)]) + ["*NSET, NSET=AXIS"] + lines_of([1 + m * j for j in range(s.size)]) + ["*NSET, NSET=HELD"] + lines_of(base)
    deck += ["*SURFACE, NAME=LOWER, TYPE=ELEMENT"] + [f"{1 + i}, S1" for i in range(m - 1) if r[i] < 1.5 * contact] + ["*SURFACE, NAME=UPPER, TYPE=ELEMENT", f"{len(corners)}, S3"]
    deck += ["*SURFACE INTERACTION, NAME=ROUGH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR"] + [f"{p:.10g}, {c:.10g}" for c, p in points]
    deck += ["*CONTACT PAIR, INTERACTION=ROUGH, TYPE=NODE TO SURFACE", "LOWER, UPPER", "*BOUNDARY", "HELD, 1, 2", "AXIS, 1, 1", "*STEP, INC=1000", "*STATIC, DIRECT", f"{1 / STEPS}, 1.",
             "*BOUNDARY", f"TOP, 2, 2, {-u:.9g}", "*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1", "RF", "*END STEP"]
    rows = run_ccx(folder, name, deck, axis=1)
    return rows[:, 0] * u, rows[:, 1] * WEDGES


def sphere(folder):
    """A sphere of finite elements knows its asperities by their mean; rsc knows each. Mean loads at the same separation of the undeformed sphere."""
    common = f"&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.01 / &asperities law='fourth_order' / &run realizations={REALIZATIONS} / &solids E={E},Infinity nu={NU_SPHERE},0.0 "
    for name, rest in (("flats", "R=Infinity,Infinity / &indentation boundary='periodic' start=4.5 stop=0.6 steps=40 /"), ("spheres", f"R=Infinity,{RADIUS} / &indentation start=3 stop=0.5 steps=11 /")):
        done = subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", os.path.join(folder, name + ".nc")], input=common + rest, text=True, capture_output=True)
        if done.returncode != 0:
            sys.exit(f"rsc failed on {name}: {done.stderr}")
    found = law.Law(os.path.join(folder, "flats.nc"))
    E_star = E / (1 - NU_SPHERE**2)
    # The equator of a half sphere comes nearer than a point far away in a half-space by what a smooth contact (a stiff law) tells, in proportion to the force.
    u, force = sphere_on_law(folder, "smooth", [(0, 0), (0.1, 1e7)], found.origin)
    hertz = (force * 3 / (4 * E_star * np.sqrt(RADIUS))) ** (2 / 3)
    compliance = np.median((hertz - u) / force)
    u, force = sphere_on_law(folder, "rough", list(zip(found.approach, found.load)), found.origin)
    z = found.origin - (u + compliance * force)
    with netCDF4.Dataset(os.path.join(folder, "spheres.nc")) as file:
        levels, forces = np.ravel(file["separation"][:]), file["force"][:]
    mean = forces.mean(axis=0)
    elements = np.exp(np.interp(-levels, -z[force > 0], np.log(force[force > 0])))
    for row in zip(levels / 0.01, mean, forces.std(axis=0, ddof=1) / mean, elements / mean - 1):
        print("Z0/sigma = %.2f: N = %.4g, from surface to surface %.2g; finite elements with the mean law %+.3f" % row)
    deep = levels < 0.0201
    return deep.sum() == 7 and bool(np.all(np.abs(elements / mean - 1)[deep] < DISTANCE))


def main():
    if sys.argv[1] == "sphere":
        with tempfile.TemporaryDirectory() as folder:
            sys.exit(0 if sphere(folder) else 1)
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for case in (block_on_flats,):
            name, u, force, series, found = case(folder)
            error = np.abs(force / series - 1)
            share = np.interp(force, found.load, found.approach) / u if name != "block" else 0
            print(f"{name}: {force.size} increments, force up to {force.max():.4g} N; contact is {100 * np.min(share):.0f} to {100 * np.max(share):.0f} % of the displacement; "
                  f"largest difference from the series {100 * error.max():.3g} %")
            if force.size != STEPS or not error.max() <= TOLERANCE or not np.all(np.diff(force) > 0):
                print(np.column_stack([u, force, series]))
                failed = True
    sys.exit(1 if failed else 0)


main()
