# SPDX-License-Identifier: MIT
"""Variations of a scene with depth and normals, for training: ./lucent python doc/samples/python/dataset.py [FOLDER] [COUNT]"""

import os
import sys

import numpy

import lucent

folder = sys.argv[1] if len(sys.argv) > 1 else "dataset"
count = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
size = (int(os.environ.get("WIDTH", 256)), int(os.environ.get("HEIGHT", 256)))
frames = int(os.environ.get("FRAMES", 32))
generator = numpy.random.default_rng(1)
os.makedirs(folder, exist_ok=True)

with lucent.SceneTree() as tree:
    scene = lucent.Node3D(name="Main")
    tree.current_scene = scene
    shapes = [lucent.BoxMesh(), lucent.SphereMesh(), lucent.TorusMesh(), lucent.CylinderMesh()]
    material = lucent.StandardMaterial3D()
    thing = lucent.MeshInstance3D(name="Thing", material_override=material)
    ground = lucent.MeshInstance3D(name="Ground", mesh=lucent.PlaneMesh(size=lucent.Vector2(10, 10)))
    sun = lucent.DirectionalLight3D(name="Sun", shadow_enabled=True)
    camera = lucent.Camera3D(name="Camera")
    for node in (thing, ground, sun, camera):
        scene.add_child(node)
    for number in range(count):
        thing.mesh = shapes[number % len(shapes)]
        thing.position = lucent.Vector3(*generator.uniform((-1, 0.5, -1), (1, 1.5, 1)))
        thing.rotation = lucent.Vector3(*generator.uniform(0, 6.28, 3))
        material.albedo_color = lucent.Color.from_hsv(float(generator.random()), 0.7, 0.9)
        sun.rotation_degrees = lucent.Vector3(float(generator.uniform(-80, -20)), float(generator.uniform(0, 360)), 0)
        camera.look_at_from_position(lucent.Vector3(*generator.uniform((-3, 1.5, 3), (3, 3, 5))), lucent.Vector3(0, 0.5, 0))
        frame = tree.render(size, frames=frames, aovs=["depth", "normal"], srgb=False)
        numpy.savez_compressed(os.path.join(folder, f"{number:04d}.npz"), color=frame.color, depth=frame["depth"], normal=frame["normal"])
print(f"{count} pictures in {folder}")
