# SPDX-License-Identifier: MIT
"""The sun goes round: ./lucent python doc/samples/python/day_cycle.py [FOLDER]"""

import math
import os
import sys

import lucent

folder = sys.argv[1] if len(sys.argv) > 1 else "."
size = (int(os.environ.get("WIDTH", 640)), int(os.environ.get("HEIGHT", 360)))
frames = int(os.environ.get("FRAMES", 0)) or None
hours = range(6, 19, int(os.environ.get("STEP", 2)))


class Sun(lucent.DirectionalLight3D):
    hour = 12.0

    def _process(self, delta: float) -> None:
        height = math.sin((self.hour - 6) / 12 * math.pi)
        self.rotation_degrees = lucent.Vector3(-90 * max(height, 0.05), (self.hour - 12) * 15, 0)
        self.light_energy = max(height, 0.0)
        self.light_color = lucent.Color("#ff9050").lerp(lucent.Color("#ffffff"), height)


with lucent.SceneTree() as tree:
    scene = lucent.Node3D(name="Main")
    tree.current_scene = scene
    ground = lucent.MeshInstance3D(name="Ground", mesh=lucent.PlaneMesh(size=lucent.Vector2(20, 20)))
    tower = lucent.MeshInstance3D(name="Tower", mesh=lucent.BoxMesh(size=lucent.Vector3(1, 4, 1)))
    tower.position = lucent.Vector3(0, 2, 0)
    camera = lucent.Camera3D(name="Camera")
    camera.look_at_from_position(lucent.Vector3(6, 4, 8), lucent.Vector3(0, 1.5, 0))
    sun = Sun(name="Sun", shadow_enabled=True)
    for node in (ground, tower, camera, sun):
        scene.add_child(node)
    for hour in hours:
        sun.hour = float(hour)
        frame = tree.render(size, frames=frames)
        frame.save(os.path.join(folder, f"hour_{hour:02d}.png"))
        print(f"{hour:2d} h: mean radiance {float(frame.color.mean()):.4f}")
