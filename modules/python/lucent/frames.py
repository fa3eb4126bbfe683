# SPDX-License-Identifier: MIT
"""Frame lists, shards and file names of sequences."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from typing import List, Optional, Tuple

MAX_FRAMES = 1000000
_PART = re.compile(r"(-?\d{1,9})(?:-(-?\d{1,9})(?:[:x](\d{1,9}))?)?")


def parse_frames(text: str) -> List[int]:
    """ "1-240", "1-240:2" (or 1-240x2), "1-3,5,-4--1": in the order given, doubles once."""
    frames: List[int] = []
    for part in text.split(","):
        match = _PART.fullmatch(part)
        if match is None:
            raise ValueError(f"frames '{text}': expected 1-240, 1-240:2 or 1-3,5")
        begin, end, every = match.groups()
        first, last, step = int(begin), int(end or begin), int(every or 1)
        if step < 1 or last < first:
            raise ValueError(f"frames '{text}': expected 1-240, 1-240:2 or 1-3,5")
        if (last - first) // step + len(frames) >= MAX_FRAMES:
            raise ValueError(f"frames '{text}': more than {MAX_FRAMES} frames")
        frames.extend(range(first, last + 1, step))
    return list(dict.fromkeys(frames))


def frames_text(frames: Sequence[int]) -> str:
    """The text that parse_frames reads back."""
    runs: List[List[int]] = []
    for frame in frames:
        if runs and frame == runs[-1][1] + 1:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame])
    return ",".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def shard_frames(frames: Sequence[int], index: int, count: int) -> List[int]:
    """Part `index` of `count`, from 0, contiguous, as even as can be; parts beyond the frames are empty."""
    return list(frames[len(frames) * index // count : len(frames) * (index + 1) // count])


def parse_shard(text: str, environment: Optional[Mapping[str, str]] = None) -> Tuple[int, int]:
    """ "2/8", from 0; or "slurm": SLURM_ARRAY_TASK_ID, _MIN and _COUNT of the environment."""
    environment = os.environ if environment is None else environment
    try:
        if text == "slurm":
            number, first, count = (int(environment["SLURM_ARRAY_TASK_" + name]) for name in ("ID", "MIN", "COUNT"))
            index = number - first
        else:
            index, count = (int(part) for part in text.split("/"))
    except KeyError as error:
        raise ValueError(f"shard slurm: the environment has no {error.args[0]}; it works inside of an array job (sbatch --array=0-7)") from None
    except ValueError:
        raise ValueError(f"shard '{text}': expected INDEX/COUNT, for example 0/8, or slurm") from None
    if not 0 <= index < count:
        raise ValueError(f"shard '{text}': the index must be from 0 to one less than the count, got {index} of {count}")
    return index, count


def check_pattern(pattern: str) -> None:
    """One run of # in the file's name."""
    folder, name = os.path.split(pattern)
    stem, ending = os.path.splitext(pattern)
    if "#" not in pattern:
        raise ValueError(f"-o '{pattern}': a sequence needs # for the frame's digits, for example -o {stem}_####{ending}")
    if "#" in folder or len(re.findall("#+", name)) != 1:
        raise ValueError(f"-o '{pattern}': expected one run of # in the file's name")
    if ending.lower() not in (".png", ".exr"):
        raise ValueError(f"-o '{pattern}': the name must end in .png (display) or .exr (linear)")


def frame_path(pattern: str, frame: int) -> str:
    """ "f_####.exr" of 37 is "f_0037.exr": as many digits at least, the sign before them."""
    return re.sub("#+", lambda run: ("-" if frame < 0 else "") + str(abs(frame)).zfill(len(run.group())), pattern)
