"""The sidecar's parts put together: one camera, one store, one analyser, many runs."""

from __future__ import annotations

import contextlib
import itertools
import threading
import time
from typing import Any

from .._version import __version__
from ..errors import ConfigurationError, StoreError
from ..run_view import RECOVERY
from ..run_view.overview import RunOverview
from ..vision.camera import Camera
from ..vision.types import Detector
from ..vision.view import ViewWatch
from .aiming import Aim
from .alerts import Alerts, Notice
from .analysis import Analyser
from .auditing import Auditor, Audits
from .bell import Bell
from .cameras import BoundCameras, FreeRunning, Health
from .clips import Clips
from .config import SidecarConfig
from .grabbing import Grabber
from .housekeeping import Housekeeper, Tidied
from .journal import event
from .lineage import lineage_document
from .overview import run_overview, runs_overview
from .run_names import check_start, kept_apart, name_taken
from .sessions import LAYER1, OPERATOR, UNSERVED, RunSession
from .store import Store
from .webhook import WebHook
from .wire import Finish, HoldReport, RecoveryReport, RunStart, WireError

SESSIONS_KEPT = 16
"""Runs beyond this number leave memory if they are finished or silent; the store keeps them."""
SILENT_S = 3600.0
"""A robot that asked nothing for so long was switched off in its run, or stands in a pause. If it
does go on, its run is made again from the store."""
EMPTY_S = 60.0
"""One that has captured nothing, or has ended, leaves after so long, s."""


class Sidecar:
    """Everything behind the HTTP face.

    Args:
        config: Settings.
        camera: Where frames come from; closed with the sidecar.
        analyser: Judges wells.
        detector: Finds the tip where it is in doubt that the camera sees it; without one, frames
            are not asked whether they show anything.
        auditor: Looks back at each run that has ended; without one nobody does.

    Raises:
        StoreError: The data folder cannot be used, or another sidecar uses it.

    Attributes:
        address: Where people open the page; for links in messages.
    """

    def __init__(
        self,
        config: SidecarConfig,
        camera: Camera,
        analyser: Analyser,
        detector: Detector | None = None,
        auditor: Auditor | None = None,
    ) -> None:
        self.config = config
        self.camera = camera
        self.bell = Bell()
        self.address = ""
        self._analyser = analyser
        self.store = Store(config.data, alone=True)
        try:
            self.alerts = Alerts(
                config.notifications.urls,
                self.store,
                lambda: self.address,
                self.bell.ring,
                lambda told: self._film(told.run, told.trajectory, anew=told.kind != "recovered"),
            )
        except ConfigurationError:
            self.store.close()
            raise
        with contextlib.suppress(StoreError):  # a full disk keeps nobody from their runs
            for run in self.store.unfinished():
                self.store.forget_torn(run)
        self._clips = Clips(camera, self.store, self.bell.ring)
        # A test pattern shows no pipette, and is not meant to.
        watched = config.camera.watch_view and camera.kind != "pattern"
        self._detector = detector if watched else None
        self._sessions: dict[str, RunSession] = {}
        self._met: set[str] = set()
        self._opening = threading.Lock()
        self._grabber = Grabber(camera, config.camera.timeout_s, self.alerts)
        self.aim = Aim(config, camera, lambda: self._grabber.last)
        self._closed = False
        self._about = about_sidecar(config, camera)
        self._audits = None
        if auditor is not None and config.audit:
            self._audits = Audits(auditor, self.store, self._settled, self.bell.ring)
        self._hook = WebHook(
            config.webhook,
            lambda run: lineage_document(self.store, run),
            self._settled,
            lambda run, why: self.alerts.undelivered(run, "webhook", why),
        )
        self._housekeeper = Housekeeper(
            self.store, config.retention, self._tidied, self._heard_within
        )

    def register(self, start: RunStart) -> str:
        """A run starts, or the robot says again that it has.

        Returns:
            What the run is called here: another name where another start has the one it came with.

        Raises:
            WireError: 422 if another start has it, and the guard is too old to take another.
        """
        run, first = start.run, None
        for number in itertools.count(2):
            if self.store.register(start.model_copy(update={"run": run}), self._about):
                self._met.add(run)
                event("run", run=run, protocol=start.protocol, robot=start.robot_name)
                break
            known = self.store.start_of(run)
            if known is None or start.is_again(known):
                break
            if not start.nonce:
                raise name_taken(known)
            first = first or known
            run = f"{start.run[:120]}-{number}"
        if first is not None:
            self.alerts.incidents.begin(run, "identifier", kept_apart(first, run))
            self.alerts.incidents.end(run, "identifier")
        self.store.reopen(run)
        if start.mode == "watch" and isinstance(self.camera, (FreeRunning, BoundCameras)):
            self.camera.remember()
        self.session(run)
        self.bell.ring()
        return run

    def session(self, run: str, nonce: str | None = None) -> RunSession:
        """The run in memory, from the store if need be.

        Args:
            run: Its name.
            nonce: Of the start that asks; ``None`` for a person.

        Raises:
            WireError: 404 if the run was never registered, 409 if it is another start's.
        """
        with self._opening:
            session = self._sessions.get(run)
            if session is None:
                self.require(run)
                self._evict()
                self._meet(run)
                if isinstance(self.camera, BoundCameras):
                    self.camera.meet(run, str((self.store.run(run) or {}).get("robot_name") or ""))
                session = self._sessions[run] = RunSession(
                    run,
                    self.store,
                    self._analyser,
                    self.bell,
                    self._grabber.grab,
                    self.alerts,
                    self.config.operator.timeout_s,
                    None if self._detector is None else ViewWatch(self._detector),
                )
            if nonce is not None:
                check_start(run, session.nonce, nonce)
            session.asked = time.monotonic()
            return session

    def require(self, run: str) -> None:
        """Raise WireError 404 unless the run was registered."""
        if not self.store.knows(run):
            raise WireError(
                404, "run_unknown", f"Run {run!r} is not known here.", "Register it with PUT."
            )

    def hold(self, run: str, hold: HoldReport) -> None:
        """Keep how a hold ended. People hear of it unless a verdict, or they, ended it."""
        watched = (self.store.run(run) or {}).get("mode") == "watch"
        self.session(run).held(hold, watched)
        event("hold", run=run, **hold.model_dump())
        if hold.resolution in ("stopped", OPERATOR) and hold.paused_s is None:
            self._film(run, hold.trajectory)
        expected = hold.resolution in ("verdict", "stopped", OPERATOR)
        if not expected and hold.paused_s is None:
            policy = f"; then: {hold.policy}" if hold.policy else ""
            what, seen = "a hold ended without a verdict", f"After {hold.seconds:.1f} s: "
            if hold.resolution in UNSERVED:
                what, seen = "the robot is paused", "It was not served: "
            elif hold.resolution == RECOVERY:
                what, seen = "the robot waits", f"A step failed ({hold.next}): "
            elif hold.resolution == LAYER1:
                what, seen = "the robot is paused", "What it does next breaks a rule: "
            seen += f"{hold.resolution}{policy}."
            self.alerts.tell(Notice(run, "hold", what, seen, hold.trajectory))

    def recovery(self, run: str, told: RecoveryReport) -> None:
        """Keep what the robot does by itself about a failed delivery."""
        self.session(run).record.recovery(told)
        event("recovery", run=run, **told.model_dump())
        if told.state == "recovered":  # people were told that it failed
            self.alerts.tell(
                Notice(run, "recovered", "put right by the robot", told.text, told.trajectory)
            )

    def _film(self, run: str, trajectory: int | None = None, anew: bool = False) -> None:
        """Keep the seconds around something that happened: with its delivery, ``anew`` if there is
        a clip already, or with the one that was under way, whose clip stays."""
        session = self._sessions.get(run)
        number = session.under_way if trajectory is None and session else trajectory
        if number is None:
            return
        keeps = trajectory is None or not anew
        with contextlib.suppress(StoreError):  # a clip is no reason to trouble anybody
            if not keeps or number not in self.store.clips(run):
                self._clips.take(run, number)

    def differs(self, run: str, text: str) -> None:
        """The run does otherwise than its rehearsal: people are told, once."""
        self.require(run)
        self.alerts.tell(Notice(run, "layer1", "the run is not as rehearsed", text))

    def finish(self, run: str, finish: Finish) -> None:
        """Keep how the run ended."""
        session = self.session(run)  # after a restart: judges what had not been judged
        session.record.end(finish)
        if finish.outcome != "succeeded":
            self._film(run)
        with contextlib.suppress(StoreError):
            self.alerts.incidents.end(run, "layer1")
            session.catch_up()
        event("finish", run=run, outcome=finish.outcome, detail=finish.detail)
        self._look_back(run)
        self.bell.ring()

    def close_run(self, run: str, finish: Finish) -> None:
        """Somebody who saw the robot says how the run ended, which the run itself cannot any more:
        what it was in the middle of is given up."""
        self.require(run)
        told = self.overview(run)
        if told["finished"]:
            return
        for one in told["trajectories"]:
            over = any(k["kind"] == "post_dispense" for k in one["keyframes"])
            if not over and one["verdict"] is None and one["abandoned"] is None:
                self.session(run).abandon(one["trajectory"], finish.detail or finish.outcome)
        self.finish(run, finish)

    def runs(self, search: str = "", most: int = -1) -> list[dict[str, Any]]:
        """Runs, newest first, as plain JSON (see :func:`.runs_overview`)."""
        return runs_overview(self.store, search, most)

    def overview(self, run: str) -> RunOverview:
        """All that is known of a run, as plain JSON (docs/reference/wire.md)."""
        version = self.bell.rings
        self.require(run)
        session = self._sessions.get(run)
        waiting = None if session is None else session.record
        at_work = session is not None and not session.idle
        overview = run_overview(self.store, run, at_work, waiting)
        overview["incidents"] += self.alerts.incidents.waiting(run)
        overview["order"] = None if session is None else session.ordered()
        for trajectory in overview["trajectories"]:
            number = trajectory["trajectory"]
            waits = session is not None and session.verdicts.awaits_operator(number)
            trajectory["awaiting"] = "operator" if waits else None
            trajectory["awaiting_s"] = (
                session.verdicts.operator_has(number) if session and waits else None
            )
            trajectory["held_for_s"] = session.verdicts.held_for(number) if session else None
        overview["version"] = version
        return overview

    def camera_health(self) -> Health:
        """How the camera is, by its own word and by the last capture."""
        return self._grabber.health()

    def close(self) -> None:
        """End workers, camera and store. Idempotent."""
        if self._closed:
            return
        self._closed = True
        if self._audits is not None:
            self._audits.close()
        self._hook.close()
        for session in self._sessions.values():
            session.close()
        self._housekeeper.close()
        self._clips.close()
        self.camera.close()
        self.alerts.notifier.close()
        self.store.close()

    def _meet(self, run: str) -> None:
        """Keep that this process took a run up in the middle."""
        if run in self._met:
            return
        self._met.add(run)
        with contextlib.suppress(StoreError):  # a full disk must not keep people from their run
            for kind in ("camera", "store", "model"):  # of an earlier process
                self.store.end_incidents(run, kind)
            row = self.store.run(run)
            if row is not None and not row["finished"] and self.store.next_sequence(run):
                self.alerts.incidents.note(
                    run, "restart", "The sidecar was started anew in this run."
                )

    def _heard_within(self, seconds: float) -> list[str]:
        since = time.monotonic() - seconds
        return [run for run, session in list(self._sessions.items()) if session.asked > since]

    def _tidied(self, done: Tidied) -> None:
        for run in done.removed:
            with self._opening:
                session = self._sessions.pop(run, None)
            if session is not None:
                session.close()
        for run in done.closed:
            self._look_back(run)
            seen = "The robot has said nothing for long; its run was closed."
            self.alerts.notifier.send(Notice(run, "silent", "a run ended without a word", seen))
        self.bell.ring()

    def _look_back(self, run: str) -> None:
        if self._audits is not None:
            self._audits.add(run)
        self._hook.add(run)

    def _settled(self, run: str) -> bool:
        session = self._sessions.get(run)
        return session is None or session.idle

    def _evict(self) -> None:
        if len(self._sessions) < SESSIONS_KEPT:
            return
        now = time.monotonic()
        for run, session in list(self._sessions.items()):
            if not session.idle or session.record or now - session.asked < EMPTY_S:
                continue
            if session.empty or now - session.asked > SILENT_S or self._has_ended(run):
                session.close()
                del self._sessions[run]

    def _has_ended(self, run: str) -> bool:
        row = self.store.run(run)
        return row is not None and bool(row["finished"])


def about_sidecar(config: SidecarConfig, camera: Camera) -> dict[str, Any]:
    """Settings and versions that a run is judged under, without secrets; plain JSON."""
    return {
        "version": __version__,
        "camera": camera.kind,
        "cascade": config.cascade.model_dump(mode="json"),
        "operator_timeout_s": config.operator.timeout_s,
        "model": config.model.name,
    }
