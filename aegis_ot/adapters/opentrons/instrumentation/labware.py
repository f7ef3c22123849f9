"""What the trace has to know of a labware: plain facts from its definition."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple


class WellInfo(NamedTuple):
    """Geometry of one well; each labware has many, and a named tuple is made quickly.

    Attributes:
        max_volume: Capacity, µL.
        depth: From the rim to the bottom, mm.
        x: Centre in the labware's own frame, mm.
        y: Likewise.
        diameter: Of a round well, mm; ``None`` for a rectangular one.
        x_size: Of a rectangular well, mm.
        y_size: Likewise.
        bottom: Shape of the bottom: ``flat``, ``u``, ``v``, or ``""`` if the definition has none.
        sections: Inner geometry from the bottom up, where the definition has one: Opentrons' own
            sections (``{"shape": "conical", "topHeight": ..., ...}``, heights in mm).
    """

    max_volume: float
    depth: float
    x: float = 0.0
    y: float = 0.0
    diameter: float | None = None
    x_size: float | None = None
    y_size: float | None = None
    bottom: str = ""
    sections: tuple[Mapping[str, Any], ...] = ()


@dataclass(frozen=True)
class LabwareInfo:
    """One physical piece of labware on the deck.

    Attributes:
        key: Unique within a run, in the order of loading.
        load_name: Opentrons' name of its definition.
        display_name: The definition's own display name.
        label: What the scientist called it; ``""`` if nothing.
        slot: Where it was loaded; ``""`` off deck.
        is_tip_rack: Whether it holds tips.
        is_trash: Whether it is a trash bin.
        centers_channels: Whether a multi-channel pipette is centred on a well (reservoirs).
        wells: By well name, in the definition's order.
    """

    key: str
    load_name: str
    display_name: str
    label: str
    slot: str
    is_tip_rack: bool
    is_trash: bool
    centers_channels: bool = False
    wells: Mapping[str, WellInfo] = field(default_factory=dict)

    @functools.cached_property
    def middles(self) -> Mapping[tuple[float, float], str]:
        """The wells by the x and y of their middles, mm, to a hundredth; of two the first."""
        wells = reversed([*self.wells.items()])
        return {(round(well.x, 2), round(well.y, 2)): name for name, well in wells}

    @property
    def holds_liquid(self) -> bool:
        """Whether liquid may stand in its wells, other than waste."""
        return bool(self.wells) and not (self.is_tip_rack or self.is_trash)
