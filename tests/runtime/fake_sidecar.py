"""A small real HTTP server that keeps the wire's rules, and breaks them when told to."""

from __future__ import annotations

import contextlib
import json
import socket
import threading
import time
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

Fault = Callable[["Handler"], bool]
"""Called with each request after its body was read; ``True`` if it has dealt with it."""


class FakeSidecar:
    """Serves on loopback; use as a context manager.

    Attributes:
        keyframes: Those stored, per run, in order; a resent one is stored once.
        channels: What a verdict says of each nozzle, by trajectory number.
        outcomes: Verdict by trajectory number; ``"pass"`` by default, ``None`` for never.
        findings: Further members of the verdict, by trajectory number.
        requests: ``(method, path, body)`` of every request that was read.
        fault: What to do instead of answering.
    """

    def __init__(self, token: str | None = None, port: int = 0) -> None:
        self.token = token
        self.keyframes: dict[str, list[dict[str, Any]]] = {}
        self.outcomes: dict[int, str | None] = {}
        self.findings: dict[int, dict[str, Any]] = {}
        self.recoveries: list[dict[str, Any]] = []
        self.decided: dict[int, str] = {}
        self.channels: dict[int, list[dict[str, Any]]] = {}
        self.actions: dict[int, str] = {}
        self.order: dict[str, Any] | None = None
        self.requests: list[tuple[str, str, Any]] = []
        self.connections: list[socket.socket] = []
        self.holds: list[dict[str, Any]] = []
        self.incidents: list[dict[str, Any]] = []
        self.finished: list[dict[str, Any]] = []
        self.abandoned: list[int] = []
        self.fault: Fault | None = None
        self.asked = threading.Event()
        sidecar = self

        class Bound(Handler):
            owner = sidecar

        self._server = ThreadingHTTPServer(("127.0.0.1", port), Bound)
        self._server.daemon_threads = True
        self.port = self._server.server_address[1]
        self.url = f"http://127.0.0.1:{self.port}"
        self._thread = threading.Thread(
            target=self._server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True
        )

    def __enter__(self) -> FakeSidecar:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.die()

    def die(self) -> None:
        """Stop listening and cut every connection, as a killed process would."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()
        for connection in self.connections:
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)

    def stored(self, run: str = "run") -> list[dict[str, Any]]:
        return self.keyframes.get(run, [])


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    owner: FakeSidecar
    disable_nagle_algorithm = True

    def setup(self) -> None:
        super().setup()
        self.owner.connections.append(self.connection)

    def log_message(self, *_: object) -> None:
        pass

    def do_GET(self) -> None:
        self.handle_any()

    do_PUT = do_POST = do_GET

    def handle_any(self) -> None:
        length = int(self.headers.get("Content-Length", 0))
        body = json.loads(self.rfile.read(length)) if length else None
        owner = self.owner
        self.path = self.path.partition("?stands=")[0]  # its camera is never slow
        owner.requests.append((self.command, self.path, body))
        self.body = body
        if owner.fault is not None and owner.fault(self):
            return
        is_open = owner.token is None or self.path == "/v1/health"
        if not is_open and self.headers.get("Authorization") != f"Bearer {owner.token}":
            self.answer(401, {"error": {"code": "token", "message": "Wrong token.", "hint": ""}})
            return
        self.serve()

    def serve(self) -> None:
        owner = self.owner
        parts = urlsplit(self.path)
        words = parts.path.strip("/").split("/")
        if words[1] == "health":
            self.answer(200, {"name": "aegis-ot", "wire": 1})
            return
        run = words[2]
        if len(words) == 3:
            owner.keyframes.setdefault(run, [])
            self.answer(200, {"run": run, "wire": 1, "nonce": self.body.get("nonce", "")})
        elif run not in owner.keyframes:
            self.answer(404, {"error": {"code": "run_unknown", "message": "Unknown.", "hint": ""}})
        elif words[3] == "keyframes":
            self.keyframe(owner.keyframes[run])
        elif words[3] == "finish":
            owner.finished.append(self.body)
            self.answer(200, {})
        elif words[3] == "incident":
            owner.incidents.append(self.body)
            self.answer(200, {})
        elif words[3] == "hold":
            owner.holds.append(self.body)
            self.answer(200, {})
        elif words[3] == "recovery":
            owner.recoveries.append(self.body)
            self.answer(200, {})
        elif words[5] == "abandon":
            owner.abandoned.append(int(words[4]))
            self.answer(200, {})
        elif words[5] == "action":
            told = owner.actions.get(int(words[4]))
            self.answer(200, {"action": told and {"action": told, "by": "Ada", "note": ""}})
        else:
            wait = float(parse_qs(parts.query).get("wait", ["0"])[0])
            verdict = self.verdict(run, int(words[4]), wait)
            self.answer(200, {"verdict": verdict, "order": owner.order})

    def keyframe(self, stored: list[dict[str, Any]]) -> None:
        sequence = self.body["sequence"]
        if sequence > len(stored):
            error = {"code": "gap", "message": "Missing.", "hint": ""}
            self.answer(409, {"error": error, "expected": len(stored)})
            return
        if sequence == len(stored):
            stored.append(self.body)
        self.answer(
            200,
            {
                "sequence": sequence,
                "captured": True,
                "exposed_after_s": 0.01,
                "order": self.owner.order,
            },
        )

    def verdict(self, run: str, number: int, wait: float) -> dict[str, Any] | None:
        owner = self.owner
        owner.asked.set()
        frames = [f for f in owner.keyframes[run] if f["trajectory"] == number]
        outcome = owner.outcomes.get(number, "pass")
        if len(frames) < 4 or outcome is None:
            time.sleep(min(wait, 1.0))
            return None
        verdict = {"run": run, "trajectory": number, "outcome": outcome, "route": "grey_zone"}
        verdict["reason"] = "the column is too long"
        if number in owner.channels:
            verdict["channels"] = owner.channels[number]
        if outcome == "fail":
            verdict["failure"] = "partial_dispense"
        verdict.update(owner.findings.get(number, {}))
        if number in owner.decided:
            verdict.update(outcome=owner.decided[number], gate="operator")
        return verdict

    def answer(self, status: int, body: Any) -> None:
        data = json.dumps(body).encode()
        self.send_response(status)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def raw(self, data: bytes) -> None:
        """Write bytes and drop the connection."""
        self.wfile.write(data)
        self.wfile.flush()
        self.drop()

    def drop(self) -> None:
        """Drop the connection without a further word."""
        self.close_connection = True
        with contextlib.suppress(OSError):
            self.connection.shutdown(socket.SHUT_RDWR)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def once(path_end: str, act: Callable[[Handler], None], times: int = 1) -> Fault:
    """A fault for the first requests whose path ends so."""
    left = [times]

    def fault(handler: Handler) -> bool:
        if left[0] and urlsplit(handler.path).path.endswith(path_end):
            left[0] -= 1
            act(handler)
            return True
        return False

    return fault
