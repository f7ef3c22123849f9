"""The robot of the drill: a guarded run on Opentrons' own engine, and what it was told."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any
from unittest import mock

from aegis_ot.runtime import page_answers
from aegis_ot.runtime.sidecar_client import Acknowledgement, SidecarClient
from aegis_ot.settings import Settings
from aegis_ot.vocabulary import Keyframe, Verdict
from tests.runtime.live import LiveRun
from tests.runtime.test_page_answers import RobotServer

PATIENCE_S = 300.0
"""A run that takes longer hangs."""


@dataclass
class Acknowledged:
    """What the sidecar has told the robot that it has, or that is so.

    Attributes:
        triggers: When the robot stood still for a keyframe, ``time.monotonic``, s.
        keyframes: Sequence numbers.
        verdicts: Outcome by trajectory, as told first.
        holds: Trajectories whose hold was reported.
        finished: The outcome of the run, once it was taken.
    """

    triggers: dict[int, float] = field(default_factory=dict)
    keyframes: set[int] = field(default_factory=set)
    verdicts: dict[int, str] = field(default_factory=dict)
    holds: set[int] = field(default_factory=set)
    finished: str = ""


@dataclass
class Robot:
    """One guarded run.

    Args:
        run: Its identifier.
        url: Of the sidecar, as the robot knows it.
        wells: How many it fills.
        show: Told of each keyframe before it is sent: what the camera sees from now on.
        more: Settings of the guard.
        text: The protocol, where it is not :func:`fill` under Layer 2 alone.
    """

    run: str
    url: str
    wells: int
    show: Callable[[Keyframe], None]
    more: dict[str, Any]
    text: str = ""
    told: Acknowledged = field(default_factory=Acknowledged)
    clock_ahead_s: float = 0.0
    pauses: int = 0
    commands: list[Any] = field(default_factory=list)

    def play(self, step: Callable[[int], None], may_resume: Callable[[], bool]) -> str:
        """Run to the end.

        Args:
            step: Called again and again with how many keyframes are acknowledged.
            may_resume: Whether the operator, who stands before a paused robot, resumes it.

        Returns:
            How the run failed; empty if it did not.
        """
        settings = Settings(sidecar=self.url, run_id=self.run, **self.more)
        began = time.monotonic()
        with self._recorded(), robot_server() as server:
            live = LiveRun(self._protocol(), settings)
            server.run = live
            live.start()
            if self.text:
                live.play()
            paused = False
            while live._thread.is_alive():
                if time.monotonic() - began > PATIENCE_S:
                    live.stop()
                    return f"hung after {len(self.told.keyframes)} keyframes, {live.status}"
                step(len(self.told.keyframes))
                now = live.status == "paused"
                self.pauses += now and not paused
                if now and may_resume():
                    live.play()
                paused = now
                time.sleep(0.02)
            try:
                self.commands = live.join().commands
            except BaseException as error:
                return f"{type(error).__name__}: {error}"
        return "" if live.error is None else f"{type(live.error).__name__}: {live.error}"

    def _protocol(self) -> Callable[[Any], None] | str:
        if not self.text:
            return lambda protocol: fill(protocol, self.wells)
        given = {"sidecar": self.url, "run_id": self.run, **self.more}
        settings = ", ".join(f"{name}={value!r}" for name, value in given.items())
        return self.text.format(settings=settings, wells=self.wells)

    @contextlib.contextmanager
    def _recorded(self) -> Iterator[None]:
        """Note what the link hears, and move the robot's clock and picture."""
        told = self.told
        keyframe, verdict = SidecarClient.keyframe, SidecarClient.verdict
        report, finish = SidecarClient.report, SidecarClient.finish

        def sent(link: SidecarClient, frame: Keyframe, *rest: Any) -> Acknowledgement:
            told.triggers.setdefault(frame.sequence, time.monotonic())
            self.show(frame)
            ahead = replace(frame, robot_time=frame.robot_time + self.clock_ahead_s)
            captured = keyframe(link, ahead, *rest)
            told.keyframes.add(frame.sequence)
            return captured

        def asked(link: SidecarClient, run: str, number: int, *rest: Any) -> Verdict | None:
            found = verdict(link, run, number, *rest)
            if found is not None:
                told.verdicts.setdefault(number, found.outcome.value)
            return found

        def reported(link: SidecarClient, run: str, what: str, body: Any, most: float) -> None:
            report(link, run, what, body, most)
            if what == "hold":
                told.holds.add(body["trajectory"])

        def ended(link: SidecarClient, run: str, outcome: str, *rest: Any) -> None:
            finish(link, run, outcome, *rest)
            told.finished = outcome

        with mock.patch.multiple(
            SidecarClient, keyframe=sent, verdict=asked, report=reported, finish=ended
        ):
            yield


@contextlib.contextmanager
def robot_server() -> Iterator[RobotServer]:
    """The robot's own HTTP server, by which its page answers are carried out."""
    server = RobotServer()
    threading.Thread(target=server.server.serve_forever, args=(0.05,), daemon=True).start()
    host, port = server.server.server_address[:2]
    try:
        with mock.patch.object(page_answers, "ROBOT_SERVER", f"http://{host}:{port}"):
            yield server
    finally:
        server.server.shutdown()
        server.server.server_close()


OTHERWISE = """
from aegis_ot import guard
metadata = {{"apiLevel": "2.15"}}

@guard({settings})
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    source = protocol.load_labware("nest_12_reservoir_15ml", "2")["A1"]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3")
    dye = protocol.define_liquid(name="red dye", description="", display_color="#FF0000")
    source.load_liquid(liquid=dye, volume=14_000)
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    wells = plate.wells()[:{wells}]
    if not protocol.is_simulating():
        wells.reverse()
    pipette.transfer(100, source, wells, new_tip="always")
"""
"""The same, in another order than in its rehearsal."""


def fill(protocol: Any, wells: int) -> None:
    """The protocol: 100 µL of a dye into each well, with a new tip."""
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    source = protocol.load_labware("nest_12_reservoir_15ml", "2")["A1"]
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3")
    dye = protocol.define_liquid(name="red dye", description="", display_color="#FF0000")
    source.load_liquid(liquid=dye, volume=14_000)
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    pipette.transfer(100, source, plate.wells()[:wells], new_tip="always")
