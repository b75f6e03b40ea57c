"""Runs every example of modules/README: the blocks indented by four spaces that begin as a Python,
Fortran or C program does. Its table names every procedure of rsc.f90 and subroutine of rsc77.c.

usage: test_readme.py README          in a folder of its own; RSC_FORTRAN, RSC_C in the environment:
how to compile, with the flags"""
import os
import re
import shlex
import subprocess
import sys
import tempfile

LANGUAGES = [
    ("python", r"import |from "),
    ("fortran", r"program \w+$"),
    ("fixed", r" {6}program \w+$"),
    ("c", r"#include "),
]


def examples(text):
    """(line number, language, program) of every example; a block goes on over empty lines."""
    lines = text.split("\n")
    k = 0
    while k < len(lines):
        language = next(
            (name for name, start in LANGUAGES if re.match(f"    (?:{start})", lines[k], re.I)),
            None,
        )
        if language is None:
            k += 1
            continue
        end = k
        while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
            end += 1
        yield k + 1, language, "\n".join(line[4:] for line in lines[k:end]).rstrip() + "\n"
        k = end


def commands(language, program, folder):
    suffix = {"python": "py", "fortran": "f90", "fixed": "f", "c": "c"}[language]
    path = os.path.join(folder, "example." + suffix)
    with open(path, "w", encoding="utf-8") as out:
        out.write(program)
    if language == "python":
        return [[sys.executable, "-W", "error::UserWarning", path]]
    compiler, *flags = shlex.split(os.environ["RSC_C" if language == "c" else "RSC_FORTRAN"])
    binary = os.path.join(folder, "example")
    return [[compiler, path, "-o", binary, *flags], [binary]]


def unnamed(readme, text):
    """Calls of the Fortran modules that the table does not have."""
    folder = os.path.dirname(readme)
    sources = ""
    for name in ("rsc.f90", "rsc77.c", "generated/rsc77.inc"):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            sources += file.read()
    table = text[text.index("\nAll calls\n") :]
    names = re.findall(r"^    (?:procedure|generic) :: (\w+) => ", sources, re.M)
    names += [name.upper() for name in re.findall(r"^RSC_API void (rsc\w+)_\(", sources, re.M)]
    return sorted({name for name in names if not re.search(rf"\b{name}\(", table)})


def main():
    failed, count = 0, {}
    with open(sys.argv[1], encoding="utf-8") as readme:
        text = readme.read()
    for number, language, program in examples(text):
        if language != "python" and "RSC_FORTRAN" not in os.environ:
            continue
        count[language] = count.get(language, 0) + 1
        with tempfile.TemporaryDirectory() as folder:
            for command in commands(language, program, folder):
                done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                # An example shows something: it prints, nothing that is no number, and no messages
                # of HDF5.
                shown = done.stdout.strip() or command[0] != command[-1] and language != "python"
                made = len(os.listdir(folder)) > 1
                if (
                    done.returncode != 0
                    or not (shown or made)
                    or re.search(r"\bnan\b", done.stdout, re.I)
                    or "HDF5" in done.stderr
                ):
                    print(
                        f"line {number}, {language}: status {done.returncode}\n"
                        f"{done.stdout}{done.stderr}"
                    )
                    failed += 1
                    break
    missing = unnamed(sys.argv[1], text)
    print(f"examples run: {count}; {failed} failed; calls not in the table: {missing}")
    sys.exit(1 if failed or missing or count.get("python", 0) < 8 else 0)


main()
