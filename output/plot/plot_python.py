"""Finds a Python that has the modules of a script. A python3 of pyenv, conda or a virtual
environment often lacks them, while that of the system has them."""

import importlib.util
import os
import shutil
import subprocess
import sys

_DEBIAN = {
    "numpy": "python3-numpy",
    "scipy": "python3-scipy",
    "netCDF4": "python3-netcdf4",
    "matplotlib": "python3-matplotlib",
}


def needs(*modules):
    """Returns if this Python has the modules. Otherwise runs the script again with another Python
    of this machine that has them, and reports it; ends with a message that lists the packages to
    install if there is none. To be called first in a script, before it imports them."""
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if not missing:
        return
    script = os.path.basename(sys.argv[0])
    places = [os.environ.get("PYTHON", ""), "/usr/bin/python3", "/usr/local/bin/python3"]
    places += [
        os.path.join(folder, "python3") for folder in os.environ.get("PATH", "").split(os.pathsep)
    ]
    for python in dict.fromkeys(
        place for place in map(shutil.which, filter(None, places)) if place
    ):
        test = subprocess.run(
            [python, "-c", "import " + ", ".join(modules)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
        )
        if test.returncode == 0:
            print(
                f"{script}: {sys.executable} lacks {', '.join(missing)}; running with {python}",
                file=sys.stderr,
            )
            sys.stderr.flush()
            os.execv(python, [python, *sys.argv])
    sys.exit(
        f"{script}: {sys.executable} lacks {', '.join(missing)}, and no other Python here has "
        "them all. Install them with\n"
        f"    sudo apt-get install {' '.join(_DEBIAN.get(name, name) for name in modules)}    "
        " (Debian, Ubuntu), or\n"
        f"    {sys.executable} -m pip install {' '.join(missing)}"
    )


def open_result(path):
    """The netCDF4.Dataset of a result; raises OSError for a damaged one (modules/rsc/_sound.py, of
    which an installation has a copy beside this file)."""
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path.append(os.path.join(here, "..", "..", "modules", "rsc"))
    try:
        from _sound import open_result as opened
    finally:
        sys.path.pop()
    return opened(path)
