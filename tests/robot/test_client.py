"""The client against Opentrons' engine behind the shapes of its robot server."""

from __future__ import annotations

import time
from pathlib import Path
from urllib.parse import unquote

import httpx
import pytest

from aegis_ot.errors import ConfigurationError, RobotError, RobotRefused, RobotUnreachable
from aegis_ot.robot import RobotClient
from aegis_ot.robot.address import robot_url
from aegis_ot.robot.clocks import RobotClock
from aegis_ot.robot.following import Completed, Found, Lost, Started, StatusChanged, follow

from ..support.robot_server import RobotServer
from .protocols import BAD, GOOD, PAUSES, WAITS


def uploaded(client: RobotClient, folder: Path, text: str) -> str:
    path = folder / "protocol.py"
    path.write_text(text, encoding="utf-8")
    return client.upload(path)[0]


@pytest.mark.parametrize(
    ("typed", "url"),
    [
        ("192.168.1.7", "http://192.168.1.7:31950"),
        (" robot.local:8080 ", "http://robot.local:8080"),
        ("http://robot/", "http://robot:31950"),
        ("https://robot", "https://robot:32313"),
        ("fe80::1", "http://[fe80::1]:31950"),
        ("[fe80::1]:99", "http://[fe80::1]:99"),
    ],
)
def test_an_address_is_what_a_person_types(typed: str, url: str) -> None:
    assert robot_url(typed) == url


@pytest.mark.parametrize("typed", ["", "http://", "my robot", "robot:port", "ftp://robot", "a/b"])
def test_what_is_no_address_is_refused_with_its_text(typed: str) -> None:
    with pytest.raises(ConfigurationError, match="as the Opentrons App shows it"):
        robot_url(typed)


def test_a_good_protocol_is_analysed_and_runs_to_its_end(
    client: RobotClient, tmp_path: Path
) -> None:
    protocol = uploaded(client, tmp_path, GOOD)
    analysis = client.analysis(protocol, 30)
    assert (analysis.ok, analysis.errors) == (True, ())
    assert analysis.kinds[:2] == ("home", "loadLabware")
    run = client.create_run(protocol)
    assert client.current_run() == run
    client.act(run, "play")
    steps = list(follow(client, run, poll_s=0.02))
    done = [step.command for step in steps if isinstance(step, Completed)]
    assert tuple(command.kind for command in done) == analysis.kinds
    assert [command.index for command in done] == list(range(len(done)))
    assert all(c.started and c.completed and c.started <= c.completed for c in done)
    assert sum(isinstance(step, Started) for step in steps) == len(done)
    loaded = next(command for command in done if command.kind == "loadLabware")
    assert "labwareId" in client.result(run, loaded.id)
    last = steps[-1]
    assert isinstance(last, StatusChanged)
    assert last.run.status == "succeeded"
    assert [pipette.name for pipette in last.run.pipettes] == ["p300_single_gen2"]


def test_an_analysis_tells_the_protocols_own_error(client: RobotClient, tmp_path: Path) -> None:
    analysis = client.analysis(uploaded(client, tmp_path, BAD), 30)
    assert not analysis.ok
    assert "ValueError [line 5]: no such thing" in analysis.errors[0]


def test_the_same_file_keeps_its_analysis_until_another_is_asked_for(
    client: RobotClient, tmp_path: Path
) -> None:
    first = client.analysis(uploaded(client, tmp_path, GOOD), 30)
    protocol = uploaded(client, tmp_path, GOOD)
    assert client.analysis(protocol, 30).id == first.id
    client.analyse_again(protocol)
    assert client.analysis(protocol, 30).id != first.id


def test_what_the_server_refuses_is_told_in_its_words(client: RobotClient, tmp_path: Path) -> None:
    with pytest.raises(RobotRefused, match="never closed"):
        uploaded(client, tmp_path, "def run(")
    with pytest.raises(RobotRefused, match="not found") as refusal:
        client.create_run("nothing")
    assert refusal.value.status == 404


def test_a_second_run_while_one_waits_is_refused(client: RobotClient, tmp_path: Path) -> None:
    protocol = uploaded(client, tmp_path, PAUSES)
    run = client.create_run(protocol)
    client.act(run, "play")
    for step in follow(client, run, poll_s=0.02):
        if isinstance(step, StatusChanged) and step.run.status == "paused":
            with pytest.raises(RobotRefused, match="not idle"):
                client.create_run(protocol)
            client.act(run, "play")
    with pytest.raises(RobotRefused, match="already stopped"):
        client.act(run, "pause")


def test_a_run_is_stopped(client: RobotClient, tmp_path: Path) -> None:
    run = client.create_run(uploaded(client, tmp_path, WAITS))
    client.act(run, "play")
    seen = []
    for step in follow(client, run, poll_s=0.02):
        if isinstance(step, Started) and step.command.kind == "waitForDuration":
            if not seen:
                client.act(run, "stop")
            seen.append(step)
    assert client.run(run).status == "stopped"


def test_a_connection_that_comes_back_misses_no_command(
    robot: RobotServer, client: RobotClient, tmp_path: Path
) -> None:
    away = {"for": 0}

    def cut(request: httpx.Request) -> httpx.Response:
        if away["for"] > 0:
            away["for"] -= 1
            raise httpx.ConnectError("cut", request=request)
        return real.handle_request(request)

    real = httpx.HTTPTransport()
    protocol = uploaded(client, tmp_path, GOOD)
    kinds = client.analysis(protocol, 30).kinds
    run = client.create_run(protocol)
    done, lost, found = [], 0, 0
    with RobotClient(robot.url, transport=httpx.MockTransport(cut)) as shaky:
        for step in follow(shaky, run, poll_s=0.02):
            if isinstance(step, StatusChanged) and step.run.status == "idle":
                client.act(run, "play")
                away["for"] = 5
            if isinstance(step, Completed):
                done.append(step.command.kind)
            lost += isinstance(step, Lost)
            found += isinstance(step, Found)
    assert tuple(done) == kinds
    assert (lost, found) == (1, 1)


def test_a_robot_that_stays_away_is_given_up(robot: RobotServer) -> None:
    def cut(request: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("cut", request=request)

    with (
        RobotClient(robot.url, transport=httpx.MockTransport(cut)) as client,
        pytest.raises(RobotUnreachable, match="Given up"),
    ):
        list(follow(client, "run", poll_s=0.01, patience_s=0.05))


def test_what_is_no_robot_is_told_so() -> None:
    transport = httpx.MockTransport(lambda _: httpx.Response(200, text="<html>"))
    with (
        RobotClient("router", transport=transport) as client,
        pytest.raises(RobotError, match="no robot"),
    ):
        client.health()


def test_the_clock_difference_is_told_to_the_millisecond(
    robot: RobotServer, client: RobotClient
) -> None:
    robot.clock_offset_s = 3600.0
    clock = RobotClock(client.clock)
    clock.look()
    assert is_exact(clock, 3600.0)
    assert clock.jumps == 0
    robot.clock_offset_s = -5.0
    clock.look()
    assert clock.jumps == 1
    assert is_exact(clock, -5.0)


def is_exact(clock: RobotClock, ahead_s: float) -> bool:
    """As exact as it says it is: half of the question's round trip, and a millisecond."""
    doubt_s = clock.round_trip_s / 2 + 0.001
    before, told, after = time.monotonic(), time.time() + ahead_s, time.monotonic()
    return before - doubt_s <= clock.local(told) <= after + doubt_s


def test_without_system_time_the_date_of_an_answer_serves(robot: RobotServer) -> None:
    real = httpx.HTTPTransport()

    def old(request: httpx.Request) -> httpx.Response:
        if request.url.path == "/system/time":
            return httpx.Response(404, json={"errors": [{"title": "Not Found"}]})
        return real.handle_request(request)

    with RobotClient(robot.url, transport=httpx.MockTransport(old)) as client:
        before = time.time()
        told = client.clock()
        # On a busy machine the server's Date is some ticks old.
        assert before - 20.0 <= told <= time.time() + 0.6


@pytest.mark.parametrize(
    ("status", "said"),
    [
        (401, "AEGIS_OT_ROBOT_TOKEN"),
        (403, "does not allow this"),
        (409, "another one has not"),
        (451, "wants a reason for this .POST /runs.. Give it as AEGIS_OT_ROBOT_REASON"),
    ],
)
def test_a_robot_that_lets_nobody_in_says_what_to_do(
    status: int, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AEGIS_OT_ROBOT_TOKEN", "s3cret")
    answer = httpx.Response(status, json={"errors": [{"detail": "no scope runs.write"}]})
    transport = httpx.MockTransport(lambda request: answer)
    with RobotClient("robot", transport) as it, pytest.raises(RobotRefused, match=said) as refused:
        it.create_run("protocol")
    assert "no scope runs.write" in str(refused.value)
    assert refused.value.status == status
    if status == 403:
        monkeypatch.delenv("AEGIS_OT_ROBOT_TOKEN")
        with (
            RobotClient("robot", transport) as it,
            pytest.raises(RobotRefused, match="ROBOT_TOKEN"),
        ):
            it.create_run("protocol")


def test_the_robots_token_goes_to_it_and_into_no_message(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv("AEGIS_OT_ROBOT_TOKEN", "s3cret")
    seen: list[str] = []

    def answer(request: httpx.Request) -> httpx.Response:
        seen.append(request.headers.get("authorization", ""))
        return httpx.Response(403, json={})

    caplog.set_level("DEBUG")
    transport = httpx.MockTransport(answer)
    with RobotClient("robot", transport) as it, pytest.raises(RobotRefused) as refused:
        it.health()
    assert seen == ["Bearer s3cret"]
    assert "s3cret" not in str(refused.value) + caplog.text


def test_a_robot_that_wants_a_reason_gets_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_ROBOT_TOKEN", "s3cret")
    seen: list[str] = []

    def answer(request: httpx.Request) -> httpx.Response:
        seen.append(request.headers.get("opentrons-user-notes", ""))
        return httpx.Response(
            422, json={"errors": [{"detail": "Opentrons-User-Notes is required"}]}
        )

    for reason in ("", "Charge 7, Müller"):
        monkeypatch.setenv("AEGIS_OT_ROBOT_REASON", reason)
        client = RobotClient("robot", httpx.MockTransport(answer))
        with client, pytest.raises(RobotRefused, match="wants a reason"):
            client.act("run", "play")
    assert [unquote(one) for one in seen] == ["aegis-ot guards this run", "Charge 7, Müller"]
    assert all(one.isascii() for one in seen)
    monkeypatch.delenv("AEGIS_OT_ROBOT_TOKEN")
    with RobotClient("robot", httpx.MockTransport(answer)) as it, pytest.raises(RobotRefused):
        it.act("run", "play")
    assert seen[-1] == ""
