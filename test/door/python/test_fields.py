"""Fields of the program: they add up to the force, no body enters the other, and the gap about a
smooth sphere is Hertz's; what fields.py makes of them. What the keys for measured maps do to a map.

usage: test_fields.py FOLDER_OF_EXPORT    (RSC_PROGRAM in the environment)
"""
import base64
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import netCDF4
import numpy as np

sys.path.insert(0, sys.argv.pop(1))
import fields  # noqa: E402
from result_files import InFolder  # noqa: E402

ROUGH = """&solids E = 1.0e3, Infinity nu = 0.0, 0.0 R = Infinity, {R} /
&surface L = 1.0 sigma = 1.0e-3 L_lambda_l = 2 L_lambda_s = 6 n = 64 /
&indentation boundary = '{boundary}' levels = 1.5, 0.5 /
&solver model = '{model}' /
&asperities law = 'hertz' /
&elements points_per_wave = 10 /
&output fields = 'pressure', 'gap', 'contact', 'heights' field_levels = 1.6, 0.6 contacts = 'none' /
"""


class Program(InFolder):
    def run_case(self, text, *words, status=0):
        done = subprocess.run(
            [os.environ["RSC_PROGRAM"], "-o", self.path("r.nc"), *words],
            input=text,
            text=True,
            capture_output=True,
            cwd=self.folder,
            check=False,
        )
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr if status else done.stdout

    def result(self):
        with netCDF4.Dataset(self.path("r.nc")) as file:
            return {
                name: np.ma.filled(v[...].astype(float), np.nan)
                for name, v in file.variables.items()
                if v.dtype.kind in "fi"
            }


class Fields(Program):
    def test_add_up_and_stay_apart(self):
        for boundary, R in (("free", "10.0"), ("periodic", "Infinity")):
            for model in ("elements", "asperities"):
                self.run_case(ROUGH.format(boundary=boundary, R=R, model=model))
                r = self.result()
                pixel = np.diff(r["field_x"])[0] * np.diff(r["field_y"])[0]
                np.testing.assert_array_equal(r["field_step"], [1, 2])
                np.testing.assert_allclose(
                    r["field_pressure"].sum(axis=(1, 2)) * pixel, r["force"][0], rtol=1e-6
                )
                touch = r["field_pressure"] > 0
                np.testing.assert_array_equal(touch, r["field_contact"] == 1)
                self.assertTrue(
                    touch.any()
                    and (r["field_gap"][~touch] >= 0).all()
                    and (r["field_gap"][touch] == 0).all()
                )
                if (
                    model == "elements"
                ):  # every point is solved: none that carries nothing is entered
                    self.assertGreater(r["field_gap"][~touch].min(), 0)
                if (
                    boundary == "periodic" and model == "elements"
                ):  # what goes down here comes up there, with a layer, too
                    np.testing.assert_allclose(
                        r["field_gap"].mean(axis=(1, 2)),
                        r["separation"].ravel(),
                        rtol=1e-5,
                        atol=1e-9,
                    )
                    self.run_case(
                        ROUGH.format(boundary=boundary, R=R, model=model),
                        *(
                            w
                            for key in ("thickness=0.05", "E=200", "nu=0.3")
                            for w in ("-s", "solids%layer_" + key)
                        ),
                    )
                    r = self.result()
                    np.testing.assert_allclose(
                        r["field_gap"].mean(axis=(1, 2)),
                        r["separation"].ravel(),
                        rtol=1e-5,
                        atol=1e-9,
                    )

    def test_yielded(self):
        """Unloaded, summits that have yielded are lower by their residual depth: the indenter
        touches none."""
        keys = (
            "-s",
            "solids%hardness=1",
            "-s",
            "indentation%levels=0.5,3",
            "-s",
            "output%field_levels=0.5,3",
            "-s",
            "output%contacts='all'",
        )
        self.run_case(ROUGH.format(boundary="free", R="10.0", model="asperities"), *keys)
        r = self.result()
        self.assertTrue(
            r["force"][0, 0] > 0
            and r["force"][0, 1] == 0
            and r["asperity_residual_depth"].max() > 0
        )
        self.assertEqual(r["field_gap"][0].min(), 0)
        self.assertGreater(r["field_gap"][1].min(), 0)

    def test_relaxed(self):
        """Held for long: field_gap is that of the elastic body with the relaxed modulus. Curves of
        elastic bodies are absent, as are marks of yielding."""
        for boundary, R in (("free", "10.0"), ("periodic", "Infinity")):
            for model in ("elements", "asperities"):
                text = ROUGH.format(boundary=boundary, R=R, model=model).replace(
                    "levels = 1.6, 0.6 contacts = 'none'", "levels = 0.4 contacts = 'all'"
                )
                self.run_case(
                    text.replace("E = 1.0e3", "E = 1.0e2").replace(
                        "levels = 1.5, 0.5", "levels = 0.4999999"
                    )
                )
                soft = self.result()
                text = text.replace(
                    "E = 1.0e3", "relaxation_share = 0.9 relaxation_time = 1.0 E = 1.0e3"
                )
                self.run_case(
                    text.replace("levels = 1.5, 0.5", "levels = 0.5, 0.4999999 times = 0.0, 1.0e3")
                )
                r = self.result()
                np.testing.assert_array_equal(r["field_step"], [2])
                np.testing.assert_allclose(
                    r["force"][0, 1], soft["force"][0, 0], rtol=1e-5
                )  # the solver's tolerance is 1e-6
                np.testing.assert_allclose(
                    r["field_gap"][-1],
                    soft["field_gap"][-1],
                    rtol=0,
                    atol=1e-5 * soft["field_gap"].max(),
                )
                for name in ("area_I", "area_II", "transition_force"):
                    self.assertTrue(np.isnan(r[name]).all() and np.isfinite(soft[name]).all(), name)
                for name in (
                    "area_hertz",
                    "hertz_pressure",
                    "area_persson",
                    "area_bgt",
                    "area_gw",
                    "contact_yields",
                ):
                    self.assertNotIn(name, r)

    def test_tension(self):
        """Two flats under tension have no area by theories of contact without adhesion."""
        self.run_case(
            ROUGH.format(boundary="periodic", R="Infinity", model="asperities")
            .replace("E = 1.0e3", "adhesion = 3e-3 E = 1.0e3")
            .replace("1.5, 0.5", "1.5, 4.5", 1)
        )
        r = self.result()
        pulled = r["force_mean"] < 0
        self.assertTrue(pulled.any())
        for name in ("area_persson", "area_bgt"):
            np.testing.assert_array_equal(np.isnan(r[name]), pulled, name)

    def test_map_of_attraction(self):
        """The cells of the map add up to the force, the attraction of places without contact
        included."""
        for model, w, reach in (("elements", 0.02, 0.02), ("asperities", 1e-3, 1e-3)):
            keys = f"adhesion = {w} adhesion_range = {reach} E = 1.0e3"
            self.run_case(
                ROUGH.format(boundary="free", R="10.0", model=model).replace("E = 1.0e3", keys)
            )
            r = self.result()
            self.assertTrue((r["cohesive_area"] > 0).any())
            np.testing.assert_allclose(
                r["map_pressure"].sum(axis=(1, 2)) * r["map_cell_side"] ** 2,
                r["force"][0],
                rtol=1e-9,
            )

    def test_gap_about_a_smooth_sphere(self):
        with open(self.path("flat.txt"), "w") as out:
            out.write(("0 " * 81 + "\n") * 81)
        R, E, depth = 10.0, 1e3, 2e-3
        self.run_case(
            f"""&solids E = {E}, Infinity nu = 0.0, 0.0 R = Infinity, {R} /
&surface source = 'heights' file = 'flat.txt' pixel = 0.01 sigma = 1.0 detrend = 'none' /
&indentation unit = 'length' levels = {-depth} /
&output fields = 'gap' field_window = 0.0, 0.8, 0.4, 0.41 /"""
        )
        r = self.result()
        self.assertEqual(r["field_gap"].shape, (1, 2, 81))
        d, a = abs(r["field_x"] - 0.4), np.sqrt(R * depth)
        out = d > 1.3 * a  # the edge of the contact is within a pixel
        s = a / d[out]
        lowered = ((2 * a**2 - d[out] ** 2) * np.arcsin(s) + a * d[out] * np.sqrt(1 - s**2)) / (
            np.pi * R
        )  # Johnson 1985, eq. 3.42
        np.testing.assert_allclose(
            r["field_gap"][0, 0][out], d[out] ** 2 / (2 * R) - depth + lowered, rtol=0.02
        )

    def test_refusals(self):
        for words, said in (
            (["-s", "output%field_window=2,3,2,3"], "field_window"),
            (["-s", "output%field_window=1,0,0,1"], "field_window"),
            (["-s", "run%realizations=2"], "fields"),
            (["-s", "output%fields='force'"], "pressure"),
        ):
            self.assertIn(
                said,
                self.run_case(
                    ROUGH.format(boundary="free", R="10.0", model="elements"), *words, status=2
                ),
            )

    def test_files_for_others(self):
        self.run_case(ROUGH.format(boundary="free", R="10.0", model="elements"))
        r = self.result()
        fields.main([self.path("r.nc")])
        piece = xml.etree.ElementTree.parse(self.path("r_fields_2.vti")).getroot().find("ImageData")
        self.assertEqual(
            piece.get("WholeExtent").split()[1::2],
            [str(r["field_x"].size - 1), str(r["field_y"].size - 1), "0"],
        )
        arrays = {
            a.get("Name").split()[0]: np.frombuffer(base64.b64decode(a.text)[8:])
            for a in piece.iter("DataArray")
        }
        np.testing.assert_array_equal(arrays["pressure"], r["field_pressure"][1].ravel())
        np.testing.assert_array_equal(arrays["height"], r["field_height"].ravel())
        fields.write_vti(
            self.path("oblong.vti"), np.array([1.0, 1.5, 2.0]), np.array([-2.0, 0.0]), {}
        )
        image = xml.etree.ElementTree.parse(self.path("oblong.vti")).getroot().find("ImageData")
        self.assertEqual(
            [float(v) for v in image.get("Spacing").split() + image.get("Origin").split()],
            [0.5, 2, 1, 1, -2, 0],
        )
        fields.main([self.path("r.nc"), "--format", "csv"])
        columns = np.loadtxt(self.path("r_fields_1.csv"), delimiter=",", skiprows=1)
        np.testing.assert_allclose(
            columns[:, :4],
            np.column_stack(
                [
                    *(v.ravel() for v in np.meshgrid(r["field_x"], r["field_y"])),
                    r["field_pressure"][0].ravel(),
                    r["field_gap"][0].ravel(),
                ]
            ),
            rtol=1e-8,
        )
        fields.main([self.path("r.nc"), "--format", "png"])
        self.assertGreater(os.path.getsize(self.path("r_fields_1.png")), 10000)


class Maps(Program):
    CASE = """&solids E = 1.0e3, Infinity nu = 0.0, 0.0 R = Infinity, 10.0 /
&surface source = 'heights' file = 'map.txt' {keys} /
&indentation unit = 'length' levels = {level} /
&output heights = .true. /"""

    def setUp(self):
        super().setUp()
        k = np.arange(40) * 2 * np.pi / 40
        self.z = 1e-3 * (np.sin(3 * k)[:, None] + np.cos(2 * k)[None, :])  # [mm]
        np.savetxt(self.path("map.txt"), self.z * 1e6)

    def heights(self, keys, level=1e-3):
        self.said = self.run_case(self.CASE.format(keys="detrend = 'none' " + keys, level=level))
        return self.result()

    def test_unit_and_pixel(self):
        r = self.heights("height_unit = 'nm' pixel = 0.02")
        np.testing.assert_allclose(r["height"], self.z, rtol=1e-12)
        np.testing.assert_allclose(np.diff(r["height_x"]), 0.02, rtol=1e-12)
        for keys, said in (
            ("height_unit = 'nm'", "pixel"),
            ("height_unit = 'N' pixel = 0.02", "height_unit"),
            ("height_unit = 'nm' pixel = 0.02 L = 0.9", "L"),
        ):
            self.assertIn(said, self.run_case(self.CASE.format(keys=keys, level=1e-3), status=2))

    def test_text_against_another_format(self):
        self.heights("height_unit = 'nm' pixel = 0.02")
        os.rename(self.path("r.nc"), self.path("other.nc"))
        case = (
            self.CASE.replace("R = Infinity, 10.0", "")
            + "\n&indenter shape = 'map' file = 'other.nc' channel = 'height' /"
        )
        text, keys = (
            case.format(keys="{keys} detrend = 'none'", level=5e-4),
            "height_unit = 'nm' pixel = 0.02",
        )
        netcdf = text.replace("map.txt", "other.nc").replace("{keys}", "channel = 'height' {keys}")
        forces = []
        for case in (text.format(keys=keys), netcdf.format(keys="")):
            self.run_case(case)
            forces.append(float(self.result()["force"][0]))
        self.assertGreater(forces[0], 0)
        self.assertAlmostEqual(
            forces[1] / forces[0], 1, delta=1e-9
        )  # the text has 18 digits, in another unit
        self.assertIn("pixel", self.run_case(netcdf.format(keys=keys), status=2))

    def test_border_of_the_indenter(self):
        """Contact at the border of a smaller map of body 2 is counted, as no load is carried
        beyond; contact in its middle is not."""
        np.savetxt(self.path("map.txt"), np.zeros((40, 40)))
        i = np.arange(17) - 8.0
        for bend, at_border in ((-1e-4, False), (1e-4, True)):  # [mm]
            np.savetxt(self.path("body.txt"), 1e6 * bend * (i[:, None] ** 2 + i**2))
            text = self.CASE.replace("R = Infinity, 10.0", "").format(
                keys="detrend = 'none' height_unit = 'nm' pixel = 0.02 sigma = 1e-3",
                level=120e-4 if at_border else -2e-4,
            )
            self.run_case(text + "\n&indenter shape = 'map' file = 'body.txt' /")
            r = self.result()
            self.assertGreater(r["force"][0, 0], 0)
            self.assertEqual(r["edge_contacts"][0, 0] > 0, at_border)
            self.assertTrue(r["status"][0, 0] == 1 or not at_border)

    def test_window(self):
        r = self.heights("height_unit = 'nm' pixel = 0.02 window = 0.1, 0.5, 0.19, 0.7")
        np.testing.assert_allclose(r["height"], self.z[10:36, 5:26], rtol=1e-12)
        np.testing.assert_allclose([r["height_x"][0], r["height_y"][0]], [0.1, 0.2], rtol=1e-12)
        # Points on the border of the window belong to it: 0.14/0.02 is above 7, 0.58/0.02 below 29.
        r = self.heights("height_unit = 'nm' pixel = 0.02 window = 0.14, 0.58, 0.14, 0.58")
        np.testing.assert_allclose(r["height"], self.z[7:30, 7:30], rtol=1e-12)
        self.assertIn(
            "window",
            self.run_case(
                self.CASE.format(
                    keys="height_unit = 'nm' pixel = 0.02 window = 5, 6, 5, 6", level=1e-3
                ),
                status=2,
            ),
        )

    def test_outliers(self):
        spiked = self.z.copy()
        spiked[7, 9] += 0.02
        spiked[20, 30] -= 0.02
        spiked[0, 0] += 0.05
        np.savetxt(self.path("map.txt"), spiked * 1e6)
        r = self.heights("height_unit = 'nm' pixel = 0.02 outliers = 6")
        self.assertEqual((r["outlier_points"], r["filled_points"]), (3, 3))
        self.assertIn("outliers: 3 points", self.said)
        self.assertLess(
            abs(r["height"] - self.z).max(), 3e-4
        )  # the curvature of the waves between the points
        same = np.ones(self.z.shape, bool)
        same[[7, 20, 0], [9, 30, 0]] = False
        np.testing.assert_allclose(r["height"][same], self.z[same], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
