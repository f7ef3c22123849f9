"""JPEG to pixels and back, strictly."""

from __future__ import annotations

import cv2
import numpy as np

from ...errors import CameraError
from ...vision.types import Image

QUALITY = 92


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
    try:
        image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error as error:
        raise CameraError(f"a JPEG of {len(jpeg)} bytes cannot be decoded: {error}") from error
    if image is None:
        raise CameraError(f"a JPEG of {len(jpeg)} bytes cannot be decoded")
    return np.asarray(image, dtype=np.uint8)


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
