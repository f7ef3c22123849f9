"""The trace: everything that one rehearsal's tips did to one rehearsal's wells."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field

from ...instrumentation import LabwareInfo
from ...vocabulary import WellRef
from .model import Tip, Transfer, Visit, Well

PlaceKey = tuple[str, int, str]
"""Labware key, generation of the plate, well name."""


@dataclass(frozen=True)
class Imbalance:
    """A well that was filled beyond its capacity, or drawn below what it held.

    Attributes:
        visit: What did it.
        overfilled: Which of the two.
        volume: What it would hold, or what was drawn, µL.
        limit: Its capacity, or what it held, µL.
    """

    visit: Visit
    overfilled: bool
    volume: float
    limit: float


@dataclass
class Trace:
    """Everything that checks may ask about one rehearsal.

    Attributes:
        labware: Facts of each labware, by key.
        wells: Every well that was visited or filled, by place.
        tips: Every tip.
        visits: Every visit, in order.
        transfers: Every transfer from well to well, in order.
        imbalances: Volumes that do not add up.
        shaken: Index, labware keys (``None``: any) of each time a plate was shaken.
        descriptions: What the run says of a liquid, by the liquid's name.
    """

    labware: Mapping[str, LabwareInfo]
    wells: dict[PlaceKey, Well] = field(default_factory=dict)
    tips: list[Tip] = field(default_factory=list)
    visits: list[Visit] = field(default_factory=list)
    transfers: list[Transfer] = field(default_factory=list)
    imbalances: list[Imbalance] = field(default_factory=list)
    shaken: list[tuple[int, frozenset[str] | None]] = field(default_factory=list)
    descriptions: dict[str, str] = field(default_factory=dict)
    groups: dict[WellRef, tuple[WellRef, ...]] = field(default_factory=dict)
    singles: set[WellRef] = field(default_factory=set)
    _served: dict[bool, dict[WellRef, set[WellRef]]] = field(default_factory=dict)

    def served(self, prefilled: bool = False) -> Mapping[WellRef, Set[WellRef]]:
        """For each well the wells that liquid drawn from it came into; asked once all is read.

        Args:
            prefilled: Only of wells that held liquid before the run.
        """
        if prefilled not in self._served:
            found = self._served[prefilled] = {}
            for one in self.transfers:
                if one.source.prefilled or not prefilled:
                    found.setdefault(one.source.ref, set()).add(one.well.ref)
        return self._served[prefilled]

    def mixed_since(self, well: Well, index: int, before: float) -> bool:
        """Whether ``well`` was mixed or shaken after ``index`` and before ``before``."""
        if any(index < last and first < before for first, last, _ in well.mixes):
            return True
        return any(
            index < at < before and (keys is None or well.ref.labware in keys)
            for at, keys in self.shaken
        )
