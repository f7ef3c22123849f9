"""Retained columns planted into normal wells' frames."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aegis_ot.vision.scorers.column import ColumnScorer
from aegis_ot.vision.scorers.looks import looks
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.planting import with_retained
from tests.vision.column.drawn import RED, detection, draw_tip

VOLUME = 300.0


def top_of(share: float) -> float:
    """Where a share of the volume ends in a drawn tip, u."""
    tip = tip_for("p1000")
    return 1.0 - tip.height_of(share * VOLUME) / tip.length_mm


def normal(
    seed: int = 0, plate: str = "p1", volume_ul: float = VOLUME, reagent: str = "red"
) -> TrajectorySample:
    """A well of which all was delivered."""
    top = top_of(volume_ul / VOLUME)
    frames = {
        kind: draw_tip(top=top if number < 2 else 1.0, dye=RED, seed=seed + number)
        for number, kind in enumerate(KeyframeKind)
    }
    expected = dict(zip(KeyframeKind, (volume_ul, volume_ul, 0.0, 0.0), strict=True))
    found = dict.fromkeys(KeyframeKind, detection())
    name = f"w{seed}"
    return TrajectorySample(
        name, plate, name, "p1000", volume_ul, frames, found, expected, reagent, "normal"
    )


def test_a_planted_column_is_seen_and_the_well_itself_is_left_alone() -> None:
    well = replace(normal(), tip_used="A1")
    before = {kind: look.profile.colour.copy() for kind, look in looks(well).items()}
    retained = [ColumnScorer().report(with_retained(well, share)).signs.retained or 0.0
                for share in (0.3, 1.0)]  # fmt: skip
    assert (ColumnScorer().report(well).signs.retained or 0.0) < 5 < min(retained)
    for kind, look in looks(well).items():
        assert look.profile.colour == pytest.approx(before[kind])
    failed = with_retained(well, 0.3)
    assert (failed.label, failed.retained_fraction, failed.tip_used) == ("failure", 0.3, "")
    assert failed.id != well.id


def test_the_frames_show_what_a_tip_with_that_column_shows() -> None:
    well = normal()
    planted = with_retained(well, 0.4).frames
    for number, kind in enumerate(KeyframeKind):
        loaded = number < 2
        true = draw_tip(top=top_of(1.0 if loaded else 0.4), dye=RED, seed=number)
        off = planted[kind].astype(float) - true
        assert np.abs(off.mean()) < 0.1
        tip = off[40:225, 150:180]
        assert np.sqrt((tip**2).mean()) < 4.0, "the frame's noise, 1.7, twice over, and little more"
    empty = np.abs(well.frames[KeyframeKind.POST_DISPENSE].astype(float) - true)
    assert empty[160:220, 158:170].mean() > 8.0, "which an empty tip does not"


def test_what_stands_behind_the_full_tip_is_not_planted_with_its_liquid() -> None:
    well = normal()
    lighter = well.frames[KeyframeKind.TRANSIT].astype(int) + 40
    frames = {**well.frames, KeyframeKind.TRANSIT: np.clip(lighter, 0, 255).astype(np.uint8)}
    # The nozzle is lit as before.
    frames[KeyframeKind.TRANSIT][:58] = well.frames[KeyframeKind.TRANSIT][:58]
    planted = with_retained(replace(well, frames=frames), 0.4).frames[KeyframeKind.POST_DISPENSE]
    usual = with_retained(well, 0.4).frames[KeyframeKind.POST_DISPENSE]
    off = (planted.astype(float) - usual)[150:215, 162:167]
    assert abs(off.mean()) < 12.0, "of 40"


def test_where_labware_hides_the_tip_nothing_is_planted() -> None:
    well = normal()
    frames = dict(well.frames)
    hidden = frames[KeyframeKind.DISPENSE].copy()
    hidden[185:] = np.random.default_rng(1).normal(120, 1.7, hidden[185:].shape).astype(np.uint8)
    frames[KeyframeKind.DISPENSE] = hidden
    planted = with_retained(replace(well, frames=frames), 1.0).frames[KeyframeKind.DISPENSE]
    changed = np.abs(planted.astype(float) - hidden).max(axis=(1, 2))
    assert changed[150:170].max() > 20.0
    assert changed[195:].max() < 12.0
