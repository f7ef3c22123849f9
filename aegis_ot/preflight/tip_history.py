"""What a tip has touched so far in a run that is still going on."""

from __future__ import annotations

from ..instrumentation import OperationKind
from ..vocabulary import WellRef
from .rehearsal import Recorder
from .trace import Pauses, build_trace


def touched_by_tip(recorder: Recorder, well: WellRef) -> frozenset[WellRef] | None:
    """The wells that the tip has touched which last dispensed into ``well``.

    Layer 1's trace of the run so far, read for the worst: a well of which nothing is known counts
    as one that holds liquid, so a tip that went below its upper third touched it.

    Args:
        recorder: Has heard all that was done.
        well: Where the tip dispensed.

    Returns:
        ``None`` if no tip did.
    """
    trace = build_trace(recorder.log, recorder.labware, Pauses(), lambda ref: True)
    for visit in reversed(trace.visits):
        if visit.well.ref == well and visit.kind is OperationKind.DISPENSE:
            return frozenset(touched.ref for touched in visit.tip.touched)
    return None
