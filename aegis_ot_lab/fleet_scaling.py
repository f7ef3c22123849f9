"""The scaling sweep of the paper (SI A): one workload on ever more simulated robots.

Both layers judge the workload once, on a small fleet of simulated robots. The sweep then plays
those results back through the same agents, exchange and coordinator: each protocol takes as long
as a model's answer would (8 to 10 s, as in the paper, divided by a stated factor) and no processor
time, so that what is measured is the fleet, not how many simulators share this machine's cores.
"""

from __future__ import annotations

import asyncio
import heapq
import random
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.dryrun import TRUSTING
from aegis_ot.fleet.agent import AegisAgent
from aegis_ot.fleet.config import FleetConfig, RobotConfig
from aegis_ot.fleet.coordinator import run_fleet
from aegis_ot.fleet.jobs import Job, JobNeeds
from aegis_ot.fleet.report import FleetReport
from aegis_ot.fleet.schedule import least_s
from aegis_ot.fleet.sessions import SimulatedSession, Watch
from aegis_ot.preflight.judging import Report
from aegis_ot.vocabulary import VerdictWord

LATENCY_S = (8.0, 10.0)
"""A model's answer in Layer 1 (paper, SI A), s."""

_DELIVERS = """
metadata = {{"apiLevel": "2.16"}}
def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "plate")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, "reservoir")
    tips = protocol.load_labware("opentrons_96_tiprack_{tips}ul", 3)
    pipette = protocol.load_instrument("{pipette}", "left", [tips])
    liquid = protocol.define_liquid("{liquid}", "", "#ff0000")
    reservoir["A1"].load_liquid(liquid, 12000)
    for well in plate.wells()[:8]:
        pipette.transfer({volume}, reservoir["A1"], well)
"""
_CONTAMINATES = """
from aegis_ot import guard
metadata = {{"apiLevel": "2.16"}}
@guard(assay="pcr", roles={{"ntc": ["1:{ntc}"], "template": ["2:A1"]}})
def run(protocol):
    plate = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 1)
    dna = protocol.load_labware("biorad_96_wellplate_200ul_pcr", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    pipette.pick_up_tip()
    pipette.transfer(30, dna["A1"], [plate["B1"], plate["{ntc}"]], new_tip="never")
    pipette.drop_tip()
"""
_OVERFILLS = """
metadata = {{"apiLevel": "2.16"}}
def run(protocol):
    plate = protocol.load_labware("{plate}", 1)
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2)
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    reservoir["A1"].load_liquid(protocol.define_liquid("buffer", "", "#0000ff"), 12000)
    for _ in range(3):
        pipette.transfer(200, reservoir["A1"], plate["A1"])
"""
_FAULTS = (
    *(("partial:50", liquid) for liquid in ("red dye", "yellow dye", "water")),
    ("no_aspirate", "red dye"),
    ("no_tip", "red dye"),
    ("", "red dye"),
)
_PIPETTES = (("p300_single_gen2", 300, 200), ("p1000_single_gen2", 1000, 400))


@dataclass(frozen=True)
class ScalingTask:
    """A protocol of the workload, and what the two layers should say of it.

    Attributes:
        job: The protocol, its faults planted.
        truth: ``"rejected"``, the well of a planted fault, or ``""`` where all is well.
    """

    job: Job
    truth: str

    def is_detected(self, outcome: str, flagged: Sequence[Mapping[str, Any]]) -> bool:
        """Whether the layers said just that, and of no other well anything."""
        if self.truth == "rejected":
            return outcome == "rejected"
        wells = [str(well["well"]).partition(" ")[0] for well in flagged]
        return outcome == "succeeded" and wells == ([self.truth] if self.truth else [])


@dataclass(frozen=True)
class Point:
    """One size of the fleet.

    Attributes:
        robots, protocols: How many.
        seconds: Wall time, s.
        alone_s: Of the same protocols one after the other, by their latencies, s.
        least_s: No schedule on so many robots is shorter, s.
        planned_s: The longest-first schedule without any overhead, s.
        cpu_s: Processor time of this process, s: what the fleet itself costs.
        detected: Protocols of which both layers said what they should.
    """

    robots: int
    protocols: int
    seconds: float
    alone_s: float
    least_s: float
    planned_s: float
    cpu_s: float
    detected: int


def workload(seed: int = 0) -> list[ScalingTask]:
    """16 protocols: 4 with an error of Layer 1, 10 with a planted fault, 2 without."""
    tasks = [
        _task(f"contaminates-{ntc}.py", _CONTAMINATES.format(ntc=ntc), "rejected")
        for ntc in ("A1", "H1")
    ]
    tasks += [
        _task(f"overfills-{number}.py", _OVERFILLS.format(plate=plate), "rejected")
        for number, plate in enumerate(
            ("corning_96_wellplate_360ul_flat", "biorad_96_wellplate_200ul_pcr")
        )
    ]
    rng = random.Random(seed)
    for pipette, tips, volume in _PIPETTES:
        for fault, liquid in _FAULTS:
            text = _DELIVERS.format(pipette=pipette, tips=tips, volume=volume, liquid=liquid)
            well = rng.choice(("C2", "D2"))  # after the six wells of the calibration
            name = f"{pipette[:5].strip('_')}-{fault or 'clean'}-{liquid}.py".replace(" ", "-")
            planted = (f"{fault}@1:{well}",) if fault else ()
            tasks.append(_task(name, text, well if fault else "", planted))
    return tasks


def _task(name: str, text: str, truth: str, faults: tuple[str, ...] = ()) -> ScalingTask:
    return ScalingTask(Job(name, Script(text, name), JobNeeds("OT-2"), 0.0, faults), truth)


def judge_live(tasks: Sequence[ScalingTask], robots: int = 2) -> FleetReport:
    """Both layers on every protocol, on so many simulated robots in this process."""

    def agent(robot: RobotConfig) -> AegisAgent:
        return AegisAgent(robot, session=SimulatedSession(robot.seed, TRUSTING))

    return asyncio.run(run_fleet(_robots(robots), [task.job for task in tasks], make_agent=agent))


def sweep(
    tasks: Sequence[ScalingTask],
    live: FleetReport,
    robots: Sequence[int],
    scale: float,
    rounds: int = 1,
) -> list[Point]:
    """Play a workload back on fleets of several sizes.

    Args:
        tasks: The workload.
        live: What both layers said of it.
        robots: Sizes of the fleet.
        scale: The model's latency is divided by this.
        rounds: The workload that many times over (weak scaling); 1: once.
    """
    results = {entry.job.name: dict(entry.result) for entry in live.entries}
    points = []
    for count in robots:
        many = [_copy(task, number) for number in range(rounds) for task in tasks]
        latencies = _latencies(many, scale)
        jobs = [
            Job(one.job.name, one.job.script, one.job.needs, latencies[one.job.name])
            for one in many
        ]

        def agent(robot: RobotConfig, latencies: Mapping[str, float] = latencies) -> AegisAgent:
            return AegisAgent(robot, _answers_after(latencies), _Playback(results))

        cpu = time.process_time()
        report = asyncio.run(run_fleet(_robots(count), jobs, make_agent=agent))
        cpu = time.process_time() - cpu
        times = list(latencies.values())
        detected = sum(
            one.is_detected(entry.outcome, entry.flagged)
            for one, entry in zip(many, report.entries, strict=True)
        )
        points.append(
            Point(
                count, len(jobs), report.seconds, sum(times), least_s(times, count),
                longest_first_s(times, count), cpu, detected,
            )
        )  # fmt: skip
    return points


def _robots(count: int) -> FleetConfig:
    return FleetConfig(robot=tuple(RobotConfig(name=f"robot-{n + 1}") for n in range(count)))


def _copy(task: ScalingTask, number: int) -> ScalingTask:
    if number == 0:
        return task
    name = f"{task.job.name}#{number}"
    script = Script(task.job.script.text, name)
    return ScalingTask(Job(name, script, task.job.needs, 0.0, task.job.faults), task.truth)


def _latencies(tasks: Sequence[ScalingTask], scale: float) -> dict[str, float]:
    """Of a model's answer on each protocol, s; the same whatever the fleet."""
    return {
        task.job.name: random.Random(task.job.name).uniform(*LATENCY_S) / scale for task in tasks
    }


def _answers_after(latencies: Mapping[str, float]) -> Any:
    """A Layer 1 that takes as long as a model does; what it says is played back with the rest."""

    def validator(script: Script) -> Report:
        time.sleep(latencies[script.file_name])
        return Report(script.file_name, "", VerdictWord.PASS, (), ())

    return validator


class _Playback:
    """A session that plays back what both layers said before."""

    def __init__(self, results: Mapping[str, dict[str, Any]]) -> None:
        self._results = results

    def run(self, job: Job, watch: Watch) -> dict[str, Any]:
        watch.ask_leave()
        watch.go_on()
        return self._results[job.name.partition("#")[0]]


def longest_first_s(durations: Sequence[float], robots: int) -> float:
    """How long the longest-first schedule takes on so many equal robots, s.

    At most 4/3 - 1/(3 robots) of the best (Graham 1969, SIAM J. Appl. Math. 17, 416).
    """
    free = [0.0] * robots
    for duration in sorted(durations, reverse=True):
        heapq.heapreplace(free, free[0] + duration)
    return max(free)
