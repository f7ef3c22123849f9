"""Path-traced frames of the simulated scenes: Mitsuba in the place of ``simulation.render``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cv2
import mitsuba as mi
import numpy as np
import pyoidn
from numpy.typing import NDArray

from aegis_ot.simulation.backdrop import light_field
from aegis_ot.simulation.exposure import encode, expose, frame_gain
from aegis_ot.simulation.optics import Pinhole
from aegis_ot.simulation.scene import SceneState
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import FrameTruth, tip_truth

from .lathe import Surface
from .stage import Lamps, plastic, stage
from .tips import GAMMA, Liquid, Sleeve, tip_surfaces

mi.set_variant("scalar_rgb")

Floats = NDArray[np.float64]
Light = NDArray[np.float32]

PLASTIC, LIQUID, AIR = 1.49, 1.333, 1.0
"""Refractive indices: polypropylene, water, air."""


@dataclass(frozen=True)
class Quality:
    """Rays per pixel, and surfaces a ray may meet: a filled tip has eight on the way through.

    ``soft_px``: by how much what is rendered anew reaches beyond the pipette, px.
    """

    still: int = 24
    body: int = 12
    tip: int = 24
    depth: int = 16
    soft_px: int = 4


FOR_DETECTOR = Quality(still=12, body=4, tip=24, soft_px=16)
"""Fewer rays, for what is left of their noise drowns in a camera's; and softer edges of what is
rendered anew, so that the end of the pipette's shadow on the panel is not taken for a sign."""


class PathTracer:
    """Renders one session's frames; call it where ``simulation.render_jpeg`` is called.

    Args:
        lamps: Light of each session, by the session's seed; the same for all if left out.
        quality: Rays per pixel.
        sleeves: Upper parts of the tips, by the session's seed.
    """

    def __init__(
        self,
        lamps: Mapping[int, Lamps] | None = None,
        quality: Quality | None = None,
        sleeves: Mapping[int, Sleeve] | None = None,
    ) -> None:
        self._sleeves = sleeves or {}
        self._lamps = lamps or {}
        self._quality = quality or Quality()
        self._still = lru_cache(maxsize=2)(self._render_still)

    def __call__(
        self, state: SceneState, session: SessionParameters, rng: np.random.Generator
    ) -> tuple[bytes, FrameTruth]:
        """One camera frame as JPEG, and what is in it."""
        camera = Pinhole(session)
        jitter = rng.normal(0.0, session.axis_jitter_px, 2) / session.px_per_mm
        still, light = self._still(session)
        light = light.copy()
        shapes, outlines, truth = self._moving(state, session, camera, jitter)
        scene = self._scene(still | shapes)
        soft = self._quality.soft_px
        for outline, rays in outlines:
            box = covering(outline, session.size, soft)
            if box is None:
                continue
            x0, y0, x1, y1 = box
            seed = int(rng.integers(2**31))
            part = self._trace(scene, session, box, rays, seed)
            share = _inside(outline, box, soft)
            light[y0:y1, x0:x1] = share * part + (1 - share) * light[y0:y1, x0:x1]
        gain = frame_gain(session, rng)
        image = expose(levels(light, session) * np.float32(gain), session, rng)
        jpeg = encode(image, session.jpeg_quality)
        tips, front = truth
        return jpeg, FrameTruth(
            state.kind, tips, front, state.dye.name, gain == session.overexposed_gain
        )

    def _standing(self, session: SessionParameters) -> dict[str, Any]:
        described = stage(session, self._lamps.get(session.seed, Lamps()), mi.ScalarTransform4f)
        return {name: mi.load_dict(shape) for name, shape in described.items()}

    def _render_still(self, session: SessionParameters) -> tuple[dict[str, Any], Light]:
        """What stands still, loaded once, and the whole frame without a pipette."""
        shapes = self._standing(session)
        whole = (0, 0, *session.size)
        scene = self._scene(shapes)
        return shapes, self._trace(scene, session, whole, self._quality.still, session.seed)

    def _scene(self, shapes: dict[str, Any]) -> Any:
        integrator = {"type": "path", "max_depth": self._quality.depth}
        return mi.load_dict({"type": "scene", "integrator": integrator} | shapes)

    @staticmethod
    def _trace(
        scene: Any,
        session: SessionParameters,
        box: tuple[int, int, int, int],
        rays: int,
        seed: int,
    ) -> Light:
        """Linear light (B, G, R) in a part of the frame, ``(y1 - y0, x1 - x0, 3)``.

        What so few rays leave of noise is more than any camera's, and hides clear water: it is
        taken out by Intel's Open Image Denoise. 16 rays look like 300 then.
        """
        sensor = mi.load_dict(_sensor(session, box, rays))
        picture = np.array(mi.render(scene, sensor=sensor, spp=rays, seed=seed))[..., :3]
        light = pyoidn.denoise(np.nan_to_num(picture.astype(np.float32)), hdr=True)
        return np.ascontiguousarray(light[..., ::-1])

    def _moving(
        self,
        state: SceneState,
        session: SessionParameters,
        camera: Pinhole,
        jitter: Floats,
    ) -> tuple[dict[str, Any], list[tuple[Floats, int]], tuple[Any, int]]:
        """Pipette, tips and liquid; what they cover, px, and with how many rays; the truth."""
        shapes: dict[str, Any] = {}
        truths, depths = [], []
        bodies, tips = [], []
        for channel, content in enumerate(state.contents):
            origin = np.array(state.orifice) + channel * np.array([*state.pitch, 0.0])
            origin += jitter[0] * camera.level_right + np.array([0.0, 0.0, jitter[1]])
            placing = _placing(camera, origin, session.tip_tilt_deg)
            shapes |= _tip_shapes(channel, state, session, placing, self._sleeves.get(session.seed))
            hidden = -99.0 if state.rim_z is None else state.rim_z - float(origin[2])
            plane = camera.plane((*map(float, origin),), session.tip_tilt_deg)  # type: ignore[arg-type]
            truths.append(tip_truth(channel, plane, state, content, hidden))
            depths.append(float((origin - camera.eye) @ camera.forward))
            top = state.tip.length_mm + session.shaft_mm
            body = _body_width(state, session)
            wide = max(float(state.tip.outer_radius(state.tip.length_mm)), 3.0) + 0.6
            bodies.append(camera.project(_corners(placing, body / 2, top, top + 200.0)))
            tips.append(camera.project(_corners(placing, wide, -3.0, top)))
        # A row's tips stand so close that what holds them all is soon traced.
        outlines = [
            (np.concatenate(bodies), self._quality.body),
            (np.concatenate(tips), self._quality.tip),
        ]
        return shapes, outlines, (tuple(truths), int(np.argmin(depths)))


def _body_width(state: SceneState, session: SessionParameters) -> float:
    """Of the pipette above one channel, mm: those of a row stand side by side."""
    return session.body_mm if len(state.contents) == 1 else 9.0


def _corners(placing: Floats, half: float, low: float, high: float) -> Floats:
    """Corners of a box about a tip's axis in the scene, mm, ``(8, 3)``."""
    local = [(s * half, t * half, z, 1.0) for s in (-1, 1) for t in (-1, 1) for z in (low, high)]
    return np.asarray(np.array(local) @ placing.T[:, :3])


def _placing(camera: Pinhole, origin: Floats, tilt_deg: float) -> Floats:
    """From a tip's own mm (its axis is z) to the scene, shape ``(4, 4)``."""
    tilt = np.radians(tilt_deg)
    up = np.array([0.0, 0.0, 1.0])
    along = np.cos(tilt) * up + np.sin(tilt) * camera.level_right
    across = np.cos(tilt) * camera.level_right - np.sin(tilt) * up
    matrix = np.eye(4)
    matrix[:3] = np.stack([across, np.cross(along, across), along, origin], axis=1)
    return matrix


def _tip_shapes(
    channel: int,
    state: SceneState,
    session: SessionParameters,
    placing: Floats,
    sleeve: Sleeve | None,
) -> dict[str, Any]:
    content = state.contents[channel]
    liquid = Liquid(state.dye, session.dye_strength)
    parts = tip_surfaces(state.tip, content, liquid, session.shaft_mm, sleeve)
    wall = _frosted(session.frost)
    shapes: dict[str, Any] = {}
    for name, surfaces, bsdf in (
        ("plastic", parts.plastic, wall),
        ("bore", parts.bore, _clear(AIR, PLASTIC)),
        ("wet", parts.wet_bore, _clear(LIQUID, PLASTIC, dyed=True)),
        ("liquid", parts.liquid, _clear(LIQUID, AIR)),
        ("shaft", (parts.shaft,), plastic(session.shaft, 0.2)),
    ):
        for i, surface in enumerate(surfaces):
            shapes[f"{name}{channel}_{i}"] = _mesh(f"{name}{channel}_{i}", surface, placing, bsdf)
    high = state.tip.length_mm + session.shaft_mm
    transform = mi.ScalarTransform4f
    half = _body_width(state, session) / 2
    shapes[f"body{channel}"] = {
        "type": "cube",
        "to_world": transform(placing)
        @ transform().translate([0, 0, high + 100.0]).scale([half, half, 100.0]),
        "bsdf": plastic(session.body),
    }
    return shapes


def _frosted(frost: float) -> dict[str, Any]:
    """A tip's outer side: rough plastic that lets light through, with some white haze on it."""
    through = {
        "type": "roughdielectric",
        "int_ior": PLASTIC,
        "ext_ior": AIR,
        "alpha": 0.02 + 0.22 * frost,
        "distribution": "ggx",
    }
    haze = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.8}}
    return {"type": "blendbsdf", "weight": 0.02 + 0.15 * frost, "a": through, "b": haze}


def _clear(inside: float, outside: float, dyed: bool = False) -> dict[str, Any]:
    bsdf: dict[str, Any] = {"type": "dielectric", "int_ior": inside, "ext_ior": outside}
    if dyed:
        bsdf["specular_transmittance"] = {"type": "mesh_attribute", "name": "vertex_color"}
    return bsdf


def _mesh(name: str, surface: Surface, placing: Floats, bsdf: dict[str, Any]) -> Any:
    """A surface as Mitsuba's mesh, in the scene."""
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh(
        name, len(surface.points), len(surface.faces), props=properties, has_vertex_normals=True
    )
    if surface.colour is not None:
        mesh.add_attribute("vertex_color", 3, surface.colour.astype(np.float32).ravel())
    points = surface.points @ placing[:3, :3].T + placing[:3, 3]
    normals = surface.normals @ placing[:3, :3].T
    state = mi.traverse(mesh)
    state["vertex_positions"] = points.astype(np.float32).ravel()
    state["vertex_normals"] = normals.astype(np.float32).ravel()
    state["faces"] = surface.faces.ravel()
    state.update()
    return mesh


def _sensor(
    session: SessionParameters, box: tuple[int, int, int, int], rays: int
) -> dict[str, Any]:
    width, height = session.size
    x0, y0, x1, y1 = box
    up = np.array([0.0, 0.0, 1.0])
    transform = mi.ScalarTransform4f
    view = transform().look_at(origin=session.eye, target=session.look, up=up)
    return {
        "type": "perspective",
        "fov_axis": "x",
        "fov": float(np.degrees(2 * np.arctan(width / 2 / session.focal_px))),
        "near_clip": 10.0,
        "far_clip": 5000.0,
        "to_world": view @ transform().rotate([0, 0, 1], session.roll_deg),
        "film": {
            "type": "hdrfilm",
            "width": width, "height": height,
            "crop_offset_x": x0, "crop_offset_y": y0,
            "crop_width": x1 - x0, "crop_height": y1 - y0,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
        },
        "sampler": {"type": "independent", "sample_count": rays},
    }  # fmt: skip


def _inside(outline: Floats, box: tuple[int, int, int, int], soft: int) -> Light:
    """1 within the hull of an outline and soft at its edge, ``(h, w, 1)``."""
    x0, y0, x1, y1 = box
    mask = np.zeros((y1 - y0, x1 - x0), np.float32)
    hull = cv2.convexHull((outline - (x0, y0)).astype(np.float32))
    cv2.fillConvexPoly(mask, np.round(hull).astype(np.int32), 1.0)
    mask = cv2.dilate(mask, np.ones((2 * soft + 1,) * 2, np.uint8))
    return np.asarray(cv2.GaussianBlur(mask, (0, 0), soft / 2)[..., None], np.float32)


def covering(pixels: Floats, size: tuple[int, int], soft: int) -> tuple[int, int, int, int] | None:
    low = np.floor(pixels.min(axis=0)).astype(int)
    high = np.ceil(pixels.max(axis=0)).astype(int)
    x0, y0 = max(int(low[0]) - 3 * soft, 0), max(int(low[1]) - 3 * soft, 0)
    x1 = min(int(high[0]) + 3 * soft, size[0])
    y1 = min(int(high[1]) + 3 * soft, size[1])
    return (x0, y0, x1, y1) if x1 - x0 > 1 and y1 - y0 > 1 else None


def levels(light: Light, session: SessionParameters) -> Light:
    """Linear light to grey levels: lens blur, gamma, light field and white balance."""
    if session.blur_px > 0.05:
        light = np.asarray(cv2.GaussianBlur(light, (0, 0), session.blur_px), np.float32)
    levels = 255.0 * np.power(np.maximum(light, 0.0), 1.0 / GAMMA)
    return np.asarray(levels * light_field(session), np.float32)
