"""Kinds of camera: set-ups that differ as laboratories do, each with its own light and pipettes.

A scorer that was fitted on all but one of them and judges that one shows what a laboratory gets
whose camera nobody here has seen. Inside a kind every plate is drawn anew.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from aegis_ot.simulation.session import SessionParameters
from aegis_ot.vision.tips import tip_for
from aegis_ot_lab.drawing.random_sessions import random_session

from .stage import Lamps

Range = tuple[float, float]


@dataclass(frozen=True)
class CameraKind:
    """One kind of set-up; ranges are drawn from evenly, once per plate.

    Attributes:
        size: Frame width and height, px.
        pipettes: In turn, one per plate.
        azimuth_deg: Camera to the left of the front.
        elevation_deg: How far it looks down.
        distance_mm: From the tip.
        filling: Height of the tip over height of the frame; less where both labwares would not fit.
        panel: Grey level behind the deck.
        blur_px, noise, jpeg: Of lens, sensor and encoder.
        frost: Haze of the tips.
        around, lamp: Radiance of the room, and of the lamp.
        lamp_place: Middle of where the lamp hangs, mm. ``lamp_size``: its half sides, mm.
        balance: White balance (B, G, R) about which plates scatter.
        dyes: Concentration, as a multiple of what ``DYES`` says.
        view_mm: What is to be in view from side to side: both labwares.
        shaft_mm: Of the pipette in view above the tip; as long as a single channel's if not given.
        head: Grey level of the pipette; as the session draws it if not given.
        clutter: Strength of a textured wall or of people behind the deck, 0 to 1; the path tracer
            has a plain panel there.
        sleeves: Whether the tips' upper part is a sleeve, as real ones' is; drawn tips have none.
    """

    size: tuple[int, int]
    pipettes: tuple[str, ...]
    azimuth_deg: Range
    elevation_deg: Range
    distance_mm: Range
    filling: Range
    panel: Range
    blur_px: Range
    noise: Range
    jpeg: Range
    frost: Range
    around: Range
    lamp: Range
    lamp_place: tuple[float, float, float]
    lamp_size: tuple[float, float]
    balance: tuple[float, float, float] = (1.0, 1.0, 1.0)
    dyes: Range = (0.8, 2.5)
    view_mm: float = 118.0
    shaft_mm: Range | None = None
    head: Range | None = None
    clutter: Range = (0.0, 0.0)
    sleeves: bool = False


KINDS: Mapping[str, CameraKind] = {
    "webcam": CameraKind(
        (640, 480), ("p1000", "p300"), (-8, 8), (4, 14), (380, 560), (0.34, 0.42),
        (30, 120), (0.8, 1.3), (2, 4), (80, 94), (0.1, 0.5), (0.5, 0.9), (8, 16),
        (-120, -200, 900), (160, 60),
    ),
    "phone-above": CameraKind(
        (1280, 720), ("p300", "p1000"), (-30, -16), (22, 32), (350, 500), (0.30, 0.38),
        (120, 220), (0.5, 1.0), (1.5, 3), (85, 97), (0.05, 0.3), (0.9, 1.3), (2, 6),
        (300, -400, 800), (250, 250), (0.94, 1.0, 1.06),
    ),
    "flex-cabinet": CameraKind(
        (1280, 720), ("flex_1channel_1000", "flex_1channel_50"), (10, 26), (6, 16), (420, 600),
        (0.32, 0.42), (50, 110), (0.6, 1.2), (2, 4), (75, 95), (0.1, 0.4), (0.25, 0.5), (20, 40),
        (0, -60, 700), (300, 12), (1.05, 1.0, 0.95),
    ),
    "close-up": CameraKind(
        (1280, 720), ("p20", "p300"), (-10, 10), (3, 12), (220, 320), (0.38, 0.48),
        (90, 200), (0.8, 1.8), (2, 4), (85, 97), (0.05, 0.4), (0.6, 1.0), (6, 14),
        (-200, -150, 700), (120, 120),
    ),
    "old-webcam": CameraKind(
        (640, 480), ("p1000", "p300"), (-14, 14), (6, 18), (350, 500), (0.36, 0.44),
        (20, 90), (1.3, 1.9), (5, 9), (55, 75), (0.2, 0.6), (0.4, 0.8), (6, 14),
        (100, -300, 900), (120, 60), (1.1, 1.0, 0.9),
    ),
    "backlit": CameraKind(
        (960, 540), ("p1000", "p20"), (-6, 6), (2, 10), (400, 600), (0.34, 0.42),
        (225, 245), (0.6, 1.2), (1.5, 3.5), (85, 96), (0.05, 0.35), (1.0, 1.4), (3, 8),
        (0, 60, 800), (300, 80),
    ),
}  # fmt: skip
"""Kinds by name. They were written down before anything was scored on them."""

LATER_KINDS: Mapping[str, CameraKind] = {
    "loft": CameraKind(
        (1280, 720), ("p300", "p20"), (26, 40), (28, 38), (420, 640), (0.26, 0.34),
        (60, 160), (0.6, 1.2), (2, 4), (75, 92), (0.1, 0.5), (0.7, 1.2), (3, 9),
        (-350, -300, 850), (180, 180), (0.97, 1.0, 1.04), clutter=(0.3, 0.7),
    ),
    "window-side": CameraKind(
        (800, 600), ("p1000", "p300"), (-44, -28), (6, 16), (320, 480), (0.33, 0.41),
        (110, 200), (0.7, 1.4), (2, 5), (72, 92), (0.1, 0.5), (0.9, 1.4), (10, 24),
        (420, 100, 600), (60, 260), (1.08, 1.0, 0.93), clutter=(0.5, 0.9), sleeves=True,
    ),
    "wide-lens": CameraKind(
        (1024, 768), ("p20", "p1000"), (-12, 12), (0, 6), (170, 240), (0.30, 0.40),
        (40, 140), (0.5, 1.0), (3, 6), (80, 95), (0.05, 0.3), (0.4, 0.8), (8, 20),
        (100, -220, 750), (90, 90), sleeves=True,
    ),
    "night-shift": CameraKind(
        (640, 480), ("p300", "flex_1channel_1000"), (-20, 20), (4, 20), (380, 560), (0.34, 0.44),
        (10, 60), (0.9, 1.6), (6, 10), (45, 65), (0.2, 0.6), (0.1, 0.25), (25, 45),
        (0, -350, 800), (40, 40), (0.9, 1.0, 1.12), clutter=(0.4, 0.9), sleeves=True,
    ),
}  # fmt: skip
"""Four more, written down on 2026-11-28 before anything was scored on them, and scored on once."""


PIPETTES = ("p1000", "p300", "p20", "flex_1channel_1000", "flex_1channel_50")
ROW_PIPETTES = ("p20_multi_gen2", "p300_multi_gen2", "flex_8channel_50", "flex_8channel_1000")


def any_kind(rng: np.random.Generator) -> CameraKind:
    """A set-up from a range that holds all of :data:`KINDS` and more: for training a detector."""
    place = (float(rng.uniform(-400, 400)), float(rng.uniform(-500, 150)), 800.0)
    sizes = ((640, 480), (640, 480), (960, 540), (1280, 720))
    warm = float(rng.uniform(-0.1, 0.1))
    return CameraKind(
        sizes[int(rng.integers(len(sizes)))], (PIPETTES[int(rng.integers(len(PIPETTES)))],),
        (-35, 35), (1, 34), (220, 650), (0.24, 0.5), (12, 250), (0.5, 2.0), (1.5, 9), (55, 97),
        (0.0, 0.6), (0.2, 1.4), (2, 40), place, (float(rng.uniform(12, 300)),) * 2,
        (1.0 + warm, 1.0, 1.0 - warm), (0.5, 3.0),
    )  # fmt: skip


def any_row(rng: np.random.Generator) -> CameraKind:
    """As :func:`any_kind`, of eight tips in a row: seen from beside the deck, not end-on.

    The head of such a pipette ends close above its tips; many are black, and many cameras see
    them before a bright wall, close enough for the row to fill the frame.
    """
    pipette = str(rng.choice(ROW_PIPETTES))
    return replace(
        any_kind(rng), pipettes=(pipette,), azimuth_deg=(60, 98), elevation_deg=(1, 16),
        distance_mm=(180, 650), filling=(0.3, 0.68), view_mm=float(rng.uniform(52, 75)),
        shaft_mm=(3, 16), head=(8, 60) if rng.random() < 0.6 else None,
        panel=(150, 250) if rng.random() < 0.5 else (12, 250),
    )  # fmt: skip


def draw_session(
    kind: CameraKind, pipette: str, rng: np.random.Generator
) -> tuple[SessionParameters, Lamps]:
    """One plate's camera, deck and light."""

    def u(limits: Range) -> float:
        return float(rng.uniform(*limits))

    base = random_session(rng, pipette=pipette, size=kind.size)
    length = tip_for(pipette).length_mm
    distance, look = u(kind.distance_mm), (u((-8, 8)), u((-8, 8)), 0.55 * length + u((20, 34)))
    around, down = np.radians(u(kind.azimuth_deg)), np.radians(u(kind.elevation_deg))
    eye = (
        look[0] - distance * float(np.cos(down) * np.sin(around)),
        look[1] - distance * float(np.cos(down) * np.cos(around)),
        look[2] + distance * float(np.sin(down)),
    )
    # Both labwares stay in view, whatever the tip's length.
    scale = min(u(kind.filling) * kind.size[1] / length, 0.42 * kind.size[0] / kind.view_mm)
    level = u(kind.panel)
    wall = (level * rng.normal(1, 0.04), level, level * rng.normal(1, 0.04))
    blue, green, red = (gain * rng.normal(1.0, 0.02) for gain in kind.balance)
    # Only the two blocks in use: others take time to render.
    session = replace(
        base, eye=eye, look=look, focal_px=scale * distance, wall=wall, backdrop_top=wall,
        clutter=u(kind.clutter) if any(kind.clutter) else 0.0, blur_px=u(kind.blur_px),
        noise=u(kind.noise), jpeg_quality=int(u(kind.jpeg)),
        frost=u(kind.frost), dye_strength=u(kind.dyes), white_balance=(blue, green, red),
        gain=u((0.9, 1.1)), brightness_fall=0.0, side_fall=0.0, labware=base.labware[:2],
        # Whoever looks from beside the deck has the panel at its right end.
        panel_right_mm=230.0 if kind.azimuth_deg[0] > 35 else base.panel_right_mm,
    )  # fmt: skip
    if kind.shaft_mm:
        session = replace(session, shaft_mm=u(kind.shaft_mm))
    if kind.head:
        session = replace(session, shaft=(u(kind.head),) * 3, body=(u(kind.head),) * 3)
    x, y, z = (place + u((-60, 60)) for place in kind.lamp_place)
    lamps = Lamps(
        around=u(kind.around), strength=u(kind.lamp), place=(x, y, z), size=kind.lamp_size
    )
    return session, lamps
