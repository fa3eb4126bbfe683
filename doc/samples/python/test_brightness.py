# SPDX-License-Identifier: MIT
"""Guards a scene's brightness: ./lucent python -m pytest doc/samples/python/test_brightness.py"""

import os

import lucent

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cornell/cornell.tscn")


def test_room_is_neither_dark_nor_burnt_out() -> None:
    with lucent.open(SCENE) as tree:
        frame = tree.render((64, 48), frames=8)
    assert 0.02 < float(frame.color.mean()) < 1.0
    assert float((frame.srgb == 255).mean()) < 0.5
