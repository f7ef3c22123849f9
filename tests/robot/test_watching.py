"""Watch mode against Opentrons' engine and a real sidecar."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import httpx
import pytest

from aegis_ot.errors import SidecarUnreachable
from aegis_ot.robot import Analysis, RobotClient, watching
from aegis_ot.robot.keyframe_times import PastLink, moment_of_transit
from aegis_ot.robot.run_report import run_report
from aegis_ot.robot.running import RobotRun
from aegis_ot.robot.server_answers import Command as RobotCommand
from aegis_ot.robot.verdicts import VerdictReader, WellVerdict
from aegis_ot.robot.watching import LOSSES, WatchPolicies, await_run, watch_run
from aegis_ot.run_view.situation import Situation, situations
from aegis_ot.runtime.sidecar_client import Acknowledgement
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.analysis import Judged
from aegis_ot.vocabulary import Keyframe, Outcome, Verdict
from aegis_ot.vocabulary.pipette_names import channels_of, largest_volume

from ..cli.commands import Command
from ..sidecar.helpers import Robot, StubAnalyser, StubCamera, StubRun
from ..support.robot_server import RobotServer

SLOW = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "my plate")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    dye = protocol.define_liquid("dye", "red", "#ff0000")
    plate["A1"].load_liquid(dye, 300)
    for target in ("A2", "B2", "C2", "D2"):
        pipette.transfer(50, plate["A1"], plate[target])
        protocol.delay(0.5)
"""


class Shown:
    """What a run shows, written down; ``wants`` is what the person asks, by what is shown."""

    def __init__(self) -> None:
        self.said: list[str] = []
        self.verdicts: list[WellVerdict] = []
        self.waited: list[str] = []
        self.wants: dict[str, str] = {}

    def analysing(self, seconds: float) -> None: ...

    def began(self, commands: int | None) -> None: ...

    def doing(self, command: RobotCommand) -> None: ...

    def done(self, command: RobotCommand) -> None: ...

    def says(self, text: str) -> None:
        self.said.append(text)

    def waits(self, text: str, recovery: bool = False) -> None:
        self.waited.append(text)

    def judged(self, verdict: WellVerdict) -> None:
        self.verdicts.append(verdict)

    def asked(self) -> str:
        for word, key in list(self.wants.items()):
            if any(word in text for text in (*self.said, *self.waited)):
                del self.wants[word]
                return key
        return ""


class LosingLink(PastLink):
    """To a sidecar that is gone from the seventh keyframe on."""

    gone = False

    def keyframe(self, keyframe: Keyframe, timeout_s: float, ago_s: float = 0.0) -> Acknowledgement:
        self.gone = self.gone or keyframe.sequence == 6
        self._must_be_there()
        return super().keyframe(keyframe, timeout_s, ago_s)

    def health(self, timeout_s: float) -> dict[str, Any]:
        self._must_be_there()
        return super().health(timeout_s)

    def verdict(self, run: str, number: int, wait_s: float, timeout_s: float) -> Verdict | None:
        self._must_be_there()
        return super().verdict(run, number, wait_s, timeout_s)

    def _must_be_there(self) -> None:
        if self.gone:
            raise SidecarUnreachable("The sidecar is gone.")


@contextmanager
def sidecar(folder: Path, *fails: int) -> Iterator[str]:
    config = SidecarConfig(port=0, data=folder / "sidecar")
    with running_sidecar(config, StubCamera(), StubAnalyser(fails)) as url:
        yield url


def begin(client: RobotClient, folder: Path, text: str = SLOW) -> RobotRun:
    path = folder / "slow.py"
    path.write_text(text, encoding="utf-8")
    run = client.create_run(client.upload(path)[0])
    client.act(run, "play")
    assert await_run(client) == run
    name = client.protocol_name(run)
    return RobotRun(name, "test-robot", client.url, run, Analysis("", done=False))


def test_an_unguarded_run_is_watched_to_its_end(client: RobotClient, tmp_path: Path) -> None:
    shown = Shown()
    with sidecar(tmp_path) as url:
        run = watch_run(client, begin(client, tmp_path), PastLink(url, None), shown, poll_s=0.05)
        with Robot(url, f"watch-{run.id}") as reader:
            seen = reader.overview()
    assert shown.said == [LOSSES]
    assert (run.status, run.protocol, run.pauses) == ("succeeded", "slow.py", [])
    assert [v.verdict.outcome for v in run.verdicts.values()] == [Outcome.PASS] * 4
    assert seen["finished"]["outcome"] == "succeeded"
    wells = [trajectory["well"] for trajectory in seen["trajectories"]]
    assert wells == [f"{well} of my plate (slot 2)" for well in ("A2", "B2", "C2", "D2")]
    frames = [k for t in seen["trajectories"] for k in t["keyframes"]]
    assert [f["kind"] for f in frames] == ["aspirate", "transit", "dispense", "post_dispense"] * 4
    assert {f["reagent"] for f in frames} == {"dye"}
    assert [f["expected_ul"] for f in frames[:4]] == [50, 50, 0, 0]
    assert {f["capacity_ul"] for f in frames} == {300}
    assert not any(f["late"] for f in frames[4:])


def test_a_run_that_is_watched_a_second_time_is_kept_apart(
    client: RobotClient, tmp_path: Path
) -> None:
    shown = Shown()
    with sidecar(tmp_path) as url:
        view = begin(client, tmp_path)
        PastLink(url, None).start(f"watch-{view.id}", {"mode": "watch", "started": 1.5}, 2.0)
        run = watch_run(client, view, PastLink(url, None), shown, poll_s=0.05)
        with Robot(url, run.watched_as) as reader:
            seen = reader.overview()
    assert run.watched_as == f"watch-{view.id}-2"
    assert any("This run was watched before" in said for said in shown.said)
    assert len(seen["trajectories"]) == len(run.verdicts) == 4


def test_a_failed_delivery_pauses_the_robot_by_its_api(client: RobotClient, tmp_path: Path) -> None:
    shown = Shown()
    shown.wants["The watch paused"] = "play"
    with sidecar(tmp_path, 1) as url:
        run = watch_run(client, begin(client, tmp_path), PastLink(url, None), shown, poll_s=0.05)
    assert run.status == "succeeded"
    assert any("Paused by the watch: B2 of my plate (slot 2) failed" in said for said in shown.said)
    assert run.pauses == ["The watch paused the run: B2 of my plate (slot 2) failed."]
    assert run.verdicts[1].verdict.outcome is Outcome.FAIL


def test_a_pause_of_the_watch_is_answered_on_the_page(client: RobotClient, tmp_path: Path) -> None:
    shown = Shown()
    with sidecar(tmp_path, 1) as url:
        run = begin(client, tmp_path)
        with Robot(url, f"watch-{run.id}") as page:

            def answer() -> None:
                while not any("Paused by the watch" in said for said in shown.said):
                    time.sleep(0.05)
                until = time.monotonic() + 60
                while time.monotonic() < until:
                    found = situations(page.overview(), time.time())
                    if [one.kind for one in found] == ["paused"]:
                        break
                    time.sleep(0.05)
                asked.extend(found)
                page.post("trajectories/1/action", {"action": "resume", "by": "Ada"})

            asked: list[Situation] = []
            somebody = threading.Thread(target=answer)
            somebody.start()
            watch_run(client, run, PastLink(url, None), shown, poll_s=0.05)
            somebody.join()
            hold = page.overview()["trajectories"][1]["holds"][-1]
    assert run.status == "succeeded"
    assert [(one.kind, one.trajectory) for one in asked] == [("paused", 1)]
    assert hold["answered"] == "page"
    assert hold["paused_s"] > 0


def test_a_run_cancelled_by_somebody_else_ends_the_watch(
    client: RobotClient, robot: RobotServer, tmp_path: Path
) -> None:
    shown = Shown()
    with sidecar(tmp_path) as url:
        run = begin(client, tmp_path)

        def cancel() -> None:
            with RobotClient(robot.url) as other:
                while not shown.verdicts:
                    time.sleep(0.05)
                other.act(run.id, "stop")

        somebody = threading.Thread(target=cancel)
        somebody.start()
        watch_run(client, run, PastLink(url, None), shown, poll_s=0.05)
        somebody.join()
        with Robot(url, f"watch-{run.id}") as reader:
            assert reader.overview()["finished"]["outcome"] == "stopped"
    assert run.status == "stopped"


def test_a_robot_whose_clock_is_set_during_the_run_gives_no_wrong_frames(
    client: RobotClient, robot: RobotServer, tmp_path: Path
) -> None:
    shown = Shown()
    with sidecar(tmp_path) as url:
        run = begin(client, tmp_path)

        def jump() -> None:
            while not shown.verdicts:
                time.sleep(0.02)
            robot.clock_offset_s = 4000.0

        clockmaker = threading.Thread(target=jump)
        clockmaker.start()
        watch_run(client, run, PastLink(url, None), shown, poll_s=0.05)
        clockmaker.join()
        with Robot(url, f"watch-{run.id}") as reader:
            seen = reader.overview()
    assert any("clock was set" in said for said in shown.said)
    last = seen["trajectories"][-1]["keyframes"]
    assert not any(frame["late"] for frame in last)
    assert all(frame["exposed_after_s"] < 1 for frame in last)


def test_a_lost_sidecar_pauses_once_and_the_watch_goes_on(
    client: RobotClient, tmp_path: Path
) -> None:
    shown = Shown()
    shown.wants["The watch paused"] = "play"
    with sidecar(tmp_path) as url:
        link = LosingLink(url, None)
        run = begin(client, tmp_path)
        watch_run(client, run, link, shown, WatchPolicies(capture_timeout_s=0.3), poll_s=0.05)
    assert run.status == "succeeded"
    assert sum("Paused by the watch: the sidecar is away" in said for said in shown.said) == 1


def test_a_robot_that_is_away_is_waited_for() -> None:
    idle = httpx.Response(200, json={"data": [], "links": {}})
    begun = httpx.Response(200, json={"data": [], "links": {"current": {"href": "/runs/one"}}})
    running = httpx.Response(200, json={"data": {"id": "one", "status": "running"}})
    starting = httpx.Response(503, json={"errors": [{"detail": "The server starts."}]})
    answers = iter((idle, None, None, starting, idle, begun, running))

    def answer(request: httpx.Request) -> httpx.Response:
        found = next(answers)
        if found is None:
            raise httpx.ConnectError("refused", request=request)
        return found

    said: list[str] = []
    with RobotClient("robot", httpx.MockTransport(answer)) as robot:
        assert await_run(robot, lambda seconds: None, said.append) == "one"
    (words,) = said
    assert "cannot be reached" in words


def test_a_run_driven_by_single_commands_is_said_not_to_be_watched() -> None:
    current = {"data": [], "links": {"current": {"href": "/runs/one"}}}
    driven = {"data": {"id": "one", "status": "idle"}}
    commands = {"data": [], "meta": {"cursor": 0, "totalLength": 3}}
    begun = {"data": {"id": "one", "status": "running", "protocolId": "p"}}
    looks = iter((driven, driven, begun))

    def answer(request: httpx.Request) -> httpx.Response:
        if request.url.path == "/runs":
            return httpx.Response(200, json=current)
        if request.url.path.endswith("/commands"):
            return httpx.Response(200, json=commands)
        return httpx.Response(200, json=next(looks))

    said: list[str] = []
    with RobotClient("robot", httpx.MockTransport(answer)) as robot:
        assert await_run(robot, lambda seconds: None, said.append) == "one"
    assert said == [watching.DRIVEN.format("one")]


class Slow(StubAnalyser):
    """Judges the last delivery when it may."""

    def __init__(self, fails: Sequence[int] = ()) -> None:
        super().__init__(fails)
        self.last = threading.Event()

    def begin(self, run: str, history: Any = ()) -> StubRun:
        return SlowRun(self, run)


class SlowRun(StubRun):
    def judge(self, trajectory: int) -> Judged:
        if trajectory == 3:
            assert isinstance(self.analyser, Slow)
            assert self.analyser.last.wait(60)
        return super().judge(trajectory)


def test_the_last_verdict_is_waited_for_however_long_the_sidecar_works(
    client: RobotClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(watching, "WAIT_SHOWN_S", 0.2)
    shown, analyser = Shown(), Slow([3])
    config = SidecarConfig(port=0, data=tmp_path / "sidecar")
    said = shown.says

    def says(text: str) -> None:
        said(text)
        if text == "Waiting for the verdict on D2 of my plate (slot 2).":
            analyser.last.set()

    monkeypatch.setattr(shown, "says", says)
    with running_sidecar(config, StubCamera(), analyser) as url:
        run = begin(client, tmp_path)
        reader = VerdictReader(url, None)
        watch_run(client, run, PastLink(url, None), shown, verdicts=reader, poll_s=0.05)
        reader.close()
    assert run.status == "succeeded"
    assert [v.state for v in run.verdicts.values()] == ["pass"] * 3 + ["fail"]
    report = run_report(run)
    assert report["sidecar"]["counts"] == {"pass": 3, "fail": 1, "wells": 4, "deliveries": 4}


def test_a_verdict_that_never_comes_leaves_its_well_undecided(
    client: RobotClient, robot: RobotServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:  # fmt: skip
    monkeypatch.setattr(watching, "LAST_VERDICTS_S", 0.5)
    analyser = Slow()
    config = SidecarConfig(port=0, data=tmp_path / "sidecar")
    with running_sidecar(config, StubCamera(), analyser) as url:
        begin(client, tmp_path)
        done = Command(capfdbinary)("watch", "--robot", robot.url, "--sidecar", url)
        analyser.last.set()
    assert done.code == 1, done.out + done.err
    assert "4 deliveries: 3 pass, 1 undecided" in done.out
    assert "D2 of my plate (slot 2): undecided: No verdict on it came." in done.out


def test_a_run_with_a_guard_is_told_so(client: RobotClient, tmp_path: Path) -> None:
    shown = Shown()
    text = SLOW.replace("tips =", 'protocol.comment("aegis_ot: hello")\n    tips =')
    with sidecar(tmp_path) as url:
        watch_run(client, begin(client, tmp_path, text), PastLink(url, None), shown, poll_s=0.05)
    assert any("carries a guard of its own" in said for said in shown.said)


def test_the_command_waits_for_a_run_and_reports_it(
    client: RobotClient, robot: RobotServer, tmp_path: Path,
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:  # fmt: skip
    report = tmp_path / "report.json"
    with sidecar(tmp_path) as url:
        later = threading.Timer(1.0, begin, (client, tmp_path))
        later.start()
        done = Command(capfdbinary)(
            "watch", "--robot", robot.url, "--sidecar", url, "--report", report
        )
        later.join()
    assert done.code == 0, done.out + done.err
    assert "4 deliveries: 4 pass" in done.out
    told = json.loads(report.read_text(encoding="utf-8"))
    assert (told["protocol"], told["status"]) == ("slow.py", "succeeded")
    assert told["sidecar"]["counts"]["wells"] == 4


def test_without_a_sidecar_there_is_nothing_to_watch_with(
    robot: RobotServer, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    aegis = Command(capfdbinary)
    assert "needs a sidecar" in aegis("watch", "--robot", robot.url).err
    gone = aegis("watch", "--robot", robot.url, "--sidecar", "http://127.0.0.1:9")
    assert (gone.code, "cannot be reached" in gone.err) == (2, True)


def test_transit_lies_before_the_plunger_moves() -> None:
    params = {"volume": 100.0, "flowRate": 50.0}
    assert moment_of_transit(RobotCommand(0, "dispense", "succeeded", params, 10.0, 15.0)) == 12.8
    # Within the command, however short it was.
    assert moment_of_transit(RobotCommand(0, "dispense", "succeeded", params, 14.0, 15.0)) == 14.0


@pytest.mark.parametrize(
    ("name", "channels", "volume"),
    [("p300_multi_gen2", 8, 300), ("flex_1channel_50", 1, 50), ("p1000_96", 96, 1000),
     ("flex_96channel_1000", 96, 1000), ("p20_single_gen2", 1, 20)],
)  # fmt: skip
def test_a_pipettes_name_says_its_size(name: str, channels: int, volume: float) -> None:
    assert (channels_of(name), largest_volume(name)) == (channels, volume)


class FlexRun:
    """A Flex's run as its server tells it, a look at a time; pictures of what was observed."""

    def __init__(self, looks: list[tuple[str, list[dict[str, Any]]]]) -> None:
        self._looks = looks
        self._done: list[dict[str, Any]] = []

    def __call__(self, request: httpx.Request) -> httpx.Response:
        now = datetime.now(timezone.utc).isoformat()
        path = request.url.path
        if path == "/system/time":
            return _told({"systemTime": now})
        if path == "/runs/r":
            pipettes = [{"id": "p", "pipetteName": "flex_1channel_1000", "mount": "left"}]
            labware = [
                {
                    "id": name,
                    "loadName": name,
                    "definitionUri": name,
                    "location": {"slotName": slot},
                }
                for name, slot in (("rack", "B2"), ("reservoir", "C1"), ("plate", "C2"))
            ]
            status = self._looks[0][0] if self._looks else "succeeded"
            return _told({"id": "r", "status": status, "pipettes": pipettes, "labware": labware})
        if path == "/runs/r/commands":
            if self._looks:
                times = {"startedAt": now, "completedAt": now}
                self._done += [command | times for command in self._looks.pop(0)[1]]
            cursor = int(request.url.params["cursor"])
            meta = {"cursor": cursor, "totalLength": len(self._done)}
            return httpx.Response(200, json={"data": self._done[cursor:], "meta": meta})
        if path.startswith("/runs/r/commands/"):
            return _told({"result": {"position": {"x": 0, "y": 0, "z": 0}}})  # no liquid found
        return httpx.Response(404, json={"errors": [{"detail": "not here"}]})


def _told(data: dict[str, Any]) -> httpx.Response:
    return httpx.Response(200, json={"data": data})


def _did(kind: str, place: str, error: str = "") -> dict[str, Any]:
    labware, well = place.split(":")
    inside = {"origin": "bottom", "offset": {"z": 1.0}}
    params = {"pipetteId": "p", "labwareId": labware, "wellName": well, "volume": 50.0}
    status = (
        {"status": "failed", "error": {"errorType": error}} if error else {"status": "succeeded"}
    )
    return {"id": "c", "commandType": kind, "params": params | {"wellLocation": inside}} | status


def test_what_a_flexs_sensor_found_is_watched_too(tmp_path: Path) -> None:
    def delivery(well: str) -> list[dict[str, Any]]:
        done = [_did("aspirate", "reservoir:A1"), _did("dispense", f"plate:{well}")]
        return [*done, _did("dropTip", "rack:A1")]

    tip, missing = (
        _did("pickUpTip", "rack:A1"),
        _did("liquidProbe", "reservoir:A1", "liquidNotFound"),
    )
    looks = [
        ("running", [tip, _did("liquidProbe", "reservoir:A1"), *delivery("A1")]),
        ("running", [tip, _did("tryLiquidProbe", "reservoir:A1"), *delivery("B1")]),
        ("running", [tip, missing, *delivery("C1")]),  # as if told to ignore this kind of error
        ("running", [tip, missing]),
        ("awaiting-recovery", []),
        ("running", delivery("D1")),
    ]
    transport = httpx.MockTransport(FlexRun(looks))
    view = RobotRun("flex.py", "flex", "http://127.0.0.1", "r", Analysis("", done=False))
    with sidecar(tmp_path) as url, RobotClient("127.0.0.1", transport) as client:
        watch_run(client, view, PastLink(url, None), Shown(), poll_s=0.01)
        with Robot(url, "watch-r") as reader:
            seen = reader.overview()["trajectories"]
    said = [{frame.get("liquid_found") for frame in one["keyframes"]} for one in seen]
    assert said == [{True}, {False}, {False}, {None}]
