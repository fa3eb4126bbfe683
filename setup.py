# SPDX-License-Identifier: MIT
"""Builds the module by scons and packs what it made. The shaders are inside of it."""

import os
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

ROOT = os.path.dirname(os.path.abspath(__file__))


class BuildModule(build_py):
    def run(self):
        subprocess.run(["scons", "-Q", "module_python_enabled=yes", "python"], cwd=ROOT, check=True)
        super().run()


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True


os.makedirs(os.path.join(ROOT, "bin/python/lucent"), exist_ok=True)
setup(
    packages=["lucent"],
    package_dir={"lucent": "bin/python/lucent"},
    package_data={"lucent": ["*.so", "*.pyi", "py.typed"]},
    cmdclass={"build_py": BuildModule},
    distclass=BinaryDistribution,
)
