"""Each half of a liquid's deliveries judged as a run of its own: what runs differ by, and what a
model of the lab's own would have caught beside the one in use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import DatasetError
from ..planted import NORMAL
from ..progress import Progress
from ..vision.models import SHIPPED
from ..vision.scorers import make_scorer
from ..vision.types import TrajectorySample
from ..worldmodel.cascade import JudgedWell, run_cascade
from ..worldmodel.leave_one_out import hold_out, score_with
from ..worldmodel.limits import LimitFit, fit_limits
from .counting import rate_of, spread_between
from .opening import JudgedDelivery


def judge_anew(samples: Sequence[TrajectorySample], progress: Progress | None = None) -> LimitFit:
    """Judge each half with the shipped model, as if the other had never been."""
    from ..sidecar.analysers import load_scorer

    return fit_limits(score_with(_seen(samples), load_scorer(SHIPPED), progress))


def _seen(samples: Sequence[TrajectorySample]) -> list[TrajectorySample]:
    return [each for each in samples if each.label == NORMAL or not each.lacks_tip]


def flagged_anew(fit: LimitFit) -> dict[str, bool]:
    """By well, but those on which its half was calibrated, whether it was flagged."""
    return {well.sample.well: well.flagged for well in fit.judged if not well.calibration}


def spread_of(deliveries: Sequence[JudgedDelivery], anew: Mapping[str, bool]) -> float | None:
    """What runs differ by beyond chance, pooled over kinds; ``None`` without two judged halves."""
    judged = [each.planned for each in deliveries if each.planned.well in anew]
    groups = []
    for kind in {each.kind for each in judged}:
        halves = [[anew[e.well] for e in judged if (e.kind, e.half) == (kind, n)] for n in (1, 2)]
        if all(halves):
            groups.append(((sum(halves[0]), len(halves[0])), (sum(halves[1]), len(halves[1]))))
    return spread_between(groups) if groups else None


def before_and_after(
    samples: Sequence[TrajectorySample], shipped: LimitFit, progress: Progress | None = None
) -> dict[str, Any] | None:
    """For the certificate, the shipped model (``shipped``: what :func:`judge_anew` made of
    ``samples``) and a fitted one, leaving one half out; ``None`` if there are too few frames."""
    try:
        held = hold_out(_seen(samples), lambda: make_scorer("ensemble"), "p-value", progress)
    except DatasetError:
        return None
    flagged = [well.flagged for well in shipped.judged]
    both = [one or other for one, other in zip(flagged, shipped.beyond, strict=True)]
    own = run_cascade(held)
    rows = [
        _row("the shipped model", shipped.judged, flagged),
        _row("the shipped model with limits of these frames", shipped.judged, both),
        _row("a model of these frames", own, [well.flagged for well in own]),
    ]
    return {"rows": rows}


def _row(name: str, judged: Sequence[JudgedWell], flagged: Sequence[bool]) -> dict[str, Any]:
    def rate(failed: bool) -> dict[str, float | int]:
        told = zip(judged, flagged, strict=True)
        return rate_of(
            f for w, f in told if not w.calibration and w.scored.failed is failed
        ).to_json()

    return {"judge": name, "caught": rate(True), "normals_flagged": rate(False)}
