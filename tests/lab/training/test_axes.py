"""Axes from boxes: what a camera sees of a known tip gives the tip back."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot_lab.training.axes import PlateCamera, TipLabel, rendered_labels

PLATE = {
    "eye": [20.0, -550.0, 130.0],
    "look": [5.0, 0.0, 55.0],
    "roll": 1.5,
    "fov": 49.0,
    "size": [960, 540],
}


def test_a_point_that_is_lifted_is_seen_where_it_was() -> None:
    camera = PlateCamera.from_meta(PLATE)
    point = camera.lift(300.0, 200.0, 480.0)
    assert camera.project(point[None])[0] == pytest.approx((300.0, 200.0))


def test_the_look_at_point_is_seen_in_the_middle() -> None:
    camera = PlateCamera.from_meta(PLATE)
    assert camera.project(np.array([PLATE["look"]], float))[0] == pytest.approx((480.0, 270.0))


def test_axes_come_back_from_the_boxes_of_upright_cylinders() -> None:
    camera = PlateCamera.from_meta(PLATE)
    angles = np.linspace(0, 2 * np.pi, 64)
    ring = np.stack([4.0 * np.cos(angles), 4.0 * np.sin(angles), 0 * angles], axis=-1)
    boxes, ends = [], []
    for x in (-120.0, -40.0, 30.0, 110.0):
        foot, head = np.array([x, -40.0, 15.0]), np.array([x, -40.0, 102.0])
        seen = camera.project(np.concatenate([ring + foot, ring + head]))
        boxes.append([*seen.min(axis=0), *np.ptp(seen, axis=0)])
        ends.append(camera.project(np.stack([head, foot])))
    labels = rendered_labels([camera] * 4, np.array(boxes))
    for label, (collar, orifice) in zip(labels, ends, strict=True):
        assert label.collar == pytest.approx(collar, abs=0.3)
        assert label.orifice == pytest.approx(orifice, abs=0.3)
        assert label.radius == pytest.approx(4.0 / 87.0 * label.length, rel=0.05)


def test_a_label_moves_with_its_image() -> None:
    label = TipLabel((10.0, 20.0), (12.0, 120.0), 8.0).mapped(-0.5, 0.5, 100.0, 3.0)
    assert label == TipLabel((95.0, 13.0), (94.0, 63.0), 4.0)
