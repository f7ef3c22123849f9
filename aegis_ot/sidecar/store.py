"""Keeps runs, keyframes, verdicts, holds and decisions in SQLite, and frames as JPEG files.

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
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from ..account.overview import KeyframeEntry, RunEntry
from ..errors import StoreError
from ..vision.camera import SIMULATED_KINDS
from ..vocabulary import Keyframe, from_json, to_json
from .chain import CLIPS, FRAMES, sha256
from .database import DATABASE, readable
from .frames import FrameFiles, folder_name
from .records import OF_A_RUN, Records
from .wire import Finish, RunStart

__all__ = ["DATABASE", "SILENT", "Captured", "Store"]

SILENT = "silent"
"""Outcome of a run that ended without a word: its robot was switched off, or lost its network."""


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


class Store(Records):
    """One data folder: runs, their frames, and what came of them. Safe to use from threads.

    Args:
        folder: Made if it is missing.
        alone: See :class:`~.database.Database`.

    Raises:
        StoreError: From every method, if the disk or the database does not play along.
    """

    def __init__(self, folder: Path, alone: bool = False) -> None:
        super().__init__(folder, alone)
        self._counted = time.monotonic()
        with self._plain_errors("open"):
            self._frames = FrameFiles(folder)

    # Runs

    def register(self, start: RunStart, sidecar: dict[str, Any] | None = None) -> bool:
        """Keep a run; one that is known already stays as it is.

        Args:
            start: What the robot says of it.
            sidecar: Settings and versions that it runs under.

        Returns:
            Whether it is new.
        """
        row = (
            start.run,
            folder_name(start.run),
            start.model_dump_json(),
            time.time(),
            json.dumps(sidecar),
            self.at_work(),
        )
        return bool(
            self._write(
                "INSERT INTO runs (run, folder, start, registered, sidecar, heard) "
                "VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (run) DO NOTHING",
                row,
            )
        )

    def add_layer1(self, run: str, said: dict[str, Any]) -> None:
        """Keep what Layer 1 says of a run, in the place of what it said before."""
        self._write(
            "UPDATE runs SET start = json_set(start, '$.layer1', json(?)) WHERE run = ?",
            (json.dumps(said), run),
        )

    def mark_simulated(self, run: str) -> None:
        """A frame of this run is drawn or replayed, whatever its robot said of itself."""
        if not (self.run(run) or {}).get("simulated"):
            self._write(
                "UPDATE runs SET start = json_set(start, '$.simulated', json('true')) "
                "WHERE run = ?",
                (run,),
            )

    def knows(self, run: str) -> bool:
        """Whether the run was registered."""
        return bool(self._read("SELECT 1 FROM runs WHERE run = ?", run))

    def start_of(self, run: str) -> RunStart | None:
        """What its robot said when the run registered; ``None`` if it never did."""
        rows = self._read("SELECT start FROM runs WHERE run = ?", run)
        if not rows:
            return None
        try:
            return RunStart.model_validate_json(rows[0]["start"])
        except ValueError:  # damaged: no start is the same
            return RunStart(run=run)

    def finish(self, run: str, finish: Finish, at: float | None = None) -> None:
        """Keep how a run ended; the last word counts."""
        counts = finish.trajectories, finish.keyframes
        self._end(run, finish.outcome, finish.detail, at, counts)

    def close_silent(self, run: str, detail: str) -> None:
        """Close a run that ended without a word."""
        self._end(run, SILENT, detail)

    def reopen(self, run: str) -> None:
        """A run that was closed as silent speaks again."""
        self._write(
            "UPDATE runs SET finished = NULL, outcome = NULL, detail = NULL "
            "WHERE run = ? AND outcome = ?",
            (run, SILENT),
        )

    def _end(
        self,
        run: str,
        outcome: str,
        detail: str,
        at: float | None = None,
        counts: tuple[int | None, int | None] = (None, None),
    ) -> None:
        self._write(
            "UPDATE runs SET finished = ?, outcome = ?, detail = ?, heard = ?, "
            "trajectories = ?, keyframes = ? WHERE run = ?",
            (time.time() if at is None else at, outcome, detail, self.at_work(), *counts, run),
        )

    def runs(self, search: str = "", most: int = -1, skip: int = 0) -> list[dict[str, Any]]:
        """Runs, newest first, with the number of keyframes.

        Args:
            search: Words that the run's name, protocol, robot or outcome must all hold.
            most: How many; all if negative.
            skip: How many of the newest are left out.
        """
        words = search.lower().split()[:10]
        match = f" AND instr({_SEARCHED}, ?)" * len(words)
        rows = self._read(
            f"{_ROW}, (SELECT count(*) FROM keyframes k WHERE k.run = r.run) AS keyframes "
            f"FROM runs r WHERE 1{match} ORDER BY r.registered DESC, r.rowid DESC "
            "LIMIT ? OFFSET ?",
            *words,
            most,
            skip,
        )
        return [_run_row(row) | {"keyframes": row["keyframes"]} for row in rows]

    def run(self, run: str) -> RunEntry | None:
        """The run's own row, or ``None``."""
        rows = self._read(f"{_ROW} FROM runs r WHERE r.run = ?", run)
        return cast("RunEntry", _run_row(rows[0])) if rows else None

    def unfinished(self) -> list[str]:
        """Runs that have not ended."""
        return [run for (run,) in self._read("SELECT run FROM runs WHERE finished IS NULL")]

    def ages(self) -> dict[str, float]:
        """For how long sidecars were at work on this store since each run ended, or since its
        robot was heard of, s. Wall clocks do not count: they are set, and some begin in 1970."""
        now = self.at_work()
        return {run: now - heard for run, heard in self._read("SELECT run, heard FROM runs")}

    def ages_by_clock(self, now: float) -> dict[str, float]:
        """Likewise by the wall clock, seconds since the epoch; for a person who looks at it."""
        rows = self._read("SELECT run, coalesce(finished, registered) FROM runs")
        return {run: now - at for run, at in rows}

    def at_work(self) -> float:
        """For how long sidecars were at work on this store, s."""
        ((seconds,),) = self._read("SELECT seconds FROM at_work")
        return float(seconds) + time.monotonic() - self._counted

    def count_time(self, heard: Iterable[str]) -> None:
        """Keep for how long that was until now, and that these runs' robots are there still."""
        now = self.at_work()
        self._write("UPDATE at_work SET seconds = ?", (now,))
        self._counted = time.monotonic()
        for run in heard:
            self._write("UPDATE runs SET heard = ? WHERE run = ? AND finished IS NULL", (now, run))

    def size(self, run: str) -> int:
        """What a run's frames take on the disk, bytes."""
        with self._plain_errors("read from"):
            return self._frames.size(run)

    def forget(self, run: str, why: str = "retention") -> None:
        """Remove a run with its frames and all that is known of it. It cannot be brought back;
        the store's own chain keeps that it was removed, and why."""
        with self._transaction("write to"):
            self._chain.remove(run, why)
        with self._plain_errors("remove a run from"):
            self._frames.remove(run)
        with self._transaction("write to"):
            for table in (*OF_A_RUN, "chain", "seals", "runs"):
                self._db.execute(f"DELETE FROM {table} WHERE run = ?", (run,))
            self._chain.forget_touched()

    # Keyframes

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

    def chained(self, run: str) -> tuple[dict[int, str], dict[str, Any] | None]:
        """SHA-256 of frames by number, and the newest hash of the run's chain with its signature;
        nothing of an older run."""
        frames = self._read(
            "SELECT key, digest FROM chain WHERE run = ? AND kind = ? ORDER BY number", run, FRAMES
        )
        seal = self._read(
            "SELECT c.number, c.hash, s.key, s.signature FROM chain c JOIN seals s USING (run) "
            "WHERE run = ? ORDER BY number DESC LIMIT 1",
            run,
        )
        hashes = {int(row["key"]): row["digest"] for row in frames if row["digest"]}
        return hashes, dict(seal[0]) if seal else None

    @contextlib.contextmanager
    def snapshot(self) -> Iterator[sqlite3.Connection]:
        """Read at one moment, whatever is written meanwhile."""
        with self._transaction("read from", "BEGIN"):
            yield self._db

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


_SEARCHED = (
    "lower(r.run || ' ' || CASE WHEN json_valid(r.start) THEN "
    "coalesce(json_extract(r.start, '$.protocol'), '') || ' ' || "
    "coalesce(json_extract(r.start, '$.robot'), '') || ' ' || "
    "coalesce(json_extract(r.start, '$.robot_name'), '') ELSE '' END || ' ' || "
    "coalesce(r.outcome, 'running'))"
)
_ROW = (
    "SELECT r.run, r.start, r.registered, r.finished, r.outcome, r.detail, r.sidecar, "
    "r.trajectories AS begun, r.keyframes AS meant"
)


def _run_row(row: sqlite3.Row) -> dict[str, Any]:
    start: dict[str, Any] | None = readable(row["start"], dict)
    if start is None:
        start = RunStart(
            run=row["run"], protocol="(the record of this run is damaged)"
        ).model_dump()
    start = RunStart(run=row["run"]).model_dump() | start  # an older guard told less
    finished = row["finished"]
    ended = {
        "at": finished, "outcome": row["outcome"], "detail": row["detail"],
        "trajectories": row["begun"], "keyframes": row["meant"],
    }  # fmt: skip
    sidecar: dict[str, Any] | None = readable(row["sidecar"], dict)
    # Older stores say only what the robot was; the frames are the camera's.
    drawn = (sidecar or {}).get("camera") in SIMULATED_KINDS
    return start | {
        "simulated": bool(start.get("simulated")) or drawn,
        "registered": row["registered"],
        "finished": ended if finished else None,
        "run": row["run"],
        "sidecar": sidecar,
    }


def _captured(row: sqlite3.Row) -> Captured | None:
    """``None`` where the row is damaged."""
    try:
        keyframe = from_json(Keyframe, json.loads(row["keyframe"]))
    except (TypeError, ValueError):
        return None
    return Captured(keyframe, row["exposed_after_s"], row["captured"])
