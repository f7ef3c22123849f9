"""Checked protocols, a line for each finding: for editors, ``grep`` and narrow terminals."""

from __future__ import annotations

from collections.abc import Iterator

from ..vocabulary import no_commands
from ..workbench import CheckedProtocol, CheckRun
from .wording import by_model, fit_to_print, location, summary_line


def check_line(run: CheckRun) -> str:
    """Render as ``file:line: severity RULE message``, and a closing line."""
    lines = [line for checked in map(fit_to_print, run.protocols) for line in _lines(checked)]
    return no_commands("\n".join([*lines, summary_line(run)]) + "\n")


def _lines(checked: CheckedProtocol) -> Iterator[str]:
    if checked.problem is not None:
        where = location(checked, checked.problem.line)
        yield f"{where}: error cannot be judged: {checked.problem.message}"
    for finding in checked.findings:
        # The last line is where the harm was done.
        where = location(checked, finding.lines[-1] if finding.lines else None)
        mark = f"({by_model(finding)}) " if by_model(finding) else ""
        yield f"{where}: {finding.severity.value} {finding.rule} {mark}{finding.message}"
    if checked.unanswered:
        yield f"{checked.file}: error {checked.unanswered}"
    if checked.exploration is not None:
        for values, problem in checked.exploration.failures:
            where = location(checked, problem.line)
            yield f"{where}: error cannot be judged with {values}: {problem.message}"
    for remark in checked.remarks:
        yield f"{location(checked, remark.line)}: warning {remark.message}"
    for undecided in checked.undecided:
        if undecided.reason != checked.unanswered:
            yield f"{checked.file}: undecided {undecided.rule} {undecided.told}"
