"""Wells as a trace sees them: what they hold, how much, how high it stands."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from ...instrumentation import WellInfo
from ...vocabulary import WellRef

if TYPE_CHECKING:
    from .visits import Visit

Composition = Mapping["Well", float]
"""Shares of a liquid by the well each part stood in before the run; they sum to 1."""

CLEARANCE_MM = 2.0
"""A tip end at least this far above the liquid does not touch it (``spec/rules.md``)."""

EMPTY_UL = 1e-6


class Well:
    """One well of one physical plate, followed through a run.

    Attributes:
        ref: Labware and name.
        generation: Counts the plates that stood for this labware (replaced in a pause).
        capacity: µL; ``inf`` if unknown.
        volume: What it holds at least, µL.
        known: Whether ``volume`` is exact.
        declared: Volume declared for it before the run, µL.
        contents: µL by the well in which that liquid stood before the run (itself included).
        liquids: Names of liquids loaded into it.
        visits: Everything tips did here, in order.
        mixes: ``(first index, last index, line)`` of each time it was mixed.
        prefilled: Whether it held liquid before the run.
        fed: Whether the run has put liquid into it.
        most: What it holds at most while that is unknown, µL: a full well less what was taken.
        unsure: µL of ``volume`` that may not be there: drawn from a well beyond what it held.
        reckoned: Volume at the time when someone may have changed it by hand, followed since, µL.
    """

    __slots__ = (
        "capacity",
        "contents",
        "declared",
        "depth",
        "fed",
        "generation",
        "known",
        "last",
        "liquids",
        "mixes",
        "most",
        "order",
        "prefilled",
        "pure",
        "reckoned",
        "ref",
        "slope",
        "unsure",
        "visits",
        "volume",
    )

    def __init__(
        self, ref: WellRef, generation: int, info: WellInfo | None, order: tuple[int, int]
    ) -> None:
        self.ref = ref
        self.generation = generation
        self.order = order
        self.capacity = info.max_volume if info and info.max_volume > 0 else math.inf
        self.depth = info.depth if info else 0.0
        self.slope = _mm_per_ul(info) if info else None
        self.volume = 0.0
        self.known = True
        self.prefilled = False
        self.fed = False
        self.most = self.capacity
        self.unsure = 0.0
        self.reckoned: float | None = None
        self.declared: float | None = None
        self.contents: dict[Well, float] = {}
        self.liquids: list[str] = []
        self.visits: list[Visit] = []
        self.mixes: list[tuple[int, int, int | None]] = []
        self.pure: Composition = {self: 1.0}
        self.last: Composition = self.pure

    def __repr__(self) -> str:
        return f"<{self.ref.address}{'*' * self.generation}>"

    @property
    def empty(self) -> bool:
        """Whether it surely holds nothing now."""
        return self.known and self.volume <= EMPTY_UL

    @property
    def least(self) -> float:
        """µL that it surely holds."""
        return self.volume - self.unsure

    def fill_before_run(self, volume: float | None) -> None:
        """It held liquid of its own before the run, of a declared or an unknown volume."""
        if volume is not None and volume <= 0:
            return
        self.prefilled = True
        if volume is None:
            self.known = False
            self.contents[self] = self.contents.get(self, 0.0) + self._guess()
        else:
            self.declared = (self.declared or 0.0) + volume
            self.volume += volume
            self.contents[self] = self.contents.get(self, 0.0) + volume

    def forget_volume(self, reckon: bool = False) -> None:
        """Someone may have filled or emptied it by hand.

        Args:
            reckon: Whether nothing says so: then what it held still tells how high it stood.
        """
        if not reckon:
            self.reckoned = None
        elif self.known:
            self.reckoned = self.volume
        self.known = False
        self.most = self.capacity
        self.volume = self.unsure = 0.0

    def liquid(self) -> Composition:
        """What a tip would draw now."""
        contents = self.contents
        if len(contents) == 1:
            only = next(iter(contents))
            return only.pure
        total = sum(contents.values())
        if total <= 0:
            return self.last
        return {origin: volume / total for origin, volume in contents.items()}

    def draw(self, volume: float) -> float:
        """Take liquid out; returns how much of it the well did not hold (0 if unknown)."""
        self.most = max(self.most - volume, 0.0)
        missing = volume - self.volume if self.known and volume > self.volume else 0.0
        least = max(self.least - volume, 0.0)
        self.volume = self.volume - volume if self.volume > volume else 0.0
        self.unsure = self.volume - least
        if self.reckoned is not None:
            self.reckoned = max(self.reckoned - volume, 0.0)
        if self.known and self.volume <= EMPTY_UL:
            self.volume = 0.0
            self.last = self.liquid()
            self.contents.clear()
        elif len(self.contents) > 1 or self.known:
            total = sum(self.contents.values())
            left = max(total - volume, total * 0.01)
            if total > 0:
                factor = left / total
                for origin in self.contents:
                    self.contents[origin] *= factor
        return missing

    def add(self, volume: float, liquid: Composition, unsure: float = 0.0) -> None:
        """Put liquid in; ``unsure`` µL of it may be air."""
        self.volume += volume
        self.most = min(self.most + volume, self.capacity)
        self.unsure += unsure
        if self.reckoned is not None:
            self.reckoned += volume
        self.fed = self.fed or volume > 0
        contents = self.contents
        for origin, share in liquid.items():
            contents[origin] = contents.get(origin, 0.0) + volume * share

    def clear_of_liquid(
        self, from_bottom: float | None, from_liquid: float | None = None, at_least: bool = False
    ) -> bool:
        """Whether a tip end at this height (mm) is known not to touch the liquid.

        Unknown volume is not clear; but a well that was emptied in part stands no higher than a
        full one less what was taken.

        Args:
            from_bottom: Height of the tip's end over the well's bottom, mm.
            from_liquid: The same over the liquid, mm.
            at_least: Ask for the liquid that is surely there, instead of all that there may be.
        """
        if from_liquid is not None:
            return from_liquid >= CLEARANCE_MM
        if from_bottom is None or self.slope is None:
            return False
        volume = self.volume if self.known else self.reckoned
        if at_least:
            volume = self.least
        elif volume is None:
            volume = self.most
        level = min(volume * self.slope, self.depth)
        return from_bottom >= level + CLEARANCE_MM

    def _guess(self) -> float:
        """A volume to reckon shares with where none is known; no rule compares it."""
        return self.capacity / 2 if math.isfinite(self.capacity) else 1000.0


def _mm_per_ul(info: WellInfo) -> float | None:
    """Height of 1 µL in the well, mm.

    Wells taper, so the area that the capacity fills over the whole depth is used where it is
    smaller than the mouth's: the level is then rather over- than underestimated.
    """
    areas = []
    if info.diameter:
        areas.append(math.pi * info.diameter**2 / 4)
    elif info.x_size and info.y_size:
        areas.append(info.x_size * info.y_size)
    if info.max_volume > 0 and info.depth > 0:
        areas.append(info.max_volume / info.depth)
    return 1 / min(areas) if areas else None


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
