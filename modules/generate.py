#!/usr/bin/env python3
"""Writes the parts of the bindings that follow from the C interface, from src/rsc.h.

    python3 modules/generate.py            writes the files below
    python3 modules/generate.py --check    writes nothing; exit status 1 if one of them is stale,
                                           or if rsc.f90 lacks a procedure

    modules/generated/interface.inc   status codes and interfaces of all C functions, for rsc.f90
    modules/generated/wrappers.inc    the generated procedures of the derived types, for rsc.f90
    modules/generated/rsc77.inc       the generated subroutines of FORTRAN 77, for rsc77.c
    modules/rsc/_h.py                 status codes and arguments of all C functions, for Python

They are part of the source: building and installing rsc needs no Python. Procedures written by hand
in rsc.f90 or rsc77.c are not generated. Optional arguments are those that the comments of rsc.h
mark as "may be null"."""
import os
import re
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
KINDS = ("case", "surface", "asperities", "contact", "friction")

# The names in FORTRAN 77. Arguments that FORTRAN 77 omits, and passes as null, follow the name.
NAMES_77 = {
    "rsccas": "case_create",
    "rscred": "case_read",
    "rscset": "case_set",
    "rscrun": "case_run",
    "rscsyn": "surface_synthesize",
    "rscsur": "surface_take",
    "rschgt": "surface_heights",
    "rscfnd": "asperities_find",
    "rscmak": "asperities_make",
    "rscasp": "asperities_take kappa1 kappa2 angle biharmonic",
    "rscnum": "asperities_count",
    "rscxyz": "asperities_get",
    "rsccon": "contact_create",
    "rsccnc": "contact_create_from_case",
    "rsctip": "contact_move_tip",
    "rsctch": "contact_first_touch",
    "rscind": "contact_indent",
    "rscprs": "contact_press",
    "rscres": "contact_result",
    "rsclev": "contact_level",
    "rscstf": "contact_stiffness",
    "rscnrg": "contact_energy",
    "rscdfl": "contact_deflection",
    "rsccom": "contact_commit",
    "rscrol": "contact_rollback",
    "rscsav": "contact_save",
    "rscrst": "contact_restore",
    "rscfsv": "friction_save",
    "rscfrs": "friction_restore",
    "rscftp": "friction_move_tip",
    "rscfri": "friction_create_from_case",
    "rscupd": "friction_update",
    "rsccmt": "friction_commit",
    "rscrbk": "friction_rollback",
}
# Inputs that are optional in Fortran, with their defaults.
DEFAULTS = {"realization": "1"}
# C functions that Fortran has under another name or within another procedure.
ELSEWHERE = {"contact_result", "case_create", "case_set", "case_resume"}


class Argument:
    """One argument of a C function. role: handle, new (address of a handle), handles (an array of
    them), text, buffer, value, callback, in (array), out (scalar) or array (output)."""

    def __init__(self, function, words, optional, has_n, first):
        match = re.fullmatch(r"(const )?(\w+)(\**) (\w+)", " ".join(words.split()))
        if not match:
            raise SystemExit(f"generate.py: {function}: argument not understood: {words}")
        self.const, self.type, self.stars, self.name = (
            bool(match[1]),
            match[2],
            len(match[3]),
            match[4],
        )
        self.optional = self.name in optional
        if self.type == "void" or self.type.startswith("rsc_"):
            self.kind = self.type[4:]
            self.role = {0: "callback", 1: "handle", 2: "new" if first else "handles"}[self.stars]
        elif self.type == "char":
            self.role = "text" if self.const else "buffer"
        elif not self.stars:
            self.role = "value"
        elif self.const:
            self.role = "in"
        else:
            self.role = "array" if has_n and self.type != "int64_t" else "out"

    def c(self):
        return f"{'const ' if self.const else ''}{self.type}{'*' * self.stars} {self.name}"


class Function:
    def __init__(self, name, arguments, comment):
        self.name, self.short = name, name[4:]
        self.comment = " ".join(re.sub(r"\n \*", "\n", comment).split())
        words = [] if arguments.strip() in ("", "void") else arguments.split(",")
        outputs = {w.split()[-1] for w in words if "*" in w and not w.strip().startswith("const")}
        named = {
            n
            for group in re.findall(
                r"((?:\w+, )*\w+) \((?:in and )?out, may be null\)", self.comment
            )
            for n in group.split(", ")
        }
        named |= {
            n
            for group in re.findall(
                r"((?:\w+, )*\w+)(?::[^;]*)? all three or none of them \(null\)", self.comment
            )
            for n in group.split(", ")
        }
        if re.search(r"(All|Both) outputs may be null", self.comment):
            named |= outputs
        for word in outputs | {w.split()[-1] for w in words if "*" in w}:
            if re.search(rf"\b{word}: [^;]*, or null\b", self.comment) or word == "length":
                named.add(word)
        if self.short == "asperities_take":
            named |= {"kappa1", "kappa2", "angle"}  # all three or none
        if self.short in ("contacts_press", "contacts_indent"):
            named |= {"separation" if self.short == "contacts_press" else "force", "status"}
        if self.short == "contacts_step":
            named |= outputs | {"x0", "y0"}
        has_n = any(re.fullmatch(r"\s*int64_t n", w) for w in words)
        self.arguments = [Argument(name, w, named, has_n, w is words[0]) for w in words]
        first = self.arguments[0] if self.arguments else None
        self.kind = (
            first.kind
            if first and first.role in ("handle", "new") and first.type != "void"
            else None
        )
        self.makes = bool(first) and first.role == "new"

    def brief(self):
        """The first sentence of its comment."""
        return re.split(r"(?<=\.)\s", self.comment + " ")[0]


def read_header(*names):
    functions, constants = [], []
    for name in names:
        with open(os.path.join(HERE, "..", "src", name), encoding="utf-8") as file:
            text = file.read()
        constants += re.findall(r"X\((RSC_\w+), (-?\d+),", text)
        found = re.findall(
            r"(?:/\*((?:(?!\*/).)*)\*/\s*)?RSC_API\s+int32_t\s+(\w+)\(([^;]*)\)\s*;",
            text,
            flags=re.S,
        )
        if len(found) != len(re.findall(r"^RSC_API\b", text, flags=re.M)):
            raise SystemExit(f"generate.py: {name}: a declaration is not understood")
        functions += [
            Function(function, arguments, comment) for comment, function, arguments in found
        ]
    return functions, constants


# ---- Fortran -------------------------------------------------------------------------------------
REAL, LONG, SHORT = "real(c_double)", "integer(c_int64_t)", "integer(c_int32_t)"
C_TYPES = {"double": REAL, "int64_t": LONG, "int32_t": SHORT}


def wrapped(line, indent=2):
    """A Fortran line, continued where it is longer than 100."""
    if len(line) + indent <= 100:
        return " " * indent + line
    return " &\n".join(
        textwrap.wrap(
            line,
            96,
            initial_indent=" " * indent,
            subsequent_indent=" " * (indent + 4),
            break_long_words=False,
            break_on_hyphens=False,
        )
    )


def comment(text):
    return "\n".join(textwrap.wrap(text, 100, initial_indent="  !> ", subsequent_indent="  !> "))


def declarations(pairs):
    """Lines `type :: a, b` of (type, variable), with the variables of one type on one line."""
    lines = {}
    for kind, variable in pairs:
        lines.setdefault(kind, []).append(variable)
    return [
        wrapped(f"{kind} :: {', '.join(variables)}", 6)[2:] for kind, variables in lines.items()
    ]


def interface_type(a):
    """(declaration, variable) of an argument for the C interface. Outputs are intent(inout): after
    a failure they keep their value."""
    optional = ", optional" if a.optional else ""
    if a.role == "callback":
        return "type(c_funptr), value", a.name
    if a.role == "handle":
        return "type(c_ptr), value", a.name
    if a.role in ("new", "handles"):
        return "type(c_ptr), intent(inout)", a.name + ("(*)" if a.role == "handles" else "")
    if a.role in ("text", "buffer"):
        return (
            f"character(kind=c_char), intent({'in' if a.const else 'inout'})"
            + ("" if a.role == "buffer" else optional),
            a.name + "(*)",
        )
    if a.role == "value":
        return C_TYPES[a.type] + ", value", a.name
    return f"{C_TYPES[a.type]}, intent({'in' if a.role == 'in' else 'inout'}){optional}", a.name + (
        "(*)" if a.role in ("in", "array") else ""
    )


def interface(functions, constants):
    lines = ["  !> Status codes of calls and levels."]
    lines += [
        f"  integer, parameter, public :: {name.lower()} = {value}" for name, value in constants
    ]
    lines += [
        "",
        "  ! Outputs are intent(inout): they keep their value when the function fails.",
        "  interface",
    ]
    with open(os.path.join(HERE, "rsc.f90"), encoding="utf-8") as file:
        own = set(
            re.findall(r"^ *function (rsc_\w+)\(", file.read(), flags=re.M)
        )  # procedures of rsc.f90 with the name of a C function
    for f in functions:
        if f.name in own:
            continue
        body = declarations([interface_type(a) for a in f.arguments])
        names = ", ".join(a.name for a in f.arguments)
        lines += [
            wrapped(f"integer(c_int32_t) function {f.name}({names}) bind(c)", 4),
            "      import :: "
            + ", ".join(
                k
                for k in ("c_char", "c_double", "c_funptr", "c_int32_t", "c_int64_t", "c_ptr")
                if k == "c_int32_t" or re.search(rf"\b{k}\b", "\n".join(body))
            ),
            *["  " + line for line in body],
            "    end function",
        ]
    return lines + ["  end interface"]


ERROR_ARGUMENTS = [
    "integer, intent(out), optional :: stat",
    "character(*), intent(inout), optional :: errmsg",
]


def wrapper(f):
    """A procedure of a derived type that only calls its C function; None if there is no rule for
    its arguments."""
    arguments = f.arguments
    result, single = None, [a for a in arguments if a.role == "out"]
    if (
        len(single) == 1
        and not single[0].optional
        and not any(a.role == "array" for a in arguments)
    ):
        result = single[0]
    inputs = [a for a in arguments if a.role == "in"]
    room = (
        f.kind == "asperities" and not inputs and any(a.role == "array" for a in arguments)
    )  # True if the procedure allocates the output arrays
    dummies, declared, local, before, call, after = ["self"], [], [], [], [], []
    for k, a in enumerate(arguments):
        if k == 0:
            declared.append(
                (f"class(rsc_{f.kind}), intent({'in' if a.const else 'inout'})", "self")
            )
            call.append("handle" if f.makes else f"rsc_handle_of(self%number)")
            continue
        if a.role == "value" and a.name == "n":
            call.append(
                "n" if room else f"size({inputs[0].name}, kind=c_int64_t)" if inputs else ""
            )
            if not inputs and not room:
                return None
            continue
        dummy = "options" if a.role == "handle" and a.kind == "case" else a.name
        if a is not result:
            dummies.append(dummy)
        if a.role == "handle":
            declared.append(
                (
                    f"class(rsc_{a.kind}), intent({'in' if a.const else 'inout'})"
                    + (", optional" if a.kind == "case" else ""),
                    dummy,
                )
            )
            call.append(
                "options_of(options)" if a.kind == "case" else f"rsc_handle_of({a.name}%number)"
            )
        elif a.role == "text":
            declared.append(("character(*), intent(in)", a.name))
            call.append(f"terminated(trim({a.name}))")
        elif a.role == "value" and a.type == "double":
            declared.append((REAL + ", intent(in)", a.name))
            call.append(a.name)
        elif a.role == "value":
            declared.append(
                ("integer, intent(in)" + (", optional" if a.name in DEFAULTS else ""), a.name)
            )
            if a.name in DEFAULTS:
                local.append((C_TYPES[a.type], a.name + "_"))
                before += [
                    f"{a.name}_ = {DEFAULTS[a.name]}",
                    f"if (present({a.name})) {a.name}_ = {a.name}",
                ]
            call.append(a.name + "_" if a.name in DEFAULTS else f"int({a.name}, c_{a.type})")
        elif a.role == "in" and a.type == "double":
            declared.append(
                (
                    REAL + ", intent(in)" + (", contiguous, optional" if a.optional else ""),
                    a.name + "(:)",
                )
            )
            call.append(a.name)
        elif a.role == "array" and a.type == "double" and room:
            declared.append((REAL + ", intent(out), allocatable, optional", a.name + "(:)"))
            local.append((REAL + ", allocatable", a.name + "_(:)"))
            before.append(f"if (present({a.name})) call make_room({a.name}_, n, status)")
            call.append(a.name + "_")
            after.append(f"if (present({a.name})) call move_alloc({a.name}_, {a.name})")
        elif a.role == "array" and a.type == "double":
            declared.append(
                (
                    REAL + ", intent(out), contiguous" + (", optional" if a.optional else ""),
                    a.name + "(:)",
                )
            )
            call.append(a.name)
        elif a.role == "out" and a.type == "double":
            if a is result:
                declared.append((REAL, a.name))
                before.append(f"{a.name} = 0")
            else:
                declared.append(
                    (REAL + ", intent(out)" + (", optional" if a.optional else ""), a.name)
                )
            call.append(a.name)
        elif a.role == "out":
            local.append((C_TYPES[a.type], a.name + "_"))
            before.append(a.name + "_ = 0")
            call.append(a.name + "_")
            declared.append(
                (
                    "integer"
                    + (
                        ""
                        if a is result
                        else ", intent(out)" + (", optional" if a.optional else "")
                    ),
                    a.name,
                )
            )
            after.append(
                f"{'if (present(' + a.name + ')) ' if a.optional else ''}{a.name} = int({a.name}_)"
            )
        else:
            return None
    refusal, verb = [], f.short.split("_", 1)[1]
    if inputs:
        first, *others = [a for a in arguments if a.role in ("in", "array")]
        for a in others:
            number = f.arguments.index(a) + 1
            present = f"if (present({a.name})) " if a.optional else ""
            refusal.append(
                f"{present}call compare({number}, '{a.name}', shape({a.name}), "
                f"shape({first.name}), unlike)"
            )
        refusal.append(f"if (refused('{f.kind}%{verb}', unlike, stat, errmsg)) return")
        local.append(("type(difference)", "unlike"))
    if f.makes:
        local += [(SHORT, "status"), ("type(c_ptr)", "handle")]
        before = [
            "call self%free()",
            *refusal,
            *before,
            "handle = c_null_ptr",
        ]
        after.insert(0, "call keep(self%number, handle, status)")
    else:
        before = refusal + before
        if room:
            local += [(LONG, "n")]
            before = [
                "n = 0",
                "status = rsc_asperities_count(rsc_handle_of(self%number), n)",
                *before,
            ]
        if after:
            local.append((SHORT, "status"))
    called = f"{f.name}({', '.join(call)})"
    if after:
        body = [
            *before,
            f"{'if (status == rsc_success) ' if room else ''}status = {called}",
            *after,
            "call finish(status, stat, errmsg)",
        ]
    else:
        body = [*before, f"call finish({called}, stat, errmsg)"]
    kind = "function" if result else "subroutine"
    arguments = ", ".join([*dummies, "stat", "errmsg"])
    returns = f" result({result.name})" if result else ""
    order = sorted(declared, key=lambda pair: result is not None and pair[1] == result.name)
    return [
        comment(f.brief()),
        wrapped(f"{kind} {f.short}({arguments}){returns}"),
        *declarations([pair for pair in order if not result or pair[1] != result.name]),
        *["    " + line for line in ERROR_ARGUMENTS],
        *declarations([pair for pair in order if result and pair[1] == result.name] + local),
        *[wrapped(line, 4) for line in body],
        f"  end {kind}",
        "",
    ]


def ownership(kind):
    """Copy and release of a derived type."""
    return f"""  !> Its own copy of another object; what this one held is released, unless both are
  !> one object.
  subroutine {kind}_copy(self, original, stat, errmsg)
    class(rsc_{kind}), intent(inout) :: self
    class(rsc_{kind}), intent(in) :: original
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    type(c_ptr) :: handle
    handle = c_null_ptr
    status = rsc_{kind}_copy(handle, rsc_handle_of(original%number))
    if (status == rsc_success .and. self%number /= original%number) call self%free()
    call keep(self%number, handle, status)
    call finish(status, stat, errmsg)
  end subroutine

  !> Releases the object; nothing happens if there is none.
  subroutine {kind}_free(self, stat, errmsg)
    class(rsc_{kind}), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    handle = rsc_handle_taken(self%number)
    self%number = 0
    call finish(rsc_{kind}_destroy(handle), stat, errmsg)
  end subroutine
""".splitlines() + [
        ""
    ]


def procedures_of(source):
    return set(
        re.findall(
            r"^\s*(?:impure |elemental )*(?:subroutine|(?:[\w()]+ )?function) (\w+)",
            source,
            flags=re.M,
        )
    )


def wrappers(functions, source):
    """The lines of wrappers.inc, and a list of changes to make in rsc.f90 by hand."""
    by_hand, lines, wanted = procedures_of(source), [], []
    for kind in KINDS:
        bound = re.search(rf"^  type :: rsc_{kind}\n.*?^  end type", source, flags=re.M | re.S)[0]
        for f in functions:
            if f.kind != kind or f.short in ELSEWHERE or f.short.endswith(("_copy", "_destroy")):
                continue
            if f"=> {f.short}\n" not in bound:
                wanted.append(
                    f"modules/rsc.f90, type rsc_{kind}: add  "
                    f"procedure :: {f.short.split('_', 1)[1]} => {f.short}"
                )
            if f.short in by_hand:
                continue
            made = wrapper(f)
            if made is None:
                wanted.append(
                    f"modules/rsc.f90: write the procedure {f.short} by hand; "
                    "there is no rule for its arguments"
                )
            else:
                lines += made
        if f"{kind}_copy" not in by_hand:
            lines += ownership(kind)
    return lines[:-1], wanted


# ---- FORTRAN 77 ----------------------------------------------------------------------------------
def subroutine_77(name, f, left_out):
    """A subroutine of FORTRAN 77: arguments by address, handles as INTEGER, lengths of texts after
    all arguments."""
    parameters, lengths, find, before, call, after, position = [], [], [], [], [], [], 0
    for k, a in enumerate(f.arguments):
        if a.name in left_out:
            call.append("NULL")
            continue
        position += 1
        if a.role == "new":
            parameters.append(f"int32_t* handle")
            find.append(f"{a.type}* made = NULL;")
            call.append("&made")
            after.append(f"ENTER({a.kind.upper()}, made, handle)")
        elif a.role == "handle":
            parameters.append(f"const int32_t* i_{a.name}")
            const = "const " if a.const else ""
            find.insert(
                position - 1 - bool(f.makes),
                f"FIND_CASE({a.name}, i_{a.name}, {position})"
                if a.kind == "case" and k
                else f"FIND({const}{a.type}, {a.name}, i_{a.name}, {a.kind.upper()}, {position})",
            )
            call.append(a.name)
        elif a.role == "text":
            parameters.append(f"const char* {a.name}")
            lengths.append(f"size_t {a.name}_length")
            before.append(f"char* const c_{a.name} = text_of({a.name}, {a.name}_length);")
            call.append("c_" + a.name)
        elif a.role == "out" and a.type == "int64_t":
            parameters.append(f"int32_t* {a.name}")
            before.append(f"int64_t long_{a.name} = 0;")
            call.append("&long_" + a.name)
            after.append(
                f"if (*ierr == 0 || *ierr == RSC_NOT_CONVERGED) *{a.name} = (int32_t)long_{a.name};"
            )
        elif a.role == "value":
            parameters.append(f"const {a.type.replace('int64_t', 'int32_t')}* {a.name}")
            call.append("*" + a.name)
        else:
            parameters.append(f"{'const ' if a.const else ''}{a.type}* {a.name}")
            call.append(a.name)
    texts = [a.name for a in f.arguments if a.role == "text"]
    called = f"{f.name}({', '.join(call)})"
    if texts:
        called = f"{' && '.join('c_' + t for t in texts)} ? {called} : RSC_NO_MEMORY"
    head = f"RSC_API void {name}_({', '.join([*parameters, 'int32_t* ierr', *lengths])})"
    body = [
        "BEGIN",
        *sorted(find, key=lambda line: "made" in line),
        *before,
        f"*ierr = {called};",
        *[f"free(c_{t});" for t in texts],
        *after,
    ]
    fill = lambda line: textwrap.wrap(line, 100, subsequent_indent=" " * 8, break_long_words=False)
    return [
        *fill(head + " {"),
        *[
            part
            for line in body
            for part in textwrap.wrap(line, 100, initial_indent=" " * 4, subsequent_indent=" " * 8)
        ],
        "}",
        "",
    ]


def names_77(functions, source):
    by_name, lines = {f.short: f for f in functions}, []
    for name, words in NAMES_77.items():
        short, *left_out = words.split()
        if f"{name}_(" not in source:
            lines += subroutine_77(name, by_name[short], left_out)
    return lines[:-1]


# ---- Python --------------------------------------------------------------------------------------
def python(functions, constants):
    lines = ['PROTOTYPES = """']
    for f in functions:
        prototype = f"{f.name}({', '.join(a.c() for a in f.arguments)})"
        lines += textwrap.wrap(prototype, 100, subsequent_indent="    ", break_long_words=False)
    lines += ['"""', ""]
    lines += [f"{name[4:]} = {value}" for name, value in constants]
    levels = ", ".join(
        f'"{name[10:].lower()}"' for name, _ in constants if name.startswith("RSC_LEVEL_")
    )
    lines += [
        "",
        "#: Names of the statuses of a level, by number, as in `status` of a result file.",
        f"LEVELS = ({levels})",
    ]
    return lines


def main():
    functions, constants = read_header("rsc.h")
    with open(os.path.join(HERE, "rsc.f90"), encoding="utf-8") as file:
        fortran = file.read()
    with open(os.path.join(HERE, "rsc77.c"), encoding="utf-8") as file:
        c = file.read()
    generated, wanted = wrappers(functions, fortran)
    note = "Generated from src/rsc.h by python3 modules/generate.py. Do not edit."
    files = {
        "generated/interface.inc": [
            f"! {note}",
            *interface(functions, constants),
        ],
        "generated/wrappers.inc": [f"! {note}", *generated],
        "generated/rsc77.inc": ["/* clang-format off */", f"/* {note} */", *names_77(functions, c)],
        "rsc/_h.py": [
            '"""Functions and status codes of rsc.h.',
            "",
            note + '"""',
            "",
            *python(functions, constants),
        ],
    }
    for name, lines in files.items():
        path, text = os.path.join(HERE, name), "\n".join(lines) + "\n"
        old = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
        if text == old:
            continue
        if "--check" in sys.argv:
            wanted.append(f"modules/{name} is stale: run python3 modules/generate.py")
        else:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as out:
                out.write(text)
            print("written:", os.path.relpath(path))
    print("\n".join(wanted) or f"{len(functions)} functions")
    sys.exit(1 if wanted else 0)


if __name__ == "__main__":
    main()
