"""Gates: the second look that confirms or rejects a flagged well.

Each stands behind :class:`ConfirmingGate`: the volumes that were measured, a vision model
(``aegis_ot.reasoning.vlm``), the operator. :class:`Gates` asks them in turn.
"""

from .case import ALARM_P, Case, ConfirmingGate, Cost, GateDecision
from .chain import Gates, in_sentences
from .operator import OperatorGate
from .volumetric import VolumetricGate, VolumetricLimits

__all__ = [
    "ALARM_P",
    "Case",
    "ConfirmingGate",
    "Cost",
    "GateDecision",
    "Gates",
    "OperatorGate",
    "VolumetricGate",
    "VolumetricLimits",
    "in_sentences",
]
