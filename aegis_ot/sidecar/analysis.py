"""What the sidecar asks of whatever judges wells. The vision room implements it.

Only plain types cross this line, so that an implementation need not import the sidecar.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any, Protocol

from ..vision.camera import Frame
from ..vocabulary import Keyframe, KeyframeKind, Outcome, Route, Verdict

Evidence = Mapping[str, Any]
"""What the page and the report show beside a verdict: boxes, scores, measured µL. Must turn
into JSON: numbers, texts, lists, mappings, numpy scalars and arrays. Keys the page knows:
``boxes`` (``{"aspirate": [x, y, w, h], ...}``, px), anything else is listed as it is."""

Judged = tuple[Verdict, Evidence]


class RunAnalysis(Protocol):
    """Judges the trajectories of one run. Called from one worker thread, never at once."""

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """A keyframe was captured. Called in order of sequence, while the robot moves on."""

    def judge(self, trajectory: int) -> Judged:
        """The trajectory's POST_DISPENSE was observed: judge it. Called once each."""

    def confirm(self, trajectory: int) -> None:
        """The operator found an undecided trajectory right, or looked and let the run go on."""


class Analyser(Protocol):
    """Makes one :class:`RunAnalysis` per run."""

    def begin(self, run: str, history: Sequence[Judged] = ()) -> RunAnalysis:
        """A run starts, or goes on after the sidecar was restarted.

        Args:
            run: Identifier of the run.
            history: What was judged before, in order. The evidence comes back as it was
                stored, so put into it whatever calibration needs.
        """


class Unscored:
    """Stands in where no analyser is configured: decides nothing, and says so."""

    def begin(self, run: str, history: Sequence[Judged] = ()) -> _UnscoredRun:
        return _UnscoredRun(run)


class _UnscoredRun:
    def __init__(self, run: str) -> None:
        self._run = run

    def observe(self, keyframe: Keyframe, frame: Frame) -> None:
        """Nothing to look for."""

    def judge(self, trajectory: int) -> Judged:
        return undecided(self._run, trajectory, "No analyser is configured in the sidecar."), {}

    def confirm(self, trajectory: int) -> None:
        """Nothing to learn."""


def undecided(run: str, trajectory: int, reason: str) -> Verdict:
    """The verdict on a trajectory that could not be scored."""
    return Verdict(run, trajectory, Outcome.UNDECIDED, Route.UNCALIBRATED, reason=reason)


def tell_late(kind: KeyframeKind | None = None) -> str:
    """Why a trajectory cannot be judged whose frame may not show its moment."""
    moment = "moment" if kind is None else f"{kind.value.replace('_', '-')} moment"
    return f"The robot had moved on before a frame of the {moment} was taken: nobody saw it."


def plain(value: Any) -> Any:
    """Turn evidence into values that :mod:`json` can write; non-finite numbers become ``None``."""
    if hasattr(value, "tolist"):  # numpy scalars and arrays
        value = value.tolist()
    if isinstance(value, Enum):
        value = value.value
    if isinstance(value, Mapping):
        return {str(plain(key)): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int)):
        return value
    return str(value).encode("utf-8", "replace").decode("utf-8")
