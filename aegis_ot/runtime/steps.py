"""What the guard has to do before an operation may proceed, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

from ..adapters.opentrons.instrumentation import Operation
from ..vocabulary import Keyframe, WellRef


@dataclass(frozen=True)
class Capture:
    """Stand still and have this keyframe captured."""

    keyframe: Keyframe


@dataclass(frozen=True)
class Lift:
    """Move the tip to the top of the well at which ``operation`` is aimed."""

    operation: Operation


@dataclass(frozen=True)
class Hold:
    """A boundary: go no further until these verdicts are in.

    Attributes:
        trajectories: Numbers of the trajectories, rising.
        reason: What was about to happen, in plain words: ``"the tip enters B1"``.
        final: Whether it is the end of the run.
    """

    trajectories: tuple[int, ...]
    reason: str
    final: bool = False


@dataclass(frozen=True)
class Abandon:
    """This trajectory will have no further keyframes and needs no verdict."""

    trajectory: int
    reason: str


Step = Capture | Lift | Hold | Abandon


@dataclass
class Trajectory:
    """One delivery of liquid into one place, as the robot half follows it.

    Attributes:
        number: Counts the trajectories of a run from 0.
        sources: Wells drawn from, each once.
        destinations: Wells delivered to, each once; empty until known.
        commanded_ul: Per channel; what is in the tip until the delivery is known.
        channels: Number of tips that take part.
        reagent: Name of the liquid, if known.
        line: Source line of the operation that caused the next keyframe.
        frames: How many of its four keyframes exist.
        recovers: The failed trajectory of which this is a recovery.
        delivered: Whether liquid has left the tip into the destination.
        nozzles: The active nozzles, where there are several.
        targets: The well under each of them, once the destination is known.
        found: What the pipette's sensors said of the source well of each nozzle before the draw;
            empty if nothing.
    """

    number: int
    sources: tuple[WellRef, ...]
    channels: int
    commanded_ul: float
    reagent: str | None = None
    line: int | None = None
    destinations: tuple[WellRef, ...] = ()
    frames: int = 0
    recovers: int | None = None
    delivered: bool = False
    nozzles: tuple[str, ...] = ()
    targets: tuple[WellRef | None, ...] = ()
    found: tuple[bool | None, ...] = ()
