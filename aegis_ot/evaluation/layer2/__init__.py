"""Layer 2 evaluated: leave-one-plate-out, figures, and the world model of a lab."""

from .evaluate import PROTOCOLS, THRESHOLDS, evaluate_layer2
from .figures import draw_figures
from .fitting import fit_model
from .metrics import Interval
from .result import Layer2Result

__all__ = [
    "PROTOCOLS",
    "THRESHOLDS",
    "Interval",
    "Layer2Result",
    "draw_figures",
    "evaluate_layer2",
    "fit_model",
]
