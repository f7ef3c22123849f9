"""Holds and pauses on Opentrons' own engine, live on its hardware simulator."""

from __future__ import annotations

import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest

from aegis_ot.errors import RunAborted
from aegis_ot.runtime import boundaries, outbox
from aegis_ot.runtime import keyframe_sender as sender
from aegis_ot.runtime import operator as operator_module
from aegis_ot.settings import Settings
from aegis_ot.vocabulary import Outcome

from .fake_sidecar import FakeSidecar, Handler
from .live import LiveRun

MOVES = ("aspirate", "dispense", "dropTip", "moveToWell")


def two_wells(context: Any) -> None:
    tips = context.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = context.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = context.load_instrument("p300_single_gen2", "left", [tips])
    pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10])


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


def settings(sidecar: FakeSidecar, **more: Any) -> Settings:
    return Settings(**{"sidecar": sidecar.url, "run_id": "run", **more})


def in_time(condition: Callable[[], bool], seconds: float = 60.0) -> None:
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.01)


def test_a_good_run_is_whole(sidecar: FakeSidecar) -> None:
    run = LiveRun(two_wells, settings(sidecar)).start().join()
    assert run.error is None
    assert [f["sequence"] for f in sidecar.stored()] == list(range(8))
    assert {h["resolution"] for h in sidecar.holds} == {"verdict"}
    told = {"outcome": "succeeded", "detail": "", "trajectories": 2, "keyframes": 8}
    assert sidecar.finished == [told]
    assert run.watcher is not None
    assert "2 passed" in run.watcher.summary()


@pytest.mark.parametrize("api", ["2.24", "2.15", "2.13"])
def test_a_stop_during_a_hold_ends_the_run(api: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = None  # no verdict ever
    # On the legacy core the hardware simulator makes is_simulating() true.
    told = settings(sidecar, watch_simulation=True, verdict_timeout_s=600.0)
    run = LiveRun(two_wells, told, api).start()
    assert sidecar.asked.wait(60)
    run.stop()
    run.join()
    assert type(run.error).__name__ in ("RunStoppedError", "ExecutionCancelledError")
    assert [f["outcome"] for f in sidecar.finished] == ["stopped"]


@pytest.mark.parametrize("path", ["/keyframes", "/verdict", "/run", "/hold", "/finish"])
def test_a_stop_while_the_sidecar_hangs(
    path: str, sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No wait ends by itself before the run is given up: the stop ends it."""
    for module in (sender, outbox):
        monkeypatch.setattr(module, "REQUEST_S", 600.0)
    hanging, release = threading.Event(), threading.Event()

    def hang(handler: Handler) -> bool:
        if not handler.path.split("?")[0].endswith(path):
            return False
        hanging.set()
        release.wait()
        handler.drop()
        return True

    sidecar.fault = hang
    patient = settings(sidecar, capture_timeout_s=600.0, verdict_timeout_s=600.0)
    run = LiveRun(two_wells, patient).start()
    assert hanging.wait(60)
    run.stop()
    run.join()
    release.set()


def test_a_stop_while_the_sidecar_is_absent(sidecar: FakeSidecar) -> None:
    sidecar.die()
    run = LiveRun(two_wells, settings(sidecar, capture_timeout_s=600.0)).start()
    in_time(lambda: any("Trying again for" in said for said in comments(run.seen())))
    run.stop()
    run.join()


def test_a_failed_well_pauses_before_the_next_is_touched_and_play_goes_on(
    sidecar: FakeSidecar,
) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar)).start()
    run.wait_for_status("paused")
    in_time(lambda: bool(sidecar.holds))
    assert sidecar.holds[0]["policy"] == "pause"
    assert len(sidecar.stored()) == 4
    run.play()
    run.join()
    assert run.error is None
    kinds = [command.commandType for command in run.commands]
    pause = kinds.index("waitForResume")
    assert [k for k in kinds[:pause] if k in MOVES] == [
        "aspirate", "moveToWell", "dispense", "moveToWell",
    ]  # fmt: skip
    message = run.commands[pause].params.message
    assert "A2 of Corning 96 Well Plate" in message
    assert "partial dispense" in message
    assert "the column is too long" in message
    assert len(sidecar.stored()) == 8


def test_a_stop_during_the_pause_ends_as_opentrons_ends_it(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "undecided"
    run = LiveRun(two_wells, settings(sidecar)).start()
    run.wait_for_status("paused")
    run.stop()
    run.join()
    assert run.error is not None
    assert not isinstance(run.error, RunAborted)
    assert [f["outcome"] for f in sidecar.finished] == ["stopped"]


def test_an_operators_pause_during_a_hold_waits_for_play(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    ahead = [0.0]
    clock = SimpleNamespace(monotonic=lambda: time.monotonic() + ahead[0])
    monkeypatch.setattr(boundaries, "time", clock)
    is_paused, is_late = threading.Event(), threading.Event()

    def pass_time(handler: Handler) -> bool:
        if "/verdict" in handler.path and is_paused.is_set():
            ahead[0] = 100.0  # longer than the verdict may take, were it not for the pause
            is_late.set()
        return False

    sidecar.outcomes[0], sidecar.fault = None, pass_time
    run = LiveRun(two_wells, settings(sidecar, verdict_timeout_s=90.0)).start()
    assert sidecar.asked.wait(60)
    run.pause()
    run.wait_for_status("paused")
    is_paused.set()
    assert is_late.wait(60)
    sidecar.outcomes[0] = "pass"
    in_time(lambda: bool(sidecar.holds))
    assert sidecar.holds[0]["resolution"] == "verdict"
    assert run.status == "paused"
    run.play()
    run.join()
    assert run.error is None


def test_abort_ends_the_run_with_the_reason(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[1] = "fail"
    run = LiveRun(two_wells, settings(sidecar, on_fail="abort")).start().join()
    assert isinstance(run.error, RunAborted)
    assert "B2" in str(run.error)
    assert sidecar.finished[0]["outcome"] == "aborted"


def test_continue_comments_and_goes_on(sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar, on_fail="continue")).start().join()
    assert run.error is None
    comments = [c.params.message for c in run.commands if c.commandType == "comment"]
    assert len(comments) == 1
    assert "The run goes on, as configured" in comments[0]
    assert run.watcher is not None
    assert "1 failed (A2 of" in run.watcher.summary()


def test_a_lost_sidecar_pauses_and_nothing_is_lost_when_it_is_back(sidecar: FakeSidecar) -> None:
    sidecar.fault = lambda handler: sidecar.fault is not None and _die_at(handler, sidecar, 2)
    run = LiveRun(two_wells, settings(sidecar, capture_timeout_s=2.0)).start()
    run.wait_for_status("paused")
    with FakeSidecar(port=sidecar.port) as reborn:
        reborn.keyframes = sidecar.keyframes  # it kept its store
        run.play()
        run.join()
        assert run.error is None
        assert [f["sequence"] for f in reborn.stored()] == list(range(8))
        assert not any(f["late"] for f in reborn.stored())
    assert run.watcher is not None
    assert run.watcher.result.outages == 1
    assert "2 passed" in run.watcher.summary()


def lost_at_the_third_keyframe(sidecar: FakeSidecar, seconds: float) -> LiveRun:
    """A run whose sidecar dies, and that says so while it tries again."""
    sidecar.fault = lambda handler: sidecar.fault is not None and _die_at(handler, sidecar, 2)
    run = LiveRun(two_wells, settings(sidecar, capture_timeout_s=seconds)).start()
    in_time(lambda: any("Trying again for" in said for said in comments(run.seen())))
    assert run.status == "running"
    return run


def comments(commands: list[Any]) -> list[str]:
    return [c.params.message for c in commands if c.commandType == "comment"]


def test_a_lost_sidecar_is_told_while_it_is_tried_again(sidecar: FakeSidecar) -> None:
    run = lost_at_the_third_keyframe(sidecar, 60.0)
    with FakeSidecar(port=sidecar.port) as reborn:
        reborn.keyframes = sidecar.keyframes
        run.join()
    assert run.error is None
    assert "waitForResume" not in [command.commandType for command in run.commands]
    assert sum("Trying again for" in said for said in comments(run.commands)) == 1


def test_a_sidecar_that_is_slow_at_each_keyframe_is_told_of_once(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("aegis_ot.runtime.retrying._SILENT_S", 0.05)
    dropped: Counter[int] = Counter()

    def slow(handler: Handler) -> bool:
        """It takes each keyframe at the third try; the client asks twice at each."""
        number = len(sidecar.stored())
        if not handler.path.endswith("/keyframes") or dropped[number] == 4:
            return False
        dropped[number] += 1
        handler.drop()
        return True

    sidecar.fault = slow
    run = LiveRun(two_wells, settings(sidecar, capture_timeout_s=60.0)).start()
    run.join()
    assert run.error is None
    assert len(sidecar.stored()) == 8
    assert sum("Trying again for" in said for said in comments(run.commands)) == 1


def test_an_operator_who_pauses_during_the_retries_resumes_once(sidecar: FakeSidecar) -> None:
    run = lost_at_the_third_keyframe(sidecar, 6.0)
    run.pause()
    run.wait_for_status("paused")
    time.sleep(6.0)  # the retries end meanwhile
    with FakeSidecar(port=sidecar.port) as reborn:
        reborn.keyframes = sidecar.keyframes
        in_time(lambda: len(reborn.stored()) == 3)
        run.play()
        run.join()
    assert run.error is None
    assert "waitForResume" not in [command.commandType for command in run.commands]


def _die_at(handler: Handler, sidecar: FakeSidecar, count: int) -> bool:
    if handler.path.endswith("/keyframes") and len(sidecar.stored()) == count:
        sidecar.fault = None
        threading.Thread(target=sidecar.die, daemon=True).start()
        handler.drop()
        return True
    return False


def test_where_nobody_can_resume_the_operator_answers_on_the_page(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operator_module, "can_be_resumed", lambda: False)
    sidecar.outcomes.update({0: "fail", 1: "fail"})
    run = LiveRun(two_wells, settings(sidecar)).start()
    in_time(lambda: bool(sidecar.holds))
    sidecar.decided[0] = "pass"
    sidecar.actions[0] = "resume"
    in_time(lambda: len(sidecar.holds) == 3)
    assert [hold.get("answered") for hold in sidecar.holds] == [None, "page", None]
    sidecar.decided[1] = "fail"
    sidecar.actions[1] = "stop"
    run.join()
    assert run.watcher is not None
    assert run.watcher.result.verdicts[0].outcome is Outcome.PASS
    assert isinstance(run.error, RunAborted)
    assert "waitForResume" not in [c.commandType for c in run.commands]


def test_a_protocol_that_fails_by_itself_fails_with_its_own_error(sidecar: FakeSidecar) -> None:
    def broken(context: Any) -> None:
        two_wells(context)
        raise KeyError("plate map")

    run = LiveRun(broken, settings(sidecar)).start().join()
    assert type(run.error) is KeyError
    assert sidecar.finished[0]["outcome"] == "failed"
    assert "plate map" in sidecar.finished[0]["detail"]


@pytest.fixture
def legacy(monkeypatch: pytest.MonkeyPatch) -> str:
    """An apiLevel of the legacy core, which the hardware simulator tells that it is live."""
    from opentrons.protocol_api.core.legacy.legacy_protocol_core import LegacyProtocolCore

    monkeypatch.setattr(LegacyProtocolCore, "is_simulating", lambda self: False)
    return "2.13"


def test_a_legacy_protocol_pauses_and_plays_on(legacy: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar), legacy).start()
    run.wait_for_status("paused")
    assert len(sidecar.stored()) == 4
    run.play()
    run.join()
    assert run.error is None
    assert run.status == "succeeded"
    assert len(sidecar.stored()) == 8
    kinds = [command.commandType for command in run.commands]
    pause = kinds.index("waitForResume")
    assert "partial dispense" in run.commands[pause].params.message
    # The command that had to wait for the verdict is the next one.
    assert kinds[pause - 1 : pause + 2] == ["dispense", "waitForResume", "aspirate"]


def test_a_legacy_protocol_tells_its_reason_while_it_is_paused(
    legacy: str, sidecar: FakeSidecar
) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar), legacy).start()
    run.wait_for_status("paused")
    seen = run.seen()
    assert seen[-1].commandType == "waitForResume"
    assert "partial dispense" in seen[-1].params.message
    run.play()
    run.join()


def test_a_legacy_protocol_is_stopped_during_its_pause(legacy: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar), legacy).start()
    run.wait_for_status("paused")
    run.stop()
    run.join()
    assert [f["outcome"] for f in sidecar.finished] == ["stopped"]


def test_a_legacy_protocol_goes_on_as_configured(legacy: str, sidecar: FakeSidecar) -> None:
    sidecar.outcomes[0] = "fail"
    run = LiveRun(two_wells, settings(sidecar, on_fail="continue"), legacy).start().join()
    assert run.error is None
    comments = [c.params.message for c in run.commands if c.commandType == "comment"]
    assert any("The run goes on, as configured" in comment for comment in comments)


def test_a_legacy_protocol_waits_for_a_lost_sidecar(legacy: str, sidecar: FakeSidecar) -> None:
    sidecar.fault = lambda handler: sidecar.fault is not None and _die_at(handler, sidecar, 2)
    run = LiveRun(two_wells, settings(sidecar, capture_timeout_s=2.0), legacy).start()
    run.wait_for_status("paused")
    time.sleep(2.5)  # longer than it is tried again
    with FakeSidecar(port=sidecar.port) as reborn:
        reborn.keyframes = sidecar.keyframes
        run.play()
        run.join()
        assert not any(f["late"] for f in reborn.stored())
        assert len(reborn.stored()) == 8
