# SPDX-License-Identifier: MIT
"""A file becomes a picture: ./lucent python doc/samples/python/first_picture.py [OUT.png]"""

import os
import sys

import lucent

scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cornell/cornell.tscn")
size = (int(os.environ.get("WIDTH", 640)), int(os.environ.get("HEIGHT", 480)))
with lucent.open(scene) as tree:
    frame = tree.render(size, frames=int(os.environ.get("FRAMES", 0)) or None)
frame.save(sys.argv[1] if len(sys.argv) > 1 else "first_picture.png")
print(frame, "mean radiance", round(float(frame.color.mean()), 4))
