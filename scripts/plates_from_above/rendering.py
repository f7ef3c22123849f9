"""Pictures of a well plate from above, as a phone or a fixed camera takes them.

Each pixel's ray is followed into its well: past the rim, through the liquid's surface and its
column, to the floor or the wall. Colour is by Beer-Lambert along that way, in linear light; what
a camera adds comes last: light that falls off, a shadow, glints, blur, noise, JPEG.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from aegis_ot.simulation.dyes import REFERENCE_PATH_MM, Dye
from aegis_ot.vision.plate.formats import LENGTH_MM, WIDTH_MM, PlateFormat
from aegis_ot.vision.types import Image

Plane = NDArray[np.float32]

TOP_MM, INSET_MM = 14.2, 1.6
"""Height of a plate, and how much narrower its top is than its foot on each side, mm."""

_FINER = 1.5
"""Rays per pixel and direction."""


@dataclass(frozen=True)
class PlateShot:
    """How one picture is taken.

    Attributes:
        width, height: Of the picture, px.
        distance_mm: Of the camera from the plate's top.
        fill: Share of the picture's width that the plate's length takes.
        tilt_deg: Of the camera against straight down, about the plate's x and y axis.
        turn_deg: Of the plate in the picture, clockwise; 180 puts A1 at the bottom right.
        offset: Of the plate's middle from the picture's, shares of the width.
        background: Linear colour (B, G, R) of what the plate stands on.
        body: Linear colour of the plate.
        clear: Whether the wells' floor is see-through: they show what is below.
        gain: By channel: exposure and white balance.
        slope: Fall of light across the picture in x and y, 0 even.
        shadow: Darkening by a soft-edged shadow over part of the picture, 0 none.
        shadow_at: Where its edge crosses (share of the width), and its direction, degrees.
        light: Direction of the lamp whose glint stands in the liquid, shares of a radius.
        glare: Places (x, y) mm from the plate's middle and radius of a lamp's reflection.
        blur: Sigma, px.
        noise: Standard deviation, grey levels.
        quality: Of the JPEG, 1 to 100.
        seed: Of noise and texture.
    """

    width: int = 1280
    height: int = 960
    distance_mm: float = 550.0
    fill: float = 0.7
    tilt_deg: tuple[float, float] = (0.0, 0.0)
    turn_deg: float = 0.0
    offset: tuple[float, float] = (0.0, 0.0)
    background: tuple[float, float, float] = (0.05, 0.05, 0.05)
    body: tuple[float, float, float] = (0.62, 0.63, 0.64)
    clear: bool = False
    gain: tuple[float, float, float] = (1.0, 1.0, 1.0)
    slope: tuple[float, float] = (0.0, 0.0)
    shadow: float = 0.0
    shadow_at: tuple[float, float] = (0.5, 60.0)
    light: tuple[float, float] = (0.35, -0.3)
    glare: tuple[tuple[float, float, float], ...] = ()
    blur: float = 0.7
    noise: float = 1.5
    quality: int = 90
    seed: int = 0


@dataclass(frozen=True)
class WellContent:
    """What a well holds.

    Attributes:
        volume_ul: µL.
        dyes: Each with the concentration at which its transmission counts once.
    """

    volume_ul: float = 0.0
    dyes: tuple[tuple[Dye, float], ...] = ()

    def absorbance(self) -> NDArray[np.float32]:
        """Natural logarithm of the light lost per mm, (B, G, R)."""
        total = np.zeros(3, np.float32)
        for dye, concentration in self.dyes:
            total -= concentration * np.log(np.array(dye.transmission)) / REFERENCE_PATH_MM
        return total


@dataclass
class _Rays:
    """Of each pixel: where its ray meets the plate's top, mm, and its slope per mm of depth."""

    x: Plane
    y: Plane
    sx: Plane
    sy: Plane
    noise: np.random.Generator = field(repr=False)


def render_plate(
    plate: PlateFormat, contents: Mapping[str, WellContent], shot: PlateShot
) -> tuple[Image, NDArray[np.float64]]:
    """A picture of a plate.

    Args:
        plate: Its kind.
        contents: By well; a well that is not named is empty.
        shot: How it is taken.

    Returns:
        The picture, BGR, and where the wells' rims have their centres in it, ``(wells, 2)`` px,
        in the order of ``plate.names``.
    """
    pose, focal, eye = _camera(shot)
    rays = _rays(shot, pose, focal, eye)
    scene = _surroundings(rays, shot)
    _wells(scene, rays, plate, contents, shot)
    scene *= _lighting(shot, rays.x.shape)[..., None]
    scene = cv2.resize(scene, (shot.width, shot.height), interpolation=cv2.INTER_AREA)
    scene = cv2.GaussianBlur(scene, (0, 0), shot.blur) * np.array(shot.gain, np.float32)
    grey = 255 * np.clip(scene, 0, 1) ** (1 / 2.2)
    grey += rays.noise.normal(0, shot.noise, grey.shape)
    raw = np.clip(np.round(grey), 0, 255).astype(np.uint8)
    _, jpeg = cv2.imencode(".jpg", raw, [cv2.IMWRITE_JPEG_QUALITY, shot.quality])
    places = np.column_stack([plate.centres(), np.full(plate.wells, TOP_MM)])
    seen = (places - eye) @ pose.T
    pixels = focal * seen[:, :2] / seen[:, 2:] + np.array(_middle(shot))
    return np.asarray(cv2.imdecode(jpeg, cv2.IMREAD_COLOR), np.uint8), pixels


def _middle(shot: PlateShot) -> tuple[float, float]:
    right, down = shot.offset
    return shot.width * (0.5 + right), shot.height / 2 + shot.width * down


def _camera(shot: PlateShot) -> tuple[NDArray[np.float64], float, NDArray[np.float64]]:
    """Rotation from plate to camera (x right, y down, z ahead), focal length px, its place mm."""
    a, b = np.radians(shot.tilt_deg)
    turn = np.radians(shot.turn_deg)
    tilt_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    tilt_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    turned = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    # Plate: x along the columns, y down the rows, z up; the camera looks down on it.
    pose = tilt_x @ tilt_y @ turned @ np.diag([1.0, 1.0, -1.0])
    eye = np.array([0.0, 0.0, TOP_MM]) - pose.T @ np.array([0.0, 0.0, shot.distance_mm])
    return pose, shot.fill * shot.width / LENGTH_MM * shot.distance_mm, eye


def _rays(
    shot: PlateShot, pose: NDArray[np.float64], focal: float, eye: NDArray[np.float64]
) -> _Rays:
    wide, tall = round(shot.width * _FINER), round(shot.height * _FINER)
    u, v = np.meshgrid((np.arange(wide) + 0.5) / _FINER, (np.arange(tall) + 0.5) / _FINER)
    x0, y0 = _middle(shot)
    ahead = np.stack([(u - x0) / focal, (v - y0) / focal, np.ones_like(u)], axis=-1) @ pose
    sx, sy = -ahead[..., 0] / ahead[..., 2], -ahead[..., 1] / ahead[..., 2]
    down = eye[2] - TOP_MM
    planes = (eye[0] + sx * down, eye[1] + sy * down, sx, sy)
    x, y, slope_x, slope_y = (plane.astype(np.float32) for plane in planes)
    return _Rays(x, y, slope_x, slope_y, np.random.default_rng(shot.seed))


def _surroundings(rays: _Rays, shot: PlateShot) -> Plane:
    """What the plate stands on, its shadow there, its skirt and its top without wells."""
    tall, wide = rays.x.shape
    coarse = rays.noise.normal(0, 1, (tall // 40 + 2, wide // 40 + 2)).astype(np.float32)
    grain = cv2.resize(coarse, (wide, tall), interpolation=cv2.INTER_CUBIC)
    scene = np.array(shot.background, np.float32) * (1 + 0.05 * grain)[..., None]
    body = np.array(shot.body, np.float32)
    x, y = rays.x + rays.sx * TOP_MM, rays.y + rays.sy * TOP_MM
    cast = np.float32(np.hypot(*shot.light) * 8)
    fall = _inside(x + cast * np.sign(shot.light[0]), y + cast * np.sign(shot.light[1]), 0)
    scene *= (1 - 0.5 * cv2.GaussianBlur(fall, (0, 0), 6 * _FINER))[..., None]
    for share in np.linspace(0, 1, 6):
        deep = np.float32(TOP_MM * (1 - share))
        skirt = _inside(rays.x + rays.sx * deep, rays.y + rays.sy * deep, INSET_MM * share) > 0
        scene[skirt] = body * (0.55 + 0.2 * share)
    top = _inside(rays.x, rays.y, INSET_MM) > 0
    scene[top] = body
    rim = top & (_inside(rays.x, rays.y, INSET_MM + 1.2) == 0)
    scene[rim] *= 1.12
    return np.asarray(scene, np.float32)


def _inside(x: Plane, y: Plane, inset: float) -> Plane:
    within = (np.abs(x) < LENGTH_MM / 2 - inset) & (np.abs(y) < WIDTH_MM / 2 - inset)
    return within.astype(np.float32)


def _wells(
    scene: Plane,
    rays: _Rays,
    plate: PlateFormat,
    contents: Mapping[str, WellContent],
    shot: PlateShot,
) -> None:
    """Draw the wells into the plate's top."""
    column = np.clip(
        np.round(rays.x / plate.pitch_mm + (plate.columns - 1) / 2), 0, plate.columns - 1
    )
    row = np.clip(np.round(rays.y / plate.pitch_mm + (plate.rows - 1) / 2), 0, plate.rows - 1)
    u = rays.x - (column - (plate.columns - 1) / 2) * np.float32(plate.pitch_mm)
    v = rays.y - (row - (plate.rows - 1) / 2) * np.float32(plate.pitch_mm)
    out = _from_middle(u, v, plate) / plate.radius_mm
    at = np.flatnonzero((out < 1.0).ravel())
    lip = (out >= 1.0) & (out < 1.0 + 0.35 / plate.radius_mm)
    scene[lip] *= 0.82
    take = [a.ravel()[at] for a in (u, v, rays.sx, rays.sy)]
    number = (row * plate.columns + column).ravel()[at].astype(int)
    scene.reshape(-1, 3)[at] = _well_colour(take, number, plate, contents, shot, rays.noise)


def _from_middle(u: Plane, v: Plane, plate: PlateFormat) -> Plane:
    """Distance from the well's axis; of a square one with rounded corners, its larger side's."""
    if not plate.square:
        return np.hypot(u, v)
    return np.asarray((np.abs(u) ** 6 + np.abs(v) ** 6) ** np.float32(1 / 6), np.float32)


def _well_colour(
    ray: list[Plane],
    number: NDArray[np.int_],
    plate: PlateFormat,
    contents: Mapping[str, WellContent],
    shot: PlateShot,
    rng: np.random.Generator,
) -> Plane:
    """Colour of the rays that enter a well at (u, v) with slope (su, sv)."""
    u, v, su, sv = ray
    held = [contents.get(name, WellContent()) for name in plate.names]
    area = (4.0 if plate.square else np.pi) * plate.radius_mm**2
    level = np.array([min(one.volume_ul / area, plate.depth_mm - 0.5) for one in held], np.float32)
    lost = np.stack([one.absorbance() for one in held])
    # The deepest point that the ray reaches before it meets the wall, in a few steps.
    reach = np.zeros_like(u)
    for deep in np.linspace(0, plate.depth_mm, 16, dtype=np.float32)[1:]:
        reach[_from_middle(u + deep * su, v + deep * sv, plate) < plate.radius_mm] = deep
    floor = reach > plate.depth_mm - 0.01
    full = level[number]
    across = _from_middle(u + reach * su, v + reach * sv, plate) / plate.radius_mm
    meniscus = np.minimum(0.25 * plate.radius_mm, 0.5) * (across**4 - 1 / 3) * (full > 0)
    path = np.clip(reach - (plate.depth_mm - full) + meniscus, 0, None) * (full > 0)
    below = shot.background if shot.clear else shot.body
    lit = np.where(floor, 0.95 - 0.12 * across**6, 0.45 + 0.3 * reach / plate.depth_mm)
    lit = lit * np.where(full > 0, 0.97, 1.0)
    colour = np.array(below, np.float32) * lit[:, None].astype(np.float32)
    colour = colour * np.exp(-1.6 * path[:, None] * lost[number])
    turn = rng.normal(0, 0.05, (plate.wells, 2)).astype(np.float32)
    near = np.hypot(
        u + (plate.depth_mm - full) * su - (shot.light[0] + turn[number, 0]) * plate.radius_mm,
        v + (plate.depth_mm - full) * sv - (shot.light[1] + turn[number, 1]) * plate.radius_mm,
    )
    glint = np.where(full > 0, 0.9, 0.25) * np.exp(-((near / (0.14 * plate.radius_mm)) ** 2))
    colour = colour + glint[:, None]
    return np.asarray(colour, np.float32) + _glare(u, v, number, plate, shot)


def _glare(
    u: Plane, v: Plane, number: NDArray[np.int_], plate: PlateFormat, shot: PlateShot
) -> Plane:
    """A lamp's reflection over some wells."""
    centres = plate.centres()[number]
    bright = np.zeros_like(u)
    for x, y, radius in shot.glare:
        off = np.hypot(centres[:, 0] + u - x, centres[:, 1] + v - y)
        bright += np.exp(-((off / radius) ** 4)).astype(np.float32)
    return np.asarray(1.5 * bright[:, None], np.float32)


def _lighting(shot: PlateShot, shape: tuple[int, ...]) -> Plane:
    tall, wide = shape
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, wide), np.linspace(-0.5, 0.5, tall))
    light = 1 + shot.slope[0] * x + shot.slope[1] * y - 0.25 * (x**2 + y**2)
    if shot.shadow:
        at, direction = shot.shadow_at
        angle = np.radians(direction)
        along = (x + 0.5 - at) * np.cos(angle) + y * np.sin(angle)
        light *= 1 - shot.shadow / (1 + np.exp(-along / 0.03))
    return np.asarray(light, np.float32)
