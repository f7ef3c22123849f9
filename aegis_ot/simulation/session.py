"""A session's camera, light and deck: all that stays the same from frame to frame.

Scene coordinates are mm: x to the right along the deck's front, y away from the front, z up
from the deck; the origin lies between source and destination labware. The camera stands in
front (negative y) and looks back.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..vision.tips import TipGeometry, tip_for

Colour = tuple[float, float, float]
"""B, G, R in grey levels, 0 to 255."""

SLOT_MM = 132.5
"""Distance of an OT-2's slots, mm."""


@dataclass(frozen=True)
class SessionLabware:
    """A block of labware on the deck: centre (x, y) and height in mm, wells, colour."""

    x: float
    y: float
    height_mm: float
    colour: Colour
    columns: int = 12
    rows: int = 8
    well_radius_mm: float = 3.3

    WIDTH = 127.76
    DEPTH = 85.48


@dataclass(frozen=True)
class SessionParameters:
    """Everything about camera, light and deck that stays the same for one session (plate).

    Attributes:
        size: Frame width and height, px.
        eye: Camera position, mm.
        look: Point at the centre of the frame, mm.
        roll_deg: Rotation about the optical axis.
        focal_px: Focal length, px.
        tip_tilt_deg: How far the tip's axis leans sideways from the vertical.
        axis_jitter_px: Repeatability of the tip's place, one standard deviation, px.
        meniscus_jitter_px: Repeatability of the meniscus, one standard deviation, px.
        row_offset: Spread of the volume offset between rows of wells, fraction of capacity.
        meniscus_edge: 10-90 % width of the meniscus before blur, in inner radii: its curvature
            and the ellipse that a camera looking down sees.
        dye_strength: Concentration of the dyes, as a multiple of what :data:`DYES` says.
        wall, backdrop_top, deck: Colours of the panel behind the deck, its upper end, the deck.
        clutter: Strength of a blurred laboratory behind, 0 (a plain panel) to 1.
        brightness_fall: Fraction of brightness lost from the bottom to the top of the frame.
        side_fall: The same from left to right (negative: from right to left).
        vignette: Fraction lost in the corners.
        gain: Exposure of the session. ``exposure_jitter``: one standard deviation per frame.
        overexposed_chance, overexposed_gain: A frame now and then, and how far over.
        white_balance: Gain of B, G, R.
        blur_px: Standard deviation of the lens blur, px.
        noise: Standard deviation of the sensor's noise at mid grey, grey levels; JPEG takes about
            half of it away.
        jpeg_quality: 1 to 100.
        frost: Haze of the tip's wall, 0 (clear) to 1.
        rim: Strength of the bright lines along the tip's edges.
        glint: Strength of the lamp's reflection along the tip.
        glint_side: Where across the tip it lies, -1 to 1.
        lens: How strongly a filled tip bends what is behind it, 0 to 1.
        piping: How far light from bright labware glows up a filled column, 0 to 1.
        specks: Mean number of bright specks in a tip: scratches, caustics, dried droplets.
        film: Liquid that stays on the wall after a dispense, fraction of the volume.
        drop_chance: Chance of a hanging drop after a dispense.
        shaft, body: Colours of the pipette's nozzle shaft and body.
        shaft_mm: Length of the shaft between tip and body, mm.
        body_mm: Width of the body, mm.
        panel_right_mm: Where the deck ends on the right and a panel begins, mm.
        labware: Source, destination and what else stands on the deck.
        seed: Fixes textures and the offsets of rows.
    """

    size: tuple[int, int] = (640, 480)
    eye: tuple[float, float, float] = (0.0, -500.0, 120.0)
    look: tuple[float, float, float] = (0.0, 0.0, 72.0)
    roll_deg: float = 0.0
    focal_px: float = 1225.0
    tip_tilt_deg: float = 0.0
    axis_jitter_px: float = 0.4
    meniscus_jitter_px: float = 0.3
    row_offset: float = 0.015
    meniscus_edge: float = 1.0
    dye_strength: float = 1.0
    wall: Colour = (34.0, 33.0, 32.0)
    backdrop_top: Colour = (34.0, 33.0, 32.0)
    deck: Colour = (78.0, 76.0, 74.0)
    clutter: float = 0.0
    brightness_fall: float = 0.12
    side_fall: float = 0.0
    vignette: float = 0.05
    gain: float = 1.0
    exposure_jitter: float = 0.025
    overexposed_chance: float = 0.01
    overexposed_gain: float = 2.2
    white_balance: Colour = (1.0, 1.0, 1.0)
    blur_px: float = 1.0
    noise: float = 3.1
    jpeg_quality: int = 92
    frost: float = 0.35
    rim: float = 0.5
    glint: float = 0.4
    glint_side: float = -0.45
    lens: float = 0.6
    piping: float = 0.1
    specks: float = 0.0
    film: float = 0.004
    drop_chance: float = 0.08
    shaft: Colour = (175.0, 174.0, 172.0)
    body: Colour = (150.0, 150.0, 148.0)
    shaft_mm: float = 45.0
    body_mm: float = 30.0
    panel_right_mm: float = 700.0
    labware: tuple[SessionLabware, ...] = ()
    seed: int = 0

    @property
    def px_per_mm(self) -> float:
        """Scale at the middle of the view, px per mm."""
        return self.focal_px / float(np.linalg.norm(np.subtract(self.look, self.eye)))

    def px_per_ul(self, tip: TipGeometry, low_ul: float, high_ul: float) -> float:
        """Mean travel of the meniscus between two volumes, px per µL."""
        rise = tip.height_of(high_ul) - tip.height_of(low_ul)
        return self.px_per_mm * rise / (high_ul - low_ul)

    @classmethod
    def webcam(cls, seed: int = 0) -> SessionParameters:
        """The 640x480 webcam before an OT-2 whose frames were measured (``spec/paper.md``).

        0.18 px per µL on a p1000 (the mean from 100 to 500 µL), noise of 1.7 grey levels,
        exposure within 2.5 %, now and then a frame far overexposed, a meniscus edge 9 px wide,
        the axis repeatable to 0.4 px, 12 % less brightness at the top. The rest is plausible.
        """
        base = cls(seed=seed, labware=_labware())
        tip = tip_for("p1000")
        scale = 0.18 / (base.px_per_ul(tip, 100.0, 500.0) / base.px_per_mm)
        base = replace(base, focal_px=base.focal_px * scale / base.px_per_mm)
        # The edge of 9 px is blur and meniscus together; Gaussian widths add in squares.
        own = np.sqrt((9.0 / 2.563) ** 2 - base.blur_px**2) * 2.563
        radius_px = tip.inner_radius(tip.height_of(300.0)) * base.px_per_mm
        return replace(base, meniscus_edge=float(own / radius_px))

    @classmethod
    def bench(cls, seed: int = 0) -> SessionParameters:
        """The set-up that we recommend: a 1280x720 webcam and a grey panel behind the deck.

        The same view as :meth:`webcam` at twice the resolution. A dye takes light out of what is
        behind it, so little of it is seen before a black panel; before a white one the edges of
        an empty tip are lost.
        """
        webcam = cls.webcam(seed)
        grey = (110.0, 110.0, 110.0)
        return replace(
            webcam,
            size=(1280, 720),
            focal_px=2 * webcam.focal_px,
            meniscus_edge=webcam.meniscus_edge / 2,
            wall=grey,
            backdrop_top=grey,
        )

    @classmethod
    def corner(cls, seed: int = 0) -> SessionParameters:
        """The same webcam at the corner of the deck, for multi-channel pipettes.

        From the front the eight tips of a column stand one behind another and hide each other.
        """
        return cls.webcam(seed)._around(55.0)

    @classmethod
    def beside(cls, angle_deg: float = 30.0, seed: int = 0) -> SessionParameters:
        """The recommended set-up for multi-channel pipettes: :meth:`bench` from beside the deck.

        The panel stands behind the pipette as the camera sees it, at the right end of the deck.

        Args:
            angle_deg: Between the view and the square onto a column of tips. 0: from the left
                side of the deck, eight tips in a row, the first on the left. 90: from the front,
                one behind another.
            seed: As for :meth:`bench`.
        """
        return replace(cls.bench(seed), panel_right_mm=230.0)._around(90.0 - angle_deg)

    def _around(self, azimuth_deg: float) -> SessionParameters:
        """The same camera, carried around the deck from the front towards its left side."""
        away = np.subtract(self.look, self.eye)
        distance, azimuth = float(np.hypot(away[0], away[1])), np.radians(azimuth_deg)
        x = self.look[0] - distance * np.sin(azimuth)
        y = self.look[1] - distance * np.cos(azimuth)
        return replace(self, eye=(float(x), float(y), self.eye[2]))


def _labware() -> tuple[SessionLabware, ...]:
    return (
        SessionLabware(-SLOT_MM / 2, 0.0, 31.4, (196.0, 196.0, 194.0), 12, 1, 4.1),
        SessionLabware(SLOT_MM / 2, 0.0, 14.5, (205.0, 204.0, 202.0)),
    )
