"""Checked protocols as text for a terminal, in the manner of ruff."""

from __future__ import annotations

import io
import re
import tokenize
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from rich.cells import cell_len

from ..preflight.judging import RoleEvidence
from ..vocabulary import Finding, Severity, VerdictWord, counted, no_commands
from ..workbench import CheckedProtocol, CheckRun, Exploration, Problem
from .wording import (
    by_model,
    fit_to_print,
    listed,
    listed_wells,
    location,
    model_line,
    site_label,
    sites_by_line,
    summary_line,
)

_MOST_LINES = 6
"""Source lines shown per finding."""
_IN_FULL = 3
"""Findings of one kind that are shown with their source; of the others, a line tells the place."""
_PLACE = re.compile(r"\b(?:[A-Z]{1,2}\d{1,2}|lines? \d+)\b")


class _Paint:
    """ANSI colours, or none."""

    def __init__(self, colour: bool) -> None:
        self._colour = colour

    def __call__(self, text: str, *codes: int) -> str:
        if not self._colour or not text:
            return text
        return f"\x1b[{';'.join(map(str, codes))}m{text}\x1b[0m"


_BOLD, _RED, _YELLOW, _BLUE, _CYAN, _GREEN, _DIM = 1, 31, 33, 34, 36, 32, 2


def check_text(run: CheckRun, colour: bool = False) -> str:
    """Render as text."""
    paint = _Paint(colour)
    names = {rule.id: rule.name for rule in run.rule_set.rules}
    volumes = {
        rule.id
        for rule in run.rule_set.rules
        if all(check["check"] == "volume_bookkeeping" for check in rule.checks)
    }
    blocks: list[str] = []
    for checked in map(fit_to_print, run.protocols):
        blocks += _protocol(checked, names, run.explain_roles, paint)
        judged = checked.report.judged if checked.report else ()
        if judged and volumes.issuperset(judged):
            blocks.append(f"{checked.file}: only volumes could be judged\n")
    blocks.append(paint(summary_line(run), _BOLD))
    return no_commands("\n".join(blocks) + "\n")


def _protocol(
    checked: CheckedProtocol, names: dict[str, str], explain_roles: bool, paint: _Paint
) -> Iterator[str]:
    if checked.problem is not None:
        yield _problem(checked, checked.problem, paint) + "\n"
        return
    yield from _findings(checked, names, paint)
    if checked.exploration is not None:
        yield from _exploration(checked, checked.exploration, paint)
    if checked.unanswered:
        yield f"{checked.file}: {paint('error', _BOLD, _RED)}: {checked.unanswered}"
    rest = []
    if model_line(checked):
        rest.append(f"{checked.file}: model: {model_line(checked)}")
    for waived in checked.waived:
        finding = waived.finding
        where = location(checked, finding.lines[0] if finding.lines else None)
        mark = f" ({by_model(finding)})" if by_model(finding) else ""
        rest.append(f"{where}: {finding.rule}{mark} waived: {waived.waiver.reason}")
    for remark in checked.remarks:
        where = location(checked, remark.line)
        yield f"{where}: {paint('warning', _BOLD, _YELLOW)}: {remark.message}"
    for note in checked.notes:
        rest.append(f"{checked.file}: note: {note}")
    by_reason: dict[tuple[str, str, str], list[str]] = {}
    for undecided in checked.undecided:
        if undecided.reason != checked.unanswered:
            asked = (undecided.reason, undecided.to_write, undecided.paste)
            by_reason.setdefault(asked, []).append(undecided.rule)
    for (reason, to_write, paste), rules in by_reason.items():
        rest.append(f"{checked.file}: undecided: {', '.join(rules)}: {reason}")
        if paste:
            rest.append(f"    {to_write}: {paste}")
    if checked.baselined:
        rules = list(dict.fromkeys(finding.rule for finding in checked.baselined))
        told = counted(len(checked.baselined), "known finding")
        rest.append(f"{checked.file}: baseline: {told} ({listed(rules)})")
    if rest:
        yield "\n".join(paint(line, _DIM) for line in rest)
    if explain_roles and checked.report is not None:
        yield _roles(checked, paint)
    word = checked.verdict
    shade = {VerdictWord.PASS: _GREEN, VerdictWord.WARN: _YELLOW}.get(word, _RED)
    family = f" ({checked.family})" if checked.family else ""
    yield f"{checked.file}: {paint(word.value, _BOLD, shade)}{family}\n"


def _problem(checked: CheckedProtocol, problem: Problem, paint: _Paint) -> str:
    where = location(checked, problem.line)
    message = " ".join(problem.message.split())
    text = f"{where}: {paint('error', _BOLD, _RED)}: cannot be judged: {message}"
    if problem.line and 0 < problem.line <= len(checked.lines):
        text += "\n" + _snippet(checked.lines, {problem.line: ""}, paint)
    return text


def _findings(checked: CheckedProtocol, names: dict[str, str], paint: _Paint) -> Iterator[str]:
    """Findings in their order, each as a block; those that go on like the ones above, in one."""
    seen: Counter[tuple[str, str]] = Counter()
    alike: list[str] = []
    for finding in checked.findings:
        kind = (finding.rule, _PLACE.sub("", finding.message))
        seen[kind] += 1
        head = _head(finding, names.get(finding.rule, ""), paint)
        if seen[kind] > _IN_FULL:
            place = location(checked, next(reversed(finding.lines), None))
            before = "".join(f"; {checked.unit} {line}" for line in finding.lines[:-1])
            alike.append(f"{head}: likewise at {place} ({listed_wells(finding.wells, 12)}{before})")
            continue
        if alike:
            yield "\n".join(alike) + "\n"
            alike = []
        yield _finding(checked, finding, head, paint)
    if alike:
        yield "\n".join(alike) + "\n"


def _head(finding: Finding, name: str, paint: _Paint) -> str:
    shade = _RED if finding.severity is Severity.ERROR else _YELLOW
    mark = f" ({by_model(finding)})" if by_model(finding) else ""
    return (
        f"{paint(finding.rule, _BOLD, shade)} {name} [{paint(finding.severity.value, shade)}]{mark}"
    )


def _finding(checked: CheckedProtocol, finding: Finding, head: str, paint: _Paint) -> str:
    sites = sites_by_line(finding)
    lines = [f"{head}: {paint(finding.message, _BOLD)}"]
    # The last line is where the harm was done.
    last = next(reversed(sites), None)
    gutter = _gutter(sites or {1: []})
    lines.append(f"{' ' * gutter}{paint('-->', _BLUE)} {location(checked, last)}")
    labels = {line: site_label(sites[line]) for line in list(sites)[:_MOST_LINES]}
    if labels:
        lines.append(_snippet(checked.lines, labels, paint, gutter))
    edge = " " * (gutter + 1) + paint("=", _BLUE)
    if finding.wells:
        lines.append(f"{edge} wells: {listed_wells(finding.wells, 12)}")
    if finding.why:
        lines.append(f"{edge} why: {finding.why}")
    if finding.fix:
        lines.append(f"{edge} {paint('fix', _CYAN)}: {finding.fix}")
    return "\n".join(lines) + "\n"


def _gutter(lines: Iterable[int]) -> int:
    return max(len(str(line)) for line in lines)


def _snippet(
    source: Sequence[str], labels: dict[int, str], paint: _Paint, gutter: int | None = None
) -> str:
    """Source lines in the order of the file, each underlined, with what happened there."""
    gutter = gutter or _gutter(labels)
    bar = paint("|", _BLUE)
    rows = [f"{' ' * gutter} {bar}"]
    before: int | None = None
    for line in sorted(labels):
        if before is not None and line > before + 1:
            rows.append(paint("...", _BLUE))
        before = line
        text = source[line - 1].expandtabs(4) if 0 < line <= len(source) else ""
        rows.append(f"{paint(str(line).rjust(gutter), _BLUE)} {bar} {text}".rstrip())
        start, width = _statement(text)
        if width:
            carets = paint("^" * width, _BOLD, _RED)
            rows.append(
                f"{' ' * gutter} {bar} {' ' * start}{carets} {paint(labels[line], _RED)}".rstrip()
            )
    rows.append(f"{' ' * gutter} {bar}")
    return "\n".join(rows)


def _statement(text: str) -> tuple[int, int]:
    """Where the code of a line starts, and how wide it is without its comment."""
    code = text
    try:
        for token in tokenize.generate_tokens(io.StringIO(text.strip()).readline):
            if token.type == tokenize.COMMENT:
                code = text[: len(text) - len(text.lstrip()) + token.start[1]]
    except (tokenize.TokenError, SyntaxError):
        pass
    # In a terminal's cells: a Chinese character takes two, a combining accent none.
    return cell_len(code[: len(code) - len(code.lstrip())]), cell_len(code.strip())


def _exploration(
    checked: CheckedProtocol, exploration: Exploration, paint: _Paint
) -> Iterator[str]:
    tried = (
        "; ".join(
            f"{name} = {listed([str(v) for v in values], 16)}"
            for name, values in exploration.parameters.items()
        )
        or "no runtime parameter can be varied"
    )
    lines = [
        f"{checked.file}: parameters: {counted(exploration.runs, 'rehearsal')} of "
        f"{counted(exploration.combinations, 'combination')}: {tried}"
    ]
    for broken in exploration.broken:
        lines.append(
            f"  {paint(broken.rule, _BOLD, _RED)} is broken by {broken.values} "
            f"({counted(broken.runs, 'rehearsal')})"
        )
    for values, problem in exploration.failures:
        where = f"line {problem.line}: " if problem.line else ""
        lines.append(
            f"  {paint('error', _BOLD, _RED)}: cannot be judged with {values}: "
            f"{where}{' '.join(problem.message.split())}"
        )
    lines += [f"  {reason}" for reason in exploration.not_varied]
    yield "\n".join(lines)


def _roles(checked: CheckedProtocol, paint: _Paint) -> str:
    assert checked.report is not None
    lines = [paint(f"{checked.file}: roles", _BOLD)]
    for inference in checked.report.families:
        if inference.score > 0 or inference.applies:
            judged = "judged" if inference.applies else "not judged"
            reasons = listed(list(inference.reasons), 6) or "given by hand"
            lines.append(
                f"  family {inference.family} ({inference.confidence:.0%}, {judged}): {reasons}"
            )
    groups: dict[tuple[object, ...], list[RoleEvidence]] = {}
    for role in checked.roles:
        key = (role.family, role.role, role.level, role.evidence, role.conflict, role.well.labware)
        groups.setdefault(key, []).append(role)
    for group in groups.values():
        first = group[0]
        level = "" if first.level is None else f" (level {first.level:g})"
        evidence = "; ".join(first.evidence)
        lines.append(
            f"  {listed_wells(role.well for role in group)}: "
            f"{paint(first.role, _CYAN)}{level}: {evidence}"
        )
        if first.conflict:
            lines.append(f"    conflict: {first.conflict}")
    if not checked.roles:
        lines.append("  nothing says what any well is for")
    return "\n".join(lines)
