"""Laws for finite elements: the points of law.py are those of the file, the law increases, bad
files are refused; uinter.f90 evaluates the table and rsc alike. Laws of interfaces: the columns
against the numbers of the file, the bearing and the particles of modules/example.

usage: test_law.py FOLDER_OF_EXPORT UINTER BEARING PARTICLES     (RSC_PROGRAM in the environment)
"""
import contextlib
import io
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop(1))
import law  # noqa: E402
import rsc  # noqa: E402
from rsc.law import Law  # noqa: E402
from result_files import write_result  # noqa: E402

UINTER, BEARING, PARTICLES = (sys.argv.pop(1) for _ in range(3))
SURFACE = "&surface n=256 L_lambda_l=8 L_lambda_s=64 sigma=0.01 /"


def setUpModule():
    global FOLDER
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    FOLDER = folder.name


def path(name):
    return os.path.join(FOLDER, name + ".nc")


def run(*words):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        try:
            law.main(list(words))
        except SystemExit as stop:
            return str(stop.code)
    return out.getvalue()


def points(text):
    return np.array(
        [
            [float(v) for v in line.rstrip(",").split(",")]
            for line in text.splitlines()
            if line and line[0] in "-0123456789"
        ]
    )


def uinter(props, k, displacements):
    """What uinter_main prints: overclosure, pressure, slope, iterations, a row a displacement."""
    words = [len(props), *props, k, len(displacements), *displacements]
    out = subprocess.run(
        [UINTER],
        input="\n".join(
            repr(float(w)) if i not in (0, len(props) + 2) else str(w) for i, w in enumerate(words)
        ),
        text=True,
        capture_output=True,
        cwd=FOLDER,
    )
    assert out.returncode == 0, out.stderr
    return np.array([[float(v) for v in line.split()] for line in out.stdout.splitlines()])


MEANINGS = "converged out_of_validity overlapping not_unique not_converged"


def made(
    name,
    z,
    load,
    area,
    status,
    flats=False,
    title="Made here",
    drop=(),
    indenter="sphere R = 2500 um",
    **more
):
    """A file in um and mN; z of the shape (step) or (realization, step), the others (realization,
    step)."""
    variables = {
        "separation": ("step" if np.ndim(z) == 1 else "realization step", z, "um"),
        "force": ("realization step", load if not flats else 7 * load, "mN"),
        "contact_area": ("realization step", area, "um2"),
        "status": ("realization step", status),
    }
    if flats:
        variables |= {
            "pressure": ("realization step", load, "mN um-2"),
            "area_fraction": ("realization step", area, "1"),
        }
    variables |= more
    attributes = {("", "indenter"): indenter} | (
        {("status", "flag_meanings"): MEANINGS} if "status" not in drop else {}
    )
    return write_result(
        FOLDER,
        name,
        {},
        {key: v for key, v in variables.items() if key not in drop},
        attributes,
        title,
        "rsc 0.0.3, a model",
    )


class WholeText(unittest.TestCase):
    """The points that law.py writes, in every format, from files whose points are known."""

    maxDiff = None
    Z = np.array(
        [9.0, 8.0, 6.5, 6.0, 5.0, 4.5, 4.0, 2.0]
    )  # um; nothing touches at 9, 6 fails in one realization, 4.5 carries less than 5
    N = np.array(
        [
            [0, 1, 3, 4, 10, 9.5, 14, 40.0],
            [0, 2, 4, 5, 11, 9.0, 15, 44],
            [0, 0, 2, 6, 9, 8.5, 16, 39],
        ]
    )
    A = 100 * N + np.array([[0.0], [0.5], [0.2]]) * (N > 0)
    STATUS = np.array(
        [[0, 0, 0, 0, 2, 0, 0, 3], [0, 1, 0, 4, 0, 0, 1, 2], [0, 0, 0, 0, 0, 1, 1, 0]]
    )
    KEPT = [1, 2, 4, 6, 7]

    def points(self, z, n, a):
        """approach, load, its deviation, area, its deviation, deviation of the approach; a row a
        point, the first at zero."""
        std = lambda v: v.std(axis=0, ddof=1)
        return np.column_stack(
            [self.Z[0] - z, n.mean(axis=0), std(n), a.mean(axis=0), std(a), 0 * z]
        )[self.KEPT]

    def rows(self, file, flag="--table"):
        return np.array(
            [
                [float(v) for v in line.split()]
                for line in run(file, flag).splitlines()
                if line[0] != "#"
            ]
        )

    def test_sphere(self):
        file = made("whole", self.Z, self.N, self.A, self.STATUS)
        rows = self.points(self.Z, self.N, self.A)
        self.assertTrue(np.allclose(self.rows(file), np.vstack([np.zeros(6), rows]), rtol=1e-11))
        self.assertIn("1 levels not converged", run(file, "--calculix"))
        grave = made("grave", self.Z, self.N, self.A, np.where(self.N > 0, [[1], [2], [0]], 0))
        self.assertEqual(law.Law(grave).statuses, "7 out of validity")  # graver than overlapping
        spring = [[-row[1], -row[0]] for row in rows[::-1]] + [[0, 0], [0, 7]]
        for flag in ("--calculix", "--abaqus"):
            self.assertTrue(np.allclose(points(run(file, flag)), spring, rtol=1e-9))
            self.assertIn("\n*SPRING, ELSET=ROUGH, NONLINEAR\n\n", run(file, flag))

    def test_flats(self):
        file = made("whole_flats", self.Z, self.N, self.A / 1e5, self.STATUS, flats=True)
        rows = self.points(self.Z, self.N, self.A / 1e5)
        self.assertTrue(np.allclose(self.rows(file), np.vstack([np.zeros(6), rows]), rtol=1e-11))
        self.assertTrue(
            np.allclose(
                points(run(file, "--calculix")), np.vstack([[0, 0], rows[:, [1, 0]]]), rtol=1e-9
            )
        )
        self.assertIn(
            "\n*SURFACE INTERACTION, NAME=ROUGH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n",
            run(file, "--calculix"),
        )

    def test_loads_prescribed(self):
        """Separations are averaged, scatter, and are given in any order; no level is without
        contact, no area in the file."""
        n = np.array([1.0, 8.0, 27.0])
        z = np.array([[6.0, 3.1, -1.5], [6.4, 2.9, -2.0]])
        order = [2, 0, 1]
        file = made(
            "loads",
            z[:, order],
            np.tile(n, (2, 1))[:, order],
            None,
            np.zeros((2, 3)),
            title="",
            drop=("contact_area",),
        )
        depth = -z.mean(axis=0)
        start = depth[0] - (depth[1] - depth[0]) / (
            8 ** (2 / 3) - 1
        )  # Hertz: approach ~ N^(2/3), here 1 and 4
        rows = self.rows(file)
        self.assertIn("no level without contact", run(file, "--table"))
        expected = [
            np.append(0, depth - start),
            np.append(0, n),
            np.zeros(4),
            np.append(0, z.std(axis=0, ddof=1)),
        ]
        self.assertTrue(np.allclose(rows[:, [0, 1, 2, 5]], np.column_stack(expected), rtol=1e-11))
        self.assertTrue(np.all(np.isnan(rows[1:, 3])) and rows[0, 3] == 0)

    def test_first_loading(self):
        """Of bodies that yield, levels at which the approach is below one before are excluded;
        reloading beyond it goes on."""
        z, n = np.array([9.0, 7, 4, 6, 3.5, 5, 2]), np.array([[0, 1.0, 10, 0.5, 12, 2, 20]])
        file = made("yielding", z, n, n, 0 * n, plastic_contacts=("realization step", n))
        self.assertTrue(
            np.allclose(self.rows(file)[:, :2], [[0, 0], [2, 1], [5, 10], [5.5, 12], [7, 20]])
        )
        self.assertIn("2 after the first loading", run(file, "--calculix"))

    def test_refused(self):
        none = np.zeros((3, 8))
        single = np.where(self.Z == 2, 5.0, none)
        falls = np.where(self.Z == 4, 5.0, np.where(self.Z == 2, 4.0, none))
        two = lambda *drop: made(
            "lacks_" + "".join(drop), self.Z, self.N, self.A, self.STATUS, drop=drop
        )
        for file, word in (
            (two("separation"), "'separation'"),
            (two("force"), "'force'"),
            (two("status"), "'status'"),
            (made("none", self.Z, none, none, 0 * self.STATUS), "0 levels"),
            (made("single", self.Z, single, single, 0 * self.STATUS), "1 level"),
            (made("falls", self.Z, falls, falls, 0 * self.STATUS), "increase"),
            (made("bad", self.Z, self.N, self.A, 0 * self.STATUS + 4), "0 levels"),
            (
                made("plane", self.Z, self.N, self.A, self.STATUS, indenter="flat"),
                "flats with a border",
            ),
            (
                made(
                    "relaxing",
                    self.Z,
                    self.N,
                    self.A,
                    self.STATUS,
                    time=("step", self.Z),
                    energy_lost=("step", self.Z),
                ),
                "relax",
            ),
            (path("nothing"), "nothing"),
            (__file__, "read"),
        ):
            said = run(file, "--table")
            self.assertTrue(
                said.startswith("law.py: ") and word in said and repr(file) in said, (word, said)
            )
        self.assertIn(
            "force against approach",
            run(
                made("cone", self.Z, self.N, self.A, self.STATUS, indenter="cone of slope 0.05"),
                "--table",
            ),
        )
        # Two levels are enough.
        pair = np.where(self.Z == 4, 4.0, np.where(self.Z == 2, 5.0, none))
        self.assertIn(
            "3 points, force increasing",
            run(made("pair", self.Z, pair, pair, 0 * self.STATUS), "--table"),
        )


class Interface(unittest.TestCase):
    """The columns of an interface, from a file whose numbers are known: two realizations of five
    levels, the first without contact, the last but one closed for one of them, the last full."""

    GAP = np.array([[9.0, 5.0, 3.0, 1.0, 0.0], [9.0, 5.5, 3.5, 1.2, 0.0]])
    LOAD = np.array([[0, 1.0, 4.0, 20.0, 90.0]] * 2)
    K = GAP**3 / 12 * np.array([[0.99, 0.9, 0.7, 0.2, 0], [0.98, 0.92, 0.75, 0, 0]])
    S = GAP / 2 * np.array([[0.99, 0.95, 0.8, 0.3, 0], [0.995, 0.93, 0.85, 0, 0]])

    def flats(self, name, **more):
        tensor = lambda v: np.stack([v, 2 * v, 0 * v], axis=-1)
        return made(
            name,
            -np.cumsum(np.ones((2, 5)), axis=1),
            self.LOAD,
            self.LOAD / 100,
            0 * self.LOAD,
            flats=True,
            indenter="flat",
            gap_mean=("realization step", self.GAP, "um"),
            nominal_area=("realization step", 0 * self.GAP + 7, "um2"),
            stiffness=("realization step", -21 * self.LOAD, "mN um-1"),
            conductance_length=("realization step", 14 * self.LOAD, "um"),
            permeability=("realization step component3", tensor(self.K), "um3"),
            permeability_error_expected=("realization step component3", tensor(0 * self.K + 0.1)),
            shear_flow=("realization step component3", tensor(self.S), "um"),
            sigma=("realization", np.array([2.0, 2.0]), "um"),
            **more,
        )

    def law_of(self, file, *words):
        target = os.path.join(FOLDER, "of.law")
        self.assertEqual(run(file, *words, "-o", target), target + "\n")
        return {column.name: column for column in Law(target).columns}, Law(target)

    def test_columns(self):
        file = self.flats("interface")
        columns, _ = self.law_of(file, "--lubrication")
        rows = [3, 2, 1, 0]  # by increasing gap, without full contact
        gap, load = self.GAP.mean(axis=0), self.LOAD[0]
        K = np.exp(np.log(np.maximum(self.K, 1e-9)).mean(axis=0))
        K[3] = 0  # not open in more than half of the realizations
        S = self.S.mean(axis=0)
        for name, values in (
            ("gap", gap),
            ("pressure", load),
            ("area_fraction", load / 100),
            ("stiffness", 3 * load),
            ("conductance", 2 * load),
            ("permeability_x", K),
            ("permeability_y", 2 * K),
            ("shear_flow_x", S),
            ("flow_factor_pressure_x", 12 * K / np.maximum(gap, 1e-9) ** 3),
            ("flow_factor_sliding_y", 4 * S / np.maximum(gap, 1e-9)),
            ("flow_factor_shear_x", (gap - 2 * S) / 2),
        ):
            self.assertTrue(np.allclose(columns[name].values, values[rows], rtol=1e-12), name)
        self.assertEqual(columns["stiffness"].unit, "mN.um-1/um2")

    def test_netcdf_is_the_text(self):
        file = self.flats("interface")
        text, _ = self.law_of(file, "--text")
        netcdf, law = self.law_of(file, "--netcdf")
        self.assertEqual(list(text), list(netcdf))
        for name, column in text.items():
            self.assertTrue(np.allclose(column.values, netcdf[name].values, rtol=1e-14))
            self.assertEqual((column.unit, column.words), (netcdf[name].unit, netcdf[name].words))
        import netCDF4

        with netCDF4.Dataset(law.path) as out:
            self.assertTrue(np.allclose(out["permeability_x_error_expected"][:], 0.1))
            self.assertTrue(
                np.allclose(out["gap_std"][:], self.GAP.std(axis=0, ddof=1)[[3, 2, 1, 0]])
            )
            self.assertIn("rsc 0.0.3", out.source)

    def test_conductance(self):
        """Conductance per area of two bodies of resistivities whose sum is 0.25."""
        file = self.flats(
            "warm",
            resistance=(
                "realization step",
                np.where(self.LOAD > 0, 0.25 / (14 * np.maximum(self.LOAD, 1)), np.nan),
                "K W-1",
            ),
        )
        for flag, card in (("--calculix", "\n*GAP CONDUCTANCE\n"), ("--abaqus", ", PRESSURE\n")):
            deck = run(file, flag, "--conductance")
            rows = points(deck[deck.index(card) :])
            self.assertTrue(np.allclose(rows, [[8 * p, p] for p in (0, 1.0, 4, 20)], rtol=1e-9))
        said = run(self.flats("interface"), "--calculix", "--conductance")
        self.assertIn("solids%resistivity", said)

    def test_of_a_ball(self):
        z = np.array([9.0, 8.0, 6.5, 5.0])
        n = np.array([[0, 1.0, 3.0, 10.0]])
        file = made("ball", z, n, 2 * n, 0 * n, stiffness=("realization step", -3 * n, "mN um-1"))
        with open(file, "rb"):
            columns, law = self.law_of(file, "--text")
        self.assertEqual(list(columns), ["approach", "force", "contact_area", "stiffness"])
        self.assertTrue(np.allclose(columns["approach"].values, [1, 2.5, 4]))
        self.assertTrue(np.allclose(law.evaluate("stiffness", force=[1, 3, 10])[0], [3, 9, 30]))
        self.assertIn("has no permeability", run(file, "--lubrication"))

    def test_formulas(self):
        """Those of the picture, against closed forms of Gaussian heights."""
        import plot_law

        for H in (0.0, 0.7, 2.5, 4.0):
            above = math.erfc(H / math.sqrt(2)) / 2
            density = math.exp(-(H**2) / 2) / math.sqrt(2 * math.pi)
            gap, square = H * (1 - above) + density, (1 + H**2) * above - H * density
            self.assertAlmostEqual(float(plot_law.truncated(np.array([H]))[0]), gap, delta=1e-12)
            self.assertAlmostEqual(plot_law._above([H], 2)[0] / square, 1, delta=1e-4)

    def test_bearing_of_rough_faces(self):
        """The example and its picture with a law that rsc computes; the example checks itself."""
        result, target = path("rough_bearing"), os.path.join(FOLDER, "rough_bearing.law")
        rsc.Case(
            "&solids R=Infinity,Infinity / &solver model='elements' / "
            "&surface L=0.2 sigma=4e-4 L_lambda_l=4 L_lambda_s=12 / &output flow=.true. / "
            "&indentation boundary='periodic' levels=15,10,7,5,4,3.4,3,2.5,2,1.5,1,0.6,0.3 /"
        ).run(result)
        self.assertEqual(run(result, "--lubrication", "-o", target), target + "\n")
        done = subprocess.run([BEARING, target], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("thick film over smooth faces", done.stdout)
        table = os.path.join(FOLDER, "stribeck.txt")
        with open(table, "w", encoding="utf-8") as out:
            out.write(done.stdout)
        script = os.path.join(os.path.dirname(rsc.__file__), "..", "example", "bearing.py")
        subprocess.run([sys.executable, script, table], check=True, capture_output=True)
        self.assertTrue(os.path.exists(table.replace("txt", "png")))

        import plot

        with contextlib.redirect_stdout(io.StringIO()):
            plot.main([result, "--only", "law"])
        self.assertTrue(os.path.exists(path("rough_bearing_law").replace(".nc", ".png")))

    def test_particles(self):
        """The example, with a law that rsc computes; it checks its result."""
        result, target = path("example"), os.path.join(FOLDER, "example.law")
        rsc.Case(SURFACE + "&indentation levels=3,2.5,2,1.5,1,0.5,0,-1,-2 /").run(result)
        self.assertEqual(run(result, "--text", "-o", target), target + "\n")
        done = subprocess.run([PARTICLES, target], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("1000 balls", done.stdout)

    def test_bearing(self):
        """The example, with faces whose flow is that of smooth ones at every gap: the thick film
        is the closed form to the midpoint rule of 2000 points, dry contact has the friction of the
        contacts (the example checks it)."""
        target = os.path.join(FOLDER, "bearing.law")
        with open(target, "w") as out:
            out.write("# rsc law 1\n# column gap mm - logarithmic: mean gap\n")
            out.write("# column pressure N.mm-2 exponential -: nominal pressure\n")
            for name in ("pressure", "sliding"):
                out.write(f"# column flow_factor_{name}_x 1 power-to-1 -: of smooth faces\n")
            for gap in np.geomspace(1e-4, 1e-2, 20):
                out.write(f"{gap} {2e3 * np.exp(-gap / 2e-4)} 1 1\n")
        done = subprocess.run([BEARING, target], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        thick = next(line for line in done.stdout.splitlines() if "thick film" in line)
        film, shear = map(float, thick.split()[-2:])
        self.assertLess(abs(film - 1), 1e-4, thick)  # printed to four places
        self.assertLess(abs(shear - 1), 1e-4, thick)


BLOCKS = """*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2, 9, 10, 11, 12, 13, 14, 15, 16
*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
13, 14, 15, 16
*NSET, NSET=ABOVE, GENERATE
9, 16
*SURFACE, NAME=SLAVE, TYPE=ELEMENT
2, S1
*SURFACE, NAME=MASTER, TYPE=ELEMENT
1, S2
*MATERIAL, NAME=BLOCK
*ELASTIC
1e6, 0.
*CONDUCTIVITY
{conductivity}
*SOLID SECTION, ELSET=LOWER, MATERIAL=BLOCK
*SOLID SECTION, ELSET=UPPER, MATERIAL=BLOCK
{interaction}
*CONTACT PAIR, INTERACTION=ROUGH, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*BOUNDARY
BOTTOM, 1, 3
ABOVE, 1, 2
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
0.1, 1.
*BOUNDARY
BOTTOM, 11, 11, 0.
TOP, 11, 11, 100.
*DLOAD
UPPER, P2, {pressure}
*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY
RFL
*END STEP
"""


@unittest.skipUnless(shutil.which("ccx"), "no CalculiX (ccx)")
class Heat(unittest.TestCase):
    """Two blocks of side 1 with a rough interface, by CalculiX: thermal resistances in series."""

    def test_two_blocks(self):
        pressure, conductivity = 4.0, 50.0
        loads = np.where(Interface.LOAD > 0, Interface.LOAD, np.nan)
        resistance = ("realization step", 0.25 / (14 * loads), "K W-1")
        file = Interface().flats("blocks", resistance=resistance)
        corners = ((0, 0), (1, 0), (1, 1), (0, 1))
        nodes = [(x, y, z) for z in (0, 1, 1, 2) for x, y in corners]
        text = BLOCKS.format(
            nodes="\n".join(f"{k}, {x}, {y}, {z}." for k, (x, y, z) in enumerate(nodes, 1)),
            interaction=run(file, "--calculix", "--conductance").strip(),
            conductivity=conductivity,
            pressure=pressure,
        )
        with open(os.path.join(FOLDER, "blocks.inp"), "w", encoding="utf-8") as deck:
            deck.write(text)
        done = subprocess.run(["ccx", "blocks"], cwd=FOLDER, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        with open(os.path.join(FOLDER, "blocks.dat"), encoding="utf-8") as out:
            flux = abs(float(out.read().split()[-1]))
        expected = 100 / (2 / conductivity + 1 / (8 * pressure))
        self.assertLess(abs(flux / expected - 1), 1e-5)  # printed to seven places


class Uinter(unittest.TestCase):
    def test_table(self):
        """The properties that --abaqus writes, in series with a spring: against the same by numpy,
        on and between the points and beyond the last."""
        z = np.linspace(40, 0, 21)  # um
        pressure = np.where(z < 39.5, 10 * np.exp(-z / 8), 0)[None]  # mN/um2
        file = made("flats", z, pressure, pressure / 10, 0 * pressure, flats=True)
        found = law.Law(file)
        text = run(file, "--abaqus")
        line = text[text.index("USER, PROPERTIES=") :].splitlines()
        props = [
            float(v)
            for row in line[1:]
            if row.startswith("** ")
            for v in row[3:].split(",")
            if v.strip()
        ]
        self.assertEqual(len(props), int(line[0].split("=")[1].split(",")[0]))
        k = 2.0e5
        c = np.concatenate([[-0.01, 0.0, 1e-9], np.linspace(0.0005, 0.039, 37), [0.045]])
        slope = np.diff(found.load) / np.diff(found.approach)
        p = np.where(
            c > found.approach[-1],
            found.load[-1] + slope[-1] * (c - found.approach[-1]),
            np.interp(c, found.approach, found.load),
        )
        rows = uinter(props, k, c + p / k)
        self.assertTrue(
            np.allclose(rows[:, 0], c, rtol=1e-7, atol=1e-10), abs(rows[:, 0] - c).max()
        )
        self.assertTrue(np.allclose(rows[:, 1], p, rtol=1e-6, atol=1e-3))
        self.assertLess(rows[:, 3].max(), 40)

    def test_rsc(self):
        """Calling rsc: the pressure is that of the library from Python; Newton's method converges
        as with a right slope."""
        case = rsc.Case(SURFACE + "&solids R=Infinity,Infinity / &solver tolerance=1.0e-11 /")
        with open(os.path.join(FOLDER, "rsc.nml"), "w", encoding="utf-8") as out:
            out.write(str(case))
        contact = rsc.Contact.from_case(rsc.Asperities.make(case), case)
        z0, area, k = contact.first_touch(), 1.0, 1.0e5
        rows = uinter([1.0, area, z0], k, [-0.01, 0.005, 0.01, 0.02])
        self.assertEqual(rows[0, 1], 0)
        for c, p, slope, iterations in rows[1:]:
            self.assertAlmostEqual(contact.indent(z0 - c) / area / p, 1, delta=1e-9)
            self.assertAlmostEqual(-contact.stiffness() / area / slope, 1, delta=1e-6)
            self.assertLess(iterations, 12)
        self.assertTrue(np.all(np.diff(rows[:, 1]) > 0))


if __name__ == "__main__":
    unittest.main()
