"""Maps to tip axes, on the very maps that the network is trained to give."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.detection.decode import candidates
from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.examples import targets


@pytest.mark.parametrize(
    "label",
    [
        TipLabel((100.3, 40.9), (104.6, 130.2), 9.0),
        TipLabel((5.0, 3.0), (4.0, 60.0), 3.0),
        TipLabel((200.0, 20.0), (180.5, 200.1), 14.0),
    ],
)
def test_ideal_maps_give_the_tip_to_a_tenth_of_a_pixel(label: TipLabel) -> None:
    maps, _ = targets(56, 96, label)
    (found,) = candidates(maps, 0.1, 3)
    assert found.collar == pytest.approx(label.collar, abs=0.1)
    assert found.orifice == pytest.approx(label.orifice, abs=0.1)
    assert found.radius == pytest.approx(label.radius, rel=0.02)
    assert found.score > 0.9


def test_cold_maps_give_nothing() -> None:
    maps, _ = targets(56, 96, None)
    assert candidates(maps, 0.05, 3) == []


def test_two_tips_come_warmest_first() -> None:
    strong, _ = targets(56, 96, TipLabel((100.0, 40.0), (100.0, 130.0), 9.0))
    weak, _ = targets(56, 96, TipLabel((300.0, 60.0), (300.0, 140.0), 9.0))
    maps = np.where(strong[:1] > 0.01, strong, np.zeros_like(strong))
    maps[:2] = np.maximum(strong[:2], 0.6 * weak[:2])
    right = np.arange(96)[None, None, :] > 50
    maps[2:] = np.where(right, weak[2:], strong[2:])
    found = candidates(maps, 0.1, 3)
    assert [round(c.collar[0]) for c in found] == [100, 300]
    assert found[0].score > found[1].score > 0.5


def test_an_orifice_above_its_collar_is_no_tip() -> None:
    maps, _ = targets(56, 96, TipLabel((100.0, 130.0), (100.0, 40.0), 9.0))
    assert candidates(maps, 0.1, 3) == []
