"""Layer 1 evaluated: any folder in the protocol benchmark format, any judge of protocols."""

from .evaluate import evaluate_layer1, score_predictions
from .labels import LABELS, Label, read_labels
from .metrics import Interval, Scores
from .predictions import Judge, Prediction, RulesOnly
from .result import Layer1Result

__all__ = [
    "LABELS",
    "Interval",
    "Judge",
    "Label",
    "Layer1Result",
    "Prediction",
    "RulesOnly",
    "Scores",
    "evaluate_layer1",
    "read_labels",
    "score_predictions",
]
