"""Opens result files, and refuses those that are cut or damaged. Needs no library of rsc: the
scripts in output/ use it, too."""

import errno
import re
import zlib

import netCDF4
import numpy as np

_START = b"\nrsc: CRC-32 of all before this line: "


def open_result(path):
    """The netCDF4.Dataset of a result. Raises OSError if it cannot be opened, if its last line, the
    checksum, is wrong, or if a result of rsc 0.3 or later lacks this line: of a cut file the NetCDF
    library returns zeros. The checksum comes first, because HDF5 crashes on some damaged files."""
    complete = _has_checksum(path)
    file = netCDF4.Dataset(path)
    version = re.match(r"rsc (\d+)\.(\d+)\.", getattr(file, "source", ""))
    if not complete and version and (int(version[1]), int(version[2])) >= (0, 3):
        file.close()
        raise OSError(
            errno.EIO,
            "is cut or damaged: its last line, the checksum that rsc writes, is missing (a copy "
            "made by another program is read if its attribute source does not begin with 'rsc')",
            path,
        )
    return file


def _has_checksum(path):
    try:
        content = np.memmap(path, np.uint8, "r")
    except (OSError, ValueError):
        return False  # reported when it is opened
    line = bytes(content[-len(_START) - 9 :])
    if not line.startswith(_START):
        return False
    if line != _START + b"%08x\n" % zlib.crc32(content[: -len(line)]):
        raise OSError(
            errno.EIO,
            "is damaged, or was changed since rsc wrote it: its checksum is wrong",
            path,
        )
    return True
