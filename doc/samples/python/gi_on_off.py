# SPDX-License-Identifier: MIT
"""The same room with and without global illumination: ./lucent python doc/samples/python/gi_on_off.py [FOLDER]"""

import os
import sys

import lucent

folder = sys.argv[1] if len(sys.argv) > 1 else "."
size = (int(os.environ.get("WIDTH", 640)), int(os.environ.get("HEIGHT", 480)))
frames = int(os.environ.get("FRAMES", 0)) or None
with lucent.open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cornell/cornell.tscn")) as tree:
    world = tree.current_scene.find_children("*", "WorldEnvironment")[0]
    means = {}
    for on in (True, False):
        world.environment.sdfgi_enabled = on
        frame = tree.render(size, frames=frames)
        frame.save(os.path.join(folder, f"gi_{'on' if on else 'off'}.png"))
        means[on] = float(frame.color.mean())
print(f"mean radiance with GI {means[True]:.4f}, without {means[False]:.4f}")
