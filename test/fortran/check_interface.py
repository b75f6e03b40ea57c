"""Compares the interface blocks of rsc.f90 with rsc.h and tickets.h: functions, arguments, their order, names and types, constants.

usage: check_interface.py rsc.h tickets.h rsc.f90
       check_interface.py --self-test rsc.h tickets.h rsc.f90    (every single change to a copy must be found)
"""
import re
import sys

C_TYPES = {"double": "real(c_double)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)"}


def read_header(text):
    """Functions {name: [(argument, type)]} and constants {name: value} of the header."""
    constants = {name.lower(): int(value) for name, value in re.findall(r"X\((RSC_\w+), (-?\d+),", text)}
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    functions = {}
    for name, arguments in re.findall(r"RSC_API\s+int32_t\s+(\w+)\(([^)]*)\)\s*;", text):
        functions[name] = [c_argument(name, a.strip()) for a in arguments.split(",")]
    if text.count("RSC_API") - 3 != len(functions):  # three of them define the macro
        raise SystemExit("rsc.h: a declaration is not understood")
    return functions, constants


def c_argument(function, text):
    match = re.fullmatch(r"(const\s+)?(\w+)\s*(\**)\s*(\w+)", " ".join(text.split()))
    if not match:
        raise SystemExit(f"rsc.h: {function}: argument not understood: {text}")
    const, kind, stars, name = bool(match[1]), match[2], match[3], match[4]
    if kind.startswith("rsc_") or kind == "void":
        what = {"*": "handle", "**": "address of a handle"}[stars]
    elif kind == "char":
        what = "text in" if const else "text out"
    else:
        what = C_TYPES[kind] + ({"": " value", "*": " in" if const else " out"}[stars])
    return name.lower(), what


def read_module(text):
    constants = {n.lower(): int(v) for n, v in re.findall(r"integer(?:\(c_int32_t\))?, parameter(?:, public)? :: (rsc_\w+) = (-?\d+)", text)}
    start = text.index("\n  interface\n")
    end = text.index("\n  end interface\n", start)
    block = re.sub(r"!.*", "", text[start:end])
    block = re.sub(r"&\s*\n\s*&?", "", block)
    functions = {}
    for name, arguments, body in re.findall(r"function (\w+)\(([^)]*)\) bind\(c\) result\(code\)\n(.*?)end function", block, flags=re.S):
        declared = {}
        for line in body.strip().splitlines():
            left, separator, right = line.partition("::")
            if not separator or left.strip() == "import":
                continue
            for variable in re.findall(r"(\w+)(\(\*\))?", right):
                declared[variable[0].lower()] = fortran_type(name, left.strip(), bool(variable[1]))
        if declared.pop("code", None) != "integer(c_int32_t) result":
            raise SystemExit(f"rsc.f90: {name}: the result must be integer(c_int32_t) :: code")
        functions[name] = [(a.strip().lower(), declared.pop(a.strip().lower(), "undeclared")) for a in arguments.split(",")]
        if declared:
            raise SystemExit(f"rsc.f90: {name}: declared but no argument: {', '.join(declared)}")
    if block.count("end function") != len(functions):
        raise SystemExit("rsc.f90: an interface is not understood")
    return functions, constants


def fortran_type(function, text, array):
    words = [w.strip() for w in re.split(r",(?![^(]*\))", text)]
    kind, attributes = words[0], set(words[1:]) - {"optional"}
    if kind == "type(c_ptr)":
        return {"value": "handle", "intent(inout)": "address of a handle"}.get("".join(attributes), text)
    if kind == "character(kind=c_char)" and array:
        return {"intent(in)": "text in", "intent(inout)": "text out"}.get("".join(attributes), text)
    if attributes == {"value"} and not array:
        return kind + " value"
    # What a failure leaves as it was is intent(inout): after intent(out) a compiler may drop the value from before.
    if attributes in ({"intent(in)"}, {"intent(inout)"}):
        return kind + (" in" if attributes == {"intent(in)"} else " out")
    return kind + " result" if not attributes else text


def differences(header, module):
    (c_functions, c_constants), (f_functions, f_constants) = read_header(header), read_module(module)
    found = []
    for name in sorted(set(c_functions) | set(f_functions)):
        if name not in f_functions:
            found.append(f"{name}: in rsc.h, not in rsc.f90")
        elif name not in c_functions:
            found.append(f"{name}: in rsc.f90, not in rsc.h")
        elif c_functions[name] != f_functions[name]:
            found.append(f"{name}: rsc.h has {c_functions[name]}, rsc.f90 has {f_functions[name]}")
    for name in sorted(set(c_constants) | set(f_constants)):
        if c_constants.get(name) != f_constants.get(name):
            found.append(f"{name}: {c_constants.get(name)} in rsc.h, {f_constants.get(name)} in rsc.f90")
    return found, len(c_functions), len(c_constants)


def self_test(header, module):
    """Each of these changes is a drift that must not go unseen."""
    changes = [
        (0, "rsc_contact_indent(rsc_contact* contact, double separation", "rsc_contact_indent(rsc_contact* contact, float separation"),
        (0, "int64_t n, double* x, double* y", "int32_t n, double* x, double* y"),
        (0, "double x0, double y0);", "double y0, double x0);"),
        (0, "const double* heights", "double* heights"),
        (0, "X(RSC_FILE, 3,", "X(RSC_FILE, 6,"),
        (0, "RSC_API int32_t rsc_contact_energy(", "RSC_API int32_t rsc_contact_work("),
        (0, "RSC_API int32_t rsc_key_count(int64_t* count);", ""),
        (1, "real(c_double), value :: separation", "real(c_double), intent(in) :: separation"),
        (1, "integer(c_int64_t), value :: key", "integer(c_int32_t), value :: key"),
        (0, "int32_t kind, void* handle", "void* handle, int32_t kind"),
        (0, "X(RSC_KIND_CASE, 1,", "X(RSC_KIND_CASE, 2,"),
        (1, "real(c_double), intent(inout), optional :: separation, force, area", "real(c_double), intent(out), optional :: separation, force, area"),
        (1, "public :: rsc_no_memory = 2", "public :: rsc_no_memory = 7"),
        (1, "function rsc_case_copy(new_case, original)", "function rsc_case_copy(original, new_case)"),
    ]
    missed = 0
    for which, old, new in changes:
        texts = [header, module]
        if old not in texts[which]:
            raise SystemExit(f"self-test: not found any more: {old}")
        texts[which] = texts[which].replace(old, new)
        try:
            found = differences(*texts)[0]
        except (SystemExit, KeyError) as error:
            found = [str(error)]
        if not found:
            print(f"not noticed: {old} -> {new}")
            missed += 1
    print(f"{len(changes)} changes, {missed} not noticed")
    return missed


def main():
    arguments = sys.argv[1:]
    test = arguments[:1] == ["--self-test"]
    *headers, module = (open(path, encoding="utf-8").read() for path in arguments[test:])
    header = "\n".join(headers)
    if test:
        sys.exit(1 if self_test(header, module) else 0)
    found, functions, constants = differences(header, module)
    for line in found:
        print(line)
    print(f"{functions} functions and {constants} constants compared, {len(found)} differences")
    sys.exit(1 if found or functions == 0 or constants == 0 else 0)


main()
