"""A study as a cube of arrays, and as a page.

usage: test_cube.py FOLDER_OF_EXPORT    (RSC_PROGRAM in the environment)
"""
import os
import subprocess
import sys
import tempfile
import unittest

import netCDF4
import numpy as np

folder = sys.argv.pop(1)
sys.path[:0] = [folder, os.path.join(folder, "..", "plot")]
import cube  # noqa: E402
import report  # noqa: E402
import rsc  # noqa: E402


class Studies(unittest.TestCase):
    def test_cube_and_report(self):
        """Every member stands at the values of its keys, in the cube of rsc.read, of cube.py and the page of report.py."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = lambda name: os.path.join(folder.name, name)
        case = """&surface n = 64 L_lambda_l = 4 L_lambda_s = 16 /
&indentation start = 3 stop = 2 steps = 3 /
&study surface%sigma = 0.01, 0.02  asperities%law = 'hertz', 'elliptic', 'fourth_order' /"""
        subprocess.run([os.environ["RSC_PROGRAM"], "-q", "-o", path("r.nc")], input=case, text=True, check=True, stdout=subprocess.DEVNULL)
        with netCDF4.Dataset(path("r_manifest.nc")) as file:  # relative to the manifest, which may move with its members
            self.assertEqual(str(netCDF4.chartostring(file["file"][4])), "r_005.nc")
        read = rsc.read(path("r_manifest.nc"), xarray=False)
        cube.main([path("r_manifest.nc")])
        with netCDF4.Dataset(path("r_cube.nc")) as file:
            self.assertEqual(file["force"].dimensions, ("surface_sigma", "asperities_law", "realization", "step"))
            for i, sigma in enumerate((0.01, 0.02)):
                for j, law in enumerate(("hertz", "elliptic", "fourth_order")):
                    with netCDF4.Dataset(path(f"r_{3 * i + j + 1:03d}.nc")) as member:
                        np.testing.assert_array_equal(file["force"][i, j], member["force"][:])
                        np.testing.assert_array_equal(read["force"][i, j], member["force"][:])
                        self.assertIn(f"law               = '{law}'", member.case)
            self.assertEqual((file["surface_sigma"][:].tolist(), file["asperities_law"][:].tolist()), ([0.01, 0.02], ["hertz", "elliptic", "fourth_order"]))
        self.assertEqual(read["dimensions"]["force"], ("surface_sigma", "asperities_law", "realization", "step"))
        os.remove(path("r_005.nc"))
        read = rsc.read(path("r_manifest.nc"), xarray=False)
        np.testing.assert_array_equal(np.isnan(read["force"][..., 0, 0]), [[False] * 3, [False, True, False]])
        report.main([path("r_manifest.nc")])
        with open(path("r.html"), encoding="utf-8") as page:
            text = page.read()
        self.assertNotIn("http", text.replace("http-equiv", ""))  # nothing is fetched
        self.assertGreater(text.count("data:image/png;base64,iVBOR"), 2)
        for word in ("out of validity", "Yastrebov", "rsc 0.", "0.02"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
