"""The model's part in a check: the checks judge first, then the model is asked.

Nothing of the reasoning room is loaded before a model is asked: the rehearsing process loads
this package too, and has no use for it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..preflight import Options, Report, RuleSet
from ..vocabulary import Dossier

if TYPE_CHECKING:
    from ..adapters.opentrons.rehearsal import Recording
    from ..llm import Backend, Judgement


@dataclass(frozen=True)
class Asking:
    """Whom to ask about each protocol, and how.

    Attributes:
        backend: Whom.
        judge: Judges with the model, where not :func:`aegis_ot.llm.hybrid` does.
    """

    backend: Backend
    judge: Callable[..., Judgement] | None = None


def ask_model(
    asking: Asking,
    report: Report,
    dossier: Dossier,
    recording: Recording,
    rule_set: RuleSet,
    options: Options,
) -> Judgement:
    """Judge a protocol, already checked, with a model.

    Args:
        asking: Whom to ask.
        report: What the checks say.
        dossier: What the model gets to know.
        recording: Judged again with what the model reads.
        rule_set: The rules in force.
        options: How it was checked.
    """
    from ..llm import hybrid
    from ..preflight import Interpretation

    reading = Interpretation(recording, rule_set, options)
    return (asking.judge or hybrid)(report, dossier, reading, asking.backend)
