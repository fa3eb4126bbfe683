# SPDX-License-Identifier: MIT
"""A door that a script opens lets light into a dark room: ./lucent python doc/samples/python/door.py [FOLDER]"""

import os
import sys

import lucent

folder = sys.argv[1] if len(sys.argv) > 1 else "."
size = (int(os.environ.get("WIDTH", 640)), int(os.environ.get("HEIGHT", 360)))
frames = int(os.environ.get("FRAMES", 30))


class Door(lucent.MeshInstance3D):
    """Slides 2 m to the side in one second."""

    closed = lucent.Vector3()

    def _ready(self) -> None:
        self.closed = self.position

    def _process(self, delta: float) -> None:
        if self.position.x - self.closed.x < 2:
            self.position += lucent.Vector3(2 * delta, 0, 0)


def wall(name: str, place: tuple[float, float, float], extent: tuple[float, float, float]) -> lucent.MeshInstance3D:
    made = lucent.MeshInstance3D(name=name, mesh=lucent.BoxMesh(size=lucent.Vector3(*extent)))
    made.position = lucent.Vector3(*place)
    return made


with lucent.SceneTree() as tree:
    scene = lucent.Node3D(name="Room")
    tree.current_scene = scene
    scene.add_child(wall("Floor", (0, -0.1, 0), (8, 0.2, 8)))
    scene.add_child(wall("Left", (-2.5, 1.5, 0), (3, 3, 0.2)))
    scene.add_child(wall("Right", (2.5, 1.5, 0), (3, 3, 0.2)))
    scene.add_child(wall("Door", (0, 1.5, 0), (2, 3, 0.2)))
    lamp = lucent.OmniLight3D(name="Lamp", omni_range=10.0, light_energy=4.0, shadow_enabled=True)
    lamp.position = lucent.Vector3(0, 1.5, -2)
    camera = lucent.Camera3D(name="Camera")
    camera.look_at_from_position(lucent.Vector3(0, 2, 4), lucent.Vector3(0, 1, 0))
    scene.add_child(lamp)
    scene.add_child(camera)
    tree.attach("Door", Door)
    for number, name in enumerate(("closed", "open")):
        frame = tree.render(size, frames=1 if number == 0 else frames, delta=1 / 30)
        frame.save(os.path.join(folder, f"door_{name}.png"))
        print(f"{name}: mean radiance {float(frame.color.mean()):.4f}")
