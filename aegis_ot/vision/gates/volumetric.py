"""The volumetric gate: the measured columns against the volumes that the protocol expects."""

from __future__ import annotations

from dataclasses import dataclass

from ...vocabulary import FailureType, Gate, KeyframeKind, Outcome, Route
from ..delivery import Shown
from ..measuring import ColumnReading
from ..types import FREE, TrajectorySample
from ..usual import ENOUGH
from .case import GateDecision, GateInput


@dataclass(frozen=True)
class VolumetricLimits:
    """When a measured volume contradicts the protocol.

    Attributes:
        sigmas: Times the reading's standard uncertainty.
        fraction: Of the commanded volume; less than that is no failure.
        least_ul: Smallest difference that counts, µL.
        blind_fraction: If the tolerance is wider than this fraction of the commanded volume,
            the reading's agreement is worth nothing.
        tested: Normal tips of this run that must have been read before they were learned, until
            a reading's agreement is worth anything.
        gross_sigmas, gross_fraction: The same limits for calibration wells, on which the
            reading itself is not calibrated yet.
        sharp_fraction: A reading whose uncertainty is at most this share of the commanded volume
            tells a column that stayed whole from one of which most did.
        gross_empty: On those, the loaded tip counts as empty up to this share of its volume.
    """

    sigmas: float = 4.0
    fraction: float = 0.15
    least_ul: float = 0.5
    blind_fraction: float = 0.6
    tested: int = ENOUGH
    gross_sigmas: float = 5.0
    gross_fraction: float = 0.2
    sharp_fraction: float = 0.1
    gross_empty: float = 0.35


class VolumetricGate:
    """Compares the measured columns with the volumes that the protocol expects.

    TRANSIT says what was aspirated, POST_DISPENSE what was left; both are frames in which the
    tip hangs free. A tip missing in both is a missing tip: no volume is needed to say so.

    It fails a well that is clearly outside what the protocol expects, by the reading's own
    uncertainty (see :mod:`..usual`), or whose own two frames show that liquid stayed in the tip or
    that none was there (see :mod:`..delivery`). Agreement explains away
    no alarming look: a bubble takes hardly any volume, and a film or a drop none.
    """

    gate = Gate.VOLUMETRIC
    screens = True

    def __init__(self, limits: VolumetricLimits | None = None) -> None:
        self.limits = limits or VolumetricLimits()

    def examine(self, case: GateInput) -> GateDecision:
        sample = case.sample
        absent = set(FREE) <= set(case.missing)
        if absent and not case.clearly_absent:
            return GateDecision(
                Outcome.UNDECIDED,
                self.gate,
                "No tip was found, but in this view none has been seen clearly so far.",
            )
        if absent:
            return GateDecision(
                Outcome.FAIL,
                self.gate,
                "No tip is on the pipette, neither in transit nor after the dispense.",
                FailureType.NO_TIP,
            )
        for kind in FREE:
            reading = case.readings.get(kind)
            if reading is None or reading.vague:
                continue
            contradiction = self._contradiction(kind, reading, case)
            if contradiction is not None:
                return contradiction
        return self._undelivered(case) or self._agreement(case, sample)

    def tolerance(self, reading: ColumnReading, commanded_ul: float, gross: bool) -> float:
        """Difference that still agrees, µL."""
        limits = self.limits
        sigmas = limits.gross_sigmas if gross else limits.sigmas
        fraction = limits.gross_fraction if gross else limits.fraction
        return max(sigmas * reading.sigma_ul, fraction * commanded_ul, limits.least_ul)

    def _contradiction(
        self, kind: KeyframeKind, reading: ColumnReading, case: GateInput
    ) -> GateDecision | None:
        sample, limits = case.sample, self.limits
        expected = sample.expected_ul.get(kind, 0.0)
        gross = case.route is Route.CALIBRATION or not case.calibrated
        tolerance = self.tolerance(reading, sample.volume_ul, gross)
        difference = reading.volume_ul - expected
        measured = reading.volume_ul
        if abs(difference) <= tolerance:
            return None
        if kind is KeyframeKind.TRANSIT and gross and measured > limits.gross_empty * expected:
            # Before the tip's inside is known, a column of another height proves little.
            return None
        if kind is KeyframeKind.TRANSIT:
            if measured <= max(0.2 * expected, tolerance / 2) and difference < 0:
                return self._fail(
                    FailureType.NO_ASPIRATE,
                    f"The tip holds about {measured:.0f} µL after the aspirate, "
                    f"expected {expected:.0f}.",
                    measured,
                    expected,
                )
            failure = FailureType.OTHER if difference < 0 else FailureType.PARTIAL_DISPENSE
            what = "too little was drawn" if difference < 0 else "more than commanded is in the tip"
            return self._fail(
                failure,
                f"About {measured:.0f} µL in transit, expected {expected:.0f}: {what}.",
                measured,
                expected,
            )
        if difference < 0:
            return self._fail(
                FailureType.OTHER,
                f"About {measured:.0f} µL are left after the dispense, expected {expected:.0f}: "
                "too much was delivered.",
                measured,
                expected,
            )
        # A column that ends among rows that no other well showed is read as all that was drawn.
        sharp = reading.sigma_ul <= limits.sharp_fraction * sample.volume_ul
        shown = case.delivery.shown if case.delivery is not None else Shown.UNKNOWN
        all_of_it = difference >= 0.9 * sample.volume_ul
        full = case.readings.get(KeyframeKind.TRANSIT)
        if all_of_it and reading.unchanged and (full is None or full.vague):
            return self._unchanged(case)
        nothing = all_of_it and shown is not Shown.LEFT and (sharp or shown is Shown.NOTHING)
        return self._fail(
            FailureType.NO_DISPENSE if nothing else FailureType.PARTIAL_DISPENSE,
            f"About {measured:.0f} µL are left in the tip after the dispense, "
            f"expected {expected:.0f}.",
            measured,
            expected,
        )

    def _undelivered(self, case: GateInput) -> GateDecision | None:
        """What the trajectory's own frames show, whatever the run was calibrated on."""
        shown = case.delivery
        if shown is None or shown.shown in (Shown.EMPTIED, Shown.FAINT, Shown.UNKNOWN):
            return None
        expected = case.sample.expected_ul.get(KeyframeKind.POST_DISPENSE, 0.0)
        if shown.shown is Shown.GAP and shown.gap_ul is not None:
            drawn = case.sample.expected_ul.get(KeyframeKind.TRANSIT, 0.0)
            return self._fail(
                FailureType.AIR_BUBBLE,
                f"About {shown.gap_ul:.1f} µL of air stand inside the column.",
                drawn - shown.gap_ul,
                drawn,
            )
        if shown.shown is Shown.LEFT and shown.left_ul is not None:
            nothing = shown.left_ul - expected >= 0.9 * case.sample.volume_ul
            return self._fail(
                FailureType.NO_DISPENSE if nothing else FailureType.PARTIAL_DISPENSE,
                f"The lower part of the column, about {shown.left_ul:.0f} µL, looks the same "
                "before and after the dispense: it stayed in the tip.",
                shown.left_ul,
                expected,
            )
        return self._unchanged(case)

    def _unchanged(self, case: GateInput) -> GateDecision:
        """The tip is after the dispense as it was before: whether it was full, TRANSIT may tell."""
        full = case.readings.get(KeyframeKind.TRANSIT)
        half = 0.5 * case.sample.expected_ul.get(KeyframeKind.TRANSIT, 0.0)
        failure = FailureType.OTHER
        if full is not None and not full.vague:
            loaded = full.volume_ul > half
            failure = FailureType.NO_DISPENSE if loaded else FailureType.NO_ASPIRATE
        return GateDecision(
            Outcome.FAIL,
            self.gate,
            "The tip looks the same before and after the dispense, unlike in the wells before: "
            "nothing was drawn, or nothing was delivered.",
            failure,
        )

    def _fail(
        self, failure: FailureType, reason: str, measured: float, expected: float
    ) -> GateDecision:
        return GateDecision(Outcome.FAIL, self.gate, reason, failure, measured, expected)

    def _agreement(self, case: GateInput, sample: TrajectorySample) -> GateDecision:
        full = case.readings.get(KeyframeKind.TRANSIT)
        last = case.readings.get(KeyframeKind.POST_DISPENSE)
        expected = sample.expected_ul.get(KeyframeKind.POST_DISPENSE)
        measured = None if last is None or last.vague else last.volume_ul

        def say(outcome: Outcome, reason: str) -> GateDecision:
            return GateDecision(outcome, self.gate, reason, None, measured, expected)

        if KeyframeKind.POST_DISPENSE in case.missing:
            return say(Outcome.UNDECIDED, "No tip can be seen after the dispense.")
        seen = case.calibrated and full is not None and self._sharp(full, sample)
        if case.seems_left:
            return say(
                Outcome.UNDECIDED,
                "The tip looks unusual, and after the dispense as if liquid were left in it, "
                "though too little or too faint to be sure.",
            )
        if case.beyond_lab > 0:
            return say(
                Outcome.UNDECIDED,
                "The readings of this well together look more like the failures that this "
                "laboratory planted than like its normal wells.",
            )
        if case.alarming and seen:
            return say(
                Outcome.UNDECIDED,
                "The volumes agree with the protocol, but the tip looks very unusual.",
            )
        if case.alarming:
            return say(
                Outcome.UNDECIDED,
                "The tip looks very unusual, and its liquid column cannot be measured well enough "
                "to clear it.",
            )
        if seen and last is not None and not last.vague and self._sharp(last, sample):
            over = last.volume_ul - (expected or 0.0)
            if over > last.sigma_ul:
                return say(
                    Outcome.PASS,
                    f"About {over:.3g} µL more than expected seem to be left in the tip, "
                    f"{over / sample.volume_ul:.0%} of the volume: within what this reading "
                    "allows for.",
                )
            return say(Outcome.PASS, "The measured columns agree with the protocol's volumes.")
        if seen and last is not None:
            return say(
                Outcome.PASS,
                "The column in transit agrees with the protocol; afterwards nothing speaks for "
                "liquid left in the tip, though this liquid hardly shows.",
            )
        if case.p_value is None:
            return say(
                Outcome.UNDECIDED,
                "The liquid column cannot be measured well enough in these frames.",
            )
        # The image score alone is no ground to stop a run.
        return say(
            Outcome.PASS,
            "Nothing in these frames speaks for a failure, though the liquid column cannot be "
            "measured well enough to confirm the volumes.",
        )

    def _sharp(self, reading: ColumnReading, sample: TrajectorySample) -> bool:
        """Whether the reading is sharp enough for its agreement to mean something."""
        if reading.tested < self.limits.tested:
            return False
        tolerance = self.tolerance(reading, sample.volume_ul, gross=False)
        return tolerance <= self.limits.blind_fraction * sample.volume_ul


make = VolumetricGate
