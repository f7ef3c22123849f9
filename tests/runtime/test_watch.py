"""Failure policies and resending, on a simulated context against a real server."""

from __future__ import annotations

import sys
import time
import types
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from opentrons import simulate

from aegis_ot.adapters.opentrons.instrumentation.tap import tapped
from aegis_ot.adapters.opentrons.run_state import RunState, can_be_resumed
from aegis_ot.errors import RunAborted
from aegis_ot.runtime import Watcher, keyframe_sender
from aegis_ot.settings import Settings

from .fake_sidecar import FakeSidecar, Handler, once
from .live import LiveRun


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


def wells(count: int) -> Callable[[Any], None]:
    def protocol(context: Any) -> None:
        tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
        plate = context.load_labware("corning_96_wellplate_360ul_flat", "2")
        pipette = context.load_instrument("p300_single_gen2", "left", [tips])
        pipette.transfer(50, plate.wells()[:count], plate.wells()[8 : 8 + count])

    return protocol


def watch(
    protocol: Callable[[Any], None], settings: Settings
) -> tuple[Watcher, list[str], BaseException | None]:
    """Run under a watcher: the watcher, the command texts, what was raised."""
    context = simulate.get_protocol_api("2.13")
    texts: list[str] = []
    context.broker.subscribe(
        "command",
        lambda m: texts.append(m["payload"]["text"]) if m["$"] == "before" else None,
    )
    watcher = Watcher(context, settings, "some/folder/protocol.py")
    with tapped(context, [watcher], protocol.__code__.co_filename) as tap:
        try:
            watcher.begin(tap)
            try:
                protocol(context)
            except BaseException as error:
                watcher.end(error)
                raise
            watcher.end(None)
        except RunAborted as error:
            return watcher, texts, error
    return watcher, texts, None


def settings(sidecar: FakeSidecar, **more: Any) -> Settings:
    given = {
        "sidecar": sidecar.url,
        "run_id": "run",
        "watch_simulation": True,
        "capture_timeout_s": 60.0,
        "verdict_timeout_s": 60.0,
    }
    return Settings(**{**given, **more})


def said(texts: list[str]) -> list[str]:
    return [text for text in texts if text.startswith("aegis_ot")]


def test_a_keyframe_carries_what_the_robot_knows(sidecar: FakeSidecar) -> None:
    watcher, _, error = watch(wells(1), settings(sidecar))
    assert error is None
    start = next(body for method, _, body in sidecar.requests if method == "PUT")
    assert start["protocol"] == "protocol.py"
    assert start["simulated"] is True
    aspirate, transit, dispense, post = sidecar.stored()
    assert aspirate["tip"] == "1:A1"
    assert [w["name"] for w in aspirate["sources"]] == ["A1"]
    assert aspirate["destinations"] == []
    assert [w["name"] for w in transit["destinations"]] == ["A2"]
    assert [f["expected_ul"] for f in (aspirate, transit, dispense, post)] == [50, 50, 0, 0]
    assert {f["commanded_ul"] for f in sidecar.stored()} == {50}
    assert {f["capacity_ul"] for f in sidecar.stored()} == {300}
    assert transit["position"][2] == post["position"][2] > dispense["position"][2]
    assert abs(aspirate["robot_time"] - time.time()) < 60
    assert aspirate["line"] is not None
    assert watcher.result.keyframes == 4


def test_an_analysis_inserts_the_same_moves_and_talks_to_nobody(sidecar: FakeSidecar) -> None:
    def commands(**more: Any) -> list[str]:
        context = simulate.get_protocol_api("2.15")
        watcher = Watcher(context, settings(sidecar, **more), "p.py")
        protocol = wells(2)
        with tapped(context, [watcher], protocol.__code__.co_filename) as tap:
            watcher.begin(tap)
            protocol(context)
            watcher.end(None)
        state = context._core._engine_client.state
        return [command.commandType for command in state.commands.get_all()]

    quiet = commands(watch_simulation=False)
    assert sidecar.requests == []
    assert commands() == quiet
    assert sidecar.requests != []
    assert quiet.count("moveToWell") == 4
    assert commands(lift=False).count("moveToWell") == 0


def test_a_simulated_pause_is_reported_and_the_run_goes_on(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[1] = "fail"
    watcher, texts, error = watch(wells(3), settings(sidecar))
    assert error is None
    assert len(said(texts)) == 1
    assert "B2" in said(texts)[0]
    assert "would pause here" in said(texts)[0]
    assert "2 passed, 1 failed (B2" in watcher.summary()


@pytest.mark.parametrize(("outcome", "name"), [("fail", "on_fail"), ("undecided", "on_undecided")])
def test_abort(outcome: str, name: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = outcome
    _, _, error = watch(wells(2), settings(sidecar, **{name: "abort"}))
    assert isinstance(error, RunAborted)
    assert "A2" in str(error)
    assert sidecar.finished[0]["outcome"] == "aborted"
    assert len(sidecar.stored()) == 4


def test_a_verdict_that_never_comes(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = None
    short = {"verdict_timeout_s": 0.3}
    watcher, _, error = watch(wells(1), settings(sidecar, on_link_loss="abort", **short))
    assert isinstance(error, RunAborted)
    assert "within 0.3 s" in str(error)
    assert watcher.result.lost == {0: "timeout"}
    watcher, texts, error = watch(
        wells(1), settings(sidecar, on_link_loss="continue", run_id="again", **short)
    )
    assert error is None
    assert len(said(texts)) == 1
    assert "1 undecided (A2" in watcher.summary()


def test_hold_off_never_waits_until_the_end(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    watcher, texts, error = watch(wells(2), settings(sidecar, hold="off", on_fail="abort"))
    assert error is None
    polls = [i for i, r in enumerate(sidecar.requests) if "/verdict" in r[1]]
    last = max(i for i, r in enumerate(sidecar.requests) if r[1].endswith("/keyframes"))
    assert min(polls) > last
    assert "1 failed" in watcher.summary()
    assert len(said(texts)) == 1


class TestLinkLoss:
    def test_absent_from_the_start(self, sidecar: FakeSidecar) -> None:
        sidecar.die()
        short = {"capture_timeout_s": 0.3}
        _, texts, error = watch(wells(1), settings(sidecar, on_link_loss="abort", **short))
        assert isinstance(error, RunAborted)
        assert sidecar.url in str(error)
        assert not any("Picking up" in text for text in texts)
        patience = settings(sidecar, on_link_loss="continue", **short)
        watcher, texts, error = watch(wells(4), patience)
        assert error is None
        assert watcher.result.outages == 1  # one patient try, not one for each keyframe
        assert len(said(texts)) == 1
        assert "4 undecided" in watcher.summary()

    def test_a_refused_token_is_not_asked_again(self) -> None:
        with FakeSidecar(token="right") as strict:
            _, _, error = watch(wells(1), settings(strict, token="wrong", on_link_loss="abort"))
            assert isinstance(error, RunAborted)
            assert "AEGIS_OT_TOKEN" in str(error)
            assert len(strict.requests) <= 2

    def test_one_dropped_connection_is_nobodys_business(self, sidecar: FakeSidecar) -> None:
        sidecar.fault = once("/keyframes", Handler.drop, times=2)
        watcher, texts, error = watch(wells(2), settings(sidecar, capture_timeout_s=60.0))
        assert error is None
        assert said(texts) == []
        assert [f["sequence"] for f in sidecar.stored()] == list(range(8))
        assert watcher.result.outages == 0

    def test_a_camera_that_hiccups_is_asked_again(self, sidecar: FakeSidecar) -> None:
        sidecar.fault = once("/keyframes", lambda h: h.answer(503, {"error": "no frame"}), 2)
        watcher, texts, _ = watch(wells(1), settings(sidecar, capture_timeout_s=60.0))
        assert said(texts) == []
        assert len(sidecar.stored()) == 4
        assert "1 passed" in watcher.summary()

    def test_a_dead_camera_is_named_even_if_the_last_try_was_cut_short(
        self, sidecar: FakeSidecar
    ) -> None:
        def slow_camera(handler: Handler) -> None:
            time.sleep(0.9)
            error = {"code": "camera", "message": "No frame.", "hint": ""}
            handler.answer(503, {"error": error})

        sidecar.fault = once("/keyframes", slow_camera, times=100)
        patience = settings(sidecar, capture_timeout_s=2.0, on_link_loss="abort")
        _, _, error = watch(wells(1), patience)
        assert isinstance(error, RunAborted)
        assert "got no usable frame from its camera" in str(error)

    def test_garbage_is_a_lost_link(self, sidecar: FakeSidecar) -> None:
        sidecar.fault = once("/keyframes", lambda h: h.raw(b"\x00\x01 garbage\r\n\r\n"), 1000)
        patience = settings(sidecar, on_link_loss="abort", capture_timeout_s=2.0)
        _, _, error = watch(wells(1), patience)
        assert isinstance(error, RunAborted)
        assert "no sense" in str(error)

    def test_garbled_verdicts_end_in_the_policy_and_not_in_a_loop(
        self, sidecar: FakeSidecar
    ) -> None:
        sidecar.fault = once("/verdict", lambda h: h.answer(200, {"verdict": 5}), 100_000)
        patience = settings(sidecar, on_link_loss="abort", verdict_timeout_s=0.3)
        _, _, error = watch(wells(1), patience)
        assert isinstance(error, RunAborted)

    def test_a_sidecar_that_forgot_the_run_gets_all_again_marked_late(
        self, sidecar: FakeSidecar
    ) -> None:
        def forget(handler: Handler) -> None:
            sidecar.keyframes.clear()
            handler.serve()

        left = [0]

        def fault(handler: Handler) -> bool:
            if handler.path.endswith("/keyframes"):
                left[0] += 1
                if left[0] == 6:  # TRANSIT of the second well
                    forget(handler)
                    return True
            return False

        sidecar.fault = fault
        watcher, texts, error = watch(wells(2), settings(sidecar, capture_timeout_s=60.0))
        assert error is None
        stored = sidecar.stored()
        assert [f["sequence"] for f in stored] == list(range(8))
        assert [f["late"] for f in stored] == [True] * 5 + [False] * 3
        assert len(said(texts)) == 1
        assert "B2" in said(texts)[0]
        assert "the sidecar lost its keyframes" in said(texts)[0]
        # The first had its verdict before; of the second one keyframe is worthless.
        assert "1 passed, 1 undecided (B2" in watcher.summary()

    def test_a_sidecar_that_forgot_the_run_during_a_hold_is_not_waited_for(
        self, sidecar: FakeSidecar
    ) -> None:
        def forget(handler: Handler) -> None:
            sidecar.keyframes.clear()
            handler.serve()

        sidecar.fault = once("/verdict", forget)
        patience = settings(sidecar, verdict_timeout_s=600.0)
        watcher, texts, error = watch(wells(2), patience)
        assert error is None
        assert "A2" in said(texts)[0]
        assert "the sidecar lost its keyframes" in said(texts)[0]
        assert [f["sequence"] for f in sidecar.stored()] == list(range(8))
        assert [f["late"] for f in sidecar.stored()] == [True] * 4 + [False] * 4
        assert "1 passed, 1 undecided (A2" in watcher.summary()

    def test_it_is_found_again_and_gets_what_it_missed(
        self, sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(keyframe_sender, "_FIRST_REST_S", 0.0)
        monkeypatch.setattr(keyframe_sender, "_LONGEST_REST_S", 0.0)
        monkeypatch.setattr(keyframe_sender, "GLANCE_S", 60.0)
        sidecar.fault = once("/keyframes", Handler.drop, times=10_000)

        def protocol(context: Any) -> None:
            tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
            plate = context.load_labware("corning_96_wellplate_360ul_flat", "2")
            pipette = context.load_instrument("p300_single_gen2", "left", [tips])
            pipette.transfer(50, plate["A1"], plate["A2"])
            sidecar.fault = None
            pipette.transfer(50, plate["B1"], plate["B2"])

        # A busy machine answers late; that is no second outage.
        patient = settings(sidecar, on_link_loss="continue", capture_timeout_s=2.0)
        watcher, _, error = watch(protocol, patient)
        assert error is None
        stored = sidecar.stored()
        assert [f["sequence"] for f in stored] == list(range(8))
        assert [f["late"] for f in stored] == [True] * 4 + [False] * 4
        assert "1 passed, 1 undecided (A2" in watcher.summary()
        assert watcher.result.outages == 1

    def test_a_run_id_that_was_used_before(self, sidecar: FakeSidecar) -> None:
        sidecar.fault = once(
            "/keyframes", lambda h: h.answer(409, {"error": {}, "expected": 12}), 1000
        )
        _, _, error = watch(wells(1), settings(sidecar, on_link_loss="abort"))
        assert isinstance(error, RunAborted)
        assert "new run_id" in str(error)


def test_nobody_can_resume_where_opentrons_execute_owns_the_hardware(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    module = types.ModuleType("opentrons.execute")
    monkeypatch.setitem(sys.modules, "opentrons.execute", module)
    assert can_be_resumed()  # imported, and not in use
    module._THREAD_MANAGED_HW = object()  # type: ignore[attr-defined]
    assert not can_be_resumed()


def test_where_nobody_can_resume_a_dead_camera_waits_for_the_page(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sidecar is there all the time: that alone mends no camera."""
    module = types.ModuleType("opentrons.execute")
    module._THREAD_MANAGED_HW = object()  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "opentrons.execute", module)
    error = {"error": {"code": "camera", "message": "No frame.", "hint": ""}}
    dead = True

    def fault(handler: Handler) -> bool:
        nonlocal dead
        if handler.path.endswith("/hold") and handler.body["resolution"] == "camera":
            sidecar.actions[0] = "resume"  # a person sees the page, and puts the cable back
            dead = False
        if dead and handler.path.endswith("/keyframes"):
            handler.answer(503, error)
            return True
        return False

    sidecar.fault = fault
    short = settings(sidecar, watch_simulation=False, capture_timeout_s=0.3)
    live = LiveRun(wells(1), short).start().join()
    assert live.error is None
    (told,) = [hold for hold in sidecar.holds if hold.get("answered")]
    assert (told["resolution"], told["answered"]) == ("camera", "page")
    assert not any(keyframe["late"] for keyframe in sidecar.stored())


def test_a_core_of_an_unknown_version_is_neither_stopping_nor_paused() -> None:
    state = RunState(types.SimpleNamespace(_core=object()))
    assert not state.stopping
    assert not state.paused


def columns(context: Any) -> None:
    tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = context.load_labware("corning_96_wellplate_360ul_flat", "2", "plate")
    pipette = context.load_instrument("p300_multi_gen2", "left", [tips])
    for column in (1, 2):
        pipette.transfer(50, plate.columns()[0][0], plate.columns()[column][0])


def channels(column: int, told: str) -> list[dict[str, Any]]:
    words = {".": "pass", "F": "fail", "u": "unobserved"}
    return [
        {
            "nozzle": f"{row}1",
            "outcome": words[sign],
            "well": {"labware": "p", "name": f"{row}{column}", "label": "plate", "slot": "2"},
        }
        for row, sign in zip("ABCDEFGH", told, strict=True)
    ]


def test_wells_that_the_camera_cannot_see_are_told_once_and_hold_nothing(
    sidecar: FakeSidecar,
) -> None:
    sidecar.channels = {0: channels(2, "uuuuu..."), 1: channels(3, "uuuuu...")}
    watcher, texts, error = watch(columns, settings(sidecar, on_fail="abort"))
    assert error is None
    told = [text for text in said(texts) if "does not see" in text]
    assert len(told) == 1
    assert "A2 to E2 of plate (slot 2)" in told[0]
    assert "10 wells unobserved" in watcher.summary()


def test_a_failed_channel_holds_the_run_with_its_well_named(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[1] = "fail"
    sidecar.channels = {1: channels(3, "..F....F")}
    _, _, error = watch(columns, settings(sidecar, on_fail="abort"))
    assert "Delivery into C3, H3 of plate (slot 2) failed" in str(error)


def test_a_row_of_which_no_tip_was_seen_has_not_passed(sidecar: FakeSidecar) -> None:
    sidecar.channels = {0: channels(2, "uuuuuuuu"), 1: channels(3, "........")}
    watcher, _, _ = watch(columns, settings(sidecar))
    assert "1 passed" in watcher.summary()


@pytest.mark.parametrize("policy", ["continue", "pause", "abort"])
def test_what_a_protocol_names_begins_no_line_of_the_run_log(
    policy: str, sidecar: FakeSidecar
) -> None:
    """A CI job that simulates would take it for a command of its own."""
    evil = "plate\n::error::owned\x1b[2J"

    def protocol(context: Any) -> None:
        tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
        plate = context.load_labware("corning_96_wellplate_360ul_flat", "2", label=evil)
        pipette = context.load_instrument("p300_single_gen2", "left", [tips])
        pipette.transfer(50, plate["A1"], plate["B1"])

    sidecar.outcomes[0] = "fail"
    sidecar.findings[0] = {"reason": f"Ada decided fail: {evil}"}
    watcher, texts, error = watch(protocol, settings(sidecar, on_fail=policy))
    told = [*said(texts), watcher.summary(), str(error or "")]
    assert any("owned" in text for text in told)
    assert not any("\n" in text or "\x1b" in text for text in told)
