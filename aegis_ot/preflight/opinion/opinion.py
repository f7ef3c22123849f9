"""A model's opinion of a protocol, as it crosses the wire."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...vocabulary import Finding, Undecided
from ..judging import MODEL


@dataclass(frozen=True)
class Citation:
    """Where the protocol says something: the words, verbatim, at a source line."""

    line: int
    quote: str


@dataclass(frozen=True)
class RoleProposal:
    """What a model takes wells for, and where it read that.

    Attributes:
        role: Name of a role: ``"ntc"``.
        wells: Places: ``"4:H12"``, ``"4:A1-H1"``.
        levels: Concentrations or doses as they are written: one for all wells, or one each.
        citations: What says so.
    """

    role: str
    wells: tuple[str, ...]
    levels: tuple[str, ...] = ()
    citations: tuple[Citation, ...] = ()


@dataclass(frozen=True)
class RuleAnswer:
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
        proposals: What it takes wells for; not yet verified.
        answers: To the open questions.
        findings: Violations that it sees, in wells and lines that exist.
        left_out: What it said that cannot be used, and why.
        summary: Its own words.
    """

    state: str
    model: str
    detail: str = ""
    family: str = ""
    proposals: tuple[RoleProposal, ...] = ()
    answers: tuple[RuleAnswer, ...] = ()
    findings: tuple[Finding, ...] = ()
    left_out: tuple[str, ...] = ()
    summary: str = ""

    @property
    def answered(self) -> bool:
        """Whether the model gave an answer."""
        return self.state == "answered"


def no_answer(opinion: Opinion) -> Undecided:
    """What a report says of a model that was asked in vain."""
    return Undecided(MODEL, f"{opinion.model} gave no answer ({opinion.state}): {opinion.detail}")


def is_known(finding: Finding, others: Sequence[Finding]) -> bool:
    """Whether one of the others is of the same rule, and of some of the same wells."""
    return any(
        other.rule == finding.rule and not set(other.wells).isdisjoint(finding.wells)
        for other in others
    )
