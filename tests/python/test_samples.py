# SPDX-License-Identifier: MIT
"""The samples of doc/samples/python run, small, and write what they say."""

import os
import re
import subprocess
import sys

import pytest

ENVIRONMENT = dict(os.environ, WIDTH="48", HEIGHT="36", FRAMES="3", STEPS="2", STEP="6")


def run(root, name, *arguments):
    script = os.path.join(root, "doc/samples/python", name)
    result = subprocess.run([sys.executable, script, *map(str, arguments)], env=ENVIRONMENT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def number(pattern, text):
    return float(re.search(pattern, text).group(1))


def test_first_picture(root, tmp_path):
    out = run(root, "first_picture.py", tmp_path / "a.png")
    assert "48x36" in out and (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_gi_on_off(root, tmp_path):
    out = run(root, "gi_on_off.py", tmp_path)
    assert number(r"with GI ([\d.]+)", out) > number(r"without ([\d.]+)", out)


def test_day_cycle(root, tmp_path):
    out = run(root, "day_cycle.py", tmp_path)
    assert number(r"12 h: mean radiance ([\d.]+)", out) > number(r" 6 h: mean radiance ([\d.]+)", out)


def test_door(root, tmp_path):
    out = run(root, "door.py", tmp_path)
    assert number(r"open: mean radiance ([\d.]+)", out) > number(r"closed: mean radiance ([\d.]+)", out)


def test_dataset(root, tmp_path):
    import numpy

    run(root, "dataset.py", tmp_path, 2)
    with numpy.load(tmp_path / "0001.npz") as data:
        assert data["color"].shape == (36, 48, 3) and data["depth"].shape == (36, 48) and data["normal"].shape == (36, 48, 3)


def test_parameter_study(root, tmp_path):
    out = run(root, "parameter_study.py", tmp_path)
    assert number(r"sdfgi_energy 2.00: mean radiance ([\d.]+)", out) > number(r"sdfgi_energy 0.00: mean radiance ([\d.]+)", out)


def test_pytest_sample(root):
    result = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", os.path.join(root, "doc/samples/python/test_brightness.py")], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout


def test_documents_examples(root, tmp_path, monkeypatch):
    """The python blocks of doc/python.md, in order, in one namespace."""
    monkeypatch.chdir(root)
    with open(os.path.join(root, "doc/python.md"), encoding="utf-8") as file:
        blocks = re.findall(r"```python\n(.*?)```", file.read(), re.S)
    assert len(blocks) >= 8
    names = {"OUT": str(tmp_path)}
    for block in blocks:
        exec(compile(block, "doc/python.md", "exec"), names)
