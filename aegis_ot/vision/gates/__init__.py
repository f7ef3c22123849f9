"""Gates: the second look that confirms or rejects a flagged well.

Each stands behind :class:`ConfirmingGate`: the volumes that were measured, a vision model
(``aegis_ot.llm.vlm``), the operator. :class:`Gates` asks them in turn.
"""

from .case import ALARM_P, ConfirmingGate, Cost, GateDecision, GateInput
from .chain import Gates, in_sentences
from .operator import OperatorGate
from .volumetric import VolumetricGate, VolumetricLimits

__all__ = [
    "ALARM_P",
    "ConfirmingGate",
    "Cost",
    "GateDecision",
    "GateInput",
    "Gates",
    "OperatorGate",
    "VolumetricGate",
    "VolumetricLimits",
    "in_sentences",
]
