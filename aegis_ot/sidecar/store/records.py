"""What is judged and decided of a run: verdicts, holds, decisions, actions, incidents, audit."""

from __future__ import annotations

import json
import sqlite3
import time
from typing import Any, TypeVar, cast

from ...run_view.overview import ActionEntry, DecisionEntry, HoldEntry, IncidentEntry, RecoveryEntry
from ...vocabulary import Outcome, Route, Verdict, from_json, to_json
from ..wire import Action, Body, Decision, HoldReport, OrderRequest, RecoveryReport
from .database import Database, readable

T = TypeVar("T")

OF_A_RUN = (
    "audits", "recoveries", "incidents", "actions", "decisions", "holds", "abandoned", "verdicts",
    "keyframes",
)  # fmt: skip
"""Tables whose rows go with their run."""

_PUT_RIGHT = (
    "SELECT trajectory FROM recoveries WHERE run = ?1 AND state = 'recovered' "
    'UNION SELECT f."by" FROM recoveries f JOIN recoveries r USING (run, trajectory) '
    "WHERE run = ?1 AND f.state = 'failed' AND r.state = 'recovered' AND f.\"by\" IS NOT NULL"
)


class Records(Database):
    """The tables that belong to a run. Every method raises StoreError where the disk fails."""

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

    def withdraw_verdict(self, verdict: Verdict) -> None:
        """Keep this verdict in place of the one that was given before."""
        self._write(
            "UPDATE verdicts SET verdict = ? WHERE run = ? AND trajectory = ?",
            (json.dumps(to_json(verdict)), verdict.run, verdict.trajectory),
        )

    def verdicts(self, run: str) -> list[tuple[Verdict, dict[str, Any], float]]:
        """The analyser's verdicts in order: verdict, evidence, when (s since the epoch)."""
        rows = self._read("SELECT * FROM verdicts WHERE run = ? ORDER BY trajectory", run)
        return [
            (
                _verdict(run, row["trajectory"], row["verdict"]),
                readable(row["evidence"], dict) or {},
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

    def judged_wells(self, run: str) -> list[dict[str, Any]]:
        """Per delivery with a verdict its last keyframe's ``sequence``, ``tip``, ``pipette``,
        ``reagent``, ``commanded_ul``, ``expected_ul``; ``outcome`` after the operator, ``left_ul``,
        ``boxes`` (JSON), and ``hold_s``: for how long the robot waited for the verdict."""
        rows = self._read(
            "SELECT k.sequence, json_extract(k.keyframe, '$.tip') AS tip, "
            "json_extract(k.keyframe, '$.pipette') AS pipette, "
            "json_extract(k.keyframe, '$.reagent') AS reagent, "
            "json_extract(k.keyframe, '$.commanded_ul') AS commanded_ul, "
            "json_extract(k.keyframe, '$.expected_ul') AS expected_ul, "
            "coalesce((SELECT outcome FROM decisions d WHERE d.run = v.run "
            "AND d.trajectory = v.trajectory ORDER BY id DESC LIMIT 1), "
            "json_extract(v.verdict, '$.outcome')) AS outcome, "
            "json_extract(v.verdict, '$.left_ul') AS left_ul, "
            "CASE WHEN json_valid(v.evidence) THEN json_extract(v.evidence, '$.boxes') END "
            "AS boxes, (SELECT coalesce(sum(seconds), 0) FROM holds h WHERE h.run = v.run "
            "AND h.trajectory = v.trajectory AND h.resolution = 'verdict') AS hold_s "
            "FROM verdicts v JOIN keyframes k ON k.run = v.run AND k.sequence = "
            "(SELECT max(sequence) FROM keyframes m WHERE m.run = v.run "
            "AND m.trajectory = v.trajectory) WHERE v.run = ? AND json_valid(v.verdict) "
            "AND json_valid(k.keyframe) ORDER BY v.trajectory",
            run,
        )
        return [dict(row) for row in rows]

    def add_hold(self, run: str, hold: HoldReport, at: float | None = None) -> None:
        """Keep how long the robot held; the last word on each hold counts."""
        self._insert("INSERT OR REPLACE INTO holds", run, hold, at)

    def holds(self, run: str) -> list[HoldEntry]:
        """Holds, oldest first."""
        rows = self._read("SELECT * FROM holds WHERE run = ? ORDER BY number, trajectory", run)
        return [_entry(HoldEntry, row) for row in rows]

    def add_recovery(self, run: str, told: RecoveryReport, at: float) -> None:
        """Keep what the robot does by itself about a failed delivery; the last word counts."""
        again = (
            "ON CONFLICT (run, trajectory, attempt) DO UPDATE "
            'SET state = excluded.state, "by" = excluded."by", text = excluded.text'
        )
        self._insert("INSERT INTO recoveries", run, told, at, again=again)

    def recoveries(self, run: str) -> list[RecoveryEntry]:
        """Recoveries in the order in which they began."""
        rows = self._read("SELECT * FROM recoveries WHERE run = ? ORDER BY at", run)
        return [_entry(RecoveryEntry, row) for row in rows]

    def put_right(self, run: str) -> set[int]:
        """Failed deliveries whose well was put right in the end, failed attempts included."""
        return {trajectory for (trajectory,) in self._read(_PUT_RIGHT, run)}

    def add_decision(
        self, run: str, trajectory: int, decision: Decision, at: float | None = None
    ) -> None:
        """Keep the operator's decision; every one is kept, the last one counts."""
        self._insert("INSERT INTO decisions", run, decision, at, trajectory)

    def decisions(self, run: str) -> dict[int, list[DecisionEntry]]:
        """Decisions by trajectory, oldest first."""
        found: dict[int, list[DecisionEntry]] = {}
        for row in self._read("SELECT * FROM decisions WHERE run = ? ORDER BY id", run):
            found.setdefault(row["trajectory"], []).append(_entry(DecisionEntry, row))
        return found

    def add_action(
        self, run: str, trajectory: int, action: Action | OrderRequest, at: float | None = None
    ) -> None:
        """Keep what a person told the robot to do."""
        self._insert("INSERT INTO actions", run, action, at, trajectory)

    def actions(self, run: str) -> list[ActionEntry]:
        """Actions, oldest first."""
        rows = self._read("SELECT * FROM actions WHERE run = ? ORDER BY id", run)
        return [_entry(ActionEntry, row) for row in rows]

    def _insert(
        self,
        into: str,
        run: str,
        told: Body,
        at: float | None,
        trajectory: int | None = None,
        again: str = "",
    ) -> None:
        """A row of what was told: its columns bear the names of the body's members."""
        row = {"run": run, "at": time.time() if at is None else at} | told.model_dump(mode="json")
        if trajectory is not None:
            row["trajectory"] = trajectory
        names = ", ".join(f'"{name}"' for name in row)
        values = ", ".join("?" * len(row))
        self._write(f"{into} ({names}) VALUES ({values}) {again}", tuple(row.values()))

    def add_audit(self, run: str, audit: dict[str, Any]) -> None:
        """Keep what the look back at a run found; the last one counts."""
        self._write(
            "INSERT INTO audits VALUES (?, ?, ?) ON CONFLICT (run) DO UPDATE "
            "SET audit = excluded.audit, at = excluded.at",
            (run, json.dumps(audit), time.time()),
        )

    def audit(self, run: str) -> dict[str, Any] | None:
        """What the look back at a run found; ``None`` before there was one."""
        rows = self._read("SELECT audit FROM audits WHERE run = ?", run)
        return readable(rows[0]["audit"], dict) if rows else None

    def begin_incident(self, run: str, kind: str, text: str) -> bool:
        """Keep that trouble began; whether it is new, and not the one that goes on."""
        return bool(
            self._write(
                "INSERT INTO incidents (run, kind, text, at) SELECT ?, ?, ?, ? WHERE NOT EXISTS "
                "(SELECT 1 FROM incidents WHERE run = ? AND kind = ? AND ended IS NULL)",
                (run, kind, text, time.time(), run, kind),
            )
        )

    def add_incident(self, run: str, kind: str, text: str, at: float, ended: float) -> None:
        """Keep trouble that is over."""
        self._write(
            "INSERT INTO incidents (run, kind, text, at, ended) VALUES (?, ?, ?, ?, ?)",
            (run, kind, text, at, ended),
        )

    def end_incidents(self, run: str, kind: str) -> bool:
        """Keep that trouble is over; whether there was any."""
        return bool(
            self._write(
                "UPDATE incidents SET ended = ? WHERE run = ? AND kind = ? AND ended IS NULL",
                (time.time(), run, kind),
            )
        )

    def incidents(self, run: str) -> list[IncidentEntry]:
        """Incidents, oldest first; ``ended`` is ``None`` while the trouble lasts."""
        rows = self._read("SELECT * FROM incidents WHERE run = ? ORDER BY id", run)
        return [_entry(IncidentEntry, row) for row in rows]


def _entry(shape: type[T], row: sqlite3.Row) -> T:
    """The columns that the shape names."""
    return cast("T", {name: row[name] for name in shape.__annotations__})


def _verdict(run: str, trajectory: int, text: Any) -> Verdict:
    """A record that is damaged is no pass."""
    try:
        return from_json(Verdict, json.loads(text))
    except (TypeError, ValueError):
        why = "The record of its verdict is damaged; please look at the frames."
        return Verdict(run, trajectory, Outcome.UNDECIDED, Route.UNCALIBRATED, reason=why)
