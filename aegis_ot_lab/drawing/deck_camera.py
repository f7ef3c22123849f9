"""A simulated camera before a robot's own deck: what it shows lies where keyframes say that it is.

For whoever measures registration. The product's simulated camera stands nearer.

The robot's coordinates are carried over as they are, moved so that the labware in use lies about
the middle of the scene. As a laboratory would, the camera is set up so that all of it is in view;
where more labware comes into use than a run announced, the camera is set up anew.
"""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.simulation.dyes import dye_for
from aegis_ot.simulation.optics import Pinhole
from aegis_ot.simulation.scene import SceneState
from aegis_ot.simulation.session import SessionLabware
from aegis_ot.vision.tips import TipGeometry, is_flex, tip_for
from aegis_ot.vocabulary import Keyframe, KeyframeKind

Point = tuple[float, float, float]
_Slot = tuple[int, int]

_PITCH_OT2, _PITCH_FLEX = (132.5, 90.5), (164.0, 107.0)
"""Distance of slots, right and back, mm (deck definitions ``ot2_standard``, ``ot3_standard``)."""

_IN_WELL = (KeyframeKind.ASPIRATE, KeyframeKind.DISPENSE)
_DEPTH_MM = 9.0
"""How deep a tip stands in labware where it is first seen in it; no more than a quarter of it."""

_RAISED_MM = 50.0
"""Up to this height above the deck tips' ends are in view, mm; higher where the robot is higher."""

_MARGIN = 0.04
"""What stays free at the frame's edges, as a share."""

_MOST_DECKS = 8
"""Runs whose decks are remembered."""


@dataclass(frozen=True)
class DeckPlace:
    """Where a keyframe's tip stands in the scene.

    Attributes:
        parameters: Camera, light and deck, with the labware in use.
        orifice: Where the first channel's tip ends, mm.
        rim_z: Height below which labware hides the tip, mm; ``None`` if nothing hides it.
    """

    parameters: SessionParameters
    orifice: Point
    rim_z: float | None


class DeckView:
    """One run's deck as a camera sees it.

    Args:
        base: The set-up: direction, distance and light; its labware lends colours and wells.
    """

    def __init__(self, base: SessionParameters) -> None:
        self._base = base
        self._slots: dict[_Slot, float | None] = {}
        self._pitch = _PITCH_OT2
        self._highest_mm = 0.0
        self._announced: dict[_Slot, list[Point]] = {}
        self._parameters = base

    def expect(self, keyframes: Iterable[Keyframe]) -> None:
        """Places that will be in use, from a rehearsal: no more than these has to be in view."""
        for keyframe in keyframes:
            if keyframe.channels == 1 and keyframe.position is not None:
                self._note(keyframe)
                x, y, z = keyframe.position
                ends = self._announced.setdefault(self._slot_at(keyframe.position), [])
                ends += [(x, y, z), (x, y, z + _tip_of(keyframe).length_mm)]
        if self._announced:
            self._parameters = self._set_up()

    def place(self, keyframe: Keyframe, position: Point) -> DeckPlace:
        """Where the tip of a keyframe with a position stands."""
        self._note(keyframe)
        x, y, z = position
        left, front = self._origin()
        inside = keyframe.kind in _IN_WELL
        rim = None
        if inside:
            tip, height = _tip_of(keyframe), self._slots[self._slot_at(position)]
            assert height is not None
            rim = min(height, z + tip.length_mm / 3)
        return DeckPlace(self._parameters, (x - left, y - front, z), rim)

    def _note(self, keyframe: Keyframe) -> None:
        """Take a keyframe's labware into view; the camera is set up anew if it was not yet."""
        before = dict(self._slots), self._highest_mm
        self._pitch = _PITCH_FLEX if is_flex(keyframe.pipette) else _PITCH_OT2
        for well in (*keyframe.sources[:1], *keyframe.destinations[:1]):
            slot = _slot_named(well.slot)
            if slot is not None:
                self._slots.setdefault(slot, None)
        tip = _tip_of(keyframe)
        top = _RAISED_MM + tip.length_mm
        if keyframe.position is not None:
            slot, z = self._slot_at(keyframe.position), keyframe.position[2]
            self._slots.setdefault(slot, None)
            if keyframe.kind in _IN_WELL and self._slots[slot] is None:
                self._slots[slot] = max(z + min(_DEPTH_MM, tip.length_mm / 4), 3.0)
            height = self._slots[slot]
            if keyframe.kind not in _IN_WELL and height is not None:
                self._slots[slot] = max(min(height, z - 1.0), 3.0)  # a raised tip hangs above it
            top = max(top, z + tip.length_mm)
        self._highest_mm = max(self._highest_mm, top)
        if (self._slots, self._highest_mm) != before and self._slots:
            self._parameters = self._set_up()

    def _slot_at(self, position: Point) -> _Slot:
        return int(position[0] // self._pitch[0]), int(position[1] // self._pitch[1])

    def _middle_of(self, slot: _Slot) -> tuple[float, float]:
        """Of the labware in a slot, on the deck, mm."""
        return (
            slot[0] * self._pitch[0] + SessionLabware.WIDTH / 2,
            slot[1] * self._pitch[1] + SessionLabware.DEPTH / 2,
        )

    def _origin(self) -> tuple[float, float]:
        """The place on the deck that lies in the middle of the scene, mm."""
        middles = np.array([self._middle_of(slot) for slot in self._slots])
        x, y = (middles.min(axis=0) + middles.max(axis=0)) / 2
        return float(x), float(y)

    def _set_up(self) -> SessionParameters:
        base, (left, front) = self._base, self._origin()
        looks = base.labware or (SessionLabware(0.0, 0.0, 14.5, (205.0, 204.0, 202.0)),)
        blocks = []
        for number, (slot, height) in enumerate(self._slots.items()):
            like, (x, y) = looks[min(number, len(looks) - 1, 1)], self._middle_of(slot)
            known = like.height_mm if height is None else height
            blocks.append(replace(like, x=x - left, y=y - front, height_mm=known))
        there = replace(base, labware=tuple(blocks))
        return replace(there, focal_px=base.focal_px * min(1.0, self._shrink(there)))

    def _shrink(self, parameters: SessionParameters) -> float:
        """Factor of the focal length by which all tips over the labware are in view."""
        left, front = self._origin()
        points = [
            (x - left, y - front, z)
            for slot in self._slots
            for x, y, z in self._announced.get(slot) or self._corners_of(slot)
        ]
        half = np.array(parameters.size) / 2
        away = np.abs(Pinhole(parameters).project(points) - half) / (half * (1 - 2 * _MARGIN))
        return float(1.0 / max(away.max(), 1e-6))

    def _corners_of(self, slot: _Slot) -> list[Point]:
        """Where the ends of tips over a labware may be, on the deck, mm."""
        (x, y), half_x, half_y = self._middle_of(slot), 52.0, 34.0
        return [
            (x + side * half_x, y + end * half_y, z)
            for side in (-1, 1)
            for end in (-1, 1)
            for z in (3.0, self._highest_mm)
        ]


class DeckCamera(SimulatedCamera):
    """Shows keyframes of a single tip that say where it is from before that deck; others, rows of
    tips among them, as any simulated camera does. Takes the arguments of one.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._decks: OrderedDict[str, DeckView] = OrderedDict()
        self._expected: tuple[Keyframe, ...] = ()

    @property
    def parameters(self) -> SessionParameters:
        """Camera, light and deck in use."""
        with self._lock:
            place = None if self._keyframe is None else self._place(self._keyframe)
            return super().parameters if place is None else place.parameters

    def expect(self, keyframes: Iterable[Keyframe]) -> None:
        """Learn from a rehearsal which wells are to come: their labware has to be in view."""
        with self._lock:
            self._expected = tuple(keyframes)
            self._decks.clear()
            super().expect(self._expected)

    def _place(self, keyframe: Keyframe) -> DeckPlace | None:
        if keyframe.position is None or keyframe.channels != 1:
            return None
        if keyframe.run not in self._decks:
            self._decks[keyframe.run] = DeckView(super().parameters)
            self._decks[keyframe.run].expect(self._expected)
            while len(self._decks) > _MOST_DECKS:
                self._decks.popitem(last=False)
        return self._decks[keyframe.run].place(keyframe, keyframe.position)

    def _scene(self, keyframe: Keyframe) -> SceneState:
        place = self._place(keyframe)
        if place is None or self._state is None:
            return super()._scene(keyframe)
        wells = keyframe.destinations or keyframe.sources
        return SceneState(
            keyframe.kind,
            _tip_of(keyframe),
            self._state.contents,
            dye_for(keyframe.reagent, self._colours),
            place.orifice,
            place.rim_z,
            row=wells[0].name[:1] if wells else "",
        )


def _tip_of(keyframe: Keyframe) -> TipGeometry:
    return tip_for(keyframe.pipette, keyframe.capacity_ul)


def _slot_named(name: str) -> _Slot | None:
    """Column and row, from 0 at the left front: ``"4"`` is (0, 1) on an OT-2, ``"C2"`` (1, 1) on
    a Flex; ``None`` for another name."""
    if re.fullmatch("[1-9]|1[0-2]", name):
        return (int(name) - 1) % 3, (int(name) - 1) // 3
    if re.fullmatch("[A-D][1-4]", name):
        return int(name[1]) - 1, "DCBA".index(name[0])
    return None
