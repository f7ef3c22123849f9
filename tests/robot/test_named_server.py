"""The guard on a whole robot server, whichever ``AEGIS_OT_TEST_ROBOT`` names.

The server needs the package (on its ``PYTHONPATH``, or installed) and a left p300 of the second
generation (a Flex: a left one-channel p1000), simulated or real with nothing on the deck that
matters: the protocols move it. It has to reach this machine at ``AEGIS_OT_TEST_HOST`` (127.0.0.1
unless set). ``AEGIS_OT_TEST_ROBOT_TYPE`` is ``OT-2`` unless set, or ``Flex``.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from aegis_ot.robot import Analysis, RobotClient
from aegis_ot.robot.following import Completed, Step, follow

from ..runtime.fake_sidecar import FakeSidecar

ROBOT = os.environ.get("AEGIS_OT_TEST_ROBOT", "")
HOST = os.environ.get("AEGIS_OT_TEST_HOST", "127.0.0.1")
pytestmark = [
    pytest.mark.skipif(not ROBOT, reason="AEGIS_OT_TEST_ROBOT names no robot server"),
    pytest.mark.timeout(180),
]

FLEX = os.environ.get("AEGIS_OT_TEST_ROBOT_TYPE", "OT-2") == "Flex"
TEXT = """
from aegis_ot import guard
{head} = {{"apiLevel": "{level}"{robot}}}

@guard(assay="pcr", sidecar="{sidecar}", capture_timeout_s=6, watch_simulation={simulated})
def run(protocol):
    tips = protocol.load_labware("{tips}", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("{pipette}", "left", tip_racks=[tips])
{trash}{body}
"""
LEVEL = "2.18" if FLEX else "2.15"
DECK = {
    "head": "requirements" if FLEX else "metadata",
    "robot": ', "robotType": "Flex"' if FLEX else "",
    "tips": "opentrons_flex_96_tiprack_200ul" if FLEX else "opentrons_96_tiprack_300ul",
    "pipette": "flex_1channel_1000" if FLEX else "p300_single_gen2",
    "trash": '    protocol.load_trash_bin("A3")\n' if FLEX else "",
}
GOOD = '    pipette.transfer(50, plate.wells()[:3], plate.wells()[8:11], new_tip="always")'
BAD = """
    template, water, ntc = plate["A1"], plate["A2"], plate["H12"]
    pipette.pick_up_tip()
    pipette.transfer(40, template, plate["A3"], new_tip="never")
    pipette.transfer(40, water, ntc, new_tip="never")
    pipette.drop_tip()
"""


@pytest.fixture
def client() -> Iterator[RobotClient]:
    with RobotClient(ROBOT) as it:
        yield it


@pytest.fixture
def sidecar() -> Iterator[FakeSidecar]:
    with FakeSidecar() as server:
        yield server


@pytest.fixture
def upload(client: RobotClient, tmp_path: Path) -> Callable[..., str]:
    def put(sidecar: FakeSidecar, body: str = GOOD, level: str = LEVEL) -> str:
        # A name of its own for each test: the server keeps analyses by file.
        path = tmp_path / f"named_{time.time_ns()}.py"
        url = f"http://{HOST}:{sidecar.port}"
        path.write_text(
            TEXT.format(level=level, sidecar=url, body=body, simulated=level < "2.14", **DECK),
            encoding="utf-8",
        )
        return client.upload(path)[0]

    return put


def started(client: RobotClient, protocol: str) -> str:
    run = client.create_run(protocol)
    client.act(run, "play")
    return run


def until(condition: Callable[[], bool], seconds: float = 60.0) -> None:
    limit = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.05)


def ended(client: RobotClient, run: str) -> tuple[list[str], str]:
    """Types of the run's commands, and how it ended."""
    steps: list[Step] = list(follow(client, run))
    kinds = [step.command.kind for step in steps if isinstance(step, Completed)]
    return kinds, client.run(run).status


def analysed(client: RobotClient, protocol: str) -> Analysis:
    return client.analysis(protocol, 120)


def test_a_good_protocol_passes_its_analysis_and_does_the_same_live(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    protocol = upload(sidecar)
    analysis = analysed(client, protocol)
    assert analysis.ok, analysis.errors
    assert analysis.guard_words[-1].startswith("Layer 1: ")
    kinds, status = ended(client, started(client, protocol))
    assert status == "succeeded"
    assert tuple(kinds) == analysis.kinds
    (run,) = sidecar.keyframes
    assert len(sidecar.keyframes[run]) == 12


def test_a_bad_protocol_fails_its_analysis_with_the_line(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    protocol = upload(sidecar, BAD)
    analysis = analysed(client, protocol)
    assert not analysis.ok
    assert "ProtocolRejected [line 1" in analysis.errors[0]
    run = started(client, protocol)
    until(lambda: client.run(run).ended)
    assert client.run(run).status == "failed"
    assert {c.kind for c in client.commands(run, 0).commands} <= {
        "home",
        "comment",
        "loadLabware",
        "loadPipette",
    }


def test_a_failed_well_pauses_with_its_reason_and_play_goes_on(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    sidecar.outcomes[0] = "fail"
    run = started(client, upload(sidecar))
    until(lambda: client.run(run).status == "paused")
    first, *_, last = client.commands(run, 0).commands
    assert client.result(run, first.id) is not None
    assert last.kind == "waitForResume"
    assert "A2 of Corning 96 Well Plate" in last.message
    client.act(run, "play")
    assert ended(client, run)[1] == "succeeded"


def test_a_stop_in_a_hold_ends_at_once_and_the_next_run_starts(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    sidecar.outcomes[0] = None
    protocol = upload(sidecar)
    run = started(client, protocol)
    assert sidecar.asked.wait(60)
    client.health()  # the server answers during a hold
    client.act(run, "stop")
    until(lambda: client.run(run).ended)
    assert client.run(run).status == "stopped"
    sidecar.outcomes[0] = "pass"
    assert ended(client, started(client, protocol))[1] == "succeeded"


def test_an_operators_pause_waits_for_play(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    sidecar.outcomes[0] = None
    run = started(client, upload(sidecar))
    assert sidecar.asked.wait(60)
    client.act(run, "pause")
    sidecar.outcomes[0] = "pass"
    until(lambda: bool(sidecar.holds))
    assert client.run(run).status == "paused"
    client.act(run, "play")
    assert ended(client, run)[1] == "succeeded"


def test_a_sidecar_that_is_killed_and_comes_back_loses_nothing(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    sidecar.outcomes[1] = None
    run = started(client, upload(sidecar))
    until(lambda: any(len(found) == 8 for found in sidecar.keyframes.values()))
    sidecar.die()
    with FakeSidecar(port=sidecar.port) as reborn:
        reborn.keyframes = sidecar.keyframes
        assert ended(client, run)[1] == "succeeded"
        (frames,) = reborn.keyframes.values()
        assert [frame["sequence"] for frame in frames] == list(range(12))


@pytest.mark.skipif(FLEX, reason="a Flex takes no apiLevel below 2.15")
def test_an_old_protocol_tells_its_reason(
    client: RobotClient, sidecar: FakeSidecar, upload: Callable[..., str]
) -> None:
    # On simulated hardware a legacy protocol takes itself for a simulation: it comments.
    sidecar.outcomes[0] = "fail"
    run = started(client, upload(sidecar, level="2.13"))
    until(lambda: client.run(run).status == "paused" or client.run(run).ended)
    if not client.run(run).ended:
        client.act(run, "play")
    assert ended(client, run)[1] == "succeeded"
    said = [c.message for c in client.commands(run, 0).commands if c.is_guards]
    assert any("Delivery into A2" in text for text in said)
