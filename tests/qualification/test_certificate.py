"""A whole qualification on simulated hardware, by the command: run, opened, filed, exported."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from syrupy.assertion import SnapshotAssertion

from aegis_ot.errors import ConfigurationError
from aegis_ot.planted import NO_TIP, NORMAL
from aegis_ot.qualification.camera_state import camera_state, changes
from aegis_ot.qualification.certificate import certificate, certificate_html, count_liquid
from aegis_ot.qualification.counting import Rate
from aegis_ot.qualification.fitted import flagged_anew, judge_anew
from aegis_ot.qualification.frames import export_archive, true_samples, write_frames
from aegis_ot.qualification.opening import JudgedDelivery, open_plan
from aegis_ot.qualification.plan import CALIBRATING, make_plan
from aegis_ot.qualification.running import run_simulated
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.store.opening import open_store
from aegis_ot.vision.dataset import load_dataset
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vocabulary import KeyframeKind

PLAN = make_plan("p300_single_gen2", "right", ["red"], 15, 3)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Store, str]:
    """The shortest qualification that there is: 24 deliveries."""
    folder = tmp_path_factory.mktemp("qualification")
    named = run_simulated(PLAN, folder, 3)
    return open_store(folder), named


@pytest.fixture(scope="module")
def anew(run: tuple[Store, str]) -> dict[str, bool]:
    return flagged_anew(judge_anew(true_samples(*run, PLAN, HeatmapDetector())[0]))


@pytest.fixture(scope="module")
def made(run: tuple[Store, str], anew: dict[str, bool]) -> dict[str, Any]:
    return certificate(*run, PLAN, HeatmapDetector(), anew=anew)


def test_what_was_planted_is_counted_blind(made: dict[str, Any]) -> None:
    (red,) = made["liquids"]
    assert (made["delivered"], made["uncounted"], made["frames"]) == (24, 0, "simulated")
    assert red["caught"]["of"] == 12
    assert red["caught"]["hits"] >= 7  # dye before a grey panel: most of it is seen
    assert red["normals_flagged"] | {"low": 0, "high": 0} == {
        "hits": 0, "of": 6, "low": 0, "high": 0,
    }  # fmt: skip
    assert sum(row["caught"]["of"] for row in red["rows"]) == 12
    # Nobody was told of the plan: the store holds no word of it.
    assert made["record"]["plan"]["seed"] == 3


def test_each_half_is_judged_by_itself(anew: dict[str, bool], made: dict[str, Any]) -> None:
    """All but the tip that nobody sees. So short a plan has no normal wells but those that
    calibrate each half."""
    judged = {each.well for each in PLAN.deliveries if each.kind not in (NORMAL, NO_TIP)}
    assert anew.keys() == judged
    assert sum(anew.values()) >= 7
    assert 0 <= made["liquids"][0]["spread"] <= 1
    assert made["liquids"][0]["normals_spread"] is None


def _by_halves(first: bool, second: bool) -> dict[str, bool]:
    return {each.well: first if each.half == 1 else second for each in PLAN.deliveries}


def test_halves_that_differ_make_claims_wider(run: tuple[Store, str]) -> None:
    told = {}
    for second in (True, False):
        made = certificate(*run, PLAN, HeatmapDetector(), anew=_by_halves(True, second))
        told[second] = made["liquids"][0], certificate_html(made)
    (agreeing, page), (differing, wider) = told[True], told[False]
    assert (agreeing["spread"], differing["spread"]) == (0.0, 1.0)
    assert "for further runs here" in page
    assert "differ by more than chance" not in page
    assert "intraclass correlation of what was planted 1.00, of normal wells 1.00" in wider
    for name in ("caught", "normals_flagged"):
        narrow, wide = agreeing[name], differing[name]
        assert (narrow["hits"], narrow["of"]) == (wide["hits"], wide["of"])
        exact = Rate(narrow["hits"], narrow["of"]).to_json()
        assert narrow == exact
        assert wide["low"] <= exact["low"]
        assert wide["high"] >= exact["high"]
        assert wide["high"] - wide["low"] > exact["high"] - exact["low"]


def test_the_page_reads_as_it_did(made: dict[str, Any], snapshot: SnapshotAssertion) -> None:
    """Of verdicts that are told here, not seen: a better camera changes nothing in it."""
    frames = [{"kind": kind.value, "late": False} for kind in KeyframeKind]
    deliveries = []
    for number, planned in enumerate(PLAN.deliveries):
        is_caught = planned.kind != NORMAL and (planned.half == 1 or planned.share >= 0.5)
        entry: Any = {"judged": {"outcome": "fail" if is_caught else "pass"}, "keyframes": frames}
        deliveries.append(JudgedDelivery(planned, number < CALIBRATING, entry))
    anew = {each.planned.well: each.is_flagged for each in deliveries}
    page = certificate_html(made | {"liquids": [count_liquid("red", deliveries, PLAN, anew)]})
    counts = page[page.index("<p>The robot failed on purpose") : page.index("</section>")]
    assert re.sub(r"\s*(<[^>]+>\s*)+", "\n", counts) == snapshot


def test_halves_that_nobody_could_judge_are_told(run: tuple[Store, str]) -> None:
    made = certificate(*run, PLAN, HeatmapDetector())
    assert made["liquids"][0]["spread"] is None
    assert "these intervals are of this run alone" in certificate_html(made)


def test_the_record_has_a_hash_of_every_frame(made: dict[str, Any], run: tuple[Store, str]) -> None:
    hashes = made["record"]["frame_sha256"]
    assert len(hashes) == made["record"]["frames"] == 96
    assert len(set(hashes.values())) == 96


def test_the_page_says_that_it_is_simulated(made: dict[str, Any]) -> None:
    page = certificate_html(made)
    assert "every figure on this page is a figure on simulated frames" in page
    assert "10 % air inside the column" in page
    assert made["record"]["frames_sha256"] in page
    assert "<script" not in page


def test_a_camera_that_changed_is_told(made: dict[str, Any]) -> None:
    now = made["camera"]
    assert changes(now, now) == []
    places = {well: [x + 9, y] for well, (x, y) in now["places"].items()}
    before = now | {"sharpness": 2 * now["sharpness"], "light": now["light"] / 2, "places": places}
    told = " ".join(changes(now, before))
    assert "sharpness has changed by -50 %" in told
    assert "light has changed by +100 %" in told
    assert "9 px" in told


def test_the_look_of_the_liquid_is_no_change_of_the_camera(
    made: dict[str, Any], run: tuple[Store, str]
) -> None:
    deliveries, overview = open_plan(*run, PLAN)
    full = {
        keyframe["sequence"]
        for entry in overview["trajectories"]
        for keyframe in entry["keyframes"]
        if keyframe["kind"] == "transit"
    }
    frame = run[0].frames_of(run[1])
    assert len(full) == 24
    black = cv2.imencode(".jpg", np.zeros((1080, 1920), np.uint8))[1].tobytes()
    camera = camera_state(deliveries, lambda number: black if number in full else frame(number))
    assert changes(camera, made["camera"]) == []


def test_what_could_not_be_compared_is_told(made: dict[str, Any], run: tuple[Store, str]) -> None:
    now = made["camera"]
    nothing = now | {"sharpness": None, "light": None, "places": {}, "size": None}
    told = changes(now, nothing)
    assert len(told) == 3
    assert all("could not be compared" in each for each in told)
    before = made | {"robot": "another", "tips": "others"}
    again = certificate(*run, PLAN, HeatmapDetector(), before)
    assert again["changes"] == [
        "The last certificate is of another robot and another kind of tips: the cameras are not "
        "compared."
    ]


def test_a_run_is_not_opened_with_another_plan(run: tuple[Store, str]) -> None:
    store, named = run
    with pytest.raises(ConfigurationError, match="no run of this plan"):
        open_plan(store, named, make_plan("p20_single_gen2", "right", ["red"], 15, 3))


def test_frames_are_labelled_by_what_was_planted(run: tuple[Store, str], tmp_path: Path) -> None:
    store, named = run
    samples, source = true_samples(store, named, PLAN, HeatmapDetector())
    data = load_dataset(write_frames(tmp_path / "frames", samples, source))
    assert data.source == "synthetic"
    assert data.plates == ("red 1", "red 2")
    assert [record.label for record in data.records] == [
        "failure" if each.fault else "normal" for each in PLAN.deliveries
    ]
    archive = tmp_path / "frames.zip"
    assert export_archive(data, archive, "CC0-1.0") == 24
    _assert_anonymous(archive, named)
    with pytest.raises(ConfigurationError, match="Name the licence"):
        export_archive(data, tmp_path / "other.zip", " ")
    with pytest.raises(ConfigurationError, match="is there already"):
        export_archive(data, archive, "CC0-1.0")


def _assert_anonymous(archive: Path, run: str) -> None:
    with zipfile.ZipFile(archive) as packed:
        told = packed.read("deliveries.json").decode()
        assert packed.read("LICENCE.txt").decode() == "CC0-1.0\n"
        pictures = [name for name in packed.namelist() if name.endswith(".jpg")]
        assert {entry.date_time[0] for entry in packed.infolist()} == {1980}  # not today's
    assert run not in told
    assert "red" not in told
    assert json.loads(told)["source"] == "synthetic"
    assert len(pictures) == 96
