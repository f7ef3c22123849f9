"""Triage: which wells pass silently and which go to a gate. No scorer fails a well alone."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from ..vocabulary import KeyframeKind, Route
from .calibration import CalibrationSettings, CalibrationState, RunCalibration, Standing

CROP_SCORERS = ("pca", "single_frame_pca", "autoencoder")
"""Scorers to which the score floor applies: a blank crop costs them almost nothing."""


@dataclass(frozen=True)
class Triage:
    """Where a well was sent, and why.

    Attributes:
        route: See :class:`~aegis_ot.vocabulary.Route`.
        reason: One sentence.
        missing: Keyframes whose missing tip counts in this run.
        band: From where to where a score passed silently; ``None`` before a band was set.
    """

    route: Route
    reason: str
    missing: tuple[KeyframeKind, ...] = ()
    band: tuple[float, float] | None = None

    @property
    def to_gate(self) -> bool:
        """Whether a gate must settle this well."""
        return self.route not in (Route.SILENT_PASS, Route.CALIBRATION)


class Cascade:
    """The routes of one run (paper, "Real-time deployment").

    The paper's blank floor is a score below 1e-4, "signalling that the detector produced no
    crop": it is the missing detection that matters, so that is asked first and the score floor
    is kept beside it. A tip that is not found in one frame but in a later one is on the pipette,
    for tips fall off and do not come back: that is no evidence.

    Args:
        scorer: Name of the scorer whose scores :meth:`triage` gets.
        settings: Calibration settings.
        always_gate: Send every well after calibration to the gate.
        least_alarm: See :class:`~.calibration.RunCalibration`.

    Attributes:
        calibration: The run's band.
    """

    def __init__(
        self,
        scorer: str,
        settings: CalibrationSettings | None = None,
        always_gate: bool = False,
        least_alarm: float = 0.0,
    ) -> None:
        self.calibration = RunCalibration(settings, least_alarm)
        self._scorer = scorer
        self._always_gate = always_gate
        self._refused = 0

    @property
    def state(self) -> CalibrationState:
        """How far the calibration is."""
        return self.calibration.state

    def triage(
        self,
        score: float | None,
        missing: Collection[KeyframeKind],
        contradiction: str = "",
    ) -> Triage:
        """Route one well. Says nothing to the calibration: see :meth:`learn`.

        Args:
            score: Anomaly score; ``None`` if none could be computed.
            missing: Keyframes in which no tip was found.
            contradiction: How the measured columns contradict the protocol's volumes, or what
                else looks alarming: reason enough for the grey zone inside any band.
        """
        return replace(self._triage(score, missing, contradiction), band=self.calibration.band)

    def _triage(
        self, score: float | None, missing: Collection[KeyframeKind], contradiction: str
    ) -> Triage:
        if self.state is CalibrationState.COLLECTING:
            return Triage(
                Route.CALIBRATION,
                "One of the first wells, on which the run is calibrated.",
                self._counted(missing),
            )
        counted = self._counted(missing)
        if counted:
            where = ", ".join(kind.value for kind in counted)
            return Triage(Route.BLANK_FLOOR, f"No tip found at {where}.", counted)
        if self._blank(score):
            return Triage(Route.BLANK_FLOOR, "The score is that of a blank crop.")
        if self.state is CalibrationState.UNCALIBRATED:
            return Triage(Route.UNCALIBRATED, f"Run not calibrated: {self.calibration.reason}.")
        if self._always_gate:
            return Triage(Route.ALWAYS_GATE, "Every well goes to the gate, as set.")
        if contradiction:
            return Triage(Route.GREY_ZONE, contradiction)
        if score is None:
            return Triage(Route.GREY_ZONE, "No image score could be computed.")
        standing = self.calibration.standing(score)
        if not standing.inside:
            return Triage(Route.GREY_ZONE, _why(self._scorer, standing))
        return Triage(Route.SILENT_PASS, "Inside this run's band.")

    def learn(
        self,
        score: float | None,
        *,
        normal: bool,
        volume_ul: float | None = None,
    ) -> None:
        """Tell the cascade how a well that it routed was judged.

        While it calibrates, a well that the gate failed is left out of the band; two of them
        among the first wells make the run uncalibrated, for then the others are not to be
        trusted either.
        """
        if self.state is CalibrationState.COLLECTING:
            if not normal:
                self._refused += 1
                if self._refused >= 2:
                    refused = f"{self._refused} of the first wells failed at the gate"
                    self.calibration.give_up(refused)
            elif score is not None:
                self.calibration.add(score, volume_ul)
        elif normal and score is not None:
            self.calibration.accept(score)

    def _blank(self, score: float | None) -> bool:
        floor = self.calibration.settings.score_floor
        return self._scorer in CROP_SCORERS and score is not None and score < floor

    def _counted(self, missing: Collection[KeyframeKind]) -> tuple[KeyframeKind, ...]:
        """The missing frames at the end of the trajectory, if its last one is missing."""
        counted: list[KeyframeKind] = []
        for kind in reversed(KeyframeKind):
            if kind not in missing:
                break
            counted.append(kind)
        return tuple(reversed(counted))


def _why(name: str, standing: Standing) -> str:
    if standing.z is None:
        return f"The {name} score could not be computed."
    side = "above" if standing.z > 0 else "below"
    return f"The {name} score is {abs(standing.z):.1f} spreads {side} this run's median."
