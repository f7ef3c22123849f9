"""A robot's Layer 2 session: runs one protocol at a time on a simulated or on a real robot."""

from __future__ import annotations

import base64
import contextlib
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from ..adapters.opentrons.instrumentation import Operation, OperationKind
from ..dryrun import DryRunProgress, DryRunSettings, dry_run
from ..errors import LinkError
from ..reports.run_html import ReportedRun, report_run
from ..robot import Command, RobotClient
from ..robot.preparing import Inputs, analyse, refuse_what_is_not_there, take_offsets
from ..robot.run_report import run_report
from ..robot.running import RobotRun, run_analysed
from ..robot.verdicts import VerdictReader, WellVerdict
from ..run_view import SeenWell
from ..sidecar import Judged, make_analyser
from ..sidecar.config import CascadeSettings
from ..vocabulary import Outcome
from .config import RobotConfig
from .jobs import Job

_MOVES_LIQUID = (OperationKind.ASPIRATE, OperationKind.DISPENSE, OperationKind.BLOW_OUT)
_ANALYSIS_TIMEOUT_S = 900.0
_FLAGGED = ("fail", "undecided")
_MOST_PICTURED = 12
"""Flagged wells of a protocol whose close-ups go to the coordinator; about 30 kB each."""


class Watch(Protocol):
    """What a session tells of its run, and asks; called from the session's own threads."""

    def ask_leave(self) -> None:
        """Liquid is about to move for the first time; returns once that is allowed.

        Raises:
            RunAborted: It never was, or the agent is being shut down.
        """

    def go_on(self) -> None:
        """Returns once the robot is not held.

        Raises:
            RunAborted: The agent is being shut down.
        """

    def tell(self, **news: Any) -> None:
        """``wells`` to be watched, ``judged``, ``flagged``, ``text``: as they stand."""

    @property
    def wanted(self) -> str:
        """``"play"``, ``"pause"`` or ``"stop"``, once for each change of mind; else ``""``."""


class Session(Protocol):
    """Runs protocols on one robot."""

    def run(self, job: Job, watch: Watch) -> dict[str, Any]:
        """Run one to its end.

        Returns:
            ``outcome`` (``"succeeded"``, ``"stopped"`` or ``"failed"``), ``detail``, ``frames``
            (``"simulated"`` or ``"real"``), ``counts`` of wells by state, ``flagged`` wells
            (``well``, ``state``, ``failure``, ``reason``, ``line``; ``pictures``: close-ups of the
            tip as base64 JPEG, by keyframe), ``robot_run``.

        Raises:
            AegisError: It could not be run.
        """


def open_session(robot: RobotConfig) -> Session:
    """The session of a robot."""
    if robot.simulated:
        return SimulatedSession(robot.seed)
    return RobotSession(robot, os.environ.get(robot.token_variable))


class SimulatedSession:
    """Opentrons' simulator, a sidecar and a simulated camera, in this process.

    Args:
        seed: Of the camera.
        cascade: How its wells are judged.
    """

    def __init__(self, seed: int = 0, cascade: CascadeSettings | None = None) -> None:
        self._seed = seed
        self._cascade = cascade or CascadeSettings()

    def run(self, job: Job, watch: Watch) -> dict[str, Any]:
        """See :class:`Session`."""
        settings = DryRunSettings(
            faults=job.faults, seed=self._seed, rules="off", cascade=self._cascade
        )
        done = dry_run(
            job.script, settings, make_analyser(settings.cascade), _WatchedProgress(watch)
        )
        account = done.reported.account
        return {
            "outcome": done.outcome,
            "detail": done.detail,
            "frames": "simulated",
            "counts": dict(account["counts"]),
            "flagged": _flagged(done.reported),
            "robot_run": account["run"],
        }


def _flagged(run: ReportedRun) -> list[dict[str, Any]]:
    """Wells to look at, the first ones with what the camera saw."""
    seen = dict(zip(run.account["flagged"], run.flagged, strict=True))
    wells = [well for well in run.account["wells"] if well["state"] in _FLAGGED]
    return [
        _short(well) | {"pictures": _close_ups(seen[well["trajectory"]], number < _MOST_PICTURED)}
        for number, well in enumerate(wells)
    ]


def _close_ups(well: SeenWell, wanted: bool) -> dict[str, str]:
    return {
        kind.value: base64.b64encode(frame.tip.jpeg).decode("ascii")
        for kind, frame in well.frames.items()
        if wanted and frame.tip is not None
    }


def _short(well: Mapping[str, Any]) -> dict[str, Any]:
    return {name: well.get(name) for name in ("well", "state", "failure", "reason", "line")}


class _WatchedProgress(DryRunProgress):
    """A dry run's progress, told to a watch."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self._allowed = False
        self._judged = self._flagged = 0

    def begin(self, wells: int) -> None:
        self._watch.tell(wells=wells)

    def moves(self, operation: Operation) -> None:
        if not self._allowed and operation.kind in _MOVES_LIQUID:
            self._watch.ask_leave()
            self._allowed = True
        self._watch.go_on()

    def judged(self, judged: Judged) -> None:
        self._judged += 1
        self._flagged += judged[0].outcome is not Outcome.PASS
        self._watch.tell(judged=self._judged, flagged=self._flagged)


class RobotSession:
    """A real robot through its HTTP API; Layer 2 is its protocol's guard, read from its sidecar."""

    def __init__(self, robot: RobotConfig, token: str | None = None) -> None:
        assert robot.address is not None
        self._name = robot.name
        self._address = robot.address
        self._offsets = robot.offsets
        self._sidecar, self._token = robot.sidecar, token

    def run(self, job: Job, watch: Watch) -> dict[str, Any]:
        """See :class:`Session`."""
        screen = _Screen(watch)
        with RobotClient(self._address) as client, tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / Path(job.script.file_name).name
            path.write_text(job.script.text, encoding="utf-8")
            inputs = Inputs()
            identifier, analysis = analyse(
                client, path, screen.analysing, _ANALYSIS_TIMEOUT_S, inputs
            )
            run = RobotRun(path.name, self._name, client.url, "", analysis)
            if not analysis.ok:
                run.status, run.errors = "failed", analysis.errors
                return _of_robot(run, None)
            refuse_what_is_not_there(client, analysis)
            screen.says(" ".join(take_offsets(client, analysis, inputs, self._offsets)))
            reader = self._reader(path.name, str(client.health().get("name") or ""))
            watch.ask_leave()
            try:
                run_analysed(client, identifier, run, screen, reader, inputs)
                return _of_robot(run, reader)
            finally:
                if reader is not None:
                    reader.close()

    def _reader(self, protocol: str, robot: str) -> VerdictReader | None:
        if self._sidecar is None:
            return None
        reader = VerdictReader(self._sidecar, self._token, protocol, robot=robot)
        reader.check()
        return reader


def _of_robot(run: RobotRun, reader: VerdictReader | None) -> dict[str, Any]:
    flagged = [_short(one) for one in run_report(run)["verdicts"] if one["state"] in _FLAGGED]
    if run.overview is not None and reader is not None:
        with contextlib.suppress(LinkError):  # then its words are there, its pictures are not
            flagged = _flagged(report_run(run.overview, reader.frame))
    outcomes = [one.state for one in run.verdicts.values()]
    counts = {outcome: outcomes.count(outcome) for outcome in dict.fromkeys(outcomes)}
    return {
        "outcome": run.status if run.status in ("succeeded", "stopped") else "failed",
        "detail": " ".join(run.errors),
        "frames": "real",
        "counts": counts | {"wells": len(outcomes)},
        "flagged": flagged,
        "robot_run": run.id,
    }


class _Screen:
    """A :class:`aegis_ot.robot.running.Screen` that tells a watch."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self._wells: dict[int, bool] = {}

    def analysing(self, seconds: float) -> None:
        """The robot analyses the protocol."""
        self._watch.tell(text="the robot analyses it")

    def began(self, commands: int | None) -> None:
        """The run has started."""
        self._watch.tell(text="")

    def doing(self, command: Command) -> None:
        """Too much to tell of each."""

    def done(self, command: Command) -> None:
        """Likewise."""

    def says(self, text: str) -> None:
        """A comment of the guard, or trouble with the connection."""
        self._watch.tell(text=text)

    def waits(self, text: str, recovery: bool = False) -> None:
        """The run waits for a person."""
        self._watch.tell(text=f"waits for a person: {text}" if text else "")

    def judged(self, verdict: WellVerdict) -> None:
        """A verdict is in."""
        self._wells[verdict.verdict.trajectory] = verdict.is_flagged
        self._watch.tell(judged=len(self._wells), flagged=sum(self._wells.values()))

    def asked(self) -> str:
        """What the fleet wants of the robot."""
        return self._watch.wanted
