"""Merges a model's opinion with what the checks decided. The robot does it as well.

The merge can only add. Every finding of the checks stays, whatever the model says; a rule that
the checks decided stays decided, and where the model disagrees a note says so; an open question
stays listed, with the model's reading beside it, unless the model shows a violation in wells and
lines that the trace holds. So no text in a protocol that talks a model round can change what the
checks found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ..vocabulary import Finding, Severity, Undecided, VerdictWord
from .dossier import Dossier
from .judging import (
    Options,
    Report,
    RoleEvidence,
    Waived,
    apply_waivers,
    read_waivers,
)
from .opinion import Opinion, no_answer
from .source import read_source


def options_with_roles(
    options: Options, report: Report, opinion: Opinion, roles: Mapping[str, Iterable[str]]
) -> Options | None:
    """Options to judge once more with what the model reads where names are silent.

    Only wells that no other evidence speaks for get the model's role; the family is taken only
    where it was a guess. ``None`` if the model adds nothing.

    Args:
        options: How it was judged.
        report: The checks' report.
        opinion: The model's.
        roles: Names of roles by family.
    """
    known = {evidence.well for evidence in report.roles}
    first = report.families[0] if report.families else None
    assay = tuple(options.assay)
    if not assay and opinion.family in roles and not (first and first.sure):
        assay = (opinion.family,)
    in_force = assay or tuple(i.family for i in report.families if i.applies)
    names = {name for family in in_force for name in roles.get(family, ())}
    given: dict[str, list[str]] = {role: list(wells) for role, wells in options.roles.items()}
    added = False
    for reading in opinion.roles:
        fresh = [ref for ref in reading.wells if ref not in known]
        if reading.role in names and fresh:
            given.setdefault(reading.role, []).extend(f"{r.labware}:{r.name}" for r in fresh)
            added = True
    if not added and assay == tuple(options.assay):
        return None
    return replace(options, assay=assay, roles=given)


def merge(
    report: Report, opinion: Opinion, dossier: Dossier, second: Report | None = None
) -> Report:
    """The checks' report with the model's opinion added; see the module for what that may do.

    Args:
        report: The checks' report.
        opinion: The model's.
        dossier: What the model was asked about.
        second: What the checks say with the roles that the model read, if that was tried.
    """
    if not opinion.answered:
        return replace(report, undecided=(*report.undecided, no_answer(opinion)))
    decided = {brief.id for brief in dossier.rules if brief.decided}
    notes = [f"{opinion.model}: {opinion.summary}"] if opinion.summary else []
    candidates: list[Finding] = []
    for finding in opinion.findings:
        if finding.rule in decided:
            notes.append(
                f"{opinion.model} disagrees with the check of {finding.rule}, which stands: "
                f"{finding.message}"
            )
        else:
            candidates.append(finding)
    for finding in second.findings if second else ():
        if finding.rule not in decided and not _known(finding, candidates):
            message = f"{finding.message} ({opinion.model} read what the wells are for.)"
            candidates.append(replace(finding, message=message, source="model"))
    notes += [f"{opinion.model}, left out: {text}" for text in opinion.left_out]
    standing, waived = _without_waived(report, candidates)
    findings = sorted(
        (*report.findings, *standing), key=lambda f: (min(f.lines, default=0), f.rule)
    )
    return replace(
        report,
        findings=tuple(findings),
        verdict=_verdict(report.verdict, findings),
        undecided=tuple(_questions(report, opinion, standing, second)),
        waived=(*report.waived, *waived),
        notes=(*report.notes, *notes),
        roles=(*report.roles, *_roles(report, opinion)),
    )


def _known(finding: Finding, others: Sequence[Finding]) -> bool:
    return any(
        other.rule == finding.rule and not set(other.wells).isdisjoint(finding.wells)
        for other in others
    )


def _verdict(before: VerdictWord, findings: Sequence[Finding]) -> VerdictWord:
    if before in (VerdictWord.FAIL, VerdictWord.ERROR):
        return before
    if any(finding.severity is Severity.ERROR for finding in findings):
        return VerdictWord.FAIL
    return VerdictWord.WARN if findings else before


def _questions(
    report: Report, opinion: Opinion, standing: Sequence[Finding], second: Report | None
) -> Iterable[Undecided]:
    found = {finding.rule for finding in standing}
    answers = {answer.rule: answer for answer in opinion.answers}
    still_open = {u.rule for u in second.undecided} if second else set()
    for question in report.undecided:
        if question.rule in found:
            continue
        reason = question.reason
        answer = answers.get(question.rule)
        if answer is not None:
            words = {"holds": "it holds", "violated": "it is violated"}
            said = words.get(answer.answer, "it cannot tell")
            reason += f"; {opinion.model} reads that {said}"
            reason += f": {answer.reason}" if answer.reason else ""
        if second is not None and question.rule not in still_open:
            reason += "; with the roles that it reads, the check finds nothing"
        yield Undecided(question.rule, reason)


def _without_waived(
    report: Report, findings: Sequence[Finding]
) -> tuple[list[Finding], list[Waived]]:
    if not findings:
        return [], []
    text = "\n".join(report.lines)
    return apply_waivers(findings, read_waivers(text, read_source(text)))


def _roles(report: Report, opinion: Opinion) -> Iterable[RoleEvidence]:
    known = {evidence.well for evidence in report.roles}
    for reading in opinion.roles:
        for ref in reading.wells:
            if ref not in known:
                said = f"read by {opinion.model}" + (
                    f": {reading.reason}" if reading.reason else ""
                )
                yield RoleEvidence(report.family, ref, reading.role, (said,))
