"""What a session's camera sees besides the tip: panel, deck, labware, pipette, lamps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from aegis_ot.simulation.backdrop import BACK_MM
from aegis_ot.simulation.session import Colour, SessionLabware, SessionParameters

from .tips import GAMMA

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Lamps:
    """Light on the deck.

    Attributes:
        around: Radiance from everywhere: walls and windows of the laboratory.
        strength: Radiance of the ceiling lamp.
        place: Its centre, mm.
        size: Its half width and half depth, mm.
    """

    around: float = 0.7
    strength: float = 12.0
    place: tuple[float, float, float] = (-150.0, -250.0, 900.0)
    size: tuple[float, float] = (150.0, 60.0)


def linear(colour: Colour) -> dict[str, Any]:
    """Reflectance of a colour that is given in grey levels (B, G, R)."""
    values = (np.clip(np.asarray(colour[::-1]) / 255.0, 0.0, 0.97)) ** GAMMA
    return {"type": "rgb", "value": [float(v) for v in values]}


def matt(colour: Colour) -> dict[str, Any]:
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": linear(colour)}}


def plastic(colour: Colour, roughness: float = 0.15) -> dict[str, Any]:
    return {
        "type": "roughplastic",
        "diffuse_reflectance": linear(colour),
        "alpha": roughness,
        "nonlinear": False,
    }


def stage(session: SessionParameters, lamps: Lamps, transform: Any) -> dict[str, Any]:
    """Mitsuba's description of all that stands still.

    Args:
        session: Camera, colours and labware.
        lamps: The light.
        transform: ``mitsuba.ScalarTransform4f``.
    """
    far, right = BACK_MM + 1.0, session.panel_right_mm
    shapes: dict[str, Any] = {
        "around": {"type": "constant", "radiance": {"type": "rgb", "value": lamps.around}},
        "lamp": {
            "type": "rectangle",
            "to_world": transform()
            .translate(lamps.place)
            .scale([lamps.size[0], lamps.size[1], 1.0])
            .rotate([1, 0, 0], 180),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": lamps.strength}},
        },
        "deck": _sheet(
            [(-700, -260, 0), (right, -260, 0), (right, far, 0), (-700, far, 0)],
            session.deck, transform,
        ),
        "panel": _sheet(
            [(-900, far, -50), (1500, far, -50), (1500, far, 900), (-900, far, 900)],
            session.wall, transform,
        ),
    }  # fmt: skip
    if right < 600:
        shapes["side_panel"] = _sheet(
            [(right, -600, -50), (right, far, -50), (right, far, 900), (right, -600, 900)],
            session.wall, transform,
        )  # fmt: skip
    for i, block in enumerate(session.labware):
        shapes |= _block(i, block, transform)
    return shapes


def _sheet(
    corners: list[tuple[float, float, float]], colour: Colour, transform: Any
) -> dict[str, Any]:
    """A flat parallelogram through three of its corners."""
    a, b, _, d = (np.asarray(point, dtype=float) for point in corners)
    across, along = (b - a) / 2, (d - a) / 2
    normal = np.cross(across, along)
    normal /= np.linalg.norm(normal)
    matrix = np.eye(4)
    matrix[:3] = np.stack([across, along, normal, a + across + along], axis=1)
    return {"type": "rectangle", "to_world": transform(matrix), "bsdf": matt(colour)}


def _block(number: int, block: SessionLabware, transform: Any) -> dict[str, Any]:
    """A plate or rack: a box with dark wells on its top."""
    half = [SessionLabware.WIDTH / 2, SessionLabware.DEPTH / 2, block.height_mm / 2]
    shapes: dict[str, Any] = {
        f"block{number}": {
            "type": "cube",
            "to_world": transform().translate([block.x, block.y, block.height_mm / 2]).scale(half),
            "bsdf": plastic(block.colour),
        }
    }
    dark = (block.colour[0] * 0.6, block.colour[1] * 0.6, block.colour[2] * 0.6)
    for row in range(block.rows):
        for column in range(block.columns):
            x = block.x + (column - (block.columns - 1) / 2) * 108 / block.columns
            y = block.y - (row - (block.rows - 1) / 2) * 72 / block.rows
            deep = 34.0 if block.rows == 1 else block.well_radius_mm
            shapes[f"well{number}_{row}_{column}"] = {
                "type": "disk",
                "to_world": transform()
                .translate([x, y, block.height_mm + 0.05])
                .scale([block.well_radius_mm, deep, 1.0]),
                "bsdf": matt(dark),
            }
    return shapes
