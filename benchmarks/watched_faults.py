"""``python -m benchmarks.watched_faults [--runs 50] [--seed N]``: no watched run ends clean.

Runs of an unguarded protocol on Opentrons' own engine behind the robot's HTTP API, watched as
``aegis-ot watch`` watches them, with a sidecar over a socket. Each run has a planted fault: the
judge fails one well, drawn at random, every other time the last one; it takes its time, so that
verdicts come late, also after the run. Counted are the runs that end with exit status 0, those
whose failed well is not the one that was planted, and those whose report, page and sidecar
disagree. Exit status 1: there was one.
"""

from __future__ import annotations

import argparse
import logging
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aegis_ot.cli.robots import exit_code
from aegis_ot.robot import Analysis, RobotClient
from aegis_ot.robot.keyframe_times import PastLink
from aegis_ot.robot.run_report import run_report
from aegis_ot.robot.running import RobotRun
from aegis_ot.robot.verdicts import VerdictReader
from aegis_ot.robot.watching import WatchPolicies, await_run, watch_run
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from tests.robot.test_watching import SLOW, Shown
from tests.sidecar.helpers import StubAnalyser, StubCamera, StubRun
from tests.support.robot_server import RobotServer

WELLS = 4


class SlowJudge(StubAnalyser):
    """Takes up to so long for a verdict, s."""

    def __init__(self, fails: Sequence[int], longest_s: float, rng: random.Random) -> None:
        super().__init__(fails)
        self.longest_s, self.rng = longest_s, rng

    def begin(self, run: str, history: Any = ()) -> StubRun:
        """One for each run."""
        return _SlowRun(self, run)


class _SlowRun(StubRun):
    def judge(self, trajectory: int) -> Any:
        judge = self.analyser
        assert isinstance(judge, SlowJudge)
        time.sleep(judge.rng.uniform(0, judge.longest_s))
        return super().judge(trajectory)


def watched(struck: int, rng: random.Random, folder: Path) -> list[str]:
    """What is wrong with one watched run."""
    judge = SlowJudge([struck], rng.choice((0.0, 0.5, 3.0)), rng)
    config = SidecarConfig(port=0, data=folder / "sidecar")
    protocol = folder / "slow.py"
    protocol.write_text(SLOW, encoding="utf-8")
    with (
        RobotServer() as robot,
        RobotClient(robot.url) as client,
        running_sidecar(config, StubCamera(), judge) as url,
    ):
        client.act(client.create_run(client.upload(protocol)[0]), "play")
        run = RobotRun("slow.py", "robot", client.url, await_run(client), Analysis("", done=False))
        reader = VerdictReader(url, None)
        told = WatchPolicies(on_fail=rng.choice(("continue", "pause")))
        shown = Shown()
        shown.wants["The watch paused"] = "play"
        watch_run(client, run, PastLink(url, None), shown, told, reader, poll_s=0.05)
        reader.close()
    return list(_wrong(run, struck))


def _wrong(run: RobotRun, struck: int) -> list[str]:
    wrong = []
    if exit_code(run) == 0:
        wrong.append("ended clean")
    failed = [number for number, known in run.verdicts.items() if known.state == "fail"]
    if failed != [struck]:
        wrong.append(f"failed are {failed}")
    counts = run_report(run)["sidecar"]["counts"]
    if counts.get("fail") != 1 or counts.get("deliveries") != WELLS:
        wrong.append(f"the sidecar counts {counts}")
    if run.status != "succeeded":
        wrong.append(f"the run {run.status}")
    return wrong


def main(arguments: Sequence[str] | None = None) -> int:
    """Watch, and print what was found."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.watched_faults")
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args(arguments)
    logging.disable(logging.WARNING)
    wells: Counter[int] = Counter()
    bad = 0
    for number in range(asked.runs):
        rng = random.Random(f"{asked.seed} {number}")
        struck = WELLS - 1 if number % 2 else rng.randrange(WELLS)
        wells[struck] += 1
        with tempfile.TemporaryDirectory(prefix="aegis-ot-watched-") as folder:
            wrong = watched(struck, rng, Path(folder))
        bad += bool(wrong)
        if wrong:
            print(f"run {number}, fault in well {struck + 1}: {'; '.join(wrong)}", flush=True)
    by_well = ", ".join(f"{well + 1}: {count}" for well, count in sorted(wells.items()))
    print(f"{asked.runs} watched runs, faults by well {by_well}: {bad} wrong.")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
