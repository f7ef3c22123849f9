"""Retained columns planted into normal wells' frames."""

from __future__ import annotations

from dataclasses import replace

import pytest

from aegis_ot.evaluation.layer2.smallest import smallest_caught, with_retained
from aegis_ot.vision.reach import Smallest
from aegis_ot.vision.scorers import make_scorer
from aegis_ot.vision.scorers.column import ColumnScorer
from aegis_ot.vision.scorers.looks import looks
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from tests.vision.column.drawn import RED, detection, draw_tip

VOLUME = 300.0


def normal(seed: int = 0, plate: str = "p1") -> TrajectorySample:
    top = 1.0 - tip_for("p1000").height_of(VOLUME) / tip_for("p1000").length_mm
    frames = {
        kind: draw_tip(top=top if number < 2 else 1.0, dye=RED, seed=seed + number)
        for number, kind in enumerate(KeyframeKind)
    }
    expected = dict(zip(KeyframeKind, (VOLUME, VOLUME, 0.0, 0.0), strict=True))
    found = dict.fromkeys(KeyframeKind, detection())
    return TrajectorySample(
        f"w{seed}", plate, "A1", "p1000", VOLUME, frames, found, expected, "red", "normal"
    )


def test_a_planted_column_is_seen_and_the_well_itself_is_left_alone() -> None:
    well = normal()
    before = {kind: look.profile.colour.copy() for kind, look in looks(well).items()}
    retained = [ColumnScorer().report(with_retained(well, share)).signs.retained or 0.0
                for share in (0.3, 1.0)]  # fmt: skip
    assert (ColumnScorer().report(well).signs.retained or 0.0) < 5 < min(retained)
    for kind, look in looks(well).items():
        assert look.profile.colour == pytest.approx(before[kind])


def test_it_says_what_would_be_caught_and_how_close_the_camera_has_to_come() -> None:
    wells = [normal(10 * number, plate=f"p{number // 2}") for number in range(6)]
    (found,) = smallest_caught(wells, lambda: make_scorer("ensemble"))
    assert found.smallest_ul is not None
    assert found.smallest_ul < 0.5 * VOLUME
    assert found.px_per_mm_for_half is not None
    assert found.px_per_mm_for_half > found.px_per_mm
    assert f"{found.smallest_ul:.1f} µL left in the tip are caught" in str(found)
    assert "not even the whole" in str(replace(found, smallest_ul=None))
    assert Smallest(**found.to_json()) == found
    assert smallest_caught(wells[:2], lambda: make_scorer("ensemble")) == [], "one plate alone"
