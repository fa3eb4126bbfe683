# SPDX-License-Identifier: MIT
import os

import pytest

import lucent

pytest_plugins = ["lucent.testing"]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


@pytest.fixture
def root():
    return ROOT


def box_scene(tree, **material):
    """A red box in the left top corner, a lamp, a camera that looks along -z."""
    scene = lucent.Node3D(name="Main")
    box = lucent.MeshInstance3D(name="Box", mesh=lucent.BoxMesh())
    box.material_override = lucent.StandardMaterial3D(
        albedo_color=lucent.Color(0, 0, 0), emission_enabled=True, emission=lucent.Color(1, 0, 0), **material
    )
    box.position = (-2, 1.2, 0)
    camera = lucent.Camera3D(name="Camera", fov=60.0)
    camera.position = (0, 0, 4)
    lamp = lucent.OmniLight3D(name="Lamp", omni_range=20.0)
    lamp.position = (0, 3, 3)
    for node in (box, camera, lamp):
        scene.add_child(node)
    tree.current_scene = scene
    return scene
