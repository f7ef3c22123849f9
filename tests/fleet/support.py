"""Jobs and agents of the fleet's tests: real agents on a real exchange, a robot that obeys."""

from __future__ import annotations

import asyncio
import functools
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.fleet import FleetConfig, FleetReport, Job, run_fleet
from aegis_ot.fleet.agent import AegisAgent
from aegis_ot.fleet.coordinator import FleetScreen
from aegis_ot.fleet.jobs import JobNeeds
from aegis_ot.fleet.report import FleetEntry
from aegis_ot.fleet.sessions import Watch
from aegis_ot.preflight.check_protocol import check_script

RESULT = {
    "outcome": "succeeded",
    "detail": "",
    "frames": "simulated",
    "counts": {"wells": 1, "pass": 1},
    "flagged": [],
    "robot_run": "a-run",
}
EMPTY = 'metadata = {"apiLevel": "2.15"}\ndef run(protocol):\n    pass\n'
PIPETTES = {"left": "p300_single_gen2"}


@functools.cache
def passed() -> Any:
    """What Layer 1 says of a protocol that does nothing."""
    return check_script(Script(EMPTY, "empty.py"))


def job(name: str, expected_s: float = 1.0, **needs: Any) -> Job:
    return Job(name, Script(EMPTY, name), JobNeeds(**{"robot_type": "OT-2", **needs}), expected_s)


def fleet(*robots: Mapping[str, Any], **values: Any) -> FleetConfig:
    return FleetConfig(robot=robots, **values)  # type: ignore[arg-type]


class Robot:
    """A session whose protocols do what a test says, by name.

    Attributes:
        ran: Names of the protocols that began here.
        at_once: The most that ever ran at a time.
    """

    def __init__(self, does: Callable[[Job, Watch], None] = lambda job, watch: None) -> None:
        self.does = does
        self.ran: list[str] = []
        self.at_once = 0
        self._now = 0
        self._lock = threading.Lock()

    def run(self, job: Job, watch: Watch) -> dict[str, Any]:
        with self._lock:
            self._now += 1
            self.at_once = max(self.at_once, self._now)
            self.ran.append(job.name)
        try:
            watch.ask_leave()
            self.does(job, watch)
            watch.go_on()
        finally:
            with self._lock:
                self._now -= 1
        return dict(RESULT)


class Heard(FleetScreen):
    def __init__(self) -> None:
        self.order: list[str] = []
        self.states: list[tuple[str, str]] = []

    def stands(self, robot: str, status: Mapping[str, Any]) -> None:
        self.states.append((robot, status["state"]))

    def ended(self, entry: FleetEntry) -> None:
        self.order.append(entry.job.name)


def run(
    config: FleetConfig,
    jobs: Sequence[Job],
    sessions: Mapping[str, Any],
    screen: FleetScreen | None = None,
    agents: dict[str, AegisAgent] | None = None,
) -> FleetReport:
    """Run a fleet in this process; ``agents`` is filled with its agents."""

    def make(robot: Any) -> AegisAgent:
        agent = AegisAgent(robot, lambda script: passed(), sessions[robot.name])
        if agents is not None:
            agents[robot.name] = agent
        return agent

    return asyncio.run(asyncio.wait_for(run_fleet(config, jobs, screen, make), 60))
