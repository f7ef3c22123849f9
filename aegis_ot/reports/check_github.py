"""Checked protocols as GitHub workflow commands: annotations beside the lines of a change.

The format is that of GitHub's "Workflow commands for GitHub Actions".
"""

from __future__ import annotations

from collections.abc import Iterator

from ..vocabulary import Severity
from ..workbench import CheckedProtocol, CheckRun
from .wording import by_model, file_line, fit_to_print, listed, location, summary_line


def check_github(run: CheckRun) -> str:
    """Render as workflow commands, and a closing line for the log."""
    names = {rule.id: rule.name for rule in run.rule_set.rules}
    protocols = map(fit_to_print, run.protocols)
    lines = [line for checked in protocols for line in _annotations(checked, names)]
    return "\n".join([*lines, summary_line(run)]) + "\n"


def _annotations(checked: CheckedProtocol, names: dict[str, str]) -> Iterator[str]:
    if checked.problem is not None:
        yield _command(
            "error",
            checked.file,
            checked.problem.line,
            "aegis-ot: cannot be judged",
            checked.problem.message,
        )
    for finding in checked.findings:
        kind = "error" if finding.severity is Severity.ERROR else "warning"
        # The last line is where the harm was done.
        line = finding.lines[-1] if finding.lines else None
        place = f"{location(checked, line)}: " if line and checked.unit != "line" else ""
        told = (
            f"{place}{finding.message}",
            finding.why,
            f"Fix: {finding.fix}" if finding.fix else "",
        )
        message = "\n".join(part for part in told if part)
        title = " ".join(
            part for part in (finding.rule, names.get(finding.rule), by_model(finding)) if part
        )
        yield _command(kind, checked.file, file_line(checked, line), title, message)
    if checked.unanswered:
        title = "aegis-ot: no answer of the model"
        yield _command("error", checked.file, None, title, checked.unanswered)
    if checked.exploration is not None:
        for values, problem in checked.exploration.failures:
            title = f"aegis-ot: cannot be judged with {values}"
            yield _command("error", checked.file, problem.line, title, problem.message)
    for remark in checked.remarks:
        yield _command("warning", checked.file, remark.line, "aegis-ot", remark.message)
    for note in checked.notes:
        yield _command("notice", checked.file, None, "aegis-ot", note)
    questions = [u for u in checked.undecided if u.reason != checked.unanswered]
    if questions:
        rules = listed(list(dict.fromkeys(u.rule for u in questions)), 30)
        reasons = "\n".join(dict.fromkeys(f"{u.rule}: {u.told}" for u in questions))
        yield _command("notice", checked.file, None, f"aegis-ot: undecided: {rules}", reasons)


def _command(kind: str, file: str, line: int | None, title: str, message: str) -> str:
    properties = [f"file={_property(file)}"]
    if line:
        properties.append(f"line={line}")
    properties.append(f"title={_property(title)}")
    return f"::{kind} {','.join(properties)}::{_data(message)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
