"""Frames of trajectory data sets as training material: labels, bare nozzles, other cameras."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from ..errors import DatasetError
from .axes import PlateCamera, TipLabel, rendered_labels
from .photometry import photograph
from .rooms import draw_room
from .transplant import transplanted

Image = NDArray[np.uint8]
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

    The axis follows from the plate's camera where ``meta.json`` gives one, and is the box's
    vertical centre line otherwise.

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


class FramePool:
    """Draws training frames from recorded ones, each as another camera might have seen it.

    Args:
        frames: What to draw from; the images are kept in memory.
    """

    def __init__(self, frames: Sequence[RecordedFrame]) -> None:
        self._frames = list(frames)
        self._images: list[Image] = []
        for frame in self._frames:
            image = cv2.imread(str(frame.path), cv2.IMREAD_COLOR)
            if image is None:
                raise DatasetError(f"{frame.path.name} is not an image that can be read.")
            self._images.append(image)
        by_plate: dict[str, list[int]] = {}
        for i, frame in enumerate(self._frames):
            by_plate.setdefault(frame.plate, []).append(i)
        # The pipette moves, the room does not: the median over a plate is the empty room.
        self._rooms = {
            plate: np.median([self._images[i] for i in members[:12]], axis=0).astype(np.uint8)
            for plate, members in by_plate.items()
            if len(members) >= 6 and len({self._images[i].shape for i in members}) == 1
        }

    def draw(self, rng: np.random.Generator) -> tuple[Image, TipLabel | None, TipLabel | None]:
        """A frame, its tip, and where a tip is missing from a bare nozzle, if it is known."""
        i = int(rng.integers(len(self._frames)))
        image, label, decoy = self._images[i], self._frames[i].label, None
        room = self._rooms.get(self._frames[i].plate)
        if room is not None and rng.random() < 0.45:
            background = draw_room(rng, image.shape[1], image.shape[0])
            image = transplanted(rng, image, room, background, label)
            room = background
        if label is not None and room is not None and rng.random() < 0.3:
            image, decoy, label = _without_tip(image, label, room), label, None
        return other_camera(rng, image, label, decoy)


def _without_tip(image: Image, label: TipLabel, room: Image) -> Image:
    """The frame with the tip replaced by the empty room behind it."""
    out = image.copy()
    (cx, cy), (ox, oy) = label.collar, label.orifice
    margin = 3 * label.radius
    x0, x1 = int(max(0, min(cx, ox) - margin)), int(max(cx, ox) + margin)
    y0, y1 = int(max(0, cy)), int(oy + 2 * margin)
    out[y0:y1, x0:x1] = room[y0:y1, x0:x1]
    return out


def other_camera(
    rng: np.random.Generator, image: Image, label: TipLabel | None, decoy: TipLabel | None
) -> tuple[Image, TipLabel | None, TipLabel | None]:
    """A frame and its labels zoomed, stretched, turned and shifted into a frame of another size."""
    height, width = image.shape[:2]
    out_w, out_h = ((640, 480), (960, 540), (640, 360), (800, 600))[int(rng.integers(4))]
    known = label or decoy
    length = known.length if known is not None else 0.25 * height
    low, high = np.log(50), np.log(0.8 * out_h)
    zoom = float(np.exp(rng.uniform(low, high))) / length
    if rng.random() < 0.4:  # about as it was framed
        zoom = out_w / width * float(np.exp(rng.normal(0, 0.12)))
    stretch = float(np.exp(rng.normal(0, 0.07)))
    angle = float(np.clip(rng.normal(0, 0.03), -0.1, 0.1))
    cos, sin = np.cos(angle), np.sin(angle)
    linear = np.array([[zoom * stretch * cos, -zoom * sin], [zoom * stretch * sin, zoom * cos]])
    if known is not None:
        ends = np.array([known.collar, known.orifice])
        middle = linear @ ends.mean(axis=0)
        half = abs(linear @ (ends[1] - ends[0]))[1] / 2
        free = max(4.0, out_h - 2 * half - 8)
        target = np.array([rng.uniform(0.06, 0.94) * out_w, 4 + half + rng.uniform(0, 1) * free])
        natural = middle + (np.array([out_w, out_h]) - linear @ [width, height]) / 2
        if rng.random() < 0.4 and half < natural[1] < out_h - half and 8 < natural[0] < out_w - 8:
            target = natural
        shift = target - middle
    else:
        shift = (np.array([out_w, out_h]) - linear @ [width, height]) / 2
    # OpenCV's coordinates count from the centre of the first pixel, the project's from its corner.
    offset = shift + linear @ [0.5, 0.5] - 0.5
    if zoom < 0.6:
        image = cv2.GaussianBlur(image, (0, 0), 0.4 / zoom)
    moved = cv2.warpAffine(
        image,
        np.hstack([linear, offset[:, None]]),
        (out_w, out_h),
        flags=cv2.INTER_LINEAR,
        # Mirrored borders would show the pipette twice.
        borderMode=cv2.BORDER_REPLICATE,
    )

    def carried(old: TipLabel | None) -> TipLabel | None:
        if old is None:
            return None
        collar = linear @ old.collar + shift
        orifice = linear @ old.orifice + shift
        return TipLabel(
            (float(collar[0]), float(collar[1])),
            (float(orifice[0]), float(orifice[1])),
            old.radius * zoom * stretch,
            tuple(tip for tip in map(carried, old.beside) if tip is not None),
        )

    return photograph(rng, moved, float(rng.uniform(0.2, 1.0))), carried(label), carried(decoy)
