"""What a score means in this run: the run's own band.

The scale of a score drifts by a factor of two between sessions (paper, "Per-run calibration").
So each run anchors itself on its first wells, which are assumed normal. How unusual a score is
among the normals of earlier runs is the world model's to say: see
:class:`~.scorers.ensemble.EnsembleScorer`, whose docstring states what that assumes, and
:meth:`.calibration_group.CalibrationGroup.p_value`, which takes it against this run's own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..errors import ConfigurationError


@dataclass(frozen=True)
class CalibrationSettings:
    """How a run is calibrated.

    Attributes:
        wells: Number of calibration wells at the start of a run (paper: 6).
        multiplier: Half-width m of the band, median ± m·MAD. See :data:`PRESETS`.
        two_sided: Whether a score below the band leaves it too.
        score_floor: A score below it means a blank crop (paper: 1e-4).
        least_spread: Smallest spread taken for real, as a fraction of the median: six scores
            can agree by chance, and a band of no width would send every well to the gate.
        outlier: Calibration wells farther than this many MADs from the median disagree.
        widest: Largest MAD, as a fraction of the median, at which the first wells agree.
        streaming: Whether accepted wells after the calibration update the band.
        memory: Number of latest wells that a streaming band remembers.
    """

    wells: int = 6
    multiplier: float = 5.0
    two_sided: bool = False
    score_floor: float = 1e-4
    least_spread: float = 0.02
    outlier: float = 10.0
    widest: float = 0.8
    streaming: bool = True
    memory: int = 48

    def __post_init__(self) -> None:
        wrong = [
            name
            for name, good in (
                ("wells", self.wells >= 1),
                ("multiplier", self.multiplier > 0),
                ("score_floor", self.score_floor >= 0),
                ("least_spread", self.least_spread >= 0),
                ("outlier", self.outlier > 0),
                ("widest", self.widest > 0),
                ("memory", self.memory >= self.wells),
            )
            if not good
        ]
        if wrong:
            raise ConfigurationError(f"calibration settings out of range: {', '.join(wrong)}")


PRESETS = {
    "default": CalibrationSettings(),
    "paper": CalibrationSettings(multiplier=0.7, two_sided=True, streaming=False),
}
"""Named settings.

``paper`` is median ± 0.7·MAD, two-sided: with six wells it sends about 72 % of exchangeable
normals to the gate. ``default`` is one-sided with m = 5, which sends 4 % (normal scores) to 8 %
(lognormal, gamma) there, simulated with six calibration wells; m = 4 would send 6 to 11 %. It
learns from accepted wells as the run goes on, which halves that again over a plate. It is
one-sided because an anomaly score below the band says that the well is *more* usual than the
calibration wells; the one low score that matters, a blank crop, is caught as missing tips. The
tests repeat the simulation.
"""


class CalibrationState(str, Enum):
    """How far a run's calibration is."""

    COLLECTING = "collecting"
    READY = "ready"
    UNCALIBRATED = "uncalibrated"


@dataclass(frozen=True)
class Standing:
    """Where one score stands in its run.

    Attributes:
        z: Distance from the run's median in units of its spread; ``None`` before calibration.
        inside: Whether the score may pass silently.
    """

    z: float | None
    inside: bool


class RunCalibration:
    """The band of one run for one scorer.

    Median and MAD tolerate one bad calibration well, and a well that the gate already failed is
    not added at all. A cluster of bad ones is another matter: if two or more first wells stand
    far from the others, or if the first wells scatter as widely as their own size, the run is
    :attr:`CalibrationState.UNCALIBRATED`, and stays so.

    Args:
        settings: See :class:`CalibrationSettings`.
        least_alarm: Score up to which a well passes however quiet this run is: a scorer that
            learned from many runs what a normal well scores knows that better than six wells
            do. 0: a scorer whose scale is the run's own.
    """

    def __init__(
        self,
        settings: CalibrationSettings | None = None,
        least_alarm: float = 0.0,
    ) -> None:
        self.settings = settings or PRESETS["default"]
        self.least_alarm = least_alarm
        self._first: list[float] = []
        self._recent: list[float] = []
        self._median = self._spread = math.nan
        self.state = CalibrationState.COLLECTING
        self.reason = ""
        self._volumes: set[float] = set()

    @property
    def normals(self) -> tuple[float, ...]:
        """Scores of the latest wells that were judged normal, as many as are remembered."""
        return tuple([*self._first, *self._recent][-self.settings.memory :])

    @property
    def band(self) -> tuple[float, float] | None:
        """Silent-pass band; its lower end is minus infinity when one-sided."""
        if self.state is not CalibrationState.READY:
            return None
        width = self.settings.multiplier * self._spread
        low = self._median - width if self.settings.two_sided else -math.inf
        return low, max(self._median + width, self.least_alarm)

    def add(self, score: float, volume_ul: float | None = None) -> CalibrationState:
        """Take the score of one calibration well; the last one closes the calibration.

        Args:
            score: Anomaly score.
            volume_ul: Volume that the well was to get: wells of different volumes look
                different, so that their scores cannot be asked to agree.
        """
        if self.state is CalibrationState.COLLECTING:
            self._first.append(float(score))
            if volume_ul is not None and volume_ul > 0:
                self._volumes.add(float(volume_ul))
            if len(self._first) >= self.settings.wells:
                self._close()
        return self.state

    def give_up(self, reason: str) -> None:
        """Declare the run uncalibrated, for a reason seen elsewhere (the gates)."""
        self.state, self.reason = CalibrationState.UNCALIBRATED, reason

    def standing(self, score: float) -> Standing:
        """Where ``score`` stands; inside nothing while the run is not calibrated."""
        band = self.band
        if band is None or not math.isfinite(score):
            return Standing(None, False)
        z = (score - self._median) / self._spread
        return Standing(z, band[0] <= score <= band[1])

    def accept(self, score: float) -> None:
        """A later well was judged normal: a streaming band learns from it.

        One outside the band that passed for want of proof counts as its edge: it may be no normal
        one, and must not make the next one look usual.
        """
        if not self.settings.streaming or self.band is None:
            return
        self._recent.append(float(min(score, self.band[1])))
        del self._recent[: -self.settings.memory]
        # The first wells stay until enough accepted ones replace them: accepted wells are cut
        # off at the band's edge, and a band learned from them alone would only ever shrink.
        self._median, self._spread = self._anchor(self.normals)

    def _anchor(self, scores: Sequence[float]) -> tuple[float, float]:
        values = np.asarray(scores, dtype=np.float64)
        median = float(np.median(values))
        mad = float(np.median(np.abs(values - median)))
        least = max(self.settings.least_spread * abs(median), float(np.finfo(np.float64).tiny))
        least = max(least, self.least_alarm / self.settings.multiplier)
        return median, max(mad, least)

    def _close(self) -> None:
        values = np.asarray(self._first)
        median, spread = self._anchor(self._first)
        far = int(np.sum(np.abs(values - median) > self.settings.outlier * spread))
        comparable = not self._volumes or max(self._volumes) <= 1.2 * min(self._volumes)
        if len(values) >= 4 and far >= 2 and comparable:
            self.give_up(
                f"{far} of the first {len(values)} wells stand apart from the others; "
                "are they all normal?"
            )
        elif (
            len(values) >= 4
            and comparable
            and spread > self.settings.widest * max(abs(median), self.least_alarm)
        ):
            self.give_up(f"the first {len(values)} wells disagree too widely to calibrate on")
        else:
            self._median, self._spread = median, spread
            self.state = CalibrationState.READY
