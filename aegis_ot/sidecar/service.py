"""The sidecar's parts put together: one camera, one store, one analyser, many runs."""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from typing import Any

from ..errors import AegisError, CameraError
from ..vision.camera import Camera, Frame
from ..vision.types import Detector
from ..vision.view import ViewWatch
from ..vocabulary import Keyframe, to_json
from .analysis import Analyser
from .bell import Bell
from .cameras import FreeRunning, Health, camera_health
from .config import SidecarConfig
from .notifications import Notifier
from .overview import run_overview
from .sessions import Session
from .store import Store
from .wire import Finish, Hold, RunStart, WireError

log = logging.getLogger(__name__)

SESSIONS_KEPT = 16
"""Runs beyond this number leave memory if they are finished or silent; the store keeps them."""
SILENT_S = 3600.0
"""A robot that asked nothing for so long was switched off in its run, or stands in a pause. If it
does go on, its run is made again from the store."""


class Sidecar:
    """Everything behind the HTTP face.

    Args:
        config: Settings.
        camera: Where frames come from; closed with the sidecar.
        analyser: Judges wells.
        detector: Finds the tip where it is in doubt that the camera sees it; without one, frames
            are not asked whether they show anything.

    Raises:
        StoreError: The data folder cannot be used.
    """

    def __init__(
        self,
        config: SidecarConfig,
        camera: Camera,
        analyser: Analyser,
        detector: Detector | None = None,
    ) -> None:
        self.config = config
        self.camera = camera
        self.bell = Bell()
        self.store = Store(config.data)
        self._analyser = analyser
        # A test pattern shows no pipette, and is not meant to.
        watched = config.camera.watch_view and camera.kind != "pattern"
        self._detector = detector if watched else None
        self._notifier = Notifier(config.notifications.urls)
        self._sessions: dict[str, Session] = {}
        self._opening = threading.Lock()
        self._camera_trouble = ""
        # A camera that is told what to show must not hear of another keyframe in between.
        # One that runs by itself serves everyone at once.
        self._camera_lock: contextlib.AbstractContextManager[Any] = (
            contextlib.nullcontext() if isinstance(camera, FreeRunning) else threading.Lock()
        )
        self._closed = False

    def register(self, start: RunStart) -> None:
        """A run starts, or the robot says again that it has."""
        self.store.register(start)
        self.session(start.run)
        self.bell.ring()

    def session(self, run: str) -> Session:
        """The run in memory, from the store if need be.

        Raises:
            WireError: 404 if the run was never registered.
        """
        with self._opening:
            session = self._sessions.get(run)
            if session is None:
                self.require(run)
                self._evict()
                session = self._sessions[run] = Session(
                    run,
                    self.store,
                    self._analyser,
                    self.bell,
                    self._grab,
                    self._notifier.send,
                    self.config.operator.timeout_s,
                    None if self._detector is None else ViewWatch(self._detector),
                )
            session.asked = time.monotonic()
            return session

    def require(self, run: str) -> None:
        """Raise WireError 404 unless the run was registered."""
        if not self.store.knows(run):
            raise WireError(
                404, "run_unknown", f"Run {run!r} is not known here.", "Register it with PUT."
            )

    def hold(self, run: str, hold: Hold) -> None:
        """Keep how a hold ended. People hear of it unless a verdict, or they, ended it."""
        self.require(run)
        self.store.add_hold(run, hold)
        self.session(run).held(hold.trajectory, hold.policy)
        self.bell.ring()
        if hold.resolution not in ("verdict", "stopped"):
            policy = f"; policy: {hold.policy}" if hold.policy else ""
            self._notifier.send(
                f"aegis-ot: a hold ended without a verdict in run {run}",
                f"Trajectory {hold.trajectory}, after {hold.seconds:.1f} s: "
                f"{hold.resolution}{policy}",
            )

    def finish(self, run: str, finish: Finish) -> None:
        """Keep how the run ended."""
        self.session(run)  # after a restart: judges what had not been judged
        self.store.finish(run, finish)
        self.bell.ring()

    def runs(self) -> list[dict[str, Any]]:
        """All runs, newest first, as plain JSON."""
        return self.store.runs()

    def overview(self, run: str) -> dict[str, Any]:
        """All that is known of a run, as plain JSON (docs/reference/wire.md)."""
        version = self.bell.rings
        self.require(run)
        overview = run_overview(self.store, run)
        session = self._sessions.get(run)
        for trajectory in overview["trajectories"]:
            waits = session is not None and session.awaiting_operator(trajectory["trajectory"])
            trajectory["awaiting"] = "operator" if waits else None
            if session is not None and trajectory["verdict"] is None:
                # Judged, but the store could not keep it.
                verdict = session.verdict(trajectory["trajectory"])
                trajectory["verdict"] = None if verdict is None else to_json(verdict)
        return overview | {"version": version}

    def camera_health(self) -> Health:
        """How the camera is, by its own word and by the last capture."""
        health = camera_health(self.camera)
        if health.ok and self._camera_trouble:
            return Health(False, self._camera_trouble)
        return health

    def close(self) -> None:
        """End workers, camera and store. Idempotent."""
        if self._closed:
            return
        self._closed = True
        for session in self._sessions.values():
            session.close()
        self.camera.close()
        self._notifier.close()
        self.store.close()

    def _grab(self, keyframe: Keyframe, moment: float, view: ViewWatch | None) -> Frame:
        try:
            with self._camera_lock:
                self.camera.announce(keyframe)
                frame = self._usable(keyframe, moment, view)
        except Exception as error:
            if not isinstance(error, AegisError):
                log.exception("The camera failed")
                error = CameraError(f"The camera failed: {type(error).__name__}: {error}")
            if not self._camera_trouble:
                self._notifier.send(f"aegis-ot: camera trouble in run {keyframe.run}", str(error))
            self._camera_trouble = str(error)
            raise error from None
        self._camera_trouble = ""
        return frame

    def _usable(self, keyframe: Keyframe, moment: float, view: ViewWatch | None) -> Frame:
        """A frame that tells something; a second one is taken before that is given up."""
        trouble = None
        for again in (True, False):
            frame = self.camera.frame_after(moment, self.config.camera.timeout_s)
            _check_frame(frame, moment)
            trouble = None if view is None else view.look(keyframe, frame.image, again=again)
            if trouble is None:
                return frame
            moment = time.monotonic()
        raise CameraError("" if trouble is None else trouble.message)

    def _evict(self) -> None:
        if len(self._sessions) < SESSIONS_KEPT:
            return
        silent_before = time.monotonic() - SILENT_S
        for run, session in list(self._sessions.items()):
            row = self.store.run(run)
            finished = row is not None and row["finished"]
            if session.idle and (finished or session.asked < silent_before):
                session.close()
                del self._sessions[run]


def _check_frame(frame: Frame, moment: float) -> None:
    if not frame.jpeg or frame.image.ndim != 3:
        raise CameraError("The camera gave an empty frame.")
    if frame.exposed_at < moment:
        age = time.monotonic() - frame.exposed_at
        raise CameraError(f"The camera gave an old frame, exposed {age:.2f} s ago.")
