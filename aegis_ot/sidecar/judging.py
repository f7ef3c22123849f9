"""Puts together what judges wells, as the settings say."""

from __future__ import annotations

from ..vision.calibration import CalibrationSettings
from ..vision.column_reader import MeasuredColumns
from ..vision.detection import load_detector
from ..vision.monitor import MonitorSettings, RunMonitor
from .analysis import Analyser
from .config import CascadeSettings


def make_analyser(cascade: CascadeSettings | None = None) -> Analyser:
    """The vision room's monitor with detector, world model, cascade and gates.

    Raises:
        ModelError: A model file is missing, damaged or of another version.
    """
    cascade = cascade or CascadeSettings()
    detector = load_detector("default" if cascade.detector is None else cascade.detector)
    settings = MonitorSettings(
        CalibrationSettings(wells=cascade.calibration_wells, multiplier=cascade.band),
        always_gate=cascade.always_gate,
    )
    return RunMonitor(detector, settings=settings, reader=MeasuredColumns)
