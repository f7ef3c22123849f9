"""A fleet in one process: real agents on Academy's local exchange; the robots obey the tests."""

from __future__ import annotations

import asyncio
import threading

import pytest

from aegis_ot.errors import ConfigurationError, RehearsalError, RobotUnreachable, RunAborted
from aegis_ot.fleet import run_fleet
from aegis_ot.fleet.agent import AegisAgent
from aegis_ot.fleet.exchange import make_exchange
from aegis_ot.fleet.hosting import agents_of
from aegis_ot.fleet.remote import pack_error, unpack_error

from .support import PIPETTES, RESULT, Heard, Robot, fleet, job, passed, run

LIMIT_S = 60.0


def outcomes(report):
    return {entry.job.name: entry.outcome for entry in report.entries}


def test_one_robot_runs_the_longest_first_and_one_at_a_time():
    robot, heard = Robot(), Heard()
    report = run(fleet({"name": "a"}), [job("s", 1), job("l", 9), job("m", 5)], {"a": robot}, heard)
    assert robot.ran == ["l", "m", "s"] == heard.order
    assert robot.at_once == 1
    assert set(outcomes(report).values()) == {"succeeded"}
    assert not report.lost


def test_robots_run_at_the_same_time():
    both = threading.Barrier(2, timeout=LIMIT_S)
    robots = {name: Robot(lambda job, watch: both.wait()) for name in "ab"}
    report = run(fleet({"name": "a"}, {"name": "b"}), [job("x"), job("y")], robots)
    assert outcomes(report) == {"x": "succeeded", "y": "succeeded"}


def test_protocols_go_where_they_can_run():
    robots = {"a": Robot(), "b": Robot()}
    jobs = [job("p300", pipettes=PIPETTES), job("flex", robot_type="Flex"), job("any")]
    config = fleet({"name": "a", "pipettes": PIPETTES}, {"name": "b"})
    report = run(config, jobs, robots)
    assert outcomes(report) == {"p300": "succeeded", "flex": "not run", "any": "succeeded"}
    assert "p300" in robots["a"].ran
    assert "it is an OT-2, not a Flex" in report.entries[1].detail
    assert report.entries[1].robot == ""


def test_the_same_file_twice_is_two_jobs():
    report = run(fleet({"name": "a"}), [job("x"), job("x")], {"a": Robot()})
    assert outcomes(report) == {"x": "succeeded", "x (2)": "succeeded"}


class Dying(Robot):
    """A robot whose agent is shut down at a moment of the run."""

    def __init__(self, agents, after_leave: bool) -> None:
        super().__init__()
        self.agents, self.after_leave = agents, after_leave

    def run(self, job, watch):
        self.ran.append(job.name)
        if self.after_leave:
            watch.ask_leave()
        agent = self.agents["dying"]
        agent._loop.call_soon_threadsafe(agent.agent_shutdown)
        while True:  # until it is told to stop at its next move
            watch.go_on()


@pytest.mark.parametrize("after_leave", [False, True])
def test_a_dead_agents_protocol_is_given_on_only_if_no_liquid_moved(after_leave):
    agents = {}
    dying, other = Dying(agents, after_leave), Robot()
    config = fleet({"name": "dying", "pipettes": PIPETTES}, {"name": "other", "pipettes": PIPETTES})
    held = threading.Event()
    other.does = lambda job, watch: held.wait(1) if job.name == "short" else None
    jobs = [job("long", 9, pipettes=PIPETTES), job("short", 1, pipettes=PIPETTES)]
    report = run(config, jobs, {"dying": dying, "other": other}, agents=agents)
    (long, short) = report.entries
    assert short.outcome == "succeeded"
    assert set(report.lost) == {"dying"}
    assert dying.ran == ["long"]
    if after_leave:
        assert long.outcome == "lost"
        assert "look at dying" in long.detail
        assert other.ran == ["short"]
    else:
        assert (long.outcome, long.robot, long.lost_on) == ("succeeded", "other", ["dying"])


def test_a_robot_that_cannot_be_reached_is_out_and_its_protocol_given_on():
    was_asked = threading.Event()

    class Away(Robot):
        def run(self, job, watch):
            was_asked.set()
            raise RobotUnreachable("The robot gave no answer.")

    robots = {"away": Away(), "here": Robot(lambda job, watch: was_asked.wait(LIMIT_S))}
    report = run(fleet({"name": "away"}, {"name": "here"}), [job("x", 2), job("y")], robots)
    assert set(outcomes(report).values()) == {"succeeded"}
    assert report.lost == {"away": "The robot gave no answer."}


def test_without_a_robot_left_the_rest_is_not_run():
    class Away(Robot):
        def run(self, job, watch):
            raise RobotUnreachable("The robot gave no answer.")

    report = run(fleet({"name": "a"}), [job("x"), job("y")], {"a": Away()})
    assert outcomes(report) == {"x": "not run", "y": "not run"}


def test_a_protocols_own_failure_leaves_the_robot_in():
    def fail(job, watch):
        if job.name == "bad":
            raise RehearsalError("It raised.", 7)

    report = run(fleet({"name": "a"}), [job("bad", 2), job("good")], {"a": Robot(fail)})
    assert outcomes(report) == {"bad": "failed", "good": "succeeded"}
    assert report.entries[0].detail == "It raised."


def test_an_agent_that_breaks_down_is_out():
    def broken(job, watch):
        raise KeyError("bug")

    report = run(fleet({"name": "a"}), [job("x"), job("y")], {"a": Robot(broken)})
    assert outcomes(report) == {"x": "lost", "y": "not run"}  # liquid may have moved
    assert "KeyError" in report.lost["a"]


def test_a_held_robot_moves_again_only_when_it_may():
    seen = []
    agents = {}

    def hold(job, watch):
        agent = agents["a"]
        asyncio.run_coroutine_threadsafe(agent.pause(True), agent._loop).result(LIMIT_S)
        timer = threading.Timer(0.3, release, [agent])
        timer.start()
        watch.go_on()
        seen.append("moved")

    def release(agent):
        seen.append("released")
        asyncio.run_coroutine_threadsafe(agent.pause(False), agent._loop).result(LIMIT_S)

    report = run(fleet({"name": "a"}), [job("x")], {"a": Robot(hold)}, agents=agents)
    assert seen == ["released", "moved"]
    assert outcomes(report) == {"x": "succeeded"}


def test_an_agent_is_asked_held_and_reports_through_its_exchange():
    class Plain:
        def run(self, job, watch):
            return dict(RESULT)

    async def talk():
        def make(robot):
            return AegisAgent(robot, lambda script: passed(), Plain())

        async with agents_of(fleet({"name": "a"}), make) as agents:
            agent = agents["a"]
            await agent.process(job("x").to_wire())
            await agent.pause(True)
            status = await agent.status()
            with pytest.raises(ConfigurationError, match="a lacks p300_single_gen2 on the left"):
                await agent.process(job("y", pipettes=PIPETTES).to_wire())
            return status, await agent.report()

    status, report = asyncio.run(asyncio.wait_for(talk(), LIMIT_S))
    assert (status["robot"], status["state"], status["held"]) == ("a", "idle", True)
    assert [(one["job"], one.get("outcome"), one.get("error")) for one in report] == [
        ("x", "succeeded", None),
        ("y", None, "ConfigurationError"),
    ]


def test_a_fleet_that_is_broken_off_stops_its_robots_and_reports():
    running, stopped = threading.Event(), threading.Event()

    class Endless(Robot):
        def run(self, job, watch):
            watch.ask_leave()
            running.set()
            try:
                while True:
                    watch.go_on()
            except RunAborted:
                stopped.set()
                raise

    async def break_off():
        config = fleet({"name": "a"})

        def make(robot):
            return AegisAgent(robot, lambda script: passed(), Endless())

        task = asyncio.ensure_future(run_fleet(config, [job("x"), job("y")], None, make))
        await asyncio.to_thread(running.wait, LIMIT_S)
        task.cancel()
        return await task

    report = asyncio.run(break_off())
    assert report.broken_off
    assert outcomes(report) == {"x": "broken off", "y": "not run"}
    assert stopped.wait(LIMIT_S)


@pytest.mark.parametrize(
    "error", [RehearsalError("no", 3), RobotUnreachable("away"), ConfigurationError("so not")]
)
def test_errors_keep_their_type_across_the_wire(error):
    found = unpack_error(pack_error(error))
    assert type(found) is type(error)
    assert str(found) == str(error)
    assert getattr(found, "line", None) == getattr(error, "line", None)


@pytest.mark.parametrize("address", ["", "ftp://h:1", "redis://", "http://", "redis://h:port"])
def test_an_unknown_exchange_is_told(address):
    with pytest.raises(ConfigurationError, match="none of"):
        make_exchange(address)


def test_listening_at_redis_has_no_time_limit():
    # Redis clients from 8 on give a silent exchange up within a minute, and the agent ends.
    exchange = make_exchange("rediss://me:secret@h:7")
    assert exchange.redis_info.kwargs == {
        "username": "me",
        "password": "secret",
        "ssl": True,
        "socket_timeout": None,
    }


def test_the_hosted_exchange_is_refused():
    from academy.exchange.cloud.client import DEFAULT_EXCHANGE_URL

    with pytest.raises(ConfigurationError, match="hosted exchange"):
        make_exchange(DEFAULT_EXCHANGE_URL)
