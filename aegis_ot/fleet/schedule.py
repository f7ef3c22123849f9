"""Which protocol goes to which robot: the longest expected first, where it fits."""

from __future__ import annotations

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
