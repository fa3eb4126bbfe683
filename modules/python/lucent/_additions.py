# SPDX-License-Identifier: MIT
"""What Python adds to the registry's classes: indexing, iteration, pictures, numpy."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Sequence
from typing import Any, Dict, Optional, Tuple

from lucent import _lucent
from lucent._frame import Frame, NotConverged


class _Object:
    def __getattr__(self, name: str) -> Any:
        kind = type(self)
        names = [member for member in dir(kind) if not member.startswith("_")]
        raise AttributeError(f"{kind.__name__} has no member '{name}'{_lucent.suggestion(name, names)}")

    def __dir__(self) -> Any:
        dynamic = [entry["name"] for entry in self.get_property_list()] if self._is_valid() else []
        return sorted({*object.__dir__(self), *dynamic})


class _Node:
    def __getitem__(self, path: str) -> Any:
        """The node at a path below this one."""
        node = self.get_node_or_null(path)  # type: ignore[attr-defined]
        if node is None:
            names = [child.name for child in self]
            hint = _lucent.suggestion(str(path), names)
            raise _lucent.NodeNotFoundError(f"{self!r} has no node '{path}'{hint}")
        return node

    def get_node(self, path: str) -> Any:
        """The node at a path; NodeNotFoundError if it is not there."""
        return self[path]

    def __iter__(self) -> Iterator[Any]:
        return iter(self.get_children())  # type: ignore[attr-defined]

    def __len__(self) -> int:
        return int(self.get_child_count())  # type: ignore[attr-defined]

    def __bool__(self) -> bool:
        return True

    def __contains__(self, path: object) -> bool:
        return bool(self.has_node(path)) if isinstance(path, str) else any(child == path for child in self)  # type: ignore[attr-defined]

    def _ipython_key_completions_(self) -> Any:
        return [str(self.get_path_to(node)) for node in self.find_children("*", owned=False)]  # type: ignore[attr-defined]

    def print_tree(self) -> None:
        """Prints the node and all below it."""
        print(self.get_tree_string_pretty(), end="")  # type: ignore[attr-defined]


class _SceneTree:
    def render(
        self,
        size: Tuple[int, int] = (1280, 720),
        camera: Any = None,
        frames: Optional[int] = None,
        aovs: Sequence[str] = (),
        delta: float = 1 / 60,
        device: Optional[str] = None,
        srgb: bool = True,
    ) -> Frame:
        """Draws the scene: (width, height) pixels, until its light has converged or for that many frames of `delta` seconds.

        camera: a Camera3D; by default the current one, the first one, or one that frames the scene. aovs: direct, indirect_diffuse,
        indirect_specular, emission, albedo, normal, depth, motion. The device is opened at the first picture: `device` is an index or a
        part of its name, else LUCENT_DEVICE says, else the best one is taken.
        """
        if frames is not None and frames < 1:
            raise ValueError(f"frames: expected at least 1, got {frames}")
        width, height = size
        color, display, layers, stats = _lucent.render(
            self, width, height, camera, frames or 0, list(dict.fromkeys(aovs)), delta, device or "", srgb
        )
        frame = Frame(color, display, layers, json.loads(stats))
        if frames is None and not frame.stats["converged"]:
            warnings.warn(f"the light still changes after {frame.stats['frames']} frames", NotConverged, stacklevel=2)
        return frame

    def attach(self, path: Any, script: Any) -> Any:
        """Makes the node at a path below the current scene (or a node) an instance of a Python class, and answers it."""
        node = self.current_scene[path] if isinstance(path, str) else path  # type: ignore[attr-defined]
        return _lucent.attach(node, script)

    def close(self) -> None:
        """Ends the tree and all its nodes. Twice is fine."""
        _lucent.close(self)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


class _ArrayMesh:
    @classmethod
    def from_arrays(
        cls, positions: Any, indices: Any = None, normals: Any = None, uvs: Any = None, colors: Any = None, material: Any = None
    ) -> Any:
        """A mesh of one surface. positions, normals (N, 3), uvs (N, 2), colors (N, 4) linear; indices 3 a triangle,
        counter-clockwise is the front. float32 and uint32 are copied once, other dtypes are converted first."""
        mesh = cls()
        _lucent.add_surface(mesh, positions, indices, normals, uvs, colors, material)
        return mesh

    def get_surface_views(self, surface: int) -> Any:
        """A surface's arrays by name, read-only, without a copy: positions, indices, normals, uvs, colors."""
        return _lucent.surface_views(self, surface)


class _ImageTexture:
    @classmethod
    def from_array(cls, pixels: Any) -> Any:
        """A texture of (H, W, 3) or (H, W, 4): uint8 is sRGB-encoded, floats are linear."""
        texture = cls()
        _lucent.set_image(texture, pixels)
        return texture


ADDITIONS = {"Object": _Object, "Node": _Node, "SceneTree": _SceneTree, "ArrayMesh": _ArrayMesh, "ImageTexture": _ImageTexture}


def members(name: str) -> Dict[str, Any]:
    source = ADDITIONS.get(name)
    if source is None:
        return {}
    return {key: value for key, value in vars(source).items() if key not in ("__dict__", "__weakref__", "__module__", "__doc__")}


def apply_scripts(tree: Any, scripts: Dict[str, Any]) -> None:
    for group, script in scripts.items():
        for node in tree.get_nodes_in_group(group):
            _lucent.attach(node, script)
