"""Makes the calls of calls.txt through the C interface, Python, rsc.f90 and rsc77.c, and compares what comes back: every value to the
last bit, every status, every message.

    calls.py generate fortran|77 FILE    writes the program that makes the calls in that language
    calls.py compare [fortran=PROGRAM] [77=PROGRAM] [python]

The C interface is called through ctypes as src/rsc.h declares it. RSC_LIBRARY in the environment: librsc.so.
"""
import collections
import ctypes
import itertools
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
MODULES = os.path.join(HERE, "..", "..", "..", "modules")
sys.path.insert(0, MODULES)
import generate  # noqa: E402

CASE = "&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 /\n&indentation levels=2, 0, -1 /\n&solver max_iterations=1, tolerance=1e-14 /\n&output file='calls.nc' /\n"
# Functions that calls.txt cannot have: called by the runners themselves, or told in other ways by the languages.
NOT_CALLED = {
    "message",
    "status_text",
    "key_count",
    "key_name",
    "lock",
    "unlock",
    "case_run_watched",
    "case_resume",
    "contacts_step",
} | {f"{kind}_destroy" for kind in generate.KINDS}
FUNCTIONS = {f.short: f for f in generate.read_header("rsc.h")[0]}


def noise(k, s):
    return (k * k * s + 29 * k + 7 * s) % 61 / 64


def inputs_of(f):
    """The arguments that stand in calls.txt."""
    return [
        a
        for a in f.arguments
        if a.role in ("handle", "new", "handles", "text", "value", "in")
        and a.name not in ("n", "size")
    ]


def read_calls():
    """[(function, values of the inputs, status, word)] and the arrays."""
    arrays, calls, kinds = {"noise": noise, "nan": math.nan, "inf": math.inf, "None": None}, [], {}
    with open(os.path.join(HERE, "calls.txt"), encoding="utf-8") as file:
        for line in file:
            if re.match(r"[A-Z]\w* = ", line):
                name, expression = line.split(" = ", 1)
                arrays[name] = eval(expression, arrays)
            elif re.match(r"\w+\(", line):
                call, _, wanted = line.strip().partition("  ! ")
                status, _, word = wanted.partition(" ")
                name, words = re.fullmatch(r"(\w+)\((.*)\)", call).groups()
                words = re.findall(r'"(?:[^"])*"|[^,\s][^,]*', words)
                if name == "all":
                    kind = kinds[words[0]]
                    asked = [
                        f.short
                        for f in FUNCTIONS.values()
                        if f.kind == kind
                        and len(inputs_of(f)) == 1
                        and any(a.role in ("out", "array") for a in f.arguments)
                    ]
                    calls += [(one, words, 0, "") for one in asked]
                    continue
                given = inputs_of(FUNCTIONS[name])
                assert len(given) == len(words), line
                for a, w in zip(given, words):
                    if a.role == "new":
                        kinds[w] = a.kind
                calls.append((name, words, int(status or 0), word))
    return calls, arrays


def bits(value):
    if isinstance(value, float):
        return struct.pack(">d", value).hex().upper()
    return str(int(value)) if isinstance(value, int) else value.replace("\n", "|").rstrip()


def handles_of(word, objects):
    return [objects[k] for k in sorted(objects) if k.startswith(word + "[")]


class Rows(collections.defaultdict):
    """{(number of the call, what): values}."""

    def __init__(self):
        super().__init__(list)

    def put(self, k, what, values):
        self[k, what] = " ".join(
            bits(v) for v in (values if isinstance(values, (list, tuple)) else [values])
        )


accepts_null = []  # what does not refuse NULL, and names no argument then


# ---- C -------------------------------------------------------------------------------------------------------------------------
C_TYPES = {"double": ctypes.c_double, "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64}


def by_c(calls, arrays):
    sometimes_none = {
        (name, a.name)
        for name, words, _, _ in calls
        for a, w in zip(inputs_of(FUNCTIONS[name]), words)
        if w == "None"
    }
    without_null = set()
    library, objects, counts, rows = ctypes.CDLL(os.environ["RSC_LIBRARY"]), {}, {}, Rows()

    def number(function, handle, before=0):
        n = ctypes.c_int64()
        getattr(library, function)(handle, *[None] * before, ctypes.byref(n))
        return n.value

    for k, (name, words, _, _) in enumerate(calls):
        f, passed, outputs, alive = FUNCTIONS[name], [], [], []
        given = dict(zip([a.name for a in inputs_of(f)], words))
        sizes = [
            len(arrays[given[a.name]])
            for a in f.arguments
            if a.role == "in" and given[a.name] != "None"
        ]
        n = 0
        if any(a.name == "n" and a.role == "value" for a in f.arguments):
            if sizes:
                n = sizes[0]
            elif name == "surface_heights":
                nx, ny = ctypes.c_int64(), ctypes.c_int64()
                library.rsc_surface_grid(
                    objects[words[0]], ctypes.byref(nx), ctypes.byref(ny), *[None] * 5
                )
                n = nx.value * ny.value
            elif f.kind == "asperities":
                n = number("rsc_asperities_count", objects[words[0]])
            elif name == "friction_spots":
                count = ctypes.c_int64()
                library.rsc_friction_spots(
                    objects[words[0]], ctypes.c_int64(0), ctypes.byref(count), *[None] * 5
                )
                n = count.value
            else:
                n = (
                    counts[words[0]]
                    if name == "contact_per_asperity"
                    else number("rsc_contact_result", objects[words[0]], 3)
                )
        for a in f.arguments:
            word = given.get(a.name)
            if a.role == "new":
                objects[word] = ctypes.c_void_p()
                passed.append(ctypes.byref(objects[word]))
            elif a.role == "handle":
                passed.append(objects[word] if word != "None" else None)
            elif a.role == "handles":
                many = handles_of(word, objects)
                alive.append((ctypes.c_void_p * len(many))(*[h.value for h in many]))
                passed.append(alive[-1])
            elif a.role == "text":
                passed.append(word[1:-1].encode())
            elif a.name == "size":
                passed.append(ctypes.c_int64(30000))
            elif a.role == "value":
                passed.append(
                    C_TYPES[a.type](
                        n
                        if a.name == "n"
                        else float(eval(word, arrays))
                        if a.type == "double"
                        else int(word)
                    )
                )
            elif a.role == "in":
                passed.append(
                    None if word == "None" else (ctypes.c_double * len(arrays[word]))(*arrays[word])
                )
            elif a.role == "buffer":
                outputs.append((a, ctypes.create_string_buffer(30000)))
                passed.append(outputs[-1][1])
            elif a.name == "length":
                passed.append(None)
            else:
                outputs.append(
                    (a, (C_TYPES[a.type] * n)() if a.role == "array" else C_TYPES[a.type]())
                )
                passed.append(outputs[-1][1] if a.role == "array" else ctypes.byref(outputs[-1][1]))
        status = getattr(library, f.name)(*passed)
        if status == 0 and name not in without_null:
            without_null.add(name)
            passed = [
                ctypes.byref(ctypes.c_void_p()) if a.role == "new" else p
                for a, p in zip(f.arguments, passed)
            ]
            for position, a in enumerate(f.arguments):
                optional = (name, a.name) in sometimes_none or (
                    a.role == "handle" and a.kind == "case" and f.kind != "case"
                )
                if a.role in ("new", "handle", "handles", "text", "in", "buffer") and not optional:
                    told = getattr(library, f.name)(
                        *passed[:position], None, *passed[position + 1 :]
                    )
                    if told != -position - 1:
                        accepts_null.append(f"{f.name}: NULL for {a.name} is answered by {told}")
        for a, w in zip(inputs_of(f), words):
            if f.kind == "contact" and f.makes and a.role == "handle" and a.kind != "case":
                counts[words[0]] = (
                    number("rsc_asperities_count", objects[w])
                    if a.kind == "asperities"
                    else counts[w]
                )
        if status:
            text = ctypes.create_string_buffer(4096)
            library.rsc_message(text, ctypes.c_int64(4096), None)
            rows.put(k, "code", f"{status} {text.value.decode()}")
        if status in (0, 1):
            for a, value in outputs:
                rows.put(
                    k,
                    a.name,
                    value.value.decode()
                    if a.role == "buffer"
                    else list(value)
                    if a.role == "array"
                    else value.value,
                )
    return rows


# ---- Python --------------------------------------------------------------------------------------------------------------------
def namelist(value):
    if isinstance(value, tuple):
        return ", ".join(map(namelist, value))
    if isinstance(value, bool):
        return f".{value}.".lower()
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)


def by_python(calls, arrays):
    import numpy as np
    import rsc

    objects, rows = {}, Rows()
    kinds = {
        "case": rsc.Case,
        "surface": rsc.Surface,
        "asperities": rsc.Asperities,
        "contact": rsc.Contact,
        "friction": rsc.Friction,
    }

    def value(a, word):
        if a.role in ("handle", "handles"):
            return (
                handles_of(word, objects)
                if a.role == "handles"
                else objects[word]
                if word != "None"
                else None
            )
        return word[1:-1] if a.role == "text" else eval(word, arrays)

    def make(name, f, v):
        kind, verb = name.split("_", 1)
        if verb == "create":
            return kinds[kind](*v)
        if verb == "copy":
            return v[0].copy()
        if name == "contact_asperities":
            return v[0].asperities()
        if name == "surface_take":
            return rsc.Surface.take(
                np.array(v[7]).reshape(v[1], v[0]), v[2], v[3], v[4], v[5], v[6]
            )
        return getattr(kinds[kind], {"create_from_case": "from_case"}.get(verb, verb))(*v)

    def call(name, f, v):
        """What the language gives back, as {output: value} or values in the order of the outputs."""
        if not f.kind:
            return {
                "version": rsc.version,
                "tangential_ratio": rsc.stiffness_ratio,
                "contacts_press": rsc.press_all,
                "contacts_indent": rsc.indent_all,
            }.get(name, getattr(rsc, name, None))(*v)
        one, verb, rest = v[0], name.split("_", 1)[1], v[1:]
        if name == "contact_result":
            return [one.separation, one.force, one.area, one.contacts]
        if name == "contact_move_tip":
            one.tip = rest
            return []
        if name == "case_set":
            one[rest[0]] = rsc._case._python_value(rest[1])
            return []
        if name == "case_get":
            return namelist(one[rest[0]])
        if name == "case_run":
            one.run()
            return []
        found = len(one) if name == "asperities_count" else getattr(one, verb)
        return found(*rest) if callable(found) else found

    for k, (name, words, _, _) in enumerate(calls):
        f = FUNCTIONS[name]
        v = [value(a, w) for a, w in zip(inputs_of(f), words) if a.role != "new"]
        outputs = [
            a.name
            for a in f.arguments
            if a.role in ("out", "array", "buffer") and a.name not in ("length", "count")
        ]
        try:
            if f.makes:
                objects[words[0]] = make(name, f, v)
                continue
            found = call(name, f, v)
        except rsc.Error as error:
            rows.put(k, "code", f"{error.status} {error}")
            kind = (
                rsc.ArgumentError
                if error.status < 0
                else rsc.NotConverged
                if error.status == 1
                else rsc.Error
            )
            assert type(error) is kind, (name, type(error))
            if error.status != 1:
                continue
            # Not converged: the last iterate can be read.
            found = {
                "contact_indent": lambda: v[0].force,
                "contact_press": lambda: v[0].separation,
                "case_run": lambda: error.failed_levels,
                "friction_update": lambda: [getattr(v[0].state(), name) for name in outputs],
            }[name]()
        if hasattr(found, "_asdict"):
            found = [value for name, value in found._asdict().items() if value is not None]
        if isinstance(found, np.ndarray):
            found = (
                found.ravel().tolist()
                if len(outputs) > 1 and len(outputs) == found.size
                else [found]
            )
        if not isinstance(found, (list, tuple)):
            found = [found]
        for what, values in zip(outputs, found):
            rows.put(
                k,
                what,
                np.ravel(values).tolist()
                if isinstance(values, np.ndarray)
                else bool(values)
                if isinstance(values, np.bool_)
                else values,
            )
    return rows


# ---- Fortran -------------------------------------------------------------------------------------------------------------------
HEAD = """  use, intrinsic :: iso_c_binding, only: dp => c_double, c_int32_t, c_int64_t
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
  implicit none
  real(dp) :: nan, inf, r(20)
  integer :: i(20), stat, n
  integer(c_int32_t) :: each(3)
  logical :: l
  character(4096) :: msg
  real(dp) :: k2(2, 2)
  real(dp), allocatable :: a1(:), a2(:), a3(:), a4(:), a5(:), z(:, :)
  integer, allocatable :: j1(:)
"""
TAIL = """  ! A row: number of the call, what it is, its values, reals bit by bit.
  subroutine put_r(k, what, v)
    integer, intent(in) :: k
    character(*), intent(in) :: what
    real(dp), intent(in) :: v(:)
    if (stat == 0 .or. stat == 1) print '(i0,1x,a,*(1x,z16.16))', k, what, transfer(v, [0_c_int64_t])
  end subroutine
  subroutine put_i(k, what, v)
    integer, intent(in) :: k, v(:)
    character(*), intent(in) :: what
    if (stat == 0 .or. stat == 1) print '(i0,1x,a,*(1x,i0))', k, what, v
  end subroutine
  subroutine put_t(k, what, v)
    integer, intent(in) :: k
    character(*), intent(in) :: what, v
    character(len(v)) :: line
    integer :: m
    line = v
    do m = 1, len(v)
      if (line(m:m) == new_line('a')) line(m:m) = '|'
    end do
    if (stat == 0 .or. stat == 1 .or. what == 'code') print '(i0,3a)', k, ' '//what, ' ', trim(line)
  end subroutine
"""


def literal(word, arrays):
    value = eval(word, arrays)
    return (
        "nan"
        if value != value
        else "inf"
        if value == math.inf
        else f"{value!r}_dp"
        if isinstance(value, float)
        else str(value)
    )


def constants(arrays, used):
    lines = []
    for name, values in arrays.items():
        if name in used:
            lines.append(f"{name}_ = [{', '.join(literal(repr(v), arrays) for v in values)}]")
    return lines


def declared_arrays(arrays, used):
    return [f"  real(dp) :: {name}_({len(arrays[name])})" for name in arrays if name in used]


def program(name, head, arrays, used, before, body, tail):
    blocks, size = [], 40
    parts = [body[k : k + size] for k in range(0, len(body), size)]
    for k, part in enumerate(parts):
        blocks += (
            [f"  subroutine part{k}()"]
            + ["    " + line for lines in part for line in lines]
            + ["  end subroutine"]
        )
    lines = [f"program {name}", *head, *declared_arrays(arrays, used)]
    lines += [
        "  nan = ieee_value(nan, ieee_quiet_nan)",
        "  inf = ieee_value(inf, ieee_positive_inf)",
        "  msg = ''",
    ] + ["  " + line for line in before + constants(arrays, used)]
    lines += [f"  call part{k}()" for k in range(len(parts))] + [
        "contains",
        *blocks,
        tail,
        "end program",
    ]
    return (
        "\n".join(
            " &\n      &".join(re.findall(r".{1,110}(?:$|(?<=[ ,(]))|.{1,110}", line))
            if len(line) > 120
            else line
            for line in "\n".join(lines).splitlines()
        )
        + "\n"
    )


FREE = {
    "version": "rsc_library_version",
    "tangential_ratio": "rsc_stiffness_ratio",
    "stiffness_ratio": "rsc_stiffness_ratio",
    "contacts_press": "rsc_press_all",
    "contacts_indent": "rsc_indent_all",
}


def signatures():
    """{procedure: (dummies, result, {variable: declaration})} of the Fortran module."""
    found = {}
    for path in ("rsc.f90", "generated/wrappers.inc"):
        with open(os.path.join(MODULES, path), encoding="utf-8") as file:
            text = re.sub(r"\s*&\s*\n\s*&?", " ", re.sub(r"!.*", "", file.read()))
        for kind, name, dummies, _, result, body in re.findall(
            r"^  (subroutine|function) (\w+)\(([^)]*)\)( result\((\w+)\))?\n(.*?)^  end \1",
            text,
            flags=re.M | re.S,
        ):
            variables = {}
            for line in body.splitlines():
                left, colons, right = line.partition("::")
                if colons:
                    variables.update(
                        {
                            v: left.strip() + (shape or "")
                            for v, shape in re.findall(r"(\w+)(\([^)]*\))?", right)
                        }
                    )
            found[name] = ([d.strip() for d in dummies.split(",") if d.strip()], result, variables)
    return found


def in_fortran(calls, arrays):
    known, objects, body, used = signatures(), {}, [], set()
    for k, (name, words, _, _) in enumerate(calls):
        f = FUNCTIONS[name]
        given = dict(zip([a.name for a in inputs_of(f)], words))
        roles = {a.name: a for a in f.arguments}
        used |= {w for w in words if w in arrays and w not in ("nan", "inf", "None")}
        for a, w in zip(inputs_of(f), words):
            if a.role in ("new", "handle") and w != "None":
                objects[w] = a.kind
        call = lambda word: word.replace("[", "(").replace("]", ")")
        if name.endswith("_copy"):
            asperities_of[words[0]] = asperities_of.get(words[1])
            body.append([f"call {call(words[0])}%copy({call(words[1])})"])
            continue
        if name == "contact_result":
            lines = []
            for m, what in enumerate(("separation", "force", "area", "contacts")):
                lines += [
                    f"{'i' if what == 'contacts' else 'r'}({m + 1}) = {words[0]}%{what}(stat, msg)",
                    f"call told({k})",
                    f"call put_{'i' if what == 'contacts' else 'r'}({k}, '{what}', [{'i' if what == 'contacts' else 'r'}({m + 1})])",
                ]
            body.append(lines)
            continue
        if name == "case_create":  # an object that was never set holds the defaults
            continue
        dummies, result, variables = known[
            FREE.get(name, {"case_set": "case_set_text"}.get(name, name))
        ]
        arguments, puts, reals, integers, reallocated = (
            [],
            [],
            itertools.count(1),
            itertools.count(1),
            itertools.count(1),
        )
        before, after = [], []

        def output(dummy, what, a):
            """A variable for an output, and how it is printed."""
            kind = variables[dummy]
            if a.role == "buffer":
                return None
            if "(2, 2)" in kind:
                puts.extend(
                    f"call put_r({k}, '{w}', [k2({m}, {n})])"
                    for w, m, n in (("xx", 1, 1), ("xy", 1, 2), ("yx", 2, 1), ("yy", 2, 2))
                )
                return "k2"
            if kind.startswith("logical"):
                puts.append(f"call put_i({k}, '{what}', [merge(1, 0, l)])")
                return "l"
            if "(:,:)" in kind:
                before.extend(
                    [
                        f"call {words[0]}%grid(nx=i(1), ny=i(2))",
                        "if (allocated(z)) deallocate (z)",
                        "allocate (z(i(1), i(2)))",
                    ]
                )
                puts.append(f"call put_r({k}, '{what}', [z])")
                return "z"
            if "(:)" in kind and "c_int32_t" in kind:
                puts.append(f"call put_i({k}, '{what}', int(each))")
                return "each"
            if "(:)" in kind and kind.startswith("integer"):
                puts.append(f"call put_i({k}, '{what}', j1 - 1)")
                return "j1"
            if "(:)" in kind:
                variable = f"a{next(reallocated)}"
                if "allocatable" not in kind:
                    size = (
                        f"size({[w for w in words if w in arrays and w not in ('nan', 'inf', 'None')][0]}_)"
                        if any(w in arrays and w not in ("nan", "inf", "None") for w in words)
                        else "n"
                    )
                    if size == "n" and "n = " not in " ".join(before):
                        before.append(f"n = {asperities_of.get(words[0], '')}%count()")
                    before.extend(
                        [
                            f"if (allocated({variable})) deallocate ({variable})",
                            f"allocate ({variable}({size}))",
                        ]
                    )
                puts.append(f"call put_r({k}, '{what}', {variable})")
                return variable
            letter, m = ("i", next(integers)) if kind.startswith("integer") else ("r", next(reals))
            puts.append(f"call put_{letter}({k}, '{what}', [{letter}({m})])")
            return f"{letter}({m})"

        single = []
        for dummy in dummies:
            if dummy in ("self", "stat", "errmsg"):
                continue
            c = (
                dummy
                if dummy in roles
                else {"options": "a_case", "z": "heights", "each": "status"}.get(dummy)
            )
            a = roles[c]
            if c in given:
                word = given[c]
                if word == "None":
                    continue
                if a.role == "text":
                    text = "'" + word[1:-1].replace("'", "''") + "'"
                elif a.role == "in":
                    text = (
                        f"reshape({word}_, [{words[1]}, {words[2]}])"
                        if "(:,:)" in variables[dummy]
                        else word + "_"
                    )
                elif a.role == "value":
                    text = (
                        {"1": ".true.", "0": ".false."}[word]
                        if variables[dummy].startswith("logical")
                        else literal(word, arrays)
                        if a.type == "double"
                        else word
                    )
                else:
                    text = call(word)
                arguments.append(f"{dummy}={text}")
            else:
                printed = len(puts)
                arguments.append(f"{dummy}={output(dummy, c, a)}")
                single.append((arguments[-1], puts[printed:], list(before)))
        target = (
            FREE.get(name)
            or f"{call(words[0])}%{'of_contact' if name == 'contact_asperities' else name.split('_', 1)[1]}"
        )
        tail = [] if name == "version" else ["stat=stat", "errmsg=msg"]
        if result:
            a = next(
                (
                    x
                    for x in f.arguments
                    if x.role in ("out", "buffer", "array") and x.name != "length"
                ),
                None,
            )
            if a.role == "buffer":
                lines = [
                    f"call put_t({k}, '{a.name}', {target}({', '.join(arguments + tail)}))"
                    if not tail
                    else f"call ask_text({k}, '{a.name}', {target}({', '.join(arguments + tail)}))"
                ]
            else:
                lines = [f"{output(result, a.name, a)} = {target}({', '.join(arguments + tail)})"]
        else:
            lines = [f"call {target}({', '.join(arguments + tail)})"]
        if f.makes:
            source = next(
                (
                    w
                    for a, w in zip(inputs_of(f), words)
                    if a.role == "handle" and a.kind == "asperities"
                ),
                None,
            )
            asperities_of[words[0]] = source
        lines = before + lines + [f"call told({k})"] + puts
        # Each output asked for alone is the same.
        if (
            len(single) > 1 and len(inputs_of(f)) == 1 and name != "friction_spots"
        ):  # whose numbers are those of a new solution
            for argument, put, _ in single:
                lines += [
                    f"call {target}({argument}, stat=stat, errmsg=msg)",
                    f"call told({k})",
                    *put,
                ]
        body.append(lines)
    kinds = collections.defaultdict(set)
    for name, kind in objects.items():
        kinds[kind].add(re.sub(r"\[.*", "(3)", name))
    declared = [
        f"  type(rsc_{kind}) :: {', '.join(sorted(names))}" for kind, names in kinds.items()
    ]
    told = """  ! Of success nothing is printed; errmsg keeps its value then.
  subroutine told(k)
    integer, intent(in) :: k
    character(12) :: code
    write (code, '(i0)') stat
    if (stat /= 0) call put_t(k, 'code', trim(code) // ' ' // msg)
    if (stat == 0 .and. msg /= '') call put_t(k, 'code', 'a message without failure: ' // msg)
    msg = ''
  end subroutine
  subroutine ask_text(k, what, text)
    integer, intent(in) :: k
    character(*), intent(in) :: what, text
    call put_t(k, what, text)
  end subroutine
"""
    return program(
        "calls", ["  use rsc", HEAD, *declared], arrays, used, ["stat = 0"], body, told + TAIL
    )


asperities_of = {}  # of a contact: what it was made of
made_in_77 = set()  # numbers of the calls that FORTRAN 77 makes


def in_77(calls, arrays):
    """The calls whose function has a name in FORTRAN 77; every one with handles is tried with one that is none first."""
    names = {
        words.split()[0]: (name, words.split()[1:]) for name, words in generate.NAMES_77.items()
    }
    names.update(
        case_get=("rscget", ["size", "length"]),
        contact_spots=("rscspt", []),
        version=("rscver", ["size", "length"]),
    )
    names.update({f"{kind}_copy": ("rsccpy", []) for kind in generate.KINDS})
    made, body, used, tried, handles_77, total = (
        {},
        [],
        set(),
        set(),
        itertools.count(1),
        len({w for _, words, _, _ in calls for w in words[:1]}),
    )
    for k, (name, words, _, _) in enumerate(calls):
        f = FUNCTIONS[name]
        given = dict(zip([a.name for a in inputs_of(f)], words))
        handles = [w for a, w in zip(inputs_of(f), words) if a.role == "handle" and w != "None"]
        called, left_out = names.get(name, ("", []))
        if (
            not called
            or any(w not in made for w in handles)
            or any(given.get(a, "None") != "None" for a in left_out)
        ):
            if (
                f.makes
                or f.kind in ("case", "surface")
                and not f.arguments[0].const
                or name.endswith("_save")
            ):
                made.pop(words[0], None)  # it is not what it is in the other languages
            continue
        arguments, puts, before, positions = [], [], [], []
        reals, integers, room = itertools.count(1), itertools.count(1), itertools.count(1)
        for a in f.arguments:
            word = given.get(a.name)
            if a.name in left_out:
                continue
            if a.role == "new":
                made[word] = made.get(word) or next(handles_77)
                arguments.append(f"h({made[word]})")
            elif a.role == "handle":
                arguments.append(f"h({made[word]})" if word != "None" else "0")
                positions.append(len(arguments))
            elif a.role == "text":
                arguments.append("'" + word[1:-1].replace("'", "''") + "'")
            elif a.role == "buffer":
                arguments.append("text")
                puts.append(f"call put_t({k}, '{a.name}', text)")
            elif a.name == "n" and a.role == "value":
                sizes = [w for w in words if w in arrays and w not in ("nan", "inf", "None")]
                counted = {
                    "asperities": f"call rscnum({arguments[0]}, n, stat)",
                    "contact": f"call rscres({arguments[0]}, r(1), r(2), r(3), n, stat)",
                    "surface": f"n = points({made[words[0]]})",
                }
                before.append(f"n = size({sizes[0]}_)" if sizes else counted[f.kind])
                arguments.append("n")
            elif a.role == "value":
                arguments.append(literal(word, arrays) if a.type == "double" else word)
            elif a.role == "in":
                arguments.append(word + "_")
                used.add(word)
            elif a.role == "array" and a.type == "int32_t":
                arguments.append("j")
                puts.append(f"call put_i({k}, '{a.name}', j(:n) - 1)")
            elif a.role == "array":
                arguments.append(f"a(:, {next(room)})")
                puts.append(f"call put_r({k}, '{a.name}', {arguments[-1].replace(':', ':n')})")
            else:
                letter, m = ("r", next(reals)) if a.type == "double" else ("i", next(integers))
                arguments.append(f"{letter}({m + 10})")
                puts.append(f"call put_{letter}({k}, '{a.name}', [{letter}({m + 10})])")
        if name == "surface_copy":
            before.append(f"points({made[words[0]]}) = points({made[words[1]]})")
        if name in ("surface_take", "surface_synthesize"):
            before.append(
                f"points({made[words[0]]}) = {int(words[1]) * int(words[2]) if name == 'surface_take' else 64 * 64}"
            )
        made_in_77.add(k)
        lines = []
        if called not in tried:
            for position in positions:
                wrong = arguments[: position - 1] + ["9999"] + arguments[position:]
                lines += [
                    f"call {called}({', '.join(wrong)}, stat)",
                    f"call no_handle('{called}', {position})",
                ]
            tried.add(called)
        ending = "" if called == "rscver" else ", stat"
        body.append(
            before
            + lines
            + [f"call {called}({', '.join(arguments)}{ending})", f"call told({k})", *puts]
        )
    externals = sorted({*(n for n, _ in names.values()), "rscmsg", "rscdel", "rscint", "rscdbl"})
    head = [
        HEAD.replace(
            "integer :: i(20), stat, n",
            f"integer :: i(20), stat, n, m, j(5000), h({total}), points({total})",
        ).replace(
            "  real(dp), allocatable",
            "  real(dp) :: a(5000, 4)\n  character(30000) :: text\n  real(dp), allocatable",
        )
    ]
    head += [f"  external :: {name}" for name in externals]
    told = """  subroutine told(k)
    integer, intent(in) :: k
    character(12) :: code
    if (stat == 0) return
    call rscmsg(msg)
    write (code, '(i0)') stat
    call put_t(k, 'code', trim(code) // ' ' // msg)
  end subroutine
  subroutine no_handle(name, position)
    character(*), intent(in) :: name
    integer, intent(in) :: position
    call rscmsg(msg)
    if (stat /= -position .or. index(msg, 'handle') == 0) print '(i0,4a)', 0, ' ', name, ' takes a number that is no handle: ', trim(msg)
    stat = 0
  end subroutine
"""
    body.append(
        [
            f"do m = 1, {total}",
            "  call rscdel(h(m), stat)",
            "  if (stat /= 0 .or. h(m) /= 0) print '(a)', '0 rscdel does not delete'",
            "end do",
            "call rscdel(9999, stat)",
            "call no_handle('rscdel', 1)",
        ]
    )
    return program(
        "calls77",
        head,
        arrays,
        used,
        [
            "stat = 0",
            "h = 0",
            "i(:2) = [1, 2]",
            "call rscint(i, stat)",
            "r(:2) = [1, 2]",
            "call rscdbl(r, stat)",
        ],
        body,
        told + TAIL,
    )


# ---- comparing -----------------------------------------------------------------------------------------------------------------
def rows_of(program_path):
    rows, repeated = {}, []
    for line in (
        subprocess.run([program_path], check=True, stdout=subprocess.PIPE)
        .stdout.decode()
        .splitlines()
    ):
        k, what, values = (line + "  ").split(" ", 2)
        if rows.setdefault((int(k), what), values.strip()) != values.strip():
            repeated.append(f"{line} where it is asked for alone")
    return rows, repeated


def main():
    calls, arrays = read_calls()
    if sys.argv[1] == "generate":
        with open(sys.argv[3], "w", encoding="utf-8") as out:
            out.write({"fortran": in_fortran, "77": in_77}[sys.argv[2]](calls, arrays))
        return
    wrong = [
        f"calls.txt does not call {name}"
        for name in FUNCTIONS
        if name not in NOT_CALLED | {c[0] for c in calls}
    ]
    languages = dict(word.partition("=")[::2] for word in sys.argv[2:])
    compared = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open("calls.nml", "w", encoding="utf-8") as out:
            out.write(CASE)
        reference = by_c(calls, arrays)
        wrong += accepts_null
        for k, (name, words, status, word) in enumerate(calls):
            found = reference.get((k, "code"), "0 ")
            if int(found.split()[0]) != status or word not in found:
                wrong.append(f"{name}({', '.join(words)}): {found}; expected {status} {word}")
        for f in FUNCTIONS.values():
            if f.short in NOT_CALLED:
                continue
            outputs = [a for a in f.arguments if a.role in ("out", "array") and a.name != "length"]
            for one, other in itertools.combinations(outputs, 2):
                places = [
                    k
                    for k, call in enumerate(calls)
                    if call[0] == f.short and (k, one.name) in reference
                ]
                if one.type == other.type and all(
                    reference[k, one.name] == reference[k, other.name] for k in places
                ):
                    wrong.append(
                        f"{f.name}: {one.name} and {other.name} are alike wherever calls.txt asks for them"
                    )
        for language, path in languages.items():
            if language == "python":
                rows = by_python(calls, arrays)
                wanted = {
                    key: v
                    for key, v in reference.items()
                    if key[1] not in ("count",)
                    and not (
                        calls[key[0]][0] == "friction_first_loading"
                        and key[1] == "stick_separation"
                    )
                    and not (
                        calls[key[0]][0].startswith("contacts_")
                        and key[1] == "code"
                        and v.startswith("1 ")
                    )
                }
            else:
                rows, repeated = rows_of(path)
                wrong += [f"{language}: {line}" for line in repeated]
                if language == "77":
                    in_77(calls, arrays)
                wanted = (
                    reference
                    if language == "fortran"
                    else {key: v for key, v in reference.items() if key[0] in made_in_77}
                )
                wanted = {key: v for key, v in wanted.items() if key[1] != "count"}
            compared += len(rows)
            for k, what in sorted(set(wanted) | set(rows)):
                if wanted.get((k, what)) != rows.get((k, what)):
                    call = f"{calls[k][0]}({', '.join(calls[k][1])})"
                    wrong.append(
                        f"{language}: {call}, {what}: {str(rows.get((k, what)))[:200]}; by rsc.h: {str(wanted.get((k, what)))[:200]}"
                    )
        os.chdir("/")
    print("\n".join(wrong))
    print(
        f"{len(calls)} calls, {len(reference)} values by rsc.h, {compared} compared, {len(wrong)} wrong"
    )
    sys.exit(1 if wrong or (languages and compared < 200) else 0)


main()
