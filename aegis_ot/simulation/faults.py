"""Planted faults, and what a simulated pipette truly holds because of them.

A fault is written ``KIND@WELL``, as the command line takes it::

    partial:50@B3        half of the volume is dispensed into B3
    no_aspirate@C4       nothing is drawn for C4
    no_dispense@#12      nothing is dispensed in the run's 12th trajectory
    air_bubble@D1        air in the column drawn for D1 (8 % of the volume; air_bubble:15@D1)
    no_tip@E1            no tip on the nozzle while E1 is served
    partial:50@2:B3      only in the labware in slot 2
"""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from ..errors import ConfigurationError
from ..vocabulary import Keyframe, KeyframeKind, WellRef
from .scene import TipContent

FORMS = (
    "KIND@WELL with KIND partial:PERCENT, no_aspirate, no_dispense, air_bubble[:PERCENT] or "
    "no_tip, and WELL a destination such as B3, 2:B3 (slot 2) or #12 (the 12th trajectory); "
    "for example partial:50@B3"
)


class FaultKind(str, Enum):
    """What can go wrong physically."""

    PARTIAL = "partial"
    NO_ASPIRATE = "no_aspirate"
    NO_DISPENSE = "no_dispense"
    AIR_BUBBLE = "air_bubble"
    NO_TIP = "no_tip"


@dataclass(frozen=True)
class Where:
    """Which trajectories a fault strikes: a destination well, or one trajectory by number.

    Attributes:
        well: ``"B3"``, or ``""`` where ``number`` is set.
        slot: Deck slot of the well, or ``""`` for any.
        number: Trajectory of the run counted from 1, or ``None``.
    """

    well: str = ""
    slot: str = ""
    number: int | None = None

    def __str__(self) -> str:
        if self.number is not None:
            return f"#{self.number}"
        return f"{self.slot}:{self.well}" if self.slot else self.well

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
            of the drawn volume that is air. Otherwise 0.
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
    if kind is FaultKind.PARTIAL and not colon:
        raise _wrong(text, "a partial dispense needs the percentage dispensed")
    if kind is FaultKind.AIR_BUBBLE and not colon:
        return 0.08
    if not colon:
        return 0.0
    if kind not in (FaultKind.PARTIAL, FaultKind.AIR_BUBBLE):
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
    slot, well = slot.strip(), well.strip()
    if not re.fullmatch(r"[A-Z]{1,2}[1-9]\d?", well):
        raise _wrong(text, f"{well!r} is no well name")
    if colon and not re.fullmatch(r"\d{1,2}|[A-D][1-4]", slot):
        raise _wrong(text, f"{slot!r} is no deck slot")
    return Where(well=well, slot=slot)


@dataclass(frozen=True)
class PhysicalState:
    """What is truly on a pipette at a keyframe.

    Attributes:
        contents: One tip per channel, ``A1`` first, each as left after the keyframe's moment.
        struck: The faults that act in this trajectory.
    """

    contents: tuple[TipContent, ...]
    struck: tuple[Fault, ...] = ()


@dataclass
class _Mount:
    """A pipette between two keyframes: how its trajectory began, and what happened since."""

    tip: str = ""
    expected: float = 0.0
    trajectory: int = -1
    start: tuple[TipContent, ...] = ()
    changes: list[float] = field(default_factory=list)
    contents: tuple[TipContent, ...] = ()


class FaultPlan:
    """Follows a run's keyframes and tells what each tip truly holds.

    What is drawn or delivered between two keyframes is the change of the volume that the robot
    expects in the tip. A fault changes what comes of it:

    - ``no_aspirate``: air is drawn; what is left from before stays.
    - ``air_bubble``: that share of the volume is air, a third of the way up the column.
    - ``partial``, ``no_dispense``: less or nothing leaves the tip. The rest stays in it, also for
      the next wells if the tip is used again: a normal dispense pushes out the commanded volume
      and no more. It ends when the robot reports another tip. Keyframes do not tell of blow-outs,
      so a blow-out between two trajectories does not empty a simulated tip.
    - ``no_tip``: no tip in view in this trajectory, and nothing drawn.

    A well address means the *destination*. While a trajectory's destination is still unknown (a
    robot learns it only after the aspirate), a well-addressed fault is not yet seen; from then
    on the tip looks as if the fault had struck from the beginning. Give ``expect`` the keyframes
    of a rehearsal, and each fault acts from its trajectory's first keyframe.

    Keyframes of several runs may be mixed. A resent keyframe (same run and sequence number) gets
    the answer it got the first time.
    """

    def __init__(self, faults: Iterable[Fault | str] = (), film: float = 0.004) -> None:
        self.faults = parse_faults(faults)
        self._film = film
        self._mounts: dict[tuple[str, str], _Mount] = {}
        self._answers: OrderedDict[tuple[str, int], PhysicalState] = OrderedDict()
        self._destinations: dict[int, tuple[WellRef, ...]] = {}

    def expect(self, keyframes: Iterable[Keyframe]) -> None:
        """Learn the destinations of the coming trajectories from a rehearsal's keyframes."""
        for keyframe in keyframes:
            if keyframe.destinations:
                self._destinations[keyframe.trajectory] = keyframe.destinations

    def unmatched(self, keyframes: Sequence[Keyframe]) -> tuple[Fault, ...]:
        """The faults that strike none of these keyframes: a mistyped well, most likely."""
        return tuple(
            fault
            for fault in self.faults
            if not any(
                self._strikes(fault, keyframe, channel)
                for keyframe in keyframes
                for channel in range(max(keyframe.channels, 1))
            )
        )

    def apply(self, keyframe: Keyframe) -> PhysicalState:
        """What the pipette truly holds at this keyframe."""
        key = (keyframe.run, keyframe.sequence)
        if key in self._answers:
            return self._answers[key]
        state = self._advance(keyframe)
        self._answers[key] = state
        while len(self._answers) > 4096:
            self._answers.popitem(last=False)
        return state

    def _advance(self, keyframe: Keyframe) -> PhysicalState:
        channels = max(keyframe.channels, 1)
        mount = self._mounts.setdefault((keyframe.run, keyframe.mount), _Mount())
        if mount.tip != keyframe.tip or len(mount.contents) != channels:
            before = _expected_before(keyframe)
            fresh = tuple(TipContent(liquid_ul=before) for _ in range(channels))
            mount.tip, mount.expected, mount.contents = keyframe.tip, before, fresh
            mount.trajectory = -1
        if mount.trajectory != keyframe.trajectory:
            # A tip that was missing for one trajectory is a new one for the next.
            mount.start = tuple(c if c.present else TipContent() for c in mount.contents)
            mount.trajectory = keyframe.trajectory
            mount.changes = []
        mount.changes.append(keyframe.expected_ul - mount.expected)
        mount.expected = keyframe.expected_ul
        struck: dict[Fault, None] = {}
        contents = []
        for channel, start in enumerate(mount.start):
            faults = [f for f in self.faults if self._strikes(f, keyframe, channel)]
            struck.update(dict.fromkeys(faults))
            contents.append(self._replay(start, mount.changes, {f.kind: f for f in faults}))
        mount.contents = tuple(contents)
        return PhysicalState(mount.contents, tuple(struck))

    def _replay(
        self, start: TipContent, changes: Sequence[float], faults: dict[FaultKind, Fault]
    ) -> TipContent:
        """A tip after a trajectory's changes, from its beginning.

        Replayed as a whole each time, because a well-addressed fault may be known only from the
        second keyframe on.
        """
        if FaultKind.NO_TIP in faults:
            return TipContent(present=False)
        content = start
        for change in changes:
            if change > 1e-9:
                content = _draw(content, change, faults)
            elif change < -1e-9:
                content = self._deliver(content, -change, faults)
        return content

    def _deliver(
        self, content: TipContent, wanted: float, faults: dict[FaultKind, Fault]
    ) -> TipContent:
        if FaultKind.NO_DISPENSE in faults or FaultKind.NO_ASPIRATE in faults:
            # Without an aspirate the plunger only pushes out the air that it drew.
            return content
        if FaultKind.PARTIAL in faults:
            wanted *= faults[FaultKind.PARTIAL].amount
        left = content.liquid_ul - wanted
        left = left if left > 1e-6 else 0.0
        gone = content.liquid_ul - left
        # What was below an enclosed bubble leaves first, and the bubble after it.
        keeps_gap = content.gap_ul > 0 and content.gap_below_ul > gone
        return TipContent(
            liquid_ul=left,
            gap_ul=content.gap_ul if keeps_gap else 0.0,
            gap_below_ul=content.gap_below_ul - gone if keeps_gap else 0.0,
            film_ul=content.film_ul + self._film * gone,
            film_to_ul=max(content.film_to_ul, content.liquid_ul),
        )

    def _strikes(self, fault: Fault, keyframe: Keyframe, channel: int) -> bool:
        if fault.where.number is not None:
            return fault.where.number == keyframe.trajectory + 1
        wells = keyframe.destinations or self._destinations.get(keyframe.trajectory, ())
        if len(wells) == max(keyframe.channels, 1):
            return fault.where.matches(wells[channel])
        # Channels that share a well (a reservoir) share its fault.
        return any(fault.where.matches(well) for well in wells)


def _draw(content: TipContent, volume: float, faults: dict[FaultKind, Fault]) -> TipContent:
    if FaultKind.NO_ASPIRATE in faults:
        return content
    bubble = faults.get(FaultKind.AIR_BUBBLE)
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


def _expected_before(keyframe: Keyframe) -> float:
    """What the tip held before its first keyframe, as far as that one tells, µL."""
    if keyframe.kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT):
        return 0.0
    return keyframe.expected_ul + keyframe.commanded_ul
