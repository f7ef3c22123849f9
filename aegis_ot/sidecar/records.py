"""What is judged and decided of a run: verdicts, holds, decisions, actions, incidents, audit."""

from __future__ import annotations

import json
import time
from typing import Any

from ..vocabulary import Outcome, Route, Verdict, from_json, to_json
from .database import Database, readable
from .wire import Action, Decision, Hold, Order, Recovery

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

    def outcomes(self, run: str) -> dict[str, int]:
        """How many deliveries have which outcome, after the operator: ``pass``, ``fail``,
        ``undecided``, ``recovered`` (failed, and put right) or ``unobserved``. Of a run that is
        over those without a verdict are undecided.
        """
        rows = self._read(
            "SELECT CASE WHEN d.outcome IS NULL AND NOT json_valid(v.verdict) THEN 'undecided' "
            "WHEN NOT json_valid(v.verdict) THEN d.outcome "
            "WHEN d.outcome IS NULL AND json_array_length(v.verdict, '$.channels') > 0 "
            "AND NOT EXISTS (SELECT 1 FROM json_each(v.verdict, '$.channels') c "
            "WHERE json_extract(c.value, '$.outcome') <> 'unobserved') THEN 'unobserved' "
            "WHEN coalesce(d.outcome, json_extract(v.verdict, '$.outcome')) = 'fail' "
            f"AND v.trajectory IN ({_PUT_RIGHT}) THEN 'recovered' "
            "ELSE coalesce(d.outcome, json_extract(v.verdict, '$.outcome')) END AS outcome, "
            "count(*) AS n FROM verdicts v LEFT JOIN (SELECT trajectory, outcome, max(id) "
            "FROM decisions WHERE run = ?1 GROUP BY trajectory) d ON d.trajectory = v.trajectory "
            "WHERE v.run = ?1 AND NOT EXISTS (SELECT 1 FROM abandoned a WHERE a.run = v.run "
            "AND a.trajectory = v.trajectory) GROUP BY 1",
            run,
        )
        found = {row["outcome"]: row["n"] for row in rows}
        ((open_,),) = self._read(
            "SELECT count(DISTINCT k.trajectory) FROM keyframes k JOIN runs r USING (run) "
            "WHERE k.run = ?1 AND r.finished IS NOT NULL AND k.trajectory NOT IN "
            "(SELECT trajectory FROM verdicts WHERE run = ?1 UNION "
            "SELECT trajectory FROM abandoned WHERE run = ?1)",
            run,
        )
        return found | ({"undecided": found.get("undecided", 0) + open_} if open_ else {})

    def add_hold(self, run: str, hold: Hold, at: float | None = None) -> None:
        """Keep how long the robot held; the last word on each hold counts."""
        self._write(
            "INSERT OR REPLACE INTO holds (run, number, trajectory, seconds, resolution, policy, "
            "paused_s, answered, at) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
            (
                run,
                hold.number,
                hold.trajectory,
                hold.seconds,
                hold.resolution,
                hold.policy,
                hold.paused_s,
                hold.answered,
                time.time() if at is None else at,
            ),
        )

    def holds(self, run: str) -> list[dict[str, Any]]:
        """Holds, oldest first."""
        names = (
            "number", "trajectory", "seconds", "resolution", "policy", "paused_s", "answered", "at",
        )  # fmt: skip
        rows = self._read("SELECT * FROM holds WHERE run = ? ORDER BY number, trajectory", run)
        return [{name: row[name] for name in names} for row in rows]

    def add_recovery(self, run: str, told: Recovery) -> None:
        """Keep what the robot does by itself about a failed delivery; the last word counts."""
        self._write(
            'INSERT INTO recoveries (run, trajectory, attempt, action, state, "by", text, at) '
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (run, trajectory, attempt) DO UPDATE "
            'SET state = excluded.state, "by" = excluded."by", text = excluded.text',
            (run, told.trajectory, told.attempt, told.action, told.state, told.by, told.text,
             time.time()),
        )  # fmt: skip

    def recoveries(self, run: str) -> list[dict[str, Any]]:
        """Recoveries in the order in which they began."""
        names = ("trajectory", "attempt", "action", "state", "by", "text", "at")
        rows = self._read("SELECT * FROM recoveries WHERE run = ? ORDER BY at", run)
        return [{name: row[name] for name in names} for row in rows]

    def put_right(self, run: str) -> set[int]:
        """Failed deliveries whose well was put right in the end, failed attempts included."""
        return {trajectory for (trajectory,) in self._read(_PUT_RIGHT, run)}

    def add_decision(
        self, run: str, trajectory: int, decision: Decision, at: float | None = None
    ) -> None:
        """Keep the operator's decision; every one is kept, the last one counts."""
        self._write(
            'INSERT INTO decisions (run, trajectory, outcome, "by", note, at) '
            "VALUES (?, ?, ?, ?, ?, ?)",
            (
                run,
                trajectory,
                decision.outcome.value,
                decision.by,
                decision.note,
                time.time() if at is None else at,
            ),
        )

    def decisions(self, run: str) -> dict[int, list[dict[str, Any]]]:
        """Decisions by trajectory, oldest first."""
        found: dict[int, list[dict[str, Any]]] = {}
        for row in self._read("SELECT * FROM decisions WHERE run = ? ORDER BY id", run):
            found.setdefault(row["trajectory"], []).append(
                {key: row[key] for key in ("outcome", "by", "note", "at")}
            )
        return found

    def add_action(
        self, run: str, trajectory: int, action: Action | Order, at: float | None = None
    ) -> None:
        """Keep what a person told the robot to do."""
        self._write(
            'INSERT INTO actions (run, trajectory, action, "by", note, at) '
            "VALUES (?, ?, ?, ?, ?, ?)",
            (
                run,
                trajectory,
                action.action,
                action.by,
                action.note,
                time.time() if at is None else at,
            ),
        )

    def actions(self, run: str) -> list[dict[str, Any]]:
        """Actions, oldest first."""
        names = ("trajectory", "action", "by", "note", "at")
        rows = self._read("SELECT * FROM actions WHERE run = ? ORDER BY id", run)
        return [{name: row[name] for name in names} for row in rows]

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

    def incidents(self, run: str) -> list[dict[str, Any]]:
        """Incidents, oldest first; ``ended`` is ``None`` while the trouble lasts."""
        names = ("kind", "text", "at", "ended")
        rows = self._read("SELECT * FROM incidents WHERE run = ? ORDER BY id", run)
        return [{name: row[name] for name in names} for row in rows]


def _verdict(run: str, trajectory: int, text: Any) -> Verdict:
    """A record that is damaged is no pass."""
    try:
        return from_json(Verdict, json.loads(text))
    except (TypeError, ValueError):
        why = "The record of its verdict is damaged; please look at the frames."
        return Verdict(run, trajectory, Outcome.UNDECIDED, Route.UNCALIBRATED, reason=why)
