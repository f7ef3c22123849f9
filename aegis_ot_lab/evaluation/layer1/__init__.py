"""Layer 1 evaluated: any folder in the protocol benchmark format, any judge of protocols."""

from .bill import Bill
from .evaluate import evaluate_layer1, score_predictions
from .figures import draw_ablation
from .labels import LABELS, Label, read_labels
from .metrics import BootstrapInterval, Scores
from .predictions import Checking, Judge, Prediction
from .result import Layer1Result

__all__ = [
    "LABELS",
    "Bill",
    "BootstrapInterval",
    "Checking",
    "Judge",
    "Label",
    "Layer1Result",
    "Prediction",
    "Scores",
    "draw_ablation",
    "evaluate_layer1",
    "read_labels",
    "score_predictions",
]
