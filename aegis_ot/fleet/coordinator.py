"""Gives protocols to robots, follows them, and goes on when an agent dies."""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import AegisError, FleetError, LinkError, RobotError
from .config import FleetConfig, RobotConfig
from .hosting import MakeAgent, agents_of
from .jobs import Job, numbered
from .remote import RemoteAgent
from .report import BROKEN_OFF, LOST, NOT_RUN, FleetEntry, FleetReport
from .schedule import fitting, next_job

_OUT = (FleetError, RobotError, LinkError)
"""After these a robot gets nothing more: nobody knows how it stands."""


class FleetScreen:
    """Told how a fleet is doing. This one says nothing, and holds no real robot ready."""

    async def is_ready(self, robot: str, job: Job) -> bool:
        """Whether deck, tips and liquids of a real robot are in place for this very protocol."""
        return False

    def stands(self, robot: str, status: Mapping[str, Any]) -> None:
        """A robot's status is new; see :meth:`~.agent.AegisAgent.status`."""

    def ended(self, entry: FleetEntry) -> None:
        """A protocol has ended, or was given up."""

    def lost(self, robot: str, why: str) -> None:
        """A robot gets nothing more."""


class Coordinator:
    """Runs protocols on agents.

    Args:
        jobs: The protocols.
        robots: The fleet.
        agents: One for each robot, by its name.
        screen: Told of it.
    """

    def __init__(
        self,
        jobs: Sequence[Job],
        robots: Sequence[RobotConfig],
        agents: Mapping[str, RemoteAgent],
        screen: FleetScreen,
    ) -> None:
        jobs = numbered(jobs)
        self._agents = agents
        self._screen = screen
        self._fits = fitting(jobs, robots)
        self._entries = {job.name: FleetEntry(job) for job in jobs}
        self._real = {robot.name for robot in robots if not robot.simulated}
        self._waiting = list(jobs)
        self._running: list[Job] = []
        self._allowed: set[str] = set()
        self._changed = asyncio.Condition()
        self._began = time.monotonic()
        self.report = FleetReport(robots, list(self._entries.values()))

    async def run(self) -> FleetReport:
        """Until every protocol has ended or no robot is left for it; or until cancelled, which
        breaks the running ones off and is told in the report."""
        for job in [job for job in self._waiting if not self._fits[job.name]]:
            self._entries[job.name].detail = self._why_nowhere(job)
        try:
            await asyncio.gather(*(self._serve(name) for name in self._agents))
        except asyncio.CancelledError:
            self.report.broken_off = True
            for job in self._running:
                self._end(job, BROKEN_OFF, "The fleet's run was broken off.")
        for job in self._waiting:
            self._screen.ended(self._entries[job.name])
        self.report.seconds = self._now()
        return self.report

    def _why_nowhere(self, job: Job) -> str:
        return "No robot has what it needs: " + "; ".join(
            f"{robot.name}: {', '.join(robot.lacks(job.needs))}" for robot in self.report.robots
        )

    async def _serve(self, robot: str) -> None:
        """Give one robot protocols as long as there are any for it."""
        while (job := await self._take(robot)) is not None:
            entry = self._entries[job.name]
            if robot in self._real and not await self._screen.is_ready(robot, job):
                await self._settle(job, NOT_RUN, f"Nobody said that {robot} is ready for it.")
                continue
            entry.robot, entry.began_s = robot, self._now()
            try:
                entry.result = await self._give(self._agents[robot], job)
            except _OUT as error:
                await self._give_up(robot, job, str(error))
                return
            except AegisError as error:
                await self._settle(job, "failed", str(error))
            else:
                await self._settle(job, entry.result["outcome"], entry.result["detail"])

    async def _take(self, robot: str) -> Job | None:
        async with self._changed:
            while True:
                job = next_job(robot, self._waiting, self._fits)
                if job is not None:
                    self._waiting.remove(job)
                    self._running.append(job)
                    return job
                if not any(robot in self._fits[other.name] for other in self._running):
                    return None
                await self._changed.wait()  # one that runs elsewhere may come back

    async def _give(self, agent: RemoteAgent, job: Job) -> dict[str, Any]:
        """Have a protocol run, and follow it; whichever of the two fails first is raised."""
        work = asyncio.ensure_future(agent.process(job.to_wire()))
        watching = asyncio.ensure_future(self._follow(agent, job, work))
        try:
            await asyncio.wait([work, watching], return_when=asyncio.FIRST_COMPLETED)
            if not work.done():
                watching.result()
            return await work
        finally:
            for task in (work, watching):
                task.cancel()
                # A lost agent's exchange may be lost too: the farewell does not matter.
                with contextlib.suppress(asyncio.CancelledError, Exception):
                    await task

    async def _follow(self, agent: RemoteAgent, job: Job, work: asyncio.Future[Any]) -> None:
        seen = -1
        # Before Python 3.12 wait_for can swallow a cancellation: being cancelled is not enough.
        while not work.done():
            status = await agent.status(seen)
            seen = status["version"]
            self._screen.stands(agent.name, status)
            if status["state"] == "asking" and status["job"] == job.name:
                self._allowed.add(job.name)  # noted first: it holds even if the agent dies now
                await agent.go_ahead(job.name)

    async def _give_up(self, robot: str, job: Job, why: str) -> None:
        self.report.lost[robot] = why
        self._screen.lost(robot, why)
        if job.name in self._allowed:
            text = f"{why} Liquid may have moved: look at {robot} before anything else runs there."
            await self._settle(job, LOST, text)
            return
        async with self._changed:
            entry = self._entries[job.name]
            entry.lost_on.append(robot)
            entry.robot, entry.began_s = "", None
            self._running.remove(job)
            self._waiting.append(job)
            self._changed.notify_all()

    async def _settle(self, job: Job, outcome: str, detail: str) -> None:
        async with self._changed:
            self._running.remove(job)
            self._end(job, outcome, detail)
            self._changed.notify_all()

    def _end(self, job: Job, outcome: str, detail: str) -> None:
        entry = self._entries[job.name]
        entry.outcome, entry.detail = outcome, detail
        entry.ended_s = None if entry.began_s is None else self._now()
        self._screen.ended(entry)

    def _now(self) -> float:
        return time.monotonic() - self._began


async def run_fleet(
    config: FleetConfig,
    jobs: Sequence[Job],
    screen: FleetScreen | None = None,
    make_agent: MakeAgent | None = None,
) -> FleetReport:
    """Launch the fleet's own agents, find the remote ones, and run protocols on them all.

    Args:
        config: The fleet.
        jobs: The protocols.
        screen: Told of it.
        make_agent: Makes the agent of a robot, by default an :class:`~.agent.AegisAgent`.

    Raises:
        ConfigurationError: The exchange cannot be used.
        AgentLost: A remote agent cannot be found.
    """
    async with agents_of(config, make_agent) as agents:
        return await Coordinator(jobs, config.robot, agents, screen or FleetScreen()).run()
