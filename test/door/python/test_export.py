"""Tables of results: exact at the levels, a power law kept between them, nothing beyond them;
standard errors by their definition. A study as a cube of arrays, and as a page.

usage: test_export.py FOLDER_OF_EXPORT    (RSC_PROGRAM in the environment)
"""
import contextlib
import csv
import io
import os
import subprocess
import sys
import unittest

import netCDF4
import numpy as np

EXPORT = sys.argv.pop(1)
sys.path[:0] = [EXPORT, os.path.join(EXPORT, "..", "plot")]
import cube  # noqa: E402
import fields  # noqa: E402
import law  # noqa: E402
import plot  # noqa: E402
import plot_results  # noqa: E402
import report  # noqa: E402
import rsc  # noqa: E402
import table  # noqa: E402
from result_files import InFolder, write_result  # noqa: E402

FORCE = np.array([1.0, 4.0, 20.0, 100.0])
MEANINGS = {
    ("status", "flag_meanings"): "converged out_of_validity overlapping not_unique not_converged",
    ("force", "ancillary_variables"): "force_error_expected",
}


def result(folder, name="power", status=(0, 0, 2, 1), force=FORCE, area=None, more={}):
    """A = 0.3 N^0.9, separation 0.01 - 0.002 ln N, which changes its sign."""
    return write_result(
        folder,
        name,
        {},
        {
            "force": ("step", force, "N"),
            "contact_area": (
                "realization step",
                np.atleast_2d(0.3 * force**0.9 if area is None else area),
                "mm2",
            ),
            "separation": ("step", 0.01 - 0.003 * np.log(force), "mm"),
            "status": ("realization step", np.atleast_2d(status)),
            "force_error_expected": (
                "realization step",
                np.full(np.atleast_2d(status).shape, 0.07),
            ),
        },
        MEANINGS | more,
    )


class Tables(InFolder):
    def test_exact_at_levels_and_a_power_law_between(self):
        read = table.Table(result(self.folder))
        columns, words = read.at(FORCE)
        for name, values in read.columns.items():
            np.testing.assert_array_equal(columns[name], values, name)
        self.assertEqual(words, ["converged", "converged", "overlapping", "out_of_validity"])
        between = np.array([2.0, 10.0, 50.0])
        columns, words = read.at(between)
        np.testing.assert_allclose(columns["contact_area"], 0.3 * between**0.9, rtol=1e-12)
        self.assertEqual(words, ["converged", "overlapping", "out_of_validity"])
        path = result(self.folder, "doubted", (0, 1, 0, 1))
        with netCDF4.Dataset(path, "a") as file:
            doubts = file.createVariable("doubts", "i4", ("realization", "step"))
            doubts[:] = [[0, 3, 0, 2]]
            doubts.flag_masks, doubts.flag_meanings = np.array([1, 2], "i4"), "few_points grid"
        self.assertEqual(
            table.Table(path).words, ["converged", "few points, grid", "converged", "grid"]
        )
        # Over realizations the gravest: 4 before 1 before 3 before 2.
        path = result(self.folder, "grave", [(1, 2, 0, 3), (2, 3, 1, 4)], area=np.ones((2, 4)))
        for worst in (table.Table(path).status, plot_results.Result(path).level_status()):
            np.testing.assert_array_equal(worst, [1, 3, 1, 4])
        self.assertTrue(
            np.all(
                (columns["separation"] < read.columns["separation"][:-1])
                & (columns["separation"] > read.columns["separation"][1:])
            )
        )
        columns, _ = read.at([0.01], "separation")
        self.assertAlmostEqual(columns["force"][0], 1.0, 12)

    def test_refuses_beyond_the_levels(self):
        path = result(self.folder)
        for words in (
            ["--at", "101"],
            ["--at", "0.5"],
            ["--at", "1", "--by", "separation"],
            ["--at", "1", "--by", "pressure"],
        ):
            with self.assertRaises(SystemExit) as ended:
                table.main([path, *words])
            self.assertIn(words[1] if words[-1] != "pressure" else "pressure", str(ended.exception))

    def test_the_way_back_is_left_out(self):
        read = table.Table(
            result(
                self.folder,
                "back",
                (0,) * 5,
                np.append(FORCE, 20.0),
                np.append(0.3 * FORCE**0.9, 9.0),
                {("", "path"): "each level depends on the previous ones"},
            )
        )
        self.assertAlmostEqual(read.at([20.0])[0]["contact_area"][0], 0.3 * 20**0.9, 12)

    def test_levels_in_any_order(self):
        """Elastic levels do not depend on each other."""
        read = table.Table(result(self.folder, "order", force=FORCE[[2, 0, 3, 1]]))
        np.testing.assert_allclose(
            read.at([2.0, 50.0])[0]["contact_area"], 0.3 * np.array([2.0, 50.0]) ** 0.9, rtol=1e-12
        )

    def test_counts_are_whole(self):
        path = result(self.folder, "counts")
        with netCDF4.Dataset(path, "a") as file:
            file.createVariable("contacts", "i8", ("realization", "step"))[:] = [[3, 4, 9, 20]]
        columns, _ = table.Table(path).at([2.0, 5.0, 20.0])
        np.testing.assert_array_equal(columns["contacts"], np.round(columns["contacts"]))
        self.assertTrue(np.all(np.diff(columns["contacts"]) >= 0))

    def test_a_closed_gap_is_no_power_law(self):
        """The rounding of separations of 0 neither hides levels nor spoils those between."""
        closed = np.array([0.3, 0.9, 1.0, 1.0])
        path = result(self.folder, "closed", (0,) * 4, area=closed)
        with netCDF4.Dataset(path, "a") as file:
            file["separation"][:] = [1e-3, 1e-4, 1.1e-20, 1.3e-20]
        columns, _ = table.Table(path).at([0.5 * (FORCE[1] + FORCE[2]), FORCE[2] + 1])
        self.assertGreater(columns["separation"][0], 1e-6)
        self.assertEqual(columns["contact_area"][1], 1)

    def test_standard_error_over_the_realizations_that_converged(self):
        area = np.random.default_rng(3).uniform(1, 2, (6, 4))
        status = np.zeros((6, 4))
        status[2, 1] = 4
        read = table.Table(result(self.folder, "many", status, area=area))
        np.testing.assert_allclose(
            read.columns["contact_area_stderr"][0], area[:, 0].std(ddof=1) / np.sqrt(6), rtol=1e-12
        )
        there = np.delete(area[:, 1], 2)
        np.testing.assert_allclose(
            [read.columns["contact_area"][1], read.columns["contact_area_stderr"][1]],
            [there.mean(), there.std(ddof=1) / np.sqrt(5)],
            rtol=1e-12,
        )

    def test_geometric_means_of_open_gaps(self):
        K = np.random.default_rng(4).uniform(1, 9, (5, 4, 3))
        K[:, :, :2] *= [[[1, 1], [1, 0], [1, 1], [0, 0]]] * 5
        K[3, 2, 0] = 0
        path = result(self.folder, "seal", np.zeros((5, 4)), area=np.ones((5, 4)))
        with netCDF4.Dataset(path, "a") as file:
            file.createDimension("tensor_component", 3)
            names = "realization", "step", "tensor_component"
            file.createVariable("permeability", "f8", names)[:] = K
        columns = table.Table(path).columns
        x, y = columns["permeability_x"], columns["permeability_y"]
        np.testing.assert_allclose(x[0], np.prod(K[:, 0, 0]) ** 0.2, rtol=1e-12)
        np.testing.assert_allclose(x[2], np.prod(K[[0, 1, 2, 4], 2, 0]) ** 0.25, rtol=1e-12)
        self.assertEqual([x[3], y[1]], [0, 0])
        np.testing.assert_allclose(
            columns["permeability_x_ln_stderr"][0],
            np.log(K[:, 0, 0]).std(ddof=1) / np.sqrt(5),
            rtol=1e-12,
        )

    def test_depths_and_errors(self):
        """The largest stress over the depths with the error that belongs to this depth; by name
        all depths; the stiffness of the force against the separation with its sign turned."""
        mises = np.array([[[1.0, 5.0, 2.0], [7.0, 3.0, 4.0], [1.0, 2.0, 8.0], [0.0, 6.0, 1.0]]])
        path = result(self.folder, "depths")
        with netCDF4.Dataset(path, "a") as file:
            file.createDimension("depth", 3)
            file.createVariable("depth", "f8", "depth")[:] = [0.1, 0.2, 0.4]
            file["depth"].units = "mm"
            dimensions = "realization", "step", "depth"
            file.createVariable("mises_max", "f8", dimensions)[:] = mises
            file["mises_max"].ancillary_variables = "mises_max_error_expected"
            file.createVariable("mises_max_error_expected", "f8", dimensions)[:] = mises / 100
            file.createVariable("stiffness", "f8", dimensions[:2])[:] = -mises[:, :, 0]
        columns = table.Table(path).columns
        np.testing.assert_array_equal(columns["mises_max"], [5, 7, 8, 6])
        np.testing.assert_array_equal(columns["mises_max_depth"], [0.2, 0.1, 0.4, 0.2])
        np.testing.assert_array_equal(
            columns["mises_max_error_expected"], columns["mises_max"] / 100
        )
        np.testing.assert_array_equal(columns["normal_stiffness"], mises[0, :, 0])
        columns = table.Table(path, ["mises_max"]).columns
        self.assertEqual(list(columns)[:3], ["force", "force_error_expected", "separation"])
        np.testing.assert_array_equal(columns["mises_max_at_0.4"], mises[0, :, 2])
        with self.assertRaisesRegex(table.Refused, "no 'leak'.*it has force, .*mises_max"):
            table.Table(path, ["leak"])

    def test_what_is_printed(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            table.main(
                [
                    result(self.folder, "a"),
                    result(self.folder, "b"),
                    "--at",
                    "4,20",
                    "--format",
                    "csv",
                ]
            )
        lines = list(csv.DictReader(said.getvalue().splitlines()))
        self.assertEqual(
            [
                (
                    line["file"],
                    float(line["force [N]"]),
                    float(line["force_error_expected"]),
                    line["status"],
                )
                for line in lines
            ],
            [
                (name, force, 0.07, status)
                for name in ("a.nc", "b.nc")
                for force, status in ((4.0, "converged"), (20.0, "overlapping"))
            ],
        )
        self.assertEqual(table.markdown(["a", "b"], [["1", "22"]]).splitlines()[2], "| 1 | 22 |")
        header = ["x [mm]", "x_error_expected", "y", "y_error_expected [mm]"]
        self.assertEqual(
            table.markdown(header, [["2", "0.05", "3", "0.25"]]).splitlines()[2],
            "| 2 +- 5 % | 3 +- 0.25 |",
        )


class Damage(InFolder):
    def test_cut_results_are_refused(self):
        """By every reader, in every format: without the last line, cut in half, and of the full
        length with zeros at the end."""
        case = """&surface n = 64 L_lambda_l = 4 L_lambda_s = 16 / &indentation steps = 3 /
&output format = '%s' fields = 'pressure' /"""
        path = self.path("r.nc")
        readers = {
            "rsc.read": lambda: rsc.read(path, xarray=False),
            "table": lambda: table.main([path]),
            "law": lambda: law.main([path, "--table"]),
            "report": lambda: report.main([path]),
            "plot": lambda: plot.main([path, "-o", self.folder]),
            "cube": lambda: cube.main([path]),
            "fields": lambda: fields.main([path, "--format", "csv"]),
            "--case": lambda: subprocess.run(
                [os.environ["RSC_PROGRAM"], "--case", path], check=True, capture_output=True
            ),
        }
        refusals = SystemExit, rsc.Error, subprocess.CalledProcessError
        for kind in ("netcdf4", "classic", "cdf5"):
            command = [os.environ["RSC_PROGRAM"], "-q", "-o", path]
            subprocess.run(command, input=case % kind, text=True, check=True)
            with open(path, "rb") as file:
                whole = file.read()
            for lost in (47, len(whole) // 2):
                for end in (b"", b"\0" * lost):
                    if kind == "netcdf4" and len(end) > 100:
                        continue  # HDF5 may destroy memory
                    with open(path, "wb") as file:
                        file.write(whole[: len(whole) - lost] + end)
                    for name, reader in readers.items():
                        with self.subTest(kind=kind, lost=lost, end=len(end), reader=name):
                            with self.assertRaises(refusals), contextlib.redirect_stdout(None):
                                reader()
            os.remove(path)


class Studies(InFolder):
    def test_cube_and_report(self):
        """Every member stands at the values of its keys, in the cube of rsc.read, of cube.py and
        the page of report.py."""
        path = self.path
        case = """&surface n = 64 L_lambda_l = 4 L_lambda_s = 16 /
&indentation start = 3 stop = 2 steps = 3 /
&study surface%sigma = 0.01, 0.02  asperities%law = 'hertz', 'elliptic', 'fourth_order' /"""
        subprocess.run(
            [os.environ["RSC_PROGRAM"], "-q", "-o", path("r.nc")],
            input=case,
            text=True,
            check=True,
            stdout=subprocess.DEVNULL,
        )
        with netCDF4.Dataset(
            path("r_manifest.nc")
        ) as file:  # relative to the manifest, which may move with its members
            self.assertEqual(str(netCDF4.chartostring(file["file"][4])), "r_005.nc")
        read = rsc.read(path("r_manifest.nc"), xarray=False)
        cube.main([path("r_manifest.nc")])
        with netCDF4.Dataset(path("r_cube.nc")) as file:
            self.assertEqual(
                file["force"].dimensions, ("surface_sigma", "asperities_law", "realization", "step")
            )
            for i, sigma in enumerate((0.01, 0.02)):
                for j, law in enumerate(("hertz", "elliptic", "fourth_order")):
                    with netCDF4.Dataset(path(f"r_{3 * i + j + 1:03d}.nc")) as member:
                        np.testing.assert_array_equal(file["force"][i, j], member["force"][:])
                        np.testing.assert_array_equal(read["force"][i, j], member["force"][:])
                        self.assertIn(f"law               = '{law}'", member.case)
            self.assertEqual(
                (file["surface_sigma"][:].tolist(), file["asperities_law"][:].tolist()),
                ([0.01, 0.02], ["hertz", "elliptic", "fourth_order"]),
            )
        self.assertEqual(
            read["dimensions"]["force"], ("surface_sigma", "asperities_law", "realization", "step")
        )
        for names in None, ["contact_area", "stiffness"]:  # as in the table of a member alone
            header, lines = table.rows([path("r_manifest.nc")], None, None, names)
            for k in range(6):
                own, rows = table.rows([path(f"r_{k + 1:03d}.nc")], None, None, names)
                for row, line in zip(rows, lines[k * len(rows) :]):
                    self.assertLessEqual(set(zip(own, row)), set(zip(header, line)))
        os.remove(path("r_005.nc"))
        read = rsc.read(path("r_manifest.nc"), xarray=False)
        np.testing.assert_array_equal(
            np.isnan(read["force"][..., 0, 0]), [[False] * 3, [False, True, False]]
        )
        report.main([path("r_manifest.nc")])
        with open(path("r.html"), encoding="utf-8") as page:
            text = page.read()
        self.assertNotRegex(
            text, "https?:"
        )  # nothing is fetched; pictures in base64 may contain "http", but no colon
        self.assertGreater(text.count("data:image/png;base64,iVBOR"), 2)
        for word in ("with doubts: ", "Yastrebov", "rsc 0.", "0.02"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
