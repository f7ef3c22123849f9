"""What the pipettes' own pressure sensors said of the wells that are drawn from next.

A Flex finds the surface of a liquid with an empty tip, where the protocol has it do so: by
``detect_liquid_presence``, ``require_liquid_presence``, ``measure_liquid_height``, or before each
aspirate with a clean tip (``liquid_presence_detection``). The guard only listens.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ..adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind
from ..vocabulary import WellRef
from .pipette_state import Place

Probe = Callable[[Operation], "bool | None"]
"""Whether a probe that is over found liquid; ``None`` if it did not say."""

_CHANGING = frozenset(
    {
        OperationKind.PICK_UP_TIP,
        OperationKind.DROP_TIP,
        OperationKind.ASPIRATE,
        OperationKind.DISPENSE,
        OperationKind.BLOW_OUT,
    }
)
_SENSORS = {1: ("A1",), 8: ("A1", "H1"), 96: ("A1", "H12")}
"""Nozzles with a pressure sensor, by the number that the pipette has."""
_DECK_TOUCHED = (EventKind.PAUSED, EventKind.LABWARE_MOVING)


def never_asked(_operation: Operation) -> bool | None:
    """Where no sensor can be heard: in a rehearsal, say."""
    return None


def liquid_found(operation: Operation) -> bool | None:
    """Whether a liquid probe that is over found any; ``None`` if it cannot be told.

    A probe that requires liquid and found none is over once a person has dealt with it, and may
    have filled the well.
    """
    try:
        well = operation.arguments["well_core"]
        wells = operation.core()._engine_client.state.wells
        surface = wells.get_well_liquid_info(well.labware_id, well.get_name()).probed_height
    except Exception:  # private to Opentrons; a witness that cannot be heard says nothing
        return None
    if surface is not None and surface.height is not None:
        return True
    return False if operation.method == "detect_liquid_presence" else None


@dataclass(frozen=True)
class _Word:
    """What a probe said: of which wells, and which stood under each nozzle."""

    place: Place
    wells: tuple[WellRef | None, ...]
    found: Mapping[WellRef, bool]


class Probes:
    """The last word of each pipette's sensor, until well or tip may be other ones.

    Several tips over several wells have a sensor at either end, and the probe ends at the first
    that meets liquid: liquid found is in one well or in the other. No liquid found holds for both.
    Of the wells between nothing is known.
    """

    def __init__(self, ask: Probe = never_asked) -> None:
        self._ask = ask
        self._said: dict[str, _Word] = {}

    def before(self, operation: Operation) -> None:
        """A probe begins: whatever comes of it, what the one before it said holds no longer."""
        if operation.probes:
            self._said.pop(operation.pipette.key, None)

    def after(self, operation: Operation, place: Place) -> tuple[bool | None, ...]:
        """Take in what ``operation`` did at ``place``.

        Returns:
            For a draw, what was said of the well under each nozzle; empty where nothing was.
        """
        key, kind = operation.pipette.key, operation.kind
        if operation.probes:
            found = self._ask(operation)
            said = _of_wells(operation, place, found)
            if said:
                self._said[key] = _Word(place, operation.wells, said)
            return ()
        if kind not in _CHANGING or operation.is_air:
            return ()
        draws = kind is OperationKind.ASPIRATE
        for mount, word in list(self._said.items()):
            # Draws that follow each other in the well are one; a mix gives back what it draws.
            holds = (
                word.place == place and (draws or operation.mixing)
                if mount == key
                else not (place is None or word.place is None or place & word.place)
            )
            if not holds:
                del self._said[mount]
        if not draws or key not in self._said:
            return ()
        word = self._said[key]
        return tuple(None if well is None else word.found.get(well) for well in word.wells)

    def event(self, event: Event) -> None:
        """Where a person or the gripper may have touched the deck, nothing holds any longer."""
        if event.kind in _DECK_TOUCHED:
            self.forget()

    def forget(self) -> None:
        """Wells may be other ones than those that were asked about."""
        self._said.clear()


def _of_wells(operation: Operation, place: Place, found: bool | None) -> Mapping[WellRef, bool]:
    """What a probe says of which wells."""
    if found is None or not place:
        return {}
    if len(place) == 1:
        return dict.fromkeys(place, found)
    sensors = _SENSORS.get(operation.pipette.channels, ())
    under = zip(operation.nozzles, operation.wells, strict=False)
    probed = {well for nozzle, well in under if well is not None and nozzle in sensors}
    return dict.fromkeys(probed, found) if not found or len(probed) == 1 else {}
