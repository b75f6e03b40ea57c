"""A folder for each test, and small result files with numbers of one's own, named and shaped as
those of rsc."""
import os
import tempfile
import unittest

import netCDF4
import numpy as np


class InFolder(unittest.TestCase):
    """Tests each in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)


def write_result(folder, name, case, variables, attributes=None, title="", source="rsc 0.0"):
    """variables: {name: (dimensions in one text, values[, unit])}; attributes: {(variable, or ''
    for the file, attribute): value}; case: {'group%key': value}. Texts stand in quotes."""
    path = os.path.join(folder, name + ".nc")
    if os.path.exists(path):  # it may be open still
        os.remove(path)
    with netCDF4.Dataset(path, "w") as file:
        for key, (dimensions, values, *unit) in variables.items():
            values = np.asarray(values)
            for dimension, size in zip(dimensions.split(), values.shape):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            variable = file.createVariable(
                key, "f8", tuple(dimensions.split()), fill_value=9.96920996838687e36
            )
            variable[...] = np.where(np.isnan(values.astype(float)), 9.96920996838687e36, values)
            variable.units = unit[0] if unit else "1"
        for (key, attribute), value in (attributes or {}).items():
            (file[key] if key else file).setncattr(attribute, value)
        groups = {}
        for key, value in case.items():
            group, word = key.split("%")
            groups.setdefault(group, []).append(f"  {word} = {value}")
        file.case = "\n".join(
            f"&{group}\n" + "\n".join(lines) + "\n/" for group, lines in groups.items()
        )
        file.title, file.source = title, source
    return path
