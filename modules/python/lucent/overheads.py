# SPDX-License-Identifier: MIT
"""What the binding costs: ./lucent python -m lucent.overheads. Best of several runs, nanoseconds unless it says otherwise."""

from __future__ import annotations

import subprocess
import sys
import time
import timeit
from typing import Any, Callable

import lucent
from lucent import _lucent


def nanoseconds(statement: str, names: Any, count: int = 200000, empty: str = "pass") -> float:
    loop = min(timeit.repeat(empty, globals=names, number=count, repeat=7))
    return (min(timeit.repeat(statement, globals=names, number=count, repeat=7)) - loop) / count * 1e9


class Idle(lucent.Node):
    def _process(self, delta: float) -> None:
        pass


def process_cost(count: int = 2000) -> float:
    def frame(kind: Callable[[], Any]) -> float:
        with lucent.SceneTree() as tree:
            for _ in range(count):
                tree.root.add_child(kind())
            return min(timeit.repeat(lambda: tree.process(0.01), number=1, repeat=30))

    return (frame(Idle) - frame(lucent.Node)) / count * 1e9


def main() -> None:
    lamp, node = lucent.OmniLight3D(), lucent.Node3D()
    names = {"lamp": lamp, "node": node, "place": lucent.Vector3(1, 2, 3), "Vector3": lucent.Vector3}
    rows = [
        ("get a float", nanoseconds("lamp.light_energy", names), 120.0),
        ("get a Vector3", nanoseconds("node.position", names), 120.0),
        ("set a float", nanoseconds("lamp.light_energy = 2.0", names), None),
        ("set a Vector3", nanoseconds("node.position = place", names), None),
        ("call a method by name", nanoseconds("node.get_child_count()", names), None),
        ("_process from C++", process_cost(), 250.0),
    ]
    start = min(timeit.repeat(lambda: _lucent.make_picture(1920, 1080), number=1, repeat=10)) * 1e3
    code = "import time, numpy; t = time.perf_counter(); import lucent; print(time.perf_counter() - t)"
    imports = min(float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout) for _ in range(5))
    for name, value, bound in rows:
        print(f"{name:24} {value:8.0f} ns" + (f"   (wanted: at most {bound:.0f})" if bound else ""))
    print(f"{'1080p RGB floats to numpy':24} {start:7.1f} ms   (wanted: at most 6; filling them included)")
    print(f"{'import lucent':24} {imports:8.3f} s    (wanted: at most 0.3; numpy was there)")


if __name__ == "__main__":
    main()
