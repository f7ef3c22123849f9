"""Gates: the second look that confirms or rejects a flagged well.

Each stands behind :class:`ConfirmingGate`: the volumes that were measured, a vision model
(``aegis_ot.llm.vlm``), the operator. :class:`Gates` asks them in turn.
"""

from importlib import import_module

from ...vocabulary import Gate
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
    "measuring_gates",
]


def measuring_gates() -> dict[str, ConfirmingGate]:
    """Those that the settings may ask for and that need no model, by name.

    Each stands in a module that is named as it is, whose ``make`` makes it.
    """
    traits = {gate.value: gate.traits for gate in Gate}
    names = [name for name, its in traits.items() if its.may_be_asked_for and not its.is_model]
    return {name: import_module(f".{name}", __name__).make() for name in names}
