"""Waivers written into a protocol: ``# aegis: ignore[PCR-2] the tutorial's own way``.

Beside a statement (or on the line above it) a waiver covers findings that name one of its
lines; before the first statement of the file it covers the whole file. A reason is required.

A waiver that covered nothing although its rule was judged is stale. Whether a waiver of a rule
that was not judged (not selected, switched off, undecided, of another assay) is still needed
cannot be known, so it is not called stale.
"""

from __future__ import annotations

import ast
import difflib
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from ...vocabulary import Finding, Remark
from ..source import SourceFacts

_WAIVER = re.compile(
    r"aegis\s*:\s*ignore\s*(?:\[(?P<rules>[^\]]*)\])?\s*(?P<reason>.*)$", re.IGNORECASE
)
_MEANT = re.compile(
    r"\baegis[\w-]*\s*(?P<colon>:)?\s*(?P<word>[a-z]+)\s*(?P<rule>\[\s*[a-z]+-\d+)?", re.IGNORECASE
)
_ALIKE = 0.75
"""How much of a word has to be that of ``ignore``, from 0 to 1, for a slip of the pen."""

_WRITE = "write `# aegis: ignore[PCR-2] reason`"

MODEL = "MODEL"
"""Stands for a rule: of a finding that no rule covers, and of a question that went unanswered."""


@dataclass(frozen=True)
class Waiver:
    """One waiver.

    Attributes:
        line: Where it stands.
        lines: Source lines that it covers; empty for the whole file.
        rules: Rule identifiers, in capitals.
        reason: Why; empty if missing, and then it waives nothing.
        problem: What is wrong with it, or ``""``.
    """

    line: int
    lines: tuple[int, ...]
    rules: tuple[str, ...]
    reason: str
    problem: str = ""

    def covers(self, finding: Finding) -> bool:
        """Whether it waives this finding."""
        return (
            not self.problem
            and finding.rule.upper() in self.rules
            and (not self.lines or not set(self.lines).isdisjoint(finding.lines))
        )


@dataclass(frozen=True)
class Waived:
    """A finding that a waiver covers."""

    finding: Finding
    waiver: Waiver


def read_waivers(facts: SourceFacts) -> list[Waiver]:
    """All waivers of a protocol."""
    waivers: list[Waiver] = []
    stand = any(map(_WAIVER.search, facts.comments.values()))  # in few protocols any does
    statements = _statements(facts) if stand else {}
    for line, comment in facts.comments.items():
        match = _WAIVER.search(comment)
        if match is not None:
            waivers.append(_waiver(line, match, _covered(line, facts, statements)))
        elif _is_misspelt(comment):
            waivers.append(Waiver(line, (), (), "", f"is not understood: {_WRITE}"))
    return waivers


def _is_misspelt(comment: str) -> bool:
    """Whether a comment is meant as a waiver: "aegis: ingore[PCR-2]", "aegis-ot: ignore[PCR-2]"."""
    match = _MEANT.search(comment)
    if match is None:
        return False
    alike = difflib.SequenceMatcher(None, match["word"].lower(), "ignore").ratio() >= _ALIKE
    return bool(match["rule"] or (match["colon"] and alike))


def _waiver(line: int, match: re.Match[str], covered: tuple[int, ...]) -> Waiver:
    listed = (rule.strip().upper() for rule in (match["rules"] or "").split(","))
    rules = tuple(dict.fromkeys(rule for rule in listed if rule))
    reason = match["reason"].strip(" :-–—")
    problem = ""
    if not rules:
        problem = f"names no rule: {_WRITE}"
    elif not re.search(r"\w", reason):
        problem = f"gives no reason for waiving {', '.join(rules)}, so it waives nothing"
    return Waiver(line, covered, rules, reason, problem)


def _statements(facts: SourceFacts) -> dict[int, tuple[int, ...]]:
    """By line, the lines of the innermost statement there; of a compound one, of its head."""
    found: dict[int, tuple[int, ...]] = {}
    for part in ast.walk(facts.tree):  # from the outermost to the innermost
        if isinstance(part, ast.stmt):
            body = getattr(part, "body", None)
            last = body[0].lineno - 1 if body else part.end_lineno or part.lineno
            lines = tuple(range(part.lineno, max(last, part.lineno) + 1))
            found.update(dict.fromkeys(lines, lines))
    return found


def _covered(
    line: int, facts: SourceFacts, statements: Mapping[int, tuple[int, ...]]
) -> tuple[int, ...]:
    """The lines of the statement at ``line`` or below it; empty: the whole file."""
    if line not in facts.own_line:
        return statements.get(line, (line,))
    texts = {first for first, _ in facts.docstrings}
    if all(node.lineno > line or node.lineno in texts for node in facts.tree.body):
        return ()  # before the first statement
    below = line + 1
    while below in facts.own_line:
        below += 1
    return (line, *statements.get(below, (below,)))


def apply_waivers(
    findings: Iterable[Finding], waivers: Sequence[Waiver]
) -> tuple[list[Finding], list[Waived]]:
    """Findings that stand, and findings that are waived."""
    covers = [(one, next((w for w in waivers if w.covers(one)), None)) for one in findings]
    waived = [Waived(finding, waiver) for finding, waiver in covers if waiver is not None]
    return [finding for finding, waiver in covers if waiver is None], waived


def waiver_remarks(
    waivers: Sequence[Waiver],
    waived: Sequence[Waived],
    judged: Collection[str],
    known: Collection[str],
) -> Iterable[Remark]:
    """What is wrong with the waivers of a protocol, each with its line.

    ``judged`` are the rules that were judged to the end, ``known`` all that exist.
    """
    used = {(one.waiver, one.finding.rule.upper()) for one in waived}
    names = {name.upper(): name for name in known}
    for waiver in waivers:
        if waiver.problem:
            yield Remark(f"The waiver {waiver.problem}.", waiver.line)
            continue
        for rule in waiver.rules:
            if rule not in names and rule != MODEL:
                near = difflib.get_close_matches(rule, names, n=2, cutoff=0.6)
                hint = f"; did you mean {' or '.join(names[n] for n in near)}?" if near else "."
                told = f"The waiver names {rule}, but there is no such rule{hint}"
                yield Remark(told, waiver.line)
        idle = [r for r in judged if r.upper() in waiver.rules and (waiver, r.upper()) not in used]
        if idle:
            told = f"The waiver of {', '.join(idle)} is stale: nothing is found there."
            yield Remark(told, waiver.line)
