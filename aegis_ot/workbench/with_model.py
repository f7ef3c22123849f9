"""The model's part in a check: the checks judge first, then the model is asked.

Nothing of the reasoning room is loaded before a model is asked: the rehearsing process loads
this package too, and has no use for it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..preflight import Options, Report, RuleSet
from .tasks import Examined

if TYPE_CHECKING:
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
    asking: Asking, report: Report, examined: Examined, rule_set: RuleSet, options: Options
) -> Judgement:
    """Judge a protocol, already checked, with a model.

    Args:
        asking: Whom to ask.
        report: What the checks say.
        examined: What the model gets to know, and the recording, which is judged again with what
            the model reads.
        rule_set: The rules in force.
        options: How it was checked.
    """
    from ..llm import hybrid
    from ..preflight import Interpretation

    reading = Interpretation(examined.recording, rule_set, options)
    return (asking.judge or hybrid)(report, examined.dossier, reading, asking.backend)
