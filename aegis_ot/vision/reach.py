"""How far a world model reaches: what the wells that made it let be caught before their camera."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from ..vocabulary import counted
from .models import ModelFile

ENOUGH = 20
"""Normal wells from which a model can say that a well looks as one normal in twenty does."""


@dataclass(frozen=True)
class Smallest:
    """What one camera sees of one pipette and liquid.

    Attributes:
        pipette: Short class, ``"p20"``.
        reagent: What the liquid is called; empty if not known.
        volume_ul: Commanded volume, median, µL.
        smallest_ul: Smallest retained volume that is caught nine times in ten, µL; ``None``: not
            even the whole volume is.
        caught: Share caught of each planted share of the volume.
        wells: Normal wells in which columns were planted.
        false_alarms: Normal wells flagged, of a plate of 96.
        px_per_mm: Of the tips in the frames.
        px_per_mm_for_half: What would show half of that volume as long as this one shows.
    """

    pipette: str
    reagent: str
    volume_ul: float
    smallest_ul: float | None
    caught: Mapping[str, float]
    wells: int
    false_alarms: float
    px_per_mm: float
    px_per_mm_for_half: float | None

    def __str__(self) -> str:
        liquid = self.reagent or "liquid of unknown name"
        head = f"{self.pipette}, {liquid}, {self.volume_ul:g} µL: "
        rate = (
            f"{self.false_alarms:.0f} false alarms on a plate of 96; the camera gives "
            f"{self.px_per_mm:.1f} px/mm"
        )
        if self.smallest_ul is None:
            return (
                head + "not even the whole volume left in the tip is caught 9 times in 10 "
                f"({counted(self.wells, 'well')} planted); {rate}."
            )
        return (
            head + f"{self.smallest_ul:.1f} µL left in the tip are caught 9 times in 10 "
            f"({counted(self.wells, 'well')} planted), {rate}; "
            f"for half of that, about {self.px_per_mm_for_half:.1f} px/mm would be needed."
        )

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


def smallest_in(model: ModelFile) -> list[Smallest]:
    """What ``aegis-ot fit`` found when it made this model; empty if it could not tell."""
    told = model.data.get("smallest")
    return [Smallest(**one) for one in (told if isinstance(told, list) else [])]


def recordings_of(model: ModelFile) -> list[dict[str, Any]]:
    """What the model was made from."""
    told = model.data.get("recordings")
    return told if isinstance(told, list) else []


def normals_in(model: ModelFile) -> int:
    """How many normal wells the model was made from."""
    return sum(int(used.get("normals") or 0) for used in recordings_of(model))


def shortcomings(model: ModelFile) -> list[str]:
    """What the recordings that made a model were too few for, a sentence each."""
    if not recordings_of(model):
        return []
    said = []
    normals = normals_in(model)
    if normals < ENOUGH:
        said.append(
            f"Few: {counted(normals, 'normal well')} cannot tell one in twenty from the rest. "
            f"Record {ENOUGH} or more."
        )
    if not smallest_in(model):
        said.append(
            "What it would catch is not known: that takes a scorer that gives p-values (ensemble), "
            "and wells of two runs or plates."
        )
    return said
