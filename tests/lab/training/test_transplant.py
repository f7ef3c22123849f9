"""Recorded pipettes before other rooms."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.transplant import transplanted

LABEL = TipLabel((100.0, 80.0), (100.0, 180.0), 8.0)


@pytest.fixture
def room() -> np.ndarray:
    return np.full((240, 200, 3), 30, np.uint8)


@pytest.fixture
def frame(room: np.ndarray) -> np.ndarray:
    image = room.copy()
    image[:80, 95:106] = 200  # the shaft
    image[80:180, 93] = image[80:180, 107] = 160  # a clear tip: its two walls
    image[200:220, 20:60] = 120  # a shadow, a splash: not the pipette
    return image


def test_the_pipette_stays_and_the_room_changes(frame: np.ndarray, room: np.ndarray) -> None:
    other = np.full_like(room, 110)
    shown = transplanted(np.random.default_rng(0), frame, room, other, LABEL)
    assert np.abs(shown[20:70, 97:104].astype(int) - 200).max() <= 3
    assert np.abs(shown[:, :80].astype(int) - 110).max() <= 2
    assert np.abs(shown[200:220, 20:60].astype(int) - 110).max() <= 2


def test_the_new_room_shines_through_the_tip(frame: np.ndarray, room: np.ndarray) -> None:
    bright = transplanted(np.random.default_rng(0), frame, room, np.full_like(room, 180), LABEL)
    dark = transplanted(np.random.default_rng(0), frame, room, np.full_like(room, 20), LABEL)
    inside = (slice(110, 120), slice(98, 103))
    assert bright[inside].mean() > dark[inside].mean() + 30
    # Its walls are still to be seen before the dark room.
    assert dark[110:120, 93].mean() > dark[110:120, 88].mean() + 40


def test_every_tip_of_a_row_veils_the_new_room(frame: np.ndarray, room: np.ndarray) -> None:
    frame[:, 40:61] = frame[:, 90:111]  # another one beside it
    beside = TipLabel((50.0, 80.0), (50.0, 180.0), 8.0)
    row = TipLabel(LABEL.collar, LABEL.orifice, LABEL.radius, (beside,))
    shown = transplanted(np.random.default_rng(0), frame, room, np.full_like(room, 180), row)
    for x in (50, 100):
        assert 60 < shown[110:120, x - 2 : x + 3].mean() < 170


def test_a_frame_without_a_tip_keeps_its_bare_nozzle(room: np.ndarray) -> None:
    image = room.copy()
    image[:80, 95:106] = 200
    shown = transplanted(np.random.default_rng(0), image, room, np.full_like(room, 90), None)
    assert shown[40, 100].min() > 190
    assert np.abs(shown[90:, :].astype(int) - 90).max() <= 2


def test_an_empty_room_is_replaced(room: np.ndarray) -> None:
    other = np.full_like(room, 90)
    assert (transplanted(np.random.default_rng(0), room, room, other, None) == other).all()
