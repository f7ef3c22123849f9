"""A run in figures."""

from __future__ import annotations

import json

from aegis_ot.run_view import run_account

from .overviews import delivery, hold, overview, row


def test_counts_flagged_wells_holds_and_latency() -> None:
    decided = delivery(2, decisions=[{"outcome": "pass", "by": "Ada", "note": "", "at": 5.0}])
    run = overview(
        delivery(0),
        delivery(1, "fail", holds=[hold(0, resolution="operator", seconds=0.0), hold(1)]),
        decided,
        actions=[{"trajectory": 1, "action": "resume", "by": "Ada", "note": "", "at": 6.0}],
    )
    account = run_account(run)
    json.dumps(account)
    assert account["counts"] == {"pass": 2, "fail": 1, "wells": 3, "deliveries": 3}
    assert account["flagged"] == [1, 2]
    assert account["frames"] == "simulated"
    assert [hold["well"] for hold in account["holds"]] == ["A2 of plate (slot 4)"] * 2
    assert [d.get("outcome") or d["action"] for d in account["decisions"]] == ["pass", "resume"]
    latency = account["latency"]
    assert latency["trigger_to_exposure_s"]["count"] == 12
    assert latency["last_frame_to_verdict_s"]["median"] == 0.2
    assert (latency["hold_s"]["count"], latency["hold_s"]["sum"]) == (1, 0.3)


def test_a_run_without_deliveries_has_an_account() -> None:
    account = run_account(overview())
    assert account["counts"] == {"wells": 0, "deliveries": 0}
    assert account["latency"]["hold_s"]["median"] is None


def test_wells_that_the_camera_did_not_see_are_named_and_do_not_count_as_passed() -> None:
    account = run_account(overview(row(0, "uuuuuu.."), row(1, "uuuuuuuu")))
    assert account["counts"] == {
        "pass": 2, "unobserved": 14, "wells": 16, "deliveries": 2,
    }  # fmt: skip
    assert account["unobserved"] == [
        *(f"{letter}1" for letter in "ABCDEF"), *(f"{letter}2" for letter in "ABCDEFGH"),
    ]  # fmt: skip
    told = account["wells"][0]["channels"]
    assert (told[0]["well"], told[0]["outcome"], told[7]["outcome"]) == ("A1", "unobserved", "pass")


def test_what_was_seen_of_the_volume_drawn_is_told_with_its_uncertainty() -> None:
    evidence = {"drawn_ul": [98.2, 3.1]}
    seen, several = delivery(0, "pass", evidence=evidence), row(2, "........", evidence=evidence)
    told = run_account(overview(seen, delivery(1, "pass"), several))
    assert [well["drawn_estimate_ul"] for well in told["wells"]] == [[98.2, 3.1], None, None]
