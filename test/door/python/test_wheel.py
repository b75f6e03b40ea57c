"""pip install of modules/ without a network: a wheel with the library inside, used from elsewhere.

usage: test_wheel.py MODULES      RSC_LIBRARY in the environment: the library that goes inside
"""
import os
import subprocess
import sys
import tempfile

# What a user runs: the library must be the one in the wheel, typed, and give the closed form.
SCRIPT = """
import math, os, rsc
folder = os.path.dirname(rsc.__file__)
assert rsc._library.shared_object_path.startswith(folder), rsc._library.shared_object_path
assert os.path.exists(os.path.join(folder, "py.typed"))
contact = rsc.Contact(rsc.Asperities.take([0.0], [0.0], [0.0], [0.3]), 2e5, math.inf)
print(contact.indent(-1e-3) / (4 / 3 * 2e5 * math.sqrt(0.3) * 1e-3**1.5) - 1)
"""


def main(modules):
    with tempfile.TemporaryDirectory() as folder:
        make = [sys.executable, "-m", "venv", "--system-site-packages", folder]
        if subprocess.run(make, capture_output=True).returncode != 0:
            print("left out: this Python has no venv with pip")
            return 77
        python = os.path.join(folder, "bin", "python")
        away = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
        install = [python, "-m", "pip", "install", "--no-index", "--no-deps", modules]
        subprocess.run(install, check=True, env=away, cwd=folder)
        del away["RSC_LIBRARY"]
        ran = subprocess.run(
            [python, "-c", SCRIPT], capture_output=True, text=True, env=away, cwd=folder
        )
        print(ran.stdout, ran.stderr)
        return 0 if ran.returncode == 0 and abs(float(ran.stdout)) < 1e-12 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
