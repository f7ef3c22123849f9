"""Layer 1 with a model: the checks decide, and a model that sees what they saw adds to them.

The other ways to judge, which the evaluation compares with this one, are the laboratory's
(``aegis_ot_lab/configurations.py``).
"""

from __future__ import annotations

from dataclasses import dataclass

from ..preflight import Report, RuleSet
from ..preflight.judging import Interpretation
from ..preflight.opinion import merge
from ..vocabulary import Dossier, Opinion
from .backend import Backend, Reply, Request, State, TokenUsage
from .layer1_prompt import hybrid_request
from .read_answer import Bounds, read_opinion


@dataclass(frozen=True)
class Judgement:
    """One protocol judged with a model.

    Attributes:
        report: The verdict. Where the model gave no answer, ``undecided`` holds an entry for
            ``MODEL`` that says why; without checks beside it the verdict is ``error`` then.
        reply: What came of asking the model; ``None`` if none was to be asked.
    """

    report: Report
    reply: Reply | None = None

    @property
    def unanswered(self) -> bool:
        """Whether a model was asked and gave no answer: a reason for exit code 2."""
        return self.reply is not None and not self.reply.answered

    @property
    def usage(self) -> TokenUsage:
        """Tokens."""
        return self.reply.usage if self.reply else TokenUsage()


def hybrid(
    report: Report, dossier: Dossier, reading: Interpretation, backend: Backend | None = None
) -> Judgement:
    """Judge a protocol, already rehearsed and checked, with a model; it can only add.

    Args:
        report: What the checks say.
        dossier: From :func:`aegis_ot.preflight.opinion.make_dossier`.
        reading: What both were made from.
        backend: Whom to ask.
    """
    reply = ask(backend, hybrid_request(dossier, reading.rule_set))
    return Judgement(merge(report, opinion_of(reply, dossier), reading), reply)


def give_opinion(dossier: Dossier, rule_set: RuleSet, backend: Backend | None) -> Opinion:
    """Ask the hybrid question, and hold the answer to what exists."""
    return opinion_of(ask(backend, hybrid_request(dossier, rule_set)), dossier)


def opinion_of(reply: Reply, dossier: Dossier, bounds: Bounds | None = None) -> Opinion:
    """A reply to a Layer 1 request as an opinion."""
    if reply.value is None:
        return Opinion(reply.state.value, reply.model, reply.detail)
    return read_opinion(reply.value, dossier, reply.model, bounds)


def ask(backend: Backend | None, request: Request) -> Reply:
    """Ask, where there is someone to ask."""
    if backend is None:
        detail = "Name one with --model, or in AEGIS_OT_MODEL."
        return Reply(State.NO_MODEL, "no model", detail=detail, attempts=0)
    return backend.ask(request)
