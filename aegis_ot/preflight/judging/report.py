"""The verdict on one protocol, with all that led to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...vocabulary import Finding, Remark, Severity, Undecided, VerdictWord, WellRef
from ..roles import Inference
from .waivers import MODEL, Waived


@dataclass(frozen=True)
class RoleEvidence:
    """One well's role with its evidence, for ``--explain-roles``.

    ``derived``: it follows from what the run does with the well; nothing names it.
    """

    family: str
    well: WellRef
    role: str
    evidence: tuple[str, ...]
    level: float | None = None
    conflict: str = ""
    derived: bool = False


@dataclass(frozen=True)
class Report:
    """The verdict on one protocol.

    Attributes:
        file: Name of the protocol file.
        family: The likeliest family.
        verdict: ``fail`` with any error, ``warn`` with warnings only, ``pass`` otherwise.
        findings: Violations that stand.
        undecided: Rules that could not be judged.
        roles: Every role assignment, with evidence.
        families: All families, the likeliest first.
        waived: Findings that a waiver covers.
        notes: What a model, or a check on a workstation, has to say beyond findings.
        remarks: Conflicting evidence, stale and faulty waivers.
        judged: Rules that were judged to the end.
        unnamed: Wells that the run uses and of which nothing says what they are for.
    """

    file: str
    family: str
    verdict: VerdictWord
    findings: tuple[Finding, ...]
    undecided: tuple[Undecided, ...]
    roles: tuple[RoleEvidence, ...] = ()
    families: tuple[Inference, ...] = ()
    waived: tuple[Waived, ...] = ()
    notes: tuple[str, ...] = ()
    remarks: tuple[Remark, ...] = ()
    judged: tuple[str, ...] = ()
    unnamed: tuple[WellRef, ...] = ()


def verdict_of(findings: Sequence[Finding]) -> VerdictWord:
    """``fail`` with any error, ``warn`` with warnings only, ``pass`` otherwise."""
    if any(finding.severity is Severity.ERROR for finding in findings):
        return VerdictWord.FAIL
    return VerdictWord.WARN if findings else VerdictWord.PASS


def unanswered(report: Report) -> str:
    """Why the model that was asked gave no answer, or ``""``: a reason for exit code 2."""
    return next((u.reason for u in report.undecided if u.rule == MODEL), "")
