"""Planted faults: as a user writes them, and what each makes of a draw and of a delivery.

A fault is written ``KIND@WELL``, as the command line takes it::

    partial:50@B3        half of the volume is dispensed into B3
    no_aspirate@C4       nothing is drawn for C4
    no_dispense@#12      nothing is dispensed in the run's 12th trajectory
    air_bubble@D1        air in the column drawn for D1 (8 % of the volume; air_bubble:15@D1)
    overdraw:25@D2       a quarter more is drawn for D2 than told, and stays in the tip
    no_tip@E1            no tip on the nozzle while E1 is served
    partial:50@2:B3      only in the labware in slot 2
    no_aspirate@C4x1     only the first time that C4 is served; x2: the first two times
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from ..errors import ConfigurationError
from ..vocabulary import WellRef
from .scene import TipContent

FORMS = (
    "KIND@WELL with KIND partial:PERCENT, no_aspirate, no_dispense, air_bubble[:PERCENT], "
    "overdraw:PERCENT or no_tip, and WELL a destination such as B3, 2:B3 (slot 2), B3x1 (the "
    "first time only) or #12 (the 12th trajectory); "
    "for example partial:50@B3"
)


class FaultKind(str, Enum):
    """What can go wrong physically."""

    PARTIAL = "partial"
    NO_ASPIRATE = "no_aspirate"
    NO_DISPENSE = "no_dispense"
    AIR_BUBBLE = "air_bubble"
    OVERDRAW = "overdraw"
    NO_TIP = "no_tip"


@dataclass(frozen=True)
class Where:
    """Which trajectories a fault strikes: a destination well, or one trajectory by number.

    Attributes:
        well: ``"B3"``, or ``""`` where ``number`` is set.
        slot: Deck slot of the well, or ``""`` for any.
        number: Trajectory of the run counted from 1, or ``None``.
        times: A transient fault: so many first deliveries into the well; ``None`` for all.
    """

    well: str = ""
    slot: str = ""
    number: int | None = None
    times: int | None = None

    def __str__(self) -> str:
        if self.number is not None:
            return f"#{self.number}"
        times = "" if self.times is None else f"x{self.times}"
        return (f"{self.slot}:{self.well}" if self.slot else self.well) + times

    def matches(self, well: WellRef) -> bool:
        """Whether it means this well."""
        if self.number is not None or well.name.upper() != self.well:
            return False
        return not self.slot or self.slot == well.slot.upper()


@dataclass(frozen=True)
class Fault:
    """One planted fault.

    Attributes:
        kind: What goes wrong.
        where: For which trajectories.
        amount: ``PARTIAL``: fraction of the volume that is dispensed. ``AIR_BUBBLE``: fraction
            of the drawn volume that is air. ``OVERDRAW``: what is drawn beyond it. Otherwise 0.
    """

    kind: FaultKind
    where: Where
    amount: float = 0.0

    def __str__(self) -> str:
        share = f":{self.amount * 100:g}" if self.amount else ""
        return f"{self.kind.value}{share}@{self.where}"

    @classmethod
    def parse(cls, text: str) -> Fault:
        """Read ``KIND@WELL`` (see the module's description); case and blanks do not matter.

        Raises:
            ConfigurationError: It cannot be read; the message says what is accepted.
        """
        what, at, place = text.strip().partition("@")
        name, colon, number = what.strip().lower().partition(":")
        name = name.strip().replace("-", "_")
        if not at or not place.strip():
            raise _wrong(text, "it names no well after '@'")
        try:
            kind = FaultKind(name)
        except ValueError:
            known = ", ".join(kind.value for kind in FaultKind)
            raise _wrong(text, f"{name!r} is no kind of fault ({known})") from None
        return cls(kind, _parse_where(text, place), _parse_amount(text, kind, colon, number))


def parse_faults(faults: Iterable[Fault | str]) -> tuple[Fault, ...]:
    """Faults from what a user gave, texts or :class:`Fault` objects, in their order.

    Raises:
        ConfigurationError: One cannot be read.
    """
    return tuple(item if isinstance(item, Fault) else Fault.parse(item) for item in faults)


def _wrong(text: str, why: str) -> ConfigurationError:
    return ConfigurationError(f"The fault {text!r} cannot be used: {why}. Write {FORMS}.")


def _parse_amount(text: str, kind: FaultKind, colon: str, number: str) -> float:
    if kind in (FaultKind.PARTIAL, FaultKind.OVERDRAW) and not colon:
        raise _wrong(text, f"{kind.value} needs a percentage")
    if kind is FaultKind.AIR_BUBBLE and not colon:
        return 0.08
    if not colon:
        return 0.0
    if kind not in (FaultKind.PARTIAL, FaultKind.AIR_BUBBLE, FaultKind.OVERDRAW):
        raise _wrong(text, f"{kind.value} takes no percentage")
    try:
        percent = float(number.strip().rstrip("%"))
    except ValueError:
        raise _wrong(text, f"{number.strip()!r} is no percentage") from None
    if not 0 < percent < 100:
        raise _wrong(text, f"{percent:g} % does not lie between 0 and 100")
    return percent / 100.0


def _parse_where(text: str, place: str) -> Where:
    place = place.strip().upper()
    if place.startswith("#"):
        if not place[1:].isdigit() or int(place[1:]) < 1:
            raise _wrong(text, f"{place!r} is no trajectory number (they count from #1)")
        return Where(number=int(place[1:]))
    slot, colon, well = place.rpartition(":")
    slot, well, times = slot.strip(), well.strip(), None
    if limited := re.fullmatch(r"(.*\d)X([1-9])", well):
        well, times = limited[1], int(limited[2])
    if not re.fullmatch(r"[A-Z]{1,2}[1-9]\d?", well):
        raise _wrong(text, f"{well!r} is no well name")
    if colon and not re.fullmatch(r"\d{1,2}|[A-D][1-4]", slot):
        raise _wrong(text, f"{slot!r} is no deck slot")
    return Where(well=well, slot=slot, times=times)


Acting = Mapping[FaultKind, Fault]
"""The faults that strike one tip in one trajectory."""


def held_after(
    start: TipContent, changes: Sequence[float], acting: Acting, film: float
) -> TipContent:
    """What a tip holds after a trajectory's changes.

    Replayed as a whole each time, because a well-addressed fault may be known only from the
    second keyframe on.

    Args:
        start: As the trajectory found it.
        changes: What was drawn (more than 0) and delivered (less), µL.
        acting: The faults.
        film: Liquid that stays on the wall, fraction of what is delivered.
    """
    if FaultKind.NO_TIP in acting:
        return TipContent(present=False)
    content = start
    for change in changes:
        if change > 1e-9:
            content = _draw(content, change, acting)
        elif change < -1e-9:
            content = _deliver(content, -change, acting, film)
    return content


def _draw(content: TipContent, volume: float, acting: Acting) -> TipContent:
    """Air instead of liquid, more than was commanded, or a bubble a third of the way up."""
    if FaultKind.NO_ASPIRATE in acting:
        return content
    if FaultKind.OVERDRAW in acting:
        volume *= 1 + acting[FaultKind.OVERDRAW].amount
    bubble = acting.get(FaultKind.AIR_BUBBLE)
    air = volume * bubble.amount if bubble else 0.0
    # New liquid enters at the orifice and pushes up what was there.
    below = 0.35 * (volume - air) if air else content.gap_below_ul + volume
    gap = air or content.gap_ul
    return replace(
        content,
        liquid_ul=content.liquid_ul + volume - air,
        gap_ul=gap,
        gap_below_ul=below if gap else 0.0,
    )


def _deliver(content: TipContent, wanted: float, acting: Acting, film: float) -> TipContent:
    """A normal dispense pushes out the commanded volume and no more."""
    if FaultKind.NO_DISPENSE in acting or FaultKind.NO_ASPIRATE in acting:
        # Without an aspirate the plunger only pushes out the air that it drew.
        return content
    if FaultKind.PARTIAL in acting:
        wanted *= acting[FaultKind.PARTIAL].amount
    left = content.liquid_ul - wanted
    left = left if left > 1e-6 else 0.0
    gone = content.liquid_ul - left
    # What was below an enclosed bubble leaves first, and the bubble after it.
    keeps_gap = content.gap_ul > 0 and content.gap_below_ul > gone
    return TipContent(
        liquid_ul=left,
        gap_ul=content.gap_ul if keeps_gap else 0.0,
        gap_below_ul=content.gap_below_ul - gone if keeps_gap else 0.0,
        film_ul=content.film_ul + film * gone,
        film_to_ul=max(content.film_to_ul, content.liquid_ul),
    )
