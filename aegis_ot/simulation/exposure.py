"""From light to a finished frame: exposure, noise, clipping, JPEG."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from ..errors import CameraError
from ..vision.types import Image
from .session import SessionParameters

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
    light = np.maximum(light, np.float32(0))
    sigma = cv2.sqrt(light * np.float32(0.5 / MID_GREY) + np.float32(0.5))
    sigma *= _noise(light.shape[0], light.shape[1], rng)
    sigma *= np.float32(parameters.noise)
    sigma += light
    return np.asarray(cv2.convertScaleAbs(np.maximum(sigma, np.float32(0), out=sigma)), np.uint8)


_MARGIN = 192


@lru_cache(maxsize=4)
def _noise_bank(height: int, width: int) -> NDArray[np.float32]:
    """Noise of unit variance, larger than a frame by a margin; read only."""
    rng = np.random.default_rng((height, width, 11))
    raw = rng.standard_normal((height + _MARGIN, width + _MARGIN, 3), dtype=np.float32)
    line = cv2.getGaussianKernel(3, 0.45)
    smooth = cv2.GaussianBlur(raw, (3, 3), 0.45) / np.float32(np.sum(line**2))
    smooth.setflags(write=False)
    return np.asarray(smooth, np.float32)


def _noise(height: int, width: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """A window of the bank at a random place, randomly mirrored and inverted.

    Drawing a million normal numbers anew would cost half of a frame's time; of some 300,000
    windows hardly two ever meet.
    """
    bank = _noise_bank(height, width)
    y, x = (int(v) for v in rng.integers(0, _MARGIN + 1, 2))
    flip_y, flip_x, sign = (int(v) for v in rng.choice([-1, 1], 3))
    window = bank[y : y + height, x : x + width][::flip_y, ::flip_x]
    return window if sign > 0 else -window


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
