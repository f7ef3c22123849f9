"""Which physical plate stands for a labware at a moment, with its wells."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from ...instrumentation import LabwareInfo, WellInfo
from ...vocabulary import WellRef
from .geometry import Geometry
from .model import Well
from .trace import PlaceKey


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
        self._geometries: dict[tuple[object, ...], Geometry] = {}

    def well(self, ref: WellRef) -> Well:
        """The well of this name on the plate that stands there now."""
        well = self._current.get(ref)
        if well is None:
            generation = self._generation.get(ref.labware, 0)
            well = self._current[ref] = self._make(ref, generation)
            self._known[(ref.labware, generation, ref.name)] = well
            if self._prefilled(ref):
                well.fill_before_run(None)
        return well

    def replace(self, key: str) -> None:
        """Another plate stands for this labware from now on."""
        self._generation[key] = self._generation.get(key, 0) + 1
        for ref in [ref for ref in self._current if ref.labware == key]:
            del self._current[ref]

    def forget_volumes(self) -> None:
        """Someone may have filled or emptied wells by hand."""
        for well in self._current.values():
            if well.visits or well.prefilled:
                well.forget_volume()

    def _make(self, ref: WellRef, generation: int) -> Well:
        labware = self._labware.get(ref.labware)
        info = labware.wells.get(ref.name) if labware else None
        order = row_column(ref.name)
        if info is None:
            return Well(ref, generation, order=order)
        capacity = info.max_volume if info.max_volume > 0 else math.inf
        return Well(ref, generation, capacity, self._geometry(info), order)

    def _geometry(self, info: WellInfo) -> Geometry | None:
        """The wells of a plate share theirs."""
        if info.depth <= 0 or not (info.diameter or (info.x_size and info.y_size)):
            return None
        sizes = (info.depth, info.diameter, info.x_size, info.y_size, info.bottom, info.max_volume)
        key = (*sizes, id(info.sections))
        if key not in self._geometries:
            self._geometries[key] = Geometry(info)
        return self._geometries[key]


def row_column(name: str) -> tuple[int, int]:
    """``"B12"`` -> ``(1, 11)``; names that are not of this form count as the first well."""
    letters = name.rstrip("0123456789")
    digits = name[len(letters) :]
    row = 0
    for letter in letters.upper():
        if not "A" <= letter <= "Z":
            return (0, 0)
        row = row * 26 + ord(letter) - ord("A") + 1
    return (max(row - 1, 0), int(digits) - 1 if digits else 0)
