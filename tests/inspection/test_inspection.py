"""The page of a data set and of a run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from aegis_ot.inspection import inspect_run, inspection_html
from aegis_ot.inspection.choosing import pictured
from aegis_ot.run_view import SeenWell
from aegis_ot.sidecar.store.opening import open_store
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.models import SHIPPED, load_model
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.cascade import run_cascade
from aegis_ot.worldmodel.leave_one_out import score_with
from aegis_ot_lab.found_tips import find_tips
from aegis_ot_lab.inspection import inspect_dataset
from tests.sidecar.browser import CHROMIUM, chromium


def test_a_data_set_is_judged_and_shown_well_by_well(drawn: Path) -> None:
    data = load_dataset(drawn)
    seen = inspect_dataset(data, "pca", most=5)
    assert [well.id for well in seen.wells] == [record.id for record in data.records]
    assert sum(well.pictured for well in seen.wells) == 5
    assert sum(well.outcome == "calibration" for well in seen.wells) == 3
    page = inspection_html(seen)
    assert "synthetic" in page
    assert "http" not in page.replace("http-equiv", "")
    assert page.count("<article") == len(data.records), "wells without pictures keep their numbers"
    assert "without pictures" in page


def test_one_plate_alone_is_shown_without_scores(drawn: Path, tmp_path: Path) -> None:
    data = load_dataset(drawn)
    one = type(data)(data.root, tuple(r for r in data.records if r.plate == "plate00"),
                     data.boxes, data.meta)  # fmt: skip
    seen = inspect_dataset(one, most=0)
    assert {well.score for well in seen.wells} == {None}
    assert any("One plate alone" in note for note in seen.notes)


def test_scores_signs_limits_and_expected_columns_are_those_of_the_live_run(drawn: Path) -> None:
    data = load_dataset(drawn)
    shipped = EnsembleScorer.from_model(load_model(SHIPPED, "ensemble"))
    seen = {well.id: well for well in inspect_dataset(data, fitted=shipped, most=0).wells}
    tips = find_tips(data, "default")
    judged = run_cascade(score_with(tips.samples, shipped), detector=tips.finder)
    for well in judged:
        shown, evidence = seen[well.sample.id], well.evidence
        assert shown.score == well.verdict.score
        assert {sign.name: nats for sign, nats in shown.signs} == evidence["signs"]
        assert (shown.band and shown.band[1]) == (evidence["band"] and evidence["band"][1])
        marked = {kind.value for kind, frame in shown.frames.items() if frame.expected.mark}
        assert marked == {"aspirate", "transit"} & set(evidence["boxes"])
        for kind in marked:
            assert evidence["expected_top"][kind] == pytest.approx(_share(shown, kind), abs=1e-3)
    assert len({well.band for well in seen.values()}) > 2


def _share(shown: SeenWell, kind: str) -> float:
    """Where the expected column is marked, as a fraction of the tip above its orifice."""
    frame = shown.frames[KeyframeKind(kind)]
    (orifice, collar), mark = frame.axis, np.mean(frame.expected.mark, axis=0)
    return float(np.hypot(*np.subtract(mark, orifice)) / np.hypot(*np.subtract(collar, orifice)))


def test_where_columns_stand_is_not_made_up(drawn: Path) -> None:
    seen = inspect_dataset(load_dataset(drawn), "pca", most=0)
    first = seen.wells[0].frames[KeyframeKind.TRANSIT].expected
    assert first is not None
    assert first.volume_ul > 0
    assert first.mark is None, "nothing has shown yet how high columns stand"
    assert "nats" not in inspection_html(seen), "a reconstruction error has no unit"


def test_a_run_is_shown_as_it_was_judged(store: Path) -> None:
    kept = open_store(store)
    seen = inspect_run(kept, "run-1")
    assert [well.well for well in seen.wells] == [*(f"{row}1" for row in "ABCDEFGH")]
    last = seen.wells[-1]
    assert (last.outcome, last.failure) == ("fail", "no dispense")
    after = last.frames[KeyframeKind.POST_DISPENSE]
    assert after.measured is not None
    assert after.measured.volume_ul > 75
    assert after.measured.mark is not None
    transit = last.frames[KeyframeKind.TRANSIT].expected
    assert transit is not None
    assert transit.mark is not None


def test_which_sign_spoke_stands_with_a_runs_well_where_and_in_what_unit(store: Path) -> None:
    seen = inspect_run(open_store(store), "run-1", most=0)
    assert [not well.band for well in seen.wells] == [
        well.outcome == "calibration" for well in seen.wells
    ]
    failed = seen.wells[-1]
    page = inspection_html(seen)
    assert "surprises in nats" in page
    *_, last = page.split("<article")
    words = {
        "pair": "a tip unlike normal ones before and after the dispense",
        "undelivered": "a tip that the dispense did not change (post-dispense)",
    }
    strongest = failed.signs[:2]
    assert {sign.name for sign, _ in strongest} == set(words)
    assert strongest[0][1] >= strongest[1][1] > 3
    for item, (sign, nats) in zip(last.split("<li>")[1:], strongest, strict=False):
        assert f"{nats:.1f} nats: {words[sign.name]}" in item
    assert f"up to {failed.band[1]:.3g} passes silently" in last


def test_a_lost_frame_is_said_in_its_place(store: Path, tmp_path: Path) -> None:
    import shutil

    shutil.copytree(store, tmp_path / "store")
    files = sorted((tmp_path / "store").glob("frames/*/*.jpg"))
    files[0].unlink()
    files[1].write_bytes(b"\xff\xd8no")
    page = inspection_html(inspect_run(open_store(tmp_path / "store"), "run-1"))
    assert "missing in the store" in page
    assert "damaged in the store" in page


def test_names_are_text_and_never_markup(store: Path) -> None:
    from dataclasses import replace

    seen = inspect_run(open_store(store), "run-1", most=0)
    page = inspection_html(replace(seen, title="<script>alert(1)</script>"))
    assert "<script>alert" not in page


def test_wrong_wells_get_pictures_first() -> None:
    wells = [(False, False), (True, False), (False, True), (False, False)]
    assert pictured(wells, 2) == [False, True, True, False]
    assert pictured(wells, 9) == [True] * 4


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here")
def test_the_filter_leaves_the_flagged_wells(store: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_text(inspection_html(inspect_run(open_store(store), "run-1")), encoding="utf-8")
    with chromium((390, 844)) as browser:
        browser.open(page.as_uri())
        browser.until("document.querySelector('output').value === '8 of 8 wells'")
        browser.run("document.querySelector('[data-show=flagged]').click()")
        assert browser.run("document.querySelectorAll('article:not([hidden])').length") == 1
        browser.run("document.querySelector('.map a').click()")
        assert browser.run("document.querySelectorAll('article:not([hidden])').length") == 8
        assert browser.run("document.documentElement.scrollWidth <= innerWidth")
        assert browser.errors == []
