"""Reading the tables of a data set, with every fault noted by row and column."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import cv2
import numpy as np

from ..vocabulary import FAILURES, KeyframeKind
from .tables import Note, Problems, number, read_table
from .tips import pipette_class, tip_for
from .types import Position

FRAME_COLUMNS = tuple(kind.value for kind in KeyframeKind)
COLUMNS = (
    "trajectory_id",
    "plate",
    "well",
    "pipette",
    "reagent",
    "label",
    "failure_type",
    "retained_fraction",
    "volume_ul",
    *FRAME_COLUMNS,
)
READY = "ready"
"""A fifth frame: the trajectory's tip while it was still empty. It is checked and not used."""
BOX_COLUMNS = ("frame", "x", "y", "w", "h")
AXIS_COLUMNS = ("frame", "collar_x", "collar_y", "orifice_x", "orifice_y")
POSITION_COLUMNS = ("trajectory_id", "keyframe", "x", "y", "z")
LABELS = ("normal", "failure")
FAILURE_TYPES = (
    "partial_25",
    "partial_50",
    "partial_75",
    "partial_accumulated",
    *(known.label for known in FAILURES.values() if known.label),
)
_WELL = re.compile(r"[A-Z]{1,2}[1-9][0-9]?")
_PIPETTE = re.compile(r"p[1-9][0-9]*|flex_[0-9]{1,2}channel_[1-9][0-9]*|p[1-9][0-9]*_[a-z0-9_]+")

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Record:
    """One row of the manifest; frame paths are relative to the data set's folder."""

    id: str
    plate: str
    well: str
    pipette: str
    reagent: str
    label: str
    failure_type: str
    retained_fraction: float | None
    volume_ul: float
    frames: Mapping[KeyframeKind, str]
    ready: str = ""


def in_data_sets(pipette: str) -> str:
    """A pipette as data sets name it: by its class, or in full where the class means other tips."""
    short = pipette_class(pipette)
    return short if tip_for(short) is tip_for(pipette) else pipette


def read_manifest(root: Path, problems: Problems) -> list[Record]:
    """Rows of ``manifest.csv`` that could be read; faults go to ``problems``."""
    rows = read_table(root / "manifest.csv", COLUMNS, problems, (READY,))
    records: list[Record] = []
    first_rows: dict[str, dict[str, int]] = {"trajectory_id": {}, "frame": {}, "plate": {}}
    for line, row in rows:
        note = Note(problems, "manifest.csv", line)
        for column in ("trajectory_id", "plate", "pipette", "well"):
            if not row[column]:
                note(column, "is empty")
        name = row["trajectory_id"]
        first = first_rows["trajectory_id"].setdefault(name, line)
        if name and first != line:
            note("trajectory_id", f"{name!r} stands in row {first} already")
        volume, retained = _check_values(row, note)
        for column in (*FRAME_COLUMNS, *([READY] if row[READY] else [])):
            _check_frame(root, row[column], column, note)
            first = first_rows["frame"].setdefault(row[column], line)
            if row[column] and first != line:
                note(column, f"{row[column]!r} is also named in row {first}")
        first_rows["plate"].setdefault(row["plate"], line)
        records.append(
            Record(
                name,
                row["plate"],
                row["well"],
                row["pipette"],
                row["reagent"],
                row["label"],
                row["failure_type"],
                retained,
                volume,
                {KeyframeKind(column): row[column] for column in FRAME_COLUMNS},
                row[READY],
            )
        )
    normal_plates = {row["plate"] for _, row in rows if row["label"] == "normal"}
    for plate, line in first_rows["plate"].items():
        if plate and plate not in normal_plates:
            said = f"{plate!r} has no normal row, so it has no calibration well"
            problems.add("manifest.csv", line, "plate", said)
    if not rows and not problems:
        problems.add("manifest.csv", None, None, "has no rows")
    return records


def _check_values(row: Mapping[str, str], note: Note) -> tuple[float, float | None]:
    """Of one row the volume, µL, NaN where it is wrong, and the retained fraction."""
    if row["well"] and not _WELL.fullmatch(row["well"]):
        note("well", f"{row['well']!r} is no well name such as A1")
    if row["pipette"] and not _PIPETTE.fullmatch(row["pipette"]):
        known = "p20, p1000 or flex_1channel_50"
        note("pipette", f"{row['pipette']!r} is no pipette such as {known}")
    _check_label(row, note)
    volume = number(row["volume_ul"], "volume_ul", note)
    if volume is not None and volume <= 0:
        note("volume_ul", f"{row['volume_ul']} must be more than 0")
    retained = None
    if row["retained_fraction"]:
        retained = number(row["retained_fraction"], "retained_fraction", note)
        if retained is not None and retained < 0:
            note("retained_fraction", f"{row['retained_fraction']} must not be negative")
    return math.nan if volume is None else volume, retained


def read_boxes(
    root: Path, records: Sequence[Record], problems: Problems
) -> tuple[dict[str, Box | None], list[str]]:
    """Boxes by frame, and what is odd about them without being wrong."""
    path = root / "boxes.csv"
    boxes: dict[str, Box | None] = {}
    if not path.exists():
        return boxes, []
    lines: dict[str, int] = {}
    for line, row in read_table(path, BOX_COLUMNS, problems):
        note = Note(problems, "boxes.csv", line)
        frame = row["frame"]
        if not frame:
            note("frame", "is empty")
            continue
        if frame in lines:
            note("frame", f"{frame!r} stands in row {lines[frame]} already")
            continue
        lines[frame] = line
        cells = [row[column] for column in ("x", "y", "w", "h")]
        if not any(cells):
            boxes[frame] = None
            continue
        numbers = [
            number(cell, column, note)
            for cell, column in zip(cells, ("x", "y", "w", "h"), strict=True)
        ]
        for column, side in zip(("w", "h"), numbers[2:], strict=True):
            if side is not None and side <= 0:
                note(column, f"{side:g} must be more than 0")
        x, y, w, h = (0.0 if number is None else number for number in numbers)
        boxes[frame] = (x, y, w, h)
    named = {frame for record in records for frame in record.frames.values()}
    known = named | {record.ready for record in records}
    warnings = []
    if extra := [frame for frame in boxes if frame not in known]:
        warnings.append(f"boxes.csv: {len(extra)} rows name frames that no trajectory uses")
    if lacking := [frame for frame in named if frame not in boxes]:
        warnings.append(f"boxes.csv: {len(lacking)} frames have no row")
    return boxes, warnings


def read_positions(
    root: Path, records: Sequence[Record], problems: Problems
) -> tuple[dict[str, dict[KeyframeKind, Position]], list[str]]:
    """Where the tip's end was, mm on the deck, by trajectory, and what is odd about it without
    being wrong; empty without ``positions.csv``."""
    path = root / "positions.csv"
    positions: dict[str, dict[KeyframeKind, Position]] = {}
    if not path.exists():
        return positions, []
    strangers = 0
    known = {record.id for record in records}
    for line, row in read_table(path, POSITION_COLUMNS, problems):
        note = Note(problems, "positions.csv", line)
        name, kind = row["trajectory_id"], row["keyframe"]
        if name not in known:
            strangers += 1  # of a trajectory that was taken out of the set, or mistyped
            continue
        if kind == READY:
            continue
        if kind not in FRAME_COLUMNS:
            note("keyframe", f"{kind!r} must be one of {', '.join(FRAME_COLUMNS)}")
            continue
        x, y, z = (number(row[axis], axis, note) for axis in "xyz")
        of_well = positions.setdefault(name, {})
        if KeyframeKind(kind) in of_well:
            note("keyframe", f"{kind!r} of {name!r} stands in an earlier row already")
        if x is not None and y is not None and z is not None:
            of_well[KeyframeKind(kind)] = (x, y, z)
    odd = f"positions.csv: {strangers} rows name trajectories that manifest.csv does not have"
    return positions, [odd] if strangers else []


def _check_label(row: Mapping[str, str], note: Note) -> None:
    label, failure = row["label"], row["failure_type"]
    if label not in LABELS:
        note("label", f"{label!r} must be one of {', '.join(LABELS)}")
    elif label == "normal" and failure:
        note("failure_type", f"{failure!r} on a normal row; it must be empty there")
    elif label == "failure" and failure not in FAILURE_TYPES:
        note("failure_type", f"{failure!r} must be one of {', '.join(FAILURE_TYPES)}")


def _check_frame(root: Path, cell: str, column: str, note: Note) -> None:
    if not cell:
        note(column, "is empty")
        return
    relative = PurePosixPath(cell)
    if relative.is_absolute() or ".." in relative.parts or "\\" in cell:
        note(column, f"{cell!r} must be a path inside the data set's folder")
        return
    try:
        data = (root / relative).read_bytes()
    except FileNotFoundError:
        note(column, f"{cell!r} does not exist")
        return
    except (OSError, ValueError) as error:
        note(column, f"{cell!r} cannot be read ({error})")
        return
    if reason := unreadable(data):
        note(column, f"{cell!r} {reason}")


def unreadable(data: bytes) -> str:
    """Why ``data`` is no whole JPEG or PNG image; empty if it is one.

    A truncated JPEG still decodes, with its lower part grey, so the end marker is looked for.
    """
    if data.startswith(b"\xff\xd8\xff"):
        if b"\xff\xd9" not in data[-64:]:
            return "is a truncated JPEG"
    elif data.startswith(b"\x89PNG\r\n\x1a\n"):
        if b"IEND" not in data[-64:]:
            return "is a truncated PNG"
    else:
        return "is neither JPEG nor PNG"
    buffer = np.frombuffer(data, dtype=np.uint8)
    try:
        image = cv2.imdecode(buffer, cv2.IMREAD_REDUCED_GRAYSCALE_8)
    except cv2.error:
        image = None
    return "" if image is not None and image.size else "cannot be decoded"
