"""What came of a fleet's run: one report over all its protocols and robots."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .._version import __version__
from .config import RobotConfig
from .jobs import Job
from .schedule import least_s

FORMAT = "aegis-ot fleet report"
VERSION = 1

LOST, NOT_RUN, BROKEN_OFF = "lost", "not run", "broken off"


@dataclass
class FleetEntry:
    """One protocol's way through the fleet.

    Attributes:
        job: The protocol.
        outcome: ``"succeeded"``, ``"stopped"``, ``"failed"``, ``"rejected"`` by Layer 1,
            ``"lost"`` with its robot's agent after liquid may have moved, ``"not run"`` for want
            of a robot, or ``"broken off"`` with the fleet.
        robot: Which had it last.
        detail: Why it did not succeed.
        began_s, ended_s: Since the fleet's start, s.
        lost_on: Robots whose agents were lost before liquid had moved; it was given on.
        result: What the agent said, see :meth:`~.agent.AegisAgent.process_protocol`.
    """

    job: Job
    outcome: str = NOT_RUN
    robot: str = ""
    detail: str = "No robot was left that has what it needs."
    began_s: float | None = None
    ended_s: float | None = None
    lost_on: list[str] = field(default_factory=list)
    result: Mapping[str, Any] = field(default_factory=dict)

    @property
    def flagged(self) -> Sequence[Mapping[str, Any]]:
        """Wells that failed or are undecided."""
        found: Sequence[Mapping[str, Any]] = self.result.get("flagged", ())
        return found

    @property
    def is_clean(self) -> bool:
        """Whether nobody has to look at it."""
        return self.outcome == "succeeded" and not self.flagged


@dataclass
class FleetReport:
    """A whole run.

    Attributes:
        robots: All of the fleet.
        entries: In the order in which the protocols were given.
        lost: Why a robot dropped out, by its name.
        began: Seconds since the epoch.
        seconds: Wall time, s.
        broken_off: Whether somebody ended it early.
    """

    robots: Sequence[RobotConfig]
    entries: Sequence[FleetEntry]
    lost: dict[str, str] = field(default_factory=dict)
    began: float = field(default_factory=time.time)
    seconds: float = 0.0
    broken_off: bool = False

    def busy_s(self, robot: str) -> float:
        """How long a robot had protocols, s."""
        mine = [e for e in self.entries if e.robot == robot and e.ended_s is not None]
        return sum((e.ended_s or 0.0) - (e.began_s or 0.0) for e in mine)

    def to_json(self, pictures: bool = False) -> dict[str, Any]:
        """Plain values: the JSON report, and, with ``pictures``, what the page shows."""
        took = [e.ended_s - (e.began_s or 0.0) for e in self.entries if e.ended_s is not None]
        return {
            "format": FORMAT,
            "version": VERSION,
            "package": __version__,
            "began": self.began,
            "seconds": round(self.seconds, 2),
            "least_seconds": round(least_s(took, len(self.robots)), 2),
            "broken_off": self.broken_off,
            "robots": [
                {
                    "name": robot.name,
                    "kind": "simulated" if robot.simulated else "real",
                    "robot_type": robot.robot_type,
                    "protocols": [e.job.name for e in self.entries if e.robot == robot.name],
                    "busy_seconds": round(self.busy_s(robot.name), 2),
                    "lost": self.lost.get(robot.name),
                }
                for robot in self.robots
            ],
            "protocols": [_about(entry, pictures) for entry in self.entries],
        }


def _about(entry: FleetEntry, pictures: bool) -> dict[str, Any]:
    result = entry.result
    flagged = [
        {name: value for name, value in well.items() if pictures or name != "pictures"}
        for well in entry.flagged
    ]
    return {
        "name": entry.job.name,
        "outcome": entry.outcome,
        "detail": entry.detail,
        "robot": entry.robot,
        "expected_seconds": round(entry.job.expected_s, 1),
        "began_s": _rounded(entry.began_s),
        "ended_s": _rounded(entry.ended_s),
        "lost_on": entry.lost_on,
        "layer1": result.get("layer1"),
        "frames": result.get("frames"),
        "counts": result.get("counts"),
        "flagged": flagged,
        "robot_run": result.get("robot_run"),
    }


def _rounded(seconds: float | None) -> float | None:
    return None if seconds is None else round(seconds, 2)
