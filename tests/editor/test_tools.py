"""``aegis-ot mcp``, driven by the MCP SDK's own client over stdio."""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from aegis_ot.sidecar.store import Store
from tests.cli.test_check_command import protocol
from tests.robot.protocols import GOOD
from tests.sidecar.test_store import fill
from tests.support.robot_server import RobotServer

pytest.importorskip("pydantic")
if "mcp.server.fastmcp" not in sys.modules:  # the SDK's server half, which no client needs
    half = ModuleType("mcp.server.fastmcp")
    half.FastMCP = half.Context = object  # type: ignore[attr-defined]
    sys.modules["mcp.server.fastmcp"] = half
pytest.importorskip("mcp", reason="the MCP SDK is not installed: extra dev")

from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client


class Agent:
    """A session, and its answers as they are read."""

    def __init__(self, session: ClientSession) -> None:
        self._session = session

    async def names(self) -> set[str]:
        return {tool.name for tool in (await self._session.list_tools()).tools}

    async def asks(self, tool: str, **arguments: Any) -> tuple[Any, bool]:
        """What a tool says, and whether that is an error."""
        answer = await self._session.call_tool(tool, arguments)
        text = answer.content[0].text  # type: ignore[union-attr]
        return (text if answer.isError or tool == "explain" else json.loads(text)), answer.isError


def serve(use: Callable[[Agent], Awaitable[None]], *options: str) -> None:
    server = StdioServerParameters(command=sys.executable, args=["-m", "aegis_ot", "mcp", *options])

    async def session() -> None:
        async with stdio_client(server) as streams, ClientSession(*streams) as connected:
            assert (await connected.initialize()).serverInfo.name == "aegis-ot"
            await connected.send_ping()
            await use(Agent(connected))

    asyncio.run(session())


@pytest.mark.timeout(300)
def test_an_agent_checks_explains_simulates_and_looks_at_runs(tmp_path: Path) -> None:
    bad = protocol(tmp_path / "bad.py", tips="once")
    store = Store(tmp_path / "data")
    fill(store, "pcr", 40)
    store.close()

    async def use(agent: Agent) -> None:
        assert await agent.names() == {"check", "explain", "rules", "simulate", "runs", "run"}
        told, _ = await agent.asks("check", path=str(bad))
        assert told["verdict"] == "fail"
        assert [one["rule"] for one in told["findings"]] == ["PCR-3"]
        assert (
            '+    p20.transfer(5, templates, reactions, new_tip="always")'
            in told["mends"][0]["patch"]
        )
        mended = bad.read_text(encoding="utf-8").replace('"once"', '"always"')
        told, _ = await agent.asks("check", path=str(bad), text=mended)
        assert told["verdict"] == "pass"
        assert "Fix:" in (await agent.asks("explain", rule="pcr-3"))[0]
        assert {"id", "demands"} <= set((await agent.asks("rules"))[0][0])
        (run,), _ = await agent.asks("runs")
        assert (await agent.asks("run", run=run["run"]))[0]["counts"]
        told, is_error = await agent.asks("run", run="none")
        assert is_error
        assert "holds no run 'none'" in told
        demo = str(Path(__file__).parents[2] / "examples" / "demo" / "hello_guard.py")
        told, _ = await agent.asks("simulate", path=demo, faults=["partial:50@B1"])
        assert told["frames"] == "simulated"
        assert [one["address"] for one in told["wells"] if one["outcome"] == "fail"] == ["3:B1"]
        told, is_error = await agent.asks("simulate", path=demo, faults=["no_dispense@H12"])
        assert is_error
        assert "H12" in told

    serve(use, "--data", str(tmp_path / "data"))


@pytest.mark.timeout(300)
def test_a_run_is_started_only_where_the_person_allows_it_and_layer_1_passes(
    tmp_path: Path,
) -> None:
    good, bad = tmp_path / "good.py", protocol(tmp_path / "bad.py", tips="once")
    good.write_text(GOOD, encoding="utf-8")
    with RobotServer() as robot:

        async def use(agent: Agent) -> None:
            released = {"play", "resume", "answer", "release", "decide", "continue", "confirm"}
            names = await agent.names()
            assert names >= {"start_run", "started_run"}
            assert not any(word in name for name in names for word in released)
            told, is_error = await agent.asks("start_run", path=str(bad), robot=robot.url)
            assert is_error
            assert "Nothing was started" in told
            told, is_error = await agent.asks("start_run", path=str(good), robot="10.0.0.1")
            assert is_error
            assert robot.runs == {}
            begun, _ = await agent.asks("start_run", path=str(good), robot=robot.url)
            state: dict[str, Any] = {"exit_code": None}
            while state["exit_code"] is None:
                state, _ = await agent.asks("started_run", id=begun["id"])
            assert state["exit_code"] == 0, state
            assert len(robot.runs) == 1

        serve(use, "--may-start-on", robot.url)
