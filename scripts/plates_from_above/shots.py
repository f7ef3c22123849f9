"""Pictures of plates as people take them: each a little turned, tilted and unevenly lit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .rendering import PlateShot


def random_shot(rng: np.random.Generator) -> tuple[PlateShot, PlateShot]:
    """Two pictures of one plate, before and after, as somebody takes them by hand."""
    grounds = (
        ((0.04, 0.04, 0.04), (0.62, 0.63, 0.64), False),  # white plate on a dark deck
        ((0.60, 0.62, 0.63), (0.44, 0.45, 0.45), True),  # clear plate on a white sheet
        ((0.36, 0.35, 0.33), (0.50, 0.50, 0.50), True),  # clear plate on a grey bench
        ((0.20, 0.30, 0.42), (0.66, 0.66, 0.64), False),  # white plate on wood
    )
    ground, body, clear = grounds[int(rng.integers(len(grounds)))]
    base = PlateShot(
        distance_mm=float(rng.uniform(450, 800)), background=ground, body=body, clear=clear
    )
    return _taken(base, rng), _taken(base, rng)


def _taken(base: PlateShot, rng: np.random.Generator) -> PlateShot:
    u = rng.uniform
    bright = float(u(0.85, 1.15))
    return replace(
        base,
        fill=float(u(0.58, 0.85)),
        tilt_deg=(float(u(-7, 7)), float(u(-7, 7))),
        turn_deg=float(u(-10, 10)),
        offset=(float(u(-0.04, 0.04)), float(u(-0.03, 0.03))),
        gain=(float(bright * u(0.93, 1.07)), bright, float(bright * u(0.93, 1.07))),
        slope=(float(u(-0.4, 0.4)), float(u(-0.4, 0.4))),
        shadow=float(rng.choice([0.0, 0.0, 0.2, 0.35])),
        shadow_at=(float(u(0.2, 0.8)), float(u(0, 180))),
        light=(float(u(-0.5, 0.5)), float(u(-0.5, 0.5))),
        glare=((float(u(-50, 50)), float(u(-30, 30)), float(u(4, 10))),) if u() < 0.25 else (),
        blur=float(u(0.5, 1.3)),
        noise=float(u(0.8, 3.0)),
        quality=int(rng.integers(75, 96)),
        seed=int(rng.integers(1 << 30)),
    )
