# SPDX-License-Identifier: MIT
"""For tests of scenes. With pytest: `pytest_plugins = ["lucent.testing"]` in conftest.py gives the fixture `tree`."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any, Dict

import numpy

import lucent


def compare(a: Any, b: Any, exposure: float = 1.0) -> Dict[str, float]:
    """lucent.compare."""
    return lucent.compare(a, b, exposure)


def assert_close(a: Any, b: Any, nrmse: float = 0.01, folder: str = ".") -> None:
    """AssertionError where a is further from b; then a.exr, b.exr and difference.png are in `folder`."""
    figures = compare(a, b)
    if figures["nrmse"] <= nrmse:
        return
    os.makedirs(folder, exist_ok=True)
    first, second = numpy.asarray(a, numpy.float32), numpy.asarray(b, numpy.float32)
    lucent.save(os.path.join(folder, "a.exr"), first)
    lucent.save(os.path.join(folder, "b.exr"), second)
    lucent.save(os.path.join(folder, "difference.png"), numpy.abs(first - second))
    raise AssertionError(f"nrmse is {figures['nrmse']:.4g}, the bound is {nrmse:.4g}; pictures are in {folder}")


try:
    import pytest
except ImportError:
    pass
else:

    @pytest.fixture
    def tree() -> Iterator[Any]:
        """An empty SceneTree, closed after the test."""
        with lucent.SceneTree() as made:
            yield made
