"""Runs the sidecar: as a process, or in a thread for tests and ``aegis-ot simulate``."""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType

import uvicorn
from fastapi import FastAPI
from uvicorn.server import HANDLED_SIGNALS

from ..errors import ConfigurationError
from ..vision.camera import Camera
from ..vision.types import Detector
from .analysis import Analyser
from .app import create_app
from .auditing import Auditor
from .config import SidecarConfig
from .connections import Connection
from .service import Sidecar

log = logging.getLogger(__name__)

KEEP_ALIVE = 3600
"""The robot keeps its connection open between keyframes, which may be minutes apart, s."""
STARTING = 30.0
GRACE = 3
SWITCH_S = 0.0005
"""How long a thread that computes may keep the interpreter from the one that answers, s. Python's
own 5 ms is felt in every keyframe that comes while another is scored."""


def serve(
    config: SidecarConfig,
    camera: Camera | None = None,
    analyser: Analyser | None = None,
    ready: Callable[[str], None] | None = None,
    detector: Detector | None = None,
    auditor: Auditor | None = None,
) -> None:
    """Run the sidecar until it is stopped by SIGINT or SIGTERM.

    Args:
        config: Settings.
        camera, analyser, detector, auditor: As for :func:`~.app.create_app`.
        ready: Called with the base URL once requests are answered.

    Raises:
        ConfigurationError: The address cannot be listened on, or the camera makes no sense.
        StoreError: The data folder cannot be used.
    """
    os.umask(0o077)  # what it writes is for its own user
    with _listening(config) as (listener, url):
        sys.setswitchinterval(SWITCH_S)
        app = create_app(config, camera, analyser, detector, auditor)
        app.state.sidecar.address = config.url or url
        server = _Server(app, lambda: ready(url) if ready else None)
        server.run(sockets=[listener])


@contextlib.contextmanager
def running_sidecar(
    config: SidecarConfig,
    camera: Camera | None = None,
    analyser: Analyser | None = None,
    detector: Detector | None = None,
    auditor: Auditor | None = None,
) -> Iterator[str]:
    """Run the sidecar in a thread, over a real socket, for as long as the block lasts.

    Yields:
        The base URL, ``http://127.0.0.1:PORT``. Give ``port=0`` for a free port.

    Raises:
        ConfigurationError, StoreError: As :func:`serve`.
    """
    with _listening(config) as (listener, url):
        app = create_app(config, camera, analyser, detector, auditor)
        app.state.sidecar.address = config.url or url
        started = threading.Event()
        server = _Server(app, started.set)
        thread = threading.Thread(
            target=server.run, kwargs={"sockets": [listener]}, name="sidecar", daemon=True
        )
        thread.start()
        try:
            if not started.wait(STARTING):
                raise ConfigurationError("The sidecar did not start; its log says why.")
            yield url
        finally:
            server.stop()
            thread.join(STARTING)
            app.state.sidecar.close()


class _Server(uvicorn.Server):
    def __init__(self, app: FastAPI, on_started: Callable[[], None]) -> None:
        super().__init__(
            uvicorn.Config(
                app,
                log_config=None,
                access_log=False,
                ws="none",
                timeout_keep_alive=KEEP_ALIVE,
                timeout_graceful_shutdown=GRACE,
                server_header=False,
                http=Connection,
            )
        )
        self._sidecar: Sidecar = app.state.sidecar
        self._on_started = on_started

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            self._on_started()

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """As uvicorn does, but a signal that was obeyed is not raised again: a clean stop."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {sig: signal.signal(sig, self.handle_exit) for sig in HANDLED_SIGNALS}
        try:
            yield
        finally:
            for sig, handler in before.items():
                signal.signal(sig, handler)

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        super().handle_exit(sig, frame)
        self._sidecar.bell.ring()

    def stop(self) -> None:
        """End soon; pages that wait for news are answered."""
        self.should_exit = True
        self._sidecar.bell.ring()


@contextlib.contextmanager
def _listening(config: SidecarConfig) -> Iterator[tuple[socket.socket, str]]:
    host = config.host.strip("[]")
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, config.port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        listener = socket.socket(family, kind, protocol)
    except OSError as error:
        raise ConfigurationError(f"Cannot listen on {config.host}: {error}.") from error
    with listener:
        # A restarted sidecar takes its port back at once.
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(address)
            listener.listen(128)
        except OSError as error:
            raise ConfigurationError(
                f"Cannot listen on {config.host} port {config.port}: {error.strerror or error}. "
                "Is another sidecar running? Name another port, or stop it."
            ) from error
        port = listener.getsockname()[1]
        yield listener, f"http://{_reachable(host, family)}:{port}"


def _reachable(host: str, family: int) -> str:
    """How a browser names this machine: an address that listens everywhere cannot be opened."""
    if host not in ("", "0.0.0.0", "::"):
        return f"[{host}]" if ":" in host else host
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        # Nothing is sent: this only asks which of our addresses would be used.
        probe.connect(("192.0.2.1", 9))
        return str(probe.getsockname()[0])
    return socket.gethostname() if family == socket.AF_INET else "127.0.0.1"
