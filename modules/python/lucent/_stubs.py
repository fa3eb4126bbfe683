# SPDX-License-Identifier: MIT
"""Writes __init__.pyi from the registry: python -m lucent._stubs FILE. No text is written twice: docs are the registry's."""

from __future__ import annotations

import inspect
import keyword
import sys
from typing import Any, Dict, List, Tuple

from lucent import _additions, _classes, _lucent

VALUES = ("Vector2", "Vector2i", "Vector3", "Vector3i", "Vector4", "Quaternion", "Basis", "Transform3D", "AABB", "Color", "NodePath")
PLAIN = {"bool": "bool", "int": "int", "float": "float", "String": "str", "Dictionary": "_Dict[_Any, _Any]", "PackedByteArray": "bytes", "Callable": "_Callable[..., _Any]"}
ARRAYS = {"Array": "_Any", "PackedInt32Array": "int", "PackedFloat32Array": "float", "PackedVector2Array": "Vector2", "PackedVector3Array": "Vector3", "PackedColorArray": "Color", "PackedStringArray": "str"}
LIKE = {"float": "_Number", "NodePath": "str", "Vector2": "_Floats", "Vector2i": "_Floats", "Vector3": "_Floats", "Vector3i": "_Floats", "Vector4": "_Floats", "Quaternion": "_Floats", "Basis": "_Any", "Transform3D": "Transform3D", "AABB": "_Any", "Color": "_Floats"}

HEAD = '''# Written by lucent._stubs from the class registry; don't edit.
from enum import IntEnum as _IntEnum
from typing import Any as _Any, Callable as _Callable, Dict as _Dict, Generic as _Generic, Iterator as _Iterator, List as _List, Optional as _Optional, Sequence as _Sequence, Tuple as _Tuple, Type as _Type, TypeVar as _TypeVar, Union as _Union, overload as _overload

import numpy as _numpy

from lucent._classes import Signal as Signal
from lucent._frame import Frame as Frame, NotConverged as NotConverged
from lucent._lucent import DeviceError as DeviceError, Error as Error, FreedObjectError as FreedObjectError, Handle as _Handle, LoadError as LoadError, NodeNotFoundError as NodeNotFoundError, Property as _Property
from lucent._values import AABB as AABB, Basis as Basis, Color as Color, NodePath as NodePath, Quaternion as Quaternion, Transform3D as Transform3D, Vector2 as Vector2, Vector2i as Vector2i, Vector3 as Vector3, Vector3i as Vector3i, Vector4 as Vector4

_Number = _Union[int, float]
_Floats = _Union[_Sequence[_Number], "_numpy.ndarray[_Any, _Any]"]
_N = _TypeVar("_N", bound="Node")

version: str

def open(path: _Any, scripts: _Optional[_Dict[str, _Type[Node]]] = None) -> SceneTree: ...
def load(path: _Any) -> _Any: ...
def save(path: _Any, picture: _Any) -> None: ...
def attach(node: Node, script: _Type[_N]) -> _N: ...
def reference(tree: SceneTree, size: _Tuple[int, int] = (256, 144), spp: int = 64, camera: _Optional[Camera3D] = None, seed: int = 0, aovs: _Sequence[str] = ()) -> Frame: ...
def compare(a: _Any, b: _Any, exposure: float = 1.0) -> _Dict[str, float]: ...
def devices() -> _List[str]: ...
def is_instance_valid(instance: object) -> bool: ...
'''


def type_of(kind: str, class_name: str, argument: bool = False) -> str:
    if kind == "Nil":
        return "_Any" if class_name == "Variant" or argument else "None"
    if kind == "Object":
        return f"_Optional[{class_name}]" if class_name else "_Any"
    if kind == "Array" and class_name.endswith("[]"):
        element = {"String": "str"}.get(class_name[:-2], class_name[:-2])
        return f"_Sequence[{element}]" if argument else f"_List[{element}]"
    if kind in ARRAYS:
        return "_Any" if argument else f"_List[{ARRAYS[kind]}]"
    if kind == "int" and class_name and not argument:
        return class_name
    if argument and kind in LIKE:
        return LIKE[kind]
    return PLAIN.get(kind, kind)


def doc_line(text: str, indent: str) -> str:
    return f'{indent}"""{text}"""\n' if text else ""


def method_text(name: str, facts: Dict[str, Any]) -> str:
    parts = [] if facts["static"] else ["self"]
    least = len(facts["arguments"]) - len(facts["defaults"])
    for index, (argument, kind, class_name) in enumerate(facts["arguments"]):
        safe = argument + "_" if keyword.iskeyword(argument) else argument
        parts.append(f"{safe}: {type_of(kind, class_name, True)}" + ("" if index < least else " = ..."))
    if facts["vararg"]:
        parts.append("*args: _Any")
    decorator = "    @staticmethod\n" if facts["static"] else ""
    result = type_of(*facts["result"])
    if facts["result"][0] == "Object" and name in ("duplicate", "get_node", "instantiate"):
        result = "_Any"
    if name in ("load",):
        result = "_Any"
    body = doc_line(facts["doc"], "        ") or "        ...\n"
    return f"{decorator}    def {name}({', '.join(parts)}) -> {result}:\n{body}"


def addition_text(name: str, member: Any) -> str:
    if isinstance(member, classmethod):
        return f"    @classmethod\n    def {name}{signature_text(member.__func__)}: ...\n"
    return f"    def {name}{signature_text(member)}: ...\n"


def signature_text(function: Any) -> str:
    text = str(inspect.signature(function)).replace("'", "")
    for word in ("Any", "Optional", "Sequence", "Tuple", "Iterator", "Dict"):
        text = text.replace(word, "_" + word)
    return text.replace("0.016666666666666666", "...").replace("typing.", "")


def class_text(name: str) -> str:
    info = _lucent.class_members(name)
    text = f"\nclass {name}({info['parent'] or '_Handle'}):\n" + doc_line(info["doc"], "    ")
    enums: Dict[str, List[Tuple[str, int]]] = {}
    for constant, value, enum_name, _ in info["constants"]:
        if enum_name:
            enums.setdefault(enum_name, []).append((constant, value))
    for enum_name, members in enums.items():
        text += f"    class {enum_name}(_IntEnum):\n" + "".join(f"        {constant} = {value}\n" for constant, value in members)
    for constant, value, enum_name, _ in info["constants"]:
        text += f"    {constant}: {enum_name or 'int'}\n"
    if info["instantiable"]:
        text += "    def __init__(self, *args: _Any, **kwargs: _Any) -> None: ...\n"
    additions = _additions.members(name)
    for method, _, facts in info["methods"]:
        if method not in additions:
            text += method_text(method, facts)
    for prop, _, kind, class_name, _, read_only in info["properties"]:
        if prop in additions:
            continue
        text += f"    @property\n    def {prop}(self) -> {type_of(kind, class_name)}: ...\n"
        if not read_only:
            text += f"    @{prop}.setter\n    def {prop}(self, value: {type_of(kind, class_name)}) -> None: ...\n"
    for signal, _, _ in info["signals"]:
        text += f"    @property\n    def {signal}(self) -> Signal: ...\n"
    for member, value in additions.items():
        text += addition_text(member, value)
    return text


def ordered() -> List[str]:
    names = list(_lucent.class_names())
    done: List[str] = []
    while len(done) < len(names):
        for name in names:
            parent = _lucent.class_members(name)["parent"]
            if name not in done and (not parent or parent in done):
                done.append(name)
    return done


def stubs() -> str:
    return HEAD + "".join(class_text(name) for name in ordered())


def main() -> None:
    with open(sys.argv[1], "w", encoding="utf-8") as output:
        output.write(stubs())


if __name__ == "__main__":
    main()
