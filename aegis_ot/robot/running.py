"""A protocol's way through the robot's server: upload, analysis, start, run, end."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Protocol

from ..adapters.opentrons.run_state import PAUSED
from ..errors import LinkError, RobotError
from ..run_view.overview import is_not_as_rehearsed
from .client import RobotClient
from .following import (
    Completed,
    Found,
    Gone,
    Lost,
    Started,
    StatusChanged,
    follow,
)
from .held_liquid import HeldLiquid
from .preparing import Inputs
from .recovery import RECOVERING, Recovery
from .server_answers import OWN_WORDS, Analysis, Command, RunSnapshot
from .verdicts import VerdictReader, WellVerdict, unjudged

VERDICTS_EVERY_S = 0.5
LAST_VERDICTS_S = 600.0
"""How long the next one of the last verdicts may take, s: a vision model may be asked."""
LOST_SIDECAR_S = 20.0
"""The same from a sidecar that is away, or that was not told of the run's end, s."""
WAIT_SHOWN_S = 2.0
"""A shorter wait is not worth a word, s."""
NO_VERDICT = "No verdict on it came."


class Screen(Protocol):
    """Where a run is shown, and where the person at the terminal says what to do."""

    def analysing(self, seconds: float) -> None:
        """The robot analyses the protocol."""

    def began(self, commands: int | None) -> None:
        """The run has started; its analysis has so many commands (``None``: not known)."""

    def doing(self, command: Command) -> None:
        """A command has begun."""

    def done(self, command: Command) -> None:
        """A command is over."""

    def says(self, text: str) -> None:
        """A comment of the guard, or trouble with the connection."""

    def waits(self, text: str, recovery: bool = False) -> None:
        """The run waits for a person, who has to recover it from a step that failed, or not;
        ``""``: it goes on."""

    def judged(self, verdict: WellVerdict) -> None:
        """A verdict is in."""

    def asked(self) -> str:
        """``"play"``, ``"pause"``, ``"stop"`` or ``"retry"`` (the step that failed) as the person
        wants it now, or ``""``."""


@dataclass
class RobotRun:
    """One run, as it went.

    Attributes:
        protocol: File name.
        robot: The robot's name.
        url: Of its server.
        id: Of the run there.
        analysis: The robot's.
        status: How it ended, or how it stands where the following of it was left.
        seconds: From the start to the end.
        commands: How many were done.
        pauses: What the run waited for, in order.
        verdicts: By trajectory, as they stand.
        errors: What ended it.
        overview: What the sidecar knows of it, or ``None``.
        watched_as: What the sidecar calls it, in watch mode.
        unheard: Why verdicts may be missing; empty if all were heard.
    """

    protocol: str
    robot: str
    url: str
    id: str
    analysis: Analysis
    status: str = "idle"
    seconds: float = 0.0
    commands: int = 0
    pauses: list[str] = field(default_factory=list)
    verdicts: dict[int, WellVerdict] = field(default_factory=dict)
    errors: tuple[str, ...] = ()
    overview: Any = None
    watched_as: str = ""
    unheard: str = ""

    @property
    def not_as_rehearsed(self) -> bool:
        """Whether the robot did otherwise than what Layer 1 judged, as the sidecar was told."""
        return self.overview is not None and is_not_as_rehearsed(self.overview)


def run_analysed(
    robot: RobotClient,
    identifier: str,
    run: RobotRun,
    screen: Screen,
    verdicts: VerdictReader | None = None,
    inputs: Inputs | None = None,
) -> RobotRun:
    """Start an uploaded protocol and follow it to its end.

    Args:
        robot: Where.
        identifier: Of the protocol there.
        run: Filled in as it goes on.
        screen: Shows it, and is asked what the person wants.
        verdicts: Of the run's sidecar.
        inputs: What it was analysed with, and the offsets of its labware.

    Raises:
        RobotError: The robot refuses the start, or is lost for too long. The run then goes on, or
            waits, without this program.
    """
    inputs = inputs or Inputs()
    run.id = robot.create_run(identifier, inputs.values, inputs.uploaded, inputs.offsets)
    driver = RunDriver(robot, run, screen, verdicts)
    if verdicts is not None:
        verdicts.begins()
    robot.act(run.id, "play")
    screen.began(len(run.analysis.kinds))
    began = time.monotonic()
    try:
        for step in follow(robot, run.id, idle=driver.look_around):
            driver.take(step)
        run.seconds = time.monotonic() - began
        driver.await_verdicts()
    finally:
        run.seconds = run.seconds or time.monotonic() - began
        driver.last_words()
    return run


class RunDriver:
    """Shows a run, and does with it what the person at the terminal asks."""

    def __init__(
        self,
        robot: RobotClient,
        run: RobotRun,
        screen: Screen,
        verdicts: VerdictReader | None = None,
    ) -> None:
        self._robot = robot
        self._run = run
        self._screen = screen
        self._verdicts = verdicts
        self._next_look = 0.0
        self._trouble = ""
        self._waiting_for = ""
        self._failed: Command | None = None
        self._held = HeldLiquid()
        self.recovery = Recovery(robot, run.id)
        self.failed_again: Callable[[], None] = lambda: None

    def take(self, step: Any) -> None:
        screen = self._screen
        if isinstance(step, Started):
            self._began(step.command)
        elif isinstance(step, Completed):
            self._run.commands += 1
            screen.done(step.command)
            self._done(step.command)
        elif isinstance(step, StatusChanged):
            self._status(step.run)
        elif isinstance(step, Lost):
            screen.says(
                f"{step.reason} Trying again; if only the network is away, the run goes on."
            )
        elif isinstance(step, Found):
            screen.says(f"The robot answers again, after {step.seconds:.0f} s.")
        elif isinstance(step, Gone):
            self._gone(step.run)

    def look_around(self) -> None:
        """Do what the person asks; see which verdicts are in."""
        wanted = self._screen.asked()
        if wanted:
            try:
                self.recovery.act(wanted)
            except RobotError as error:
                self._screen.says(str(error))
        if time.monotonic() >= self._next_look:
            self._next_look = time.monotonic() + VERDICTS_EVERY_S
            self._read_verdicts()

    def paused_because(self, text: str) -> None:
        """The run was told to pause, and why: its next pause is no stranger's."""
        self._waiting_for = text

    def await_verdicts(self) -> None:
        """The run is over: wait for its last verdicts while the sidecar works on them."""
        if self._verdicts is None:
            return
        began = heard = time.monotonic()
        open_: dict[int, str] = {}
        told = False
        while True:
            self._read_verdicts()
            if self._verdicts.open != open_:
                open_, heard = dict(self._verdicts.open), time.monotonic()
            reached = not self._trouble and self._verdicts.ended
            patience = LAST_VERDICTS_S if reached else LOST_SIDECAR_S
            if not (open_ or self._trouble) or time.monotonic() - heard >= patience:
                break
            if open_ and not told and time.monotonic() - began >= WAIT_SHOWN_S:
                self._screen.says(tell_open(open_.values()))
                told = True
            time.sleep(VERDICTS_EVERY_S)
        self._run.unheard = self._trouble

    def last_words(self) -> None:
        """What the sidecar has to say at the end; without a verdict a delivery is undecided."""
        if self._verdicts is None:
            return
        self._read_verdicts()
        try:
            self._run.overview = self._verdicts.overview()
        except LinkError as error:
            self._screen.says(str(error))
        for number, well in self._verdicts.open.items():
            self._judged(WellVerdict(well, unjudged(self._run.id, number, NO_VERDICT)))

    def _done(self, command: Command) -> None:
        self._held.done(command)
        if command.error:
            self._failed = command
        try:
            again = self.recovery.failed_again(command)
        except RobotError as error:
            self._screen.says(str(error))
        else:
            if again:
                self._screen.waits(f"A step failed ({self.failed_step()}).", True)
                self.failed_again()

    def _gone(self, view: RunSnapshot | None) -> None:
        """The robot's server has lost the run: say what a person finds, and close it."""
        told = (
            "The robot's server was restarted: this run is gone and cannot be resumed. "
            f"{self._held.told(view)}"
        ).rstrip()
        self._run.status, self._run.errors = "failed", (told,)
        self._screen.waits("")
        if self._verdicts is not None:
            try:
                self._verdicts.close_run("failed", told)
            except LinkError as error:
                self._screen.says(str(error))

    def failed_step(self) -> str:
        """The last step that failed, and why: ``"aspirate A1: overpressure"``."""
        if self._failed is None:
            return "The robot waits to be recovered"
        what = " ".join(f"{self._failed.kind} {self._failed.params.get('wellName') or ''}".split())
        return f"{what}: {self._failed.error.rstrip('.')}"

    def _began(self, command: Command) -> None:
        self._held.began(command)
        if command.kind == "waitForResume":
            self._waiting_for = command.message
        elif command.is_guards:
            self._screen.says(command.message[len(OWN_WORDS) :])
        self._screen.doing(command)

    def _status(self, view: RunSnapshot) -> None:
        before, self._run.status = self._run.status, view.status
        self.recovery.status = view.status
        self._run.errors = view.errors
        if view.status in PAUSED:
            words = _DOOR if before in _AT_THE_DOOR else "The run is paused."
            text = self._waiting_for or _PAUSE_WORDS.get(view.status, words)
            if view.status == RECOVERING:
                text = f"A step failed ({self.failed_step()})."
            self._run.pauses.append(text)
            self._screen.waits(text, view.status == RECOVERING)
        elif view.status != "pause-requested":
            self._waiting_for = ""
            self._screen.waits("")

    def _read_verdicts(self) -> None:
        if self._verdicts is None:
            return
        try:
            for verdict in self._verdicts.news():
                self._judged(verdict)
        except LinkError as error:
            if str(error) != self._trouble:
                self._screen.says(f"{error} Verdicts are not shown until it is back.")
            self._trouble = str(error)
        else:
            self._trouble = ""

    def _judged(self, verdict: WellVerdict) -> None:
        known = self._run.verdicts.get(verdict.verdict.trajectory)
        self._run.verdicts[verdict.verdict.trajectory] = verdict
        if known is None or known.state != verdict.state:
            self._screen.judged(verdict)


def tell_open(wells: Iterable[str], most: int = 4) -> str:
    """Which wells' verdicts are waited for."""
    named = list(wells)
    rest = f" and {len(named) - most} more" if len(named) > most else ""
    return f"Waiting for the verdict on {', '.join(named[:most])}{rest}."


_DOOR = "The robot's door was open; the run waits to be resumed."
_AT_THE_DOOR = ("blocked-by-open-door", "awaiting-recovery-blocked-by-open-door")
_PAUSE_WORDS = {
    "blocked-by-open-door": "The robot's door is open.",
    "awaiting-recovery-blocked-by-open-door": "The robot's door is open.",
}
