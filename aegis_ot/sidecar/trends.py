"""How failures, holds, leftovers and sharpness went over the runs: drift before it hurts."""

from __future__ import annotations

import contextlib
import functools
import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import cv2

from ..errors import AegisError
from ..vocabulary import counted
from .aiming import sharpness
from .cameras.codec import decode_jpeg
from .store import Store
from .store.database import readable

RUNS = 40
"""So many of the newest runs are looked at."""
_FRAMES = 3
"""Frames of a run and group whose sharpness is measured."""
_EARLIER = 4
"""Runs before the newest without which nothing is said of it."""
_CHANCE = 0.01
_LEAST_LEFTOVER = 2.0
"""Percentage points of the volume below which a change of what stays in the tip is no drift."""
_SOFTER, _LONGER = 0.6, 3.0
"""Against the median of the runs before: sharpness below, seconds of waiting per well above it."""


class Group(NamedTuple):
    """What is compared with itself over the runs. ``lot`` is the label of the tip rack."""

    robot: str
    pipette: str
    liquid: str
    lot: str


@dataclass(frozen=True)
class TrendPoint:
    """One run of a group.

    Attributes:
        run: Its name.
        at: When it began, seconds since the epoch.
        wells: Deliveries with a verdict.
        failed, undecided: Of them, as they stand after the operator.
        hold_s: Mean time that the robot waited for a verdict, s per delivery.
        left_percent: Median of what stayed in the tip and should not have, % of the volume;
            ``None`` where the camera did not tell.
        sharpness: Median of a few frames, variance of the Laplacian at the tip; ``None`` if there
            are none.
    """

    run: str
    at: float
    wells: int
    failed: int
    undecided: int
    hold_s: float
    left_percent: float | None
    sharpness: float | None

    @property
    def failed_percent(self) -> float:
        """Of the deliveries."""
        return round(100.0 * self.failed / self.wells, 1)


@dataclass(frozen=True)
class Trend:
    """A group over the runs, oldest first; and what has changed in the newest one."""

    group: Group
    points: tuple[TrendPoint, ...]
    drifts: tuple[str, ...]


def trends_of(store: Store, runs: int = RUNS) -> list[Trend]:
    """Look at the newest runs, group by group. Simulated runs are groups of their own.

    Raises:
        StoreError: The store cannot be read.
    """
    points: dict[Group, list[TrendPoint]] = {}
    for row in reversed(store.runs("", runs)):
        racks = {str(one["slot"]): str(one["label"]) for one in row.get("racks") or ()}
        robot = str(row.get("robot_name") or row.get("robot") or "unnamed robot")
        robot += " (simulated)" if row["simulated"] else ""
        groups: dict[Group, list[dict[str, Any]]] = {}
        for well in store.judged_wells(row["run"]):
            lot = racks.get(str(well["tip"] or "").rpartition(":")[0], "")
            pipette, liquid = (str(well[name] or "-") for name in ("pipette", "reagent"))
            groups.setdefault(Group(robot, pipette, liquid, lot), []).append(well)
        for group, wells in groups.items():
            point = _point(store, row["run"], float(row["registered"]), wells)
            points.setdefault(group, []).append(point)
    return [Trend(group, tuple(of), tuple(_drifts(of))) for group, of in sorted(points.items())]


def _point(store: Store, run: str, at: float, wells: Sequence[dict[str, Any]]) -> TrendPoint:
    left = [
        100.0 * (float(well["left_ul"]) - float(well["expected_ul"] or 0.0)) / well["commanded_ul"]
        for well in wells
        if well["left_ul"] is not None and well["commanded_ul"]
    ]
    some = wells[:: max(1, len(wells) // _FRAMES)][:_FRAMES]
    places = tuple((int(well["sequence"]), str(well["boxes"] or "")) for well in some)
    return TrendPoint(
        run,
        at,
        len(wells),
        sum(well["outcome"] == "fail" for well in wells),
        sum(well["outcome"] == "undecided" for well in wells),
        round(sum(well["hold_s"] for well in wells) / len(wells), 2),
        round(statistics.median(left), 2) if left else None,
        _sharpness(store, run, places),
    )


@functools.lru_cache(maxsize=1000)
def _sharpness(store: Store, run: str, places: tuple[tuple[int, str], ...]) -> float | None:
    """A page that is opened again does not read the frames of forty runs again."""
    found = []
    for sequence, boxes in places:
        with contextlib.suppress(AegisError, ValueError, TypeError, cv2.error):
            jpeg = store.frame(run, sequence)
            if jpeg is not None:
                box = (readable(boxes, dict) or {}).get("post_dispense")
                grey = cv2.cvtColor(decode_jpeg(jpeg), cv2.COLOR_BGR2GRAY)
                found.append(sharpness(grey, tuple(map(float, box)) if box else None))
    return round(statistics.median(found), 1) if found else None


def _drifts(points: Sequence[TrendPoint]) -> list[str]:
    """What the newest run says against those before it."""
    *before, last = points
    if len(before) < _EARLIER:
        return []
    said = []
    wells, failed = sum(p.wells for p in before), sum(p.failed for p in before)
    rate = (failed + 1) / (wells + 2)
    if last.failed > 1 and _at_least(last.failed, last.wells, rate) < _CHANCE:
        said.append(
            f"{last.failed} of {counted(last.wells, 'well')} failed, before {failed} of {wells}."
        )
    left = [p.left_percent for p in before if p.left_percent is not None]
    if last.left_percent is not None and len(left) >= _EARLIER:
        middle = statistics.median(left)
        spread = 1.4826 * statistics.median(abs(one - middle) for one in left)
        if last.left_percent - middle > max(_LEAST_LEFTOVER, 4 * spread):
            said.append(f"{last.left_percent:.1f} % stays in the tip, before {middle:.1f} %.")
    sharp = [p.sharpness for p in before if p.sharpness is not None]
    if last.sharpness is not None and len(sharp) >= _EARLIER:
        usual = statistics.median(sharp)
        if last.sharpness < min(_SOFTER * usual, *sharp):
            said.append(
                f"The camera is softer: sharpness {last.sharpness:.0f}, before {usual:.0f}."
            )
    usual = statistics.median(p.hold_s for p in before)
    if last.hold_s - usual > 1.0 and last.hold_s > _LONGER * usual:
        said.append(f"The robot waits {last.hold_s:.1f} s per well, before {usual:.1f} s.")
    return said


def _at_least(count: int, of: int, rate: float) -> float:
    """How likely so many are by chance."""

    def chance(n: int) -> float:  # by logarithms: the binomials of a big run are beyond a float
        ways = math.lgamma(of + 1) - math.lgamma(n + 1) - math.lgamma(of - n + 1)
        return math.exp(ways + n * math.log(rate) + (of - n) * math.log1p(-rate))

    return sum(map(chance, range(count, of + 1)))
