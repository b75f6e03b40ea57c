"""Runs the programs that call every function of rsc.h (calls.cpp) and the same through rsc.f90 (calls.f90), rsc77.c (calls77.f90) or rsc.py
(../python/calls.py), and compares what they print: every value, every status, every message, to the last bit.

It fails, too, where something public is called by none of them or could be taken for something else unseen:
    an output of a function of rsc.h that calls.cpp does not print; two outputs of a function that are alike whenever they are printed;
    a procedure of rsc.f90 or rsc.py, a routine of rsc77.c, a member of rsc_result (rsc_results.f90) that its test does not use.

usage: compare_calls.py SOURCE_FOLDER fortran CALLS_C CALLS_FORTRAN CALLS_77
       compare_calls.py SOURCE_FOLDER python CALLS_C
"""
import ast
import collections
import itertools
import os
import re
import subprocess
import sys
import tempfile

CASE = """&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 /
&indentation levels=2, 0, -1 /
&solver max_iterations=1, tolerance=1e-14 /
&output file='calls.nc' /
"""
# What a language does not have; of rsc77.c, what it has.
LACKS = {
    "fortran": {"rsc_key_count.count", "rsc_key_name.buffer", "rsc_status_text.buffer"},
    "python": {"rsc_friction_first_loading.stick_separation", "rsc_status_text.buffer"},
}
SCENES_LACKING = {"fortran": set(), "python": {"many_refused"}, "77": {"forms", "kept", "curved", "many", "many_refused", "friction"}}
FUNCTIONS_77 = """version case_create case_read case_set case_get case_run surface_synthesize surface_take surface_heights asperities_find
    asperities_make asperities_take asperities_count asperities_get contact_create contact_create_from_case contact_move_tip contact_first_touch
    contact_indent contact_press contact_result contact_level contact_stiffness contact_energy contact_spots contact_deflection
    friction_create_from_case friction_update friction_commit friction_rollback""".split()


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def rows_of(command):
    """{(scene, function.argument, how often until then): values} of what a program prints."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "calls.nml"), "w", encoding="utf-8") as out:
            out.write(CASE)
        lines = subprocess.run(command, cwd=folder, check=True, stdout=subprocess.PIPE).stdout.decode("utf-8").splitlines()
    rows, seen = {}, collections.Counter()
    for line in lines:
        scene, what, values = (line + "  ").split(" ", 2)
        seen[scene, what] += 1
        rows[scene, what, seen[scene, what]] = values.strip()
    return rows


def declarations(header):
    """{function: [(argument, type, whether it is an output)]} of rsc.h, without handles."""
    header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    functions = {}
    for name, arguments in re.findall(r"RSC_API\s+int32_t\s+(\w+)\(([^)]*)\)\s*;", header):
        functions[name] = []
        for argument in arguments.split(","):
            const, kind, stars, word = re.fullmatch(r"(const )?(\w+)(\**) (\w+)", " ".join(argument.split())).groups()
            if not kind.startswith("rsc_"):
                functions[name].append((word, kind, not const and stars == "*"))
    return functions


def what_calls_leaves_out(functions, rows, source):
    """Functions and outputs that calls.cpp does not have, and outputs that cannot be told apart by what it prints."""
    wrong = [f"calls.cpp does not call {name}" for name in functions if not re.search(rf"\b{name}\b", source)]
    by_label = collections.defaultdict(dict)
    for (scene, what, number), values in rows.items():
        by_label[what][scene, number] = values
    # Not printed: lengths of texts and numbers of values, which come with them, and what rsc_message gives is printed with every failure.
    outputs = {f"{name}.{word}": kind for name, arguments in functions.items() for word, kind, is_output in arguments
               if is_output and name != "rsc_message" and (name, word) not in {(n, "length") for n in functions} | {("rsc_friction_spots", "count")}}
    wrong += [f"calls.cpp does not print {label}" for label in outputs if label not in by_label]
    for one, other in itertools.combinations(outputs, 2):
        if one.split(".")[0] == other.split(".")[0] and outputs[one] == outputs[other]:
            if all(by_label[other].get(place) == values for place, values in by_label[one].items()):
                wrong.append(f"{one} and {other} are alike whenever calls.cpp prints them")
    return wrong


def differences(language, reference, rows):
    def belongs(scene, what):
        if scene in SCENES_LACKING[language]:
            return False
        return what.split(".")[0][4:] in FUNCTIONS_77 if language == "77" else what not in LACKS[language]

    wrong = []
    wanted = {key: values for key, values in reference.items() if belongs(*key[:2])}
    rows = {key: values for key, values in rows.items() if key[0] != "own"}
    for key in sorted(set(wanted) | set(rows)):
        if wanted.get(key) != rows.get(key):
            wrong.append(f"{language}: {key[0]}, {key[1]}, number {key[2]}: {str(rows.get(key))[:300]}; by rsc.h: {str(wanted.get(key))[:300]}")
    return wrong


def uncalled_fortran(module, source):
    """Public procedures of rsc.f90, those of its types included, that calls.f90 does not call."""
    public = re.findall(r"^  public :: (.*)$", module, flags=re.M)
    names = [name for line in public for name in re.split(r",\s*", line) if name != "assignment(=)"]
    bound = re.findall(r"^    procedure :: (\w+) => ", module, flags=re.M) + re.findall(r"^    generic :: (\w+) => ", module, flags=re.M)
    assert len(names) > 8 and len(bound) > 50
    return [f"calls.f90 does not use {name}" for name in names if not re.search(rf"\b{name}\b", source)] + \
           [f"calls.f90 does not call %{name}" for name in set(bound) if not re.search(rf"%{name}\s*\(", source)]


def uncalled_77(module, source, readme):
    names = re.findall(r"^RSC_API void (\w+)_\(", module, flags=re.M)
    assert len(set(names)) > 30
    # Each that has a handle among its arguments is tried with wrong ones.
    handles = set(re.findall(r"^RSC_API void (\w+)_\([^)]*?const int32_t\* (?:i_\w+|icase|icon|original)\b", module, flags=re.M))
    return [f"calls77.f90 does not call {name}" for name in set(names) if not re.search(rf"call {name}\(", source)] + \
           [f"calls77.f90 does not try {name} with wrong handles" for name in handles if f"no_handle(1, '{name}')" not in source and f", '{name}')" not in source] + \
           [f"modules/README does not list {name.upper()}" for name in set(names) if name.upper() + "(" not in readme]


def unread_results(module, source):
    """Members of rsc_result that test_results.f90 does not compare with the variable of their name."""
    body = re.search(r"type :: rsc_result\n(.*?)\n  contains", module, flags=re.S)[1]
    members = []
    for line in body.splitlines():
        declared = re.sub(r"!.*", "", line).partition("::")[2]
        members += re.findall(r"(\w+)\s*(?:\([:,]+\))?\s*(?:=[^,]*)?(?:,|$)", declared.strip())
    assert len(members) > 70
    attributes = {"title", "source", "history", "references", "case", "seed"}
    return [f"test_results.f90 does not compare {name}" for name in members if name not in attributes and not re.search(rf"'{name}', (?:real\()?\[r%{name}\]", source)] + \
           [f"test_results.f90 does not look at {name}" for name in attributes if not re.search(rf"r%{name}\b", source)]


def uncalled_python(module, source, others):
    """Public names of rsc.py and methods of its classes that calls.py does not use; where files, threads or several cases belong to it, the tests beside it."""
    elsewhere = {"read", "study", "curve", "update", "close", "closed", "Error", "ArgumentError", "LEVELS", "Grid", "Moments", "Summits", "Curvatures", "Level", "Answer", "Spots",
                 "FrictionState", "SpotSlip"}
    names = set()
    for node in ast.parse(module).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
            names.add(node.name)
        if isinstance(node, ast.ClassDef) and node.name != "_Lock":
            names |= {inner.name for inner in node.body if isinstance(inner, ast.FunctionDef) and not inner.name.startswith("_")}
    names |= set(ast.literal_eval(re.search(r"__all__ = (\[.*?\])", module, flags=re.S)[1]))
    assert len(names) > 50
    return [f"python: no test uses {name}" for name in sorted(names)
            if not re.search(rf"\.{name}\b|\"{name}\"", source) and not (name in elsewhere or name in elsewhere)]


def main():
    folder, language, program, *more = sys.argv[1:]
    test, modules = os.path.join(folder, "test"), os.path.join(folder, "modules")
    reference = rows_of([program])
    functions = declarations(text_of(folder, "src", "rsc.h"))
    wrong = what_calls_leaves_out(functions, reference, text_of(test, "fortran", "calls.cpp"))
    compared = 0
    for name, command in {"fortran": more[:1], "77": more[1:]}.items() if language == "fortran" else [("python", [sys.executable, os.path.join(test, "python", "calls.py")])]:
        rows = rows_of(command)
        compared += len(rows)
        wrong += differences(name, reference, rows)
    if language == "fortran":
        wrong += uncalled_fortran(text_of(modules, "rsc.f90"), text_of(test, "fortran", "calls.f90"))
        wrong += uncalled_77(text_of(modules, "rsc77.c") + text_of(modules, "generated", "rsc77.inc"), text_of(test, "fortran", "calls77.f90"), text_of(modules, "README"))
        wrong += unread_results(text_of(modules, "rsc_results.f90"), text_of(test, "fortran", "test_results.f90"))
    else:
        others = "".join(text_of(test, "python", name) for name in os.listdir(os.path.join(test, "python")) if name.startswith("test_"))
        wrong += uncalled_python(text_of(modules, "rsc.py"), text_of(test, "python", "calls.py"), others)
    print("\n".join(wrong))
    print(f"{len(functions)} functions, {len(reference)} rows by rsc.h, {compared} compared, {len(wrong)} wrong")
    sys.exit(1 if wrong or compared < 200 else 0)


main()
