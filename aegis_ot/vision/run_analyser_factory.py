"""The judge of live runs: frames in as they come, a verdict per trajectory out.

The sidecar calls it through the protocols of ``aegis_ot.sidecar.analysis``, which this module
matches without importing them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .analyser import Judged, RunAnalyser
from .calibration import CalibrationSettings
from .calibration_group import CalibrationGroup
from .column_reader import MeasuredColumns
from .first_wells import FirstWells
from .gates import ConfirmingGate, Gates, OperatorGate, VolumetricGate
from .rows import ChannelAnalyser, FirstChannel
from .second_opinion import SecondOpinion, SpotCheck
from .types import Detector, Scorer

__all__ = ["Judged", "MonitorSettings", "RunAnalyserFactory"]


@dataclass(frozen=True)
class MonitorSettings:
    """How a run is judged.

    Attributes:
        calibration: See :class:`CalibrationSettings`.
        always_gate: Send every well after calibration to the gates.
        ask_first: Ask the operator about first wells whose frames prove nothing.
        spot_check: Which wells that pass a vision model sees, if there is one.
        first_channel: On which side of the frame a multi-channel pipette's first channel is.
    """

    calibration: CalibrationSettings = field(default_factory=CalibrationSettings)
    always_gate: bool = False
    ask_first: bool = True
    spot_check: SpotCheck = field(default_factory=SpotCheck)
    first_channel: FirstChannel = "auto"


class RunAnalyserFactory:
    """Makes one :class:`~.analyser.RunAnalyser` per run.

    Args:
        detector: Finds the tip.
        scorer: World model, fitted on earlier normals; ``None``: a PCA is fitted on each run's
            own first wells.
        settings: See :class:`MonitorSettings`.
        gates: Asked in turn; by default the volumetric gate, then the operator. A VLM gate goes
            between them.
    """

    def __init__(
        self,
        detector: Detector,
        scorer: Scorer | None = None,
        settings: MonitorSettings | None = None,
        gates: Sequence[ConfirmingGate] | None = None,
    ) -> None:
        self.detector = detector
        self.scorer = scorer
        self.settings = settings or MonitorSettings()
        self.gates = Gates((VolumetricGate(), OperatorGate()) if gates is None else gates)

    def begin(self, run: str, history: Sequence[Judged] = ()) -> RunAnalyser:
        """A run starts, or goes on after the sidecar was restarted.

        After a restart the scores in ``history`` restore the band. The column reader and what a
        world model learned of the run are not restored: both calibrate anew on the wells that
        follow, and without a model file so does the band.
        """
        first = FirstWells(self.settings.ask_first)
        second = SecondOpinion(self.gates, self.settings.spot_check)
        analyser = ChannelAnalyser(run, self.detector, self._stream, self.gates, first, second)
        analyser.first_channel = self.settings.first_channel
        if self.scorer is not None:
            analyser.recall(history)
        return analyser

    def _stream(self, kin: CalibrationGroup | None) -> CalibrationGroup:
        settings = self.settings
        return CalibrationGroup(
            self.scorer,
            MeasuredColumns(),
            settings.calibration,
            settings.always_gate,
            kin,
            self.gates,
        )
