# SPDX-License-Identifier: MIT
"""Pictures."""

from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, Optional

import numpy
import numpy.typing

from lucent import _lucent

Floats = numpy.typing.NDArray[numpy.float32]
Bytes = numpy.typing.NDArray[numpy.uint8]


class NotConverged(UserWarning):
    """The light was still changing when the frames ran out."""


class Frame:
    """A picture: row 0 is the top, radiance is linear and scene-referred. numpy.asarray(frame) is frame.color, without a copy."""

    def __init__(self, color: Floats, srgb: Optional[Bytes], aovs: Dict[str, Floats], stats: Dict[str, Any]) -> None:
        self.color = color
        """(H, W, 3) float32, linear."""
        self._srgb = srgb
        self.aovs = aovs
        """The other layers by name."""
        self.stats = stats
        """As `lucent render --stats` writes them."""

    @property
    def srgb(self) -> Bytes:
        """(H, W, 3) uint8 as a display shows it, tone-mapped."""
        if self._srgb is None:
            raise AttributeError("this frame has no display picture: render(srgb=True) makes one")
        return self._srgb

    def __getitem__(self, name: str) -> Floats:
        """A layer by name: frame["depth"] is (H, W) in metres."""
        if name not in self.aovs:
            raise KeyError(f"'{name}' was not asked for: render(aovs=['{name}'])")
        return self.aovs[name]

    def __array__(self, dtype: Any = None) -> numpy.typing.NDArray[Any]:
        return self.color if dtype is None or dtype == self.color.dtype else self.color.astype(dtype)

    def __repr__(self) -> str:
        height, width = self.color.shape[:2]
        return f"<Frame {width}x{height}, {self.stats.get('frames', '?')} frames>"

    def save(self, path: str) -> None:
        """Writes a .png (display) or an .exr (linear, with all layers)."""
        path = os.fspath(path)
        if path.lower().endswith(".png"):
            _lucent.write_png(path, self.srgb)
        elif path.lower().endswith(".exr"):
            _lucent.write_exr(path, {"": self.color, **self.aovs})
        else:
            raise ValueError(f"{path}: the name must end in .png (display) or .exr (linear)")

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "frame.png")
            _lucent.write_png(path, self.srgb if self._srgb is not None else encode(self.color))
            with open(path, "rb") as file:
                return file.read()


def encode(linear: Floats) -> Bytes:
    """Linear light as sRGB-encoded bytes, cut off at 1."""
    value = numpy.clip(numpy.nan_to_num(linear), 0.0, 1.0)
    encoded = numpy.where(value <= 0.0031308, value * 12.92, 1.055 * numpy.power(value, 1 / 2.4) - 0.055)
    result: Bytes = (encoded * 255.0 + 0.5).astype(numpy.uint8)
    return result
