"""A robot's agent as its coordinator sees it: calls that raise this package's own errors.

Only JSON crosses an exchange, never a pickle, so what an agent raises crosses it as its class's
name and its words.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from typing import Any

from .. import errors
from ..errors import AegisError, AgentFailed, AgentLost

STATUS_WAIT_S = 5.0
"""How long an agent keeps a question for its status that has no news to tell, s."""


def pack_error(error: Exception) -> dict[str, Any]:
    """An error as plain values; one that was not raised on purpose is the agent's own failure."""
    if isinstance(error, AegisError):
        kind, message = type(error).__name__, str(error)
    else:
        kind, message = "AgentFailed", f"{type(error).__name__}: {error}"
    values = {name: getattr(error, name, None) for name in ("line", "status")}
    known = {name: value for name, value in values.items() if isinstance(value, int)}
    return {"error": kind, "message": message, **known}


def unpack_error(values: Mapping[str, Any]) -> AegisError:
    """The error that an agent packed; an unknown one is an :class:`AgentFailed`."""
    kind = getattr(errors, str(values["error"]), AgentFailed)
    if not (isinstance(kind, type) and issubclass(kind, AegisError)):
        kind = AgentFailed
    extra = [values[name] for name in ("line", "status") if name in values]
    try:
        return kind(str(values["message"]), *extra)
    except TypeError:
        return AgentFailed(str(values["message"]))


class RemoteAgent:
    """Speaks to one agent.

    Args:
        name: Of its robot.
        handle: Academy's handle of the agent.
        dead_after_s: It is lost if it does not answer for so long, s.

    Every method raises :class:`AgentLost` where no answer comes, and what the agent itself raised.
    """

    def __init__(self, name: str, handle: Any, dead_after_s: float) -> None:
        self.name = name
        self._handle = handle
        self._dead_after_s = dead_after_s

    async def process(self, job: Mapping[str, Any]) -> dict[str, Any]:
        """Have a protocol checked and run; what came of it. Takes as long as the robot."""
        found: dict[str, Any] = await self._ask("process_protocol", job)
        return found

    async def status(self, since: int = -1) -> dict[str, Any]:
        """How the robot stands, as soon as that is newer than ``since``."""
        found: dict[str, Any] = await self._soon("status", since)
        return found

    async def go_ahead(self, job: str) -> None:
        """Give the robot leave to move liquid for this protocol."""
        await self._soon("go_ahead", job)

    async def pause(self, on: bool) -> None:
        """Hold the robot, or let it go on."""
        await self._soon("pause", on)

    async def report(self) -> list[dict[str, Any]]:
        """What came of every protocol that the agent has had."""
        found: list[dict[str, Any]] = await self._soon("report")
        return found

    async def _soon(self, action: str, *arguments: Any) -> Any:
        limit = STATUS_WAIT_S + self._dead_after_s
        try:
            return await asyncio.wait_for(self._ask(action, *arguments), limit)
        except asyncio.TimeoutError:
            raise AgentLost(f"{self.name} has not answered for {limit:g} s.") from None

    async def _ask(self, action: str, *arguments: Any) -> Any:
        from academy.exception import AcademyRemoteError

        try:
            answer = await self._handle.action(action, *arguments)
        except (asyncio.CancelledError, asyncio.TimeoutError):
            raise
        except AcademyRemoteError as error:
            last = str(error).strip().rpartition("\n")[2]
            raise AgentFailed(f"The agent of {self.name} broke down: {last}") from None
        except Exception as error:  # the exchange's own: mailbox closed, connection lost...
            raise AgentLost(f"The agent of {self.name} is gone: {error}") from None
        if isinstance(answer, Mapping) and "error" in answer:
            raise unpack_error(answer)
        return answer
