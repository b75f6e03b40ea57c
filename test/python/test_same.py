"""The same cases by Python, by the Fortran module and by the program: equal to the last bit.

usage: test_same.py FORTRAN_PROGRAM        (RSC_PROGRAM in the environment: the program)
"""
import os
import struct
import subprocess
import sys
import tempfile

import numpy as np

import rsc

BASE = {"surface": {"n": 256, "L_lambda_l": 8.0, "L_lambda_s": 64.0, "sigma": 0.01}, "indentation": {"start": 3.5, "stop": 1.0, "steps": 7}}
CASES = {
    "default": {},
    "direct, another seed": {"run%seed": 7, "solver%method": "direct"},
    "fourth_order": {"asperities%law": "fourth_order", "surface%hurst": 0.5},
    "no interaction, off centre": {"solver%interaction": "none", "indentation%centre": [0.4, 0.55]},
    "pressed by forces": {"indentation": {"control": "force", "start": 0.5, "stop": 30.0}},
    "elements": {"solver%model": "elements", "elements%points_per_wave": 4},
    "two flats": {"solids%R": [float("inf"), float("inf")], "indentation%boundary": "periodic", "asperities%law": "elliptic"},
    "two elastic bodies": {"solids": {"E": [1e5, 2e5], "nu": [0.3, 0.25], "R": [3.0, 5.0]}, "surface%plateau": True},
}
NAMES = ("separation", "force", "contact_area", "stiffness", "contacts")


def from_bits(text):
    return struct.unpack(">d", bytes.fromhex(text))[0]


def by_fortran(program, folder, case, levels):
    with open(os.path.join(folder, "case"), "w", encoding="utf-8") as out:
        out.write(case.text())
    with open(os.path.join(folder, "levels"), "w", encoding="utf-8") as out:
        out.writelines(f"{how} {value!r}\n" for how, value in levels)
    lines = subprocess.run([program, os.path.join(folder, "case"), os.path.join(folder, "levels")], check=True, capture_output=True, text=True).stdout.split("\n")
    rows = [line.split() for line in lines[1:] if line]
    return int(lines[0]), {name: np.array([from_bits(r[k]) if k < 4 else int(r[k]) for r in rows]) for k, name in enumerate(NAMES)}


def by_python(case, levels):
    asperities = rsc.Asperities.make(case)
    contact = rsc.Contact.from_case(asperities, case)
    rows = []
    for how, value in levels:
        contact.press(value) if how == "press" else contact.indent(value)
        rows.append((contact.separation, contact.force, contact.area, contact.stiffness(), contact.contacts))
    return len(asperities), dict(zip(NAMES, map(np.array, zip(*rows))))


def main():
    wrong = compared = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, changes in CASES.items():
            case = rsc.Case(BASE)
            case.update(changes)
            files = {}
            case["output%file"] = os.path.join(folder, "python.nc")
            files["rsc_case_run"] = rsc.read(case.run(), xarray=False)
            path = os.path.join(folder, "case.nml")
            with open(path, "w", encoding="utf-8") as out:
                out.write(case.text())
            target = os.path.join(folder, "program.nc")
            subprocess.run([os.environ["RSC_PROGRAM"], "-q", path, "-o", target], check=True, capture_output=True)
            files["program"] = rsc.read(target, xarray=False)
            of_program, of_run = ({k: np.ravel(files[by][k]) for k in NAMES if k in files[by]} for by in ("program", "rsc_case_run"))
            levels = [("indent", float(z)) for z in of_program["separation"]]
            if case["indentation%control"] == "force":
                start, stop, steps = (case[f"indentation%{name}"] for name in ("start", "stop", "steps"))
                levels = [("press", float(N)) for N in np.linspace(start, stop, steps)]
            summits, of_python = by_python(case, levels)
            of_fortran = by_fortran(sys.argv[1], folder, case, levels)
            results = {"rsc_case_run": of_run, "program": of_program, "Fortran": of_fortran[1]}
            for other, values in results.items():
                for key in values:
                    if not np.any(of_python["force"] > 0) or values[key].shape != of_python[key].shape or not np.array_equal(values[key], of_python[key]):
                        print(f"{name}: {key} by {other} {values[key]}, by Python {of_python[key]}")
                        wrong += 1
                    compared += values[key].size
            of_file = files["program"].get("summits", [summits])  # files of elements have none
            for other, count in (("program", int(of_file[0])), ("Fortran", of_fortran[0])):
                if count != summits:
                    print(f"{name}: {count} summits by {other}, {summits} by Python")
                    wrong += 1
    print(f"{len(CASES)} cases, {compared} numbers compared, {wrong} different")
    sys.exit(1 if wrong or compared < 100 else 0)


main()
