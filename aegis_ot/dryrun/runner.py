"""Runs a protocol in the simulator with the guard, a real sidecar and a simulated camera."""

from __future__ import annotations

import contextlib
import json
import secrets
import tempfile
import time
import urllib.request
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import SecretStr

from ..adapters.opentrons.instrumentation import Operation
from ..adapters.opentrons.rehearsal import Recording, Script, play
from ..errors import ConfigurationError, RehearsalError
from ..guard import guard
from ..guarding import AHEAD
from ..preflight.check_protocol import check_recording, errors_of, rejection
from ..reports.run_html import report_run
from ..run_view.overview import EndEntry, RunOverview
from ..runtime.descriptions import about_layer1
from ..settings import load_settings
from ..sidecar import Analyser, Judged, RunAnalysis, SidecarConfig, running_sidecar
from ..sidecar.config import CascadeSettings
from ..simulation import SessionParameters, SimulatedCamera
from ..vision.camera import Frame
from ..vocabulary import Keyframe
from ..workbench.engines import EngineMissing, engine_for, need_of
from ..workbench.guard_arguments import guard_arguments
from ..workbench.playing import Planned, PlanRun, PlayGuarded, ending_of
from ..workbench.problems import problem_of
from ..workbench.rehearser import Rehearser, TaskFailed
from .robot import HeardRobot, touched_after
from .summary import DryRun, rows_of, unproven
from .watched_page import PageOperator

_LOOPBACK = urllib.request.build_opener(urllib.request.ProxyHandler({}))


TRUSTING = CascadeSettings(first_wells="trust")
"""First wells are taken for right: for measurements whose truth is known, and for whoever says so.

Else a question that nobody is there to answer leaves its wells undecided."""


@dataclass(frozen=True)
class DryRunSettings:
    """How to run.

    Attributes:
        faults: Planted faults, ``"partial:50@B3"``.
        recover: As for the guard.
        on_fail: ``"continue"``: a pause is reported and the run goes on; ``"stop"``.
        seed: Of the simulated camera.
        rules: ``"on"``, ``"warn"`` or ``"off"``.
        hold: As for the guard.
        timeout_s: Longest rehearsal, s.
        data: Folder of a sidecar to keep the run in; ``None``: it is not kept.
        cascade: What the analyser was made with; the run's report says it.
        rate: Frames per second of a camera that runs freely; ``None``: a frame whenever asked.
        live: Whether a person follows it on the page: the robot takes its time, and stands still
            after a failure until it is answered there.
    """

    faults: tuple[str, ...] = ()
    recover: Mapping[str, str] = field(default_factory=dict)
    on_fail: str = "continue"
    seed: int = 0
    rules: str = "on"
    hold: str = "boundary"
    timeout_s: float = 120.0
    data: Path | None = None
    cascade: CascadeSettings = field(default_factory=CascadeSettings)
    rate: float | None = None
    live: bool = False


class DryRunProgress:
    """Told how far a dry run is. This one says nothing."""

    def checked(self, report: Any) -> None:
        """Layer 1 is done."""

    def begin(self, wells: int) -> None:
        """The run starts; so many wells will be watched."""

    def moves(self, operation: Operation) -> None:
        """The simulated robot is about to do this; it waits until this returns."""

    def judged(self, judged: Judged) -> None:
        """A verdict is in (called from the sidecar's worker)."""

    def serves(self, address: str) -> None:
        """The page of a live dry run is at this address."""

    def ended(self) -> None:
        """A live dry run is over; its page closes when this returns."""


def dry_run(
    script: Script,
    settings: DryRunSettings,
    analyser: Analyser,
    progress: DryRunProgress | None = None,
) -> DryRun:
    """Check, then run, one protocol. Every result of Layer 2 is on simulated frames.

    Raises:
        RehearsalError: The protocol cannot be loaded, or raises by itself.
        ConfigurationError: A fault cannot be planted in this protocol; it needs an engine that is
            not here, or one while it is to be live.
    """
    try:
        engine = engine_for(need_of(script.text))
    except EngineMissing as missing:
        raise ConfigurationError(f"{script.file_name}: {missing}") from None
    if engine.python and settings.live:
        raise ConfigurationError(
            f"{script.file_name} is for opentrons {engine.version}, and the live page follows only "
            "the one that aegis-ot stands beside. Leave --open out: then it is simulated in its "
            "own engine."
        )
    with contextlib.ExitStack() as stack:
        elsewhere = stack.enter_context(Rehearser(engine=engine)) if engine.python else None
        return _dry_run(script, settings, analyser, progress or DryRunProgress(), elsewhere)


def _dry_run(
    script: Script,
    settings: DryRunSettings,
    analyser: Analyser,
    progress: DryRunProgress,
    elsewhere: Rehearser | None,
) -> DryRun:
    with _no_exit(script.file_name):
        planned: Planned = _performed(PlanRun(script, settings.timeout_s), elsewhere)
    said = guard_arguments(script.text).values
    report = None
    if settings.rules != "off":
        guard_settings = load_settings(**{**said, "rules": settings.rules})
        report = check_recording(planned.recording, guard_settings)
        progress.checked(report)
        if errors_of(report) and settings.rules == "on":
            return _rejected(script.file_name, report, planned.recording)
    camera = _RepeatableCamera(
        settings.seed,
        settings.faults,
        _parameters(planned.keyframes, settings.seed),
        rate=settings.rate,
    )
    camera.expect(planned.keyframes)
    nowhere = camera.plan.unmatched(planned.keyframes)
    if nowhere:
        faults = ", ".join(str(fault) for fault in nowhere)
        raise ConfigurationError(
            f"{script.file_name} delivers nothing into the well of this fault: {faults}. Wells are "
            "destinations, as B3 or 2:B3 (slot 2); #12 is the 12th delivery."
        )
    progress.begin(planned.wells)
    begun = time.monotonic()
    layer1 = None if report is None else about_layer1(report)
    known = AHEAD.set({**planned.ahead, "layer1": layer1})
    try:
        outcome, detail, told, overview, frames = _run(
            script, settings, _recovery(said, settings), analyser, camera, progress, elsewhere
        )
    finally:
        AHEAD.reset(known)
    wells = rows_of(overview)
    touched: tuple[str, ...] = ()
    notes = list(unproven(overview, settings.cascade.first_wells == "trust"))
    if outcome == "stopped":
        touched = touched_after(told, wells)
        notes.append(f"Wells touched after the failed dispense: {', '.join(touched) or 'none'}.")
    ended = overview["finished"] or EndEntry(at=time.time(), outcome="", detail="")
    overview["layer1"] = layer1
    overview["finished"] = {**ended, "outcome": outcome, "detail": detail}
    reported = report_run(overview, frames.get, notes)
    seconds = time.monotonic() - begun
    return DryRun(
        script.file_name,
        report,
        reported,
        wells,
        outcome,
        detail,
        touched,
        seconds,
        tuple(notes),
        planned.recording,
    )


def _performed(task: PlanRun | PlayGuarded, elsewhere: Rehearser | None) -> Any:
    """What comes of a task, here or in an engine."""
    if elsewhere is None:
        return task.perform()
    try:
        return elsewhere.perform(task)
    except TaskFailed as failed:
        problem = failed.problem
        where = f"{task.file_name}, line {problem.line}" if problem.line else task.file_name
        raise RehearsalError(f"{where}: {problem.message}", problem.line) from None


@contextlib.contextmanager
def _no_exit(file_name: str) -> Iterator[None]:
    """A protocol that ends the process would end this one, without a word."""
    try:
        yield
    except SystemExit as error:
        problem = problem_of(error, file_name)
        where = f"{file_name}, line {problem.line}" if problem.line else file_name
        raise RehearsalError(f"{where}: {problem.message}", problem.line) from None


def _rejected(file_name: str, report: Any, recording: Recording) -> DryRun:
    """Nothing ran: the report holds what Layer 1 found."""
    detail = rejection(report)
    overview: RunOverview = {
        "run": "dry run",
        "protocol": file_name,
        "simulated": True,
        "finished": {"at": None, "outcome": "rejected", "detail": ""},
        "layer1": about_layer1(report),
        "trajectories": [],
    }
    told = report_run(overview, lambda _: None)
    return DryRun(file_name, report, told, (), "rejected", detail, recording=recording)


def _run(
    script: Script,
    settings: DryRunSettings,
    recovery: Mapping[str, Any],
    analyser: Analyser,
    camera: SimulatedCamera,
    progress: DryRunProgress,
    elsewhere: Rehearser | None,
) -> tuple[str, str, list[Operation], RunOverview, dict[int, bytes]]:
    run = f"dry-run-{settings.seed}"
    # The page of a live one is this machine's own: a browser there opens it without a token.
    token = None if settings.live else secrets.token_urlsafe(16)
    if settings.data is not None:
        run += time.strftime("-%Y%m%d-%H%M%S-") + secrets.token_hex(2)
    on_fail = "abort" if settings.on_fail == "stop" else "continue"
    with contextlib.ExitStack() as stack:
        data = settings.data or Path(
            stack.enter_context(tempfile.TemporaryDirectory(prefix="aegis-ot-"))
        )
        secret = None if token is None else SecretStr(token)
        config = SidecarConfig(port=0, token=secret, data=data, cascade=settings.cascade)
        told = _Telling(analyser, progress.judged)
        with running_sidecar(config, camera, told) as url:
            robot = HeardRobot(progress.moves)
            if settings.live:
                on_fail = "pause"
                person = PageOperator(url, run)
                told.tell, robot.moves = _both(progress.judged, person.judged), person.moves
                progress.serves(url)
            given = {
                "rules": "off",
                "sidecar": url,
                "token": token,
                "run_id": run,
                "watch_simulation": True,
                "hold": settings.hold,
                **recovery,
                "on_fail": on_fail,
                "on_undecided": on_fail,
                "on_link_loss": "abort",
            }

            def wrap(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
                return robot.under(guard(function, **given), script.file_name)

            if elsewhere is not None:
                there = PlayGuarded(script, given, AHEAD.get())
                outcome, detail, operations = _performed(there, elsewhere)
            else:
                with _no_exit(script.file_name):
                    outcome, detail = ending_of(lambda: play(script, wrap))
                operations = robot.operations
            overview: RunOverview = json.loads(_get(f"{url}/v1/runs/{run}", token))
            frames = {
                keyframe["sequence"]: _get(url + keyframe["frame"], token)
                for entry in overview["trajectories"]
                for keyframe in entry["keyframes"]
            }
            if settings.live:
                progress.ended()
    return outcome, detail, operations, overview, frames


def _parameters(keyframes: Sequence[Keyframe], seed: int) -> SessionParameters:
    """The recommended set-up; from the front the tips of a multi-channel hide one another."""
    several = any(1 < keyframe.channels <= 8 for keyframe in keyframes)
    return SessionParameters.beside(seed=seed) if several else SessionParameters.bench(seed)


def _both(first: Callable[[Judged], None], second: Callable[[Judged], None]) -> Any:
    def tell(judged: Judged) -> None:
        first(judged)
        second(judged)

    return tell


def _get(url: str, token: str | None) -> bytes:
    headers = {} if token is None else {"Authorization": f"Bearer {token}"}
    request = urllib.request.Request(url, headers=headers)
    with _LOOPBACK.open(request, timeout=10) as answer:
        return bytes(answer.read())


class _RepeatableCamera(SimulatedCamera):
    """Shows the same frames for the same seed, though a kept run is named after the time."""

    def announce(self, keyframe: Keyframe) -> None:
        super().announce(replace(keyframe, run=f"dry-run-{self.seed}"))


class _Telling:
    """An analyser that tells of each verdict."""

    def __init__(self, inner: Analyser, tell: Callable[[Judged], None]) -> None:
        self._inner = inner
        self.tell = tell

    def begin(self, run: str, history: Sequence[Judged] = ()) -> RunAnalysis:
        """As the inner one."""
        return _TellingRun(self._inner.begin(run, history), self.tell)


class _TellingRun:
    def __init__(self, inner: RunAnalysis, tell: Callable[[Judged], None]) -> None:
        self._inner = inner
        self._tell = tell

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        self._inner.observe(keyframe, frame)

    def judge(self, trajectory: int) -> Judged:
        judged = self._inner.judge(trajectory)
        self._tell(judged)
        return judged

    def confirm(self, trajectory: int) -> None:
        self._inner.confirm(trajectory)


def _recovery(said: Mapping[str, Any], settings: DryRunSettings) -> dict[str, Any]:
    """What the run may put right by itself: as given, else as the protocol's own guard says."""
    names = ("recover", "recover_limit", "recover_run_limit")
    found = {name: said[name] for name in names if name in said}
    return found | ({"recover": settings.recover} if settings.recover else {})
