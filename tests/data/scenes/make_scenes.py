#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the scenes that have one thing each which real ones have: window bars, thin-legged furniture, a folded curtain, columns, walls that are
turned against the grid of cells, a hall of 40 m. Needs Python alone.

usage: python3 tests/data/scenes/make_scenes.py [FOLDER]   (default: the script's own)

Metres, y up. Boxes are one BoxMesh, scaled; the curtain is a .glb. All materials are Lambertian.
"""

import json
import math
import os
import random
import struct
import sys

MATERIALS = {
    "White": (0.87, 0.86, 0.84),
    "Red": (0.8, 0.3, 0.22),
    "Green": (0.35, 0.62, 0.36),
    "Wood": (0.72, 0.56, 0.4),
    "Ground": (0.55, 0.56, 0.5),
    "Lamp": (0.5, 0.5, 0.5),
}
WALL = 0.2


def numbers(values):
    return ", ".join(f"{0.0 if abs(v) < 5e-8 else v:.7g}" for v in values)


def turn_y(degrees):
    """Rows of the rotation about y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[c, 0, s], [0, 1, 0], [-s, 0, c]]


def look(eye, target):
    """Rows of a basis whose -z points at the target."""
    back = [e - t for e, t in zip(eye, target)]
    length = math.sqrt(sum(v * v for v in back))
    back = [v / length for v in back]
    flat = math.hypot(back[0], back[2])
    right = [back[2] / flat, 0, -back[0] / flat]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]]
    return [[right[i], up[i], back[i]] for i in range(3)]


def transform(rows, origin, scale=(1, 1, 1)):
    return f"Transform3D({numbers([rows[i][j] * scale[j] for i in range(3) for j in range(3)] + list(origin))})"


class Scene:
    def __init__(self, name, sky=(0.891143, 0.930925, 1), turn=0.0, external=""):
        self.name, self.sky, self.external = name, sky, external
        self.nodes = [f'[node name="Room" type="Node3D" parent="."]\ntransform = {transform(turn_y(turn), (0, 0, 0))}\n'] if turn else ['[node name="Room" type="Node3D" parent="."]\n']
        self.used = set()
        self.meshes = set()

    def add(self, mesh, material, center, size, turn=0.0):
        self.used.add(material)
        self.meshes.add(mesh)
        self.nodes.append(
            f'[node name="{material}{len(self.nodes)}" type="MeshInstance3D" parent="Room"]\n'
            f"transform = {transform(turn_y(turn), center, size)}\n"
            f'mesh = SubResource("{mesh}")\nmaterial_override = SubResource("{material}")\n'
        )

    def box(self, material, low, high):
        self.add("Box", material, [(a + b) / 2 for a, b in zip(low, high)], [b - a for a, b in zip(low, high)])

    def camera(self, eye, target, fov=65):
        self.nodes.append(
            f'[node name="Camera3D" type="Camera3D" parent="Room"]\ntransform = {transform(look(eye, target), eye)}\n'
            f"fov = {fov}.0\nnear = 0.05\nfar = 500.0\ncurrent = true\n"
        )

    def sun(self, direction, energy=4.0):
        self.nodes.append(
            f'[node name="Sun" type="DirectionalLight3D" parent="Room"]\ntransform = {transform(look((0, 0, 0), direction), (0, 5, 0))}\n'
            f"light_color = Color(1, 0.977692, 0.930925, 1)\nlight_energy = {energy}\nlight_bake_mode = 2\nshadow_enabled = true\n"
        )

    def text(self):
        parts = [self.external] if self.external else []
        parts.append(f'[sub_resource type="Environment" id="Environment"]\nbackground_mode = 1\nbackground_color = Color({numbers(self.sky)}, 1)\nsdfgi_enabled = true\n')
        for name in MATERIALS:
            if name in self.used:
                glow = "emission_enabled = true\nemission = Color(1, 0.95, 0.85, 1)\nemission_energy_multiplier = 12.0\n" if name == "Lamp" else ""
                parts.append(f'[sub_resource type="StandardMaterial3D" id="{name}"]\nalbedo_color = Color({numbers(MATERIALS[name])}, 1)\nroughness = 1.0\nspecular_mode = 2\n{glow}')
        if "Box" in self.meshes:
            parts.append('[sub_resource type="BoxMesh" id="Box"]\nsize = Vector3(1, 1, 1)\n')
        if "Cylinder" in self.meshes:
            parts.append('[sub_resource type="CylinderMesh" id="Cylinder"]\ntop_radius = 0.5\nbottom_radius = 0.5\nheight = 1.0\nradial_segments = 24\nrings = 0\n')
        steps = 1 + sum(part.count("_resource ") for part in parts)
        parts.insert(0, f"; Made by tests/data/scenes/make_scenes.py\n[gd_scene load_steps={steps} format=3]\n")
        parts.append(f'[node name="{self.name}" type="Node3D"]\n')
        parts.append('[node name="WorldEnvironment" type="WorldEnvironment" parent="."]\nenvironment = SubResource("Environment")\n')
        return "\n".join(parts + self.nodes)

    def room(self, width, height, depth, window, ground=True):
        """Inside: x of +-width / 2, z of +-depth / 2, the floor at 0. window: low y, high y, low z, high z of a hole in the wall at -x."""
        x, z, t = width / 2, depth / 2, WALL
        self.box("Wood", (-x - t, -t, -z - t), (x + t, 0, z + t))
        self.box("White", (-x - t, height, -z - t), (x + t, height + t, z + t))
        self.box("Green", (x, 0, -z - t), (x + t, height, z + t))
        self.box("White", (-x - t, 0, -z - t), (x, height, -z))
        self.box("Red", (-x - t, 0, z), (x, height, z + t))
        y0, y1, z0, z1 = window
        self.box("White", (-x - t, 0, -z), (-x, y0, z))
        self.box("White", (-x - t, y1, -z), (-x, height, z))
        self.box("White", (-x - t, y0, -z), (-x, y1, z0))
        self.box("White", (-x - t, y0, z1), (-x, y1, z))
        if ground:
            self.box("Ground", (-20, -0.6, -20), (20, -0.4, 20))


def window_bars():
    scene = Scene("window_bars")
    scene.room(4.4, 2.8, 5.2, (0.8, 2.4, -1.6, 1.6))
    bar = 0.03
    for i in range(1, 8):  # panes of 40 cm
        z = -1.6 + 0.4 * i
        scene.box("White", (-2.2 - 0.115, 0.8, z - bar / 2), (-2.2 - 0.115 + bar, 2.4, z + bar / 2))
    for i in range(1, 4):
        y = 0.8 + 0.4 * i
        scene.box("White", (-2.2 - 0.115, y - bar / 2, -1.6), (-2.2 - 0.115 + bar, y + bar / 2, 1.6))
    scene.camera((1.7, 1.6, 2.1), (-1.4, 1.1, -1.6))
    scene.sun((0.8, -0.62, -0.3))
    return scene


def table(scene, x, z, height, width, depth, leg):
    scene.box("Wood", (x - width / 2, height - 0.03, z - depth / 2), (x + width / 2, height, z + depth / 2))
    for sx in (-1, 1):
        for sz in (-1, 1):
            cx, cz = x + sx * (width / 2 - leg), z + sz * (depth / 2 - leg)
            scene.box("Wood", (cx - leg / 2, 0, cz - leg / 2), (cx + leg / 2, height - 0.03, cz + leg / 2))


def furniture():
    scene = Scene("furniture")
    scene.room(5.6, 2.8, 5.0, (0.7, 2.4, -1.9, 1.9))
    for row in range(2):
        for column in range(3):
            x, z = -1.6 + 1.5 * column, -0.95 + 1.75 * row
            table(scene, x, z, 0.74, 1.0, 0.5, 0.04)
            table(scene, x + 0.07, z + 0.55, 0.45, 0.42, 0.42, 0.03)
            for sx in (-1, 1):  # the chair's back: two posts, three slats
                post = x + 0.07 + sx * 0.18
                scene.box("Wood", (post - 0.015, 0.45, z + 0.73), (post + 0.015, 0.9, z + 0.76))
            for slat in range(3):
                y = 0.56 + 0.13 * slat
                scene.box("Wood", (x - 0.11, y, z + 0.735), (x + 0.25, y + 0.05, z + 0.755))
    for shelf in range(5):  # against the wall at +x
        scene.box("White", (2.45, 0.2 + 0.4 * shelf, -2.2), (2.78, 0.22 + 0.4 * shelf, -1.0))
    for z in (-2.2, -1.02):
        scene.box("White", (2.45, 0, z), (2.78, 1.82, z + 0.02))
    scene.camera((2.3, 1.7, 2.2), (-1.2, 0.6, -1.4), 68)
    scene.sun((0.75, -0.7, -0.2))
    return scene


def columns():
    scene = Scene("columns")
    scene.room(7.6, 3.6, 7.0, (0.3, 3.2, -3.3, 3.3))
    generator = random.Random(3)
    for x in (-2.4, 0.0, 2.4):
        for z in (-2.4, -0.8, 0.8, 2.4):
            width = 0.34 + 0.04 * generator.random()
            scene.add("Cylinder", "White", (x, 1.8, z), (width, 3.6, width), 7.5 * generator.random())
            scene.box("White", (x - 0.26, 0, z - 0.26), (x + 0.26, 0.12, z + 0.26))
    scene.camera((1.2, 1.7, 3.3), (-1.5, 1.4, -3.0), 72)
    scene.sun((0.8, -0.55, -0.35))
    return scene


def turned_room():
    scene = Scene("turned_room", turn=27.0)
    scene.room(4.4, 2.8, 5.2, (0.8, 2.3, -1.3, 1.3))
    scene.box("White", (-0.4, 0, -1.9), (0.7, 0.9, -1.0))
    scene.box("Red", (1.4, 0, -2.2), (2.0, 1.6, -1.6))
    scene.camera((1.7, 1.6, 2.1), (-1.2, 1.0, -2.0))
    scene.sun((0.8, -0.62, -0.3))
    return scene


def long_hall():
    """40 m along z, the camera at one end: with the default cells of 0.2 m and 128 of them cascade 0 ends 12.8 m before the camera, cascade 1 at 25.6 m."""
    scene = Scene("long_hall", sky=(0, 0, 0))
    x, height, end = 3.0, 4.0, -37.0
    scene.box("Wood", (-x - WALL, -WALL, end - WALL), (x + WALL, 0, 3 + WALL))
    scene.box("White", (-x - WALL, height, end - WALL), (x + WALL, height + WALL, 3 + WALL))
    scene.box("White", (-x - WALL, 0, end - WALL), (-x, height, 3 + WALL))
    scene.box("White", (x, 0, end - WALL), (x + WALL, height, 3 + WALL))
    scene.box("Red", (-x, 0, end - WALL), (x, height, end))
    scene.box("Green", (-x, 0, 3), (x, height, 3 + WALL))
    for z in (-9, -22):  # piers, which throw shadows along the hall
        scene.box("White", (-x, 0, z - 0.3), (-x + 0.9, height, z + 0.3))
        scene.box("White", (x - 0.9, 0, z - 0.3), (x, height, z + 0.3))
    for z in (-5.5, -17.0, -31.0):
        scene.box("Lamp", (-0.9, height - 0.9, z - 0.45), (0.9, height - 0.75, z + 0.45))
    scene.camera((1.6, 1.7, 2.4), (-0.6, 1.9, -12.0), 60)
    return scene


def write_curtain(path):
    """A sheet without thickness, seen from both sides: 2.2 m high, folds of 21 cm."""
    wide, high, length, depth, folds = 96, 12, 2.0, 0.075, 9.5
    positions, normals, indices = [], [], []
    for j in range(high + 1):
        for i in range(wide + 1):
            v, u = j / high, i / wide
            swell = depth * (1.0 - 0.45 * v)  # deeper folds at the hem
            phase = 2 * math.pi * folds * u + 0.5 * math.sin(3.0 * v)
            positions.append((swell * math.sin(phase), 0.35 + 2.2 * v, length * (u - 0.5)))
            slope = swell * math.cos(phase) * 2 * math.pi * folds / length  # dx / dz
            normals.append((1 / math.hypot(1, slope), 0.0, -slope / math.hypot(1, slope)))
    for j in range(high):
        for i in range(wide):
            a = j * (wide + 1) + i
            indices += [a, a + wide + 1, a + 1, a + 1, a + wide + 1, a + wide + 2]
    blob = b"".join(struct.pack("<3f", *p) for p in positions) + b"".join(struct.pack("<3f", *n) for n in normals)
    start = len(blob)
    blob += struct.pack(f"<{len(indices)}H", *indices)
    low, high_corner = ([f(p[k] for p in [struct.unpack("<3f", struct.pack("<3f", *q)) for q in positions]) for k in range(3)] for f in (min, max))
    count = len(positions)
    document = {
        "asset": {"version": "2.0", "generator": "tests/data/scenes/make_scenes.py"},
        "extensionsUsed": ["KHR_materials_specular"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Curtain", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [
            {
                "name": "Cloth",
                "doubleSided": True,
                "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.62, 0.45, 1], "metallicFactor": 0, "roughnessFactor": 1},
                "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
            }
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", "min": low, "max": high_corner},
            {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5123, "count": len(indices), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 12 * count, "target": 34962},
            {"buffer": 0, "byteOffset": 12 * count, "byteLength": 12 * count, "target": 34962},
            {"buffer": 0, "byteOffset": start, "byteLength": len(blob) - start, "target": 34963},
        ],
        "buffers": [{"byteLength": len(blob)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(blob)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob)


def curtain():
    scene = Scene("curtain", external='[ext_resource type="PackedScene" path="curtain.glb" id="1"]\n')
    scene.room(4.4, 2.8, 5.2, (0.6, 2.4, -1.5, 1.5))
    scene.nodes.append(f'[node name="Curtain" parent="Room" instance=ExtResource("1")]\ntransform = {transform(turn_y(0), (-2.0, 0, -0.75))}\n')
    scene.box("White", (-2.02, 2.56, -1.9), (-1.98, 2.6, 1.9))  # its rod
    scene.camera((1.7, 1.6, 2.1), (-1.6, 1.2, -1.2))
    scene.sun((0.8, -0.62, -0.3))
    return scene


def atrium(camera):
    """The atrium sample, seen by another of its cameras. Its geometry is made by doc/samples/atrium/make_atrium.py."""
    sample = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../doc/samples/atrium/atrium.tscn")
    with open(sample, encoding="utf-8") as file:
        text = file.read()
    text = text.replace("res://atrium.glb", "../../../doc/samples/atrium/atrium.glb").replace("current = true\n", "")
    head = f'[node name="{camera}" type="Camera3D"'
    start = text.index(head)
    end = text.find("\n[node", start) if "\n[node" in text[start:] else len(text)
    return "; Made by tests/data/scenes/make_scenes.py\n" + text[:end].rstrip("\n") + "\ncurrent = true\n" + text[end:]


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    texts = {scene.name: scene.text() for scene in (window_bars(), furniture(), curtain(), columns(), turned_room(), long_hall())}
    texts["atrium_court"], texts["atrium_gallery"] = atrium("Court"), atrium("Gallery")
    for name, text in texts.items():
        with open(os.path.join(folder, name + ".tscn"), "w", encoding="utf-8") as file:
            file.write(text)
    write_curtain(os.path.join(folder, "curtain.glb"))


if __name__ == "__main__":
    main()
