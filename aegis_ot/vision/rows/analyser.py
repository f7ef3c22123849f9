"""A run whose pipettes may have several channels: each visible tip is judged by itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ...vocabulary import Keyframe, is_row
from ..analyser import MOST_OPEN, Judged, RunAnalyser
from ..camera import Frame
from ..types import FREE, is_image
from .finder import FirstChannel, RowFinder, SeenRow, channel_keyframe
from .lane import NO_FRAME, Lane
from .verdicts import Channel, row_verdict

Head = tuple[str, str, float, tuple[str, ...]]
"""Mount, pipette, working volume of the tips, µL, and the active nozzles."""

_COLUMN = tuple(f"{row}1" for row in "ABCDEFGH")


@dataclass
class _OpenRow:
    """A trajectory of several tips whose keyframes are coming in."""

    head: Head
    last: Keyframe
    waiting: list[tuple[Keyframe, Frame]] = field(default_factory=list)
    hidden: set[int] = field(default_factory=set)
    trouble: str = ""


class ChannelAnalyser(RunAnalyser):
    """Judges single tips as :class:`RunAnalyser` does, and rows of tips tip by tip.

    A row's tips are found together (:class:`RowFinder`), then each nozzle is followed by a
    :class:`Lane`. Tips that others hide are ``unobserved``: no pass and no fail. So are all that do
    not stand in one row, as those of a whole 96-channel head.
    """

    first_channel: FirstChannel = "auto"

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._rows: dict[int, _OpenRow] = {}
        self._blocks: dict[int, Keyframe] = {}  # of tips in several rows, by trajectory
        self._finders: dict[Head, RowFinder] = {}
        self._lanes: dict[tuple[str, str], Lane] = {}

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """A keyframe was captured: find its tips and measure while the robot moves on."""
        if keyframe.channels == 1:
            super().observe(keyframe, frame)
            return
        keyframe = _named(keyframe)
        if not is_row(keyframe.nozzles):
            self._blocks[keyframe.trajectory] = keyframe
            return
        head = keyframe.mount, keyframe.pipette, keyframe.capacity_ul, keyframe.nozzles
        row = self._rows.setdefault(keyframe.trajectory, _OpenRow(head, keyframe))
        while len(self._rows) > MOST_OPEN:
            self._close(min(self._rows))
        row.last = keyframe
        row.waiting.append((keyframe, frame))
        if head not in self._finders:
            self._finders[head] = RowFinder(self._detector, keyframe, self.first_channel)
        finder = self._finders[head]
        if finder.oriented or keyframe.kind in FREE:
            # Before a row was seen hanging free, those in wells tell little.
            self._look_at_rows(row, finder)

    def judge(self, trajectory: int) -> Judged:
        """The trajectory is complete: its verdict, and what stands behind it."""
        if trajectory in self._blocks:
            return _unseen(self._blocks.pop(trajectory))
        row = self._rows.get(trajectory)
        if row is None:
            return super().judge(trajectory)
        finder = self._finders[row.head]
        self._look_at_rows(row, finder)
        nozzles = row.head[3]
        targets = row.last.targets or (None,) * len(nozzles)
        channels = []
        for number, (nozzle, well) in enumerate(zip(nozzles, targets, strict=True)):
            judged = None
            if number not in row.hidden and not row.trouble:
                judged = self._lane(row.head, nozzle).judge(trajectory)
            channels.append(Channel(nozzle, well, judged, number in row.hidden))
        self._close(trajectory)
        return row_verdict(row.last, channels, row.trouble, finder.assumed)

    def confirm(self, trajectory: int) -> None:
        """The operator looked at an undecided trajectory and found it right."""
        super().confirm(trajectory)
        for lane in self._lanes.values():
            lane.confirm(trajectory)

    def recall(self, history: Sequence[Judged]) -> None:
        """Restore the bands from what was judged before a restart."""
        single: list[Judged] = []
        for verdict, evidence in history:
            lanes = evidence.get("lanes") if isinstance(evidence, Mapping) else None
            if not isinstance(lanes, Mapping):
                single.append((verdict, evidence))
                continue
            for nozzle, its in lanes.items():
                mount = str(((its.get("calibration") or {}).get("stream") or [""])[0]).split(" ")[0]
                self._lane((mount, "", 0.0, ()), str(nozzle)).recall([(verdict, its)])
        super().recall(single)

    def _look_at_rows(self, row: _OpenRow, finder: RowFinder) -> None:
        found = {
            keyframe.sequence: finder.find(frame.image, keyframe)
            for keyframe, frame in sorted(row.waiting, key=lambda pair: pair[0].kind not in FREE)
            if is_image(frame.image)
        }
        for keyframe, frame in row.waiting:
            seen = found.get(keyframe.sequence)
            if seen is not None and keyframe.kind in FREE:
                row.trouble = row.trouble or seen.trouble
                row.hidden |= {n for n, hides in enumerate(seen.hidden) if hides}
            self._tell(row, keyframe, frame, seen)
        row.waiting.clear()

    def _tell(self, row: _OpenRow, keyframe: Keyframe, frame: Frame, seen: SeenRow | None) -> None:
        for number, nozzle in enumerate(row.head[3]):
            lane, one = self._lane(row.head, nozzle), channel_keyframe(keyframe, number)
            if seen is None or seen.trouble or seen.hidden[number]:
                lane.observe(one, NO_FRAME)
            elif number not in row.hidden:
                lane.see(one, frame, seen.tips[number])

    def _lane(self, head: Head, nozzle: str) -> Lane:
        key = head[0], nozzle
        if key not in self._lanes:
            self._lanes[key] = Lane(self, nozzle)
        return self._lanes[key]

    def _close(self, trajectory: int) -> None:
        row = self._rows.pop(trajectory)
        for nozzle in row.head[3]:
            self._lane(row.head, nozzle).forget(trajectory)


def _named(keyframe: Keyframe) -> Keyframe:
    """An older robot names no nozzles: eight are a column's."""
    if keyframe.nozzles or keyframe.channels != len(_COLUMN):
        return keyframe
    wells = keyframe.destinations
    return replace(keyframe, nozzles=_COLUMN, targets=wells if len(wells) == len(_COLUMN) else ())


def _unseen(keyframe: Keyframe) -> Judged:
    """The verdict on tips in several rows, which hide one another from any side."""
    nozzles = keyframe.nozzles or tuple(str(number + 1) for number in range(keyframe.channels))
    wells = keyframe.targets or keyframe.destinations
    each = wells if len(wells) == len(nozzles) else (None,) * len(nozzles)
    channels = [
        Channel(nozzle, well, hidden=True) for nozzle, well in zip(nozzles, each, strict=True)
    ]
    return row_verdict(keyframe, channels, "", assumed=False)
