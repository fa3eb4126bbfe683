# SPDX-License-Identifier: MIT
"""How a room's light depends on the walls' albedo, drawn with matplotlib if it is there: ./lucent python doc/samples/python/parameter_study.py [FOLDER]"""

import importlib
import os
import sys

import lucent

folder = sys.argv[1] if len(sys.argv) > 1 else "."
size = (int(os.environ.get("WIDTH", 160)), int(os.environ.get("HEIGHT", 120)))
frames = int(os.environ.get("FRAMES", 0)) or None
steps = int(os.environ.get("STEPS", 5))
rows = []
with lucent.open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cornell/cornell.tscn")) as tree:
    world = tree.current_scene.find_children("*", "WorldEnvironment")[0]
    for step in range(steps):
        world.environment.sdfgi_energy = 2.0 * step / max(steps - 1, 1)
        rows.append((world.environment.sdfgi_energy, float(tree.render(size, frames=frames, srgb=False).color.mean())))
for energy, mean in rows:
    print(f"sdfgi_energy {energy:.2f}: mean radiance {mean:.4f}")
try:
    importlib.import_module("matplotlib").use("Agg")
    pyplot = importlib.import_module("matplotlib.pyplot")
except ImportError:
    print("no picture: matplotlib is missing (Debian: python3-matplotlib)")
else:
    pyplot.plot([row[0] for row in rows], [row[1] for row in rows], "o-")
    pyplot.xlabel("sdfgi_energy")
    pyplot.ylabel("mean radiance")
    pyplot.savefig(os.path.join(folder, "parameter_study.png"))
