"""Compares the table of functions in rsc.py, its constants and what ctypes is told with rsc.h; every single change must be noticed.

usage: test_interface.py rsc.h
"""
import ctypes
import re
import sys

import rsc

BY_VALUE = {"double": ctypes.c_double, "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64}


def declarations(text):
    """{function: arguments in one line} of rsc.h."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    found = {name: " ".join(arguments.split()) for name, arguments in re.findall(r"RSC_API\s+int32_t\s+(\w+)\(([^)]*)\)\s*;", text)}
    if text.count("RSC_API") - 3 != len(found):  # three of them define the macro
        raise SystemExit("rsc.h: a declaration is not understood")
    return found


def constants(text):
    return {name: int(value) for name, value in re.findall(r"X\(RSC_(\w+), (-?\d+),", text)}


def differences(header, prototypes):
    rows = dict(re.fullmatch(r"(\w+)\((.*)\)", row.strip()).groups() for row in prototypes.strip().splitlines())
    found = [f"{name}: rsc.py has ({rows.get(name)}); the row of _PROTOTYPES in modules/rsc.py must be\n{name}({declared})" for name, declared in declarations(header).items() if rows.get(name) != declared]
    found += [f"{name}: in rsc.py, not in rsc.h" for name in rows if name not in declarations(header)]
    found += [f"{name}: {value} in rsc.h, {getattr(rsc, name, None)} in rsc.py" for name, value in constants(header).items() if getattr(rsc, name, None) != value]
    levels = {value: name[6:].lower() for name, value in constants(header).items() if name.startswith("LEVEL_")}
    found += [f"LEVELS: {name} is {value} in rsc.h" for value, name in levels.items() if rsc.LEVELS[value : value + 1] != (name,)]
    return found


def argument_types(header):
    """What ctypes is told, from rsc.h alone, against what rsc.py told it."""
    found = []
    for name, declared in declarations(header).items():
        wanted = []
        for argument in declared.split(", "):
            words = argument.replace("const ", "").split()
            wanted.append(ctypes.c_void_p if words[0].endswith("*") else BY_VALUE[words[0]])
        function = getattr(rsc._library, name)
        if function.argtypes != wanted or function.restype is not ctypes.c_int32:
            found.append(f"{name}: ctypes was told {function.argtypes} -> {function.restype}")
    return found


# What a function gives back through addresses is a named tuple by the same names in the same order.
RECORDS = {"rsc_surface_grid": rsc.Grid, "rsc_surface_moments": rsc.Moments, "rsc_asperities_get": rsc.Summits, "rsc_asperities_curvatures": rsc.Curvatures,
           "rsc_contact_level": rsc.Level, "rsc_contact_answer": rsc.Answer, "rsc_contact_spots": rsc.Spots, "rsc_friction_state": rsc.FrictionState,
           "rsc_friction_spots": rsc.SpotSlip, "rsc_contact_result": rsc._Result, "rsc_contact_tip": rsc._Tip}


def record_fields(header):
    found = []
    for name, record in RECORDS.items():
        words = [argument.split()[-1] for argument in declarations(header)[name].split(", ")[1:]]
        wanted = tuple("status" if word == "level_status" else word for word in words if word not in ("n", "count"))
        if record._fields != wanted:
            found.append(f"{record.__name__}: the fields are {record._fields}, those of {name} {wanted}")
    return found


def main():
    header = open(sys.argv[1], encoding="utf-8").read()
    found = differences(header, rsc._PROTOTYPES) + argument_types(header) + record_fields(header)
    drifts = [(0, "double separation, double* force)", "float separation, double* force)"), (0, "X(RSC_FILE, 3,", "X(RSC_FILE, 6,"),
              (0, "const double* heights", "double* heights"), (0, "rsc_contact_energy(", "rsc_contact_work("), (0, "X(RSC_LEVEL_OVERLAPPING, 2", "X(RSC_LEVEL_MERGED, 2"),
              (1, "rsc_key_count(int64_t* count)", "rsc_key_count(int32_t* count)"), (1, "rsc_contact_tip(const ", "rsc_contact_tip("),
              (1, "double E_star, double R,", "double R, double E_star,"), (1, "rsc_key_count(int64_t* count)\n", "")]
    for which, old, new in drifts:
        texts = [header, rsc._PROTOTYPES]
        if old not in texts[which]:
            found.append(f"self-test: not found any more: {old}")
        texts[which] = texts[which].replace(old, new)
        if not differences(*texts):
            found.append(f"not noticed: {old} -> {new}")
    print("\n".join(found))
    print(f"{len(declarations(header))} functions and {len(constants(header))} constants compared, {len(drifts)} drifts tried, {len(found)} differences")
    sys.exit(1 if found else 0)


main()
