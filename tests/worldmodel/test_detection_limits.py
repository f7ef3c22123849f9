"""The smallest retained volume that a live run would catch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace

import pytest

from aegis_ot.vision.scorers import make_scorer
from aegis_ot.vision.types import TrajectorySample
from aegis_ot.worldmodel import detection_limits as smallest
from aegis_ot.worldmodel.detection_limits import LEAD, MOST, OF_A_PLATE, SHARES, smallest_caught
from aegis_ot.worldmodel.leave_one_out import HeldOut
from aegis_ot.worldmodel.reach import Smallest
from tests.worldmodel.test_planting import VOLUME, normal


def ensemble() -> object:
    return make_scorer("ensemble")


class Judge:
    """In place of the live run's: flags planted columns of at least ``least`` of a volume."""

    def __init__(self, least: float, sound: bool = False) -> None:
        self.least, self.sound = least, sound
        self.runs: list[list[TrajectorySample]] = []

    def __call__(self, held: HeldOut) -> list[SimpleNamespace]:
        judged = []
        for anchor, wells in held.plates():
            self.runs.append([well.sample for well in (anchor, *wells)])
            for number, sample in enumerate(self.runs[-1]):
                share = sample.retained_fraction
                flagged = self.sound if share is None else self.flags(share)
                judged.append(
                    SimpleNamespace(sample=sample, flagged=flagged, calibration=number == 0)
                )
        return judged

    def flags(self, share: float) -> bool:
        return share >= self.least


def plates(*sizes: int, **kind: object) -> list[TrajectorySample]:
    return [
        normal(100 * plate + 10 * well, f"p{plate}", **kind)
        for plate, size in enumerate(sizes)
        for well in range(size)
    ]


def test_it_says_what_would_be_caught_and_how_close_the_camera_has_to_come() -> None:
    (seen,) = smallest_caught(plates(2, 2, 2), ensemble)
    assert seen.smallest_ul is not None
    assert seen.smallest_ul < 0.5 * VOLUME
    assert seen.px_per_mm_for_half is not None
    assert seen.px_per_mm_for_half > seen.px_per_mm
    assert (seen.flagged, seen.sound) == (0, 3), "the first well of each plate calibrates"
    assert seen.wells == 3
    assert Smallest(**seen.to_json()) == seen


def test_a_pipette_of_one_plate_alone_is_not_judged() -> None:
    wells = plates(2)
    assert smallest_caught(wells, ensemble) == []


def test_caught_is_what_the_live_run_flags(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge(0.3, sound=True)
    monkeypatch.setattr(smallest, "run_cascade", judge)
    (found,) = smallest_caught(plates(3, 3), ensemble)
    assert found.smallest_ul == pytest.approx(0.3 * VOLUME)
    assert found.caught == {f"{share:g}": float(share >= 0.3) for share in SHARES}
    assert (found.flagged, found.sound) == (4, 4)
    blind = Judge(2.0)
    monkeypatch.setattr(smallest, "run_cascade", blind)
    (found,) = smallest_caught(plates(3, 3), ensemble)
    assert found.smallest_ul is None


def test_what_a_run_missed_teaches_it_nothing_that_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    class Odd(Judge):
        def flags(self, share: float) -> bool:
            return share != 0.5

    judge = Odd(0.0)
    monkeypatch.setattr(smallest, "run_cascade", judge)
    (found,) = smallest_caught(plates(3, 3), ensemble)
    assert found.caught["0.65"] == 1.0
    assert found.caught["0.1"] == 0.0, "flagged, but by a run that had passed the half"
    for run in judge.runs[2:]:
        shares = [sample.retained_fraction for sample in run]
        assert shares == [None, None, *reversed(SHARES)], "a run for each well, the largest first"
        assert len({sample.well for sample in run[2:]}) == 1
        assert run[2].well not in {sample.well for sample in run[:2]}, "it never saw this well"
        assert len({sample.id for sample in run}) == len(run)


def test_only_so_many_wells_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge(0.0)
    monkeypatch.setattr(smallest, "run_cascade", judge)
    monkeypatch.setattr(smallest, "with_retained", planted_nowhere)
    wells = [normal(20 * number, f"p{number // 12}") for number in range(60)]
    (found,) = smallest_caught(wells, ensemble)
    tried = [run for run in judge.runs if run[-1].retained_fraction is not None]
    assert found.wells == len(tried) == MOST
    of_plates = [run[0].plate for run in tried]
    assert max(map(of_plates.count, of_plates)) <= OF_A_PLATE
    assert set(of_plates) == {f"p{number}" for number in range(5)}, "of every plate some"
    assert {len(run) - len(SHARES) for run in tried} == {LEAD}


def planted_nowhere(sample: TrajectorySample, share: float, scale: float) -> TrajectorySample:
    return replace(sample, retained_fraction=share, label="failure")


def test_liquids_are_told_apart() -> None:
    wells: Sequence[TrajectorySample] = [
        *plates(2, 2),
        *(normal(700 + 10 * n, "w0", reagent="blue") for n in range(2)),
    ]
    found = smallest_caught(wells, ensemble)
    assert [(one.reagent, one.wells) for one in found] == [
        ("red", 2),
        ("blue", 1),
    ]
