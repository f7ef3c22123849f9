"""From light to a finished frame: exposure, noise, clipping, JPEG."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from ..errors import CameraError
from ..vision.types import Image
from .scene import SessionParameters

MID_GREY = 110.0
"""Level at which :attr:`SessionParameters.noise` is stated, grey levels."""


def frame_gain(parameters: SessionParameters, rng: np.random.Generator) -> float:
    """Exposure of one frame relative to the session's: small drift, now and then far over."""
    if rng.random() < parameters.overexposed_chance:
        return parameters.overexposed_gain
    return float(np.exp(rng.normal(0.0, parameters.exposure_jitter)))


def expose(
    light: NDArray[np.float32], parameters: SessionParameters, rng: np.random.Generator
) -> Image:
    """Add noise to an image in grey levels and round it to 8 bits.

    Noise has a constant part and one that grows with the root of the signal (shot noise), half
    of the variance each at mid grey; it is slightly correlated between neighbours, as a
    webcam's demosaicing leaves it.
    """
    raw = rng.standard_normal(light.shape, dtype=np.float32)
    # This kernel keeps 0.79 of the standard deviation; the factor below restores it.
    smooth = cv2.GaussianBlur(raw, (3, 3), 0.45)
    sigma = cv2.sqrt(np.maximum(light, 0.0) * np.float32(0.5 / MID_GREY) + np.float32(0.5))
    noisy = light + sigma * smooth * np.float32(parameters.noise * _noise_factor())
    return cv2.convertScaleAbs(np.maximum(noisy, 0.0))  # type: ignore[no-any-return]


def _noise_factor() -> float:
    line = cv2.getGaussianKernel(3, 0.45)
    return float(1.0 / np.sum(line**2))


def encode(image: Image, quality: int) -> bytes:
    """JPEG bytes of a frame.

    Raises:
        CameraError: The encoder failed.
    """
    done, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    if not done:
        raise CameraError("The simulated frame could not be encoded as JPEG.")
    return bytes(data.tobytes())


def decode(jpeg: bytes) -> Image:
    """The frame that JPEG bytes hold, BGR.

    Raises:
        CameraError: The bytes are no image.
    """
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise CameraError("The simulated frame could not be decoded.")
    return np.asarray(image, np.uint8)
