# SPDX-License-Identifier: MIT
"""Every member of the registry is in the module, its stubs and its documents; properties check what they get."""

import os
import random

import pytest

import lucent
from lucent import _lucent, _stubs

CLASSES = {name: _lucent.class_members(name) for name in _lucent.class_names()}


def test_every_member_is_there():
    stubs = _stubs.stubs()
    for name, info in CLASSES.items():
        kind = getattr(lucent, name)
        assert issubclass(kind, getattr(lucent, info["parent"]) if info["parent"] else object)
        assert f"class {name}(" in stubs
        for group in ("properties", "methods", "signals", "constants"):
            for member in info[group]:
                assert member[0] in vars(kind), f"{name}.{member[0]}"
                assert member[0] in stubs, f"{name}.{member[0]}"
        for prop in info["properties"]:
            assert vars(kind)[prop[0]].__doc__, f"{name}.{prop[0]} has no description"
    written = open(os.path.join(os.path.dirname(lucent.__file__), "__init__.pyi"), encoding="utf-8").read()
    assert written == stubs


def properties():
    for name, info in CLASSES.items():
        kind = info
        while kind is not None:
            for prop in kind["properties"]:
                yield name, prop
            kind = CLASSES.get(kind["parent"])


def make(name):
    return getattr(lucent, name)() if CLASSES[name]["instantiable"] else None


def test_defaults_read_and_write():
    seen = 0
    for name, (prop, _, kind, _, _, read_only) in properties():
        item = make(name)
        if item is None or read_only:
            continue
        value = getattr(item, prop)
        if prop in ("name", "owner", "current_scene") and not value:
            continue
        setattr(item, prop, value)
        again = getattr(item, prop)
        if kind in ("float", "int", "bool", "String", "Color", "NodePath"):
            assert again == value, f"{name}.{prop}"
        seen += 1
    assert seen > 300


def test_wrong_values_raise():
    for name, (prop, _, kind, _, is_enum, read_only) in properties():
        item = make(name)
        if item is None:
            continue
        with pytest.raises((TypeError, AttributeError)):
            setattr(item, prop, object())
        if is_enum:
            with pytest.raises(ValueError):
                setattr(item, prop, 12345)
        if kind == "float" and not read_only:
            with pytest.raises((TypeError, ValueError)):
                setattr(item, prop, float("nan"))
        if kind in ("float", "int", "Vector3", "Color") and not read_only:
            with pytest.raises(TypeError):
                setattr(item, prop, "text")


def test_typos_raise():
    for name in CLASSES:
        item = make(name)
        if item is None:
            continue
        with pytest.raises(AttributeError):
            item.no_such_member
        with pytest.raises(AttributeError):
            item.no_such_member = 1
    with pytest.raises(AttributeError, match="did you mean 'light_energy'"):
        lucent.OmniLight3D().light_enrgy = 2
    with pytest.raises(AttributeError, match="did you mean 'position'"):
        lucent.Node3D().positon


def test_ranges_and_enums():
    lamp = lucent.OmniLight3D(light_energy=2)
    assert lamp.light_energy == 2
    with pytest.raises(ValueError, match="fov must be between"):
        lucent.Camera3D().fov = 500
    environment = lucent.Environment()
    environment.background_mode = lucent.Environment.BG_SKY
    assert environment.background_mode is lucent.Environment.BGMode.BG_SKY
    assert environment.background_mode == 2


def test_arguments_are_named_in_errors():
    node = lucent.Node3D()
    with pytest.raises(TypeError, match=r"Node3D.look_at\(\): argument 1 \(target\): expected Vector3, got String"):
        node.look_at("there")
    with pytest.raises(TypeError, match="takes 1 to 2 arguments"):
        node.look_at()
    with pytest.raises(TypeError, match="no argument 'tarket'"):
        node.look_at(tarket=(1, 2, 3))
    node.position = (1, 2, 3)
    node.look_at(up=(0, 1, 0), target=(1, 2, -5))
    assert node.rotation.length() < 1e-6


def random_value(generator):
    choices = [None, True, -1, 3, 2**40, 0.5, float("inf"), "text", "", "../x", (1, 2, 3), [], [1, "x"], {}, {"a": 1}, lucent.Vector3(1, 2, 3)]
    choices += [lucent.Color("#ff8800"), lucent.Node(), lucent.BoxMesh(), len, b"bytes", float("nan"), lucent.Transform3D(), lucent.NodePath("a:b")]
    return generator.choice(choices)


def test_methods_with_random_arguments():
    generator = random.Random(1)
    allowed = (lucent.Error, TypeError, ValueError, AttributeError, LookupError, OverflowError)
    calls = 0
    for _ in range(4):
        for name, info in CLASSES.items():
            kind = info
            while kind is not None:
                for method, _, facts in kind["methods"]:
                    item = make(name)
                    if item is None or method in ("render", "process") or facts["accessor"]:
                        continue
                    arguments = [random_value(generator) for _ in range(len(facts["arguments"]) + generator.randint(-1, 1))]
                    try:
                        getattr(item, method)(*arguments)
                    except allowed:
                        pass
                    calls += 1
                kind = CLASSES.get(kind["parent"])
    assert calls > 3000
