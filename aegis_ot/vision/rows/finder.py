"""The tips of a multi-channel pipette in one frame, each with its nozzle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from ...vocabulary import Keyframe
from ..tips import TipGeometry, tip_for
from ..types import FREE, Detector, Image, PairedDetector, TipDetection
from .fit import Row
from .hiding import HIDDEN, covered
from .places import RowPlaces
from .search import RowSearch

FirstChannel = Literal["auto", "left", "right"]
"""On which side of the frame the first channel is; ``"auto"``: see :class:`RowFinder`."""

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
        other = detector.of_rows if isinstance(detector, PairedDetector) else None
        asked = [detector] if other is None else [detector, other]
        self._searches = [RowSearch(one, self._tip, self._count) for one in asked]
        self._search = self._searches[0]
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
            row = None if known is None else self._search.row_in_wells(image, known)
            return self._nothing("Labware hides the row.") if row is None else self._seen(row, 0)
        row = self._row(image)
        if row is not None and row.span == self._count:
            self._places.note(keyframe.position, row)
            self._orient(row)
            return self._seen(row, 0)
        if row is not None:
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

    def _row(self, image: Image) -> Row | None:
        """The row of a frame, by the detector that sees more of its tips."""
        found: Row | None = None
        for search in self._searches:
            row = search.row(image, self._places.last)
            if row is not None and (found is None or len(row.heats) > len(found.heats)):
                found, self._search = row, search
            if found is not None and len(found.heats) == self._count:
                break
        return found

    def _orient(self, row: Row) -> None:
        """Settle from the first whole row which end is the first channel."""
        if self._left is not None:
            return
        tapered = self._search.is_tapered(row)
        # A column's first channel is the far one: on the left if the right end is nearer.
        self._left = row.taper < 0 if self._column and tapered else True
        self.assumed = self._column and not tapered

    def _seen(self, row: Row, offset: int) -> SeenRow:
        """Name the tips of a row of which ``offset`` are missing to the left of the first."""
        numbers = [number - offset for number in range(self._count)]
        hidden = self._hidden(row, offset)
        tips = [self._search.tip(row, n) if n in row.heats else None for n in numbers]
        if not self._left:
            tips, hidden = tips[::-1], hidden[::-1]
        shown = tuple(None if hides else tip for tip, hides in zip(tips, hidden, strict=True))
        return SeenRow(shown, tuple(hidden), "", None not in tips)

    def _hidden(self, row: Row, offset: int) -> list[bool]:
        shares = covered(row, self._tip, range(-offset, self._count - offset))
        return [shares[number - offset] > HIDDEN for number in range(self._count)]

    def _nothing(self, trouble: str = "") -> SeenRow:
        return SeenRow((None,) * self._count, (False,) * self._count, trouble)

    def _along(self, image: Image) -> SeenRow:
        """Tips one behind another. The nearest one is seen, but against the others, and through
        them: of its column nothing can be told."""
        seed = self._search.guess(image)
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
