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
        base = cls(seed=seed, labware=_labware(None))
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

    @classmethod
    def draw(
        cls, rng: np.random.Generator, *, pipette: str = "p1000", size: tuple[int, int] = (640, 480)
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
        return cls(
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


def _labware(rng: np.random.Generator | None) -> tuple[SessionLabware, ...]:
    pitch = 132.5  # distance of OT-2 slots, mm
    if rng is None:
        return (
            SessionLabware(-pitch / 2, 0.0, 31.4, (196.0, 196.0, 194.0), 12, 1, 4.1),
            SessionLabware(pitch / 2, 0.0, 14.5, (205.0, 204.0, 202.0)),
        )
    u = rng.uniform

    def block(x: float) -> SessionLabware:
        columns, rows, radius = [(12, 8, 3.3), (6, 4, 8.0), (12, 1, 4.1), (12, 8, 2.6)][
            int(rng.integers(4))
        ]
        colour = _tint(rng, u(90.0, 225.0), 0.03 if rng.random() < 0.6 else 0.4)
        clipped = (min(colour[0], 240.0), min(colour[1], 240.0), min(colour[2], 240.0))
        return SessionLabware(x, u(-6.0, 6.0), u(10.0, 42.0), clipped, columns, rows, radius)

    return tuple(block(x) for x in (-pitch / 2, pitch / 2, 1.5 * pitch, -1.5 * pitch))
