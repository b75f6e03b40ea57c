"""Makes the wheel of rsc for pip (PEP 517): the Python package with the library of a built tree.

    pip install ./modules

The library is build/librsc.so, or that of the environment variable RSC_LIBRARY. It uses shared
libraries of this system (FFTW, NetCDF, LAPACK, ...), so that the wheel serves machines with the
same distribution. Nothing is compiled or downloaded; setuptools is not needed.
"""

import base64
import glob
import hashlib
import os
import re
import sysconfig
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)


def library():
    paths = [os.environ.get("RSC_LIBRARY")] if os.environ.get("RSC_LIBRARY") else []
    paths += [os.path.join(ROOT, "build", name) for name in ("librsc.so", "librsc.dylib")]
    path = next((path for path in paths if os.path.exists(path)), None)
    if path is None:
        raise SystemExit(f"{paths[0]}: not found; build rsc first, or set RSC_LIBRARY to its path")
    return path


def version():
    with open(os.path.join(ROOT, "src", "base", "version.h"), encoding="utf-8") as file:
        return re.search(r'RSC_VERSION "(.*?)"', file.read())[1]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel into a folder and returns its name."""
    tag = "py3-none-" + re.sub(r"[-.]", "_", sysconfig.get_platform())
    about = f"rsc-{version()}.dist-info"
    files = {
        f"{about}/METADATA": f"Metadata-Version: 2.1\nName: rsc\nVersion: {version()}\n"
        "Summary: Elastic contact of rough surfaces\nLicense: BSD-3-Clause\n"
        "Requires-Python: >=3.9\nRequires-Dist: numpy\n",
        f"{about}/WHEEL": "Wheel-Version: 1.0\nGenerator: rsc\nRoot-Is-Purelib: false\n"
        f"Tag: {tag}\n",
    }
    files = {name: text.encode() for name, text in files.items()}
    package = glob.glob(os.path.join(HERE, "rsc", "*.py")) + [os.path.join(HERE, "rsc", "py.typed")]
    sources = {"rsc/" + os.path.basename(path): path for path in package}
    sources["rsc/lib/" + os.path.basename(library())] = library()
    for name, path in sorted(sources.items()):
        with open(path, "rb") as file:
            files[name] = file.read()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{about}/RECORD"] = (record + f"{about}/RECORD,,\n").encode()
    wheel = f"rsc-{version()}-{tag}.whl"
    with zipfile.ZipFile(
        os.path.join(wheel_directory, wheel), "w", compression=zipfile.ZIP_DEFLATED
    ) as out:
        for name, content in files.items():
            out.writestr(name, content)
    return wheel
