"""Merges a model's opinion with what the checks decided. The robot does it as well.

The merge can only add. Every finding of the checks stays, whatever the model says; a rule that
the checks decided stays decided, and where the model disagrees a note says so; an open question
stays listed, with the model's reading beside it, unless a violation is shown in wells and lines
that the trace holds. Such a finding warns (and is an error where all warnings are). So no text
in a protocol that talks a model round can change what the checks found.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ...vocabulary import Finding, Opinion, Severity, Undecided, VerdictWord, is_known
from ..evidence import Evidence
from ..judging import (
    MODEL,
    Interpretation,
    Report,
    RoleEvidence,
    apply_waivers,
    judge,
    pasted,
    read_waivers,
    spelled,
    verdict_of,
)
from .proposals import verify_proposals

_SAID = {"holds": "it holds", "violated": "it is violated", "not_applicable": "it does not apply"}


def no_answer(opinion: Opinion) -> Undecided:
    """What a report says of a model that was asked in vain."""
    return Undecided(MODEL, f"{opinion.model} gave no answer ({opinion.state}): {opinion.detail}")


def merge(report: Report, opinion: Opinion, reading: Interpretation) -> Report:
    """The checks' report with the model's opinion added; see the module for what that may do.

    The ``reading`` that the report judges is judged again with the roles that the model read.
    """
    if not opinion.answered:
        return replace(report, undecided=(*report.undecided, no_answer(opinion)))
    notes = [f"{opinion.model}: {opinion.summary}"] if opinion.summary else []
    severity = Severity.ERROR if reading.options.strict else Severity.WARNING
    accepted, rejected, second = _judged_again(reading, opinion)
    # A check tells more exactly what happens than a model that saw the same.
    candidates = [
        replace(
            finding,
            message=f"{finding.message} ({opinion.model} read what the wells are for.)",
            severity=severity,
            source="model",
        )
        for finding in (second.findings if second else ())
        if finding.rule not in report.judged
    ]
    for finding in opinion.findings:
        if finding.rule in report.judged:
            notes.append(
                f"{opinion.model} disagrees with the check of {finding.rule}, which stands: "
                f"{finding.message}"
            )
        elif not is_known(finding, candidates):
            candidates.append(replace(finding, severity=severity))
    notes += _against_decided(report, opinion, second)
    notes += [f"{opinion.model}, role of {text}." for text in rejected]
    notes += [f"{opinion.model}, left out: {text}" for text in opinion.left_out]
    standing, waived = apply_waivers(candidates, read_waivers(reading.facts))
    findings = sorted(
        (*report.findings, *standing), key=lambda f: (min(f.lines, default=0), f.rule)
    )
    return replace(
        report,
        findings=tuple(findings),
        verdict=report.verdict if report.verdict is VerdictWord.ERROR else verdict_of(findings),
        undecided=tuple(_questions(report, opinion, standing, accepted, second)),
        waived=(*report.waived, *waived),
        notes=(*report.notes, *notes),
        roles=(*report.roles, *_further_roles(report, second)),
    )


def _judged_again(
    reading: Interpretation, opinion: Opinion
) -> tuple[Mapping[Evidence, Sequence[str]], list[str], Report | None]:
    """The roles that stand, why others do not, and what the checks say with them."""
    # The family that the model reads, where the checks only guess.
    known = {family.family for family in reading.rule_set.assays if not family.default}
    assay = (opinion.family,) if opinion.family in known and not reading.family_known else ()
    seen = reading.with_evidence((), assay) if assay else reading
    accepted, rejected = verify_proposals(opinion.proposals, seen, opinion.model)
    if not assay and not accepted:
        return accepted, rejected, None
    return accepted, rejected, judge(reading.with_evidence(tuple(accepted), assay))


def _against_decided(report: Report, opinion: Opinion, second: Report | None) -> Iterable[str]:
    """What rules that are decided would find, were the wells what the model takes them for."""
    for finding in second.findings if second else ():
        if finding.rule in report.judged and not is_known(finding, report.findings):
            yield (
                f"With the roles that {opinion.model} reads, {finding.rule} would find: "
                f"{finding.message} The check decided otherwise without them."
            )


def _questions(
    report: Report,
    opinion: Opinion,
    standing: Sequence[Finding],
    accepted: Mapping[Evidence, Sequence[str]],
    second: Report | None,
) -> Iterable[Undecided]:
    """What stays open, with the model's reading; and the roles to paste, if they are right."""
    found = {finding.rule for finding in standing}
    answers = {answer.rule: answer for answer in opinion.answers}
    roles: dict[str, list[str]] = {}
    for one, levels in accepted.items():
        leveled = [f"{ref.address} = {lv}" for ref, lv in zip(one.wells, levels, strict=False)]
        roles.setdefault(one.role, []).extend(leveled or spelled(one.wells))
    given = pasted(roles)
    for question in report.undecided:
        if question.rule in found:
            continue
        reason, paste, to_write = question.reason, question.paste, question.to_write
        answer = answers.get(question.rule)
        if answer is not None:
            said = _SAID.get(answer.answer, "it cannot tell")
            reason += f"; {opinion.model} reads that {said}"
            reason += f": {answer.reason}" if answer.reason else ""
        if second is not None and question.rule in second.judged:
            reason += "; with the roles that it reads, the check finds nothing"
            if given:
                paste, to_write = given, "write, if it reads them right"
        yield replace(question, reason=reason, paste=paste, to_write=to_write)


def _further_roles(report: Report, second: Report | None) -> Iterable[RoleEvidence]:
    """The roles that wells have with what the model read, and had not."""
    known = {(item.family, item.well, item.role) for item in report.roles}
    found = second.roles if second else ()
    return (item for item in found if (item.family, item.well, item.role) not in known)
