"""Which physical plate stands for a labware at a moment, with its wells."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Set

from ...instrumentation import LabwareInfo
from ...vocabulary import WellRef
from .trace import PlaceKey
from .wells import Well, row_column


class Plates:
    """The wells of the plates that stand on the deck now.

    A plate that was taken away or replaced makes room for another one with fresh wells.

    Args:
        labware: Facts of each labware, by key.
        prefilled: Whether a well's role implies that it held liquid before the run.
        known: Every well of the run, by place; new ones are added.
    """

    def __init__(
        self,
        labware: Mapping[str, LabwareInfo],
        prefilled: Callable[[WellRef], bool],
        known: dict[PlaceKey, Well],
    ) -> None:
        self._labware = labware
        self._prefilled = prefilled
        self._known = known
        self._generation: dict[str, int] = {}
        self._current: dict[WellRef, Well] = {}
        self._orders: dict[str, dict[str, tuple[int, int]]] = {}

    def well(self, ref: WellRef) -> Well:
        """The well of this name on the plate that stands there now."""
        well = self._current.get(ref)
        if well is None:
            generation = self._generation.get(ref.labware, 0)
            info = self._labware.get(ref.labware)
            well = Well(
                ref, generation, info.wells.get(ref.name) if info else None, self._order(ref)
            )
            self._current[ref] = well
            self._known[(ref.labware, generation, ref.name)] = well
            if self._prefilled(ref):
                well.fill_before_run(None)
        return well

    def is_used(self, key: str) -> bool:
        """Whether the run has been in a well of the plate that stands there now."""
        return any(ref.labware == key and well.visits for ref, well in self._current.items())

    def replace(self, key: str) -> None:
        """Another plate stands for this labware from now on."""
        self._generation[key] = self._generation.get(key, 0) + 1
        for ref in [ref for ref in self._current if ref.labware == key]:
            del self._current[ref]

    def forget_volumes(self, touched: Set[str] | None, reckon: bool) -> None:
        """Someone may have filled or emptied wells by hand.

        Args:
            touched: Keys of their labware; ``None`` if it may be any.
            reckon: Whether nothing says so.
        """
        for well in self._current.values():
            if touched is not None and well.ref.labware not in touched:
                continue
            if well.visits or well.prefilled:
                well.forget_volume(reckon)

    def _order(self, ref: WellRef) -> tuple[int, int]:
        orders = self._orders.get(ref.labware)
        if orders is None:
            info = self._labware.get(ref.labware)
            names = list(info.wells) if info else []
            orders = self._orders[ref.labware] = {name: row_column(name) for name in names}
        return orders.get(ref.name) or row_column(ref.name)
