"""Failed wells put right by the robot, in Opentrons' simulator and on its engine live."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script, play
from aegis_ot.guard import guard

from .fake_sidecar import FakeSidecar, Handler
from .live import LiveRun

RETRY = {"no_aspirate": "retry", "no_dispense": "retry", "partial_dispense": "top_up"}
EMPTY = {"failure": "no_aspirate", "gate": "volumetric", "measured_ul": 0.0}
HALF = {"gate": "volumetric", "measured_ul": 25.0, "left_ul": 25.0, "left_sigma_ul": 1.0}

TEXT = """
from aegis_ot import guard
metadata = {{"apiLevel": "{api}"}}

{decorator}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    {body}
"""
FRESH = "pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10], new_tip='always')"
ONE_TIP = "pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10])"


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


def script(body: str, api: str, decorator: str = "") -> Script:
    return Script(TEXT.format(api=api, body=body, decorator=decorator), "protocol.py")


def simulated(
    sidecar: FakeSidecar, body: str = "", api: str = "2.16", text: str = "", **settings: Any
) -> tuple[list[str], list[str]]:
    """What the run log shows in the simulator, and the command types of the engine."""
    said: list[str] = []
    types: list[str] = []
    given = {
        "sidecar": sidecar.url, "run_id": "run", "watch_simulation": True, "recover": RETRY,
        "on_fail": "abort", "rules": "off",
    }  # fmt: skip

    def wrap(function: Any) -> Any:
        guarded = guard(function, **{**given, **settings})

        def run(protocol: Any) -> None:
            protocol.broker.subscribe(
                "command",
                lambda m: said.append(m["payload"]["text"]) if m["$"] == "before" else None,
            )
            try:
                guarded(protocol)
            finally:
                client = getattr(protocol._core, "_engine_client", None)
                if client is not None:
                    types.extend(c.commandType for c in client.state.commands.get_all())

        return run

    play(Script(text, "flex.py") if text else script(body, api), wrap)
    return said, types


def pipetting(types: list[str]) -> list[str]:
    short = {"pickUpTip": "pick", "dropTip": "drop", "aspirate": "draw", "dispense": "give",
             "dropTipInPlace": "drop", "blowout": "blow"}  # fmt: skip
    return [short[one] for one in types if one in short]


def states(sidecar: FakeSidecar) -> list[tuple[int, str, int | None]]:
    return [(one["trajectory"], one["state"], one["by"]) for one in sidecar.recoveries]


@pytest.mark.parametrize("api", ["2.14", "2.16", "2.27"])
def test_nothing_drawn_is_drawn_again_with_a_fresh_tip(api: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    said, types = simulated(sidecar, FRESH, api)
    once = ["pick", "draw", "give", "drop"]
    assert pipetting(types) == once * 3
    assert states(sidecar) == [(0, "begun", None), (0, "recovered", 1)]
    assert [hold["policy"] for hold in sidecar.holds] == ["recover", None, None]
    assert any("Recovery 1 of 2" in text for text in said)
    frames = sidecar.stored()
    assert [f["recovers"] for f in frames] == [None] * 4 + [0] * 4 + [None] * 4
    # The spare tip is the last one; the next delivery takes the tip that it always takes.
    assert [f["tip"] for f in frames[::4]] == ["1:A1", "1:H12", "1:B1"]
    assert frames[4]["line"] == frames[0]["line"]


@pytest.mark.parametrize("api", ["2.0", "2.13"])
def test_a_legacy_protocol_shows_every_command_of_it(api: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    said, _ = simulated(sidecar, FRESH, api)
    # A legacy context announces a command before the guard can act, so only their number is told.
    for verb in ("Picking", "Aspirating", "Dispensing", "Dropping"):
        assert sum(text.startswith(verb) for text in said) == 3
    assert states(sidecar)[-1] == (0, "recovered", 1)


def test_a_short_delivery_is_topped_up_by_what_is_missing(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", HALF
    _, types = simulated(sidecar, FRESH)
    assert pipetting(types) == ["pick", "draw", "give", "drop"] * 3
    assert sidecar.stored()[6]["commanded_ul"] == 25.0
    assert states(sidecar)[-1] == (0, "recovered", 1)


def test_the_tip_of_a_recovery_goes_to_no_further_well(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    _, types = simulated(sidecar, ONE_TIP)
    assert pipetting(types) == [
        "pick", "draw", "give", "drop", "pick", "draw", "give",
        "drop", "pick", "draw", "give", "drop",
    ]  # fmt: skip
    assert [f["tip"] for f in sidecar.stored()[::4]] == ["1:A1", "1:H12", "1:G12"]
    assert sidecar.stored()[8]["capacity_ul"] == 300


def test_liquid_goes_home_only_with_a_tip_that_touched_nothing_else(sidecar: FakeSidecar) -> None:
    stuck = {"failure": "no_dispense", "gate": "volumetric", "measured_ul": 50.0}
    sidecar.outcomes[0], sidecar.findings[0] = "fail", stuck
    low = """pipette.pick_up_tip()
    pipette.aspirate(50, plate["A1"])
    pipette.dispense(50, plate["A2"]{height})
    pipette.drop_tip()"""
    _, types = simulated(sidecar, low.format(height=".top()"))
    assert pipetting(types) == [
        "pick", "draw", "give", "blow", "drop", "pick", "draw", "give", "drop",
    ]  # fmt: skip
    _, types = simulated(sidecar, low.format(height=""), run_id="other")
    assert pipetting(types) == ["pick", "draw", "give", "drop"] * 2


def test_mixing_is_done_again_too(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    body = "pipette.transfer(50, plate['A1'], plate['A2'], air_gap=10, mix_after=(2, 30))"
    _, types = simulated(sidecar, body)
    once = pipetting(types)[: len(pipetting(types)) // 2]
    assert pipetting(types) == once * 2
    assert once.count("draw") == 4  # the liquid, the air, and twice in the well
    assert states(sidecar)[-1] == (0, "recovered", 1)


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("pipette.distribute(50, plate['A1'], plate.wells()[8:10])", "meant for other wells"),
        (
            "pipette.pick_up_tip(); pipette.aspirate(50, plate['A1']); "
            "pipette.dispense(50, plate['A2']); pipette.return_tip()",
            "puts its tip back",
        ),
        (
            "[(pipette.pick_up_tip(tip), pipette.aspirate(50, plate['A1']), "
            "pipette.dispense(50, plate['A2']), pipette.drop_tip()) for tip in tips.wells()]",
            "no tip is left",
        ),
        (
            "pipette.pick_up_tip(); pipette.aspirate(50, plate['A1']); "
            "pipette.dispense(50, plate['A2']); protocol.pause('look'); pipette.drop_tip()",
            "not between two moves",
        ),
    ],
)
def test_what_is_not_certain_is_left_to_a_person(body: str, why: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    sidecar_said = "The robot does not put it right by itself"
    with pytest.raises(Exception, match=sidecar_said) as raised:
        simulated(sidecar, body)
    assert why in str(raised.value)
    assert states(sidecar) == [(0, "refused", None)]


def test_a_recovery_that_nobody_saw_pass_is_a_failed_well(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    sidecar.outcomes[1] = "undecided"
    with pytest.raises(Exception, match="as configured"):
        simulated(sidecar, FRESH, on_fail="abort", on_undecided="continue")
    assert states(sidecar)[-1] == (0, "failed", 1)


def test_a_well_that_fails_again_and_again_is_left_to_a_person(sidecar: FakeSidecar) -> None:
    for number in range(4):
        sidecar.outcomes[number], sidecar.findings[number] = "fail", EMPTY
    with pytest.raises(Exception, match="it was tried 2 times"):
        simulated(sidecar, FRESH)
    assert len(sidecar.stored()) == 12
    assert states(sidecar) == [
        (0, "begun", None), (0, "failed", 1), (0, "begun", None), (0, "failed", 2),
        (0, "refused", None),
    ]  # fmt: skip


def test_a_recovered_well_that_cannot_be_judged_is_left_to_a_person(sidecar: FakeSidecar) -> None:
    sidecar.outcomes.update({0: "fail", 1: "undecided"})
    sidecar.findings[0] = EMPTY
    with pytest.raises(Exception, match="could not be judged"):
        simulated(sidecar, FRESH, on_undecided="abort")
    assert states(sidecar)[-1] == (0, "failed", 1)


def test_a_run_has_only_so_many(sidecar: FakeSidecar) -> None:
    sidecar.outcomes.update({0: "fail", 2: "fail"})
    sidecar.findings.update({0: EMPTY, 2: EMPTY})
    with pytest.raises(Exception, match="this run has had 1 recoveries"):
        simulated(sidecar, FRESH, recover_run_limit=1)


def test_without_failures_the_commands_are_those_without_recovery(sidecar: FakeSidecar) -> None:
    with_it = simulated(sidecar, ONE_TIP)
    without = simulated(sidecar, ONE_TIP, recover={}, run_id="other")
    assert [text for text in with_it[0] if "aegis_ot" not in text] == [
        text for text in without[0] if "aegis_ot" not in text
    ]
    assert with_it[1] == without[1]
    assert sidecar.recoveries == []


def test_a_transfer_by_liquid_class_on_a_flex_is_done_again(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    text = """
requirements = {"robotType": "Flex", "apiLevel": "2.24"}
def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "C1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    trash = protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_1000", "left", [tips])
    water = protocol.get_liquid_class("water")
    pipette.transfer_with_liquid_class(
        water, 50, plate.wells()[:2], plate.wells()[8:10], new_tip="always", trash_location=trash
    )
"""
    _, types = simulated(sidecar, text=text)
    picks = [place for place, kind in enumerate(types) if kind == "pickUpTip"]
    failed, again = types[picks[0] : picks[1]], types[picks[1] : picks[2]]
    assert pipetting(again) == pipetting(failed)
    assert again.count("airGapInPlace") == failed.count("airGapInPlace") > 0
    assert states(sidecar)[-1] == (0, "recovered", 1)
    assert [f["expected_ul"] for f in sidecar.stored()[4:8]] == [50.0, 50.0, 0.0, 0.0]


def test_it_works_with_a_hold_after_each_well(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    _, types = simulated(sidecar, ONE_TIP, hold="well")
    assert pipetting(types).count("pick") == 3
    assert states(sidecar)[-1] == (0, "recovered", 1)


def live(sidecar: FakeSidecar, body: str, api: str) -> LiveRun:
    decorator = f"@guard(sidecar={sidecar.url!r}, run_id='run', rules='off', recover={RETRY!r})"
    return LiveRun(script(body, api, decorator).text).start()


@pytest.fixture(params=["2.13", "2.16"])
def api(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """The legacy core is told that it is live, as the hardware simulator does not."""
    from opentrons.protocol_api.core.legacy.legacy_protocol_core import LegacyProtocolCore

    if request.param == "2.13":
        live_core = LegacyProtocolCore
        monkeypatch.setattr(
            live_core, "is_simulating", lambda self: "Simulator" in type(self).__name__
        )
    return str(request.param)


def test_the_run_log_of_a_live_run_shows_the_recovery(api: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    run = live(sidecar, ONE_TIP, api).join()
    assert run.told == ""
    types = [command.commandType for command in run.commands]
    assert "waitForResume" not in types
    assert pipetting(types) == [
        "pick", "draw", "give", "drop", "pick", "draw", "give",
        "drop", "pick", "draw", "give", "drop",
    ]  # fmt: skip
    assert all(str(command.status.value) == "succeeded" for command in run.commands)


def test_a_stop_during_a_recovery_ends_the_run_at_once(api: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0], sidecar.findings[0] = "fail", EMPTY
    hanging, release = threading.Event(), threading.Event()

    def hang(handler: Handler) -> bool:
        if not (handler.path.endswith("/keyframes") and handler.body["sequence"] == 5):
            return False
        hanging.set()
        release.wait()
        handler.drop()
        return True

    sidecar.fault = hang  # at the TRANSIT keyframe of the recovery
    run = live(sidecar, ONE_TIP, api)
    assert hanging.wait(60)
    run.stop()
    run.join()
    release.set()
    types = [command.commandType for command in run.commands if command.status == "succeeded"]
    assert pipetting(types) == ["pick", "draw", "give", "drop", "pick", "draw"]
    assert [one["outcome"] for one in sidecar.finished] == ["stopped"]
