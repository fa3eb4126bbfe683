#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the tree against doc/conventions.md: who may include whom, licence lines, sizes, and every built shader's validity.

A broken rule is an error and ends with exit code 1; a file that wants to be two is a warning.
"""

import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SOURCE_ENDINGS = (".h", ".cpp", ".glsl", ".inc")
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]', re.M)

# The layers, each with those that it may include (and itself). A file belongs to the first row whose pattern matches.
DEVICE = "servers/rendering/device"
RULES = [
    ("core", r"servers/core/", []),
    ("driver interface", DEVICE + r"/(rendering_device_driver|resource_types|shader_data|shader_interop|driver_\w+)\.(h|cpp)$", ["core"]),
    ("device", DEVICE + "/", ["core", "driver interface"]),
    ("settings", r"servers/rendering/(gi/\w+|fog)/\w+_settings\.h$", ["core"]),
    ("shared shaders", r"servers/rendering/shaders/", ["core", "device", "driver interface"]),
    ("scene data", r"servers/rendering/(render_scene|render_origin)\.(h|cpp)$", ["core", "settings"]),
    (
        "device scene",
        r"servers/rendering/(gpu_\w+|brdf_table|gi_reflectance|scene_cull|range_allocator|mesh_attributes|texture_mips)\.(h|cpp)$",
        ["core", "device", "driver interface", "settings", "shared shaders", "scene data"],
    ),
    ("passes", r"servers/rendering/passes/", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene", "gi shader interface"]),
    ("gi shader interface", r"servers/rendering/gi/(\w+/)?gi_sample_inc\.glsl$", ["shared shaders", "gi world", "gi technique"]),
    ("gi world", r"servers/rendering/gi/world/", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene"]),
    ("gi technique", r"servers/rendering/gi/\w+/", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene", "gi world", "gi shader interface", "passes"]),
    ("gi world", r"servers/rendering/gi/\w+\.\w+$", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene"]),
    ("fog", r"servers/rendering/fog/", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene", "gi world", "gi shader interface", "passes"]),
    ("server interface", r"servers/rendering/rendering_server\.h$", ["core", "settings", "scene data"]),
    ("frame renderer", r"servers/rendering/", ["core", "device", "driver interface", "settings", "shared shaders", "scene data", "device scene", "passes", "gi shader interface", "gi world", "gi technique", "fog", "server interface"]),
    ("vulkan driver", r"drivers/vulkan/", ["core", "driver interface"]),
    ("null driver", r"drivers/null/", ["core", "driver interface"]),
    ("app", r"modules/(app|python)/", None),
    ("module", r"modules/", ["core", "settings", "shared shaders", "scene data", "server interface"]),
    ("tests", r"tests/", None),
]
VULKAN_HEADERS = re.compile(r"^(vulkan/|volk|vk_)")


def layer_of(path):
    for name, pattern, allowed in RULES:
        if re.match(pattern, path):
            return name, allowed
    return None, None


def sources():
    for top in ("servers", "drivers", "modules", "tests"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in sorted(names):
                if name.endswith(SOURCE_ENDINGS):
                    yield os.path.relpath(os.path.join(folder, name), ROOT)


def check_includes(path, text, errors):
    layer, allowed = layer_of(path)
    if layer is None:
        errors.append(f"{path}: no rule of tests/check_tree.py says which layer this is")
        return
    for bracket, name in INCLUDE.findall(text):
        if VULKAN_HEADERS.match(name) and layer != "vulkan driver":
            errors.append(f"{path}: includes {name}; Vulkan headers stay in drivers/vulkan")
        if bracket == "<":
            continue
        if name.startswith(".") or "/" not in name:
            errors.append(f'{path}: includes "{name}"; includes start at the root of the repository')
            continue
        if name.endswith(".gen.h"):
            name = name.replace(".gen.h", ".h")
        elif not os.path.isfile(os.path.join(ROOT, name)):
            errors.append(f'{path}: includes "{name}", which does not exist')
            continue
        included, _ = layer_of(name)
        same_folder = os.path.dirname(path) == os.path.dirname(name)
        if included == layer and layer in ("gi technique", "module") and not same_folder:
            owner, target = path.split("/"), name.split("/")
            depth = 4 if layer == "gi technique" else 2
            if owner[:depth] != target[:depth] and target[1] not in MODULE_USES.get(owner[1], ()):
                errors.append(f"{path}: includes {name}; one {layer} does not include another")
        elif allowed is not None and included != layer and included not in allowed:
            errors.append(f"{path}: includes {name}; {layer} may not include {included}")


# Modules that build on others: the loaders make nodes.
MODULE_USES = {"gltf": ("scene", "image"), "tscn": ("scene", "gltf", "image"), "reference": ("image",), "scene": ("image",), "bench": ("image", "reference")}


def check_text(path, text, errors, warnings):
    first = text.split("\n", 1)[0]
    if "SPDX-License-Identifier: MIT" not in first and not (first.startswith("#version") and "SPDX-License-Identifier: MIT" in text[:200]):
        errors.append(f"{path}: the first line is not the SPDX line")
    if path.endswith(".h") and "#pragma once" not in text and "#ifndef" not in text:
        errors.append(f"{path}: no #pragma once")
    lines = text.count("\n")
    limit = 300 if path.endswith(".glsl") else 400
    if lines > limit:
        warnings.append(f"{path}: {lines} lines; over {limit} it wants to be two")


def check_shaders(errors):
    """spirv-val over what the release build made, where both exist."""
    folder = os.path.join(ROOT, "bin/obj/release/spirv")
    if shutil.which("spirv-val") is None or not os.path.isdir(folder):
        return 0
    names = sorted(n for n in os.listdir(folder) if n.endswith(".spv"))
    for name in names:
        run = subprocess.run(["spirv-val", "--target-env", "vulkan1.3", "--scalar-block-layout", os.path.join(folder, name)], capture_output=True, text=True)
        if run.returncode != 0:
            errors.append(f"{name}: {(run.stdout + run.stderr).strip()}")
    return len(names)


def main():
    errors, warnings, count = [], [], 0
    for path in sources():
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            text = file.read()
        check_includes(path, text, errors)
        check_text(path, text, errors, warnings)
        count += 1
    shaders = check_shaders(errors)
    for message in warnings:
        print("warning: " + message)
    for message in errors:
        print("error: " + message)
    print(f"check_tree: {count} files and {shaders} shaders, {len(errors)} errors, {len(warnings)} warnings")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
