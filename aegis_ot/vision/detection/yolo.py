"""A user's own tip detector: a one-stage network exported by YOLOv8 (or alike) to ONNX."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from ...errors import ModelError
from ..types import Image, TipDetection
from .edges import axis_in_box
from .session import check_image, open_session

_GREY = 114  # the letterbox colour that YOLOv8 trains with
_FREE_SIDE = 640  # for exports whose input size is free: YOLOv8's default

Boxes = NDArray[np.float64]


class YoloDetector:
    """Runs a YOLOv8-style export and finds the tip axis inside its box.

    The file must have one input, ``float32`` ``(1, 3, height, width)``, RGB, 0 to 1,
    letterboxed with grey 114; and one output, ``float32`` ``(1, 4 + classes, n)``: for each of
    ``n`` boxes its centre x, centre y, width and height in px of the input, then one score from
    0 to 1 per class; more boxes than numbers per box. This is what ``yolo export format=onnx``
    writes (without ``nms=True`` and ``half=True``).

    Args:
        path: The ``.onnx`` file.
        tip_class: Index of the class that means "tip". If not given: the one whose name, as the
            export keeps it, has the word "tip" in it, else the first.
        threshold: Least score of a detection.
        threads: Threads that onnxruntime may use.

    Raises:
        ModelError: The file cannot be read or has another layout.
    """

    def __init__(
        self,
        path: str | Path,
        tip_class: int | None = None,
        threshold: float = 0.5,
        threads: int = 1,
    ) -> None:
        self._name = Path(path).name
        try:
            model = Path(path).read_bytes()
        except OSError as error:
            raise ModelError(f"The detector {self._name} cannot be read: {error}") from error
        self._session = open_session(model, threads, f"The detector {self._name}")
        self._class = _named_class(self._session) if tip_class is None else tip_class
        self.threshold = threshold
        inputs, outputs = self._session.get_inputs(), self._session.get_outputs()
        if len(inputs) != 1 or len(outputs) != 1:
            raise ModelError(
                f"The detector {self._name} has {len(inputs)} inputs and {len(outputs)} outputs; "
                "expected one image (1, 3, height, width) and one table (1, 4 + classes, n)."
            )
        shape = inputs[0].shape
        if len(shape) != 4 or shape[1] not in (3, *_free(shape[1])):
            raise ModelError(
                f"The detector {self._name} takes an input of shape {tuple(shape)}; expected one "
                "RGB image (1, 3, height, width)."
            )
        if all(isinstance(side, int) for side in outputs[0].shape):
            self._check_table(tuple(outputs[0].shape))
        if inputs[0].type != "tensor(float)":
            raise ModelError(
                f"The detector {self._name} takes {inputs[0].type}; expected float32. Export it "
                "without half precision."
            )
        sides = inputs[0].shape[2:]
        self._input = inputs[0].name
        self._height, self._width = (
            side if isinstance(side, int) and side > 0 else _FREE_SIDE for side in sides
        )

    def detect(self, image: Image) -> TipDetection | None:
        """The tip in a frame, ``None`` where there is none.

        Args:
            image: BGR, ``uint8``, shape ``(height, width, 3)``.

        Raises:
            ModelError: The network's output has another layout than documented.
            ValueError: The image has another shape or type.
        """
        check_image(image)
        canvas, scale, left, top = self._letterbox(image)
        boxes, scores = self._boxes(canvas)
        if not len(scores):
            return None
        best = int(np.argmax(scores))
        cx, cy, w, h = boxes[best]
        half = np.array((-0.5, 0.5))
        x0, x1 = np.clip((cx + half * w - left) / scale, 0, image.shape[1])
        y0, y1 = np.clip((cy + half * h - top) / scale, 0, image.shape[0])
        box = (float(x0), float(y0), float(x1 - x0), float(y1 - y0))
        collar, orifice = axis_in_box(image, *box)
        return TipDetection(*box, float(scores[best]), orifice, collar)

    def _letterbox(self, image: Image) -> tuple[NDArray[np.float32], float, int, int]:
        height, width = image.shape[:2]
        scale = min(self._width / width, self._height / height)
        w, h = max(1, round(width * scale)), max(1, round(height * scale))
        left, top = (self._width - w) // 2, (self._height - h) // 2
        canvas = np.full((self._height, self._width, 3), _GREY, np.uint8)
        mode = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
        canvas[top : top + h, left : left + w] = cv2.resize(image, (w, h), interpolation=mode)
        planes = canvas[..., ::-1].transpose(2, 0, 1)[None].astype(np.float32) / np.float32(255)
        return np.ascontiguousarray(planes), scale, left, top

    def _boxes(self, canvas: NDArray[np.float32]) -> tuple[Boxes, NDArray[np.float64]]:
        try:
            table = np.asarray(self._session.run(None, {self._input: canvas})[0])
        except Exception as error:  # onnxruntime raises its own, unexported exceptions
            raise ModelError(f"The detector {self._name} failed on an image: {error}") from error
        self._check_table(table.shape)
        rows = table[0].T.astype(np.float64)
        scores = rows[:, 4 + self._class]
        # A box counts for the tip only if no other class claims it more strongly.
        good = (scores >= self.threshold) & (scores >= rows[:, 4:].max(axis=1, initial=0.0))
        good &= np.isfinite(rows[:, :4]).all(axis=1) & (rows[:, 2] > 0) & (rows[:, 3] > 0)
        if good.any() and rows[good, :4].max() <= 2.0:
            raise ModelError(
                f"The detector {self._name} gives boxes in fractions of the image; expected px of "
                "its input. Export it with 'yolo export format=onnx'."
            )
        return rows[good, :4], np.clip(scores[good], 0.0, 1.0)

    def _check_table(self, shape: tuple[int, ...]) -> None:
        """Raises :class:`ModelError` unless it is the documented layout."""
        expected = f"expected (1, 4 + classes, n) with class {self._class} among the classes"
        if len(shape) != 3 or shape[0] != 1 or shape[1] < 5 + self._class:
            raise ModelError(
                f"The detector {self._name} gives an output of shape {shape}; {expected}."
            )
        if shape[1] > shape[2]:
            raise ModelError(
                f"The detector {self._name} gives an output of shape {shape}: its boxes are rows, "
                f"or have been sorted out already; {expected}. Export it without 'nms=True'."
            )


def _free(side: object) -> tuple[object, ...]:
    """The side itself if the export leaves it open (a name or nothing), else nothing."""
    return () if isinstance(side, int) else (side,)


def _named_class(session: Any) -> int:
    """Class whose name has the word "tip" in it, as YOLOv8 exports keep names; else 0."""
    names = session.get_modelmeta().custom_metadata_map.get("names", "")
    # A Python dictionary as text: {0: 'pipette tip', 1: 'rack'}.
    for number, name in re.findall(r"(\d+)\s*:\s*['\"]([^'\"]*)['\"]", names):
        if "tip" in re.split(r"[^a-z]+", name.lower()):
            return int(number)
    return 0
