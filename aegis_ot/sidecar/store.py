"""Keeps runs, keyframes, verdicts, holds and decisions in SQLite, and frames as JPEG files.

A frame is written before its row is, and both before the robot is answered: an acknowledged
keyframe survives a killed process. Nothing is forced onto the disk while a robot waits, so a
power cut may take the last of them; then the store ends earlier, whole, and the robot, which
keeps the keyframes of its run, sends them again.
"""

from __future__ import annotations

import contextlib
import json
import sqlite3
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import StoreError
from ..vocabulary import Keyframe, Verdict, from_json, to_json
from .frames import FrameFiles, folder_name
from .schema import migrate
from .wire import Decision, Finish, Hold, RunStart

DATABASE = "sidecar.sqlite"


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


class Store:
    """One data folder. Safe to use from several threads.

    Args:
        folder: Made if it is missing.

    Raises:
        StoreError: From every method, if the disk or the database does not play along.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        with self._plain_errors("open"):
            self._frames = FrameFiles(folder)
            self._db = sqlite3.connect(
                folder / DATABASE, check_same_thread=False, isolation_level=None, timeout=5.0
            )
            self._db.execute("PRAGMA journal_mode = WAL")
            # With the write-ahead log the database stays whole in a power cut; see above.
            self._db.execute("PRAGMA synchronous = NORMAL")
            self._db.execute("PRAGMA foreign_keys = ON")
            migrate(self._db)

    def close(self) -> None:
        """Close the database. Idempotent."""
        with self._lock, contextlib.suppress(sqlite3.Error):
            self._db.close()

    # Runs

    def register(self, start: RunStart) -> None:
        """Keep a run; one that is known already stays as it is."""
        row = (start.run, folder_name(start.run), start.model_dump_json(), time.time())
        self._write(
            "INSERT INTO runs (run, folder, start, registered) VALUES (?, ?, ?, ?) "
            "ON CONFLICT (run) DO NOTHING",
            row,
        )

    def knows(self, run: str) -> bool:
        """Whether the run was registered."""
        return bool(self._read("SELECT 1 FROM runs WHERE run = ?", run))

    def finish(self, run: str, finish: Finish) -> None:
        """Keep how a run ended; the last word counts."""
        self._write(
            "UPDATE runs SET finished = ?, outcome = ?, detail = ? WHERE run = ?",
            (time.time(), finish.outcome, finish.detail, run),
        )

    def runs(self) -> list[dict[str, Any]]:
        """All runs, newest first, with counts of keyframes and of verdicts by outcome."""
        rows = self._read(
            "SELECT start, registered, finished, outcome, detail, "
            "(SELECT count(*) FROM keyframes k WHERE k.run = r.run) AS keyframes "
            "FROM runs r ORDER BY registered DESC, rowid DESC"
        )
        return [_run_row(row) | {"keyframes": row["keyframes"]} for row in rows]

    def run(self, run: str) -> dict[str, Any] | None:
        """The run's own row, or ``None``."""
        rows = self._read(
            "SELECT start, registered, finished, outcome, detail FROM runs WHERE run = ?", run
        )
        return _run_row(rows[0]) if rows else None

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
        )

    def keyframe(self, run: str, sequence: int) -> Captured | None:
        """What was kept under this number, or ``None``."""
        rows = self._read("SELECT * FROM keyframes WHERE run = ? AND sequence = ?", run, sequence)
        return _captured(rows[0]) if rows else None

    def keyframes(self, run: str) -> list[Captured]:
        """All keyframes of a run in order."""
        rows = self._read("SELECT * FROM keyframes WHERE run = ? ORDER BY sequence", run)
        return [_captured(row) for row in rows]

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

    # Judgement

    def add_verdict(self, verdict: Verdict, evidence: dict[str, Any]) -> None:
        """Keep the analyser's verdict; the first one stays."""
        self._write(
            "INSERT INTO verdicts VALUES (?, ?, ?, ?, ?) ON CONFLICT DO NOTHING",
            (
                verdict.run,
                verdict.trajectory,
                json.dumps(to_json(verdict)),
                json.dumps(evidence),
                time.time(),
            ),
        )

    def verdicts(self, run: str) -> list[tuple[Verdict, dict[str, Any], float]]:
        """The analyser's verdicts in order: verdict, evidence, when (s since the epoch)."""
        rows = self._read("SELECT * FROM verdicts WHERE run = ? ORDER BY trajectory", run)
        return [
            (
                from_json(Verdict, json.loads(row["verdict"])),
                json.loads(row["evidence"]),
                row["judged"],
            )
            for row in rows
        ]

    def abandon(self, run: str, trajectory: int, reason: str) -> None:
        """Keep that a trajectory was given up; the first reason stays."""
        self._write(
            "INSERT INTO abandoned VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING",
            (run, trajectory, reason, time.time()),
        )

    def abandoned(self, run: str) -> dict[int, str]:
        """Reasons by trajectory."""
        rows = self._read("SELECT trajectory, reason FROM abandoned WHERE run = ?", run)
        return {row["trajectory"]: row["reason"] for row in rows}

    def add_hold(self, run: str, hold: Hold) -> None:
        """Keep how long the robot held for a trajectory; the last word counts."""
        self._write(
            "INSERT INTO holds VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (run, trajectory) DO UPDATE "
            "SET seconds = excluded.seconds, resolution = excluded.resolution, "
            "policy = excluded.policy, at = excluded.at",
            (run, hold.trajectory, hold.seconds, hold.resolution, hold.policy, time.time()),
        )

    def holds(self, run: str) -> dict[int, dict[str, Any]]:
        """Holds by trajectory."""
        rows = self._read("SELECT * FROM holds WHERE run = ?", run)
        return {
            row["trajectory"]: {
                "trajectory": row["trajectory"],
                "seconds": row["seconds"],
                "resolution": row["resolution"],
                "policy": row["policy"],
            }
            for row in rows
        }

    def add_decision(self, run: str, trajectory: int, decision: Decision) -> None:
        """Keep the operator's decision; every one is kept, the last one counts."""
        self._write(
            'INSERT INTO decisions (run, trajectory, outcome, "by", note, at) '
            "VALUES (?, ?, ?, ?, ?, ?)",
            (run, trajectory, decision.outcome.value, decision.by, decision.note, time.time()),
        )

    def decisions(self, run: str) -> dict[int, list[dict[str, Any]]]:
        """Decisions by trajectory, oldest first."""
        found: dict[int, list[dict[str, Any]]] = {}
        for row in self._read("SELECT * FROM decisions WHERE run = ? ORDER BY id", run):
            found.setdefault(row["trajectory"], []).append(
                {key: row[key] for key in ("outcome", "by", "note", "at")}
            )
        return found

    # Ground

    def _write(self, statement: str, values: tuple[Any, ...]) -> None:
        with self._lock, self._plain_errors("write to"):
            self._db.execute(statement, values)

    def _read(self, statement: str, *values: Any) -> list[sqlite3.Row]:
        with self._lock, self._plain_errors("read from"):
            cursor = self._db.cursor()
            cursor.row_factory = sqlite3.Row
            return cursor.execute(statement, values).fetchall()

    @contextlib.contextmanager
    def _plain_errors(self, what: str) -> Iterator[None]:
        try:
            yield
        except (OSError, sqlite3.Error) as error:
            raise StoreError(
                f"Cannot {what} the store in {self.folder}: {error}. "
                "Check free space and permissions there."
            ) from error


def _run_row(row: sqlite3.Row) -> dict[str, Any]:
    start: dict[str, Any] = json.loads(row["start"])
    finished = row["finished"]
    ended = {"at": finished, "outcome": row["outcome"], "detail": row["detail"]}
    return start | {"registered": row["registered"], "finished": ended if finished else None}


def _captured(row: sqlite3.Row) -> Captured:
    return Captured(
        keyframe=from_json(Keyframe, json.loads(row["keyframe"])),
        exposed_after_s=row["exposed_after_s"],
        captured=row["captured"],
    )
