#!/usr/bin/env python3
"""Writes the pages of the manual as reStructuredText, for Sphinx.

    python3 output/manual/make_manual.py RSC FOLDER [--text]

The pages are the READMEs, a gallery of the cases of input/ with their pictures, the keys from
`rsc --describe`, and the calls of C from rsc.h and of Python from its docstrings. RSC is the
program; results and pictures are kept in FOLDER/results, and computed again where a case is newer.
With --text no case is run and there are no pictures.
"""

import glob
import inspect
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.normpath(os.path.join(HERE, "..", ".."))

# The pages that are READMEs, with the names of their folders.
READMES = ["README", "input", "output", "modules", "src", "test", "CHANGELOG"]
# The pictures of each case; others show the contact area against the force.
PICTURES = {
    "first": ["area", "spots", "map"],
    "paper": ["area", "spots"],
    "gold": ["area"],
    "compare": ["compare"],
    "flat": ["flats"],
    "flat_study": ["study"],
    "seal": ["seal", "flow"],
    "lubrication": ["law"],
    "stress": ["stress", "section"],
    "crossed_cylinders": ["resistance", "spots"],
    "roller": ["line", "spots"],
    "two_maps": ["surface", "spots"],
    "creep": ["time"],
    "relax": ["time"],
    "running_in": ["wear"],
    "adhesion": ["pull"],
    "pulloff": ["pulloff"],
    "campaign": ["area", "radial"],
    "map": ["surface", "spots"],
}
ORDER = ["first", "paper", "gold", "compare", "elements", "stress", "coating", "lay", "flat"]
# Sections of the theory, by what the names of keys contain.
SECTIONS = {
    "hardness": "Hardness",
    "adhesion": "Adhesion",
    "relaxation": "Relaxation",
    "friction": "Friction",
    "wear|distances": "Wear",
    "flow|leak|viscosity|gas": "Flow",
    "stress|sliding_direction": "Stresses",
    "layer": "Layers",
    "resistivity": "Forces, stiffness and energy",
    "boundary|line_reference": "Line contact",
    "law": "Contact laws of an asperity",
    "selection": "The system of equations",
    "method|delta": "Newton's method",
    "model": "Boundary elements",
    "sigma|hurst|lambda|plateau|normalise|seed": "Spectrum",
    "detrend|filter|missing|outliers": "Measured maps",
    "indenter%": "Two bodies become one problem",
    "map|radial|pdf": "What is read off a level",
}
STYLE = """\
dl.key, dl.c, dl.py { margin-bottom: 1em; }
dd > p { margin: 0.3em 0; }
math { font-family: "STIX Two Math", "Latin Modern Math", "Cambria Math", "STIX Math",
       "DejaVu Math TeX Gyre", math; }
math[display="block"] { margin: 0.8em 0; overflow-x: auto; }
div.body a:has(> img) { border: none; }
@media (max-width: 875px) { div.sphinxsidebar ul ul { display: none; } }
"""


def read(*names):
    with open(os.path.join(TOP, *names), encoding="utf-8") as file:
        return file.read()


def plain(text):
    """Text in which nothing is markup."""
    return re.sub(r"([\\*`|_])", r"\\\1", text)


def prose(text):
    """Text in which nothing is markup but `code`."""
    return re.sub(r"\\`(.*?)\\`", r"``\1``", plain(text))


def heading(text, line="-"):
    return [text, line * len(text), ""]


def indented(lines, by=4):
    return [(" " * by + line).rstrip() for line in lines]


def page(*path):
    """A page of the project with links to the READMEs in place of their names."""
    lines = []
    for line in read(*path).split("\n"):
        if not line.startswith("    "):  # not in a literal block; links are as long as the names
            line = re.sub(
                r"(?:``)?\b(input|output|modules|src|test)/README\b(?:``)?", r":doc:`\1`", line
            )
            line = line.replace("src/THEORY.rst", ":doc:`theory` ")
        lines.append(line)
    return lines


# ---- gallery -------------------------------------------------------------------------------------
def draw(program, case, name, results):
    """The pictures of a case, computed where they are missing or older than the case."""
    if "--text" in sys.argv:
        return []
    result = os.path.join(results, name + ".nc")
    made = [p for p in (result, result.replace(".nc", "_manifest.nc")) if os.path.exists(p)]
    if not made or os.path.getmtime(made[0]) < os.path.getmtime(case):
        print("manual: running", os.path.relpath(case, TOP), flush=True)
        words = [program, "-q", case, "-o", result]
        done = subprocess.run(words, cwd=TOP, capture_output=True, text=True)
        if done.returncode != 0:
            print(f"manual: {case}: {done.stderr.strip()}")
            return []
    manifest = result.replace(".nc", "_manifest.nc")
    source, pictures = manifest if os.path.exists(manifest) else result, []
    for picture in PICTURES.get(name, ["study" if source == manifest else "area"]):
        path = f"{os.path.splitext(source.replace('_manifest', ''))[0]}_{picture}.png"
        if not os.path.exists(path) or os.path.getmtime(path) < os.path.getmtime(source):
            plot = os.path.join(TOP, "output", "plot", "plot.py")
            words = [sys.executable, plot, source, "--only", picture]
            done = subprocess.run(words, capture_output=True, text=True)
            if not os.path.exists(path):
                print(f"manual: {name}: no picture {picture}: {done.stdout}{done.stderr}".strip())
                continue
        pictures.append(path)
    return pictures


def description(text):
    """The comment at the top of a case as paragraphs, with commands as literal blocks."""
    head = re.match(r"(?:!.*\n)+", text)[0].rstrip("\n")
    lines = [re.sub(r"^! ?", "", line) for line in head.split("\n")]
    out = []
    for line in lines:
        command = line.startswith("    ")
        if command and not (out and out[-1].startswith("    ")):
            out += ["", "::", ""]
        if not command and out and out[-1].startswith("    "):
            out.append("")
        out.append(line if command else prose(line))
    return out + [""], text[len(head) :].strip("\n").split("\n")


def gallery(program, results, source):
    lines = heading("Gallery of cases", "=")
    lines += ["Each picture was made from the case below it, by rsc and plot.py.", ""]
    cases = {os.path.basename(p)[:-4]: p for p in glob.glob(os.path.join(TOP, "input", "*.nml"))}
    cases["map"] = os.path.join(TOP, "input", "map", "map.nml")
    order = [name for name in ORDER if name in cases]
    for name in order + sorted(set(cases) - set(order)):
        text = read(cases[name])
        title = re.search(r"title\s*=\s*'(.*?)'", text)
        head, body = description(text)
        lines += heading(plain(title[1]) if title else name) + head
        for path in draw(program, cases[name], name, results):
            shutil.copy(path, source)
            lines += [f".. image:: {os.path.basename(path)}", "   :width: 90%", ""]
        lines += [f"The case, ``{os.path.relpath(cases[name], TOP)}``::", "", *indented(body), ""]
    return lines


# ---- keys and calls ------------------------------------------------------------------------------
def keys(program):
    lines = heading("Keys of a case", "=")
    lines += ["All keys with their defaults, types, units and bounds: ``rsc --describe``.", ""]
    told = subprocess.run([program, "--describe"], capture_output=True, text=True, check=True)
    group = theory = ""
    for line in told.stdout.splitlines():
        if line.startswith("&"):
            group, _, about = line[1:].partition(":")
            lines += ["", *heading(f"&{group}"), plain(about.strip()), ""]
        elif line.startswith("      "):
            lines += ["   " + plain(line.strip()) + theory, ""]
            theory = ""
        elif line.strip():
            key = f"{group}%{line.strip()}"
            lines += [f".. key:: {key}", ""]
            titles = [SECTIONS[s] for s in SECTIONS if re.search(s, key.split(" =")[0])]
            theory = f"; theory: :ref:`theory:{titles[0]}`" if titles else ""
    return lines


def c_interface():
    header = read("src", "rsc.h")
    lines = heading("C interface: rsc.h", "=")
    about = re.match(r".*?/\* (.*?)\*/", header, re.S)[1]
    for line in re.sub(r"\n \* ?", "\n", about).split("\n"):
        if line and not line.startswith(" ") and lines[-1].startswith("    "):
            lines.append("")
        lines.append(plain(line))
    pattern = (
        r"/\* -{4} (.*?) -+ \*/|/\*((?:(?!\*/).)*)\*/\s*RSC_API\s+(int32_t\s+\w+\([^;]*\))\s*;"
    )
    for section, comment, declaration in re.findall(pattern, header, re.S):
        if section:
            lines += ["", *heading(section[0].upper() + section[1:])]
            continue
        lines += ["", f".. c:function:: {' '.join(declaration.split())}", ""]
        for line in re.sub(r"\n \* ?", "\n", comment).strip().split("\n"):
            entry = re.match(r"    (\S[^:]*?)(?:: (.*)|( \[.*))$", line)
            if entry and not line.startswith("      "):
                text = (entry[2] or entry[3]).strip().rstrip(";")
                if not lines[-1].startswith(("   - ", "     ")):
                    lines.append("")
                lines.append(f"   - **{plain(entry[1])}**: {plain(text)}")
            elif line.startswith("Errors:"):
                lines += ["", "   " + plain(line)]
            else:
                deeper = "     " if line.startswith("      ") else "   "
                if deeper == "   " and lines[-1].startswith(("   - ", "     ")):
                    lines.append("")
                lines.append(deeper + plain(line.strip().rstrip(";")))
    return lines


def docstring(thing, by):
    """A docstring as paragraphs and literal blocks."""
    lines = []
    for paragraph in re.split(r"\n\s*\n", inspect.getdoc(thing) or ""):
        code = paragraph.startswith("    ")
        lines += ["::", ""] if code else []
        lines += [line if code else prose(line) for line in paragraph.split("\n")] + [""]
    return indented(lines, by)


def signature(thing):
    """The arguments of a function, without self and the quotes of its annotations."""
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(inspect.signature(thing)))
    return re.sub(r"\(self(: \w+)?(, )?", "(", text).replace("_Same", "object")


def python(library):
    os.environ.setdefault("RSC_LIBRARY", library)
    sys.path.insert(0, os.path.join(TOP, "modules"))
    try:
        import rsc
    except ImportError as error:
        print(f"manual: without the page of Python: {error}")
        return None
    lines = heading("Python: the package rsc", "=") + docstring(rsc, 0)
    for name in rsc.__all__:
        thing = getattr(rsc, name)
        if inspect.isclass(thing):
            fields = getattr(thing, "_fields", None)
            lines += [f".. py:class:: {name}" + (f"({', '.join(fields)})" if fields else ""), ""]
            lines += docstring(thing, 3)
            for verb, method in inspect.getmembers(thing) if not fields else []:
                if verb.startswith("_") or not (callable(method) or isinstance(method, property)):
                    continue
                if isinstance(method, property):
                    lines += [f"   .. py:property:: {verb}", ""]
                elif hasattr(BaseException, verb):
                    continue
                else:
                    lines += [f"   .. py:method:: {verb}{signature(method)}", ""]
                lines += docstring(method, 6)
        elif callable(thing):
            lines += [f".. py:function:: {name}{signature(thing)}", ""]
            lines += docstring(thing, 3)
    return lines


def main():
    program, folder = (os.path.abspath(word) for word in sys.argv[1:3])
    source, results = os.path.join(folder, "source"), os.path.join(folder, "results")
    shutil.rmtree(source, ignore_errors=True)
    os.makedirs(source)
    os.makedirs(results, exist_ok=True)
    shutil.copy(os.path.join(HERE, "conf.py"), source)
    os.makedirs(os.path.join(source, "_static"))
    with open(os.path.join(source, "_static", "manual.css"), "w", encoding="utf-8") as out:
        out.write(STYLE)
    pages = {name: page(*([name] if name.isupper() else [name, "README"])) for name in READMES}
    pages["theory"] = page("src", "THEORY.rst")
    pages["gallery"] = gallery(program, results, source)
    pages["keys"] = keys(program)
    pages["c"] = c_interface()
    pages["python"] = python(os.path.join(os.path.dirname(program), "librsc.so"))
    # README is the first page, with the pictures of its first command below it.
    order = "gallery input keys output theory python modules c src test CHANGELOG"
    order = [name for name in order.split() if pages[name]]
    first = pages.pop("README")
    widths = {"first_area": 37, "first_spots": 61, "first_map": 98}  # [%]
    shown = [name for name in widths if os.path.exists(os.path.join(source, name + ".png"))]
    if shown:
        row = ["", " ".join(f"|{name}|" for name in shown), ""]
        for name in shown:
            row += [f".. |{name}| image:: {name}.png", f"   :width: {widths[name]}%", ""]
        at = first.index("    sh input/first.sh") + 1
        first[at:at] = row
    pages["index"] = first + ["", ".. toctree::", "   :hidden:", "", *indented(order, 3)]
    for name in [*order, "index"]:
        with open(os.path.join(source, name + ".rst"), "w", encoding="utf-8") as out:
            out.write("\n".join(pages[name]) + "\n")


if __name__ == "__main__":
    main()
