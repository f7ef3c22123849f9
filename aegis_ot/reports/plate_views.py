"""What a page shows of two pictures of a plate: both whole, and wells close up side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..run_view import Picture
from ..run_view.pictures import close_up, whole_frame
from ..vision.plate import FoundPlate
from ..vision.types import Image

MOST_SHOWN = 24
"""Wells shown close up."""

_AROUND = 1.4
"""What is shown around a well's middle on each side, pitches."""

Ring = tuple[float, float, float]
"""Middle x, y and radius of a well in its picture, px."""

Seen = tuple[Picture, Ring]
"""A picture, and the well that it is about."""


@dataclass(frozen=True)
class PlateViews:
    """Pictures for the page.

    Attributes:
        whole: Before and after, each with the ring of A1.
        wells: Names of wells, each close up before and after.
    """

    whole: tuple[Seen, Seen]
    wells: Sequence[tuple[str, Seen, Seen]]


def plate_views(
    before: tuple[Image, FoundPlate], after: tuple[Image, FoundPlate], wells: Sequence[str]
) -> PlateViews:
    """Cut what a page shows.

    Args:
        before: Picture, BGR, and the plate found in it.
        after: The same of the second.
        wells: To be shown close up; the first ones if they are many.
    """
    both = before, after
    shown = []
    for name in wells[:MOST_SHOWN]:
        first, second = (_close(image, found, name) for image, found in both)
        if first is not None and second is not None:
            shown.append((name, first, second))
    first_whole, second_whole = ((whole_frame(image), _ring(found, "A1")) for image, found in both)
    return PlateViews((first_whole, second_whole), shown)


def _ring(found: FoundPlate, well: str) -> Ring:
    plate = found.plate
    middle = plate.centres()[plate.names.index(well)]
    edge = middle + np.array([plate.radius_mm, 0.0])
    (x, y), (edge_x, edge_y) = found.pixels(np.stack([middle, edge]))
    return float(x), float(y), float(np.hypot(edge_x - x, edge_y - y))


def _close(image: Image, found: FoundPlate, well: str) -> Seen | None:
    x, y, radius = ring = _ring(found, well)
    reach = _AROUND * radius * found.plate.pitch_mm / found.plate.radius_mm
    picture = close_up(image, (x - reach, y - reach, 2 * reach, 2 * reach))
    return None if picture is None else (picture, ring)
