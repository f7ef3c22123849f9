"""Which start a run belongs to: an identifier that is used twice never mixes two runs."""

from __future__ import annotations

import contextlib
from datetime import datetime

from .wire import RunStart, WireError


def kept_apart(first: RunStart, run: str) -> str:
    """What is said of a run that came with the name of another one."""
    return (
        f"The robot began this run as {first.run!r}, which names another run already "
        f"({_describe(first)}). It is kept as {run!r}: no frame or verdict of the other counts "
        "here. Give each run a run_id of its own, or none."
    )


def name_taken(first: RunStart) -> WireError:
    """The answer to a start that cannot be given another name."""
    return WireError(
        422,
        "other_start",
        f"The run {first.run!r} is another one already ({_describe(first)}); nothing is watched "
        "under its name",
        "Give this run a run_id of its own, and install the newest aegis-ot on the robot.",
    )


def check_start(run: str, known: str, nonce: str) -> None:
    """Whether the start with ``nonce`` may speak for a run.

    Raises:
        WireError: 409, the run is another start's.
    """
    if known and nonce != known:
        raise WireError(
            409,
            "other_start",
            f"The run {run!r} is another start's.",
            "Register this start with PUT, and use the name that the answer gives.",
        )


def _describe(start: RunStart) -> str:
    told = [start.protocol] if start.protocol else []
    if start.robot_name:
        told.append(f"on {start.robot_name}")
    with contextlib.suppress(ValueError, OverflowError, OSError):  # a moment that no calendar has
        if start.started:
            told.append(f"begun {datetime.fromtimestamp(start.started):%Y-%m-%d %H:%M:%S}")
    return ", ".join(told) or "of which its robot told nothing"
