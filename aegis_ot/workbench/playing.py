"""A dry run's part that needs ``opentrons``, as tasks: an engine may have to do it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ..adapters.opentrons.instrumentation import Operation, tapped
from ..adapters.opentrons.rehearsal import Recorder, Recording, Script, play, record
from ..errors import AegisError, RehearsalError, RunAborted
from ..guard import guard
from ..guarding import AHEAD
from ..runtime import Planner
from ..vocabulary import Keyframe
from .tasks import OfScript


@dataclass(frozen=True)
class Planned:
    """What a rehearsal tells ahead of a dry run.

    Attributes:
        recording: Of Layer 1.
        keyframes: In their order.
        wells: How many will be watched.
        ahead: What the guard is to know of the run.
    """

    recording: Recording
    keyframes: tuple[Keyframe, ...]
    wells: int
    ahead: Any


@dataclass(frozen=True)
class PlanRun(OfScript):
    """Rehearse a protocol for a dry run."""

    script: Script
    timeout_s: float

    def perform(self) -> Planned:
        """Rehearse."""
        planner = Planner()
        recording = record(self.script, [planner], timeout_s=self.timeout_s)
        planner.finish()
        ahead = planner.about(recording.labware)
        return Planned(recording, tuple(planner.keyframes), planner.trajectories, ahead)


@dataclass(frozen=True)
class PlayGuarded(OfScript):
    """Run a protocol in the simulator with a guard of these settings.

    What comes of it: how it ended, why, and all that the simulated robot did.
    """

    script: Script
    settings: Mapping[str, Any]
    ahead: Any = None
    timeout_s: float = 3600.0

    def perform(self) -> tuple[str, str, list[Operation]]:
        """Run it."""
        recorder = Recorder()

        def wrap(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
            guarded = guard(function, **self.settings)

            def run(protocol: Any) -> Any:
                with tapped(protocol, [recorder], self.file_name):
                    return guarded(protocol)

            return run

        known = AHEAD.set(self.ahead)
        try:
            outcome, detail = ending_of(lambda: play(self.script, wrap, timeout_s=self.timeout_s))
        finally:
            AHEAD.reset(known)
        return outcome, detail, [one for one in recorder.log if isinstance(one, Operation)]


def ending_of(run: Callable[[], None]) -> tuple[str, str]:
    """How a guarded run ends, and why.

    Raises:
        RehearsalError: The protocol raises by itself.
    """
    try:
        run()
    except RunAborted as error:
        return "stopped", str(error)
    except RehearsalError:
        raise
    except AegisError as error:
        return "failed", str(error)
    return "succeeded", ""
