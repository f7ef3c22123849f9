"""Where a row of tips hangs in a frame: what may be one, looked at nozzle by nozzle."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeGuard

from ..column.measure import shape_of
from ..tips import TipGeometry
from ..types import Detector, GuessingDetector, Image, RowDetector, TipDetection
from .both_ends import find_in_wells, find_row
from .fit import PITCH_MM, Row, upright
from .nozzles import (
    Nozzle,
    clarity,
    compare,
    look_at_nozzles,
    on_outlines,
    promise,
    row_of,
    with_tip,
)
from .orifices import find_by_orifices, rows_by_orifices

_TAPERED = 0.025
"""A row whose far end is smaller by this share is seen at an angle: its depth can be told."""

_STEEP = 0.65
"""Below this many pitches from tip to tip, tips overlap: one that is not found may be hidden."""

_STEPS = 0.3, 1.5
"""Steps of a row, pitches; what looks like a row of other steps is none."""

_WHOLE_STEP = 0.93, 1.08
"""A row without taper is seen squarely, and its steps are a pitch each: if they look shorter or
longer than this, pitches, its tips are taken for longer or shorter ones."""

_TELLING = 6
"""Tips of a row from which its taper tells whether it is seen squarely."""

_OFF_SCALE = 0.08
"""A row is looked at again at its own scale if its tips are so much longer or shorter than the one
it was found beside, tip lengths."""

_SAME_LENGTH = 0.15
"""By how much the tips of one run's rows differ in length, tip lengths: the robot moves."""

_SCALES = 0.2, 0.28, 0.4, 0.56, 0.75
"""Lengths of tips that are looked for in the whole frame, as shares of its height."""

_SMALLEST = 0.12
"""Of tips that are looked for in the whole frame, a share of its height."""

_LINES, _FEWEST, _TRIED = 3, 3, 2
"""Rows of lower ends that are looked at per scale, from so many tips; and how many of the most
promising ones are settled."""

_IN_VAIN = 4
"""Frames that are searched as a whole before a run has shown a row: seen along, it shows none."""

_PASSES, _GAIN = 3, 1.02
"""A row is looked at again where it was settled, as often as that gains something."""


class RowSearch:
    """Finds rows of one kind of tip.

    First beside the place where the detector finds a tip, by both ends or by the lower ones alone.
    Where that gives no whole row, something else in the room may have misled the detector: then in
    the whole frame. What may be a row is settled nozzle by nozzle.

    Args:
        detector: Finds tips; only a :class:`~aegis_ot.vision.types.RowDetector` finds rows.
        tip: Kind of tip.
        count: Nozzles of the row.
    """

    def __init__(self, detector: Detector, tip: TipGeometry, count: int) -> None:
        self._detector = detector
        self._tip = tip
        self._count = count
        self._shape = shape_of(tip)
        self._in_vain = 0

    def guess(self, image: Image) -> TipDetection | None:
        """The tip, or where one would be if any is there."""
        if isinstance(self._detector, GuessingDetector):
            return self._detector.best_guess(image)
        return self._detector.detect(image)

    def row(self, image: Image, known: Row | None) -> Row | None:
        """The row of a frame; ``None`` if less than half of it is seen, or its tips are too close.

        ``known``: the last whole row of the run.
        """
        seed = self.guess(image) if isinstance(self._detector, RowDetector) else None
        if seed is None:
            return None
        near = self._near(image, seed, known)
        found = [] if near is None else [self._settled(image, near, self._look(image, near))]
        if not any(row is not None and self._is_it(row, known) for row in found):
            found += self._searched(image, known)
        return max(filter(self._enough, found), key=_warmth, default=None)

    def row_in_wells(self, image: Image, known: Row) -> Row | None:
        """The row that hangs in wells, so that labware hides its lower ends."""
        seed = self.guess(image)
        if seed is None or not isinstance(self._detector, RowDetector):
            return None
        # In a well a tip looks shorter than it is: the scale is that of the free one.
        length = known.length((self._count - 1) / 2)
        x, y = seed.collar
        ends = self._detector.ends(
            image, replace(seed, orifice=(x, y + length)), self._reach(length)
        )
        return find_in_wells(ends, known, self._tip.length_mm)

    def is_tapered(self, row: Row) -> bool:
        """Whether the row is seen at an angle that tells its depth."""
        return abs(row.taper) * (self._count - 1) >= _TAPERED

    def pitches(self, row: Row) -> float:
        """Steps of a row in pitches, at the scale of its tips."""
        return row.step_lengths * self._tip.length_mm / PITCH_MM

    def tip(self, row: Row, number: int) -> TipDetection:
        """One tip of a row."""
        collar_x, collar_y, orifice_x, orifice_y = map(float, row.best(number))
        scale = row.length(number) / self._tip.length_mm
        radius = 1.1 * float(self._tip.outer_radius(self._tip.length_mm)) * scale
        left, right = min(collar_x, orifice_x) - radius, max(collar_x, orifice_x) + radius
        return TipDetection(
            max(left, 0.0), max(collar_y, 0.0), right - max(left, 0.0),
            orifice_y - max(collar_y, 0.0), min(row.heats.get(number, 0.0), 1.0),
            (orifice_x, orifice_y), (collar_x, collar_y), row.apart(number),
        )  # fmt: skip

    def _near(self, image: Image, seed: TipDetection, known: Row | None) -> Row | None:
        """The row beside a tip."""
        row = self._by_both_ends(image, seed)
        if row is not None and abs(row.length(row.span / 2) / seed.length - 1) > _OFF_SCALE:
            better = self._by_both_ends(image, self.tip(row, (row.span - 1) // 2))
            row = better if better is not None and len(better.heats) >= len(row.heats) else row
        if row is None or len(row.heats) < self._count or not self._to_scale(row):
            row = self._clearer(row, self._by_orifices(image, seed), known)
        return None if row is None else self._hung(image, row)

    def _reach(self, length: float) -> float:
        pitch = PITCH_MM / self._tip.length_mm * length
        return 1.3 * (self._count - 1) * pitch + 0.3 * length

    def _by_both_ends(self, image: Image, seed: TipDetection) -> Row | None:
        assert isinstance(self._detector, RowDetector)
        ends = self._detector.ends(image, seed, self._reach(seed.length))
        return find_row(ends, seed.length, self._tip.length_mm, self._count)

    def _to_scale(self, row: Row) -> bool:
        """Whether steps are a pitch each, or shorter ones because the row is seen at an angle."""
        pitches = self.pitches(row)
        short = self._count < _TELLING  # too few to show a taper
        whole = pitches >= _WHOLE_STEP[0] or self.is_tapered(row)
        return pitches <= _WHOLE_STEP[1] and (whole or short)

    def _clearer(self, row: Row | None, by_orifices: Row | None, known: Row | None) -> Row | None:
        """Of a row by both ends and one by the lower ends the better one.

        The lower ends must show more tips, or the upper ones must be mistaken: steps do not fit
        the pitch then. Seen at an angle their own scale is too small: whole rows before tell.
        """
        if by_orifices is not None and known is not None:
            by_orifices = by_orifices if _as_long(by_orifices, known) else None
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
            found, length = row, row.middle_length
        # Four warm spots in line are no row: bare heads have shown as many.
        return found if found is not None and 2 * len(found.heats) > self._count else None

    def _searched(self, image: Image, known: Row | None) -> list[Row | None]:
        """Rows that the whole frame shows."""
        if known is None and self._in_vain >= _IN_VAIN:
            return []
        found = [self._settled(image, *tried) for tried in self._anywhere(image, known)]
        self._in_vain = 0 if any(map(self._enough, found)) else self._in_vain + 1
        return found

    def _is_it(self, row: Row, known: Row | None) -> bool:
        """Whether this is the row: whole, or a tip or two less and as long as the known one."""
        missing = self._count - len(row.heats)
        return missing == 0 or (known is not None and missing <= 2 and _as_long(row, known))

    def _enough(self, row: Row | None) -> TypeGuard[Row]:
        """Whether the row is whole, or half of it is seen and its tips stand apart."""
        if row is None:
            return False
        half = len(row.heats) >= max(3, self._count / 2) and self.pitches(row) >= _STEEP
        return half or len(row.heats) == self._count

    def _anywhere(self, image: Image, known: Row | None) -> list[tuple[Row, dict[int, Nozzle]]]:
        """What else in the frame may be the row, the likeliest first, and what its places show."""
        assert isinstance(self._detector, RowDetector)
        height = image.shape[0]
        lengths = [share * height for share in _SCALES]
        if known is not None:  # no smaller ones: the view would grow beyond measure
            lengths = [max(known.middle_length, _SMALLEST * height)]
        tried: list[tuple[float, Row, dict[int, Nozzle]]] = []
        for length in lengths:
            ends = self._detector.ends_of_length(image, length)
            for line in rows_by_orifices(ends, length, self._tip.length_mm, self._count, _LINES):
                if len(line.heats) >= min(_FEWEST, self._count):
                    nozzles = self._look(image, line)
                    tried.append((promise(nozzles, self._count), line, nozzles))
        tried.sort(key=lambda each: -each[0])
        return [(row, nozzles) for _, row, nozzles in tried[:_TRIED]]

    def _hung(self, image: Image, row: Row) -> Row:
        """The row at its steps' scale, and hung upright where that explains more of the picture."""
        row = self._scaled(row)
        other = upright(row)
        if other is None or clarity(row, image, self._shape) >= clarity(other, image, self._shape):
            return row
        return other

    def _scaled(self, row: Row) -> Row:
        """The row with tips no shorter than its steps say.

        What looks like a collar may be the lower end of a tip's sleeve.
        """
        if self.pitches(row) <= _WHOLE_STEP[1]:
            return row
        short = (1.0 - self.pitches(row)) * row.middle_length
        return row.moved((0.0, short, 0.0, 0.0))

    def _look(self, image: Image, row: Row) -> dict[int, Nozzle]:
        assert isinstance(self._detector, RowDetector)
        return look_at_nozzles(self._detector, image, row, self._count)

    def _settled(self, image: Image, row: Row, nozzles: dict[int, Nozzle]) -> Row | None:
        """The row of the nozzles that have a tip, looked at again where these put it."""
        settled: Row | None = None
        for _ in range(_PASSES):
            compared = compare(nozzles, image, self._shape)
            if len(with_tip(compared, surely=True)) < self._count:
                compared = compare(nozzles, image, self._shape, closely=True)
            found = row_of(compared, self._count)
            if found is None or not _STEPS[0] <= self.pitches(found) <= _STEPS[1]:
                break
            if settled is not None and _warmth(found) <= _GAIN * _warmth(settled):
                break
            settled = found
            if len(found.heats) == self._count:
                break
            nozzles = self._look(image, self._hung(image, found))
        return settled if settled is None else on_outlines(settled, image, self._shape)


def _as_long(row: Row, known: Row) -> bool:
    return abs(row.middle_length / known.middle_length - 1) <= _SAME_LENGTH


def _warmth(row: Row) -> float:
    return sum(row.heats.values())
