"""How one pipette tip and what it holds look: light through a cone of plastic and liquid.

All is done in grey levels, where the dyes' transmissions were measured, not in linear light.
"""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from ..vision.tips import TipGeometry
from .dyes import REFERENCE_PATH_MM, Dye
from .reflections import (
    Plane,
    TipPatch,
    column_edges,
    edges,
    glints,
    menisci,
    meniscus_height,
    specks,
)
from .scene import TipContent
from .session import SessionParameters


def shade_tip(
    behind: Plane,
    view: TipPatch,
    tip: TipGeometry,
    content: TipContent,
    dye: Dye,
    parameters: SessionParameters,
) -> Plane:
    """Draw shaft, tip and liquid over what lies behind: float32 ``(h, w, 3)`` to the same."""
    image = _shaft(behind, view, tip, content.present, parameters)
    if content.present:
        # The shaft above takes half of the patch: leave it out of the costly part.
        part = np.flatnonzero(view.along.min(axis=1) < tip.length_mm + 1)
        if part.size:
            rows = slice(int(part[0]), int(part[-1]) + 1)
            low = replace(view, across=view.across[rows], along=view.along[rows])
            image[rows] = _tip(image[rows], low, tip, content, dye, parameters)
    return _hide(image, behind, view)


def _tip(
    image: Plane,
    view: TipPatch,
    tip: TipGeometry,
    content: TipContent,
    dye: Dye,
    parameters: SessionParameters,
) -> Plane:
    """Tip and liquid over what lies behind, the shaft's end included."""
    h, u = view.along, np.abs(view.across)
    # Outside the ends the radii are those of the ends.
    inner = tip.inner_radius(h.astype(np.float64)).astype(np.float32)
    outer = inner + np.float32(tip.wall_mm)
    ring = (h > tip.length_mm - tip.collar_mm) & (h < tip.length_mm)
    outer = outer + ring * np.float32(0.35 * tip.wall_mm)
    inside = _cover(outer - u, view) * _cover(h, view) * _cover(tip.length_mm - h, view)

    chord = 2 * np.sqrt(np.maximum(inner**2 - u**2, 0))
    wall = 2 * np.sqrt(np.maximum(outer**2 - u**2, 0)) - chord
    liquid = _liquid(view, tip, content, inner, parameters)
    wet = liquid * (u < inner)

    # Haze of the wall: lit from the front, so it brightens what is dark and dims what is bright.
    opacity = 1 - np.exp(-(0.10 + 0.55 * parameters.frost) * wall / (2 * tip.wall_mm + 0.2))
    side = np.clip(view.across / outer, -1, 1) * float(np.sign(parameters.glint_side))
    haze = (0.55 * (1 + 0.25 * side) * float(np.mean(parameters.shaft)))[..., None]

    # A filled tip is a strong lens: what is behind is swapped left to right and drawn apart.
    through = image
    if content.liquid_ul > 0:
        bent = _refract(image, view, parameters.lens)
        dim = 1 - 0.25 * parameters.lens * np.clip(u / np.maximum(inner, 1e-3), 0, 1) ** 4
        through = image + wet[..., None] * (bent * dim[..., None] - image)
    milky = opacity[..., None]
    back = through + 0.75 * milky * (haze - through)
    if parameters.piping > 0 and view.hidden_below > 0:
        back += _piping(view, wet, parameters)[..., None] * np.asarray(view.under, np.float32)
    if not dye.is_clear:
        path = wet * chord + _film_path(view, tip, content, inner, wet)
        back *= _transmission(dye, path, parameters)
    front = back + 0.15 * milky * (haze - back)

    lines = edges(u, inner, outer, wet, view, parameters)
    lines = lines + glints(view, inner, outer, wet, parameters)
    lines = lines + menisci(view, tip, content, inner, parameters)
    lines = lines + specks(view, tip, parameters)
    front += lines[..., None] * (0.9 * np.asarray(parameters.shaft, np.float32) - 0.25 * front)
    image = image + inside[..., None] * (front - image)
    if content.drop_ul > 0:
        image = _drop(image, view, content.drop_ul, dye, parameters)
    return np.asarray(image, np.float32)


def _cover(distance_mm: Plane, view: TipPatch) -> Plane:
    """Share of a pixel that lies on the positive side of an edge."""
    return np.asarray(np.clip(distance_mm / view.mm_per_px + 0.5, 0, 1), np.float32)


def _step(distance: Plane, width_10_90: Plane | float) -> Plane:
    """A soft edge: the logistic curve nearest to an error function of that 10-90 % width."""
    scale = np.maximum(width_10_90, 1e-3) / 4.394
    return np.asarray(1 / (1 + np.exp(-np.clip(distance / scale, -30, 30))), np.float32)


def _liquid(
    view: TipPatch, tip: TipGeometry, content: TipContent, inner: Plane, p: SessionParameters
) -> Plane:
    """Share of liquid at each pixel of the bore, 0 to 1."""
    u = np.abs(view.across)
    share = np.zeros_like(u)
    pieces = column_edges(tip, content)
    for i, (bottom, top) in enumerate(pieces):
        last = i == len(pieces) - 1
        # Only the upper end is spread by curvature and view; a bubble's ends are short.
        width = inner * (p.meniscus_edge if last else 0.35)
        upper = _step(meniscus_height(top, u, inner) - view.along, width)
        lower = 1.0 if i == 0 else _step(view.along - bottom + 0.2 * inner, 0.35 * inner)
        share = np.maximum(share, upper * lower)
    return np.asarray(share * (view.along > -0.2), np.float32)


def _refract(image: Plane, view: TipPatch, strength: float) -> Plane:
    """What is behind, mirrored about the axis and widened."""
    height, width = view.across.shape
    ys, xs = np.mgrid[0:height, 0:width].astype(np.float32)
    shift = -(1.0 + 1.6 * strength) * view.across / view.mm_per_px
    seen = np.clip(xs + shift - 0.0, 0, width - 1).astype(np.float32)
    return np.asarray(
        cv2.remap(image, seen, ys, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE), np.float32
    )


def _piping(view: TipPatch, wet: Plane, p: SessionParameters) -> Plane:
    """Light from the labware below that runs up the column."""
    reach = np.exp(-np.maximum(view.along - view.hidden_below, 0) / 22.0)
    return np.asarray(p.piping * wet * reach, np.float32)


def _film_path(
    view: TipPatch, tip: TipGeometry, content: TipContent, inner: Plane, wet: Plane
) -> Plane:
    """Path of light through what is left on the wall: a thin film and a few beads, mm."""
    if content.film_ul <= 0:
        return np.zeros_like(wet)
    top = tip.height_of(max(content.film_to_ul, content.liquid_ul))
    low = tip.height_of(content.liquid_ul)
    # The film lies over all that was wet; liquid drawn again covers its lower part.
    area = max(2 * np.pi * float(tip.inner_radius(top / 2)) * top, 1e-3)
    spread = _step(top - view.along, 1.5) * (view.along > low)
    path = 2 * 0.6 * content.film_ul / area * spread
    for _ in range(int(view.beads.integers(1, 5))):
        at = view.beads.uniform(low, max(top, low + 1e-3))
        side = view.beads.uniform(-0.8, 0.8) * float(tip.inner_radius(at))
        bare = content.film_ul * (top - low) / max(top, 1e-3)
        size = float(np.cbrt(0.4 * bare / 5 * 3 / (4 * np.pi))) + 0.05
        away = ((view.along - at) ** 2 + (view.across - side) ** 2) / size**2
        path = path + 2 * size * np.exp(-2 * away)
    return np.asarray(path * (1 - wet) * (np.abs(view.across) < inner), np.float32)


def _transmission(dye: Dye, path: Plane, p: SessionParameters) -> Plane:
    if dye.is_clear:
        return np.ones((*path.shape, 3), np.float32)
    logs = p.dye_strength * np.log(np.clip(dye.transmission, 1e-3, 1.0)).astype(np.float32)
    return np.asarray(np.exp(path[..., None] * (logs / np.float32(REFERENCE_PATH_MM))), np.float32)


def _drop(image: Plane, view: TipPatch, drop_ul: float, dye: Dye, p: SessionParameters) -> Plane:
    radius = float(np.cbrt(3 * drop_ul / (4 * np.pi)))
    away = np.hypot(view.across, view.along + 0.8 * radius)
    cover = _cover(radius - away, view)
    path = np.asarray(2 * np.sqrt(np.maximum(radius**2 - away**2, 0)), np.float32)
    body = (0.85 * image + 0.12 * np.asarray(p.shaft, np.float32)) * _transmission(dye, path, p)
    spot = np.hypot(view.across - p.glint_side * 0.5 * radius, view.along + 0.4 * radius)
    body = body + 90 * p.glint * np.exp(-((spot / (0.3 * radius)) ** 2))[..., None]
    rim = np.exp(-(((away - radius) / max(0.15 * radius, 0.5 * view.mm_per_px)) ** 2))
    body = body * (1 - 0.25 * rim[..., None])
    return np.asarray(image + cover[..., None] * (body - image), np.float32)


def _shaft(
    behind: Plane, view: TipPatch, tip: TipGeometry, present: bool, p: SessionParameters
) -> Plane:
    """The pipette's nozzle and shaft: an opaque cylinder that narrows at its end."""
    end = tip.free_mm
    up = view.along - end
    # The nozzle tapers over its last millimetres, and wears an O-ring further up.
    fit = np.clip(up / max(tip.overlap_mm, 1.0), 0, 1)
    bore = tip.inner_radius(np.array([tip.length_mm]))[0]
    radius = np.minimum(0.86 + 0.14 * fit, 1.0) * np.float32(min(bore, tip.nozzle_radius_mm))
    above = up > tip.overlap_mm
    radius = np.where(above, np.float32(tip.nozzle_radius_mm * 1.05), radius)
    cover = _cover(radius - np.abs(view.across), view) * _cover(up, view)
    round_ = np.clip(view.across / radius, -1, 1)
    shade = 0.72 + 0.28 * np.sqrt(1 - round_**2) + 0.10 * np.sign(p.glint_side) * round_
    shade = shade + 0.15 * np.exp(-(((round_ - p.glint_side) / 0.2) ** 2))
    ring = np.abs(up - 0.45 * tip.overlap_mm) < 0.12 * tip.overlap_mm
    shade = shade * np.where(ring & (not present), 0.6, 1.0)
    colour = np.asarray(p.shaft, np.float32) * np.asarray(shade, np.float32)[..., None]
    return np.asarray(behind + cover[..., None] * (colour - behind), np.float32)


def _hide(image: Plane, behind: Plane, view: TipPatch) -> Plane:
    """Labware hides what is below its rim; the well's far wall shows a little of the tip."""
    if view.hidden_below <= -50:
        return image
    seen = _cover(view.along - view.hidden_below, view)
    return np.asarray(behind + seen[..., None] * (image - behind), np.float32)
