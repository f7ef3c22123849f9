"""The scaling sweep of the paper's SI A: ``python -m benchmarks.fleet_scaling [--json OUT]
[--scale 10] [--live N]``.

Simulated robots, simulated frames. Prints what both layers detect on the workload (judged live,
on N simulated robots), then the sweep, then larger fleets with one protocol for each robot.
"""

from __future__ import annotations

import argparse
import json
import logging
import os
from dataclasses import asdict
from pathlib import Path

from aegis_ot_lab.fleet_scaling import Point, judge_live, sweep, workload

ROBOTS = (1, 2, 4, 8, 16)
LARGE = (64, 256)


def main() -> None:
    """Run the sweep and print it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fleet_scaling", description=__doc__)
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument("--scale", type=float, default=10.0, help="divides the model's latency")
    parser.add_argument("--live", type=int, default=2, help="simulated robots that judge it live")
    asked = parser.parse_args()
    logging.getLogger("opentrons").setLevel(logging.ERROR)
    tasks = workload()
    live = judge_live(tasks, asked.live)
    found = [
        task.is_detected(entry.outcome, entry.flagged)
        for task, entry in zip(tasks, live.entries, strict=True)
    ]
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; simulated robots and frames.")
    print(
        f"Both layers live on {asked.live} robots: {sum(found)}/{len(tasks)} as planted, "
        f"{live.seconds:.0f} s."
    )
    for task, entry, right in zip(tasks, live.entries, found, strict=True):
        if not right:
            said = [str(well["well"]).partition(" ")[0] for well in entry.flagged]
            print(f"  {task.job.name}: planted {task.truth or 'nothing'}, {entry.outcome}, {said}")
    points = sweep(tasks, live, ROBOTS, asked.scale)
    _show(points, asked.scale)
    large = [sweep(tasks, live, (n,), asked.scale, rounds=n // 16)[0] for n in LARGE]
    _show(large, asked.scale)
    if asked.json:
        rows = [asdict(point) for point in (*points, *large)]
        asked.json.write_text(json.dumps({"scale": asked.scale, "points": rows}, indent=1) + "\n")


def _show(points: list[Point], scale: float) -> None:
    first = points[0].seconds if points[0].robots == 1 else None
    print(f"\nModel latency 8-10 s / {scale:g}; played back.")
    print(
        "robots protocols  wall s  speed-up  % of ideal  bound s  longest-first s  CPU s  detected"
    )
    for point in points:
        gain = (first or point.alone_s) / point.seconds
        print(
            f"{point.robots:6} {point.protocols:9} {point.seconds:7.2f} {gain:8.2f}x "
            f"{100 * gain / point.robots:10.0f}% {point.least_s:8.2f} {point.planned_s:16.2f} "
            f"{point.cpu_s:6.2f} {point.detected:6}/{point.protocols}"
        )


if __name__ == "__main__":
    main()
