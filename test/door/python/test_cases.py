"""The cases of input/ set what the paper, their comments and the READMEs say; what the READMEs of
input/ and output/ say of a run and of the pictures is so.

usage: test_cases.py PROJECT        (RSC_PROGRAM in the environment)"""
import functools
import glob
import io
import os
import re
import subprocess
import sys
import unittest
import unittest.mock

PROJECT = os.path.abspath(sys.argv.pop(1))
RSC = os.path.abspath(os.environ["RSC_PROGRAM"])
sys.path[:0] = [os.path.join(PROJECT, "output", "plot"), os.path.join(PROJECT, "output", "export")]
import interface_law  # noqa: E402
import law  # noqa: E402
import plot  # noqa: E402

try:
    import docutils.core
except ImportError:
    docutils = None


def read(*names):
    with open(os.path.join(PROJECT, *names), encoding="utf-8") as file:
        return file.read()


@functools.cache
def effective(text):
    """{group%key: value} that rsc --check tells of a case."""
    done = subprocess.run(
        [RSC, "--check", "-q"], input=text, text=True, capture_output=True, cwd=PROJECT
    )
    assert done.returncode == 0, done.stderr
    keys, group = {}, ""
    for line in done.stdout.splitlines():
        if line.startswith("&"):
            group = line[1:].strip()
        elif "=" in line:
            key, value = line.split("=", 1)
            keys[f"{group}%{key.strip()}"] = value.split("!")[0].strip().rstrip(",")
    return keys


class Cases(unittest.TestCase):
    maxDiff = None

    def test_paper(self):
        """The numbers of the paper, in every case of input/paper that is of its gold surface, and
        the levels it has."""
        gold = {
            "solids%E": "78000.0, Infinity",
            "solids%nu": "0.42, 0.0",
            "solids%R": "Infinity, 2.5",
            "surface%hurst": "0.8",
            "surface%L_lambda_l": "24.0",
            "surface%L_lambda_s": "512.0",
        }
        for name in ("maps", "maps_plateau"):
            said = effective(read("input", "paper", name + ".nml"))
            self.assertEqual({key: said[key] for key in gold}, gold, name)
            self.assertEqual(
                said["surface%plateau"], ".true." if name == "maps_plateau" else ".false."
            )

    def test_taken(self):
        """Every case is one that rsc takes, and a study script shortens each of its own to fewer
        realizations."""
        files = sorted(glob.glob(os.path.join(PROJECT, "input", "**", "*.nml"), recursive=True))
        self.assertGreater(len(files), 20)
        for file in files:
            with self.subTest(file=file):
                effective(read(file))
        for study in ("paper", "flat"):
            script = read("input", study, "run.sh")
            shorten = script[script.index("shorten() {") : script.index("\n}\n") + 3]
            for case in re.search(r"^cases='([^']*)'", script, re.M)[1].split():
                text = read("input", study, case + ".nml")
                short = subprocess.run(
                    ["sh", "-c", f"{shorten}shorten {case}"],
                    input=text,
                    text=True,
                    capture_output=True,
                    check=True,
                ).stdout
                whole, cut = effective(text), effective(short)
                self.assertLessEqual(
                    int(cut["run%realizations"]), int(whole["run%realizations"]), case
                )
                self.assertEqual(cut["solids%E"], whole["solids%E"])


class Readme(unittest.TestCase):
    def test_pictures(self):
        """output/README explains every picture of plot.py once, and no other."""
        text = read("output", "README")
        block = text[text.index("\nload  ") : text.index("A picture is drawn")]
        named = [
            word
            for line in block.splitlines()
            for name in re.findall(r"^([a-z]+(?:, [a-z]+)*)  ", line)
            for word in name.split(", ")
        ]
        self.assertEqual(sorted(named), sorted(plot.PICTURES))

    def test_pages(self):
        """Every page is reStructuredText without errors, no line longer than 80 columns."""
        pages = glob.glob(os.path.join(PROJECT, "*", "README"))
        others = ("README", "CHANGELOG", "src/THEORY.rst")
        for page in [*pages, *(os.path.join(PROJECT, p) for p in others)]:
            text = read(page)
            self.assertEqual([line for line in text.splitlines() if len(line) > 80], [], page)
            if docutils:
                told = io.StringIO()
                settings = {"warning_stream": told, "report_level": 2}
                docutils.core.publish_doctree(text, settings_overrides=settings)
                self.assertEqual(told.getvalue(), "", page)

    def test_scripts(self):
        """Every script is Python; the slow studies are run by no test."""
        for folder in ("input", "modules", "output", "test"):
            for path in glob.glob(os.path.join(PROJECT, folder, "**", "*.py"), recursive=True):
                with self.subTest(path=path), open(path, encoding="utf-8") as file:
                    compile(file.read(), path, "exec")

    def test_names(self):
        """Every file that src/README, src/THEORY.rst or a comment names exists, and every section
        of src/THEORY.rst."""
        tops = ("src", "test", "modules", "input/trust", "output/plot", "output/export")
        files = [
            os.path.relpath(os.path.join(folder, name), PROJECT)
            for top in tops
            for folder, _, names in os.walk(os.path.join(PROJECT, top))
            for name in names
        ]
        known = {*files, *map(os.path.basename, files)}
        for file in files:
            parts = os.path.splitext(file)[0].split("/")
            known.update("/".join(parts[:k]) for k in range(1, len(parts) + 1))
        theory = read("src", "THEORY.rst").split("\n")
        titles = {a for a, b in zip(theory, theory[1:]) if b in ("-" * len(a), "~" * len(a))}
        rooms = "|".join(d for d in os.listdir(os.path.join(PROJECT, "src")) if "." not in d)
        name = re.compile(
            rf"(?<![\w/.-])((?:(?:{rooms}|truth)/[a-z_0-9/]+(?:\.[a-z0-9]+)?)"
            r"|[a-z_0-9/]+\.(?:hpp|cpp|inl|py|cmake|rst|md))(?![\w/*])"
        )
        said, gone = 0, []
        signs = {".hpp": "//", ".cpp": "//", ".inl": "//", ".py": "#"}
        for file in files:
            sign = signs.get(os.path.splitext(file)[1])
            text = read(file) if sign or file in ("src/README", "src/THEORY.rst") else ""
            if sign:
                comments = re.findall(rf"{sign} ?([^\n]*)|\"\"\"(.*?)\"\"\"", text, re.S)
                text = " ".join(map("".join, comments))
            for word in name.findall(text):
                places = ["", "src/", "test/", "modules/", os.path.dirname(file) + "/"]
                said += 1
                if not any(place + word.rstrip("/") in known for place in places):
                    gone.append(f"{file}: {word}")
            sections = re.findall(r"THEORY\.rst, ([A-Z][\w' -]*[a-z])", text)
            gone += [f"{file}: section {s}" for s in sections if s not in titles]
        self.assertGreater(said, 200)
        self.assertEqual(gone, [])

    def test_commands(self):
        """The commands of output/README are ones that plot.py and law.py take."""
        commands = re.findall(
            r"^    python3 output/(plot/plot|export/law)\.py ((?:\S+ )*\S+)",
            read("output", "README"),
            re.M,
        )
        self.assertGreater(len(commands), 5)
        for script, words in commands:
            if script == "plot/plot":
                plot.parse(words.split())
            else:
                reached = {"side_effect": law.Refused("reached")}
                with unittest.mock.patch.object(law, "Law", **reached), unittest.mock.patch.object(
                    interface_law, "Interface", **reached
                ), self.assertRaises(SystemExit) as stop:
                    law.main(words.split())
                self.assertEqual(str(stop.exception.code), "law.py: reached")


if __name__ == "__main__":
    unittest.main()
