"""What a camera does to a scene: exposure, colour, blur, noise, compression; drawn at random."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from .axes import TipLabel

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
    if rng.random() < 0.12 * strength:  # a coarser sensor, or a stream scaled up
        coarse = rng.uniform(1.2, 2.2)
        small = (round(width / coarse), round(height / coarse))
        out = cv2.resize(cv2.resize(out, small, interpolation=cv2.INTER_AREA), (width, height))
    if rng.random() < 0.08:  # the robot still moved
        span = int(rng.integers(3, 8))
        kernel = np.zeros((span, span), np.float32)
        if rng.random() < 0.5:
            kernel[:, span // 2] = 1 / span
        else:
            kernel[span // 2] = 1 / span
        out = cv2.filter2D(out, -1, kernel)
    if rng.random() < 0.25:  # webcams sharpen: halos along every edge
        soft = cv2.GaussianBlur(out, (0, 0), rng.uniform(0.8, 2.0))
        amount = rng.uniform(0.3, 1.5) * strength
        out = cv2.addWeighted(out, 1 + amount, soft, -amount, 0)
    if rng.random() < 0.2 * strength:
        out = _shaded(rng, out)
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


def shows(image: Image, label: TipLabel | None) -> bool:
    """Whether anything at all is to be seen where a label is: exposure may have burnt it out."""
    if label is None:
        return True
    (cx, cy), (ox, oy) = label.collar, label.orifice
    reach = 2 * label.radius
    x0, x1 = int(max(0, min(cx, ox) - reach)), int(max(1, max(cx, ox) + reach))
    part = image[int(max(0, cy)) : int(max(1, oy)), x0:x1]
    return bool(part.size and np.ptp(part.astype(np.float32).mean(axis=(0, 2))) > 2.0)


def _shaded(rng: np.random.Generator, image: Image) -> Image:
    """Light that falls off to one side, and stray light that takes the contrast away."""
    height, width = image.shape[:2]
    x, y = np.linspace(-1, 1, width, dtype=np.float32), np.linspace(-1, 1, height, dtype=np.float32)
    fall = rng.normal(0, 0.25, 2)
    light = np.exp(np.float32(fall[0]) * x[None, :] + np.float32(fall[1]) * y[:, None])
    haze = rng.uniform(0, 0.35) if rng.random() < 0.5 else 0.0
    out = image * (light * (1 - haze))[..., None] + haze * rng.uniform(60, 230)
    return np.clip(out, 0, 255).astype(np.uint8)
