"""One robot's agent: its Layer 1 validator and its Layer 2 session behind Academy actions."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from typing import Any

from academy.agent import Agent, action

from ..adapters.opentrons.rehearsal import Script, record
from ..errors import ConfigurationError, RunAborted
from ..preflight.check_protocol import check_recording, errors_of, rejection
from ..preflight.judging import Report
from ..runtime.descriptions import about_layer1
from ..settings import load_settings
from ..workbench.guard_arguments import guard_arguments
from .config import RobotConfig
from .jobs import Job
from .remote import STATUS_WAIT_S, pack_error
from .sessions import Session, open_session

_LEAVE_S = 60.0
"""How long a robot waits for leave to move liquid; then its coordinator is thought dead."""

Validator = Callable[[Script], Report]
"""Layer 1: judges a protocol, or raises a :class:`~aegis_ot.errors.RehearsalError`."""


def validate(script: Script) -> Report:
    """Judge a protocol as its own guard would; without a guard as a bare one would.

    Raises:
        RehearsalError: It cannot be rehearsed.
        ConfigurationError, RuleError: Its guard, or a rule file, cannot be used.
    """
    return check_recording(record(script), load_settings(**guard_arguments(script.text).values))


class AegisAgent(Agent):
    """Guards one robot. What its actions take and give are plain JSON values."""

    def __init__(
        self, robot: RobotConfig, validator: Validator = validate, session: Session | None = None
    ) -> None:
        super().__init__()
        self._robot = robot
        self._validator = validator
        self._session = session or open_session(robot)
        self._done: list[dict[str, Any]] = []
        self._control = _Control(self._tell_from_thread)
        self._status: dict[str, Any] = {"version": 0, "robot": robot.name}
        self._status |= {"state": "idle", "job": None, "text": ""}

    async def agent_on_startup(self) -> None:
        """Everything that belongs to the agent's own event loop."""
        self._loop = asyncio.get_running_loop()
        self._lock = asyncio.Lock()  # actions run concurrently; the robot does one thing at a time
        self._news = asyncio.Event()

    async def agent_on_shutdown(self) -> None:
        """Ends a simulated run at its next move; pauses a real one, which waits for a person."""
        self._control.stop("The robot's agent was shut down.")

    @action
    async def process_protocol(self, job: dict[str, Any]) -> dict[str, Any]:
        """Check a protocol with Layer 1 and, if it may run, run it under Layer 2.

        Returns:
            As :meth:`Session.run`, with ``job``, ``robot``, ``layer1`` and ``seconds``; a refused
            protocol has the outcome ``"rejected"``. Or an error, packed.
        """
        async with self._lock:
            began = time.monotonic()
            work = asyncio.ensure_future(self._process(Job.from_wire(job)))
            try:
                found = await asyncio.shield(work)
            except asyncio.CancelledError:
                # The robot is not free before its thread has ended.
                self._control.stop("The fleet's run was broken off.")
                await asyncio.wait([work])
                raise
            except Exception as error:
                found = pack_error(error)
            finally:
                self._tell(state="idle", job=None, text="")
            found |= {"job": job["name"], "robot": self._robot.name}
            found["seconds"] = round(time.monotonic() - began, 3)
            self._done.append(found)
            return found

    async def _process(self, job: Job) -> dict[str, Any]:
        lacking = self._robot.lacks(job.needs)
        if lacking:
            raise ConfigurationError(f"{self._robot.name} lacks {', '.join(lacking)}.")
        self._control.begin()
        self._tell(state="checking", job=job.name, wells=None, judged=0, flagged=0)
        report = await self.agent_run_sync(self._validator, job.script)
        layer1 = about_layer1(report)
        refuses = guard_arguments(job.script.text).values.get("rules", "on") == "on"
        if refuses and errors_of(report):
            return {"outcome": "rejected", "detail": rejection(report), "layer1": layer1}
        self._tell(state="preparing")
        found = await self.agent_run_sync(self._session.run, job, self._control)
        return found | {"layer1": layer1}

    @action
    async def go_ahead(self, job: str) -> None:
        """The coordinator has noted that this protocol may move liquid from now on."""
        if self._status["job"] == job:
            self._tell(state="running")
            self._control.allow()

    @action
    async def status(self, since: int = -1) -> dict[str, Any]:
        """How the robot stands, as soon as that is newer than ``since``, or after a while."""
        until = self._loop.time() + STATUS_WAIT_S
        while self._status["version"] <= since and (left := until - self._loop.time()) > 0:
            try:
                await asyncio.wait_for(self._news.wait(), left)
            except asyncio.TimeoutError:
                break
        return dict(self._status)

    @action
    async def pause(self, on: bool = True) -> None:
        """Hold the robot before its next move, or let it go on."""
        self._control.hold(on)
        self._tell(held=on)

    @action
    async def report(self) -> list[dict[str, Any]]:
        """What came of every protocol so far."""
        return list(self._done)

    def _tell(self, **news: Any) -> None:
        self._status |= news
        self._status["version"] += 1
        self._news.set()
        self._news = asyncio.Event()

    def _tell_from_thread(self, **news: Any) -> None:
        self._loop.call_soon_threadsafe(lambda: self._tell(**news))


class _Control:
    """Where the session's threads and the agent's loop meet: a :class:`Watch`."""

    def __init__(self, tell: Callable[..., None]) -> None:
        self.tell = tell
        self._allowed = threading.Event()
        self._going = threading.Event()
        self._going.set()
        self._stopped = ""
        self._wanted = ""

    def begin(self) -> None:
        """A new protocol: it has no leave yet."""
        self._allowed.clear()
        self._stopped = ""
        self._wanted = "" if self._going.is_set() else "pause"

    def allow(self) -> None:
        self._allowed.set()

    def hold(self, on: bool) -> None:
        self._wanted = "pause" if on else "play"
        if on:
            self._going.clear()
        else:
            self._going.set()

    def stop(self, why: str) -> None:
        self._stopped, self._wanted = why, "pause"
        self._allowed.set()
        self._going.set()

    def ask_leave(self) -> None:
        self.tell(state="asking")
        if not self._allowed.wait(_LEAVE_S):
            raise RunAborted(f"Nobody gave leave to move liquid in {_LEAVE_S:g} s; none moved.")
        self.go_on()

    def go_on(self) -> None:
        self._going.wait()
        if self._stopped:
            raise RunAborted(self._stopped)

    @property
    def wanted(self) -> str:
        wanted, self._wanted = self._wanted, ""
        if self._stopped and not wanted:  # the pause was asked for by the call before
            raise RunAborted(self._stopped)
        return wanted
