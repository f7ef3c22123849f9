"""Which tip is on which nozzle, and where the others stand."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ...adapters.opentrons.instrumentation import Operation
from ...vocabulary import WellRef
from .model import Tip

Retaking = tuple[Operation, Mapping[WellRef, Operation]]
"""A pick-up from places of a rack that the run has emptied: those, with the pick-up that did."""


class TipBox:
    """Knows every tip of a run by the rack well in which it stands or stood; racks that are
    ``bare`` hold none but those that the run puts there.
    """

    def __init__(self) -> None:
        self.bare: set[str] = set()
        self._returned: dict[WellRef, Tip] = {}
        self._on: dict[tuple[str, str], Tip] = {}
        self._taken: dict[WellRef, Operation] = {}
        self._seen: set[str] = set()
        self.tips: list[Tip] = []
        self.retakings: list[Retaking] = []

    def pick_up(self, step: Operation, racks: Sequence[WellRef | None]) -> None:
        """Put a tip on each nozzle: the returned one if one stands there, else a new one.

        Nozzles beside the rack, or over places whose tips are gone, stay bare: that is how a
        multi-channel pipette is used with one tip.
        """
        pipette, emptied = step.pipette.key, dict[WellRef, Operation]()
        self._seen.add(pipette)
        lead = next((home for home in racks if home is not None), None)
        for nozzle, home in zip(step.nozzles, racks, strict=False):
            tip = self._returned.pop(home, None) if home is not None else None
            if home is not None and home in self._taken:
                emptied[home] = self._taken[home]
            gone = home is None or home in emptied or home.labware in self.bare
            if tip is None and gone and lead is not None and home != lead:
                self._on.pop((pipette, nozzle), None)
                continue
            if home is not None:
                self._taken.setdefault(home, step)
            tip = self._on[(pipette, nozzle)] = tip or self._new()
            tip.session += 1
        if emptied:
            self.retakings.append((step, emptied))

    def drop(self, pipette: str, nozzles: Iterable[str], racks: Iterable[WellRef | None]) -> None:
        """Take the tips off; those put back into a rack keep their history there."""
        for nozzle, home in zip(nozzles, racks, strict=False):
            tip = self._on.pop((pipette, nozzle), None)
            if tip is not None and home is not None:
                self._returned[home] = tip  # with what is in it: tips are parked full, too
                self._taken.pop(home, None)
        self._on = {key: tip for key, tip in self._on.items() if key[0] != pipette}

    def on(self, pipette: str, nozzle: str) -> Tip | None:
        """The tip on a nozzle, ``None`` on a bare one.

        One that nobody saw being picked up counts as new.
        """
        tip = self._on.get((pipette, nozzle))
        if tip is None and pipette not in self._seen:
            tip = self._on[(pipette, nozzle)] = self._new()
        return tip

    def refill_rack(self, labware: str, returned_too: bool = False) -> None:
        """The empty places of a rack hold new tips; returned ones stay what they are, unless
        someone put a fresh rack in its place.
        """
        for home in [home for home in self._returned if home.labware == labware and returned_too]:
            del self._returned[home]
        self.bare.discard(labware)
        for home in [home for home in self._taken if home.labware == labware]:
            del self._taken[home]

    def _new(self) -> Tip:
        tip = Tip(len(self.tips))
        self.tips.append(tip)
        return tip
