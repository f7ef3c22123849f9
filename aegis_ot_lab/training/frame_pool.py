"""Training frames drawn from recorded ones: other rooms, bare nozzles, other cameras."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from aegis_ot.errors import DatasetError

from .axes import TipLabel
from .photometry import photograph
from .recorded import RecordedFrame
from .rooms import draw_room
from .transplant import transplanted

Image = NDArray[np.uint8]


class FramePool:
    """Draws training frames from recorded ones, each as another camera might have seen it.

    A data set is drawn as often as the fourth root of its size says: a large one teaches most,
    and does not drown a small one.

    Args:
        frames: What to draw from; the images are kept in memory.

    Attributes:
        chances: Of each frame, adding up to 1.
    """

    def __init__(self, frames: Sequence[RecordedFrame]) -> None:
        self._frames = list(frames)
        self._images: list[Image] = []
        for frame in self._frames:
            image = cv2.imread(str(frame.path), cv2.IMREAD_COLOR)
            if image is None:
                raise DatasetError(f"{frame.path.name} is not an image that can be read.")
            self._images.append(image)
        self._rooms = self._empty_rooms()
        sets = [frame.plate.partition("/")[0] for frame in self._frames]
        weights = np.array([sets.count(name) ** -0.75 for name in sets])
        self.chances = weights / weights.sum()

    def _empty_rooms(self) -> dict[str, Image]:
        """The room of each plate without the pipette, where it can be had.

        The pipette moves, the room does not: the median over frames is the empty room, if
        no place is covered in half of them. Frames are in the order of a run, every second pair
        at the source: an odd number of them leaves it in the minority.
        """
        by_plate: dict[str, list[int]] = {}
        for i, frame in enumerate(self._frames):
            by_plate.setdefault(frame.plate, []).append(i)
        rooms = {}
        for plate, members in by_plate.items():
            chosen = members[1:12]
            if len(chosen) < 5 or len({self._images[i].shape for i in chosen}) > 1:
                continue
            images = [self._images[i] for i in chosen]
            if _moves([self._frames[i].label for i in chosen], images[0].shape[1]):
                rooms[plate] = np.median(images, axis=0).astype(np.uint8)
        return rooms

    def draw(self, rng: np.random.Generator) -> tuple[Image, TipLabel | None, TipLabel | None]:
        """A frame, its tip, and where a tip is missing from a bare nozzle, if it is known."""
        i = int(rng.choice(len(self._frames), p=self.chances))
        image, label, decoy = self._images[i], self._frames[i].label, None
        room = self._rooms.get(self._frames[i].plate)
        if room is not None and rng.random() < 0.45:
            background = draw_room(rng, image.shape[1], image.shape[0])
            image = transplanted(rng, image, room, background, label)
            room = background
        if label is not None and room is not None and rng.random() < 0.3:
            image, decoy, label = _without_tip(image, label, room), label, None
        return other_camera(rng, image, label, decoy)


def _moves(labels: Sequence[TipLabel | None], width: int) -> bool:
    """Whether no column of the picture has a tip in half of these frames."""
    covered = np.zeros(width, np.int64)
    shown = [label for label in labels if label is not None]
    for label in shown:
        ends = [x for tip in (label, *label.beside) for x in (tip.collar[0], tip.orifice[0])]
        left, right = min(ends) - 3 * label.radius, max(ends) + 3 * label.radius
        covered[max(0, int(left)) : max(0, int(right))] += 1
    return bool(covered.max() * 2 < len(labels))


def _without_tip(image: Image, label: TipLabel, room: Image) -> Image:
    """The frame with the tip, or the whole row, replaced by the empty room behind it."""
    out = image.copy()
    for tip in (label, *label.beside):
        (cx, cy), (ox, oy) = tip.collar, tip.orifice
        margin = 3 * tip.radius
        x0, x1 = int(max(0, min(cx, ox) - margin)), int(max(0, max(cx, ox) + margin))
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
