# SPDX-License-Identifier: MIT
"""Sequences: lists, shares, files that are whole or absent, running again."""

import json
import os
import random
import signal
import subprocess
import sys
import time

import pytest

import lucent
from lucent import frames, sequences

SCENE = """[gd_scene format=3]
[sub_resource type="BoxMesh" id="m"]
[node name="Main" type="Node3D"]
[node name="Box" type="MeshInstance3D" parent="."]
mesh = SubResource("m")
[node name="Lamp" type="OmniLight3D" parent="."]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2)
[node name="Camera" type="Camera3D" parent="."]
transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 3)
[node name="World" type="WorldEnvironment" parent="."]
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.tscn"
    path.write_text(SCENE)
    return str(path)


def command(scene, out, *more):
    return [sys.executable, "-m", "lucent.sequences", scene, "-o", str(out), "--size", "32x18", "--frames", "1", *more]


def pictures(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.glob("f_*.exr"))}


def test_lists():
    assert frames.parse_frames("7,1-3,2,5") == [7, 1, 2, 3, 5]
    assert frames.parse_frames("1-5:2") == frames.parse_frames("1-5x2") == [1, 3, 5]
    assert frames.parse_frames("-2--1") == [-2, -1]
    assert frames.frames_text([1, 2, 3, 5, -1, 0]) == "1-3,5,-1-0"
    for text in ("", "a", "1-", "3-1", "1-3:0", "1,,2", "1-3,", "0-1000000", "1-3:2:2", "1 2"):
        with pytest.raises(ValueError, match="frames"):
            frames.parse_frames(text)


def test_shares_cover_every_frame_once():
    numbers = list(range(1, 41))
    for count in (1, 3, 8, 40, 50):
        assert [number for index in range(count) for number in frames.shard_frames(numbers, index, count)] == numbers
    task = {"SLURM_ARRAY_TASK_ID": "12", "SLURM_ARRAY_TASK_MIN": "10", "SLURM_ARRAY_TASK_COUNT": "4"}
    assert frames.parse_shard("slurm", task) == (2, 4)
    for text in ("8/8", "-1/8", "1", "a/b", "1/0"):
        with pytest.raises(ValueError, match="shard"):
            frames.parse_shard(text)
    with pytest.raises(ValueError, match="no SLURM_ARRAY_TASK_ID"):
        frames.parse_shard("slurm", {})


def test_names():
    assert frames.frame_path("shot/f_####.exr", 37) == "shot/f_0037.exr"
    assert frames.frame_path("f_##.png", 1234) == "f_1234.png"
    assert frames.frame_path("f_###.png", -7) == "f_-007.png"
    with pytest.raises(ValueError, match=r"for example -o a/f_####.png"):
        frames.check_pattern("a/f.png")
    for pattern in ("a#/f.png", "f_#_#.png", "f_#.jpg"):
        with pytest.raises(ValueError):
            frames.check_pattern(pattern)


def test_any_chunking_gives_the_same_bytes(scene, tmp_path):
    wanted = None
    for parts in ((["1-6"]), (["1-2", "3-6"]), (["5-6", "1-4"])):
        folder = tmp_path / f"chunks{len(parts)}{parts[0]}"
        for part in parts:
            result = sequences.sequence(scene, part, str(folder / "f_####.exr"), size=(32, 18), max_frames=2, on_frame=move)
            assert result.exit_code == 0
        wanted = wanted or pictures(folder)
        assert len(wanted) == 6 and pictures(folder) == wanted
    assert wanted["f_0001.exr"] != wanted["f_0006.exr"]
    facts = json.loads((folder / "f_0003.json").read_text())
    assert facts["frame"] == 3 and facts["time"] == 3 / 24 and facts["device"]["name"]


def move(tree, frame, seconds):
    tree.current_scene["Lamp"].position = (frame / 3, 2, 2)


def test_killed_at_random_and_resumed(scene, tmp_path):
    generator = random.Random(3)
    undisturbed = tmp_path / "whole"
    assert subprocess.run(command(scene, undisturbed / "f_####.exr", "--frame-range", "1-12"), capture_output=True).returncode == 0
    folder = tmp_path / "killed"
    out = folder / "f_####.exr"
    for _ in range(4):
        process = subprocess.Popen(command(scene, out, "--frame-range", "1-12", "--resume"), stdout=subprocess.PIPE, text=True)
        process.stdout.readline()
        time.sleep(generator.random() * 0.15)
        process.kill()
        process.wait()
        for path in folder.glob("f_*.exr"):
            assert path.read_bytes() == (undisturbed / path.name).read_bytes()
    result = subprocess.run(command(scene, out, "--frame-range", "1-12", "--resume"), capture_output=True, text=True)
    assert result.returncode == 0 and "skipped" in result.stderr
    assert pictures(folder) == pictures(undisturbed)
    assert not [name for name in os.listdir(folder) if ".tmp" in name]


def test_stale_frames_are_drawn_again(scene, tmp_path):
    out = str(tmp_path / "f_####.exr")
    settings = dict(size=(32, 18), max_frames=1, resume=True)
    assert sequences.sequence(scene, "1-3", out, **settings).drawn == [1, 2, 3]
    assert sequences.sequence(scene, "1-3", out, **settings).skipped == [1, 2, 3]
    os.truncate(tmp_path / "f_0002.exr", 10)
    assert sequences.sequence(scene, "1-3", out, **settings).drawn == [2]
    with open(scene, "a") as file:
        file.write("environment = null\n")
    assert sequences.sequence(scene, "1-3", out, **settings).drawn == [1, 2, 3]
    assert sequences.sequence(scene, "1-3", out, **dict(settings, fps=30)).drawn == [1, 2, 3]


@pytest.mark.parametrize("name", [signal.SIGTERM, signal.SIGINT, signal.SIGUSR1])
def test_signals_stop_between_files(scene, tmp_path, name):
    process = subprocess.Popen(command(scene, tmp_path / "f_####.exr", "--frame-range", "1-100000"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.stdout.readline()
    process.send_signal(name)
    start = time.monotonic()
    errors = process.communicate(timeout=20)[1]
    assert process.returncode == 75 and time.monotonic() - start < 2, errors
    assert "interrupted: run it again" in errors
    assert not [entry for entry in os.listdir(tmp_path) if ".tmp" in entry]


def test_failing_frames_are_named(scene, tmp_path):
    def fail(tree, frame, seconds):
        if frame == 2:
            raise lucent.Error("no such weather")

    result = sequences.sequence(scene, "1-3", str(tmp_path / "f_#.exr"), size=(32, 18), max_frames=1, on_frame=fail)
    assert result.drawn == [1, 3] and result.failed == {2: "no such weather"} and result.exit_code == 6


def test_exit_codes(scene, tmp_path):
    def code(*arguments):
        return subprocess.run([sys.executable, "-m", "lucent.sequences", *arguments], capture_output=True).returncode

    out = str(tmp_path / "f_#.exr")
    assert code(scene, "-o", str(tmp_path / "f.exr"), "--frame-range", "1") == 2
    assert code(scene, "-o", out, "--frame-range", "3-1") == 2
    assert code(str(tmp_path / "none.tscn"), "-o", out, "--frame-range", "1") == 3
    assert code(scene, "-o", "/proc/none/f_#.exr", "--frame-range", "1") == 4
    assert code(scene, "-o", out, "--frame-range", "1-2", "--shard", "7/8") == 0


def test_full_disk(scene, tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk], capture_output=True).returncode != 0:
        pytest.skip("mounting a small tmpfs needs root")
    try:
        run = subprocess.run([*command(scene, disk / "f_####.exr", "--frame-range", "1-30"), "--size", "96x54"], capture_output=True, text=True)
        assert run.returncode in (4, 6), run.stderr
        assert "to draw again" in run.stderr
        for path in disk.glob("f_*.exr"):
            assert path.read_bytes().startswith(b"\x76\x2f\x31\x01") and path.stat().st_size > 1000
        assert not [name for name in os.listdir(disk) if ".tmp" in name]
    finally:
        subprocess.run(["umount", disk], check=True)
