"""Which protocol goes to which robot: the longest expected first, where it fits."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterable, Mapping, Sequence

from .config import RobotConfig
from .jobs import Job


def fitting(jobs: Iterable[Job], robots: Sequence[RobotConfig]) -> dict[str, frozenset[str]]:
    """Names of the robots that have all that a job needs, by name of the job."""
    return {
        job.name: frozenset(robot.name for robot in robots if not robot.lacks(job.needs))
        for job in jobs
    }


def next_job(
    robot: str, waiting: Collection[Job], fits: Mapping[str, Collection[str]]
) -> Job | None:
    """The longest of the waiting jobs that ``robot`` can run.

    Of equally long ones the one that fewest robots can run.
    """
    able = [job for job in waiting if robot in fits[job.name]]
    return max(able, key=lambda job: (job.expected_s, -len(fits[job.name])), default=None)


def least_s(durations: Sequence[float], robots: int) -> float:
    """No schedule on so many equal robots is shorter, s: the longest job, or an even share."""
    return max([sum(durations) / robots, *durations]) if durations else 0.0


def longest_first_s(durations: Sequence[float], robots: int) -> float:
    """How long the longest-first schedule takes on so many equal robots, s.

    At most 4/3 - 1/(3 robots) of the best (Graham 1969, SIAM J. Appl. Math. 17, 416).
    """
    free = [0.0] * robots
    for duration in sorted(durations, reverse=True):
        heapq.heapreplace(free, free[0] + duration)
    return max(free)
