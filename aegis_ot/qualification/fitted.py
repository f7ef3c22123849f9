"""What a model of the lab's own would have caught of a qualification, beside the one in use."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..errors import DatasetError
from ..planted import NORMAL
from ..progress import Progress
from ..vision.models import SHIPPED
from ..vision.scorers import make_scorer
from ..vision.types import TrajectorySample
from ..worldmodel.cascade import JudgedWell, run_cascade
from ..worldmodel.leave_one_out import hold_out, score_with
from ..worldmodel.limits import fit_limits
from .counting import rate_of

WORDS = (
    "Both judged these frames anew, as a live run does: each half of a liquid's deliveries is a "
    "run of its own, calibrated on its first normal wells. The lab's own model was fitted on the "
    "normal wells of the other halves, and never saw the half that it judged. Its own limits were "
    "fitted on the failures too; each well was held against limits of all other wells."
)


def before_and_after(
    samples: Sequence[TrajectorySample], progress: Progress | None = None
) -> dict[str, Any] | None:
    """The shipped model and a fitted one on the same frames, leaving one half out.

    Args:
        samples: Of a qualification, labelled by its plan.
        progress: Told how far it is.

    Returns:
        For the certificate; ``None`` where the frames are too few to fit anything.
    """
    from ..sidecar.analysers import load_scorer

    seen = [each for each in samples if each.label == NORMAL or not each.lacks_tip]
    try:
        held = hold_out(seen, lambda: make_scorer("ensemble"), "p-value", progress)
    except DatasetError:
        return None
    shipped = fit_limits(score_with(seen, load_scorer(SHIPPED), progress))
    flagged = [well.flagged for well in shipped.judged]
    both = [one or other for one, other in zip(flagged, shipped.beyond, strict=True)]
    own = run_cascade(held)
    rows = [
        _row("the shipped model", shipped.judged, flagged),
        _row("the shipped model with limits of these frames", shipped.judged, both),
        _row("a model of these frames", own, [well.flagged for well in own]),
    ]
    return {"rows": rows, "words": WORDS}


def _row(name: str, judged: Sequence[JudgedWell], flagged: Sequence[bool]) -> dict[str, Any]:
    rates = {}
    for failed in (True, False):
        rates[failed] = rate_of(
            is_flagged
            for well, is_flagged in zip(judged, flagged, strict=True)
            if not well.calibration and well.scored.failed is failed
        ).to_json()
    return {"judge": name, "caught": rates[True], "normals_flagged": rates[False]}
