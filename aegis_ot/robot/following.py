"""Follows a run: each of its commands as it starts and as it ends, in order, none missed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ..errors import RobotRefused, RobotUnreachable
from .client import PAGE, RobotClient
from .server_answers import DONE, Command, RunSnapshot

POLL_S = 0.1
"""Sees the end of a command about 70 ms after it; the server feels nothing of it."""
PATIENCE_S = 120.0
"""How long a lost connection may last before the run is given up, s."""


@dataclass(frozen=True)
class Started:
    """A command has begun."""

    command: Command


@dataclass(frozen=True)
class Completed:
    """A command is over."""

    command: Command


@dataclass(frozen=True)
class StatusChanged:
    """The run's status is another one now."""

    run: RunSnapshot


@dataclass(frozen=True)
class Lost:
    """The robot does not answer; it is asked again."""

    reason: str


@dataclass(frozen=True)
class Found:
    """The robot answers again."""

    seconds: float


@dataclass(frozen=True)
class Gone:
    """The robot's server was restarted, and has lost the run.

    Attributes:
        run: As it was last seen.
    """

    run: RunSnapshot | None


Step = Started | Completed | StatusChanged | Lost | Found | Gone


def follow(
    robot: RobotClient,
    run: str,
    *,
    poll_s: float = POLL_S,
    patience_s: float = PATIENCE_S,
    idle: Callable[[], None] = lambda: None,
) -> Iterator[Step]:
    """What happens in a run, from its first command to its end.

    Args:
        robot: Whose run it is.
        run: Its identifier.
        poll_s: Pause between two looks.
        patience_s: How long the connection may be lost.
        idle: Called at every look, for what else is to be done meanwhile.

    Raises:
        RobotUnreachable: The robot did not answer for ``patience_s``.
        RobotRefused: It never had the run, or does not let this program in.
    """
    follower = _Follower(robot, run)
    lost_at: float | None = None
    while not follower.over:
        try:
            steps = follower.look()
        except RobotRefused as error:
            if error.status == 404 and follower.view is not None:
                yield Gone(follower.view)
                return
            if error.status in (401, 403, 404):
                raise
            steps, trouble = [], str(error)
        except RobotUnreachable as error:
            steps, trouble = [], str(error)
        else:
            trouble = ""
        if trouble:
            if lost_at is None:
                lost_at = time.monotonic()
                yield Lost(trouble)
            elif time.monotonic() - lost_at > patience_s:
                raise RobotUnreachable(f"{trouble} Given up after {patience_s:g} s.")
        elif lost_at is not None:
            yield Found(time.monotonic() - lost_at)
            lost_at = None
        yield from steps
        idle()
        if not follower.over and not (steps and follower.behind):
            time.sleep(poll_s)


class _Follower:
    def __init__(self, robot: RobotClient, run: str) -> None:
        self._robot = robot
        self._run = run
        self._cursor = 0
        self._started = -1
        self._status = ""
        self.view: RunSnapshot | None = None
        self.over = False
        self.behind = False

    def look(self) -> list[Step]:
        """What is new. The status is asked first: of an ended run all commands are there."""
        view = self._robot.run(self._run)
        if view.lost:
            self.over = True
            return [Gone(self.view)]
        self.view = view
        page = self._robot.commands(self._run, self._cursor)
        steps: list[Step] = []
        for command in page.commands:
            if command.status == "queued" and not view.ended:
                break
            if command.index > self._started and command.started is not None:
                self._started = command.index
                steps.append(Started(command))
            if command.status not in DONE and not view.ended:
                break
            self._cursor = command.index + 1
            if command.status in DONE:
                steps.append(Completed(command))
        self.behind = len(page.commands) == PAGE
        if view.status != self._status:
            self._status = view.status
            steps.append(StatusChanged(view))
        self.over = view.ended and not self.behind
        return steps
