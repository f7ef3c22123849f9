"""Replays a folder of frames: keyframe number n gets the n-th of them."""

from __future__ import annotations

import csv
import threading
import time
from pathlib import Path

from ...errors import CameraError
from ...vision.camera import Frame
from ...vocabulary import Keyframe, KeyframeKind
from .codec import decode_jpeg, encode_jpeg

SUFFIXES = {".jpg", ".jpeg", ".png"}


class FolderCamera:
    """Frames of a folder in the order of their names, or of a data set in its manifest's order.

    Keyframes choose by their sequence number, so a resent one gets the same frame again and a
    bad frame shifts nothing.

    Args:
        folder: Holds images, or a data set (``manifest.csv``).

    Raises:
        CameraError: There is no frame in it.
    """

    kind = "folder"

    def __init__(self, folder: Path) -> None:
        self._paths = _frames(folder)
        if not self._paths:
            raise CameraError(f"The folder {folder} holds no JPEG or PNG frames.")
        self._folder = folder
        self._number = threading.local()

    def announce(self, keyframe: Keyframe) -> None:
        """Choose the frame that this thread gets until it chooses another."""
        self._number.value, self._number.chosen = keyframe.sequence, True

    def frame_after(self, moment: float, timeout: float) -> Frame:
        """The frame chosen by :meth:`announce`; before that the next one. Exposed now.

        Raises:
            CameraError: The folder has no such frame, or it cannot be decoded.
        """
        number = getattr(self._number, "value", 0)
        if not getattr(self._number, "chosen", False):
            self._number.value = number + 1
        if number >= len(self._paths):
            raise CameraError(
                f"The folder {self._folder} has {len(self._paths)} frames; all are used up."
            )
        path = self._paths[number]
        try:
            data = path.read_bytes()
            if path.suffix.lower() == ".png":
                data = encode_jpeg(_decode_png(data))
            return Frame(data, decode_jpeg(data), max(moment, time.monotonic()), simulated=True)
        except (OSError, CameraError) as error:
            raise CameraError(f"Frame {path.name} of the folder camera: {error}") from error

    def close(self) -> None:
        """Nothing is held open."""


def _decode_png(data: bytes):  # type: ignore[no-untyped-def]
    import cv2
    import numpy as np

    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR) if data else None
    if image is None:
        raise CameraError("it cannot be decoded")
    return image


def _frames(folder: Path) -> list[Path]:
    manifest = folder / "manifest.csv"
    try:
        if manifest.is_file():
            with manifest.open(encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            return [folder / row[kind.value] for row in rows for kind in KeyframeKind]
        return sorted(p for p in folder.iterdir() if p.suffix.lower() in SUFFIXES)
    except (OSError, UnicodeDecodeError) as error:
        raise CameraError(f"Cannot read the folder {folder}: {error}") from error
    except (KeyError, TypeError, csv.Error) as error:
        raise CameraError(f"The manifest of {folder} lacks a column of frames: {error}") from error
