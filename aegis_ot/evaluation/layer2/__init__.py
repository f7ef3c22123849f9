"""Layer 2 evaluated: leave-one-plate-out, figures, and the world model of a lab."""

from .evaluate import LEAVE_OUT, PROTOCOLS, THRESHOLDS, FoundTips, evaluate_layer2, find_tips
from .figures import draw_figures
from .fitting import fit_model
from .metrics import Interval
from .progress import Progress
from .result import Layer2Result

__all__ = [
    "LEAVE_OUT",
    "PROTOCOLS",
    "THRESHOLDS",
    "FoundTips",
    "Interval",
    "Layer2Result",
    "Progress",
    "draw_figures",
    "evaluate_layer2",
    "find_tips",
    "fit_model",
]
