"""What Layer 1 tells Layer 2 of a run's tips, for runs in which failed wells may be put right."""

from __future__ import annotations

from typing import Any

from .settings import Settings


class KnownTips:
    """Gathered in the rehearsal and in the run.

    Attributes:
        forecast: Listens to the rehearsal.
        recorder: Listens to the run, before the watcher.
        knowledge: What the watcher asks.
    """

    def __init__(self) -> None:
        from .adapters.opentrons.rehearsal import Recorder
        from .preflight.trace import touched_by_tip
        from .runtime import TipForecast, TipKnowledge

        self.forecast = TipForecast()
        self.recorder = Recorder()
        self.knowledge = TipKnowledge(
            self.forecast, lambda well: touched_by_tip(self.recorder, well)
        )


def recovers_by_itself(protocol: Any, settings: Settings) -> bool:
    """Whether failed wells of this run may be put right without a person.

    A simulation in which that is so is rehearsed first, like a run on a robot.
    """
    watches = settings.watch_simulation or not protocol.is_simulating()
    return bool(settings.recover) and settings.sidecar is not None and watches
