"""The per-run cascade on a held-out plate: calibrate, triage, gate, well by well.

It follows what the sidecar does live (``aegis_ot.vision.analyser``), with the plate as the run.
The first normal wells of a plate, at most six, are its calibration wells and are not scored.
Where there are enough of them they set the band, as in a live run. Plates in the paper's shape
begin with one or two normals: no band can be set on those, and such a plate routes by the
threshold of leave-one-plate-out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ...vision.calibration import PRESETS
from ...vision.cascade import Cascade, Triage
from ...vision.column_reader import MeasuredColumns
from ...vision.crops import missing_tips
from ...vision.gates import (
    RUN_ALARM,
    Case,
    ConfirmingGate,
    GateDecision,
    Gates,
    OperatorGate,
    VolumetricGate,
)
from ...vision.measuring import ColumnReading, TipView
from ...vision.tips import pipette_class, tip_for
from ...vision.types import TrajectorySample
from ...vocabulary import Gate, KeyframeKind, Outcome, Route
from .lopo import ALPHA, HeldOut, ScoredWell

BAND_WELLS = 4
"""Calibration wells from which a band is set."""


@dataclass(frozen=True)
class JudgedWell:
    """One well as the cascade treated it.

    Attributes:
        scored: The well with its score; its standing is the threshold's, not the band's.
        triage: Where it was sent, and why.
        readings: Measured columns by keyframe.
        decision: What came of it.
    """

    scored: ScoredWell
    triage: Triage
    readings: Mapping[KeyframeKind, ColumnReading]
    decision: GateDecision

    @property
    def sample(self) -> TrajectorySample:
        return self.scored.sample

    @property
    def calibration(self) -> bool:
        """Whether the plate was calibrated on it: assumed normal, and not scored."""
        return self.triage.route is Route.CALIBRATION

    @property
    def flagged(self) -> bool:
        """Failed, or left to the operator."""
        return self.decision.outcome is not Outcome.PASS


def run_cascade(held: HeldOut, asked: Sequence[ConfirmingGate] = ()) -> list[JudgedWell]:
    """Judge every well of every plate, in the order in which they were pipetted.

    Args:
        held: The scored wells.
        asked: Gates between the volumetric one and the operator.
    """
    judged: list[JudgedWell] = []
    for anchor, wells in held.plates():
        leading = [anchor]
        for well in wells:
            if well.failed or len(leading) >= PRESETS["default"].wells:
                break
            leading.append(well)
        if len(leading) < BAND_WELLS:
            leading = leading[:1]
        judged += _Plate(leading, held, asked).judge([anchor, *wells])
    return judged


class _Plate:
    def __init__(
        self, leading: Sequence[ScoredWell], held: HeldOut, asked: Sequence[ConfirmingGate]
    ) -> None:
        self._leading = leading
        self._name = held.scorer
        self._p_values = held.gives_p_values
        settings = replace(PRESETS["default"], wells=len(leading))
        self._cascade = Cascade(self._name, settings)
        self._reader = MeasuredColumns()
        self._gates = Gates((VolumetricGate(), *asked, OperatorGate()))
        self._banded = len(leading) >= BAND_WELLS
        for well in leading:
            self._reader.learn(self._looks(well.sample), well.sample.expected_ul)
            self._cascade.learn(well.score, normal=True, volume_ul=well.sample.volume_ul)

    def judge(self, wells: Sequence[ScoredWell]) -> list[JudgedWell]:
        return [self._judge(well) for well in wells]

    def _judge(self, well: ScoredWell) -> JudgedWell:
        sample = well.sample
        looks = self._looks(sample)
        readings = self._reader.read(looks, sample.expected_ul)
        if any(well is first for first in self._leading):
            triage = Triage(Route.CALIBRATION, "One of the wells that calibrate this plate.")
            decision = GateDecision(Outcome.PASS, Gate.NONE, triage.reason)
            return JudgedWell(well, triage, readings, decision)
        missing = missing_tips(sample)
        p_value = math.exp(-well.score) if self._p_values else None
        # On a handful of wells, what the scorer flags and nothing clears stays flagged. A long
        # run has its own band, and asks more of an alarm.
        alarm = RUN_ALARM if self._banded else ALPHA
        case = Case(
            sample, Route.GREY_ZONE, well.score, readings, missing, p_value=p_value, alarm_p=alarm
        )
        volumes = self._gates.screen(case)
        contradiction = volumes.reason if volumes.outcome is Outcome.FAIL or case.alarming else ""
        triage = self._triage(well, case, contradiction)
        if not triage.to_gate:
            decision = GateDecision(Outcome.PASS, Gate.NONE, triage.reason)
        else:
            decision = self._gates.confirm(replace(case, route=triage.route))
        normal = decision.outcome is Outcome.PASS
        self._cascade.learn(well.score, normal=normal, volume_ul=sample.volume_ul)
        if normal and KeyframeKind.TRANSIT in looks:
            self._reader.learn(looks, sample.expected_ul)
        return JudgedWell(well, triage, readings, decision)

    def _triage(self, well: ScoredWell, case: Case, contradiction: str) -> Triage:
        triage = self._cascade.triage(case.score, case.missing, contradiction)
        decided = contradiction or triage.route is Route.BLANK_FLOOR
        if self._banded or decided:
            return triage
        if well.standing > 0:
            return Triage(Route.GREY_ZONE, f"The {self._name} score is over the plate's threshold.")
        return Triage(Route.SILENT_PASS, "Under the plate's threshold.")

    def _looks(self, sample: TrajectorySample) -> dict[KeyframeKind, object]:
        tip, pipette = tip_for(sample.pipette), pipette_class(sample.pipette)
        looks: dict[KeyframeKind, object] = {}
        for kind, expected in sample.expected_ul.items():
            found = sample.detections[kind]
            if found is not None:
                view = TipView(kind, sample.frames[kind], found, tip, pipette, expected)
                looks[kind] = self._reader.look(view)
        return looks
