"""Rows of eight tips on photographs of a real OT-2: tips found, and columns read.

``git clone https://github.com/mast13f/OT2-Computer-Vision``
``python -m benchmarks.real_rows "OT2-Computer-Vision/Demo codes/default_project" [--weights FILE]``

Ninety frames (640x480) of one camera beside one robot: a p300 with eight channels and red dye, in
eight series of rising volumes. Which tips are missing, and which stayed empty, was read off the
frames by eye. The volumes are not written down; those below are the ones that fit the steps of the
columns and the tips' outer widths (``aegis_ot/vision/tips.py``), whose inner profile comes from
the three series marked so. The other five were not used for anything.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from aegis_ot.vision.column.measure import measure_column
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.rows.finder import RowFinder, SeenRow
from aegis_ot.vision.types import Image
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

FRAMES, CHANNELS, PIPETTE = 90, 8, "p300_multi_gen2"
ROWS = "ABCDEFGH"


@dataclass(frozen=True)
class Series:
    """Frames in order, and their volumes, µL."""

    first: int
    count: int
    start_ul: float
    step_ul: float
    shaped: bool = False
    """Whether the tip's inner profile was found on it."""


SERIES = (
    Series(0, 12, 50, 20),
    Series(12, 8, 50, 20),
    Series(20, 12, 50, 20, shaped=True),
    Series(32, 9, 50, 20),
    Series(42, 12, 50, 20),
    Series(54, 12, 100, 10, shaped=True),
    Series(66, 12, 30, 10, shaped=True),
    Series(78, 12, 40, 20),
)
MISSING = {
    1: (6,), 3: (3,), 5: (2, 5), 7: (1,), 8: (4,), 9: (2,), 10: (6,), 11: (3, 6), 12: (2, 5),
    13: (1, 6), 14: (2, 5), 15: (3,), 16: (1, 5), 17: (2, 5), 18: (5,), 19: (1,),
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


def rows(folder: Path, detector: HeatmapDetector) -> Iterator[tuple[int, Image, SeenRow]]:
    """Each frame with what is found in it."""
    paths = sorted(folder.glob("*.jpg"))
    if len(paths) != FRAMES:
        raise SystemExit(f"{folder} holds {len(paths)} frames; {FRAMES} are known. See --help.")
    finder = RowFinder(detector, keyframe(0, 100.0), "left")
    for number, path in enumerate(paths):
        image = cv2.imread(str(path))
        if image is None:
            raise SystemExit(f"{path} cannot be read as an image.")
        yield number, image, finder.find(image, keyframe(number, 100.0))


def errors(series: Series, seen: dict[int, tuple[Image, SeenRow]]) -> list[float]:
    """How far each column is read from its volume, as a fraction of it."""
    found = []
    for place in range(series.count):
        number, volume = series.first + place, series.start_ul + place * series.step_ul
        image, row = seen[number]
        for channel, tip in enumerate(row.tips):
            if tip is not None and channel not in EMPTY.get(number, ()):
                column = measure_column(image, tip, PIPETTE, expected_ul=volume, capacity_ul=300.0)
                found.append(column.volume_ul / volume - 1.0)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.real_rows", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--weights", type=Path, help="of another detector than the shipped one")
    asked = parser.parse_args()
    seen: dict[int, tuple[Image, SeenRow]] = {}
    right = found = false = 0
    for number, image, row in rows(asked.folder, HeatmapDetector(asked.weights)):
        seen[number] = image, row
        there = [channel not in MISSING.get(number, ()) for channel in range(CHANNELS)]
        shown = [tip is not None for tip in row.tips]
        right += there == shown
        found += sum(a and b for a, b in zip(there, shown, strict=True))
        false += sum(b and not a for a, b in zip(there, shown, strict=True))
    gaps = sum(map(len, MISSING.values()))
    print("real frames, an OT-2's p300 with eight channels, red dye")
    print(f"  every tip and every gap right   {right} of {FRAMES} rows")
    print(f"  tips found                      {found} of {FRAMES * CHANNELS - gaps}")
    print(f"  gaps taken for a tip            {false} of {gaps}")
    for shaped, title in ((False, "series not used"), (True, "series that gave the profile")):
        off = np.array([e for s in SERIES if s.shaped is shaped for e in errors(s, seen)])
        if len(off):
            print(
                f"  columns, {title}: {len(off)} read, median error {np.median(off):+.1%}, "
                f"{np.mean(np.abs(off) <= 0.05):.0%} within 5 %, "
                f"{np.mean(np.abs(off) <= 0.1):.0%} within 10 %"
            )


if __name__ == "__main__":
    main()
