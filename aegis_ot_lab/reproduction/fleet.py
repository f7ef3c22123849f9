"""The scaling sweep of a fleet (SI A)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from aegis_ot.errors import ConfigurationError

from ..evaluation.layer2.figures import COLOURS, Canvas
from .context import Context
from .experiment import Experiment, ExperimentOutcome, ExperimentPicture, Table, table

if TYPE_CHECKING:
    from ..fleet_scaling import Point

ROBOTS = (1, 2, 4, 8, 16)
LARGE = (64, 256)
SCALE = 10.0
"""The model's latency of 8 to 10 s is divided by this."""

LIVE = 2
"""Simulated robots on which both layers judge the workload."""

PAPER = {
    1: ("157.5", "1.00x"),
    2: ("86.0", "1.83x"),
    4: ("45.4", "3.47x"),
    8: ("29.2", "5.39x"),
    16: ("20.1", "7.84x"),
}


def run(context: Context) -> ExperimentOutcome:
    """Judge the workload live once, then play it back on ever more robots."""
    try:
        from ..fleet_scaling import judge_live, sweep, workload
    except ModuleNotFoundError as error:
        raise ConfigurationError(
            f"The fleet needs {error.name}: pip install 'aegis-ot[fleet]'."
        ) from None
    tasks = workload(context.options.seed)
    context.progress.begin("Fleet", 1 + len(ROBOTS) + len(LARGE))
    live = judge_live(tasks, LIVE)
    context.progress.step()
    points: list[Point] = []
    for robots in (*ROBOTS, *LARGE):
        rounds = max(robots // len(tasks), 1)
        points += sweep(tasks, live, (robots,), SCALE, rounds)
        context.progress.step()
    canvas = Canvas(context.pictures("fleet"), "simulated robots and frames, played back")
    canvas.draw("speed_up", lambda axes: _speed_up(axes, points[: len(ROBOTS)]))
    walls = ", ".join(f"{point.seconds * SCALE:.1f}" for point in points[: len(ROBOTS)])
    last = points[len(ROBOTS) - 1]
    detected = ", ".join(str(point.detected) for point in points[: len(ROBOTS)])
    return ExperimentOutcome(
        data=(f"simulated: robots, frames and model latency (8 to 10 s, divided by {SCALE:g})",),
        answers={
            "fleet": (
                f"N = 1, 2, 4, 8, 16: {walls} s (scaled back by {SCALE:g}); "
                f"{points[0].seconds / last.seconds:.2f}x at 16, bound "
                f"{last.alone_s / last.least_s:.2f}x; detected {detected} of {last.protocols}",
            )
        },
        tables=(_table(points),),
        pictures=(ExperimentPicture(context.picture(canvas.paths[0]), "Speed-up of the fleet"),),
        notes=(
            "Both layers judge the 16 protocols once, live; the sweep plays those results back "
            "through the fleet's agents and coordinator. The paper's wall times hold the work of "
            "its simulators too. `python -m benchmarks.fleet_scaling --scale 1` does not scale.",
            "64 and 256 robots have one protocol each: their speed-up is over the same protocols "
            "one after another.",
        ),
        figures={
            "detected": {str(point.robots): point.detected for point in points},
            "protocols": {str(point.robots): point.protocols for point in points},
            "bound_s": {str(point.robots): point.least_s for point in points},
        },
        timings={
            "wall_s": {str(point.robots): point.seconds for point in points},
            "cpu_s": {str(point.robots): point.cpu_s for point in points},
            "live_s": live.seconds,
        },
    )


def _table(points: Sequence[Point]) -> Table:
    rows = []
    for point in points:
        gain = _gain(points, point)
        paper = PAPER.get(point.robots, ("no counterpart", ""))
        rows.append(
            (
                point.robots,
                point.protocols,
                f"{point.seconds:.2f}",
                f"{gain:.2f}x",
                f"{gain / point.robots:.0%}",
                f"{point.least_s:.2f}",
                f"{point.detected}/{point.protocols}",
                paper[0],
                paper[1],
            )
        )
    header = ("robots", "protocols", "wall, s", "speed-up", "of ideal", "no schedule is shorter, s",
              "detected", "paper, wall, s", "paper, speed-up")  # fmt: skip
    return table(f"Wall time with the model's latency divided by {SCALE:g}", header, rows)


def _gain(points: Sequence[Point], point: Point) -> float:
    """Over one robot, measured where it was."""
    same = point.protocols == points[0].protocols
    return (points[0].seconds if same else point.alone_s) / point.seconds


def _speed_up(axes: Any, points: Sequence[Point]) -> None:
    robots = [point.robots for point in points]
    axes.plot(robots, robots, ls=":", c="#8a94a0", label="ideal")
    bounds = [point.alone_s / point.least_s for point in points]
    axes.plot(robots, bounds, ls="--", c=COLOURS[2], label="bound, whatever the schedule")
    gains = [_gain(points, point) for point in points]
    axes.plot(robots, gains, "o-", ms=4, color=COLOURS[0], label="measured")
    theirs = [float(PAPER[count][1].rstrip("x")) for count in robots]
    axes.plot(robots, theirs, "s-", ms=4, color=COLOURS[1], label="the paper")
    axes.set(xlabel="robots", ylabel="speed-up over one robot")
    axes.set_xticks(robots)
    axes.legend(loc="upper left")


EXPERIMENT = Experiment(
    "fleet", "Scaling of a fleet", "SI A, Table and Fig. fleet", ("fleet",), (), run
)
