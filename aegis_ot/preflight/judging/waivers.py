"""Waivers written into a protocol: ``# aegis: ignore[PCR-2] the tutorial's own way``.

Beside code (or on the line above it) a waiver covers findings that name that line; before the
first statement of the file it covers the whole file. A reason is required. A waiver that
covers nothing is stale and is reported.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...vocabulary import Finding
from ..text import SourceFacts

_WAIVER = re.compile(
    r"aegis\s*:\s*ignore\s*(?:\[(?P<rules>[^\]]*)\])?\s*(?P<reason>.*)$", re.IGNORECASE
)


@dataclass(frozen=True)
class Waiver:
    """One waiver.

    Attributes:
        line: Where it stands.
        lines: Source lines that it covers; empty for the whole file.
        rules: Rule identifiers.
        reason: Why; empty if missing, and then it waives nothing.
        problem: What is wrong with it, or ``""``.
    """

    line: int
    lines: tuple[int, ...]
    rules: tuple[str, ...]
    reason: str
    problem: str = ""


@dataclass(frozen=True)
class Waived:
    """A finding that a waiver covers."""

    finding: Finding
    waiver: Waiver


def read_waivers(facts: SourceFacts, first_statement: int) -> list[Waiver]:
    """All waivers of a protocol.

    Args:
        facts: What the text says.
        first_statement: Line of the first statement that is not a docstring or comment.
    """
    found = []
    for line, text in facts.comments.items():
        match = _WAIVER.search(text)
        if match is None:
            continue
        rules = tuple(
            rule.strip().upper() for rule in (match["rules"] or "").split(",") if rule.strip()
        )
        reason = match["reason"].strip(" :-–—")
        lines: tuple[int, ...] = (line,)
        if line in facts.own_line:
            lines = () if line < first_statement else (line, _next_code(facts, line))
        problem = ""
        if not rules:
            problem = "names no rule: write `# aegis: ignore[PCR-2] reason`"
        elif not reason:
            problem = f"gives no reason for waiving {', '.join(rules)}, so it waives nothing"
        found.append(Waiver(line, lines, rules, reason, problem))
    return found


def first_statement(text: str) -> int:
    """The line where a protocol's code begins, after comments and docstring."""
    try:
        body = ast.parse(text).body
    except (SyntaxError, ValueError):
        return 1
    for node in body:
        if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            return node.lineno
    return len(text.splitlines()) + 1


def stale(waiver: Waiver) -> str:
    """The note on a waiver that covers nothing."""
    return (
        f"The waiver of {', '.join(waiver.rules)} at line {waiver.line} is stale: "
        "nothing is found there."
    )


def _next_code(facts: SourceFacts, line: int) -> int:
    line += 1
    while line in facts.own_line:
        line += 1
    return line


def apply_waivers(
    findings: Iterable[Finding], waivers: Sequence[Waiver]
) -> tuple[list[Finding], list[Waived], list[str]]:
    """Findings that stand, findings that are waived, and what is wrong with the waivers."""
    standing: list[Finding] = []
    waived: list[Waived] = []
    used: set[int] = set()
    for finding in findings:
        cover = next(
            (
                waiver
                for waiver in waivers
                if not waiver.problem
                and finding.rule.upper() in waiver.rules
                and (not waiver.lines or not set(waiver.lines).isdisjoint(finding.lines))
            ),
            None,
        )
        if cover is None:
            standing.append(finding)
        else:
            used.add(cover.line)
            waived.append(Waived(finding, cover))
    problems = [f"The waiver at line {w.line} {w.problem}." for w in waivers if w.problem]
    problems += [stale(w) for w in waivers if not w.problem and w.line not in used]
    return standing, waived, problems
