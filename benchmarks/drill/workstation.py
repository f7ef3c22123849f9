"""What stands beside the robot: a sidecar process, its camera, its network, its VLM."""

from __future__ import annotations

import contextlib
import json
import os
import re
import resource
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import urllib.parse
import urllib.request
from collections import deque
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.vocabulary import Keyframe

EXPOSURES = 4
"""Pictures of each keyframe that differ by their noise; then they come again."""
FPS = 10.0
"""Of the simulated camera; each frame is rendered in the drill's own process."""

_PROCESS = """
import signal, sys, time
from pathlib import Path
real, leap = time.time, [0.0]
time.time = lambda: real() + leap[0]
signal.signal(signal.SIGUSR1, lambda *_: leap.__setitem__(0, float(Path(sys.argv[2]).read_text())))
from aegis_ot.sidecar.__main__ import main
sys.exit(main(sys.argv[1:2]))
"""
"""The sidecar, with a wall clock that can be set: a signal has it read how far from a file."""


class Sidecar:
    """One data folder, and the process that serves it.

    Args:
        folder: For settings, data, log.
        settings: Of the sidecar, without data folder and port.
    """

    def __init__(self, folder: Path, settings: dict[str, Any]) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.port = _free_port()
        self.url = f"http://127.0.0.1:{self.port}"
        self._leap = folder / "leap"
        self._settings = folder / "sidecar.json"
        self._log = folder / "sidecar.log"
        told = {"port": self.port, "data": str(folder / "data"), "log": "json"} | settings
        self._settings.write_text(json.dumps(told), encoding="utf-8")
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start the process, and wait until it answers."""
        environment = {k: v for k, v in os.environ.items() if not k.startswith("AEGIS_OT_")}
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-c", _PROCESS, str(self._settings), str(self._leap)],
                env=dict(environment, OMP_NUM_THREADS="1"), stderr=log, stdout=log,
            )  # fmt: skip
        until = time.monotonic() + 60
        while time.monotonic() < until:
            if self._process.poll() is not None:
                break
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port)):
                return
            time.sleep(0.05)
        raise RuntimeError(f"the sidecar did not start; see {self._log}")

    def kill(self) -> None:
        """As a power switch does it."""
        assert self._process is not None
        self._process.kill()
        self._process.wait()

    def stop(self) -> None:
        """A clean stop, if it runs."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
            self._process.wait(20)

    def fill_disk(self, full: bool) -> None:
        """Let no file of the process grow any more, as on a full disk; or let them again."""
        assert self._process is not None
        most = 1 if full else resource.RLIM_INFINITY
        limits = (most, resource.RLIM_INFINITY)
        resource.prlimit(self._process.pid, resource.RLIMIT_FSIZE, limits)  # Linux alone has it

    def set_clock(self, ahead_s: float) -> None:
        """Set the process's wall clock so far ahead of the machine's."""
        assert self._process is not None
        self._leap.write_text(str(ahead_s), encoding="ascii")
        self._process.send_signal(signal.SIGUSR1)


class StreamCamera:
    """The simulated camera as an MJPEG stream on loopback, with a cable that can be pulled.

    Each frame holds the moment of its exposure (see :func:`exposed_at`).

    Args:
        seed: Of its session.
        fps: Frames per second.
        lengths: Whether parts say how long they are.
        behind: How many newer frames it has when it hands one on.
    """

    def __init__(self, seed: int, fps: float = FPS, lengths: bool = True, behind: int = 0) -> None:
        self._lengths = lengths
        self._kept: deque[bytes] = deque(maxlen=behind + 1)
        self._drawn: dict[int, list[bytes]] = {}
        self._now: list[bytes] = []
        self._turn = 0
        self._showing = threading.Lock()
        self._camera = SimulatedCamera(seed, (), SessionParameters.webcam(seed))
        self._plugged = threading.Event()
        self._plugged.set()
        camera = self

        class Stream(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                if not camera._plugged.is_set():
                    self.close_connection = True
                    return
                self.send_response(200)
                self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
                self.end_headers()
                with contextlib.suppress(OSError):
                    while camera._plugged.is_set():
                        began = time.monotonic()
                        with camera._showing:  # no picture of before is sent after a move
                            self.wfile.write(camera._part())
                            self.wfile.flush()
                        time.sleep(max(0.0, 1 / fps - (time.monotonic() - began)))

            def log_message(self, *_: object) -> None:
                """Quiet."""

        self._server = _serving(Stream)
        self.spec = f"http://127.0.0.1:{self._server.server_port}/"

    def show(self, keyframe: Keyframe) -> None:
        """The robot stands at this keyframe."""
        with self._showing:
            self._camera.announce(keyframe)
            self._now = self._drawn.setdefault(keyframe.sequence, [])

    def plug(self, there: bool) -> None:
        """Pull the cable, or put it back."""
        (self._plugged.set if there else self._plugged.clear)()

    def close(self) -> None:
        """No more frames."""
        self._plugged.clear()
        self._server.shutdown()
        self._server.server_close()

    def _part(self) -> bytes:
        moment, drawn = time.monotonic(), self._now
        if len(drawn) < EXPOSURES:
            drawn.append(self._camera.frame_after(time.monotonic(), 5.0).jpeg)
            jpeg = drawn[-1]
        else:
            self._turn += 1
            jpeg = drawn[self._turn % EXPOSURES]
        self._kept.append(_dated(jpeg, moment))
        jpeg = self._kept[0]
        length = f"Content-Length: {len(jpeg)}\r\n" if self._lengths else ""
        head = f"--frame\r\nContent-Type: image/jpeg\r\n{length}\r\n"
        return head.encode() + jpeg + b"\r\n"


def _dated(jpeg: bytes, moment: float) -> bytes:
    """With the moment of its exposure as a comment, ``time.monotonic``, s."""
    said = struct.pack(">d", moment)
    return jpeg[:2] + b"\xff\xfe" + struct.pack(">H", len(said) + 2) + said + jpeg[2:]


def exposed_at(jpeg: bytes) -> float:
    """When a frame of :class:`StreamCamera` was exposed, ``time.monotonic``, s."""
    return float(struct.unpack(">d", jpeg[6:14])[0])


class Cable:
    """A TCP relay between robot and sidecar that can be cut: then nothing comes through, and
    nobody is told so, as with a pulled network cable."""

    def __init__(self, port: int) -> None:
        self._target = ("127.0.0.1", port)
        self._whole = threading.Event()
        self._whole.set()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._listener.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self, cut: bool) -> None:
        """Cut it, or mend it."""
        (self._whole.clear if cut else self._whole.set)()

    @property
    def whole(self) -> bool:
        """Whether it is not cut."""
        return self._whole.is_set()

    def close(self) -> None:
        """Accept nobody any more."""
        self._listener.close()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                near = self._listener.accept()[0]
                threading.Thread(target=self._relay, args=(near,), daemon=True).start()

    def _relay(self, near: socket.socket) -> None:
        self._whole.wait()
        try:
            far = socket.create_connection(self._target)
        except OSError:
            near.close()
            return
        for one, other in ((near, far), (far, near)):
            threading.Thread(target=self._pump, args=(one, other), daemon=True).start()

    def _pump(self, one: socket.socket, other: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while data := one.recv(1 << 16):
                self._whole.wait()
                other.sendall(data)
        for end in (one, other):
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)


class Crowd:
    """Connections to the sidecar that say nothing; every second one says a request, byte by byte,
    that never ends."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._open: list[socket.socket] = []

    def come(self, count: int) -> None:
        """All at once."""
        for number in range(count):
            one = socket.create_connection(("127.0.0.1", self._port), 10)
            if number % 2:
                one.sendall(b"GET /v1/health HTTP/1.1\r\nX-Slow: ")
            self._open.append(one)

    def go(self) -> None:
        """They are closed."""
        for one in self._open:
            one.close()


class Person:
    """Somebody at the sidecar's page, who sees what it shows and presses its buttons."""

    def __init__(self, url: str, run: str) -> None:
        self._page = f"{url}/runs/{run}"
        self._form = ""
        self._open = urllib.request.build_opener(urllib.request.ProxyHandler({})).open

    def sees_a_pause(self) -> bool:
        """Whether the page says that the robot is paused, and offers to resume it."""
        with self._open(self._page, timeout=20) as answer:
            shown = answer.read().decode()
        asked = re.search(r'class="ask paused".*?action="([^"]+)".*?value="resume"', shown, re.S)
        self._form = asked[1] if asked else ""
        return asked is not None

    def resumes(self) -> None:
        """By the button on the page."""
        url = self._page.partition("/runs/")[0] + self._form
        body = urllib.parse.urlencode({"by": "drill", "answer": "resume"}).encode()
        with self._open(url, body, timeout=20):
            pass


class VisionModel:
    """Speaks as an OpenAI-compatible server does: three lenses that pass every well."""

    def __init__(self) -> None:
        self.up = True
        self.takes_s = 0.0
        model = self

        class Answers(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                self.rfile.read(int(self.headers.get("Content-Length", 0)))
                time.sleep(model.takes_s)
                body = json.dumps(_completion() if model.up else {"error": {"message": "down"}})
                self.send_response(200 if model.up else 500)
                self.send_header("Content-Type", "application/json")
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body.encode())

            def log_message(self, *_: object) -> None:
                """Quiet."""

        self._server = _serving(Answers)
        self.name = f"openai:drill@http://127.0.0.1:{self._server.server_port}/v1"

    def close(self) -> None:
        """No more answers."""
        self._server.shutdown()
        self._server.server_close()


def _completion() -> dict[str, Any]:
    one = {"verdict": "pass", "confidence": "high", "failure": "none", "reason": "as it should be"}
    said = json.dumps(dict.fromkeys(("skeptical", "routine", "expert"), one))
    return {
        "id": "drill", "object": "chat.completion", "model": "drill",
        "choices": [{"index": 0, "finish_reason": "stop",
                     "message": {"role": "assistant", "content": said}}],
        "usage": {"prompt_tokens": 1000, "completion_tokens": 100, "total_tokens": 1100},
    }  # fmt: skip


def _serving(handler: type[BaseHTTPRequestHandler]) -> ThreadingHTTPServer:
    server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    return server


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@contextlib.contextmanager
def closing(*things: Any) -> Iterator[None]:
    """Close what is there, whatever happens."""
    try:
        yield
    finally:
        for thing in things:
            thing.close()
