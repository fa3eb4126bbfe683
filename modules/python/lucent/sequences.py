# SPDX-License-Identifier: MIT
"""Many frames into files, on one machine or by shares: python -m lucent.sequences SCENE -o shot/f_####.exr --frame-range 1-240.

A frame is written under another name, synchronised and renamed, so that no half file is ever seen. Its JSON, written the same way
afterwards, has a key of what it depends on; --resume skips frames whose picture and key are there.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import platform
import signal
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import lucent
from lucent import _lucent
from lucent.frames import check_pattern, frame_path, frames_text, parse_frames, parse_shard, shard_frames

EXIT_FAILED = 6  # some frames failed, others are there
EXIT_INTERRUPTED = 75  # run it again
_SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1)


class Interrupted(Exception):
    """A signal asked to stop; no partial file is left."""


class SequenceResult:
    """Which frames were drawn, skipped and failed."""

    def __init__(self) -> None:
        self.drawn: List[int] = []
        self.skipped: List[int] = []
        self.failed: Dict[int, str] = {}
        self.interrupted = False

    @property
    def exit_code(self) -> int:
        return EXIT_INTERRUPTED if self.interrupted else EXIT_FAILED if self.failed else 0

    def __repr__(self) -> str:
        state = ", interrupted" if self.interrupted else ""
        return f"<SequenceResult {len(self.drawn)} drawn, {len(self.skipped)} skipped, {len(self.failed)} failed{state}>"


def _dependencies(scene: str) -> Iterator[str]:
    """The scene's files: itself and what their texts name, as far as it lies on disk."""
    seen, queue = set(), [os.path.abspath(scene)]
    while queue:
        path = queue.pop()
        if path in seen or not os.path.isfile(path):
            continue
        seen.add(path)
        yield path
        if path.lower().endswith((".tscn", ".tres", ".gltf")):
            with open(path, encoding="utf-8", errors="replace") as file:
                names = [part for part in file.read().split('"')[1::2] if "." in part and len(part) < 4096 and "\n" not in part]
            for name in names:
                folder = os.path.dirname(path)
                relative = name[6:] if name.startswith("res://") else name
                queue.append(os.path.normpath(os.path.join(folder, relative)))
                while name.startswith("res://") and folder != os.path.dirname(folder):
                    folder = os.path.dirname(folder)
                    if os.path.isfile(os.path.join(folder, "project.godot")):
                        queue.append(os.path.normpath(os.path.join(folder, relative)))


def _scene_key(scenes: Sequence[str], settings: Any) -> str:
    digest = hashlib.sha256()
    for scene in scenes:
        for path in sorted(_dependencies(scene)):
            with open(path, "rb") as file:
                content = hashlib.sha256(file.read()).hexdigest()
            digest.update(f"{os.path.basename(path)} {content}\n".encode())
    with open(_lucent.__file__, "rb") as file:  # the renderer and its shaders
        digest.update(hashlib.sha256(file.read()).digest())
    digest.update(json.dumps(settings, sort_keys=True, default=str).encode())
    return digest.hexdigest()


def _publish(path: str, write: Callable[[str], None]) -> None:
    """write(temporary), then a rename that leaves either the old file or the whole new one."""
    folder, name = os.path.split(os.path.abspath(path))
    temporary = os.path.join(folder, f".{os.path.splitext(name)[0]}.{os.getpid()}.{platform.node()}.tmp{os.path.splitext(name)[1]}")
    try:
        write(temporary)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _remove_leftovers(folder: str) -> None:
    """Temporary files of processes that are gone, or a day old."""
    for name in os.listdir(folder or "."):
        parts = name.split(".")
        if not name.startswith(".") or len(parts) < 5 or parts[-2] != "tmp":
            continue
        path = os.path.join(folder, name)
        host, pid = ".".join(parts[3:-2]), parts[2]
        dead = host == platform.node() and pid.isdigit() and not os.path.exists(f"/proc/{pid}")
        try:
            if dead or time.time() - os.stat(path).st_mtime > 86400:
                os.unlink(path)
        except FileNotFoundError:
            pass


def _write_text(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _is_done(path: str, key: str) -> bool:
    try:
        with open(os.path.splitext(path)[0] + ".json", encoding="utf-8") as file:
            facts = json.load(file)
        return bool(facts["key"] == key and facts["bytes"] == os.path.getsize(path))
    except (OSError, ValueError, KeyError, TypeError):
        return False


def sequence(
    tree: Any,
    frames: Union[str, Sequence[int]],
    out: str,
    fps: float = 24.0,
    size: Tuple[int, int] = (1280, 720),
    resume: bool = False,
    keep: bool = False,
    on_frame: Optional[Callable[[Any, int, float], None]] = None,
    gi_mode: str = "settle",
    preroll: int = 40,
    max_frames: Optional[int] = None,
    camera: Any = None,
    aovs: Sequence[str] = (),
    key: str = "",
    stop_on_error: bool = False,
    require_converged: bool = False,
    progress: Optional[Callable[[str], None]] = None,
) -> SequenceResult:
    """Draws frames into files named by `out`, one run of # being the frame's digits.

    tree: a scene's path (a fresh tree each frame with gi_mode "settle", so that frames depend on nothing but their number), or a SceneTree.
    on_frame(tree, frame, seconds) prepares each frame; AnimationPlayers are sought to the time. gi_mode "carry" takes the light of one frame
    into the next, after `preroll` frames that aren't written. key: what else a frame depends on, for `resume` (on_frame's own version, say).
    """
    numbers = parse_frames(frames) if isinstance(frames, str) else list(dict.fromkeys(frames))
    check_pattern(out)
    if gi_mode not in ("settle", "carry"):
        raise ValueError(f"gi_mode: expected 'settle' or 'carry', got '{gi_mode}'")
    if fps <= 0:
        raise ValueError(f"fps: must be above 0, got {fps}")
    folder = os.path.dirname(out)
    os.makedirs(folder or ".", exist_ok=True)
    with tempfile.TemporaryFile(dir=folder or "."):  # a folder that can't be written is known before the first frame
        pass
    _remove_leftovers(folder)
    scene = os.fspath(tree) if isinstance(tree, (str, os.PathLike)) else ""
    held = lucent.load(scene) if scene else None  # read once
    carried: Any = None if scene and gi_mode == "settle" else (lucent.open(scene) if scene else tree)
    settings = [size, fps, gi_mode, preroll if gi_mode == "carry" else 0, max_frames, list(aovs), camera if isinstance(camera, str) else None, key]
    scene_key = _scene_key([scene or carried.current_scene.scene_file_path], settings)
    result = SequenceResult()
    started = time.monotonic()

    def prepare(made: Any, number: int) -> None:
        for player in made.root.find_children("*", "AnimationPlayer", owned=False):
            player.call("seek", number / fps, True)
        if on_frame is not None:
            on_frame(made, number, number / fps)

    def picture(made: Any, count: Optional[int]) -> Any:
        view = made.current_scene[camera] if isinstance(camera, str) else camera
        return made.render(size, camera=view, frames=count, aovs=aovs, delta=1 / fps, srgb=out.lower().endswith(".png"))

    def draw(number: int) -> Any:
        if carried is None:
            with lucent.open(scene) as made:
                prepare(made, number)
                return picture(made, max_frames)
        prepare(carried, number)
        return picture(carried, 1 if gi_mode == "carry" else max_frames)

    previous: Optional[int] = None
    for place, number in enumerate(numbers):
        path = frame_path(out, number)
        frame_key = hashlib.sha256(f"{scene_key} {number}".encode()).hexdigest()
        if (keep and os.path.exists(path)) or (resume and _is_done(path, frame_key)):
            result.skipped.append(number)
            continue
        begun = time.monotonic()
        try:
            if gi_mode == "carry" and previous != number - 1:
                for early in range(number - preroll, number):
                    draw(early)
            frame = draw(number)
            previous = number
            if require_converged and gi_mode == "settle" and not frame.stats["converged"]:
                raise lucent.Error(f"not converged after {frame.stats['frames']} frames")
            _publish(path, frame.save)
            facts = {"key": frame_key, "frame": number, "time": number / fps, "bytes": os.path.getsize(path), "host": platform.node()}
            facts.update({"seconds": time.monotonic() - begun, "version": lucent.version, **frame.stats})
            _publish(os.path.splitext(path)[0] + ".json", lambda name: _write_text(name, json.dumps(facts, indent=1) + "\n"))
        except (Interrupted, KeyboardInterrupt):
            result.interrupted = True
            break
        except (lucent.Error, OSError) as error:
            result.failed[number] = str(error)
            previous = None
            if stop_on_error or isinstance(error, OSError):
                result.failed.update({later: "not begun" for later in numbers[place + 1 :]})
                break
            continue
        result.drawn.append(number)
        if progress is not None:
            done = place + 1
            left = (time.monotonic() - started) / done * (len(numbers) - done)
            progress(f"frame {done}/{len(numbers)} {os.path.basename(path)} {time.monotonic() - begun:.2f} s (eta {left / 60:.0f} min)")
    del held
    return result


def _options(arguments: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="lucent.sequences", description="Draws frames of a scene into files.")
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", required=True, help="the files: one run of # stands for the frame's digits")
    parser.add_argument("--frame-range", required=True, help="1-240, 1-240:2 or 1-3,5")
    parser.add_argument("--fps", type=float, default=24.0, help="frames a second [24]")
    parser.add_argument("--size", default="1280x720", help="WIDTHxHEIGHT [1280x720]")
    parser.add_argument("--frames", type=int, help="GI frames a picture [until converged]")
    parser.add_argument("--camera", help="a camera's path below the scene's root")
    parser.add_argument("--aov", default="", help="layers of .exr files, separated by commas")
    parser.add_argument("--gi-mode", choices=("settle", "carry"), default="settle", help="light from nothing, or from the frame before [settle]")
    parser.add_argument("--preroll", type=int, default=40, help="frames before the first one that --gi-mode carry draws unseen [40]")
    parser.add_argument("--resume", action="store_true", help="skip frames that are there with the same key")
    parser.add_argument("--keep", action="store_true", help="skip frames that are there, whatever they are")
    parser.add_argument("--shard", help="INDEX/COUNT, from 0, or slurm: this process's share of the frames")
    parser.add_argument("--stop-on-error", action="store_true")
    parser.add_argument("--require-converged", action="store_true")
    parser.add_argument("--progress", choices=("line", "openjd", "json", "none"), default="line")
    return parser.parse_args(arguments)


def _show(kind: str) -> Optional[Callable[[str], None]]:
    def show(text: str) -> None:
        done, total = (int(part) for part in text.split()[1].split("/"))
        lines = {"line": text, "openjd": f"openjd_progress: {100 * done // total}", "json": json.dumps({"done": done, "total": total})}
        print(lines[kind], flush=True)

    return None if kind == "none" else show


def main(arguments: Optional[Sequence[str]] = None) -> int:
    options = _options(arguments)

    def stop(number: int, _: Any) -> None:
        for name in _SIGNALS:
            signal.signal(name, signal.SIG_DFL)  # a second one ends the process at once
        raise Interrupted(signal.Signals(number).name)

    for name in _SIGNALS:
        signal.signal(name, stop)
    result = SequenceResult()
    try:
        numbers = parse_frames(options.frame_range)
        if options.shard:
            numbers = shard_frames(numbers, *parse_shard(options.shard))
        width, height = (int(part) for part in options.size.split("x"))
        result = sequence(
            options.scene,
            numbers,
            options.output,
            fps=options.fps,
            size=(width, height),
            resume=options.resume,
            keep=options.keep,
            gi_mode=options.gi_mode,
            preroll=options.preroll,
            max_frames=options.frames,
            camera=options.camera,
            aovs=[name for name in options.aov.split(",") if name],
            stop_on_error=options.stop_on_error,
            require_converged=options.require_converged,
            progress=_show(options.progress),
        )
    except Interrupted:
        result.interrupted = True
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except (lucent.LoadError, lucent.DeviceError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3 if isinstance(error, lucent.LoadError) else 1
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 4
    for number, text in result.failed.items():
        print(f"error: frame {number}: {text}", file=sys.stderr)
    if result.failed:
        print(f"to draw again: --frame-range {frames_text(list(result.failed))}", file=sys.stderr)
    print(f"{len(result.drawn)} drawn, {len(result.skipped)} skipped, {len(result.failed)} failed" + (", interrupted: run it again" if result.interrupted else ""), file=sys.stderr)
    if result.failed and not result.drawn and not result.skipped and not result.interrupted:
        return 4 if any("writ" in text or "space" in text for text in result.failed.values()) else 1
    return result.exit_code


if __name__ == "__main__":
    sys.exit(main())
