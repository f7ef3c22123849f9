"""``aegis-ot rest``: what a stopped run left, and the protocol that finishes it."""

from __future__ import annotations

import functools
import hashlib
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.instrumentation import Operation
from aegis_ot.adapters.opentrons.rehearsal import Recording, Script, record
from aegis_ot.errors import CameraError
from aegis_ot.run_view.finishing import finishing_protocol
from aegis_ot.run_view.plain_protocol import NotPlain, plan_of
from aegis_ot.run_view.remaining import rest_of
from aegis_ot.run_view.rest import RehearsedDelivery, Rest
from aegis_ot.runtime.planner import Planner
from aegis_ot.settings import Settings
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.overview import run_overview
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.wire import Decision, Finish, RecoveryReport, RunStart
from aegis_ot.vocabulary import Outcome, Route, Verdict
from tests.runtime.live import LiveRun
from tests.sidecar.helpers import StubAnalyser, StubCamera, make_jpeg

from .commands import Command

EXAMPLES = Path(__file__).parents[2] / "examples" / "demo"
HELLO = EXAMPLES / "hello_guard.py"
WORKLIST = EXAMPLES / "normalisation_plate.py"
KINDS = {"aspirate": 1, "transit": 2, "dispense": 3}


@functools.cache
def rehearsed(text: str, name: str) -> tuple[Recording, Planner]:
    """Once for all tests: the same text does the same."""
    planner = Planner()
    recording = record(Script(text, name), [planner])
    planner.finish()
    return recording, planner


def rehearse(path: Path) -> Recording:
    return rehearsed(path.read_text(encoding="utf-8"), path.name)[0]


def stopped(
    folder: Path,
    protocol: Path,
    outcomes: Mapping[int, str],
    keyframes: int = 0,
    end: Mapping[str, Any] | None = None,
    ended: bool = True,
) -> Store:
    """A run that stopped: its first deliveries as judged, and some keyframes of the next one; and
    what its robot said in the ``end``, by default that this is all that it did."""
    recording, planner = rehearsed(protocol.read_text(encoding="utf-8"), protocol.name)
    digest = hashlib.sha256(recording.text.encode()).hexdigest()
    store = Store(folder)
    about = planner.about(recording.labware)
    start = {"run": "r", "protocol": protocol.name, "protocol_sha256": digest, **about}
    store.register(RunStart.model_validate(start))
    last = len(outcomes)
    began = last + (keyframes > 0)
    count = 0
    for keyframe in planner.keyframes:
        begun = keyframe.trajectory == last and keyframes > 0
        keyframes -= begun
        if keyframe.trajectory < last or begun:
            count += 1
            store.add_keyframe(Captured(replace(keyframe, run="r"), 0.01, time.time()), make_jpeg())
    for number, outcome in outcomes.items():
        route = Route.CALIBRATION if number == 0 else Route.GREY_ZONE
        store.add_verdict(Verdict("r", number, Outcome(outcome), route), {})
    if ended:
        told = {"outcome": "stopped", "trajectories": began, "keyframes": count} | (end or {})
        store.finish("r", Finish.model_validate(told))
    return store


def rest_in(folder: Path, protocol: Path | None = None) -> tuple[Rest, Recording | None]:
    """As the command puts it together; the rehearsal in this process."""
    overview = run_overview(Store(folder), "r")
    if protocol is None:
        return rest_of(overview), None
    recording = rehearse(protocol)
    return rest_of(overview, *plan_of(recording)), recording


def finish(folder: Path, protocol: Path, again: Sequence[int] = (), fresh: bool = False) -> str:
    left, recording = rest_in(folder, protocol)
    assert recording is not None
    return finishing_protocol(recording, left, again, fresh)


def wells(left: Rest, standing: str) -> list[str]:
    return [well for one in left.deliveries if one.standing == standing for well in one.wells]


def planned(text: str) -> tuple[list[RehearsedDelivery], dict[str, float]]:
    return plan_of(rehearsed(text, "finish.py")[0])


def test_what_failed_or_is_undecided_is_never_done(tmp_path: Path) -> None:
    stopped(tmp_path, HELLO, {0: "pass", 1: "fail", 2: "undecided", 3: "pass"}).close()
    left, _ = rest_in(tmp_path)
    assert wells(left, "done") == ["3:A1", "3:D1"]
    assert wells(left, "look") == ["3:B1", "3:C1"]
    assert wells(left, "open") == ["3:E1", "3:F1", "3:G1", "3:H1"]
    held = {one.well: (one.least_ul, one.most_ul) for one in left.wells}
    assert held["3:A1"] == (100, 100)
    assert held["3:B1"] == (0, 100)
    assert held["2:A1"] == (-400, -200)
    assert [tip.tip for tip in left.tips] == ["1:A1", "1:B1", "1:C1", "1:D1"]


def test_the_protocol_that_is_written_makes_the_open_deliveries(
    aegis: Command, tmp_path: Path
) -> None:
    data, out, told, block = (tmp_path / name for name in ("data", "f.py", "r.json", "block.py"))
    stopped(data, HELLO, {0: "pass", 1: "fail", 2: "pass"}, keyframes=1).close()
    done = aegis(
        "rest", "r", HELLO, "--data", data, "--write", out, "--json", told, "--block", block
    )
    assert done.code == 0, done.err
    assert "2 done, 5 open, 1 to look at" in done.out
    assert "written, not started. Layer 1: pass" in done.err
    left = Rest.model_validate_json(told.read_text(encoding="utf-8"))
    assert wells(left, "open") == [f"3:{row}1" for row in "DEFGH"]  # D1 was drawn for only
    assert left.tips[3].holds_ul == 100
    made, loaded = planned(out.read_text(encoding="utf-8"))
    assert [one.wells for one in made] == [[f"3:{row}1"] for row in "DEFGH"]
    assert {(*one.sources, one.volume_ul) for one in made} == {("2:A1", 100.0)}
    assert loaded["3:A1"] == 100
    picked = [
        one.well.address
        for one in rehearse(out).log
        if isinstance(one, Operation) and one.kind.value == "pick_up_tip" and one.well
    ]
    assert picked == [*(f"1:{row}1" for row in "FGH"), "1:A2", "1:B2"]  # E1 may be gone
    assert "look first: 3:B1: B1 failed" in out.read_text(encoding="utf-8")
    values: dict[str, Any] = {}
    text = block.read_text(encoding="utf-8")
    exec(text[text.index("VOLUMES_UL") :], values)
    assert len(values["OPEN"]) == 5
    assert values["LOOK"] == [(["2:A1"], ["3:B1"], 100.0)]
    assert "roles={" in text


def test_a_well_to_look_at_can_be_filled_again(tmp_path: Path) -> None:
    stopped(tmp_path, HELLO, {n: "fail" if n == 1 else "pass" for n in range(8)}).close()
    with pytest.raises(NotPlain, match="no delivery is open"):
        finish(tmp_path, HELLO)
    made, loaded = planned(finish(tmp_path, HELLO, again=[1]))
    assert [one.wells for one in made] == [["3:B1"]]
    assert loaded["3:B1"] == 100  # what it holds at most, so that none runs over unseen


def test_a_worklist_is_finished_with_the_tips_that_it_shares(tmp_path: Path) -> None:
    plan, _ = planned(WORKLIST.read_text(encoding="utf-8"))
    stopped(tmp_path, WORKLIST, dict.fromkeys(range(30), "pass")).close()
    made, loaded = planned(finish(tmp_path, WORKLIST))
    assert made == plan[30:]
    red = sum(one.volume_ul or 0 for one in plan[:30] if one.sources == ["2:A1"])
    drawn = plan[30].volume_ul if plan[30].sources == ["2:A1"] else 0
    assert loaded["2:A1"] == 8000 - red - (drawn or 0)


def test_an_interrupted_delivery_and_one_that_was_put_right(tmp_path: Path) -> None:
    store = stopped(tmp_path, HELLO, {0: "fail", 1: "undecided"}, keyframes=2)
    told = RecoveryReport(trajectory=0, attempt=1, action="retry", state="recovered")
    store.add_recovery("r", told, 5.0)
    store.add_decision("r", 1, Decision(outcome=Outcome.PASS, by="Ada"))
    store.close()
    left, _ = rest_in(tmp_path)
    assert wells(left, "done") == ["3:A1", "3:B1"]
    assert wells(left, "look") == ["3:C1"]  # nobody saw whether it was dispensed
    assert len(wells(left, "open")) == 5


@pytest.mark.parametrize(
    ("keyframes", "end", "looked"),
    [
        (0, {"outcome": "succeeded"}, "CDEFGH"),  # resumed without a camera, by design
        (0, {"trajectories": None, "keyframes": None}, "CDEFGH"),  # an older guard, or a person
        (0, {"trajectories": 5, "keyframes": 20}, "CDE"),
        (1, {"trajectories": 3, "keyframes": 11}, "C"),  # the rest of it went unwatched
        (1, {"outcome": "failed"}, ""),
    ],
)
def test_what_nobody_watched_is_never_open(
    tmp_path: Path, keyframes: int, end: dict[str, Any], looked: str
) -> None:
    stopped(tmp_path, HELLO, {0: "pass", 1: "pass"}, keyframes, end).close()
    left, recording = rest_in(tmp_path, HELLO)
    assert wells(left, "look") == [f"3:{row}1" for row in looked]
    assert wells(left, "open") == [f"3:{row}1" for row in "CDEFGH" if row not in looked]
    assert ("while nobody watched" in " ".join(left.warnings)) == bool(looked)
    held = {one.well: (one.least_ul, one.most_ul) for one in left.wells}
    assert all(held[f"3:{row}1"] == (0, 100) for row in looked)
    drawn = 2 + len(looked) + (keyframes and not looked) + (len(looked) < 6)  # and for the next
    assert held["2:A1"] == (-100 * drawn, -200)
    assert recording is not None
    if len(looked) == 6:
        with pytest.raises(NotPlain, match="no delivery is open"):
            finishing_protocol(recording, left)
    else:
        made, _ = planned(finishing_protocol(recording, left))
        assert [well for one in made for well in one.wells] == wells(left, "open")


@pytest.mark.parametrize(("stops_at", "looked"), [(5, "CDE"), (99, "CDEFGH")])
def test_a_live_run_that_goes_on_without_its_camera(
    tmp_path: Path, stops_at: int, looked: str
) -> None:
    camera = StubCamera()

    def run(context: Any) -> None:
        tips = context.load_labware("opentrons_96_tiprack_300ul", 1)
        dye = context.load_labware("nest_12_reservoir_15ml", 2)
        plate = context.load_labware("corning_96_wellplate_360ul_flat", 3)
        p300 = context.load_instrument("p300_single_gen2", "right", tip_racks=[tips])
        for number, well in enumerate(plate.columns()[0]):
            if number == 2:
                camera.failure = CameraError("it was unplugged")
            if number == stops_at:
                raise RuntimeError("the run broke off")
            p300.transfer(100, dye["A1"], well)

    with running_sidecar(SidecarConfig(data=tmp_path), camera, StubAnalyser()) as url:
        policies = dict.fromkeys(("on_link_loss", "on_fail", "on_undecided"), "continue")
        settings = Settings(sidecar=url, run_id="r", capture_timeout_s=0.3, **policies)  # type: ignore[arg-type]
        LiveRun(run, settings).start().join()
    left, _ = rest_in(tmp_path, HELLO)
    assert wells(left, "look")[-len(looked) :] == [f"3:{row}1" for row in looked]
    assert wells(left, "open") == [f"3:{row}1" for row in "FGH" if row not in looked]


def test_a_run_that_never_said_its_end_has_nothing_open(tmp_path: Path) -> None:
    store = stopped(tmp_path, HELLO, {0: "pass"}, ended=False)
    store.abandon("r", 1, "never seen")
    assert wells(rest_in(tmp_path, HELLO)[0], "open") == []
    store.close_silent("r", "nothing said")
    assert wells(rest_in(tmp_path, HELLO)[0], "open") == []
    store.close()


def test_another_protocol_is_not_finished(aegis: Command, tmp_path: Path) -> None:
    data = tmp_path / "data"
    stopped(data, HELLO, {0: "pass", 1: "pass"}).close()
    text = HELLO.read_text(encoding="utf-8")
    for change, why in (
        (("columns()[0]", "columns()[3]"), "another than the protocol's"),
        (("transfer(100", "transfer(90"), "another than the protocol's"),
        (("The smallest", "A small"), None),
    ):
        other = tmp_path / "other.py"
        assert change[0] in text
        other.write_text(text.replace(*change), encoding="utf-8")
        call = ("rest", "r", other, "--data", data, "--write", tmp_path / "out.py")
        refused = aegis(*call)
        assert (refused.code, "it was changed since" in refused.err) == (2, True)
        assert not (tmp_path / "out.py").exists()
        told = aegis(*call, "--changed")
        assert why is None or why in told.err
        assert told.code == (0 if why is None else 1)


def test_a_liquid_that_no_delivery_uses_is_left_out(tmp_path: Path) -> None:
    text = HELLO.read_text(encoding="utf-8")
    more = (
        "    spare = protocol.load_labware('nest_12_reservoir_15ml', '9')\n"
        "    water = protocol.define_liquid('water', '', '#0000ff')\n"
        "    spare['A1'].load_liquid(water, 500)\n"
    )
    protocol = tmp_path / "spare.py"
    protocol.write_text(text + more, encoding="utf-8")
    stopped(tmp_path, protocol, {0: "pass"}).close()
    made, loaded = planned(finish(tmp_path, protocol))
    assert (len(made), "9:A1" in loaded) == (7, False)


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("p300.flow_rate.aspirate = 20", "sets flow rates"),
        ("p300.transfer(50, dye['A1'], plate['A12'], blow_out=True)", "does more with a tip"),
        ("p300.transfer(50, dye['A1'], plate['A12'], mix_after=(2, 50))", "does more with a tip"),
        ("protocol.pause('look')", "pauses"),
        ("protocol.load_labware('nest_12_reservoir_15ml', 9, version=1)", "names a version"),
        ("protocol.load_labware('nest_12_reservoir_15ml', 9, 'x', 'opentrons')", "by more than"),
        ("p300.pick_up_tip(); p300.aspirate(50, dye['A1'], 0.2)", "sets flow rates"),
        ("p300.distribute(20, dye['A1'], plate.columns()[5])", "does more with a tip|in parts"),
    ],
)
def test_what_a_record_does_not_hold_is_not_left_out(tmp_path: Path, said: str, why: str) -> None:
    protocol = tmp_path / "more.py"
    protocol.write_text(HELLO.read_text(encoding="utf-8") + f"    {said}\n", encoding="utf-8")
    stopped(tmp_path, protocol, {0: "pass"}).close()
    with pytest.raises(NotPlain, match=why):
        finish(tmp_path, protocol)


def test_used_up_racks_need_fresh_tips(tmp_path: Path) -> None:
    protocol = tmp_path / "full.py"
    text = HELLO.read_text(encoding="utf-8").replace("plate.columns()[0]", "plate.wells()")
    protocol.write_text(text, encoding="utf-8")
    stopped(tmp_path, protocol, {n: "fail" if n < 2 else "pass" for n in range(96)}).close()
    with pytest.raises(NotPlain, match="--fresh-tips"):
        finish(tmp_path, protocol, again=[0])
    assert "pick_up_tip(labware_2['A1'])" in finish(tmp_path, protocol, again=[0], fresh=True)


def test_a_run_that_goes_on_and_another_protocol_are_told_of(tmp_path: Path) -> None:
    stopped(tmp_path, HELLO, {0: "pass"}, ended=False).close()
    other = tmp_path / "other.py"
    text = HELLO.read_text(encoding="utf-8").replace("plate.columns()[0]", "plate.columns()[3]")
    other.write_text(text, encoding="utf-8")
    warnings = " ".join(rest_in(tmp_path, other)[0].warnings)
    assert "has not ended" in warnings
    assert "not the protocol of this run" in warnings


def test_wrong_calls(aegis: Command, tmp_path: Path) -> None:
    Store(tmp_path / "empty").close()
    assert "holds no run yet" in aegis("rest", "--data", tmp_path / "empty").err
    stopped(tmp_path / "data", HELLO, {0: "pass"}).close()
    data = ("--data", tmp_path / "data")
    assert "holds no run 'zebra'" in aegis("rest", "zebra", *data).err
    assert "needs the run's protocol" in aegis("rest", "r", *data, "--write", tmp_path / "x.py").err
    copy = tmp_path / "copy.py"
    copy.write_text("def run(protocol:\n", encoding="utf-8")
    refused = aegis("rest", "r", copy, *data, "--write", copy)
    assert (refused.code, "the run's own protocol" in refused.err) == (2, True)
    for path in (tmp_path / "nowhere.py", copy):
        broken = aegis("rest", "r", path, *data)
        assert (broken.code, "Traceback" in broken.err) == (2, False)
