"""Two hosts on loopback: agents served by a process of their own, found through an exchange."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from academy.exception import AcademyRemoteError
from academy.handle import Handle
from academy.serialize import SerializationStrategy
from redis import Redis

from aegis_ot.errors import AgentLost, ConfigurationError
from aegis_ot.fleet import FleetConfig, hosting, read_job, run_fleet, serve_agents
from aegis_ot.fleet.coordinator import FleetScreen

from ..cli.commands import Command

AEGIS = [sys.executable, "-c", "from aegis_ot.cli import main; main()"]
START_S = 60.0
PROTOCOL = """
metadata = {{"apiLevel": "2.15"}}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_{tips}ul", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "plate")
    pipette = protocol.load_instrument("{pipette}", "left", [tips])
    pipette.transfer(150, plate["A1"], plate["B1"])
"""


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


@contextlib.contextmanager
def process(*arguments: str, port: int | None = None, says: str = "") -> Iterator[subprocess.Popen]:
    """A program, once it listens at a port or says that it is ready."""
    running = subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True)
    try:
        if says:
            assert says in running.stdout.readline()
        until = time.monotonic() + START_S
        while port is not None:
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1):
                break
            assert running.poll() is None
            assert time.monotonic() < until
            time.sleep(0.05)
        yield running
    finally:
        running.kill()
        running.wait(60)
        running.stdout.close()


@pytest.fixture(params=["redis", "http"])
def exchange(request: pytest.FixtureRequest) -> Iterator[str]:
    port = free_port()
    if request.param == "http":
        with process(*AEGIS, "fleet", "exchange", "--port", str(port), port=port):
            yield f"http://127.0.0.1:{port}"
        return
    server = shutil.which("redis-server")
    if server is None:
        pytest.skip("There is no redis-server here (Debian: apt-get install redis-server).")
    options = ("--port", str(port), "--bind", "127.0.0.1", "--save", "", "--appendonly", "no")
    with process(server, *options, "--requirepass", "secret", port=port):
        yield f"redis://:secret@127.0.0.1:{port}"


@pytest.fixture
def robots(tmp_path: Path, exchange: str) -> Path:
    path = tmp_path / "fleet.toml"
    path.write_text(
        f'exchange = "{exchange}"\ndead_after_s = 60\n'
        '[[robot]]\nname = "here"\npipettes = {left = "p300_single_gen2"}\n'
        '[[robot]]\nname = "there"\nremote = true\npipettes = {left = "p1000_single_gen2"}\n'
        '[[robot]]\nname = "spare"\npipettes = {left = "p1000_single_gen2"}\n'
    )
    return path


@pytest.fixture
def protocols(tmp_path: Path) -> list[Path]:
    found = []
    for pipette, tips in (("p300_single_gen2", 300), ("p1000_single_gen2", 1000)):
        found.append(tmp_path / f"{pipette}.py")
        found[-1].write_text(PROTOCOL.format(pipette=pipette, tips=tips))
    return found


def test_two_hosts_run_one_fleet(
    aegis: Command, robots: Path, protocols: list[Path], tmp_path: Path
) -> None:
    robots.write_text(robots.read_text().partition('[[robot]]\nname = "spare"')[0])
    report = tmp_path / "reports" / "fleet.html"
    with process(*AEGIS, "fleet", "serve", "--robots", str(robots), says="Serving there"):
        done = aegis("fleet", "run", "--robots", robots, "--report", report, *protocols)
    assert done.code == 0, done.out + done.err
    told = json.loads(report.with_suffix(".json").read_text())
    assert {one["name"]: one["robot"] for one in told["protocols"]} == {
        "p300_single_gen2.py": "here",
        "p1000_single_gen2.py": "there",
    }
    assert all(one["outcome"] == "succeeded" for one in told["protocols"])
    assert all(one["counts"]["wells"] == 1 for one in told["protocols"])
    page = report.read_text()
    assert "p1000_single_gen2.py" in page
    assert "secret" not in page + done.out + done.err


@pytest.mark.parametrize("exchange", ["redis"], indirect=True)
def test_a_host_that_dies_loses_nothing_that_had_not_begun(
    robots: Path, protocols: list[Path]
) -> None:
    robots.write_text(robots.read_text().replace("dead_after_s = 60", "dead_after_s = 6"))
    config = FleetConfig.load(robots, {})
    jobs = [read_job(path) for path in protocols]

    class Killing(FleetScreen):
        def stands(self, robot, status):
            if robot == "there" and status["state"] == "checking":
                os.kill(host.pid, signal.SIGKILL)

    busy = [jobs[1]] * 2  # one for each of "there" and "spare"
    with process(*AEGIS, "fleet", "serve", "--robots", str(robots), says="Serving there") as host:
        report = asyncio.run(asyncio.wait_for(run_fleet(config, busy, Killing()), 100))
    assert set(report.lost) == {"there"}
    assert [entry.outcome for entry in report.entries] == ["succeeded"] * 2
    assert [entry.robot for entry in report.entries] == ["spare"] * 2
    assert sorted(entry.lost_on for entry in report.entries) == [[], ["there"]]


@pytest.mark.parametrize("exchange", ["redis"], indirect=True)
def test_a_host_that_nobody_serves_is_told(
    robots: Path, protocols: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hosting, "FIND_S", 0.5)
    with pytest.raises(AgentLost, match="Nobody serves the agent of there"):
        asyncio.run(run_fleet(FleetConfig.load(robots, {}), [read_job(protocols[0])]))


@pytest.mark.parametrize("exchange", ["redis"], indirect=True)
def test_robots_are_held_and_released_from_another_terminal(robots: Path) -> None:
    async def pause(*more: str) -> None:
        arguments = ("fleet", "pause", "--robots", str(robots), "--robot", "there", *more)
        done = await asyncio.create_subprocess_exec(*AEGIS, *arguments)
        assert await done.wait() == 0

    async def talk() -> list[bool]:
        held = []
        async with hosting.agents_of(FleetConfig.load(robots, {})) as agents:
            for more in ((), ("--release",)):
                await pause(*more)
                held.append((await agents["there"].status())["held"])
        return held

    with process(*AEGIS, "fleet", "serve", "--robots", str(robots), says="Serving there"):
        assert asyncio.run(asyncio.wait_for(talk(), 100)) == [True, False]


@pytest.mark.parametrize("exchange", ["redis"], indirect=True)
def test_agents_whose_exchange_goes_away_say_so(robots: Path, exchange: str) -> None:
    port = int(exchange.rpartition(":")[2])
    with process(*AEGIS, "fleet", "serve", "--robots", str(robots), says="Serving there") as host:
        with Redis(port=port, password="secret") as redis:
            redis.shutdown(nosave=True)
        assert host.wait(START_S) == 2


class Bomb:
    """A pickle that makes a file where it is read."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self):
        return Path.touch, (self.path,)


@pytest.mark.parametrize("exchange", ["redis"], indirect=True)
def test_an_agent_reads_no_pickle(robots: Path, exchange: str, tmp_path: Path) -> None:
    bomb = tmp_path / "bomb"

    async def send() -> None:
        config = FleetConfig(exchange=exchange, robot=[{"name": "here"}])
        async with hosting.agents_of(config) as agents:
            to = agents["here"]._handle
            pickling = Handle(
                to.agent_id,
                exchange=to.exchange,
                request_serializer=SerializationStrategy.PICKLE,
                result_serializer=SerializationStrategy.JSON,
            )
            with pytest.raises(AcademyRemoteError, match="Prohibited"):
                await pickling.action("status", Bomb(bomb))

    asyncio.run(asyncio.wait_for(send(), START_S))
    assert not bomb.exists()


def test_an_exchange_that_is_not_there_is_one_sentence(aegis: Command, tmp_path: Path) -> None:
    path = tmp_path / "fleet.toml"
    path.write_text(f'exchange = "redis://:secret@127.0.0.1:{free_port()}"\n[[robot]]\nname="a"\n')
    protocol = tmp_path / "empty.py"
    protocol.write_text('metadata = {"apiLevel": "2.15"}\ndef run(protocol):\n    pass\n')
    done = aegis("fleet", "run", "--robots", path, protocol)
    assert done.code == 2
    assert "cannot be used" in done.err
    assert "secret" not in done.err
    assert "Traceback" not in done.err


def test_serving_needs_robots_to_serve() -> None:
    config = FleetConfig(robot=[{"name": "a"}])
    with pytest.raises(ConfigurationError, match="remote = true"):
        asyncio.run(serve_agents(config))
    with pytest.raises(ConfigurationError, match="No robot is called 'b'"):
        asyncio.run(serve_agents(config, ["b"]))
