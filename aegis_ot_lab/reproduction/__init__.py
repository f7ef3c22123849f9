"""Every table and figure of the paper by one command: ``aegis-ot reproduce``.

An experiment is a short module that makes an :class:`~.experiment.ExperimentOutcome`;
:data:`EXPERIMENTS` lists them, :func:`reproduce` runs them and keeps what is finished.
"""

from . import (
    baselines,
    calibration,
    components,
    cost,
    detector,
    fleet,
    latency,
    layer1,
    leave_one_out,
    live,
    multi_bug,
    rules,
)
from .context import Context, ReproductionOptions, as_json
from .experiment import Experiment, ExperimentOutcome
from .page import reproduction_html, reproduction_json
from .runner import Entry, reproduce

EXPERIMENTS: tuple[Experiment, ...] = (
    rules.EXPERIMENT,
    layer1.EXPERIMENT,
    multi_bug.EXPERIMENT,
    detector.EXPERIMENT,
    leave_one_out.P1000,
    leave_one_out.P20,
    baselines.EXPERIMENT,
    components.EXPERIMENT,
    calibration.EXPERIMENT,
    live.EXPERIMENT,
    cost.EXPERIMENT,
    latency.EXPERIMENT,
    fleet.EXPERIMENT,
)
"""In the order of the page."""

__all__ = [
    "EXPERIMENTS",
    "Context",
    "Entry",
    "Experiment",
    "ExperimentOutcome",
    "ReproductionOptions",
    "as_json",
    "reproduce",
    "reproduction_html",
    "reproduction_json",
]
