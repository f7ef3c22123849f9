"""Keyframes as they were captured: their rows, their frames and the clips around them.

A frame is written before its row is, and both before the robot is answered: an acknowledged
keyframe survives a killed process. Nothing is forced onto the disk while a robot waits, so a
power cut may take the last of them; then the store ends earlier, whole, and the robot, which
keeps the keyframes of its run, sends them again.
"""

from __future__ import annotations

import contextlib
import dataclasses
import json
import sqlite3
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from ...errors import StoreError
from ...run_view.overview import KeyframeEntry
from ...vocabulary import Keyframe, from_json, to_json
from .chain import CLIPS, FRAMES, sha256
from .database import Database, readable
from .frames import FrameFiles

LEFT_OUT = {
    field.name: to_json(field.default)
    for field in dataclasses.fields(Keyframe)
    if field.default is not dataclasses.MISSING
}
"""What a keyframe of an older robot may not hold."""


@dataclass(frozen=True)
class Captured:
    """A keyframe as it was kept.

    Attributes:
        keyframe: What the robot sent.
        exposed_after_s: From the arrival of the request to the start of the exposure, s.
        captured: When it was kept, seconds since the epoch.
    """

    keyframe: Keyframe
    exposed_after_s: float
    captured: float


class Captures(Database):
    """Every method raises StoreError where the disk fails."""

    def __init__(self, folder: Path, alone: bool = False) -> None:
        super().__init__(folder, alone)
        with self._plain_errors("open"):
            self._frames = FrameFiles(folder)

    def add_keyframe(self, captured: Captured, jpeg: bytes) -> None:
        """Keep a keyframe and its frame. The same one again changes nothing."""
        keyframe = captured.keyframe
        with self._plain_errors("keep a frame in"):
            self._frames.write(keyframe.run, keyframe.sequence, jpeg)
        self._write(
            "INSERT INTO keyframes VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING",
            (
                keyframe.run,
                keyframe.sequence,
                keyframe.trajectory,
                json.dumps(to_json(keyframe)),
                captured.exposed_after_s,
                captured.captured,
            ),
            keyframe.run,
            [(FRAMES, str(keyframe.sequence), sha256(jpeg))],
        )

    def mark_late(self, run: str, sequence: int) -> None:
        """Keep that the robot had moved on before it heard that this keyframe was captured."""
        self._write(
            "UPDATE keyframes SET keyframe = json_set(keyframe, '$.late', json('true')) "
            "WHERE run = ? AND sequence = ?",
            (run, sequence),
        )

    def keyframe(self, run: str, sequence: int) -> Captured | None:
        """What was kept under this number, or ``None``."""
        rows = self._read("SELECT * FROM keyframes WHERE run = ? AND sequence = ?", run, sequence)
        if not rows:
            return None
        captured = _captured(rows[0])
        if captured is None:
            raise StoreError(f"The record of keyframe {sequence} of run {run!r} is damaged.")
        return captured

    def keyframes(self, run: str) -> list[Captured]:
        """All keyframes of a run in order."""
        rows = self._read("SELECT * FROM keyframes WHERE run = ? ORDER BY sequence", run)
        return [captured for row in rows if (captured := _captured(row)) is not None]

    def told_keyframes(self, run: str) -> list[KeyframeEntry]:
        """All keyframes of a run in order as plain JSON, with ``captured`` and
        ``exposed_after_s``; ten times as fast as :meth:`keyframes`.
        """
        rows = self._read("SELECT * FROM keyframes WHERE run = ? ORDER BY sequence", run)
        return [
            cast(
                "KeyframeEntry",
                LEFT_OUT
                | told
                | {"captured": row["captured"], "exposed_after_s": row["exposed_after_s"]},
            )
            for row in rows
            if (told := readable(row["keyframe"], dict)) is not None
        ]

    def next_sequence(self, run: str) -> int:
        """The number that the next keyframe of the run must have."""
        rows = self._read("SELECT max(sequence) FROM keyframes WHERE run = ?", run)
        return 0 if rows[0][0] is None else int(rows[0][0]) + 1

    def frame(self, run: str, sequence: int) -> bytes | None:
        """The JPEG of a keyframe, or ``None`` if there is no such keyframe."""
        if self.keyframe(run, sequence) is None:
            return None
        with self._plain_errors("read a frame from"):
            return self._frames.read(run, sequence)

    def frames_of(self, run: str) -> Callable[[int], bytes | None]:
        """For pages and reports: a keyframe's JPEG by its number; ``None``, too, where it cannot be
        read."""

        def frame(sequence: int) -> bytes | None:
            try:
                return self.frame(run, sequence)
            except StoreError:
                return None

        return frame

    def keep_clip(self, run: str, trajectory: int, video: bytes) -> None:
        """Keep the seconds around a delivery, unless the run was removed meanwhile."""
        path = self._frames.clip_path(run, trajectory)
        with self._plain_errors("keep a clip in"):
            if not path.parent.is_dir():
                return
            path.write_bytes(video)
        try:
            self._write("", (), run, [(CLIPS, str(trajectory), sha256(video))])
        except StoreError:
            path.unlink(missing_ok=True)
            raise

    def clips(self, run: str) -> set[int]:
        """Deliveries of which there is a clip."""
        with self._plain_errors("read from"):
            return self._frames.clips(run)

    def clip(self, run: str, trajectory: int) -> bytes | None:
        """The clip of a delivery, WebM; ``None`` where there is none."""
        path = self._frames.clip_path(run, trajectory)
        with self._plain_errors("read a clip from"):
            return path.read_bytes() if path.is_file() else None

    def frame_path(self, run: str, sequence: int) -> Path:
        """Where the JPEG of a keyframe is."""
        return self._frames.path(run, sequence)

    def files_of(self, run: str) -> dict[tuple[str, str], Path]:
        """The frames and clips that lie in a run's folder, by kind and number."""
        with self._plain_errors("read from"):
            return self._frames.files(run)

    def file_of(self, run: str, kind: str, number: int) -> Path:
        """Where one of them is, or will be."""
        return self._frames.file(run, kind, number)

    def file_digest(self, path: Path) -> str | None:
        """SHA-256 of one of them; ``None`` if it is gone by now."""
        with self._plain_errors("read a file from"), contextlib.suppress(FileNotFoundError):
            return sha256(path.read_bytes())
        return None

    def settle(self, run: str, sequence: int) -> None:
        """Force a frame onto the disk; takes what the disk takes."""
        with self._plain_errors("keep a frame in"):
            self._frames.settle(run, sequence)

    def forget_torn(self, run: str) -> None:
        """Forget what a power cut tore: the keyframes from the first unjudged one on whose
        frame is not whole. The robot has them still and sends them again.
        """
        rows = self._read(
            "SELECT sequence FROM keyframes k WHERE run = ? AND NOT EXISTS "
            "(SELECT 1 FROM verdicts v WHERE v.run = k.run AND v.trajectory = k.trajectory) "
            "ORDER BY sequence",
            run,
        )
        with self._plain_errors("read a frame from"):
            torn = next((n for (n,) in rows if not self._frames.is_whole(run, n)), None)
        if torn is not None:
            self._write("DELETE FROM keyframes WHERE run = ? AND sequence >= ?", (run, torn))


def _captured(row: sqlite3.Row) -> Captured | None:
    """``None`` where the row is damaged."""
    try:
        keyframe = from_json(Keyframe, json.loads(row["keyframe"]))
    except (TypeError, ValueError):
        return None
    return Captured(keyframe, row["exposed_after_s"], row["captured"])
