"""From settings to the analyser: detector, scorer, calibration, gates of the vision room."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError, ModelError
from ..vision.calibration import PRESETS
from ..vision.detection import load_detector
from ..vision.gates import ConfirmingGate, OperatorGate, measuring_gates
from ..vision.lab_limits import LabLimits
from ..vision.models import SHIPPED, load_model
from ..vision.run_analyser_factory import MonitorSettings, RunAnalyserFactory
from ..vision.scorers import make_scorer
from ..vision.second_opinion import SpotCheck
from ..vision.types import Detector, Scorer
from .analysis import Analyser
from .config import CascadeSettings


def make_detector(cascade: CascadeSettings | None = None) -> Detector:
    """The tip detector that the settings name; the shipped one by default.

    Raises:
        ModelError: Its file is missing, damaged or of another layout.
    """
    chosen = None if cascade is None else cascade.detector
    return load_detector("default" if chosen is None else chosen)


def make_analyser(
    cascade: CascadeSettings | None = None,
    gates: Mapping[str, ConfirmingGate] | None = None,
    detector: Detector | None = None,
) -> Analyser:
    """The vision room's monitor with detector, world model, cascade and gates.

    Args:
        cascade: Which models and limits; the defaults if left out.
        gates: Gates by name that the vision room cannot make itself (``"vlm"``).
        detector: From :func:`make_detector`, if it is there already.

    Raises:
        ConfigurationError: A gate is asked for that nobody gave, or a limit is out of range.
        ModelError: A model file is missing, damaged or of another version.
    """
    cascade = cascade or CascadeSettings()
    known: dict[str, ConfirmingGate] = measuring_gates() | dict(gates or {})
    missing = [name for name in cascade.gates if name not in known]
    if missing:
        raise ConfigurationError(
            f"The gate {missing[0]!r} is asked for, but none is set up. Configure a model for it, "
            "or leave it out of cascade.gates."
        )
    given: dict[str, Any] = {
        "wells": cascade.calibration_wells,
        "multiplier": cascade.band,
        "score_floor": cascade.blank_floor,
    }
    calibration = dataclasses.replace(
        PRESETS[cascade.preset],
        **{name: value for name, value in given.items() if value is not None},
    )
    return RunAnalyserFactory(
        detector or make_detector(cascade),
        _world_model(cascade),
        MonitorSettings(
            calibration,
            cascade.always_gate,
            cascade.first_wells == "ask",
            SpotCheck(cascade.spot_check),
            cascade.first_channel,
        ),
        [*(known[name] for name in cascade.gates), OperatorGate()],
    )


def _world_model(cascade: CascadeSettings) -> Scorer | None:
    """The lab's own, or the shipped one; the paper's cascade learns from the run's first wells."""
    if cascade.model is not None:
        return load_scorer(cascade.model)
    return None if cascade.preset == "paper" else load_scorer(SHIPPED)


def load_scorer(path: Path) -> Scorer:
    """A fitted scorer from the model file that ``aegis-ot fit`` wrote, with the lab's limits.

    Raises:
        ModelError: The file is damaged, or holds no scorer.
    """
    model = load_model(path)
    try:
        kind: Any = type(make_scorer(model.kind))
        scorer: Scorer = kind.from_model(model)
        scorer.lab_limits = LabLimits.from_model(model)  # type: ignore[attr-defined]
    except (ConfigurationError, AttributeError) as error:
        raise ModelError(f"{path}: holds a {model.kind!r} model, which is no scorer.") from error
    return scorer
