"""Where the column stood that left the tip, and what a run learns from it."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.vision.column_look import Look
from aegis_ot.vision.column_reader import MeasuredColumns
from aegis_ot.vision.drawn import drawn_top
from aegis_ot.vision.measuring import ColumnReading
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import FREE, TipDetection
from aegis_ot.vocabulary import KeyframeKind

from .test_run_analyser_factory import keyframes

Well = tuple[dict[KeyframeKind, Look], dict[KeyframeKind, float]]


def wells(
    reader: MeasuredColumns,
    count: int,
    faults: tuple[str, ...] = (),
    reagent: str = "red dye",
    volume: float = 100.0,
) -> list[Well]:
    """Looks at the true tips of a run's free frames, and what should be in them, µL."""
    camera = SimulatedCamera(5, faults, SessionParameters.bench(5))
    seen: list[Well] = [({}, {}) for _ in range(count)]
    for keyframe in keyframes(count, reagent=reagent, volumes=(volume,)):
        camera.announce(keyframe)
        frame, truth = camera.frame_after(0.0, 1.0), camera.truth
        if keyframe.kind not in FREE or truth is None or truth.box is None:
            continue
        found = TipDetection(*truth.box, 0.9, truth.tip.orifice, truth.tip.collar)
        looks, expected = seen[keyframe.trajectory]
        expected[keyframe.kind] = keyframe.expected_ul
        looks[keyframe.kind] = reader.look(
            {keyframe.kind: frame.image}, keyframe.kind, found, tip_for(keyframe.pipette)
        )
    return seen


def top_of(well: Well, off: float = 0.0) -> float | None:
    before, after = (well[0][kind] for kind in FREE)
    tip = before.tip
    place = 1.0 - float(tip.height_of(well[1][KeyframeKind.TRANSIT])) / tip.length_mm
    return drawn_top(before, after, place + off, 0.1)


@pytest.mark.parametrize("volume", [60.0, 200.0, 500.0])
def test_the_end_of_a_column_that_left_is_found_where_it_stood(volume: float) -> None:
    (well,) = wells(MeasuredColumns(), 1, volume=volume)
    tip = tip_for("p1000")
    true = 1.0 - float(tip.height_of(volume)) / tip.length_mm
    assert top_of(well) == pytest.approx(true, abs=0.025)
    assert top_of(well, off=0.04) == pytest.approx(top_of(well), abs=0.004), "wherever expected"


@pytest.mark.parametrize("fault", ["no_dispense@#1", "no_aspirate@#1"])
def test_where_nothing_left_there_is_no_end(fault: str) -> None:
    assert top_of(wells(MeasuredColumns(), 1, (fault,))[0]) is None


def test_a_liquid_that_does_not_show_has_no_end() -> None:
    assert top_of(wells(MeasuredColumns(), 1, reagent="water")[0]) is None


def readings(
    reader: MeasuredColumns, seen: list[Well]
) -> list[Mapping[KeyframeKind, ColumnReading]]:
    """Each well read before it is learned."""
    read = []
    for looks, expected in seen:
        read.append(reader.read(looks, expected))
        reader.learn(looks, expected)
    return read


def test_a_run_of_one_volume_learns_how_high_its_columns_stand() -> None:
    reader = MeasuredColumns()
    read = readings(reader, wells(reader, 6))
    first, last = read[1][KeyframeKind.TRANSIT], read[5][KeyframeKind.TRANSIT]
    assert first.seen is None, "the run's scale is not known yet"
    assert last.seen is not None
    assert last.seen.volume_ul == pytest.approx(100.0, rel=0.05)
    assert last.seen.volume_ul != 100.0, "it is what was seen, not what was expected"
    assert 0 < last.seen.sigma_ul < 0.1 * 100.0


def test_an_emptied_tip_that_holds_liquid_teaches_nothing() -> None:
    """Wells that pass with a remainder must not make the next one's look empty."""
    reader = MeasuredColumns()
    faults = tuple(f"partial:70@#{number}" for number in range(7, 15))
    read = readings(reader, wells(reader, 15, faults))
    left = [one[KeyframeKind.POST_DISPENSE].volume_ul for one in read[6:14]]
    assert min(left) > 15.0
    assert read[14][KeyframeKind.POST_DISPENSE].volume_ul == 0.0


def test_what_is_learned_anew_leaves_out_emptied_tips_that_hold_liquid() -> None:
    reader = MeasuredColumns()
    faults = tuple(f"partial:60@#{number}" for number in (4, 5, 6, 7))
    seen = wells(reader, 7, faults)
    readings(reader, seen)
    reader.forget(seen[:6])
    assert reader.read(*seen[6])[KeyframeKind.POST_DISPENSE].volume_ul > 15.0
