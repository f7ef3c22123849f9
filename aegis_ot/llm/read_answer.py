"""Holds what a model says to what exists: the wells, lines and rules of this run.

A schema (:mod:`.answer`) cannot carry these bounds. What does not fit is left out, and told.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..preflight.evidence import wells_in
from ..preflight.evidence.deck import without_slot
from ..preflight.evidence.well_names import WELL
from ..preflight.judging import MODEL
from ..vocabulary import (
    Citation,
    Dossier,
    Finding,
    Opinion,
    RoleProposal,
    RuleAnswer,
    Severity,
    Site,
    WellRef,
    is_known,
    one_line,
)
from .backend import State

LONGEST_TEXT = 400
LONGEST_NAME = 60
MOST_FINDINGS = 12
MOST_PROPOSALS = 24

_CITED_WELL = re.compile(rf"(?:\b\w+:|\b){WELL}(?:-{WELL})?(?!\w)")
_CITED_LINES = re.compile(
    r"\b(?:lines?\s+|L)(\d+(?:(?:\s*[,&–-]\s*|\s+)(?:and\s+|to\s+|L)?\d+)*)", re.I
)


def read_opinion(
    value: Mapping[str, Any], dossier: Dossier, model: str, bounds: Bounds | None = None
) -> Opinion:
    """Hold an answer that fits the schema to what exists: wells, lines, rules.

    Args:
        value: The model's answer, see :mod:`.answer`.
        dossier: What it was asked about.
        model: Who answered.
        bounds: What it may name, where that is not what the trace has.
    """
    bounds = bounds or Bounds(dossier)
    findings, left_out = _findings(value.get("findings", ()), bounds)
    asked = {question.rule for question in dossier.questions}
    answers = []
    for given in value.get("answers", ()):
        if given["rule"] not in bounds.severity:
            told = f"an answer about {_name(given['rule'])!r} (there is no such rule in force)"
            left_out.append(told)
        if given["rule"] in asked:
            answers.append(RuleAnswer(given["rule"], given["answer"], _text(given["reason"])))
    violated = [  # of a rule that the checks decided, too: a disagreement is told as such
        _violated(given)
        for given in value.get("answers", ())
        if given["rule"] in bounds.severity and given["answer"] == "violated"
    ]
    more, problems = _findings(violated, bounds)
    findings += [one for one in more if not is_known(one, findings)]
    return Opinion(
        State.ANSWERED.value,
        model,
        family=_name(value.get("family")),
        proposals=tuple(map(_proposal, list(value.get("roles", ()))[:MOST_PROPOSALS])),
        answers=tuple(answers),
        findings=tuple(findings),
        left_out=(*left_out, *problems),
        summary=_text(value.get("summary")),
    )


class Bounds:
    """Which wells, lines and rules an answer may name.

    Args:
        dossier: What the model was asked about.
        wells: The wells, each with its labware's load name or key; those of the trace if left out.
        lines: Source lines; those of the trace if left out.
    """

    def __init__(
        self,
        dossier: Dossier,
        wells: Iterable[tuple[WellRef, str]] | None = None,
        lines: Iterable[int] | None = None,
    ) -> None:
        self._known: dict[str, dict[str, list[WellRef]]] = {}
        for ref, load_name in wells or ((well, well.labware) for well in dossier.wells):
            for name in (ref.slot, ref.label, load_name):
                known = self._known.setdefault(name.lower(), {})
                known.setdefault(ref.name, []).append(ref)
        self.lines = set(dossier.lines if lines is None else lines)
        self.severity = {brief.id: brief.severity for brief in dossier.rules}
        by_name: dict[str, set[WellRef]] = {}
        for names in self._known.values():
            for name, refs in names.items():
                by_name.setdefault(name, set()).update(refs)
        self._of_one_labware = {
            name: list(refs) for name, refs in by_name.items() if len(refs) == 1
        }

    def wells(self, given: Iterable[str]) -> list[WellRef]:
        """The wells that are meant and exist: ``"4:H12"``, ``"4:A1-H1"``, ``"PCR plate:A1"``."""
        found: dict[WellRef, None] = {}
        for place in given:
            labware, _, spec = place.strip().rpartition(":")
            known = self._known.get(without_slot(labware).strip().lower(), {})
            if not labware:
                known = self._of_one_labware
            for name in wells_in(spec.upper(), known) if spec.strip() else ():
                found.update(dict.fromkeys(known[name]))
        return list(found)


def _violated(given: Mapping[str, Any]) -> dict[str, Any]:
    """An answer that a rule is broken as a finding, in wells and lines that it gives or cites."""
    reason = str(given["reason"])
    lines = (int(n) for cited in _CITED_LINES.findall(reason) for n in re.findall(r"\d+", cited))
    return {
        "rule": given["rule"],
        "message": reason or "The model reads that it is broken.",
        "wells": given["wells"] or _CITED_WELL.findall(reason),
        "lines": given["lines"] or list(lines),
    }


def _findings(
    given: Sequence[Mapping[str, Any]], bounds: Bounds
) -> tuple[list[Finding], list[str]]:
    """Findings in wells and lines that exist, and what is wrong with the others."""
    findings, problems = [], []
    for one in given[:MOST_FINDINGS]:
        wells = bounds.wells(one["wells"])
        lines = [line for line in dict.fromkeys(one["lines"]) if line in bounds.lines]
        if _name(one["rule"]) not in (MODEL, *bounds.severity):
            problem = "there is no such rule in force"
        elif not wells or not lines:
            problem = f"it names no {'line' if wells else 'well'} that the run knows"
        else:
            findings.append(_finding(one, wells, lines, bounds))
            continue
        problems.append(f"{_name(one['rule'])}: {_text(one['message'])} ({problem})")
    return findings, problems


def _finding(
    given: Mapping[str, Any], wells: Sequence[WellRef], lines: Sequence[int], bounds: Bounds
) -> Finding:
    rule = _name(given["rule"])
    # One well stands beside each line, so that both ends can be shown; the rest follow.
    sites = [Site(lines[min(number, len(lines) - 1)], ref) for number, ref in enumerate(wells)] + [
        Site(line) for line in lines[len(wells) :]
    ]
    return Finding(
        rule,
        bounds.severity.get(rule, Severity.WARNING),
        _text(given["message"]),
        tuple(sites),
        why=_text(given.get("why")),
        fix=_text(given.get("fix")),
        source="model",
    )


def _proposal(given: Mapping[str, Any]) -> RoleProposal:
    return RoleProposal(
        _name(given["role"]),
        tuple(_name(place) for place in given["wells"]),
        tuple(_name(level) for level in given["levels"]),
        tuple(Citation(said["line"], _text(said["quote"])) for said in given["citations"]),
    )


def _text(value: object) -> str:
    """A model's words."""
    return one_line(value, LONGEST_TEXT)


def _name(value: object) -> str:
    """What should be a name that this package knows, and may be anything."""
    return one_line(value, LONGEST_NAME)
