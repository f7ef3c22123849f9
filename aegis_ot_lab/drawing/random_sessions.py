"""A laboratory drawn at random: camera, light and deck."""

from __future__ import annotations

import numpy as np

from aegis_ot.simulation.session import SLOT_MM, Colour, SessionLabware, SessionParameters
from aegis_ot.vision.tips import tip_for


def random_session(
    rng: np.random.Generator, *, pipette: str = "p1000", size: tuple[int, int] = (640, 480)
) -> SessionParameters:
    """A session drawn at random, wide but realistic.

    Args:
        rng: Source of randomness: the same state gives the same session.
        pipette: Opentrons name or class. Multi-channel pipettes are seen from the corner
            of the deck, since from the front their tips hide one another.
        size: Frame width and height, px.
    """
    u = rng.uniform
    tip = tip_for(pipette)
    distance = u(330.0, 650.0)
    # A camera is set up to see both labwares and the raised tip up to its collar.
    scale = u(0.7, 1.0) * min(0.455 * size[0] / 118.0, size[1] / (tip.length_mm + 95.0))
    azimuth = np.radians(u(38.0, 55.0) if "multi" in pipette or "8channel" in pipette else 0)
    azimuth += np.radians(u(-6.0, 6.0))
    elevation = np.radians(u(3.0, 17.0))
    look = (u(-10.0, 10.0), u(-10.0, 10.0), tip.length_mm * 0.55 + u(18.0, 32.0))
    eye = (
        look[0] - distance * np.cos(elevation) * np.sin(azimuth),
        look[1] - distance * np.cos(elevation) * np.cos(azimuth),
        look[2] + distance * np.sin(elevation),
    )
    dark = rng.random() < 0.6
    level = u(14.0, 60.0) if dark else u(60.0, 210.0)
    wall = _tint(rng, level, 0.06 if dark else 0.15)
    grey = u(120.0, 225.0)
    return SessionParameters(
        size=size,
        eye=(float(eye[0]), float(eye[1]), float(eye[2])),
        look=look,
        roll_deg=rng.normal(0.0, 1.0),
        focal_px=scale * distance,
        tip_tilt_deg=rng.normal(0.0, 0.8),
        axis_jitter_px=u(0.2, 0.7),
        meniscus_jitter_px=u(0.19, 0.45),
        row_offset=u(0.0, 0.02),
        meniscus_edge=u(0.4, 1.5),
        dye_strength=float(np.exp(u(np.log(0.7), np.log(3.0)))),
        wall=wall,
        backdrop_top=_tint(rng, level * u(0.7, 1.25), 0.08),
        deck=_tint(rng, u(35.0, 150.0), 0.06),
        clutter=0.0 if rng.random() < 0.6 else u(0.1, 0.9),
        brightness_fall=rng.normal(0.1, 0.08),
        side_fall=rng.normal(0.0, 0.1),
        vignette=u(0.0, 0.2),
        gain=u(0.75, 1.25),
        exposure_jitter=u(0.005, 0.035),
        overexposed_chance=0.01,
        overexposed_gain=u(1.6, 2.8),
        white_balance=(u(0.92, 1.08), 1.0, u(0.92, 1.08)),
        blur_px=u(0.5, 1.5) * (size[1] / 480.0) ** 0.5,
        noise=u(1.5, 5.5),
        jpeg_quality=int(u(70, 97)),
        frost=u(0.08, 0.6),
        rim=u(0.15, 0.9),
        glint=u(0.1, 0.9),
        glint_side=float(rng.choice([-1.0, 1.0])) * u(0.2, 0.7),
        lens=u(0.3, 0.9),
        piping=u(0.0, 0.3) if rng.random() < 0.75 else u(0.3, 1.1),
        specks=0.0 if rng.random() < 0.6 else u(0.5, 8.0),
        film=u(0.001, 0.008),
        drop_chance=u(0.0, 0.15),
        shaft=_tint(rng, grey, 0.03),
        body=_tint(rng, u(30.0, 225.0), 0.03),
        shaft_mm=u(25.0, 70.0),
        body_mm=u(18.0, 45.0),
        labware=_labware(rng),
        seed=int(rng.integers(2**31)),
    )


def _tint(rng: np.random.Generator, level: float, spread: float) -> Colour:
    b, g, r = level * (1.0 + rng.normal(0.0, spread, 3))
    return (float(b), float(g), float(r))


def _labware(rng: np.random.Generator) -> tuple[SessionLabware, ...]:
    u = rng.uniform

    def block(x: float) -> SessionLabware:
        columns, rows, radius = [(12, 8, 3.3), (6, 4, 8.0), (12, 1, 4.1), (12, 8, 2.6)][
            int(rng.integers(4))
        ]
        colour = _tint(rng, u(90.0, 225.0), 0.03 if rng.random() < 0.6 else 0.4)
        clipped = (min(colour[0], 240.0), min(colour[1], 240.0), min(colour[2], 240.0))
        return SessionLabware(x, u(-6.0, 6.0), u(10.0, 42.0), clipped, columns, rows, radius)

    return tuple(block(x) for x in (-SLOT_MM / 2, SLOT_MM / 2, 1.5 * SLOT_MM, -1.5 * SLOT_MM))
