# SPDX-License-Identifier: MIT
"""Lucent from Python: scenes with Godot's names, real-time global illumination, pictures as numpy arrays.

    import lucent
    tree = lucent.open("room.tscn")
    lucent.save("room.png", tree.render())
"""

import sys as _sys

try:
    import numpy as _numpy
except ImportError as _error:
    raise ImportError(f"lucent needs numpy, which {_sys.executable} lacks (Debian: apt-get install python3-numpy for /usr/bin/python3)") from _error
try:
    from lucent import _lucent
except ImportError as _error:
    import glob as _glob
    import os as _os

    _built = [_os.path.basename(name) for name in _glob.glob(_os.path.join(_os.path.dirname(__file__), "_lucent.*.so"))]
    raise ImportError(
        f"lucent is built for {', '.join(_built) or 'no Python'}; this is {_sys.implementation.cache_tag} ({_sys.executable}). "
        f"`./lucent python` runs the one that fits. ({_error})"
    ) from _error

import atexit as _atexit
import os as _os

from lucent import _additions, _classes
from lucent._classes import Signal
from lucent._frame import Frame, NotConverged
from lucent._lucent import DeviceError, Error, FreedObjectError, LoadError, NodeNotFoundError
from lucent._values import AABB, Basis, Color, NodePath, Quaternion, Transform3D, Vector2, Vector2i, Vector3, Vector3i, Vector4

version = _lucent.version
globals().update(_classes.make_classes())


def open(path, scripts=None):
    """A SceneTree that runs the scene of a file (.tscn, .glb, .gltf), with what `lucent render` adds where there is no environment.

    scripts: Python classes by group; each node of that group becomes an instance.
    """
    tree = SceneTree()  # noqa: F821
    _lucent.open_scene(tree, _os.fspath(path))
    _additions.apply_scripts(tree, scripts or {})
    return tree


def load(path):
    """The resource of a file: a scene becomes a PackedScene, a picture an ImageTexture."""
    return _lucent.load(_os.fspath(path))


def save(path, picture):
    """Writes a Frame, or an array (H, W, 3): uint8 as .png, linear floats as .exr or, encoded, as .png."""
    from lucent._frame import encode

    if isinstance(picture, Frame):
        return picture.save(path)
    array = _numpy.asarray(picture)
    name = _os.fspath(path)
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or not name.lower().endswith((".png", ".exr")):
        raise ValueError(f"{name}: expected a Frame or an array (H, W, 3), and a name that ends in .png or .exr")
    if name.lower().endswith(".exr"):
        return _lucent.write_exr(name, {"": array[:, :, :3]})
    return _lucent.write_png(name, array if array.dtype == _numpy.uint8 else encode(array))


def attach(node, script):
    """Makes a node an instance of a Python class, as a script in Godot, and answers it."""
    return _lucent.attach(node, script)


def reference(tree, size=(256, 144), spp=64, camera=None, seed=0, aovs=()):
    """The path-traced truth of a tree's scene as a Frame; aovs: direct, indirect, emission, background, albedo, normal, depth, variance."""
    wanted = [name for name in dict.fromkeys(aovs) if name != "variance"]
    color, variance, layers, rays, seconds = _lucent.reference(tree, size[0], size[1], camera, spp, seed, wanted)
    if "variance" in aovs:
        layers["variance"] = variance
    return Frame(color, None, layers, {"frames": spp, "spp": spp, "rays": rays, "seconds": seconds})


def compare(a, b, exposure=1.0):
    """How far a picture is from the truth b, as `lucent compare` says it: a dict of rmse, nrmse, energy, ssim, flip and others."""
    return _lucent.compare(_numpy.asarray(a), _numpy.asarray(b), exposure)


def devices():
    """The names of the Vulkan devices, best first."""
    return list(_lucent.devices())


def is_instance_valid(instance):
    """Whether the object lives."""
    return isinstance(instance, _lucent.Handle) and instance._is_valid()


_atexit.register(_lucent.close_all)
_os.register_at_fork(after_in_child=_lucent.note_fork)
