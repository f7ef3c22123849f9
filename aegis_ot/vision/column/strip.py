"""A tip cut out of a frame and laid straight: rows run along its axis, columns across it.

The axis comes from :mod:`.axis`.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..types import Image

Array = NDArray[np.float32]
Point = NDArray[np.float64]

MARGIN = 0.06
"""How far the strip reaches beyond collar and orifice, in tip lengths."""


@dataclass(frozen=True)
class TipShape:
    """The outline of a kind of tip in units of its length, collar (0) to orifice (1).

    Attributes:
        name: ``"p1000"``: an OT-2 class; a Flex tip's own name.
        rows: Rows of a strip from collar to orifice; about 1.3 times the usual length in px.
        collar_radius: Outer radius at the collar, tip lengths.
        orifice_radius: Outer radius at the orifice, tip lengths.
        nozzle_end: Where the pipette's nozzle ends inside the tip, tip lengths below the collar.
        bends: Outer radii between the ends, ``(u, radius)``, where the taper is not straight.
    """

    name: str
    rows: int
    collar_radius: float
    orifice_radius: float
    nozzle_end: float
    bends: tuple[tuple[float, float], ...] = ()

    @property
    def half_width(self) -> float:
        """Half the width of a strip, tip lengths: the tip and as much background beside it."""
        return 2.0 * self.collar_radius

    def radius(self, u: Array) -> Array:
        """Outer radius at ``u`` (0 collar, 1 orifice), tip lengths."""
        ends = ((0.0, self.collar_radius), *self.bends, (1.0, self.orifice_radius))
        places, radii = zip(*ends, strict=True)
        return np.interp(u, places, radii).astype(np.float32)


# Lengths and nozzle overlaps are Opentrons' own (labware definitions 2/opentrons_96_tiprack_*);
# radii are measured on the tips.
SHAPES = {
    "p1000": TipShape("p1000", 240, 0.0440, 0.0095, 0.0815),
    "p300": TipShape("p300", 180, 0.0560, 0.0105, 0.125),
    "p20": TipShape("p20", 120, 0.0640, 0.0130, 0.155),
}


@dataclass(frozen=True)
class Strip:
    """A tip laid straight.

    Attributes:
        pixels: ``(rows, columns, 3)`` float32, BGR, 0 to 255; row 0 is ``MARGIN`` above the
            collar, the middle column is the axis.
        u: ``(rows,)`` position of each row's centre: 0 collar, 1 orifice.
        v: ``(columns,)`` position of each column's centre across the axis, tip lengths.
        collar: Refined upper end of the axis, px of the frame.
        orifice: Refined lower end of the axis, px of the frame.
        clarity: Share of the outline's contrast that the refined axis explains; low values
            mean that the tip was hardly to be seen.
    """

    pixels: Array
    u: Array
    v: Array
    collar: tuple[float, float]
    orifice: tuple[float, float]
    clarity: float

    @property
    def length(self) -> float:
        """Length of the tip in the frame, px."""
        return float(np.hypot(self.orifice[0] - self.collar[0], self.orifice[1] - self.collar[1]))


def resample(
    image: Image,
    collar: Point,
    orifice: Point,
    rows: int,
    half_width: float,
    margin: float = MARGIN,
) -> tuple[Array, Array, Array]:
    """Resample the frame along an axis; returns pixels, u and v."""
    extra = round(margin * rows)
    n = rows + 2 * extra
    step = 1.0 / rows
    columns = 2 * round(half_width / step) + 1
    u = ((np.arange(n) + 0.5 - extra) * step).astype(np.float32)
    v = ((np.arange(columns) - columns // 2) * step).astype(np.float32)
    along = orifice - collar
    across = np.array([along[1], -along[0]])  # to the right in the frame when the tip hangs down
    # dst (column, row) -> src (x, y); cv2 puts pixel centres on integers, this project on halves.
    matrix = np.array(
        [
            [across[0] * step, along[0] * step, 0.0],
            [across[1] * step, along[1] * step, 0.0],
        ]
    )
    start = collar + along * float(u[0]) + across * float(v[0]) - 0.5
    matrix[:, 2] = start
    x0 = int(np.floor(min(collar[0], orifice[0]) - half_width * np.hypot(*along))) - 8
    y0 = int(np.floor(min(collar[1], orifice[1]) - margin * np.hypot(*along))) - 8
    x1 = int(np.ceil(max(collar[0], orifice[0]) + half_width * np.hypot(*along))) + 8
    y1 = int(np.ceil(max(collar[1], orifice[1]) + margin * np.hypot(*along))) + 8
    x0, y0 = max(0, min(x0, image.shape[1] - 2)), max(0, min(y0, image.shape[0] - 2))
    x1, y1 = max(x0 + 2, min(x1, image.shape[1])), max(y0 + 2, min(y1, image.shape[0]))
    matrix[:, 2] -= (x0, y0)
    patch = image[y0:y1, x0:x1].astype(np.float32)
    pixels = cv2.warpAffine(
        patch,
        matrix,
        (columns, n),
        flags=cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(pixels, dtype=np.float32), u, v
