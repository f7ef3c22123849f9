"""The camera as a qualification found it, and what has changed since the one before."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import cv2
import numpy as np

from ..vision.tips import tip_for
from .opening import JudgedDelivery

SHARPNESS_CHANGED, LIGHT_CHANGED, MOVED_PX = 0.25, 0.15, 4.0
"""From when a change is told: shares, and px. Chosen, not measured: half of what a well-kept
camera's own frames differ by is far below them."""

_FRAME = "post_dispense"
"""The tip hangs free and is empty: what another liquid looks like is no drift of the camera."""


def camera_state(
    deliveries: Sequence[JudgedDelivery], frame: Callable[[int], bytes | None]
) -> dict[str, Any]:
    """Of the normal deliveries: how sharp and bright their tips are, and where they hang.

    Args:
        deliveries: Of the run.
        frame: The JPEG of a keyframe's number.

    Returns:
        ``sharpness`` (steepest steps across the tip, grey levels per px, over its brightness),
        ``light`` (median grey level beside the tip), ``px_per_mm``, ``places`` (lower end of the
        tip by well, px), ``size`` (of the frame, px), ``missed`` (frames without a tip found, and
        of how many). Figures are ``None`` where no tip was found.
    """
    sharp, light, scale, places = [], [], [], {}
    size: tuple[int, int] | None = None
    missed = looked = 0
    for each in deliveries:
        if not (each.is_normal and each.is_counted):
            continue
        looked, missed = looked + 4, missed + 4 - len(each.boxes)
        shown = next((k for k in each.entry["keyframes"] if k["kind"] == _FRAME), None)
        box = each.boxes.get(_FRAME)
        image = _decoded(frame(int(shown["sequence"]))) if shown and box else None
        if image is None or shown is None or box is None:
            continue
        size = (image.shape[1], image.shape[0])
        x, y, w, h = box
        tip = tip_for(shown["pipette"], shown["capacity_ul"])
        scale.append(h / tip.length_mm)
        places[each.planned.well] = [round(x + w / 2, 1), round(y + h, 1)]
        about = image[_span(y, h, size[1]), _span(x - w, 3 * w, size[0])]
        steps = np.abs(cv2.Sobel(about, cv2.CV_32F, 1, 0, ksize=1))
        light.append(float(np.median(about)))
        sharp.append(float(np.percentile(steps, 99)) / max(float(about.mean()), 1.0))

    def middle(values: Sequence[float], digits: int) -> float | None:
        return round(float(np.median(values)), digits) if values else None

    return {
        "sharpness": middle(sharp, 4),
        "light": middle(light, 1),
        "px_per_mm": middle(scale, 3),
        "places": places,
        "size": size,
        "missed": [missed, looked],
    }


def changes(now: Mapping[str, Any], before: Mapping[str, Any]) -> list[str]:
    """What a person has to know of the camera since the last qualification, a sentence each; also
    what could not be compared."""
    told = []
    for name, limit in (("sharpness", SHARPNESS_CHANGED), ("light", LIGHT_CHANGED)):
        if not (now[name] and before[name]):
            told.append(f"The {name} could not be compared: one of the two has none.")
        elif abs(now[name] / before[name] - 1) > limit:
            change = 100 * (now[name] / before[name] - 1)
            cause = "Is the lens clean and in focus?" if name == "sharpness" else "See the lamps."
            told.append(f"The {name} has changed by {change:+.0f} %. {cause}")
    both = now["places"].keys() & before["places"].keys()
    if not both:
        told.append("The place could not be compared: no tip was found over the same well.")
    elif list(now["size"] or ()) != list(before["size"] or ()):
        told.append("The frames have another size now: places cannot be compared.")
    else:
        away = [np.subtract(now["places"][well], before["places"][well]) for well in both]
        moved = float(np.hypot(*np.median(away, axis=0)))
        if moved > MOVED_PX:
            told.append(
                f"Tips appear {moved:.0f} px from where they did: the camera was moved. Fix it."
            )
    return told


def _decoded(jpeg: bytes | None) -> Any:
    return cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE) if jpeg else None


def _span(start: float, length: float, most: int) -> slice:
    return slice(max(int(start), 0), min(int(start + length) + 1, most))
