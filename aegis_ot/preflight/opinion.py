"""A model's opinion of a protocol, held to what exists, and merged with what the checks decided.

Pure, standard library only: the robot merges what the sidecar's model said.

The merge can only add. Every finding of the checks stays, whatever the model says; a rule that
the checks decided stays decided, and where the model disagrees a note says so; an open question
stays listed, with the model's reading beside it, unless the model shows a violation in wells and
lines that the trace holds. So no text in a protocol that talks a model round can change what the
checks found.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..vocabulary import Finding, Severity, Site, Undecided, VerdictWord, WellRef
from .dossier import DeckItem, Dossier
from .judge import Options, Report, RoleEvidence
from .source import read_source
from .trace import row_column
from .waivers import apply_waivers, read_waivers

MODEL = "MODEL"
"""Stands for a rule: of a finding that no rule covers, and of a question that went unanswered."""

ANSWERED = "answered"
LONGEST_TEXT = 400
MOST_FINDINGS = 12


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


def read_opinion(
    value: Mapping[str, Any], dossier: Dossier, model: str, blind: bool = False
) -> Opinion:
    """Hold an answer that fits the schema to what exists: wells, lines, rules.

    Args:
        value: The model's answer, see ``aegis_ot.reasoning.answer``.
        dossier: What it was asked about.
        model: Who answered.
        blind: The model did not see the trace: any well on the deck and any source line will do.
    """
    bounds = _Bounds(dossier, blind)
    left_out: list[str] = []
    findings = []
    for given in list(value.get("findings", ()))[:MOST_FINDINGS]:
        finding, problem = _finding(given, bounds)
        if finding is not None:
            findings.append(finding)
        if problem:
            left_out.append(problem)
    roles = []
    for given in value.get("roles", ()):
        wells = tuple(bounds.wells(given["wells"]))
        if wells:
            roles.append(RoleReading(given["role"], wells, _text(given.get("reason"))))
        else:
            left_out.append(f"a role {given['role']!r} for wells that the run does not know")
    asked = {question.rule for question in dossier.questions}
    answers = tuple(
        RuleReading(given["rule"], given["answer"], _text(given.get("reason")))
        for given in value.get("answers", ())
        if given["rule"] in asked
    )
    return Opinion(
        ANSWERED,
        model,
        family=str(value.get("family", "")),
        roles=tuple(roles),
        answers=answers,
        findings=tuple(findings),
        left_out=tuple(left_out),
        summary=_text(value.get("summary")),
    )


class _Bounds:
    """Which wells, lines and rules an answer may name."""

    def __init__(self, dossier: Dossier, blind: bool) -> None:
        self._dossier = dossier
        self._blind = blind
        self._known: dict[tuple[str, str], list[WellRef]] = {}
        for ref in dossier.wells:
            for name in (ref.slot, ref.label, ref.labware):
                self._known.setdefault((name.lower(), ref.name), []).append(ref)
        count = len(dossier.source.splitlines())
        self.lines = set(range(1, count + 1)) if blind else set(dossier.lines)
        self.severity = {brief.id: brief.severity for brief in dossier.rules}

    def wells(self, given: Iterable[str]) -> Iterable[WellRef]:
        """The wells that are meant and exist: ``"4:H12"``, ``"4:A1-H1"``, ``"PCR plate:A1"``."""
        found: dict[WellRef, None] = {}
        for place in given:
            labware, _, spec = place.strip().rpartition(":")
            labware = labware.strip().removeprefix("slot ").lower()
            names = _WELLS.findall(spec)
            for first, last in names:
                for ref in self._range(labware, first.upper(), (last or first).upper()):
                    found[ref] = None
        return found

    def _range(self, labware: str, first: str, last: str) -> Iterable[WellRef]:
        (row1, column1), (row2, column2) = row_column(first), row_column(last)
        rows, columns = sorted((row1, row2)), sorted((column1, column2))
        if self._blind:
            yield from self._on_deck(labware, rows, columns)
            return
        for (name, well), refs in self._known.items():
            row, column = row_column(well)
            inside = rows[0] <= row <= rows[1] and columns[0] <= column <= columns[1]
            if name == labware and inside:
                yield from refs

    def _on_deck(self, labware: str, rows: list[int], columns: list[int]) -> Iterable[WellRef]:
        for item in self._dossier.deck:
            if labware not in (item.slot.lower(), item.label.lower(), item.load_name.lower()):
                continue
            for column in range(columns[0], min(columns[1], item.columns - 1) + 1):
                for row in range(rows[0], min(rows[1], item.rows - 1) + 1):
                    yield _ref(item, row, column)


_WELLS = re.compile(r"\b([A-Pa-p]\d{1,2})(?:\s*[-–]\s*([A-Pa-p]\d{1,2}))?\b")


def _ref(item: DeckItem, row: int, column: int) -> WellRef:
    return WellRef(item.key, f"{chr(ord('A') + row)}{column + 1}", item.label, item.slot)


def _finding(given: Mapping[str, Any], bounds: _Bounds) -> tuple[Finding | None, str]:
    rule = str(given["rule"])
    said = f"{rule}: {_text(given['message'])}"
    if rule != MODEL and rule not in bounds.severity:
        return None, f"{said} (there is no such rule in force)"
    wells = list(bounds.wells(given["wells"]))
    lines = [line for line in dict.fromkeys(given["lines"]) if line in bounds.lines]
    if not wells or not lines:
        missing = "well" if not wells else "line"
        return None, f"{said} (it names no {missing} that the run knows)"
    # One well stands beside each line, so that both ends can be shown; the rest follow.
    sites = [Site(lines[min(number, len(lines) - 1)], ref) for number, ref in enumerate(wells)] + [
        Site(line) for line in lines[len(wells) :]
    ]
    severity = bounds.severity.get(rule, Severity.WARNING)
    return Finding(
        rule,
        severity,
        _text(given["message"]),
        tuple(sites),
        why=_text(given.get("why")),
        fix=_text(given.get("fix")),
        source="model",
    ), ""


def _text(value: object) -> str:
    """A model's words, on one line and not too long."""
    flat = " ".join(str(value or "").split())
    flat = "".join(c for c in flat if c.isprintable())
    return flat if len(flat) <= LONGEST_TEXT else flat[: LONGEST_TEXT - 3] + "..."


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
        reason = f"{opinion.model} gave no answer ({opinion.state}): {opinion.detail}"
        return replace(report, undecided=(*report.undecided, Undecided(MODEL, reason)))
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


def unanswered(report: Report) -> str:
    """Why the model that was asked gave no answer, or ``""``: a reason for exit code 2."""
    return next((u.reason for u in report.undecided if u.rule == MODEL), "")


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


def _without_waived(report: Report, findings: Sequence[Finding]) -> tuple[list[Finding], list[Any]]:
    if not findings:
        return [], []
    text = "\n".join(report.lines)
    facts = read_source(text)
    first = _first_statement(text)
    standing, waived, _ = apply_waivers(findings, read_waivers(facts, first))
    return standing, waived


def _first_statement(text: str) -> int:
    """The line where the protocol's code begins, after comments and docstring."""
    try:
        body = ast.parse(text).body
    except (SyntaxError, ValueError):
        return 1
    for node in body:
        if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            return node.lineno
    return len(text.splitlines()) + 1


def _roles(report: Report, opinion: Opinion) -> Iterable[RoleEvidence]:
    known = {evidence.well for evidence in report.roles}
    for reading in opinion.roles:
        for ref in reading.wells:
            if ref not in known:
                said = f"read by {opinion.model}" + (
                    f": {reading.reason}" if reading.reason else ""
                )
                yield RoleEvidence(report.family, ref, reading.role, (said,))
