# An optional module: present means offered as module_<name>_enabled. depends: modules that it cannot be built without.
import os

depends = ["scene", "image", "reference", "tscn"]


def can_build():
    """Whether Debian's python3-dev, pybind11-dev and python3-numpy are there. It is off where they aren't."""
    return all(os.path.exists(path) for path in ["/usr/include/python3.11/Python.h", "/usr/include/pybind11/pybind11.h", "/usr/lib/python3/dist-packages/numpy"])
