"""Builds the extension of `pip install .` by CMake.

CLEARLOCI_BUILD names a build tree to take it from instead, as build/release, where its module is up to date."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).parent.resolve()
version = re.search(r"project\(clearloci VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        tree = Path(os.environ.get("CLEARLOCI_BUILD") or self.build_temp).resolve()
        if "CLEARLOCI_BUILD" not in os.environ:
            # The Python that runs pip, whatever other one CMake would find first.
            options = {"CMAKE_BUILD_TYPE": "Release", "Python3_EXECUTABLE": sys.executable, "CLEARLOCI_PYTHON": "ON"}
            options |= {"CLEARLOCI_BUILD_TESTS": "OFF", "CLEARLOCI_WORKBENCH": "OFF", "CLEARLOCI_UNITY": "ON"}
            configure = ["cmake", "-S", str(root), "-B", str(tree), "-G", "Ninja"]
            subprocess.check_call(configure + [f"-D{name}={value}" for name, value in options.items()])
            subprocess.check_call(["cmake", "--build", str(tree), "--target", "clearloci_python"])
        built = next((tree / "python" / "clearloci").glob("_clearloci*.so"))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)


setup(
    version=version,
    ext_modules=[Extension("clearloci._clearloci", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
