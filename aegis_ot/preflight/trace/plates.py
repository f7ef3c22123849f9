"""Which physical plate stands for a labware at a moment, with its wells."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Collection, Mapping

from ...adapters.opentrons.instrumentation import LabwareInfo, WellInfo
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
        runs_through: Labware that holds nothing, by key.
        supposed: Wells whose role is no more than a variable's name.
    """

    def __init__(
        self,
        labware: Mapping[str, LabwareInfo],
        prefilled: Callable[[WellRef], bool],
        known: dict[PlaceKey, Well],
        runs_through: Collection[str] = (),
        supposed: Collection[WellRef] = (),
    ) -> None:
        self._runs_through = runs_through
        self._supposed = supposed
        self._labware = labware
        self._prefilled = prefilled
        self._known = known
        self._generation: Counter[str] = Counter()
        self._geometries: dict[tuple[object, ...], Geometry] = {}

    def well(self, ref: WellRef) -> Well:
        """The well of this name on the plate that stands there now."""
        key = (ref.labware, self._generation.get(ref.labware, 0), ref.name)
        well = self._known.get(key)
        if well is None:
            labware = self._labware.get(ref.labware)
            info = labware.wells.get(ref.name) if labware else None
            capacity = info.max_volume if info and info.max_volume > 0 else math.inf
            geometry = self._geometry(info) if info else None
            if geometry and 100 * capacity < geometry.brim:  # written in mL: 22 for a trough
                capacity = geometry.brim
            well = self._known[key] = Well(ref, key[1], capacity, geometry)
            well.runs_through = ref.labware in self._runs_through
            if self._prefilled(ref) and not well.runs_through:
                well.fill_before_run(None)
                well.supposed = ref in self._supposed
        return well

    def replace(self, key: str) -> None:
        """Another plate stands for this labware from now on."""
        self._generation[key] += 1

    def forget_volumes(self, labware: str = "") -> None:
        """Someone may have filled or emptied wells by hand: of one labware, or of all."""
        for well in self._known.values():
            if labware not in ("", well.ref.labware):
                continue
            stands = well.generation == self._generation[well.ref.labware]
            if stands and (well.visits or well.prefilled):
                well.known = False
                well.most, well.full = well.capacity, well.brim
                well.unsure = well.volume

    def _geometry(self, info: WellInfo) -> Geometry | None:
        """The wells of a plate share theirs."""
        if info.depth <= 0 or not (info.diameter or (info.x_size and info.y_size)):
            return None
        sizes = (info.depth, info.diameter, info.x_size, info.y_size, info.bottom, info.max_volume)
        key = (*sizes, id(info.sections))
        if key not in self._geometries:
            self._geometries[key] = Geometry(info)
        return self._geometries[key]
