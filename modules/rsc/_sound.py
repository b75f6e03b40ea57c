"""Opens result files, and refuses those that are cut or damaged. Needs no library of rsc: the
scripts in output/ use it, too."""

import errno
import mmap
import re
import zlib

import netCDF4

_START = b"\nrsc: CRC-32 of all before this line: "
_SOURCE = re.compile(rb"(?<! )rsc (\d+)\.(\d+)\.\d+, ")  # begins the attribute source of a result


def open_result(path):
    """The netCDF4.Dataset of a result. Raises OSError if it cannot be opened, if its last line, the
    checksum, is wrong, or if a result of rsc 0.3 or later lacks this line: of a cut file the NetCDF
    library returns zeros, and HDF5 crashes on some damaged files."""
    _check(path)
    return netCDF4.Dataset(path)


def _check(path):
    try:
        with open(path, "rb") as file:
            content = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except (OSError, ValueError):
        return  # reported when it is opened
    with content, memoryview(content) as view:
        line = bytes(view[-len(_START) - 9 :])
        if line.startswith(_START):
            if line != _START + b"%08x\n" % zlib.crc32(view[: -len(line)]):
                raise OSError(
                    errno.EIO,
                    "is damaged, or was changed since rsc wrote it: its checksum is wrong",
                    path,
                )
            return
        source = _SOURCE.search(view)
        if source and (int(source[1]), int(source[2])) >= (0, 3):
            raise OSError(
                errno.EIO,
                "is cut or damaged: its last line, the checksum that rsc writes, is missing (a copy "
                "made by another program is read if its attribute source does not begin with 'rsc')",
                path,
            )
