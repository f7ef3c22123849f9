"""How far a world model reaches: what the wells that made it let be caught before their camera."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

from ..vision.models import ModelFile
from ..vocabulary import counted

ENOUGH = 20
"""Normal wells from which a model can say that a well looks as one normal in twenty does."""

MANY = 10
"""Planted wells from which a rate of nine in ten means something."""


def wilson(hits: int, total: int) -> tuple[float, float]:
    """95 % interval of a proportion (Wilson, 1927): of use where a few of a few are counted."""
    if not total:
        return 0.0, 1.0
    z = 1.959964
    share, spread = hits / total, z * z / total
    middle = share + spread / 2
    half = z * math.sqrt(share * (1 - share) / total + spread / (4 * total))
    return max((middle - half) / (1 + spread), 0.0), min((middle + half) / (1 + spread), 1.0)


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
        flagged, sound: Normal wells that were flagged, and of how many.
        px_per_mm: Of the tips in the frames.
        px_per_mm_for_half: What would show half of that volume as long as this one shows.
    """

    pipette: str
    reagent: str
    volume_ul: float
    smallest_ul: float | None
    caught: Mapping[str, float]
    wells: int
    px_per_mm: float
    px_per_mm_for_half: float | None
    flagged: int = 0
    sound: int = 0

    def __str__(self) -> str:
        liquid = self.reagent or "liquid of unknown name"
        head = f"{self.pipette}, {liquid}, {self.volume_ul:g} µL: "
        camera = f"The camera gives {self.px_per_mm:.1f} px/mm; "
        if self.smallest_ul is None or self.px_per_mm_for_half is None:
            found = "not even the whole volume left in the tip is surely caught, "
            least = self.volume_ul
            camera += f"come closer, to {2 * self.px_per_mm:.1f} px/mm, or dye the liquid."
        else:
            found = f"{self.smallest_ul:.1f} µL left in the tip are caught, "
            least = self.smallest_ul
            half = self.px_per_mm_for_half
            camera += f"for half of that, about {half:.1f} px/mm would be needed."
        return f"{head}{found}{self._rate(least)}; {self._alarms()}. {camera}"

    def _rate(self, volume_ul: float) -> str:
        """How many of the wells in which so much was planted were caught."""
        share = self.caught.get(f"{volume_ul / self.volume_ul:g}", 0.0)
        caught = round(share * self.wells)
        low, high = wilson(caught, self.wells)
        rate = "9 times in 10: " if share >= 0.9 and self.wells >= MANY else ""
        return (
            f"{rate}{caught} of {counted(self.wells, 'planted well')} "
            f"(95 %: {100 * low:.0f} to {100 * high:.0f} %)"
        )

    def _alarms(self) -> str:
        if not self.sound:
            return "no normal well was left to tell false alarms from"
        told = f"{self.flagged} of {counted(self.sound, 'normal well')} flagged"
        if not self.flagged:
            return told
        return f"{told}, which would be {96 * self.flagged / self.sound:.0f} on a plate of 96"

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


def smallest_in(model: ModelFile) -> list[Smallest]:
    """What ``aegis-ot fit`` found when it made this model; empty if it could not tell."""
    told = model.data.get("smallest")
    known = {field.name for field in fields(Smallest)}
    return [
        Smallest(**{name: value for name, value in one.items() if name in known})
        for one in (told if isinstance(told, list) else [])
    ]


def recordings_of(model: ModelFile) -> list[dict[str, Any]]:
    """What the model was made from."""
    told = model.data.get("recordings")
    return told if isinstance(told, list) else []


def normals_in(model: ModelFile) -> int:
    """How many normal wells the model was made from."""
    return sum(int(used.get("normals") or 0) for used in recordings_of(model))


def limits_in(model: ModelFile) -> list[str]:
    """What the lab's own limits did to the wells that made them, a sentence for each liquid."""
    from scipy.stats import beta

    said = []
    for told in model.data.get("limits") or ():
        head = f"{told['tip']}, {told['liquid'] or 'liquid of unknown name'}: limits of your own "
        if not told["used"]:
            said.append(f"{head}would catch no more failures than chance does, and are left out.")
            continue
        flagged, normals = told["flagged"], told["normals"]
        most = beta.ppf(0.975, flagged + 1, normals - flagged) if flagged < normals else 1.0
        said.append(
            f"{head}catch {told['caught']} of {counted(told['failures'], 'planted failure')} "
            f"({told['caught_before']} without them) and flag {flagged} of "
            f"{counted(normals, 'normal well')} ({told['flagged_before']} without), each judged by "
            "limits of the others. So few wells prove no more than that at most "
            f"{100 * float(most):.0f} in 100 normal wells are flagged (95 %)."
        )
    return said


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
    if not smallest_in(model) and not model.data.get("limits"):
        said.append(
            "What it would catch is not known: that takes a scorer that gives p-values (ensemble), "
            "and wells of two runs or plates."
        )
    return said
