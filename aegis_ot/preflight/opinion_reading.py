"""Holds what a model says to what exists: the wells, lines and rules of this run.

A schema cannot carry these bounds. What does not fit is left out, and told.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from ..vocabulary import Finding, Severity, Site, WellRef, one_line
from .dossier import DeckItem, Dossier
from .judging import MODEL
from .opinion import ANSWERED, Opinion, RoleReading, RuleReading
from .trace import row_column

LONGEST_TEXT = 400
LONGEST_NAME = 60
MOST_FINDINGS = 12


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
        role, wells = _name(given["role"]), tuple(bounds.wells(given["wells"]))
        if wells:
            roles.append(RoleReading(role, wells, _text(given.get("reason"))))
        else:
            left_out.append(f"a role {role!r} for wells that the run does not know")
    asked = {question.rule for question in dossier.questions}
    left_out += [
        f"an answer about {_name(given['rule'])!r} (there is no such rule in force)"
        for given in value.get("answers", ())
        if given["rule"] not in bounds.severity
    ]
    answers = tuple(
        RuleReading(given["rule"], given["answer"], _text(given.get("reason")))
        for given in value.get("answers", ())
        if given["rule"] in asked
    )
    return Opinion(
        ANSWERED,
        model,
        family=_name(value.get("family")),
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
        count = len(dossier.source_lines)
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
    rule = _name(given["rule"])
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
    """A model's words."""
    return one_line(value, LONGEST_TEXT)


def _name(value: object) -> str:
    """What should be a name that this package knows, and may be anything."""
    return one_line(value, LONGEST_NAME)
