"""Deliveries that are done and not judged, and what may not happen before they are."""

from __future__ import annotations

from collections.abc import Iterable

from ..adapters.opentrons.instrumentation import Operation, OperationKind
from .pipette_state import PipetteState
from .steps import Trajectory

EXPELLING = (OperationKind.DISPENSE, OperationKind.BLOW_OUT)


class Awaiting:
    """Trajectories with all four keyframes whose verdict is not in, by mount."""

    def __init__(self) -> None:
        self._of: dict[str, list[Trajectory]] = {}

    def add(self, hand: PipetteState, trajectory: Trajectory) -> None:
        """The last keyframe of a delivery of this pipette was taken."""
        self._of.setdefault(hand.pipette.key, []).append(trajectory)

    def all(self) -> list[Trajectory]:
        """Every one of them."""
        return [trajectory for awaiting in self._of.values() for trajectory in awaiting]

    def on(self, labware: str) -> list[Trajectory]:
        """Those that were delivered into this labware."""
        return [trajectory for trajectory in self.all() if is_on(trajectory, labware)]

    def due_at(self, hand: PipetteState, operation: Operation) -> list[Trajectory]:
        """Those whose failure ``operation`` would spread or hide."""
        ends_tip = operation.kind is OperationKind.DROP_TIP
        expels = operation.disposal and operation.kind in EXPELLING
        place = hand.target(operation)
        enters = hand.enters(operation)
        due = [
            trajectory
            for trajectory in self._of.get(hand.pipette.key, ())
            if ends_tip or expels or (enters and place != frozenset(trajectory.destinations))
        ]
        if enters and place:
            for key, others in self._of.items():
                if key != hand.pipette.key:
                    due += [t for t in others if place & frozenset(t.destinations)]
        return due

    def take(self, due: Iterable[Trajectory]) -> tuple[int, ...]:
        """Wait for these no longer; their numbers, rising."""
        numbers = {trajectory.number for trajectory in due}
        for key, awaiting in self._of.items():
            self._of[key] = [t for t in awaiting if t.number not in numbers]
        return tuple(sorted(numbers))


def is_on(trajectory: Trajectory, labware: str) -> bool:
    """Whether it goes into this labware."""
    return any(well.labware == labware for well in trajectory.destinations)


def describe(operation: Operation) -> str:
    """What an operation that has to wait is about to do, in plain words."""
    if operation.kind is OperationKind.DROP_TIP:
        return "the tip is dropped"
    if operation.disposal:
        return "the tip is emptied into the trash"
    return f"the tip enters {operation.well}" if operation.well else "the tip goes on"
