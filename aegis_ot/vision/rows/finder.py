"""The tips of a multi-channel pipette in one frame, each with its nozzle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from ...vocabulary import Keyframe
from ..tips import TipGeometry, tip_for
from ..types import FREE, Detector, Image, RowDetector, TipDetection
from .fit import PITCH_MM, Row, find_in_wells, find_row
from .hiding import HIDDEN, covered
from .orifices import find_by_orifices
from .places import RowPlaces

FirstChannel = Literal["auto", "left", "right"]
"""On which side of the frame the first channel is; ``"auto"``: see :class:`RowFinder`."""

_TAPERED = 0.025
"""A row whose far end is smaller by this share is seen at an angle: its depth can be told."""

_STEEP = 0.65
"""Below this many pitches from tip to tip, tips overlap: one that is not found may be hidden."""

_STEPS = 0.3, 1.15
"""Steps of a row, pitches; what looks like a row of other steps is none."""

_WHOLE_STEP = 0.93
"""A row without taper is seen squarely, and its steps are a pitch each: if they look shorter than
this, pitches, its tips are taken for longer ones."""

_OFF_SCALE = 0.08
_SAME_LENGTH = 0.15
_FAINT = 0.2
"""Confidence below which not even one tip is in the frame."""


@dataclass(frozen=True)
class SeenRow:
    """What a frame shows of a row, one entry per nozzle in their order.

    Attributes:
        tips: The tip on each; ``None`` where there is none, or none is seen.
        hidden: Whether other tips hide it.
        trouble: Why the tips cannot be told apart; empty if they can.
        whole: Whether every tip was found.
    """

    tips: tuple[TipDetection | None, ...]
    hidden: tuple[bool, ...]
    trouble: str = ""
    whole: bool = False


class RowFinder:
    """Finds one run's rows of tips and puts names to them.

    Channels are told by their order in the frame. Which end is the first: as ``first`` says, or
    from the depth of the row, if it is seen at an angle. Cameras stand before the deck or beside
    it, so a column's first channel (``A1``, at the back) is the far one. A row seen squarely shows
    no depth: then the camera is taken to stand at the left side, the first channel on the left.

    Args:
        detector: Finds tips.
        keyframe: The first one of this pipette and tip.
        first: On which side the first channel is.
    """

    def __init__(self, detector: Detector, keyframe: Keyframe, first: FirstChannel) -> None:
        self._detector = detector
        self._tip: TipGeometry = tip_for(keyframe.pipette, keyframe.capacity_ul)
        self._count = len(keyframe.nozzles)
        self._column = keyframe.nozzles[0][1:] == keyframe.nozzles[-1][1:]
        self._places = RowPlaces()
        self._left: bool | None = None if first == "auto" else first == "left"
        self.assumed = False
        """Whether nothing told which end is the first channel."""

    @property
    def oriented(self) -> bool:
        """Whether a row was seen, and which end is the first channel is known or assumed."""
        return self._left is not None and self._places.last is not None

    def find(self, image: Image, keyframe: Keyframe) -> SeenRow:
        """The tips of one frame; of a row in wells, ``trouble`` where not all are found."""
        if keyframe.kind not in FREE:
            known = self._places.last
            row = None if known is None else self._row_in_wells(image, known)
            return self._nothing("Labware hides the row.") if row is None else self._seen(row, 0)
        row = self._row(image)
        if row is not None and row.span == self._count:
            self._places.note(keyframe.position, row)
            self._orient(row)
            return self._seen(row, 0)
        if row is not None and self._pitches(row) >= _STEEP:
            offset = self._places.offset(keyframe.position, row, self._count)
            if offset is not None:
                return self._seen(row, offset)
            return self._nothing(
                f"Only {len(row.heats)} of {self._count} tips are seen, and which are missing "
                "cannot be told."
            )
        known = self._places.last
        if known is not None and not any(self._hidden(known, 0)):
            if self._detector.detect(image) is None:
                return self._nothing()
            return self._nothing(f"Most of the {self._count} tips are not seen.")
        return self._along(image)

    def _orient(self, row: Row) -> None:
        """Settle from the first whole row which end is the first channel."""
        if self._left is not None:
            return
        tapered = self._is_tapered(row)
        # A column's first channel is the far one: on the left if the right end is nearer.
        self._left = row.taper < 0 if self._column and tapered else True
        self.assumed = self._column and not tapered

    def _row(self, image: Image) -> Row | None:
        if not isinstance(self._detector, RowDetector):
            return None
        seed = self._guess(image)
        if seed is None:
            return None
        row = self._row_at(image, seed)
        if row is not None and abs(row.length(row.span / 2) / seed.length - 1) > _OFF_SCALE:
            better = self._row_at(image, self._detection(row, (row.span - 1) // 2))
            row = better if better is not None and len(better.heats) >= len(row.heats) else row
        if row is None or len(row.heats) < self._count or not self._to_scale(row):
            row = self._clearer(row, self._by_orifices(image, seed))
        if row is None:
            return None
        step = self._pitches(row)
        enough = len(row.heats) == self._count or (
            len(row.heats) >= max(3, self._count / 2) and step >= _STEEP
        )
        return row if enough and _STEPS[0] <= step <= 1.3 * _STEPS[1] else None

    def _guess(self, image: Image) -> TipDetection | None:
        """The tip, or where one would be if any is there."""
        guess = getattr(self._detector, "best_guess", self._detector.detect)
        found: TipDetection | None = guess(image)
        return found

    def _row_in_wells(self, image: Image, known: Row) -> Row | None:
        seed = self._guess(image)
        if seed is None or not isinstance(self._detector, RowDetector):
            return None
        # In a well a tip looks shorter than it is: the scale is that of the free one.
        length = known.length((self._count - 1) / 2)
        x, y = seed.collar
        ends = self._detector.ends(
            image, replace(seed, orifice=(x, y + length)), self._reach(length)
        )
        return find_in_wells(ends, known, self._tip.length_mm)

    def _reach(self, length: float) -> float:
        pitch = PITCH_MM / self._tip.length_mm * length
        return 1.3 * (self._count - 1) * pitch + 0.3 * length

    def _row_at(self, image: Image, seed: TipDetection) -> Row | None:
        assert isinstance(self._detector, RowDetector)
        ends = self._detector.ends(image, seed, self._reach(seed.length))
        return find_row(ends, seed.length, self._tip.length_mm, self._count)

    def _to_scale(self, row: Row) -> bool:
        """Whether steps are a pitch each, or shorter ones because the row is seen at an angle."""
        pitches = self._pitches(row)
        return pitches <= _STEPS[1] and (pitches >= _WHOLE_STEP or self._is_tapered(row))

    def _is_tapered(self, row: Row) -> bool:
        return abs(row.taper) * (self._count - 1) >= _TAPERED

    def _pitches(self, row: Row) -> float:
        """Steps of a row in pitches, at the scale of its tips."""
        return row.step_lengths * self._tip.length_mm / PITCH_MM

    def _clearer(self, row: Row | None, by_orifices: Row | None) -> Row | None:
        """Of a row by both ends and one by the lower ends the better one.

        The lower ends must show more tips, or the upper ones must be mistaken: steps do not fit
        the pitch then. Seen at an angle their own scale is too small: whole rows before tell.
        """
        known = self._places.last
        if by_orifices is not None and known is not None:
            length, wanted = (one.length((one.span - 1) / 2) for one in (by_orifices, known))
            if abs(length / wanted - 1) > _SAME_LENGTH:
                by_orifices = None
        if by_orifices is None or row is None:
            return by_orifices or row
        more = len(by_orifices.heats) - len(row.heats)
        mistaken = not self._to_scale(row)
        return by_orifices if more > 0 or (mistaken and more == 0) else row

    def _by_orifices(self, image: Image, seed: TipDetection) -> Row | None:
        """The row by its lower ends, at the scale that they themselves give."""
        assert isinstance(self._detector, RowDetector)
        length, found = seed.length, None
        for _ in range(2):
            x, y = seed.orifice[0], min(seed.orifice[1], float(image.shape[0]))
            at = replace(seed, orifice=(x, y), collar=(x, y - length))
            ends = self._detector.ends(image, at, self._reach(length))
            row = find_by_orifices(ends, length, self._tip.length_mm, self._count)
            if row is None or (found is not None and len(row.heats) < len(found.heats)):
                break
            found, length = row, row.length((row.span - 1) / 2)
        # Four warm spots in line are no row: bare heads have shown as many.
        return found if found is not None and 2 * len(found.heats) > self._count else None

    def _seen(self, row: Row, offset: int) -> SeenRow:
        """Name the tips of a row of which ``offset`` are missing to the left of the first."""
        numbers = [number - offset for number in range(self._count)]
        hidden = self._hidden(row, offset)
        tips = [self._detection(row, n) if n in row.heats else None for n in numbers]
        if not self._left:
            tips, hidden = tips[::-1], hidden[::-1]
        shown = tuple(None if hides else tip for tip, hides in zip(tips, hidden, strict=True))
        return SeenRow(shown, tuple(hidden), "", None not in tips)

    def _hidden(self, row: Row, offset: int) -> list[bool]:
        shares = covered(row, self._tip, range(-offset, self._count - offset))
        return [shares[number - offset] > HIDDEN for number in range(self._count)]

    def _detection(self, row: Row, number: int) -> TipDetection:
        collar_x, collar_y, orifice_x, orifice_y = map(float, row.best(number))
        scale = row.length(number) / self._tip.length_mm
        radius = 1.1 * float(self._tip.outer_radius(self._tip.length_mm)) * scale
        left, right = min(collar_x, orifice_x) - radius, max(collar_x, orifice_x) + radius
        return TipDetection(
            max(left, 0.0), max(collar_y, 0.0), right - max(left, 0.0),
            orifice_y - max(collar_y, 0.0), min(row.heats.get(number, 0.0), 1.0),
            (orifice_x, orifice_y), (collar_x, collar_y), row.apart(number),
        )  # fmt: skip

    def _nothing(self, trouble: str = "") -> SeenRow:
        return SeenRow((None,) * self._count, (False,) * self._count, trouble)

    def _along(self, image: Image) -> SeenRow:
        """Tips one behind another. The nearest one is seen, but against the others, and through
        them: of its column nothing can be told."""
        seed = self._guess(image)
        if seed is None or seed.confidence < _FAINT:
            return self._nothing()
        return SeenRow((None,) * self._count, (True,) * self._count)


def channel_keyframe(keyframe: Keyframe, number: int) -> Keyframe:
    """What a keyframe says of one of its channels, as of a single tip."""
    target = keyframe.targets[number] if keyframe.targets else None
    found = keyframe.channels_found
    sources = keyframe.sources
    each = len(sources) == keyframe.channels
    return replace(
        keyframe,
        channels=1,
        sources=(sources[number],) if each else sources,
        destinations=() if target is None else (target,),
        nozzles=(),
        targets=(),
        liquid_found=found[number] if found else keyframe.liquid_found,
        channels_found=(),
    )
