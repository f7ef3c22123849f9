"""What the pipettes' own pressure sensors said of the wells that are drawn from next.

A Flex finds the surface of a liquid with an empty tip, where the protocol has it do so: by
``detect_liquid_presence``, ``require_liquid_presence``, ``measure_liquid_height``, or before each
aspirate with a clean tip (``liquid_presence_detection``). The guard only listens.
"""

from __future__ import annotations

from collections.abc import Callable

from ..instrumentation import Event, EventKind, Operation, OperationKind
from .hand import Place

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


class Probes:
    """The last word of each pipette's sensor, until well or tip may be other ones.

    Only probes of one well are kept: of several tips over several wells the outer ones have a
    sensor, and the robot does not say which of them met liquid.

    Args:
        ask: What a probe said.
    """

    def __init__(self, ask: Probe = never_asked) -> None:
        self._ask = ask
        self._said: dict[str, tuple[Place, bool]] = {}

    def before(self, operation: Operation) -> None:
        """A probe begins: whatever comes of it, what the one before it said holds no longer."""
        if operation.probes:
            self._said.pop(operation.pipette.key, None)

    def after(self, operation: Operation, place: Place) -> bool | None:
        """Take in what ``operation`` did at ``place``.

        Returns:
            For a draw, what was said of its well; else ``None``.
        """
        key, kind = operation.pipette.key, operation.kind
        if operation.probes:
            found = self._ask(operation)
            if found is not None and place is not None and len(place) == 1:
                self._said[key] = (place, found)
            return None
        if kind not in _CHANGING or operation.is_air:
            return None
        draws = kind is OperationKind.ASPIRATE
        for mount, (well, _) in list(self._said.items()):
            # Draws that follow each other in the well are one; a mix gives back what it draws.
            holds = (
                well == place and (draws or operation.mixing)
                if mount == key
                else not (place is None or well is None or place & well)
            )
            if not holds:
                del self._said[mount]
        return self._said[key][1] if draws and key in self._said else None

    def event(self, event: Event) -> None:
        """Where a person or the gripper may have touched the deck, nothing holds any longer."""
        if event.kind in _DECK_TOUCHED:
            self.forget()

    def forget(self) -> None:
        """Wells may be other ones than those that were asked about."""
        self._said.clear()
