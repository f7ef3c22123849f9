"""Rows of eight tips on photographs of a real OT-2: tips found, and columns read.

``git clone https://github.com/mast13f/OT2-Computer-Vision``
``python -m benchmarks.real_rows OT2-Computer-Vision [--weights FILE]``

A p300 with eight channels before three cameras (640x480). *Labelled*: frames with a box round every
tip, drawn by that repository's authors; in some the volume is part of the name. *Series*: ninety
frames of one camera, red dye in rising volumes. Which tips are missing there, and which stayed
empty, was read off the frames by eye; the volumes are those that fit the steps of the columns and
the tips' outer widths. On the series marked so the inside of the tip (``aegis_ot/vision/tips.py``)
was measured; all else was used for nothing.
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from aegis_ot.vision.column import Reference, TipShape, look_at_tip, read_column
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.outlines import Outlines
from aegis_ot.vision.rows.finder import RowFinder, SeenRow
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import Image, TipDetection
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef
from aegis_ot_lab.training.figures import overlap

SERIES_FOLDER = "Demo codes/default_project"
LABELLED = ("Model_YoloNAS_50 epoch_Tips_n_liquid/Dataset", "Experimental/Previous Data")
_CLOSE = "AI"
"""How names of the labelled frames of the close camera begin."""
FRAMES, CHANNELS, PIPETTE = 90, 8, "p300_multi_gen2"
ROWS = "ABCDEFGH"
CALIBRATION = 3
"""First rows of a series, on which its columns are calibrated."""


@dataclass(frozen=True)
class Series:
    """Frames in order, and their volumes, µL."""

    first: int
    count: int
    start_ul: float
    step_ul: float
    measured: bool = False
    """Whether the inside of the tips, as the package has it, was measured on these."""


SERIES = (
    Series(0, 12, 50, 20),
    Series(12, 8, 50, 20),
    Series(20, 12, 50, 20, measured=True),
    Series(32, 9, 50, 20),
    Series(42, 12, 50, 20),
    Series(54, 12, 100, 10, measured=True),
    Series(66, 12, 30, 10, measured=True),
    Series(78, 12, 40, 20),
)
MISSING = {
    1: (6,), 3: (3,), 5: (2, 5), 7: (1,), 8: (4,), 9: (2,), 10: (6,), 11: (3, 6), 12: (2, 5),
    13: (1, 6), 14: (2, 6), 15: (3,), 16: (1, 5), 17: (2, 5), 18: (5,), 19: (1,),
}  # fmt: skip
"""Channels without a tip, by frame; the leftmost is 0."""
EMPTY = {19: (0,), 40: (1,), 89: (0, 1, 2, 3, 5)}
"""Channels that drew air."""


def keyframe(number: int, volume_ul: float) -> Keyframe:
    """What a robot would have said of a frame: a loaded row, always at one place."""
    wells = tuple(WellRef("plate", f"{row}1", "plate", "2") for row in ROWS)
    return Keyframe(
        "photographs", number, number, KeyframeKind.TRANSIT, PIPETTE, "right", CHANNELS, "10:A1",
        (WellRef("trough", "A1", "trough", "1"),), wells, volume_ul, volume_ul, 300.0, "red",
        (100.0, 110.0, 130.0), nozzles=tuple(f"{row}1" for row in ROWS), targets=wells,
    )  # fmt: skip


Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Labelled:
    """A frame with the boxes of its tips, and of the liquid in them, px."""

    camera: str
    volume_ul: float | None
    image: Image
    tips: tuple[Box, ...]
    columns: tuple[Box, ...]


def labelled(root: Path) -> Iterator[Labelled]:
    """Every labelled frame, once."""
    seen = set()
    for folder in LABELLED:
        for path in sorted((root / folder).rglob("images/*.jpg")):
            name = re.sub(r"^[0-9a-f]{8}-", "", path.stem)
            text = path.parent.with_name("labels") / f"{path.stem}.txt"
            if name in seen or not text.exists():
                continue
            seen.add(name)
            image = read(path)
            height, width = image.shape[:2]
            boxes: dict[int, list[Box]] = {0: [], 1: []}
            for line in text.read_text().split("\n"):
                if not line.strip():
                    continue
                kind, x, y, w, h = map(float, line.split())
                box = ((x - w / 2) * width, (y - h / 2) * height, w * width, h * height)
                boxes.setdefault(int(kind), []).append(box)
            volume = re.search(r"_(\d+)ul", name)
            camera = "close camera" if name.startswith(_CLOSE) else "white panel"
            yield Labelled(
                camera,
                float(volume[1]) if volume else None,
                image,
                tuple(boxes[0]),
                tuple(boxes[1]),
            )


def read(path: Path) -> Image:
    image = cv2.imread(str(path))
    if image is None:
        raise SystemExit(f"{path} cannot be read as an image.")
    return image


def hits(tips: Sequence[TipDetection | None], boxes: Sequence[Box]) -> int:
    """How many boxes have a tip that overlaps them by more than half."""
    found = [(tip.x, tip.y, tip.w, tip.h) for tip in tips if tip is not None]
    return sum(any(overlap(box, one) > 0.5 for one in found) for box in boxes)


def drawn_volumes(frame: Labelled) -> Iterator[float]:
    """Volumes of the columns that the boxes show, µL."""
    geometry = tip_for(PIPETTE, 300.0)
    for x, top, *_ in frame.columns if frame.tips else ():
        _, tip_top, _, length = min(frame.tips, key=lambda tip: abs(tip[0] - x))
        yield geometry.volume_of((tip_top + length - top) / length * geometry.length_mm)


def judge_labelled(root: Path, detector: HeatmapDetector) -> None:
    """Print what is found in the labelled frames."""
    counts: Counter[tuple[str, str]] = Counter()
    off: list[float] = []
    drawn: list[float] = []
    for number, frame in enumerate(labelled(root)):
        row = RowFinder(detector, keyframe(0, 100.0), "left").find(
            frame.image, keyframe(number, 100.0)
        )
        shown = sum(tip is not None for tip in row.tips)
        which = frame.camera if frame.tips else "no tips"
        counts[which, "frames"] += 1
        counts[which, "tips"] += len(frame.tips)
        counts[which, "hits"] += hits(row.tips, frame.tips)
        counts[which, "whole"] += shown == len(frame.tips) == hits(row.tips, frame.tips)
        counts[which, "false"] += max(0, shown - len(frame.tips))
        if frame.volume_ul:
            drawn += [volume / frame.volume_ul - 1.0 for volume in drawn_volumes(frame)]
            off += [
                volume_read(frame.image, tip, frame.volume_ul) / frame.volume_ul - 1.0
                for tip in row.tips
                if tip is not None and hits([tip], frame.tips)
            ]
    for which in sorted({which for which, _ in counts}):
        of = {key: counts[which, key] for key in ("frames", "tips", "hits", "whole", "false")}
        print(
            f"  labelled, {which}: {of['whole']} of {of['frames']} frames right, "
            f"{of['hits']} of {of['tips']} tips found, {of['false']} that are none"
        )
    tell("columns of known volume", off)
    tell("the same as drawn by hand", drawn)


def volume_read(
    image: Image, tip: TipDetection, expected_ul: float, shape: TipShape | None = None
) -> float:
    """Of the column in a tip that should hold so much, µL."""
    geometry = tip_for(PIPETTE, 300.0)
    profile = look_at_tip(image, tip, geometry, shape=shape).profile
    top = read_column(profile, geometry, expected_ul, Reference()).top
    return geometry.volume_of((1.0 - top) * geometry.length_mm)


def tell(what: str, errors: Sequence[float]) -> None:
    """Print how well volumes are read."""
    off = np.array(errors)
    if len(off):
        print(
            f"  {what}: {len(off)} read, median error {np.median(off):+.1%}, "
            f"{np.mean(np.abs(off) <= 0.05):.0%} within 5 %, {np.mean(np.abs(off) <= 0.1):.0%} "
            "within 10 %"
        )


def rows(folder: Path, detector: HeatmapDetector) -> Iterator[tuple[int, Image, SeenRow]]:
    """Each frame of the series with what is found in it."""
    paths = sorted(folder.glob("*.jpg"))
    if len(paths) != FRAMES:
        raise SystemExit(f"{folder} holds {len(paths)} frames; {FRAMES} are known. See --help.")
    finder = RowFinder(detector, keyframe(0, 100.0), "left")
    for number, path in enumerate(paths):
        image = read(path)
        yield number, image, finder.find(image, keyframe(number, 100.0))


def columns(
    series: Series, seen: dict[int, tuple[Image, SeenRow]]
) -> Iterator[tuple[int, float, float]]:
    """Place in the series, volume read and true one of each column, µL.

    By the outline that its first rows show, as a run does it: see ``aegis_ot.vision.outlines``.
    """
    geometry, outlines = tip_for(PIPETTE, 300.0), Outlines()
    for number in range(series.first, series.first + CALIBRATION):
        image, row = seen[number]
        for tip in filter(None, row.tips):
            outlines.note(look_at_tip(image, tip, geometry))
    shape = outlines.best(geometry)
    for place in range(series.count):
        number, volume = series.first + place, series.start_ul + place * series.step_ul
        image, row = seen[number]
        for channel, tip in enumerate(row.tips):
            if tip is not None and channel not in EMPTY.get(number, ()):
                yield place, volume_read(image, tip, volume, shape), volume


def calibrated(read: Sequence[tuple[int, float, float]]) -> Iterator[float]:
    """Errors after the first rows, once these have shown how high columns stand, as a fraction.

    As a run does it: heights are off by one factor, see ``aegis_ot.vision.tip_scale``.
    """
    tip = tip_for(PIPETTE, 300.0)
    first = [(found, true) for place, found, true in read if place < CALIBRATION]
    if not first:
        return
    factor = np.median([tip.height_of(found) / tip.height_of(true) for found, true in first])
    for place, found, true in read:
        if place >= CALIBRATION:
            yield float(tip.volume_of(tip.height_of(found) / factor)) / true - 1.0


def judge_series(root: Path, detector: HeatmapDetector) -> None:
    """Print what is found in the series."""
    seen: dict[int, tuple[Image, SeenRow]] = {}
    right = found = false = 0
    for number, image, row in rows(root / SERIES_FOLDER, detector):
        seen[number] = image, row
        there = [channel not in MISSING.get(number, ()) for channel in range(CHANNELS)]
        shown = [tip is not None for tip in row.tips]
        right += there == shown
        found += sum(a and b for a, b in zip(there, shown, strict=True))
        false += sum(b and not a for a, b in zip(there, shown, strict=True))
    gaps = sum(map(len, MISSING.values()))
    print(
        f"  series: {right} of {FRAMES} frames right, {found} of {FRAMES * CHANNELS - gaps} tips "
        f"found, {false} of {gaps} gaps taken for a tip"
    )
    for measured, which in ((False, "other series"), (True, "series that shaped the geometry")):
        read = [list(columns(series, seen)) for series in SERIES if series.measured is measured]
        errors = [found / true - 1.0 for one in read for _, found, true in one]
        tell(f"columns of the {which}", errors)
        tell(
            f"the same after the first {CALIBRATION} rows, calibrated on these",
            [error for one in read for error in calibrated(one)],
        )


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.real_rows", description=__doc__)
    parser.add_argument("clone", type=Path, help="of the repository named above")
    parser.add_argument("--weights", type=Path, help="of another detector than the shipped one")
    asked = parser.parse_args()
    detector = HeatmapDetector(asked.weights)
    print("real frames, an OT-2's p300 with eight channels")
    judge_labelled(asked.clone, detector)
    judge_series(asked.clone, detector)


if __name__ == "__main__":
    main()
