"""What Layer 1 tells Layer 2 of a run's tips, for runs in which failed wells may be put right."""

from __future__ import annotations

from typing import Any

from .settings import Settings
from .vocabulary import WellRef


class KnownTips:
    """Gathered in the rehearsal and in the run.

    Attributes:
        forecast: Listens to the rehearsal.
        recorder: Listens to the run, before the watcher.
        knowledge: What the watcher asks.
    """

    def __init__(self) -> None:
        from .adapters.opentrons.rehearsal import Recorder
        from .runtime import TipForecast, TipKnowledge

        self.forecast = TipForecast()
        self.recorder = Recorder()
        self.knowledge = TipKnowledge(self.forecast, self._touched)

    def _touched(self, well: WellRef) -> frozenset[WellRef] | None:
        """The wells that the tip has touched which last dispensed into ``well``.

        The run so far is read for the worst: a well of which nothing is known counts as one that
        holds liquid, so a tip that went below its upper third touched it. ``None`` if no tip did.
        """
        from .adapters.opentrons.instrumentation import OperationKind
        from .preflight.trace import build_trace

        trace = build_trace(self.recorder.log, self.recorder.labware, {}, lambda ref: True)
        for visit in reversed(trace.visits):
            if visit.well.ref == well and visit.kind is OperationKind.DISPENSE:
                return frozenset(touched.ref for touched in visit.tip.touched)
        return None


def recovers_by_itself(protocol: Any, settings: Settings) -> bool:
    """Whether failed wells of this run may be put right without a person.

    A simulation in which that is so is rehearsed first, like a run on a robot.
    """
    watches = settings.watch_simulation or not protocol.is_simulating()
    return bool(settings.recover) and settings.sidecar is not None and watches
