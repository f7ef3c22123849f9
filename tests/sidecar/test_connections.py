"""Connections that say nothing, or say it slowly, keep no robot out."""

from __future__ import annotations

import contextlib
import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import pytest
from pydantic import SecretStr

from aegis_ot.errors import LinkError
from aegis_ot.runtime.sidecar_client import SidecarBusy, SidecarClient
from aegis_ot.sidecar import SidecarConfig, connections, running_sidecar, security
from aegis_ot.sidecar.connections import who_goes

from .helpers import Robot, StubAnalyser, StubCamera

TOKEN = "s3cret-token-of-the-lab"


@pytest.fixture
def guarded(tmp_path: Path) -> Iterator[str]:
    config = SidecarConfig(port=0, data=tmp_path, token=SecretStr(TOKEN))
    with running_sidecar(config, StubCamera(), StubAnalyser()) as url:
        yield url


def connect(url: str, says: bytes = b"") -> socket.socket:
    parts = urlsplit(url)
    peer = socket.create_connection((parts.hostname or "", parts.port or 0), timeout=60)
    peer.sendall(says)
    return peer


def is_dropped(peer: socket.socket) -> bool:
    """Waits until the other side has ended it; what it says before that does not count."""
    try:
        while peer.recv(1 << 16):
            pass
    except TimeoutError:
        return False
    except OSError:
        return True
    return True


def answer(peer: socket.socket) -> bytes:
    head = b""
    while b"]" not in head:
        came = peer.recv(1 << 16)
        assert came, head
        head += came
    return head


@pytest.mark.parametrize("says", [b"", b"GET /v1/runs HTTP/1.1\r\nX-Slow: "])
def test_a_flood_of_silent_connections_keeps_no_robot_out(guarded: str, says: bytes) -> None:
    with contextlib.ExitStack() as flood, Robot(guarded, token=TOKEN) as robot:
        assert robot.register().status_code == 200
        for _ in range(connections.MOST_AT_ONCE + 50):
            flood.enter_context(connect(guarded, says))
        assert robot.send(0).status_code == 200
        with Robot(guarded, token=TOKEN) as another:  # a robot that comes anew finds room as well
            assert another.send(1).status_code == 200
        assert robot.send(2).status_code == 200


@pytest.mark.parametrize(
    "says",
    [
        b"",
        b"GET /login HTTP/1.1\r\nHost: x\r\n\r\n",
        b"GET /v1/runs HTTP/1.1\r\nHost: x\r\n\r\n",
        b"POST /login HTTP/1.1\r\nHost: x\r\nContent-Length: 99\r\n\r\ntoken=",
        b"GET /v1/runs HTTP/1.1\r\nX-Slow: ",
    ],
)
def test_who_does_not_show_the_token_is_sent_away(
    guarded: str, says: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "STRANGER_S", 0.2)
    with connect(guarded, says) as peer:
        assert is_dropped(peer)


@pytest.mark.parametrize(
    "slow", [b"GET /v1/runs HTTP/1.1\r\nX-Slow: ", b"PUT /v1/runs/r HTTP/1.1\r\nHost: x\r\n"]
)
def test_a_known_robot_may_rest_but_not_linger_over_a_request(
    guarded: str, slow: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "REQUEST_S", 0.3)
    let_in = f"Host: x\r\nAuthorization: Bearer {TOKEN}\r\n".encode()
    ask = b"GET /v1/runs HTTP/1.1\r\n" + let_in + b"\r\n"
    with connect(guarded, ask) as peer:
        assert b'"runs"' in answer(peer)
        time.sleep(0.4)  # it may rest for longer than a request may take
        peer.sendall(ask)
        assert b'"runs"' in answer(peer)
        peer.sendall(slow + (let_in + b"Content-Length: 9\r\n\r\n{" if b"PUT" in slow else b""))
        assert is_dropped(peer)


@dataclass
class Seen:
    address: str
    made: float
    known: bool = False
    idle: bool = True

    @property
    def used(self) -> float:
        return self.made


def test_the_oldest_stranger_of_the_fullest_address_makes_room() -> None:
    quiet = Seen("10.0.0.1", 0.0)
    flood = [Seen("10.0.0.9", 1.0 + n) for n in range(connections.MOST_STRANGERS - 1)]
    newcomer = Seen("10.0.0.2", 99.0)
    assert who_goes([quiet, *flood[:-1], newcomer], newcomer) is None
    assert who_goes([quiet, *flood, newcomer], newcomer) is flood[0]


def test_of_too_many_that_are_known_the_longest_idle_one_makes_room() -> None:
    known = [Seen("a", n, known=True) for n in range(connections.MOST_AT_ONCE - 1)]
    known[0].idle = False
    newcomer = Seen("b", 999.0)
    assert who_goes([*known, newcomer], newcomer) is known[1]
    for one in known:
        one.idle = False
    assert who_goes([*known, newcomer], newcomer) is None


def test_a_sidecar_with_too_much_to_do_says_so(
    guarded: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(security, "MOST_AT_ONCE", 0)
    link = SidecarClient(guarded, TOKEN, lambda: None)
    with pytest.raises(SidecarBusy, match=r"too busy to serve this robot \(The sidecar answers"):
        link.start("run", {"run": "run"}, 5)
    told = httpx.get(f"{guarded}/v1/runs?token={TOKEN}", trust_env=False)
    assert (told.status_code, told.json()["error"]["code"]) == (503, "crowded")
    assert issubclass(SidecarBusy, LinkError)
