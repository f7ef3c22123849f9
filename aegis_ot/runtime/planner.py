"""What a run will have watched, told by its rehearsal."""

from __future__ import annotations

from collections.abc import Iterable

from ..instrumentation import Event, Operation
from ..vocabulary import Keyframe
from .steps import Abandon, Capture, Step
from .tracker import Tracker


class Planner:
    """A listener that collects the keyframes which a run of the same operations will emit.

    Attributes:
        keyframes: In order.
    """

    def __init__(self) -> None:
        self._tracker = Tracker("plan")
        self._abandoned: set[int] = set()
        self.keyframes: list[Keyframe] = []

    @property
    def trajectories(self) -> int:
        """How many wells will be judged."""
        seen = {keyframe.trajectory for keyframe in self.keyframes}
        return len(seen - self._abandoned)

    def before(self, operation: Operation) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        self._take(self._tracker.before(operation))

    def after(self, operation: Operation) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        self._take(self._tracker.after(operation))

    def event(self, event: Event) -> None:
        """Of :class:`aegis_ot.instrumentation.Listener`."""
        self._take(self._tracker.event(event))

    def finish(self) -> None:
        """The run is over: take in what it still owed."""
        self._take(self._tracker.finish())

    def _take(self, steps: Iterable[Step]) -> None:
        for step in steps:
            if isinstance(step, Capture):
                self.keyframes.append(step.keyframe)
            elif isinstance(step, Abandon):
                self._abandoned.add(step.trajectory)
