"""How a run on a robot is shown in the terminal, and steered from there."""

from __future__ import annotations

import signal
from types import FrameType
from typing import Any

from rich.console import Console
from rich.text import Text

from ..robot.running import RobotRun
from ..robot.server_answers import Command
from ..robot.verdicts import WellVerdict
from ..vocabulary import Outcome, counted
from .keys import Keys
from .progress import progress_bar

_WANTED = {"p": "pause", "r": "play", "s": "stop", "t": "retry"}
_STOPPED = "RunStoppedError"
"""What the server says of a command during which the run was stopped: no news."""
_STYLES = {Outcome.FAIL: "bold red", Outcome.UNDECIDED: "yellow"}
HELP = "Keys: p pause, r resume, s stop. Ctrl-C pauses; a second one leaves the run to the App."
RECOVER = (
    "Put it right, then press t to try that step again, or r to go on after it; s stops. Or "
    "recover it in the Opentrons App"
)


class TerminalScreen:
    """A :class:`aegis_ot.robot.running.Screen`; a context manager."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._bar = progress_bar(console)
        self._task = self._bar.add_task("The robot analyses the protocol", total=None)
        self._keys = Keys()
        self._typing: Any = None
        self._interrupted = False
        self._pause_wanted = False
        self._paused = False
        self._before: Any = None

    def __enter__(self) -> TerminalScreen:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()
        if self._typing is not None:
            self._typing.__exit__(None, None, None)
            signal.signal(signal.SIGINT, self._before)

    def analysing(self, seconds: float) -> None:
        """The bar runs by itself."""

    def began(self, commands: int | None) -> None:
        """From here on the run is steered from the keyboard."""
        self._bar.update(self._task, description="Running", total=commands, completed=0)
        self._typing = self._keys.open()
        self._typing.__enter__()
        self._before = signal.signal(signal.SIGINT, self._interrupt)
        if self._keys.there:
            self._print(HELP, "dim")

    def doing(self, command: Command) -> None:
        """Name the command beside the bar."""
        self._bar.update(self._task, description=describe(command))

    def done(self, command: Command) -> None:
        """Count it."""
        self._bar.advance(self._task)
        if command.error and command.error_kind != _STOPPED:
            self._print(f"{command.kind} failed: {command.error}", "red")

    def says(self, text: str) -> None:
        """A line of its own."""
        self._print(text)

    def waits(self, text: str, recovery: bool = False) -> None:
        """The run waits for a person."""
        self._paused = bool(text)
        if text:
            how = "Press r to resume or s to stop" if self._keys.there else "Decide in the App"
            if recovery:
                how = RECOVER if self._keys.there else "Recover it in the Opentrons App"
            self._print(f"Paused: {text} ({how}.)", "bold yellow")

    def judged(self, verdict: WellVerdict) -> None:
        """Only what a person should look at gets a line; the others are counted at the end."""
        if verdict.recovered:
            self._print(f"{_place(verdict)}: put right by the robot", "green")
        elif verdict.is_flagged:
            self._print(tell(verdict), _STYLES[verdict.verdict.outcome])

    def asked(self) -> str:
        """The key pressed, or the pause that Ctrl-C asks for."""
        if self._pause_wanted:
            self._pause_wanted = False
            return "pause"
        return _WANTED.get(self._keys.pressed(), "")

    def _interrupt(self, _number: int, _frame: FrameType | None) -> None:
        """The first one pauses; there is nothing to pause in a run that waits already."""
        if self._interrupted or self._paused:
            raise KeyboardInterrupt
        self._interrupted = self._pause_wanted = True

    def _print(self, text: str, style: str = "") -> None:
        self._console.print(Text(text, style=style), soft_wrap=True)


def describe(command: Command) -> str:
    """A command in a few words: ``"aspirate 50 µL A1"``."""
    params = command.params
    volume = f" {params['volume']:g} µL" if isinstance(params.get("volume"), (int, float)) else ""
    well = f" {params['wellName']}" if params.get("wellName") else ""
    return f"{command.kind}{volume}{well}"[:40]


def tell(verdict: WellVerdict) -> str:
    """One line on a well."""
    found = verdict.verdict
    kind = f" ({found.failure.value.replace('_', ' ')})" if found.failure else ""
    reason = f": {found.reason}" if found.reason else ""
    return f"{_place(verdict)}: {found.outcome.value}{kind}{reason}"


def _place(verdict: WellVerdict) -> str:
    return verdict.well or f"delivery {verdict.verdict.trajectory}"


def show_end(console: Console, run: RobotRun) -> None:
    """The last lines of a run."""
    for error in run.errors:
        console.print(Text(error, style="red"), soft_wrap=True)
    if run.unheard:
        text = f"Verdicts may be missing, and are not counted as passed: {run.unheard}"
        console.print(Text(text, style="yellow"), soft_wrap=True)
    if run.not_as_rehearsed:
        text = "The run was not as rehearsed: Layer 1's pass does not hold for what the robot did."
        console.print(Text(text, style="yellow"), soft_wrap=True)
    words = {"unobserved": "not seen", "recovered": "put right"}
    outcomes = [words.get(known.state, known.state) for known in run.verdicts.values()]
    parts = [f"{run.protocol} on {run.robot}: {run.status}", f"{run.commands} commands"]
    parts.append(f"{run.seconds:.0f} s")
    if run.pauses:
        parts.append(counted(len(run.pauses), "pause"))
    if outcomes:
        each = [f"{outcomes.count(told)} {told}" for told in dict.fromkeys(sorted(outcomes))]
        parts.append(f"{counted(len(outcomes), 'delivery', 'deliveries')}: {', '.join(each)}")
    console.print(Text("; ".join(parts) + "."), soft_wrap=True)
