"""Layer 2 evaluated: leave-one-plate-out, and figures."""

from .evaluate import LEAVE_OUT, PROTOCOLS, THRESHOLDS, evaluate_layer2
from .figures import draw_figures
from .metrics import Interval
from .result import Layer2Result

__all__ = [
    "LEAVE_OUT",
    "PROTOCOLS",
    "THRESHOLDS",
    "Interval",
    "Layer2Result",
    "draw_figures",
    "evaluate_layer2",
]
