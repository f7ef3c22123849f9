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

import functools
from collections.abc import Iterator
from dataclasses import replace
from enum import Enum
from typing import Any

from aegis_ot.llm import Backend, Judgement, Reply, Request
from aegis_ot.llm.answer import ANSWER_SCHEMA, strict_object
from aegis_ot.llm.backend import Message
from aegis_ot.llm.hybrid import ask, hybrid, opinion_of
from aegis_ot.llm.layer1_prompt import (
    PURPOSE,
    fenced,
    hybrid_request,
    rules_text,
    source_part,
    system_passages,
)
from aegis_ot.llm.prompts_text import prompt
from aegis_ot.llm.read_answer import Bounds
from aegis_ot.preflight import Report, RuleSet
from aegis_ot.preflight.judging import MODEL, Interpretation, verdict_of
from aegis_ot.preflight.opinion import no_answer
from aegis_ot.preflight.source import source_lines
from aegis_ot.vocabulary import Dossier, Severity, Undecided, VerdictWord, WellRef
from aegis_ot.workbench import Asking

BLIND_SCHEMA: dict[str, Any] = strict_object(
    family={"type": "string"},
    findings=ANSWER_SCHEMA["properties"]["findings"],
    summary={"type": "string"},
)
"""For the configurations that get neither roles nor questions."""


class AskingConfiguration(str, Enum):
    """See the module."""

    HYBRID = "hybrid"
    LLM_ONLY = "llm-only"
    RULES_ONLY = "rules-only"
    TRACE_BLIND = "trace-blind"


def asking_in(configuration: AskingConfiguration | str, backend: Backend) -> Asking:
    """Whom the workbench is to ask, and how."""
    return Asking(backend, functools.partial(judge_in, configuration))


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
        return Judgement(report)
    if configuration is AskingConfiguration.HYBRID:
        return hybrid(report, dossier, reading, backend)
    if configuration is AskingConfiguration.TRACE_BLIND:
        reply = ask(backend, blind_request(dossier, reading.rule_set))
        return _model_alone(report, dossier, reply)
    reply = ask(backend, llm_only_request(dossier, reading.rule_set))
    return _model_alone(report, dossier, _own_rules(reply), severe=True)


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


def blind_request(dossier: Dossier, rule_set: RuleSet) -> Request:
    """Rules, API reference and source: the paper's own prompt, without the trace."""
    return _request("blind", rules_text(rule_set), dossier)


def llm_only_request(dossier: Dossier, rule_set: RuleSet) -> Request:
    """API reference and source; rules withheld, the families' names given."""
    families = ", ".join(family.family for family in rule_set.assays)
    return _request("llm_only", f"Assay families: {families}.", dossier)


def _request(task: str, rules: str, dossier: Dossier) -> Request:
    return Request(
        PURPOSE,
        system_passages(prompt(task, "aegis_ot_lab"), rules),
        (Message((fenced(source_part(dossier)),)),),
        BLIND_SCHEMA,
    )


def _own_rules(reply: Reply) -> Reply:
    """The rules were withheld, so whatever the model calls one is its own."""
    if reply.value is None:
        return reply
    findings = [{**finding, "rule": MODEL} for finding in reply.value["findings"]]
    return replace(reply, value={**reply.value, "findings": findings})


def _model_alone(report: Report, dossier: Dossier, reply: Reply, severe: bool = False) -> Judgement:
    """What a model says without a check beside it is what there is; if ``severe``, as errors."""
    lines = range(1, len(source_lines(dossier.source)) + 1)
    opinion = opinion_of(reply, dossier, Bounds(dossier, _on_deck(dossier), lines))
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
    return Judgement(alone, reply)


def _on_deck(dossier: Dossier) -> Iterator[tuple[WellRef, str]]:
    """Every well on the deck, column by column, with its labware's load name."""
    for item in dossier.deck:
        for column in range(item.columns):
            for row in range(item.rows):
                name = f"{chr(ord('A') + row)}{column + 1}"
                yield WellRef(item.key, name, item.label, item.slot), item.load_name
