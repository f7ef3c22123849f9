"""Path-traced frames of the simulated scenes: Mitsuba in the place of ``simulation.render``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cv2
import mitsuba as mi
import numpy as np
from numpy.typing import NDArray

from aegis_ot.simulation.backdrop import light_field
from aegis_ot.simulation.exposure import encode, expose, frame_gain
from aegis_ot.simulation.optics import Pinhole
from aegis_ot.simulation.scene import SceneState
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import FrameTruth, tip_truth

from .lathe import Surface
from .stage import Lamps, plastic, stage
from .tips import GAMMA, Liquid, tip_surfaces

mi.set_variant("scalar_rgb")

Floats = NDArray[np.float64]
Light = NDArray[np.float32]

PLASTIC, LIQUID, AIR = 1.49, 1.333, 1.0
"""Refractive indices: polypropylene, water, air."""
SOFT_PX = 24
"""Width over which what is rendered anew passes into what stands still, px."""


@dataclass(frozen=True)
class Quality:
    """Rays per pixel, and surfaces a ray may meet: a filled tip has eight on the way through."""

    still: int = 48
    moving: int = 48
    depth: int = 20


class PathTracer:
    """Renders one session's frames; call it where ``simulation.render_jpeg`` is called.

    Args:
        lamps: Light of each session, by the session's seed.
        quality: Rays per pixel.
    """

    def __init__(self, lamps: Mapping[int, Lamps], quality: Quality | None = None) -> None:
        self._lamps = lamps
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
        shapes, box, truth = self._moving(state, session, camera, jitter)
        if box is not None:
            x0, y0, x1, y1 = box
            seed = int(rng.integers(2**31))
            part = self._trace(still | shapes, session, box, self._quality.moving, seed)
            share = _soft_edges(box, session.size)
            light[y0:y1, x0:x1] = share * part + (1 - share) * light[y0:y1, x0:x1]
        gain = frame_gain(session, rng)
        image = expose(_levels(light, session) * np.float32(gain), session, rng)
        jpeg = encode(image, session.jpeg_quality)
        tips, front = truth
        return jpeg, FrameTruth(
            state.kind, tips, front, state.dye.name, gain == session.overexposed_gain
        )

    def _render_still(self, session: SessionParameters) -> tuple[dict[str, Any], Light]:
        """What stands still, loaded once, and the whole frame without a pipette."""
        described = stage(session, self._lamps[session.seed], mi.ScalarTransform4f)
        shapes = {name: mi.load_dict(shape) for name, shape in described.items()}
        whole = (0, 0, *session.size)
        return shapes, self._trace(shapes, session, whole, self._quality.still, session.seed)

    def _trace(
        self,
        shapes: dict[str, Any],
        session: SessionParameters,
        box: tuple[int, int, int, int],
        rays: int,
        seed: int,
    ) -> Light:
        """Linear light (B, G, R) in a part of the frame, ``(y1 - y0, x1 - x0, 3)``."""
        scene = mi.load_dict(
            {"type": "scene", "integrator": {"type": "path", "max_depth": self._quality.depth}}
            | {"camera": _sensor(session, box, rays)}
            | shapes
        )
        picture = np.array(mi.render(scene, spp=rays, seed=seed))[..., :3]
        return np.ascontiguousarray(picture[..., ::-1], np.float32)

    def _moving(
        self,
        state: SceneState,
        session: SessionParameters,
        camera: Pinhole,
        jitter: Floats,
    ) -> tuple[dict[str, Any], tuple[int, int, int, int] | None, tuple[Any, int]]:
        """Pipette, tips and liquid; the part of the frame that they cover; the truth."""
        shapes: dict[str, Any] = {}
        truths, corners = [], []
        depths = []
        for channel, content in enumerate(state.contents):
            origin = np.array(state.orifice) + channel * np.array([*state.pitch, 0.0])
            origin += jitter[0] * camera.level_right + np.array([0.0, 0.0, jitter[1]])
            placing = _placing(camera, origin, session.tip_tilt_deg)
            shapes |= _tip_shapes(channel, state, session, placing)
            hidden = -99.0 if state.rim_z is None else state.rim_z - float(origin[2])
            plane = camera.plane((*map(float, origin),), session.tip_tilt_deg)  # type: ignore[arg-type]
            truths.append(tip_truth(channel, plane, state, content, hidden))
            depths.append(float((origin - camera.eye) @ camera.forward))
            half = max(session.body_mm / 2, 6.0) + 3.0
            reach = state.tip.length_mm + session.shaft_mm + 200.0
            local = [(s * half, t * half, z, 1.0) for s in (-1, 1) for t in (-1, 1)
                     for z in (-6.0, reach)]  # fmt: skip
            corners.append(np.array(local) @ placing.T[:, :3])
        box = _covering(camera.project(np.concatenate(corners)), session.size)
        return shapes, box, (tuple(truths), int(np.argmin(depths)))


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
    channel: int, state: SceneState, session: SessionParameters, placing: Floats
) -> dict[str, Any]:
    content = state.contents[channel]
    liquid = Liquid(state.dye, session.dye_strength)
    parts = tip_surfaces(state.tip, content, liquid, session.shaft_mm)
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
    shapes[f"body{channel}"] = {
        "type": "cube",
        "to_world": transform(placing)
        @ transform().translate([0, 0, high + 100.0]).scale(
            [session.body_mm / 2 if len(state.contents) == 1 else 4.5,
             session.body_mm / 2 if len(state.contents) == 1 else 4.5, 100.0]
        ),
        "bsdf": plastic(session.body),
    }  # fmt: skip
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


def _soft_edges(box: tuple[int, int, int, int], size: tuple[int, int]) -> Light:
    """1 inside and falling to 0 at those sides of a box that lie in the frame, ``(h, w, 1)``.

    The pipette's shade falls beyond the box; without this its sides would show.
    """
    x0, y0, x1, y1 = box
    x, y = np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5
    left = x - x0 if x0 > 0 else np.full_like(x, np.inf)
    right = x1 - x if x1 < size[0] else np.full_like(x, np.inf)
    bottom = y1 - y if y1 < size[1] else np.full_like(y, np.inf)
    across = np.minimum(left, right)[None, :]
    share = np.minimum(across, bottom[:, None]) / SOFT_PX
    return np.clip(share, 0.0, 1.0).astype(np.float32)[..., None]


def _covering(pixels: Floats, size: tuple[int, int]) -> tuple[int, int, int, int] | None:
    low = np.floor(pixels.min(axis=0)).astype(int)
    high = np.ceil(pixels.max(axis=0)).astype(int)
    x0, y0 = max(int(low[0]) - SOFT_PX, 0), max(int(low[1]), 0)
    x1, y1 = min(int(high[0]) + SOFT_PX, size[0]), min(int(high[1]) + SOFT_PX, size[1])
    return (x0, y0, x1, y1) if x1 - x0 > 1 and y1 - y0 > 1 else None


def _levels(light: Light, session: SessionParameters) -> Light:
    """Linear light to grey levels: lens blur, gamma, light field and white balance."""
    if session.blur_px > 0.05:
        light = np.asarray(cv2.GaussianBlur(light, (0, 0), session.blur_px), np.float32)
    levels = 255.0 * np.power(np.maximum(light, 0.0), 1.0 / GAMMA)
    return np.asarray(levels * light_field(session), np.float32)
