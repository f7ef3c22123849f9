"""The link against a real server on loopback that is absent, late, wrong, or dying."""

from __future__ import annotations

import itertools
import math
import os
import selectors
import socket
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from aegis_ot.errors import LinkError, SidecarGarbled, SidecarRefused, SidecarUnreachable
from aegis_ot.http_client import HttpClient, interruptible_socket
from aegis_ot.runtime.sidecar_client import CameraSilent, RunUnknown, SequenceGap, SidecarClient
from aegis_ot.vocabulary import Keyframe, KeyframeKind, Outcome, WellRef

from .fake_sidecar import FakeSidecar, Handler, free_port, once


class Stop(Exception):
    pass


def keyframe(sequence: int = 0, trajectory: int = 0) -> Keyframe:
    well = WellRef("plate", "A1", "my plate", "2")
    return Keyframe(
        "run", sequence, trajectory, list(KeyframeKind)[sequence % 4], "p300_single_gen2", "left",
        1, "1:A1", (well,), (), 50.0, 50.0, 300.0,
    )  # fmt: skip


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


@pytest.fixture
def link(sidecar: FakeSidecar) -> Iterator[SidecarClient]:
    made = SidecarClient(sidecar.url, None, lambda: None)
    yield made
    made.close()


def test_a_whole_conversation_on_one_connection(sidecar: FakeSidecar, link: SidecarClient) -> None:
    assert link.health(1.0)["name"] == "aegis-ot"
    link.start("run", {"run": "run"}, 1.0)
    for n in range(4):
        assert link.keyframe(keyframe(n), 1.0).sequence == n
    verdict = link.verdict("run", 0, 0.15, 1.0)
    assert verdict is not None
    assert verdict.outcome is Outcome.PASS
    link.report("run", "trajectories/1/abandon", {"reason": "dropped"}, 1.0)
    link.finish("run", "succeeded", "", 1.0)
    assert sidecar.abandoned == [1]
    assert sidecar.finished == [{"outcome": "succeeded", "detail": ""}]
    assert len(sidecar.connections) == 1
    assert sidecar.stored()[0]["sources"][0]["name"] == "A1"


def test_small_requests_are_not_held_back(
    sidecar: FakeSidecar, link: SidecarClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[socket.socket] = []
    real = socket.socket

    def noted(*arguments: Any, **more: Any) -> socket.socket:
        made.append(real(*arguments, **more))
        return made[-1]

    monkeypatch.setattr(interruptible_socket.socket, "socket", noted)
    link.health(1.0)
    # Else 40 ms each: Nagle and delayed ACK.
    assert made[0].getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


def test_absent() -> None:
    port = free_port()
    link = SidecarClient(f"http://127.0.0.1:{port}", None, lambda: None)
    with pytest.raises(SidecarUnreachable, match=rf"127\.0\.0\.1:{port}.*refused.*Check that"):
        link.health(1.0)


def test_unknown_host() -> None:
    link = SidecarClient("http://no-such-host.invalid:7645", None, lambda: None)
    with pytest.raises(SidecarUnreachable, match=r"no-such-host\.invalid"):
        link.health(5.0)


@pytest.mark.parametrize("host", ["a..b", "x" * 70])
def test_a_host_that_is_no_name(host: str) -> None:
    link = SidecarClient(f"http://{host}:7645", None, lambda: None)
    with pytest.raises(SidecarUnreachable, match="no host name"):
        link.health(5.0)


def test_a_process_with_many_open_files(sidecar: FakeSidecar) -> None:
    resource = pytest.importorskip("resource")
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    if limits[1] < 1400:
        pytest.skip("this machine allows too few open files")
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(limits[0], 1400), limits[1]))
    held = [os.open(os.devnull, os.O_RDONLY) for _ in range(1100)]
    try:
        link = SidecarClient(sidecar.url, None, lambda: None)
        assert link.health(2.0)["name"] == "aegis-ot"
        link.close()
    finally:
        for number in held:
            os.close(number)
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)


def test_token() -> None:
    with FakeSidecar(token="secret") as sidecar:
        good = SidecarClient(sidecar.url, "secret", lambda: None)
        good.start("run", {}, 1.0)
        good.close()
        bad = SidecarClient(sidecar.url, "wrong", lambda: None)
        with pytest.raises(SidecarRefused, match=r"token.*AEGIS_OT_TOKEN") as caught:
            bad.start("run", {}, 1.0)
        assert "wrong" not in str(caught.value).replace("Wrong token", "")
        assert bad.health(1.0)["wire"] == 1
        bad.close()


GARBAGE = {
    "no http": b"SSH-2.0-OpenSSH_9.6\r\n",
    "no json": b"HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\nhello",
    "a list": b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\n[]",
    "broken json": b'HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\n{"wire": ',
    "bytes": b"HTTP/1.1 200 OK\r\nContent-Length: 3\r\n\r\n\xff\xfe\x00",
    "another page": b"HTTP/1.1 200 OK\r\nContent-Length: 13\r\n\r\n<html></html>",
    "server error": b"HTTP/1.1 500 Oops\r\nContent-Length: 0\r\n\r\n",
    "redirect": b"HTTP/1.1 302 Found\r\nLocation: /login\r\nContent-Length: 0\r\n\r\n",
    "other wire": b'HTTP/1.1 200 OK\r\nContent-Length: 11\r\n\r\n{"wire": 9}',
    "bad length": b"HTTP/1.1 200 OK\r\nContent-Length: many\r\n\r\n{}",
    "endless headers": b"HTTP/1.1 200 OK\r\n" + b"X: y\r\n" * 200,
    "cut short": b'HTTP/1.1 200 OK\r\nContent-Length: 99\r\n\r\n{"wire": 1',
    "nothing": b"",
    "nested for ever": b"HTTP/1.1 200 OK\r\nContent-Length: 200000\r\n\r\n" + b"[" * 200_000,
    "less than nothing": b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n-5\r\nabc",
}


@pytest.mark.parametrize("what", sorted(GARBAGE))
def test_garbage_is_always_a_link_error_for_people(
    what: str, sidecar: FakeSidecar, link: SidecarClient
) -> None:
    def fault(handler: Handler) -> bool:
        handler.raw(GARBAGE[what])
        return True

    sidecar.fault = fault
    with pytest.raises(LinkError) as caught:
        link.start("run", {}, 1.0)
    assert sidecar.url in str(caught.value)
    assert isinstance(caught.value, (SidecarGarbled, SidecarUnreachable))
    sidecar.fault = None
    link.start("run", {}, 1.0)  # and the link has recovered


@pytest.mark.parametrize(
    "verdict",
    [5, {}, {"run": "run", "trajectory": 0, "outcome": "maybe", "route": "grey_zone"},
     {"run": "other", "trajectory": 0, "outcome": "pass", "route": "grey_zone"},
     {"run": "run", "trajectory": 1, "outcome": "pass", "route": "grey_zone"}],
)  # fmt: skip
def test_a_verdict_that_is_none(verdict: Any, sidecar: FakeSidecar, link: SidecarClient) -> None:
    link.start("run", {}, 1.0)
    sidecar.fault = once("/verdict", lambda handler: handler.answer(200, {"verdict": verdict}))
    with pytest.raises(SidecarGarbled):
        link.verdict("run", 0, 0.1, 1.0)


def test_an_acknowledgement_of_another_keyframe(sidecar: FakeSidecar, link: SidecarClient) -> None:
    link.start("run", {}, 1.0)
    sidecar.fault = once("/keyframes", lambda h: h.answer(200, {"sequence": 7, "captured": True}))
    with pytest.raises(SidecarGarbled, match="keyframe 0"):
        link.keyframe(keyframe(), 1.0)


def test_late(sidecar: FakeSidecar, link: SidecarClient) -> None:
    release = threading.Event()

    def fault(handler: Handler) -> bool:
        release.wait()
        handler.drop()
        return True

    sidecar.fault = fault
    with pytest.raises(SidecarUnreachable, match=r"within 0\.3 s"):
        link.health(0.3)
    release.set()


def test_an_answer_that_drips_byte_by_byte_still_ends_in_time(
    sidecar: FakeSidecar, link: SidecarClient
) -> None:
    release = threading.Event()

    def fault(handler: Handler) -> bool:
        handler.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\n")
        while not release.wait(0.02):
            try:
                handler.wfile.write(b" ")
            except OSError:
                break
        handler.drop()
        return True

    sidecar.fault = fault
    with pytest.raises(SidecarUnreachable, match=r"within 0\.3 s"):
        link.health(0.3)
    release.set()


def test_the_last_answer_of_a_connection_is_read_to_its_end(sidecar: FakeSidecar) -> None:
    told, wanted = threading.Event(), threading.Event()

    def fault(handler: Handler) -> bool:
        handler.wfile.write(b"HTTP/1.1 200 OK\r\nConnection: close\r\nContent-Length: 4\r\n\r\n")
        told.set()
        assert wanted.wait(60)
        handler.raw(b"late")
        return True

    def check_stop() -> None:
        if told.is_set():
            wanted.set()

    sidecar.fault = fault
    client = HttpClient(sidecar.url, None, check_stop)
    assert client.request("GET", "/", None, 60.0) == (200, b"late")
    client.close()


@pytest.mark.parametrize(
    "again", [b"HTTP/1.1 100 Continue\r\n\r\n" * 100, b"X: y\r\n" * 1000, b"1\r\nx\r\n" * 1000]
)
@pytest.mark.parametrize("stopped", [False, True])
def test_an_answer_without_an_end_ends_in_time(
    again: bytes, stopped: bool, sidecar: FakeSidecar
) -> None:
    """It never makes the robot wait, so the wait is not what ends it."""
    flowing = threading.Event()

    def fault(handler: Handler) -> bool:
        if again[:1] != b"H":
            handler.wfile.write(b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n")
        if again[:1] == b"X":
            handler.wfile.write(b"0\r\n")
        try:
            while True:
                handler.wfile.write(again)
                flowing.set()
        except OSError:
            return True

    def check_stop() -> None:
        if stopped and flowing.is_set():
            raise Stop

    link = SidecarClient(sidecar.url, None, check_stop)
    sidecar.fault = fault
    with pytest.raises(Stop if stopped else LinkError):
        link.health(600.0 if stopped else 0.3)
    link.close()


def test_a_stop_ends_any_wait_at_once(
    sidecar: FakeSidecar, monkeypatch: pytest.MonkeyPatch
) -> None:
    release, stopping = threading.Event(), threading.Event()
    waits: list[float] = []
    real = selectors.DefaultSelector.select

    def select(self: selectors.DefaultSelector, timeout: float | None = None) -> Any:
        waits.append(math.inf if timeout is None else timeout)
        return real(self, timeout)

    monkeypatch.setattr(interruptible_socket.selectors.DefaultSelector, "select", select)

    def check() -> None:
        if stopping.is_set():
            raise Stop

    def fault(handler: Handler) -> bool:
        threading.Timer(0.25, stopping.set).start()
        release.wait()
        handler.drop()
        return True

    sidecar.fault = fault
    link = SidecarClient(sidecar.url, None, check)
    with pytest.raises(Stop):
        link.health(600.0)
    release.set()
    assert max(waits) <= 0.15


def test_a_stop_ends_a_connect_to_nowhere() -> None:
    # A listener whose queue is full leaves further connections hanging.
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen(0)
        fillers = [socket.socket() for _ in range(4)]
        for filler in fillers:
            filler.setblocking(False)
            filler.connect_ex(listener.getsockname())
        looks = itertools.count()

        def check() -> None:
            if next(looks) > 2:
                raise Stop

        link = SidecarClient(f"http://127.0.0.1:{listener.getsockname()[1]}", None, check)
        with pytest.raises(Stop):
            link.health(600.0)
        for filler in fillers:
            filler.close()


def test_dropped_after_reading_is_sent_again_and_counted_once(
    sidecar: FakeSidecar, link: SidecarClient
) -> None:
    link.start("run", {}, 1.0)

    def store_and_drop(handler: Handler) -> None:
        sidecar.stored().append(handler.body)
        handler.drop()

    sidecar.fault = once("/keyframes", store_and_drop)
    assert link.keyframe(keyframe(), 1.0).sequence == 0
    sent = [r for r in sidecar.requests if r[1].endswith("/keyframes")]
    assert len(sent) == 2
    assert len(sidecar.stored()) == 1


def test_a_connection_that_was_closed_meanwhile_is_opened_again(
    sidecar: FakeSidecar, link: SidecarClient
) -> None:
    link.start("run", {}, 1.0)
    sidecar.connections[0].shutdown(socket.SHUT_RDWR)
    assert link.keyframe(keyframe(), 1.0).sequence == 0


def test_it_dies_and_comes_back(sidecar: FakeSidecar, link: SidecarClient) -> None:
    link.start("run", {}, 1.0)
    sidecar.die()
    with pytest.raises(SidecarUnreachable):
        link.keyframe(keyframe(), 0.5)
    with FakeSidecar(port=sidecar.port) as reborn:
        with pytest.raises(RunUnknown):
            link.keyframe(keyframe(), 1.0)
        link.start("run", {}, 1.0)
        with pytest.raises(SequenceGap) as caught:
            link.keyframe(keyframe(3), 1.0)
        assert caught.value.expected == 0
        link.close()
        assert reborn.stored() == []


def test_a_silent_camera(sidecar: FakeSidecar, link: SidecarClient) -> None:
    link.start("run", {}, 1.0)
    error = {"code": "camera", "message": "No frame within 2 s.", "hint": "Look."}
    sidecar.fault = once("/keyframes", lambda h: h.answer(503, {"error": error}))
    with pytest.raises(CameraSilent, match=r"No frame within 2 s\)\. Its page"):
        link.keyframe(keyframe(), 1.0)
    assert link.keyframe(keyframe(), 1.0).sequence == 0


def test_a_refused_body(sidecar: FakeSidecar, link: SidecarClient) -> None:
    error = {"code": "body", "message": "volume must not be negative.", "hint": ""}
    sidecar.fault = once("/run", lambda h: h.answer(422, {"error": error}))
    with pytest.raises(SidecarRefused, match="volume must not be negative"):
        link.start("run", {}, 1.0)


def test_proxies_are_ignored(
    sidecar: FakeSidecar, link: SidecarClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("http_proxy", f"http://127.0.0.1:{free_port()}")
    assert link.health(1.0)["wire"] == 1
