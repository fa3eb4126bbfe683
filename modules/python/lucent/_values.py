# SPDX-License-Identifier: MIT
"""Godot's value types: immutable tuples, compared and hashed by value. Angles are radians, lengths metres."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn, TypeVar, Union, cast

import numpy
import numpy.typing

Number = Union[int, float]
_T = TypeVar("_T", bound="_Vector")


def _text(value: float) -> str:
    """As few digits as the 32-bit float needs: 0.1, not 0.10000000149011612."""
    return f"{value:.7g}"


class _Value(tuple):  # type: ignore[type-arg]
    __slots__ = ()
    _names: tuple[str, ...] = ()

    def __setattr__(self, name: str, value: object) -> NoReturn:
        kind = type(self).__name__
        if name not in self._names:
            raise AttributeError(f"{kind} has no part '{name}'; it has {', '.join(self._names)}")
        raise AttributeError(
            f"{kind} is a value: build another one, as n.property = n.property.with_{name}(...), or write n.set_indexed('property:{name}', ...)"
        )

    def __array__(self, dtype: Any = None) -> numpy.typing.NDArray[Any]:
        return numpy.array([tuple(part) if isinstance(part, tuple) else part for part in self], dtype or numpy.float32)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(_text(part) for part in self)})"

    def __reduce__(self) -> Any:
        return type(self), tuple(self)

    def _with(self: _Self, name: str, value: object) -> _Self:
        parts = list(self)
        parts[self._names.index(name)] = value
        return type(self)(*parts)


_Self = TypeVar("_Self", bound=_Value)


class _Vector(_Value):
    """Arithmetic part by part; * and / also with a number."""

    __slots__ = ()

    def _each(self: _T, other: object, operation: Any) -> _T:
        if isinstance(other, (int, float)):
            return type(self)(*[operation(part, other) for part in self])
        if isinstance(other, (tuple, list, numpy.ndarray)) and len(other) == len(self):
            return type(self)(*[operation(a, b) for a, b in zip(self, other)])
        return cast(_T, NotImplemented)

    def __add__(self: _T, other: Any) -> _T:
        return self._each(other, lambda a, b: a + b) if not isinstance(other, (int, float)) else cast(_T, NotImplemented)

    __radd__ = __add__

    def __sub__(self: _T, other: Any) -> _T:
        return self._each(other, lambda a, b: a - b) if not isinstance(other, (int, float)) else cast(_T, NotImplemented)

    def __rsub__(self: _T, other: Any) -> _T:
        return (-self).__add__(other)

    def __mul__(self: _T, other: Any) -> _T:
        return self._each(other, lambda a, b: a * b)

    __rmul__ = __mul__

    def __truediv__(self: _T, other: Any) -> _T:
        return self._each(other, lambda a, b: a / b)

    def __neg__(self: _T) -> _T:
        return type(self)(*[-part for part in self])

    def dot(self: _T, other: _T) -> float:
        """The scalar product."""
        return float(sum(a * b for a, b in zip(self, other)))

    def length(self) -> float:
        """The Euclidean length."""
        return math.sqrt(sum(part * part for part in self))

    def length_squared(self) -> float:
        """The length's square."""
        return float(sum(part * part for part in self))

    def distance_to(self: _T, other: _T) -> float:
        """The distance between two points."""
        return (self - other).length()

    def normalized(self: _T) -> _T:
        """The same direction, of length 1; zero stays zero."""
        length = self.length()
        return self / length if length > 0 else self

    def lerp(self: _T, to: _T, weight: float) -> _T:
        """Between the two: 0 is this one, 1 the other."""
        return self + (to - self) * weight


class Vector2(_Vector):
    """Two floats."""

    __slots__ = ()
    _names = ("x", "y")

    def __new__(cls, x: Number = 0.0, y: Number = 0.0) -> Vector2:
        return tuple.__new__(cls, (float(x), float(y)))

    @property
    def x(self) -> float:
        """The first part."""
        return cast(float, tuple.__getitem__(self, 0))

    @property
    def y(self) -> float:
        """The second part."""
        return cast(float, tuple.__getitem__(self, 1))

    def with_x(self, x: Number) -> Vector2:
        """The same with another x."""
        return self._with("x", x)

    def with_y(self, y: Number) -> Vector2:
        """The same with another y."""
        return self._with("y", y)


class Vector2i(_Vector):
    """Two integers."""

    __slots__ = ()
    _names = ("x", "y")

    def __new__(cls, x: Number = 0, y: Number = 0) -> Vector2i:
        return tuple.__new__(cls, (int(x), int(y)))

    @property
    def x(self) -> int:
        """The first part."""
        return cast(int, tuple.__getitem__(self, 0))

    @property
    def y(self) -> int:
        """The second part."""
        return cast(int, tuple.__getitem__(self, 1))

    def with_x(self, x: int) -> Vector2i:
        """The same with another x."""
        return self._with("x", x)

    def with_y(self, y: int) -> Vector2i:
        """The same with another y."""
        return self._with("y", y)


class Vector3(_Vector):
    """Three floats: a point, a direction, a scale."""

    __slots__ = ()
    _names = ("x", "y", "z")

    def __new__(cls, x: Number = 0.0, y: Number = 0.0, z: Number = 0.0) -> Vector3:
        return tuple.__new__(cls, (float(x), float(y), float(z)))

    @property
    def x(self) -> float:
        """To the right."""
        return cast(float, tuple.__getitem__(self, 0))

    @property
    def y(self) -> float:
        """Up."""
        return cast(float, tuple.__getitem__(self, 1))

    @property
    def z(self) -> float:
        """Towards the viewer."""
        return cast(float, tuple.__getitem__(self, 2))

    def with_x(self, x: Number) -> Vector3:
        """The same with another x."""
        return self._with("x", x)

    def with_y(self, y: Number) -> Vector3:
        """The same with another y."""
        return self._with("y", y)

    def with_z(self, z: Number) -> Vector3:
        """The same with another z."""
        return self._with("z", z)

    def cross(self, other: Vector3) -> Vector3:
        """The vector product."""
        ax, ay, az = self
        bx, by, bz = other
        return Vector3(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)


class Vector3i(_Vector):
    """Three integers."""

    __slots__ = ()
    _names = ("x", "y", "z")

    def __new__(cls, x: Number = 0, y: Number = 0, z: Number = 0) -> Vector3i:
        return tuple.__new__(cls, (int(x), int(y), int(z)))

    @property
    def x(self) -> int:
        """The first part."""
        return cast(int, tuple.__getitem__(self, 0))

    @property
    def y(self) -> int:
        """The second part."""
        return cast(int, tuple.__getitem__(self, 1))

    @property
    def z(self) -> int:
        """The third part."""
        return cast(int, tuple.__getitem__(self, 2))


class Vector4(_Vector):
    """Four floats."""

    __slots__ = ()
    _names = ("x", "y", "z", "w")

    def __new__(cls, x: Number = 0.0, y: Number = 0.0, z: Number = 0.0, w: Number = 0.0) -> Vector4:
        return tuple.__new__(cls, (float(x), float(y), float(z), float(w)))

    @property
    def x(self) -> float:
        """The first part."""
        return cast(float, tuple.__getitem__(self, 0))

    @property
    def y(self) -> float:
        """The second part."""
        return cast(float, tuple.__getitem__(self, 1))

    @property
    def z(self) -> float:
        """The third part."""
        return cast(float, tuple.__getitem__(self, 2))

    @property
    def w(self) -> float:
        """The fourth part."""
        return cast(float, tuple.__getitem__(self, 3))


class Quaternion(_Value):
    """A rotation: x, y, z, w."""

    __slots__ = ()
    _names = ("x", "y", "z", "w")

    def __new__(cls, x: Number = 0.0, y: Number = 0.0, z: Number = 0.0, w: Number = 1.0) -> Quaternion:
        return tuple.__new__(cls, (float(x), float(y), float(z), float(w)))

    @property
    def x(self) -> float:
        """The axis' x times the sine of half the angle."""
        return cast(float, tuple.__getitem__(self, 0))

    @property
    def y(self) -> float:
        """The axis' y times the sine of half the angle."""
        return cast(float, tuple.__getitem__(self, 1))

    @property
    def z(self) -> float:
        """The axis' z times the sine of half the angle."""
        return cast(float, tuple.__getitem__(self, 2))

    @property
    def w(self) -> float:
        """The cosine of half the angle."""
        return cast(float, tuple.__getitem__(self, 3))

    @staticmethod
    def from_axis_angle(axis: Vector3, angle: float) -> Quaternion:
        """The turn by an angle about an axis."""
        x, y, z = Vector3(*axis).normalized() * math.sin(angle / 2)
        return Quaternion(x, y, z, math.cos(angle / 2))


class Basis(_Value):
    """Rotation and scale: the images of the axes."""

    __slots__ = ()
    _names = ("x", "y", "z")

    def __new__(cls, x: Sequence[Number] = (1, 0, 0), y: Sequence[Number] = (0, 1, 0), z: Sequence[Number] = (0, 0, 1)) -> Basis:
        return tuple.__new__(cls, (Vector3(*x), Vector3(*y), Vector3(*z)))

    @property
    def x(self) -> Vector3:
        """Where the x axis goes."""
        return cast(Vector3, tuple.__getitem__(self, 0))

    @property
    def y(self) -> Vector3:
        """Where the y axis goes."""
        return cast(Vector3, tuple.__getitem__(self, 1))

    @property
    def z(self) -> Vector3:
        """Where the z axis goes."""
        return cast(Vector3, tuple.__getitem__(self, 2))

    def __matmul__(self, other: Any) -> Any:
        return self * other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Basis):
            return Basis(self * other.x, self * other.y, self * other.z)
        if isinstance(other, (tuple, list, numpy.ndarray)) and len(other) == 3:
            return self.x * other[0] + self.y * other[1] + self.z * other[2]
        return NotImplemented

    def __array__(self, dtype: Any = None) -> numpy.typing.NDArray[Any]:
        return numpy.array([tuple(column) for column in self], dtype or numpy.float32).T

    def __repr__(self) -> str:
        return f"Basis({self.x!r}, {self.y!r}, {self.z!r})"


class Transform3D(_Value):
    """An affine map: basis * point + origin."""

    __slots__ = ()
    _names = ("basis", "origin")

    def __new__(cls, basis: Iterable[Sequence[Number]] = ((1, 0, 0), (0, 1, 0), (0, 0, 1)), origin: Sequence[Number] = (0, 0, 0)) -> Transform3D:
        return tuple.__new__(cls, (basis if isinstance(basis, Basis) else Basis(*basis), Vector3(*origin)))

    @property
    def basis(self) -> Basis:
        """Rotation and scale."""
        return cast(Basis, tuple.__getitem__(self, 0))

    @property
    def origin(self) -> Vector3:
        """Where the origin goes."""
        return cast(Vector3, tuple.__getitem__(self, 1))

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Transform3D):
            return Transform3D(self.basis * other.basis, self.basis * other.origin + self.origin)
        if isinstance(other, (tuple, list, numpy.ndarray)) and len(other) == 3:
            return self.basis * other + self.origin
        return NotImplemented

    def translated(self, offset: Sequence[Number]) -> Transform3D:
        """Moved in the parent's space."""
        return Transform3D(self.basis, self.origin + Vector3(*offset))

    def with_origin(self, origin: Sequence[Number]) -> Transform3D:
        """The same with another origin."""
        return Transform3D(self.basis, origin)

    def with_basis(self, basis: Basis) -> Transform3D:
        """The same with another basis."""
        return Transform3D(basis, self.origin)

    def __array__(self, dtype: Any = None) -> numpy.typing.NDArray[Any]:
        return numpy.column_stack([numpy.asarray(self.basis), numpy.asarray(self.origin)]).astype(dtype or numpy.float32)

    def __repr__(self) -> str:
        return f"Transform3D({self.basis!r}, {self.origin!r})"


class AABB(_Value):
    """A box along the axes: its corner and its size."""

    __slots__ = ()
    _names = ("position", "size")

    def __new__(cls, position: Sequence[Number] = (0, 0, 0), size: Sequence[Number] = (0, 0, 0)) -> AABB:
        return tuple.__new__(cls, (Vector3(*position), Vector3(*size)))

    @property
    def position(self) -> Vector3:
        """The corner of the least coordinates."""
        return cast(Vector3, tuple.__getitem__(self, 0))

    @property
    def size(self) -> Vector3:
        """From that corner to the opposite one."""
        return cast(Vector3, tuple.__getitem__(self, 1))

    @property
    def end(self) -> Vector3:
        """The corner of the largest coordinates."""
        return self.position + self.size

    def get_center(self) -> Vector3:
        """The middle."""
        return self.position + self.size / 2

    def has_point(self, point: Sequence[Number]) -> bool:
        """Whether a point is inside."""
        return all(low <= value <= high for low, value, high in zip(self.position, point, self.end))

    def __repr__(self) -> str:
        return f"AABB({self.position!r}, {self.size!r})"


class Color(_Value):
    """Red, green, blue, alpha, sRGB-encoded as Godot's colours. Also from "#ff8800" or "#ff8800cc"."""

    __slots__ = ()
    _names = ("r", "g", "b", "a")

    def __new__(cls, r: Union[Number, str] = 0.0, g: Number = 0.0, b: Number = 0.0, a: Number = 1.0) -> Color:
        if isinstance(r, str):
            digits = r.lstrip("#")
            if len(digits) not in (6, 8) or any(digit not in "0123456789abcdefABCDEF" for digit in digits):
                raise ValueError(f"Color('{r}'): expected '#rrggbb' or '#rrggbbaa'")
            parts = [int(digits[i : i + 2], 16) / 255 for i in range(0, len(digits), 2)]
            return tuple.__new__(cls, (*parts, 1.0)[:4])
        return tuple.__new__(cls, (float(r), float(g), float(b), float(a)))

    @property
    def r(self) -> float:
        """Red."""
        return cast(float, tuple.__getitem__(self, 0))

    @property
    def g(self) -> float:
        """Green."""
        return cast(float, tuple.__getitem__(self, 1))

    @property
    def b(self) -> float:
        """Blue."""
        return cast(float, tuple.__getitem__(self, 2))

    @property
    def a(self) -> float:
        """Alpha: 0 is clear."""
        return cast(float, tuple.__getitem__(self, 3))

    def __mul__(self, other: Any) -> Color:
        if isinstance(other, (int, float)):
            return Color(self.r * other, self.g * other, self.b * other, self.a * other)
        return cast(Color, NotImplemented)

    def lerp(self, to: Color, weight: float) -> Color:
        """Between the two: 0 is this one, 1 the other."""
        return Color(*[a + (b - a) * weight for a, b in zip(self, to)])

    def to_html(self) -> str:
        """As rrggbbaa."""
        return "".join(f"{round(min(max(part, 0), 1) * 255):02x}" for part in self)

    @staticmethod
    def from_hsv(h: float, s: float, v: float, alpha: float = 1.0) -> Color:
        """From hue, saturation and value, 0 to 1 each."""
        import colorsys

        return Color(*colorsys.hsv_to_rgb(h, s, v), alpha)


class NodePath(str):
    """Names of nodes between slashes, then of properties after colons: "../Sun:light_color"."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"NodePath({str.__repr__(self)})"


VALUES = {kind.__name__: kind for kind in (Vector2, Vector2i, Vector3, Vector3i, Vector4, Quaternion, Basis, Transform3D, AABB, Color, NodePath)}
