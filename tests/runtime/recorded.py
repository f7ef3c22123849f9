"""Runs real protocol functions in Opentrons' simulator and writes down what the tracker says."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from opentrons import simulate

from aegis_ot.adapters.opentrons.instrumentation import Event, EventKind, Operation
from aegis_ot.adapters.opentrons.instrumentation.tap import tapped
from aegis_ot.runtime.steps import Abandon, Capture, Hold, Lift, Step
from aegis_ot.runtime.tracker import Tracker

_LETTERS = {"aspirate": "A", "transit": "T", "dispense": "D", "post_dispense": "P"}


class Recorder:
    """A listener that writes one word per step and per operation.

    ``A0`` is the ASPIRATE keyframe of trajectory 0, ``T0 D0 P0`` the others; ``^B1`` an inserted
    move to the top of B1, ``[0]`` a boundary that waits for trajectory 0, ``x0`` an abandoned
    trajectory; ``aspirate:A1`` and the like are the operations themselves.
    """

    def __init__(self, tracker: Tracker) -> None:
        self.tracker = tracker
        self.words: list[str] = []
        self.steps: list[Step] = []
        self.operations: list[Operation] = []
        self.lift: Callable[[Operation], None] = lambda operation: None

    def before(self, operation: Operation) -> None:
        self.take(self.tracker.before(operation))
        place = operation.well.name if operation.well else "trash" if operation.disposal else "-"
        self.words.append(f"{operation.kind.value}:{place}")
        self.operations.append(operation)

    def after(self, operation: Operation) -> None:
        self.take(self.tracker.after(operation))

    def event(self, event: Event) -> None:
        if event.kind is EventKind.LABWARE_MOVED:
            self.words.append(f"moved:{event.text}")
        self.take(self.tracker.event(event))

    def take(self, steps: list[Step]) -> None:
        for step in steps:
            self.steps.append(step)
            if isinstance(step, Capture):
                letter = _LETTERS[step.keyframe.kind.value]
                self.words.append(f"{letter}{step.keyframe.trajectory}")
            elif isinstance(step, Lift):
                well = step.operation.well
                self.words.append(f"^{well.name if well else '-'}")
                self.lift(step.operation)
            elif isinstance(step, Hold):
                self.words.append("[" + ",".join(map(str, step.trajectories)) + "]")
            elif isinstance(step, Abandon):
                self.words.append(f"x{step.trajectory}")

    @property
    def line(self) -> str:
        """The steps only, operations left out."""
        return " ".join(word for word in self.words if ":" not in word)

    @property
    def keyframes(self) -> list[Any]:
        return [step.keyframe for step in self.steps if isinstance(step, Capture)]


def record(
    protocol: Callable[[Any], None],
    api: str = "2.15",
    robot: str = "OT-2",
    **settings: Any,
) -> Recorder:
    """Run ``protocol(context)`` in the simulator under a tracker."""
    context = simulate.get_protocol_api(api, robot_type=robot)
    recorder = Recorder(Tracker("run", **settings))
    with tapped(context, [recorder], protocol.__code__.co_filename) as tap:
        recorder.lift = tap.lift
        protocol(context)
        recorder.take(recorder.tracker.finish())
    return recorder
