"""A model's opinion of a protocol, as it crosses the wire. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass

from ..vocabulary import Finding, Undecided, WellRef
from .judging import MODEL, Report

ANSWERED = "answered"


@dataclass(frozen=True)
class RoleReading:
    """What the model takes wells for."""

    role: str
    wells: tuple[WellRef, ...]
    reason: str = ""


@dataclass(frozen=True)
class RuleReading:
    """The model's answer to an open question: ``holds``, ``violated`` or ``cannot_tell``."""

    rule: str
    answer: str
    reason: str = ""


@dataclass(frozen=True)
class Opinion:
    """What came of asking a model about one protocol.

    Attributes:
        state: ``answered``, or why there is no answer.
        model: Who was asked.
        detail: One sentence on what went wrong.
        family: The assay family that it reads, or ``""``.
        roles: What it takes wells for.
        answers: To the open questions.
        findings: Violations that it sees, in wells and lines that exist.
        left_out: What it said that cannot be used, and why.
        summary: Its own words.
    """

    state: str
    model: str
    detail: str = ""
    family: str = ""
    roles: tuple[RoleReading, ...] = ()
    answers: tuple[RuleReading, ...] = ()
    findings: tuple[Finding, ...] = ()
    left_out: tuple[str, ...] = ()
    summary: str = ""

    @property
    def answered(self) -> bool:
        """Whether the model gave an answer."""
        return self.state == ANSWERED


def no_answer(opinion: Opinion) -> Undecided:
    """What a report says of a model that was asked in vain."""
    return Undecided(MODEL, f"{opinion.model} gave no answer ({opinion.state}): {opinion.detail}")


def unanswered(report: Report) -> str:
    """Why the model that was asked gave no answer, or ``""``: a reason for exit code 2."""
    return next((u.reason for u in report.undecided if u.rule == MODEL), "")
