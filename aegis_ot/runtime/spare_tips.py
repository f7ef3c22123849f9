"""Which tips a recovery may take: those that the protocol will never ask for.

A tip taken out of turn would let the protocol pick up nothing later, where it names its tips. So
only tips are taken that the rehearsal of the whole run left in their racks, the last ones first.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind


class TipForecast:
    """A listener of the rehearsal: which tips the run will use.

    Attributes:
        complete: Whether the rehearsal reached the end of the run; set by whoever led it.
        used: Slot and name of each tip.
        returning: Mounts of the pipettes that put tips back.
        moving: Slots where a tip rack stands for a part of the run only.
    """

    def __init__(self) -> None:
        self.complete = False
        self.used: set[tuple[str, str]] = set()
        self.returning: set[str] = set()
        self.moving: set[str] = set()
        self._racks: dict[str, str] = {}

    def before(self, operation: Operation) -> None:
        """Only what was done counts."""

    def after(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        if operation.kind is OperationKind.PICK_UP_TIP:
            self.used |= {(well.slot, well.name) for well in operation.wells if well is not None}
        elif operation.kind is OperationKind.DROP_TIP and not operation.disposal:
            self.returning.add(operation.pipette.mount)

    def event(self, event: Event) -> None:
        """Of :class:`.Listener`."""
        info = event.labware_info
        if event.kind is EventKind.LABWARE_LOADED and info is not None and info.is_tip_rack:
            self._racks[event.labware] = info.slot
        elif event.kind is EventKind.LABWARE_MOVED and event.labware in self._racks:
            self.moving |= {self._racks[event.labware], event.text}


def spare_tips(instrument: Any, forecast: TipForecast, slot_of: Callable[[Any], str]) -> list[Any]:
    """Tips of the kind that is on the pipette now, the one to take first in front.

    Args:
        instrument: The ``InstrumentContext``, with a tip on.
        forecast: Of the whole run.
        slot_of: Where a labware stands.

    Returns:
        ``Well`` objects of tip racks; empty if there are none left.
    """
    now = instrument._last_tip_picked_up_from
    if now is None:
        return []
    rack = now.parent
    racks = list(instrument.tip_racks)
    if rack not in racks:
        racks.append(rack)
    first = instrument.starting_tip
    if first is not None and first.parent in racks:
        racks = racks[racks.index(first.parent) :]  # those before it are empty
    found: list[Any] = []
    for other in reversed(racks):
        slot = slot_of(other)
        if other.load_name != rack.load_name or not slot or slot in forecast.moving:
            continue
        tips = other.wells()
        if first is not None and first.parent == other:
            tips = tips[tips.index(first) :]
        found += [
            tip
            for tip in reversed(tips)
            if tip.has_tip and (slot, tip.well_name) not in forecast.used
        ]
    return found
