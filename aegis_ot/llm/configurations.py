"""The four ways to judge a protocol that the evaluation compares (paper, "Layer 1 results").

``hybrid``
    The checks decide; a model that sees source, rules, trace and roles adds to them. Ours.
``trace-blind``
    A model that sees source and rules alone decides: the paper's own hybrid. What the trace is
    worth is the difference to ``hybrid``.
``llm-only``
    A model that sees the source alone decides: rules withheld.
``rules-only``
    The checks alone. No model is asked.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from ..preflight import Report, RuleSet
from ..preflight.judging import MODEL, Interpretation, verdict_of
from ..preflight.opinion import merge, no_answer
from ..vocabulary import Dossier, Opinion, Severity, Undecided, VerdictWord
from .backend import Backend, Reply, Request, State, TokenUsage
from .layer1_prompt import blind_request, hybrid_request, llm_only_request
from .read_answer import read_opinion


class AskingConfiguration(str, Enum):
    """See the module."""

    HYBRID = "hybrid"
    LLM_ONLY = "llm-only"
    RULES_ONLY = "rules-only"
    TRACE_BLIND = "trace-blind"


@dataclass(frozen=True)
class Judgement:
    """One protocol judged in one configuration.

    Attributes:
        configuration: Which.
        report: The verdict. Where the model gave no answer, ``undecided`` holds an entry for
            ``MODEL`` that says why; without checks beside it the verdict is ``error`` then.
        reply: What came of asking the model; ``None`` if none was to be asked.
    """

    configuration: AskingConfiguration
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


def judge_in(
    configuration: AskingConfiguration | str,
    report: Report,
    dossier: Dossier,
    reading: Interpretation,
    backend: Backend | None = None,
) -> Judgement:
    """Judge a protocol, already rehearsed and checked, in one configuration.

    Args:
        configuration: Which.
        report: What the checks say.
        dossier: From :func:`aegis_ot.preflight.opinion.make_dossier`.
        reading: What both were made from.
        backend: Whom to ask; not needed for ``rules-only``.
    """
    configuration = AskingConfiguration(configuration)
    if configuration is AskingConfiguration.RULES_ONLY:
        return rules_only(report)
    if configuration is AskingConfiguration.HYBRID:
        return hybrid(report, dossier, reading, backend)
    if configuration is AskingConfiguration.TRACE_BLIND:
        return trace_blind(report, dossier, reading.rule_set, backend)
    return llm_only(report, dossier, reading.rule_set, backend)


def request_in(
    configuration: AskingConfiguration | str, dossier: Dossier, rule_set: RuleSet
) -> Request | None:
    """The request that a configuration makes; ``None`` for ``rules-only``."""
    makers = {
        AskingConfiguration.HYBRID: hybrid_request,
        AskingConfiguration.TRACE_BLIND: blind_request,
        AskingConfiguration.LLM_ONLY: llm_only_request,
    }
    make = makers.get(AskingConfiguration(configuration))
    return None if make is None else make(dossier, rule_set)


def rules_only(report: Report) -> Judgement:
    """The checks alone."""
    return Judgement(AskingConfiguration.RULES_ONLY, report)


def hybrid(
    report: Report, dossier: Dossier, reading: Interpretation, backend: Backend | None
) -> Judgement:
    """The checks, and a model that sees what they saw; it can only add."""
    reply = ask(backend, hybrid_request(dossier, reading.rule_set))
    merged = merge(report, opinion_of(reply, dossier), reading)
    return Judgement(AskingConfiguration.HYBRID, merged, reply)


def trace_blind(
    report: Report, dossier: Dossier, rule_set: RuleSet, backend: Backend | None
) -> Judgement:
    """A model with rules and source decides alone (the paper's hybrid)."""
    reply = ask(backend, blind_request(dossier, rule_set))
    return _model_alone(AskingConfiguration.TRACE_BLIND, report, dossier, reply)


def llm_only(
    report: Report, dossier: Dossier, rule_set: RuleSet, backend: Backend | None
) -> Judgement:
    """A model with the source decides alone, by what it knows itself.

    The rules are withheld, so whatever it calls one is its own.
    """
    reply = ask(backend, llm_only_request(dossier, rule_set))
    if reply.value is not None:
        findings = [{**finding, "rule": MODEL} for finding in reply.value["findings"]]
        reply = replace(reply, value={**reply.value, "findings": findings})
    return _model_alone(AskingConfiguration.LLM_ONLY, report, dossier, reply)


def give_opinion(dossier: Dossier, rule_set: RuleSet, backend: Backend | None) -> Opinion:
    """Ask the hybrid question, and hold the answer to what exists."""
    return opinion_of(ask(backend, hybrid_request(dossier, rule_set)), dossier)


def opinion_of(reply: Reply, dossier: Dossier, blind: bool = False) -> Opinion:
    """A reply to a Layer 1 request as an opinion."""
    if reply.value is None:
        return Opinion(reply.state.value, reply.model, reply.detail)
    return read_opinion(reply.value, dossier, reply.model, blind)


def ask(backend: Backend | None, request: Request) -> Reply:
    """Ask, where there is someone to ask."""
    if backend is None:
        detail = "Name one with --model, or in AEGIS_OT_MODEL."
        return Reply(State.NO_MODEL, "no model", detail=detail, attempts=0)
    return backend.ask(request)


def _model_alone(
    configuration: AskingConfiguration, report: Report, dossier: Dossier, reply: Reply
) -> Judgement:
    opinion = opinion_of(reply, dossier, blind=True)
    # No check stands beside these: what the model reports is what there is.
    severe = configuration is AskingConfiguration.LLM_ONLY
    findings = tuple(
        replace(finding, severity=Severity.ERROR) if severe else finding
        for finding in opinion.findings
    )
    undecided: tuple[Undecided, ...] = ()
    if opinion.answered:
        verdict = verdict_of(findings)
    else:
        verdict = VerdictWord.ERROR
        undecided = (no_answer(opinion),)
    alone = Report(
        file=report.file,
        family=opinion.family,
        verdict=verdict,
        findings=findings,
        undecided=undecided,
        notes=tuple(f"{opinion.model}, left out: {text}" for text in opinion.left_out),
    )
    return Judgement(configuration, alone, reply)
