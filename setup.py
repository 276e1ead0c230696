"""Builds the extension of `pip install .` by CMake.

CLEARLOCI_BUILD names a build tree to take it from instead, as build/release, where its module is up to date."""

import os
import re
import shutil
import subprocess
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = Path(__file__).parent.resolve()
version = re.search(r"project\(clearloci VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        tree = Path(os.environ.get("CLEARLOCI_BUILD") or self.build_temp).resolve()
        if "CLEARLOCI_BUILD" not in os.environ:
            options = {"BUILD_TYPE": "Release"}
            own = {"PYTHON": "ON", "BUILD_TESTS": "OFF", "WORKBENCH": "OFF", "UNITY": "ON"}
            subprocess.check_call(
                ["cmake", "-S", str(root), "-B", str(tree), "-G", "Ninja"]
                + [f"-DCMAKE_{name}={value}" for name, value in options.items()]
                + [f"-DCLEARLOCI_{name}={value}" for name, value in own.items()]
            )
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
