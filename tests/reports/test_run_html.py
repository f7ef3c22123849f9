"""The report of a run is one page that holds everything."""

from __future__ import annotations

import re

from aegis_ot.reports.run_html import report_run, run_report_html
from tests.run_view.overviews import delivery, hold, overview, row
from tests.sidecar.helpers import make_jpeg


def page(run: dict) -> str:
    return run_report_html([report_run(run, lambda _: make_jpeg())])


def test_it_tells_all_that_the_account_holds() -> None:
    run = overview(
        delivery(0),
        delivery(
            1,
            "fail",
            holds=[hold(1, paused_s=31.0, answered="page")],
            decisions=[{"outcome": "fail", "by": "Ada", "note": "drop seen", "at": 5.0}],
            evidence={"band": [0.0, 3.0], "boxes": {"transit": [10, 4, 8, 40]}},
        ),
        finished={"at": 130.0, "outcome": "stopped", "detail": "Stopped by hand."},
        incidents=[{"kind": "camera", "text": "cable", "at": 101.0, "ended": 109.0}],
        layer1={
            "verdict": "warn",
            "findings": [
                {"rule": "PCR-2", "severity": "warning", "message": "Carry-over.", "why": "",
                 "fix": "", "lines": [4], "wells": []}
            ],
            "more": 0,
            "undecided": [],
        },
    )  # fmt: skip
    text = page(run)
    for said in (
        "plate.py", "lab-3", "stopped", "simulated result", "Stopped by hand.", "PCR-2",
        "A2: failed, partial dispense", "About 52 µL", "drop seen",
        "paused 31 s, answered at the page",
        "cable", "Over after 8 s", "last frame to verdict", "none: no model was asked",
    ):  # fmt: skip
        assert said in text, said
    # The tip close up, and the whole frame where no tip was found.
    assert text.count("data:image/jpeg;base64,") == 4
    assert text.count("no tip found") == 3
    assert not re.search(r"(src|href)=\"(?!#|data:)", text)


def test_what_a_run_says_of_itself_is_no_markup() -> None:
    text = page(overview(delivery(0), protocol="<script>alert(1)</script>.py"))
    assert "<script" not in text


def test_wells_that_the_camera_did_not_see_are_said_to_be_such() -> None:
    text = page(overview(row(0, "uuF.....")))
    assert "2 wells were not seen by the camera" in text
    assert 'aria-label="A1: not seen by the camera"' in text
    assert 'aria-label="C1: failed, no dispense"' in text


def test_settings_have_their_units() -> None:
    guard = {"verdict_timeout_s": 60.0, "on_fail": "stop", "keyframes_lost": 3}
    text = page(overview(delivery(0), guard=guard))
    assert "verdict timeout 60 s; on fail stop; keyframes lost 3" in text


def test_findings_of_several_lines_say_lines() -> None:
    finding = {
        "rule": "PCR-2",
        "severity": "warning",
        "message": "Carry-over.",
        "why": "",
        "fix": "",
    }
    said = {"verdict": "warn", "more": 0, "undecided": []}
    for lines, words in (([4], "Line 4"), ([41, 44], "Lines 41, 44")):
        layer1 = {**said, "findings": [{**finding, "lines": lines, "wells": []}]}
        assert words in page(overview(delivery(0), layer1=layer1))
