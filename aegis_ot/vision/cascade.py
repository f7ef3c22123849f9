"""Triage: which wells pass silently and which go to a gate. No scorer fails a well alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

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
    """

    route: Route
    reason: str
    missing: tuple[KeyframeKind, ...] = ()

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
        scorers: Names of the scores that :meth:`triage` will get; the first is the main one.
        settings: Calibration settings, common to all scorers.
        always_gate: Send every well after calibration to the gate.
        least_alarm: See :class:`~.calibration.RunCalibration`, by scorer name.
    """

    def __init__(
        self,
        scorers: Collection[str],
        settings: CalibrationSettings | None = None,
        always_gate: bool = False,
        least_alarm: Mapping[str, float] | None = None,
    ) -> None:
        self.settings = settings or CalibrationSettings()
        self.always_gate = always_gate
        least = least_alarm or {}
        self.calibrations = {
            name: RunCalibration(self.settings, least.get(name, 0.0)) for name in scorers
        }
        self._refused = 0

    @property
    def state(self) -> CalibrationState:
        """Uncalibrated if any scorer is; ready when all are."""
        states = {calibration.state for calibration in self.calibrations.values()}
        for state in (CalibrationState.UNCALIBRATED, CalibrationState.COLLECTING):
            if state in states:
                return state
        return CalibrationState.READY

    @property
    def reason(self) -> str:
        """Why the run is uncalibrated."""
        return next((c.reason for c in self.calibrations.values() if c.reason), "")

    def triage(
        self,
        scores: Mapping[str, float],
        missing: Collection[KeyframeKind],
        contradiction: str = "",
    ) -> Triage:
        """Route one well. Says nothing to the calibration: see :meth:`learn`.

        Args:
            scores: Anomaly scores by scorer name.
            missing: Keyframes in which no tip was found.
            contradiction: How the measured columns contradict the protocol's volumes, or what
                else looks alarming: reason enough for the grey zone inside any band.
        """
        if self.state is CalibrationState.COLLECTING:
            return Triage(
                Route.CALIBRATION,
                "One of the first wells, on which the run is calibrated.",
                self._counted(missing),
            )
        standings = {
            name: self.calibrations[name].standing(score)
            for name, score in scores.items()
            if name in self.calibrations
        }
        counted = self._counted(missing)
        low = [
            name
            for name, score in scores.items()
            if name in CROP_SCORERS and score < self.settings.score_floor
        ]
        if counted:
            where = ", ".join(kind.value for kind in counted)
            return Triage(Route.BLANK_FLOOR, f"No tip found at {where}.", counted)
        if low:
            return Triage(Route.BLANK_FLOOR, "The score is that of a blank crop.")
        if self.state is CalibrationState.UNCALIBRATED:
            return Triage(Route.UNCALIBRATED, f"Run not calibrated: {self.reason}.")
        if self.always_gate:
            return Triage(Route.ALWAYS_GATE, "Every well goes to the gate, as set.")
        if contradiction:
            return Triage(Route.GREY_ZONE, contradiction)
        if not scores:
            return Triage(Route.GREY_ZONE, "No image score could be computed.")
        outside = [name for name, standing in standings.items() if not standing.inside]
        if outside:
            return Triage(Route.GREY_ZONE, _why(outside[0], standings[outside[0]]))
        return Triage(Route.SILENT_PASS, "Inside this run's band.")

    def learn(
        self,
        scores: Mapping[str, float],
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
                    self.give_up(f"{self._refused} of the first wells failed at the gate")
                return
            for name, calibration in self.calibrations.items():
                if name in scores:
                    calibration.add(scores[name], volume_ul)
        elif normal:
            for name, score in scores.items():
                if name in self.calibrations:
                    self.calibrations[name].accept(score)

    def give_up(self, reason: str) -> None:
        """Declare the whole run uncalibrated."""
        for calibration in self.calibrations.values():
            calibration.give_up(reason)

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
