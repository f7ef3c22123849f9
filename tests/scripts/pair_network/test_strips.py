"""Drawn pairs show what they say that they show."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from aegis_ot.vision.scorers.pair_strips import COLUMNS, ROWS, U, wet_rows
from aegis_ot.vision.tips import TIPS
from scripts.pair_network.strips import draw_pairs, save


def test_liquid_stands_from_the_orifice_up_to_its_volume() -> None:
    tip = TIPS["ot2_300"]
    wet = wet_rows(tip, ((0.0, 100.0),))
    top = 1 - tip.height_of(100.0) / tip.length_mm
    assert np.array_equal(wet > 0, (top < U) & (U < 1))
    gapped = wet_rows(tip, ((0.0, 40.0), (50.0, 110.0)))
    assert 0 < (wet_rows(tip, ((0.0, 110.0),)) - gapped).sum() < gapped.sum()


def test_a_plate_begins_with_normal_pairs_that_were_emptied(tmp_path: Path) -> None:
    pairs = list(draw_pairs(seed=3, plates=2, wells=5))
    assert len(pairs) > 5
    first = [one for one in pairs if one.plate == pairs[0].plate][:3]
    for one in first:
        assert one.failure == ""
        assert one.frames.shape == (2, ROWS, COLUMNS, 3)
        assert one.wet[0].any()
        assert not one.wet[1].any()
        assert abs(one.wet[0].sum() - one.tip[0].sum()) <= 3, "as much as should stand there"
    save(tmp_path / "drawn.npz", pairs)
    kept = np.load(tmp_path / "drawn.npz")
    assert len(kept["frames"]) == len(kept["failure"]) == len(pairs)
