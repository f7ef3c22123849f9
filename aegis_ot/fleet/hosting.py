"""Launches agents in this process, and finds those that others serve."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable, Collection, Mapping
from typing import Any

from academy.handle import Handle
from academy.manager import Manager
from academy.serialize import SerializationStrategy

from ..errors import AgentLost, ConfigurationError
from .agent import AegisAgent
from .config import FleetConfig, RobotConfig
from .exchange import JSON_ONLY, json_only, make_exchange
from .remote import RemoteAgent

MakeAgent = Callable[[RobotConfig], AegisAgent]
FIND_S = 30.0
"""How long remote agents are looked for, s."""
_ANSWER_S = 3.0


@contextlib.asynccontextmanager
async def agents_of(
    config: FleetConfig, make_agent: MakeAgent | None = None
) -> AsyncIterator[Mapping[str, RemoteAgent]]:
    """All agents of a fleet by robot, its own ones for as long as the block lasts.

    Raises:
        ConfigurationError: The exchange cannot be used.
        AgentLost: A remote agent does not appear within :data:`FIND_S`.
    """
    async with _hosted(config, [r for r in config.robot if not r.remote], make_agent) as hosted:
        handles = dict(hosted.launched)
        remote = {robot.name for robot in config.robot if robot.remote}
        handles |= await _find(hosted.client, remote)
        yield {
            robot.name: RemoteAgent(robot.name, handles[robot.name], config.dead_after_s)
            for robot in config.robot
        }


async def serve_agents(
    config: FleetConfig,
    names: Collection[str] = (),
    started: Callable[[Collection[str]], None] = lambda names: None,
) -> None:
    """Serve agents of a fleet on this host until cancelled.

    Args:
        config: Its file, the same on every host.
        names: Which robots; none: all that are marked ``remote``.
        started: Told once they can be found.

    Raises:
        ConfigurationError: There is no such robot, or the exchange cannot be used.
        AgentLost: An agent has ended, most likely with the exchange.
    """
    robots = _named(config, names) or [robot for robot in config.robot if robot.remote]
    if config.exchange == "local" or not robots:
        raise ConfigurationError("Serving agents needs an exchange and robots with remote = true.")
    async with _hosted(config, robots, None) as hosted:
        started([robot.name for robot in robots])
        await hosted.one_ended()
        raise AgentLost(f"An agent has ended. Is {_public(config.exchange)} still there?")


async def hold_robots(config: FleetConfig, names: Collection[str], on: bool) -> None:
    """Hold robots of a fleet that runs elsewhere before their next move, or let them go on.

    Args:
        config: The fleet.
        names: Which robots; none: all.
        on: Whether to hold them.

    Raises:
        ConfigurationError: There is no such robot, or no exchange to reach it by.
        AgentLost: Its agent cannot be found.
    """
    wanted = [robot.name for robot in _named(config, names) or config.robot]
    if config.exchange == "local":
        raise ConfigurationError("Agents of another process are reached by redis or http only.")
    async with _hosted(config, (), None) as hosted:
        for name, handle in (await _find(hosted.client, wanted)).items():
            await RemoteAgent(name, handle, config.dead_after_s).pause(on)


def _named(config: FleetConfig, names: Collection[str]) -> list[RobotConfig]:
    known = {robot.name: robot for robot in config.robot}
    wrong = [name for name in names if name not in known]
    if wrong:
        raise ConfigurationError(f"No robot is called {wrong[0]!r}; there are {', '.join(known)}.")
    return [known[name] for name in names]


class _Hosted:
    def __init__(self, manager: Manager[Any]) -> None:
        self._manager = manager
        self.client = manager.exchange_client
        self.launched: list[tuple[str, Handle[Any]]] = []

    async def one_ended(self) -> None:
        """Wait until any agent launched here has ended."""
        agents = [handle for _, handle in self.launched]
        await self._manager.wait(agents, return_when=asyncio.FIRST_COMPLETED)


@contextlib.asynccontextmanager
async def _hosted(
    config: FleetConfig, robots: Collection[RobotConfig], make_agent: MakeAgent | None
) -> AsyncIterator[_Hosted]:
    make = make_agent or AegisAgent
    with json_only():
        try:
            manager = await Manager.from_exchange_factory(make_exchange(config.exchange))
        except ConfigurationError:
            raise
        except Exception as error:  # each kind of exchange has errors of its own
            raise ConfigurationError(
                f"The exchange {_public(config.exchange)} cannot be used: {error}"
            ) from None
        hosted = _Hosted(manager)
        try:
            for robot in robots:
                launched = await manager.launch(make(robot), config=JSON_ONLY, name=robot.name)
                hosted.launched.append((robot.name, _handle(launched.agent_id, hosted.client)))
            yield hosted
        finally:
            # What a dead agent died of, or an exchange that is gone: told already.
            with contextlib.suppress(Exception):
                async with manager:
                    pass


async def _find(client: Any, names: Collection[str]) -> dict[str, Handle[Any]]:
    """Handles of the agents of these robots, wherever they are."""
    found: dict[str, Handle[Any]] = {}
    until = asyncio.get_running_loop().time() + FIND_S
    while missing := sorted(set(names) - set(found)):
        handles = [_handle(uid, client) for uid in await client.discover(AegisAgent)]
        answers = await asyncio.gather(*(_robot_of(handle) for handle in handles))
        found |= {name: handle for name, handle in zip(answers, handles, strict=True) if name}
        if not set(names) - set(found):
            break
        if asyncio.get_running_loop().time() > until:
            raise AgentLost(
                f"Nobody serves the agent of {', '.join(missing)}. On its host: aegis-ot fleet "
                "serve --robots FILE, with the same exchange."
            )
        await asyncio.sleep(0.3)
    return found


async def _robot_of(handle: Handle[Any]) -> str:
    """Which robot an agent has; ``""`` of one that is dead."""
    try:
        status = await asyncio.wait_for(RemoteAgent("?", handle, 0.0).status(), _ANSWER_S)
    except (AgentLost, asyncio.TimeoutError):
        return ""
    return str(status["robot"])


def _handle(agent: Any, client: Any) -> Handle[Any]:
    """Agents are asked, and answer, in JSON; errors too."""
    json = SerializationStrategy.JSON
    return Handle(agent, exchange=client, request_serializer=json)


def _public(address: str) -> str:
    """An address without its password."""
    scheme, _, rest = address.partition("://")
    return f"{scheme}://{rest.rpartition('@')[2]}" if rest else address
