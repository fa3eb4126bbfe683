# SPDX-License-Identifier: MIT
"""Makes the classes of the registry. What Python adds to them beyond the registry is in _additions.py."""

from __future__ import annotations

import enum
from typing import Any, Dict

from lucent import _additions, _lucent, _values


class Signal:
    """A signal of an object: node.ready.connect(function)."""

    __slots__ = ("_object", "_name")

    def __init__(self, owner: Any, name: str) -> None:
        self._object = owner
        self._name = name

    def connect(self, callable: Any, flags: int = 0) -> None:
        """Calls the callable each time the signal is emitted. A bound method of a node ends with the node."""
        self._object.connect(self._name, callable, flags)

    def disconnect(self, callable: Any) -> None:
        """Ends a connection."""
        self._object.disconnect(self._name, callable)

    def is_connected(self, callable: Any) -> bool:
        """Whether the callable is connected."""
        return bool(self._object.is_connected(self._name, callable))

    def emit(self, *arguments: Any) -> None:
        """Emits the signal."""
        self._object.emit_signal(self._name, *arguments)

    def __repr__(self) -> str:
        return f"<Signal {self._name} of {self._object!r}>"


class SignalMember:
    """Answers an object's Signal."""

    def __init__(self, name: str, doc: str) -> None:
        self.__name__ = name
        self.__doc__ = doc

    def __get__(self, owner: Any, kind: Any = None) -> Any:
        return self if owner is None else Signal(owner, self.__name__)

    def __set__(self, owner: Any, value: Any) -> None:
        raise AttributeError(f"'{self.__name__}' is a signal: connect to it")


def make_enum(owner: str, name: str, members: Dict[str, int]) -> Any:
    made = enum.IntEnum(name, members)  # type: ignore[misc]
    made.__module__ = "lucent"
    made.__qualname__ = f"{owner}.{name}"
    return made


def make_class(name: str, classes: Dict[str, Any], enums: Dict[str, Any]) -> Any:
    info = _lucent.class_members(name)
    members: Dict[str, Any] = {"__slots__": (), "__module__": "lucent", "__doc__": info["doc"]}
    grouped: Dict[str, Dict[str, int]] = {}
    for constant, value, enum_name, _ in info["constants"]:
        members[constant] = value
        if enum_name:
            grouped.setdefault(enum_name, {})[constant] = value
    for enum_name, values in grouped.items():
        made = make_enum(name, enum_name, values)
        members[enum_name] = enums[f"{name}.{enum_name}"] = made
        members.update({key: made[key] for key in values})
    for method, member, facts in info["methods"]:
        members[method] = staticmethod(member) if facts["static"] else member
    for signal, _, doc in info["signals"]:
        members[signal] = SignalMember(signal, doc)
    for prop, member, *_ in info["properties"]:
        members[prop] = member
    members.update(_additions.members(name))
    base = classes[info["parent"]] if info["parent"] else _lucent.Handle
    return type(name, (base,), members)


def make_classes() -> Dict[str, Any]:
    _lucent.set_value_types(_values.VALUES)
    classes: Dict[str, Any] = {}
    enums: Dict[str, Any] = {}
    parents = {name: _lucent.class_members(name)["parent"] for name in _lucent.class_names()}
    while len(classes) < len(parents):
        for name, parent in parents.items():
            if name not in classes and (not parent or parent in classes):
                classes[name] = make_class(name, classes, enums)
                _lucent.register(classes[name], name)
    for name in classes:
        for prop, _, _, class_name, is_enum, _ in _lucent.class_members(name)["properties"]:
            if is_enum and class_name in enums:
                _lucent.set_enum(classes[name].__dict__[prop], {int(member): member for member in enums[class_name]})
    return classes
