"""What a camera does to a scene: exposure, colour, blur, noise, compression; drawn at random."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]


def photograph(rng: np.random.Generator, image: Image, strength: float = 1.0) -> Image:
    """The image as one of many cameras would have taken it.

    Args:
        rng: Source of every choice.
        image: BGR, shape ``(height, width, 3)``.
        strength: 1 for a drawn scene; less for an image that a camera has taken already.
    """
    height, width = image.shape[:2]
    values = np.arange(256, dtype=np.float32) / 255
    gamma = np.exp(rng.normal(0, 0.3 * strength))
    gain = np.exp(rng.normal(0, 0.3 * strength))
    if rng.random() < 0.05:  # now and then one frame is far overexposed
        gain *= rng.uniform(1.8, 3.5)
    lift = rng.uniform(-0.04, 0.08) * strength
    balance = np.exp(rng.normal(0, 0.1 * strength, 3))
    table = np.clip(255 * (gain * balance[None] * (values**gamma)[:, None] + lift), 0, 255)
    out = cv2.LUT(image, table.astype(np.uint8)[None].reshape(1, 256, 3))
    if rng.random() < 0.15:
        out = cv2.cvtColor(cv2.cvtColor(out, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR)
    sigma = rng.uniform(0, 1.6) * strength * max(1.0, height / 480)
    if sigma > 0.3 and rng.random() < 0.7:
        out = cv2.GaussianBlur(out, (0, 0), sigma)
    if rng.random() < 0.08:  # the robot still moved
        span = int(rng.integers(3, 8))
        kernel = np.zeros((span, span), np.float32)
        if rng.random() < 0.5:
            kernel[:, span // 2] = 1 / span
        else:
            kernel[span // 2] = 1 / span
        out = cv2.filter2D(out, -1, kernel)
    if rng.random() < 0.8:
        noise = np.empty((height, width, 3), np.int16)
        cv2.setRNGSeed(int(rng.integers(1 << 30)))
        cv2.randn(noise, 0, float(rng.uniform(0.5, 10) * strength))
        if rng.random() < 0.3:  # coarse, as after in-camera denoising
            noise = cv2.blur(noise, (2, 2)) * 2
        out = np.clip(out.astype(np.int16) + noise, 0, 255).astype(np.uint8)
    if rng.random() < 0.5:
        quality = int(rng.uniform(30, 95))
        out = cv2.imdecode(cv2.imencode(".jpg", out, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], 1)
    return np.ascontiguousarray(out)
