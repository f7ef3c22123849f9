"""The table of runs: registered, heard of, ended, searched."""

from __future__ import annotations

import json
import sqlite3
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any, cast

from ...run_view.overview import RunEntry
from ...vision.camera import SIMULATED_KINDS
from ..wire import Finish, RunStart
from .database import Database, readable
from .frames import folder_name

SILENT = "silent"
"""Outcome of a run that ended without a word: its robot was switched off, or lost its network."""

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


class Runs(Database):
    """Every method raises StoreError where the disk fails."""

    def __init__(self, folder: Path, alone: bool = False) -> None:
        super().__init__(folder, alone)
        self._counted = time.monotonic()

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
