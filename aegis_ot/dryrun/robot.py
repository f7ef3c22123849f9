"""What the simulated robot really did in a dry run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..adapters.opentrons.instrumentation import Event, Operation, OperationKind, tapped
from .summary import WellRow


class HeardRobot:
    """Hears, below the guard, what the simulated robot really did.

    Attributes:
        operations: All that were done, in order.
        moves: Told likewise.
    """

    def __init__(self, moves: Callable[[Operation], None]) -> None:
        self.operations: list[Operation] = []
        self.moves = moves

    def under(self, guarded: Callable[[Any], Any], file_name: str) -> Callable[[Any], Any]:
        """The guarded protocol, with this one listening."""

        def run(protocol: Any) -> Any:
            with tapped(protocol, [self], file_name):
                return guarded(protocol)

        return run

    def before(self, operation: Operation) -> None:
        """Only what was done counts."""
        self.moves(operation)

    def after(self, operation: Operation) -> None:
        """It was done."""
        self.operations.append(operation)

    def event(self, event: Event) -> None:
        """Of no interest here."""


def touched_after(operations: Sequence[Operation], wells: Sequence[WellRow]) -> tuple[str, ...]:
    """Wells entered after the last dispense into the first flagged well."""
    flagged = next((row for row in wells if row.flagged), None)
    if flagged is None:
        return ()
    last = max(
        (
            index
            for index, operation in enumerate(operations)
            if operation.kind is OperationKind.DISPENSE
            and operation.well is not None
            and str(operation.well) in flagged.wells
        ),
        default=len(operations),
    )
    return tuple(
        dict.fromkeys(
            str(operation.well)
            for operation in operations[last + 1 :]
            if operation.kind is not OperationKind.MOVE
            and operation.well is not None
            and str(operation.well) not in flagged.wells
        )
    )
