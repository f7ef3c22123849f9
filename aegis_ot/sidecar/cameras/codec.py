"""JPEG to pixels and back, strictly."""

from __future__ import annotations

import cv2
import numpy as np

from ...errors import CameraError
from ...vision.types import Image

QUALITY = 92
MOST_BYTES = 30_000_000
MOST_PIXELS = 50_000_000
"""A camera gives less; a picture that says it is larger would only fill the memory."""

_ALONE = frozenset({0x00, 0x01, *range(0xD0, 0xDA)})
"""What follows 0xFF without a length after it."""


def decode_jpeg(jpeg: bytes) -> Image:
    """Decode a whole JPEG to BGR, ``uint8`` of shape ``(height, width, 3)``.

    Raises:
        CameraError: It is none, or it breaks off. OpenCV fills the rest of a cut-off JPEG with
            grey and says nothing, so the end marker is checked here.
    """
    if not jpeg.startswith(b"\xff\xd8"):
        raise CameraError(f"a frame of {len(jpeg)} bytes is not a JPEG")
    # Some cameras pad their frames with zeros.
    if not jpeg.rstrip(b"\0\r\n").endswith(b"\xff\xd9"):
        raise CameraError(f"a JPEG of {len(jpeg)} bytes breaks off before its end")
    width, height = _size(jpeg)
    if not width or not height:
        raise CameraError(f"a JPEG of {len(jpeg)} bytes does not tell its size")
    if len(jpeg) > MOST_BYTES or width * height > MOST_PIXELS:
        raise CameraError(
            f"a JPEG of {len(jpeg)} bytes, {width} x {height} px, is larger than any camera's"
        )
    try:
        image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error as error:
        raise CameraError(f"a JPEG of {len(jpeg)} bytes cannot be decoded: {error}") from error
    if image is None:
        raise CameraError(f"a JPEG of {len(jpeg)} bytes cannot be decoded")
    return np.asarray(image, dtype=np.uint8)


def _size(jpeg: bytes) -> tuple[int, int]:
    """Width and height that its header tells, px; 0, 0 where there is none.

    Whatever stands before a marker is passed over, as the decoder does it.
    """
    place = 2
    while 0 <= (place := jpeg.find(b"\xff", place)) <= len(jpeg) - 9:
        marker = jpeg[place + 1]
        if marker == 0xFF:  # fill byte
            place += 1
        elif marker in _ALONE:
            place += 2
        elif 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            height, width = jpeg[place + 5 : place + 7], jpeg[place + 7 : place + 9]
            return int.from_bytes(width, "big"), int.from_bytes(height, "big")
        else:
            place += 2 + int.from_bytes(jpeg[place + 2 : place + 4], "big")
    return 0, 0


def encode_jpeg(image: Image) -> bytes:
    """Encode BGR pixels as JPEG.

    Raises:
        CameraError: The array is no image.
    """
    try:
        ok, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    except cv2.error as error:
        raise CameraError(f"a frame cannot be encoded: {error}") from error
    if not ok:
        raise CameraError("a frame cannot be encoded")
    return bytes(data)
