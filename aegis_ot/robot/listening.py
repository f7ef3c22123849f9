"""From the commands of a run to keyframes, each with the moment that it shows."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from ..adapters.opentrons.instrumentation import Operation
from ..adapters.opentrons.run_state import PAUSED
from ..runtime import Tracker
from ..runtime.steps import Abandon, Capture, Step
from ..vocabulary import Keyframe, KeyframeKind
from .clocks import WatchedClock
from .deck import Deck
from .keyframe_times import moment_before, moment_of_transit
from .operations import OperationReader
from .server_answers import Command

_UNKNOWN = 0.0
"""The moment of a keyframe whose time makes no sense: so long ago that it goes as late."""


@dataclass(frozen=True)
class Timed:
    """A keyframe, and its moment on ``time.monotonic``, s."""

    keyframe: Keyframe
    moment: float


class RunListener:
    """Hears the commands of one run, in order."""

    def __init__(self, deck: Deck, name: str, clock: WatchedClock) -> None:
        reader = self._reader = OperationReader(deck)
        self._tracker = Tracker(name, "off", False, reader.capacity, reader.liquid_found)
        self._clock = clock
        self._operation: Operation | None = None
        self._last: float | None = None
        self._queue: deque[tuple[Keyframe, float | None]] = deque()

    def started(self, command: Command) -> list[Abandon | Timed]:
        """What is known by the beginning of a command."""
        heard: list[Abandon | Timed] = []
        event = self._reader.event(command)
        if event is not None:
            heard += self._perform(self._tracker.event(event), command)
        self._operation = self._reader.operation(command)
        if self._operation is not None:
            heard += self._perform(self._tracker.before(self._operation), command)
        return heard

    def completed(self, command: Command) -> list[Abandon | Timed]:
        """What is known by its end: also when it was that the tip came to its well."""
        transit = moment_of_transit(command)
        if command.completed is not None:
            self._last = command.completed
            if not self._clock.is_plausible(command.completed):
                self._last = transit = _UNKNOWN
        self._queue = deque(
            (keyframe, transit if moment is None else moment) for keyframe, moment in self._queue
        )
        heard: list[Abandon | Timed] = []
        operation, self._operation = self._operation, None
        if operation is not None and self._reader.is_done(operation, command):
            heard += self._perform(self._tracker.after(operation), command)
        return heard + self._due()

    def status(self, status: str) -> list[Abandon | Timed]:
        """The run's status is another one now."""
        if status in PAUSED:
            self._tracker.deck_touched()
        return self._perform(self._tracker.finish(), None) if status == "succeeded" else []

    def break_off(self, reason: str) -> dict[int, str]:
        """Nothing more is heard: the trajectories that nothing will come of, with the reason."""
        left = self._tracker.break_off(reason)
        return {step.trajectory: step.reason for step in left if isinstance(step, Abandon)}

    def _perform(self, steps: list[Step], command: Command | None) -> list[Abandon | Timed]:
        heard: list[Abandon | Timed] = []
        for step in steps:
            if isinstance(step, Abandon):
                heard.append(step)
            elif isinstance(step, Capture):
                self._note(step.keyframe, command)
        return heard + self._due()

    def _note(self, keyframe: Keyframe, command: Command | None) -> None:
        moment: float | None = None
        if keyframe.kind is not KeyframeKind.TRANSIT or command is None:
            moment = moment_before(keyframe.kind, self._last or 0.0)
        self._queue.append((keyframe, moment))

    def _due(self) -> list[Abandon | Timed]:
        due: list[Abandon | Timed] = []
        while self._queue and (moment := self._queue[0][1]) is not None:
            due.append(Timed(self._queue.popleft()[0], self._clock.local(moment)))
        return due
