"""Frames of trajectory data sets as training material, with their labels."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from aegis_ot.errors import DatasetError

from .axes import PlateCamera, TipLabel, rendered_labels

_AXIS = ("collar_x", "collar_y", "orifice_x", "orifice_y")
TipAxis = tuple[tuple[float, float], tuple[float, float]]
_KEYFRAMES = ("aspirate", "transit", "dispense", "post_dispense")


@dataclass(frozen=True)
class RecordedFrame:
    """One frame of a data set.

    Attributes:
        path: The image file.
        plate: Unit of camera pose and lighting, unique over all data sets.
        label: The tip; ``None`` where ``boxes.csv`` says that there is none.
        box: ``x, y, w, h`` as ``boxes.csv`` gives it, px; ``None`` where there is no tip.
    """

    path: Path
    plate: str
    label: TipLabel | None
    box: tuple[float, float, float, float] | None


def read_frames(folder: Path) -> list[RecordedFrame]:
    """All frames of a data set that has ``boxes.csv``, in its order.

    The axis is that of ``axes.csv`` where the frame has a row there; else it follows from the
    plate's camera where ``meta.json`` gives one, and is the box's vertical centre line otherwise.

    Raises:
        DatasetError: A file is missing or a row cannot be used; every bad row is listed.
    """
    plates = _plates(folder)
    rows = _rows(folder / "boxes.csv")
    problems: list[str] = []
    read: list[tuple[Path, str, tuple[float, float, float, float] | None]] = []
    for number, row in enumerate(rows, start=2):
        name = (row.get("frame") or "").strip()
        if name not in plates:
            problems.append(
                f"boxes.csv row {number}, column frame: {name!r} is not in manifest.csv"
            )
            continue
        if not (folder / name).is_file():
            problems.append(f"boxes.csv row {number}, column frame: {name!r} does not exist")
            continue
        cells = [(row.get(key) or "").strip() for key in ("x", "y", "w", "h")]
        if not any(cells):
            read.append((folder / name, plates[name], None))
            continue
        try:
            x, y, w, h = (float(cell) for cell in cells)
        except ValueError:
            problems.append(f"boxes.csv row {number}: {', '.join(cells)!r} are not four numbers")
            continue
        if not (np.isfinite([x, y, w, h]).all() and w > 0 and h > 0):
            problems.append(f"boxes.csv row {number}: w and h must be positive, got {cells}")
            continue
        read.append((folder / name, plates[name], (x, y, w, h)))
    if problems:
        raise DatasetError(f"{folder.name}:\n" + "\n".join(problems))
    if not any(box is not None for _, _, box in read):
        raise DatasetError(f"{folder.name}: boxes.csv has no tip box to learn from.")
    labels = _labels(folder, [(plate, box) for _, plate, box in read])
    shown = {path.relative_to(folder).as_posix() for path, _, box in read if box is not None}
    axes = _axes(folder, shown)
    for i, (path, _, box) in enumerate(read):
        given = axes.get(path.relative_to(folder).as_posix())
        if box is not None and given:
            labels[i] = _label(given, box)
    return [
        RecordedFrame(path, f"{folder.name}/{plate}", label, box)
        for (path, plate, box), label in zip(read, labels, strict=True)
    ]


def _rows(path: Path) -> list[dict[str, str]]:
    try:
        with path.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise DatasetError(f"{path.parent.name}: {path.name} cannot be read: {error}") from error


def _plates(folder: Path) -> dict[str, str]:
    plates = {}
    for row in _rows(folder / "manifest.csv"):
        for keyframe in _KEYFRAMES:
            if row.get(keyframe):
                plates[row[keyframe]] = row.get("plate") or ""
    return plates


def _axes(folder: Path, frames: set[str]) -> dict[str, list[TipAxis]]:
    """Collars and orifices by frame, of the optional ``axes.csv``."""
    if not (folder / "axes.csv").exists():
        return {}
    axes: dict[str, list[TipAxis]] = {}
    problems: list[str] = []
    for line, row in enumerate(_rows(folder / "axes.csv"), start=2):
        name = (row.get("frame") or "").strip()
        cells = [(row.get(column) or "").strip() for column in _AXIS]
        try:
            x0, y0, x1, y1 = (float(cell) for cell in cells)
        except ValueError:
            x0 = y0 = x1 = y1 = np.nan
        if not np.isfinite([x0, y0, x1, y1]).all():
            problems.append(f"axes.csv row {line}: {', '.join(cells)!r} are not four numbers")
        elif name not in frames:
            problems.append(f"axes.csv row {line}, column frame: {name!r} has no box in boxes.csv")
        else:
            axes.setdefault(name, []).append(((x0, y0), (x1, y1)))
    if problems:
        raise DatasetError(f"{folder.name}:\n" + "\n".join(problems))
    return axes


def _label(axes: Sequence[TipAxis], box: tuple[float, float, float, float]) -> TipLabel:
    """The tip of the box, and those beside it; a tip is widest at its collar, inside its box."""
    x, y, w, h = box
    middle = np.array([x + w / 2, y + h / 2])
    own, *others = sorted(axes, key=lambda axis: float(np.hypot(*(np.mean(axis, 0) - middle))))
    radius = max(0.5, min(own[0][0] - x, x + w - own[0][0]))
    beside = tuple(TipLabel(collar, orifice, radius) for collar, orifice in others)
    return TipLabel(*own, radius, beside)


def _labels(
    folder: Path, frames: Sequence[tuple[str, tuple[float, float, float, float] | None]]
) -> list[TipLabel | None]:
    cameras = _cameras(folder, [plate for plate, _ in frames])
    shown = [i for i, (_, box) in enumerate(frames) if box is not None]
    labels: list[TipLabel | None] = [None] * len(frames)
    if cameras is not None:
        boxes = np.array([frames[i][1] for i in shown], dtype=np.float64)
        for i, label in zip(
            shown, rendered_labels([cameras[i] for i in shown], boxes), strict=True
        ):
            labels[i] = label
        return labels
    for i in shown:
        box = frames[i][1]
        assert box is not None
        x, y, w, h = box
        labels[i] = TipLabel((x + w / 2, y), (x + w / 2, y + h), w / 2)
    return labels


def _cameras(folder: Path, plates: Sequence[str]) -> list[PlateCamera] | None:
    """The camera of each frame; ``None`` if ``meta.json`` does not give them all."""
    try:
        meta = json.loads((folder / "meta.json").read_text(encoding="utf-8"))
        cameras = [PlateCamera.from_meta(plate) for plate in meta["plates"]]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    order = {plate: i for i, plate in enumerate(dict.fromkeys(plates))}
    if len(order) != len(cameras):
        return None
    return [cameras[order[plate]] for plate in plates]
