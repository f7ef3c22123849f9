"""The model's part in a check: the checks judge first, then the model is asked.

Nothing of the reasoning room is loaded before a model is asked: the rehearsing process loads
this package too, and has no use for it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..preflight import Database, Options, Report
from ..preflight.dossier import Dossier
from .rehearser import Rehearser, TaskFailed
from .tasks import Check

if TYPE_CHECKING:
    from ..reasoning import Backend, Judgement


@dataclass(frozen=True)
class Asking:
    """Whom to ask about each protocol, and how.

    Attributes:
        backend: Whom.
        configuration: ``hybrid``, ``trace-blind`` or ``llm-only``, see
            :mod:`aegis_ot.reasoning.configurations`.
    """

    backend: Backend
    configuration: str = "hybrid"


def ask_model(
    asking: Asking,
    rehearser: Rehearser,
    check: Check,
    report: Report,
    dossier: Dossier,
    database: Database,
) -> Judgement:
    """Judge a protocol, already checked, with a model.

    Args:
        asking: Whom to ask.
        rehearser: Rehearses once more where the model reads roles that names leave open.
        check: How it was checked.
        report: What the checks say.
        dossier: What the model gets to know.
        database: The rules in force.
    """
    from ..reasoning import judge_in

    def rejudge(with_roles: Options) -> Report | None:
        try:
            second: Report = rehearser.perform(replace(check, options=with_roles))
        except TaskFailed:
            return None  # it could be rehearsed a moment ago: the model's roles are only told
        return second

    return judge_in(
        asking.configuration, report, dossier, database, asking.backend, check.options, rejudge
    )
