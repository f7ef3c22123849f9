"""The JPEG files of captured frames, one folder per run."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
from pathlib import Path

FRAMES = "frames"


class FrameFiles:
    """Frames under one data folder.

    Every method raises OSError if the disk does not play along.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder / FRAMES
        self._folder.mkdir(parents=True, exist_ok=True)

    def path(self, run: str, sequence: int) -> Path:
        """Where a frame is, or will be."""
        return self._folder / folder_name(run) / f"{sequence:06d}.jpg"

    def write(self, run: str, sequence: int, jpeg: bytes) -> None:
        """Write a frame so that it is whole or absent, even if this process is killed.

        It is not forced onto the disk: that takes up to some ten ms, and a robot is waiting.
        """
        path = self.path(run, sequence)
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(".partial")
        partial.write_bytes(jpeg)
        partial.replace(path)

    def clips(self, run: str) -> set[int]:
        """Deliveries of which a clip was kept."""
        return {int(file.stem[5:]) for file in self.path(run, 0).parent.glob("clip-*.webm")}

    def clip_path(self, run: str, trajectory: int) -> Path:
        """Where the clip of a delivery is, or will be."""
        return self.path(run, 0).parent / f"clip-{trajectory}.webm"

    def files(self, run: str) -> dict[tuple[str, str], Path]:
        """The frames and clips that lie there, by kind and number; a picture that is named as no
        frame is, ``2.jpg``, by that name."""
        folder = self.path(run, 0).parent
        found = {}
        for file in folder.glob("*.jpg"):
            number = int(file.stem) if file.stem.isdecimal() else -1
            is_ours = file.name == self.path(run, number).name
            found["frames", str(number) if is_ours else file.name] = file
        return found | {("clips", file.stem[5:]): file for file in folder.glob("clip-*.webm")}

    def file(self, run: str, kind: str, number: int) -> Path:
        """Where a frame or clip is, or will be."""
        return (self.path if kind == "frames" else self.clip_path)(run, number)

    def size(self, run: str) -> int:
        """What a run's frames take, bytes."""
        folder = self._folder / folder_name(run)
        return sum(file.stat().st_size for file in folder.glob("*")) if folder.is_dir() else 0

    def remove(self, run: str) -> None:
        """Remove a run's frames."""
        folder = self._folder / folder_name(run)
        if folder.is_dir():
            shutil.rmtree(folder)

    def settle(self, run: str, sequence: int) -> None:
        """Force a frame onto the disk, so that it survives a power cut as well."""
        with self.path(run, sequence).open("r+b") as file:
            os.fsync(file.fileno())

    def read(self, run: str, sequence: int) -> bytes:
        """The JPEG."""
        return self.path(run, sequence).read_bytes()

    def is_whole(self, run: str, sequence: int) -> bool:
        """Whether the file begins and ends as a JPEG; a power cut can leave an empty one."""
        try:
            jpeg = self.read(run, sequence)
        except FileNotFoundError:
            return False
        return jpeg.startswith(b"\xff\xd8") and b"\xff\xd9" in jpeg[-64:]


def folder_name(run: str) -> str:
    """A folder name that is safe everywhere and different for every run."""
    slug = re.sub(r"[^A-Za-z0-9-]+", "-", run).strip("-")[:40]
    return f"{slug or 'run'}-{hashlib.sha256(run.encode()).hexdigest()[:8]}"
