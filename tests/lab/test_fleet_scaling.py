from __future__ import annotations

from aegis_ot.fleet.report import FleetEntry, FleetReport
from aegis_ot_lab.fleet_scaling import longest_first_s, sweep, workload
from tests.fleet.support import RESULT


def judged(tasks):
    """What the layers would say if they found all that was planted but in the first protocol."""
    entries = []
    for number, task in enumerate(tasks):
        result = dict(RESULT)
        if task.truth == "rejected" and number:
            result["outcome"] = "rejected"
        elif task.truth and number:
            result["flagged"] = [{"well": f"{task.truth} of plate (slot 1)"}]
        entries.append(FleetEntry(task.job, result["outcome"], result=result))
    return FleetReport((), entries)


def test_the_workload_is_16_protocols_the_same_for_a_seed():
    tasks = workload()
    assert len(tasks) == 16 == len({task.job.name for task in tasks})
    assert sum(task.truth == "rejected" for task in tasks) == 4
    assert sum(bool(task.job.faults) for task in tasks) == 10
    assert workload() == tasks != workload(3)


def test_more_robots_are_faster_and_detect_the_same():
    tasks = workload()
    one, four = sweep(tasks, judged(tasks), (1, 4), scale=100)
    assert one.detected == four.detected == 15
    assert one.least_s == one.alone_s <= one.seconds
    assert four.planned_s >= four.least_s
    assert four.planned_s < one.planned_s / 2


def test_the_workload_many_times_over():
    tasks = workload()
    (point,) = sweep(tasks, judged(tasks), (32,), scale=100, rounds=2)
    assert (point.protocols, point.detected) == (32, 30)


def test_the_longest_first():
    assert longest_first_s([2, 2, 2], 2) == 4
    assert longest_first_s([3, 3, 2, 2, 2], 2) == 7  # the best is 6; the known worst case, 7/6
