"""Checked protocols as JUnit XML: a suite per protocol, a case per rule that applies to it."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from xml.etree.ElementTree import Element, SubElement

from ..preflight.judging import MODEL
from ..preflight.rules import RuleSpec
from ..vocabulary import Finding
from ..workbench import CheckedProtocol, CheckRun
from .wording import by_model, location

# What XML 1.0 cannot hold, even escaped.
_UNWRITABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def check_junit(run: CheckRun) -> str:
    """Render as XML. An undecided rule is a skipped case; a protocol not judged, an error."""
    root = Element("testsuites", name="aegis-ot")
    for checked in run.protocols:
        _suite(root, checked, run)
    for count in ("tests", "failures", "errors", "skipped"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in root)))
    ElementTree.indent(root)
    body = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n{body}\n'


def _suite(root: Element, checked: CheckedProtocol, run: CheckRun) -> None:
    suite = SubElement(root, "testsuite", name=checked.file, time=f"{checked.seconds:.3f}")
    if checked.problem is not None:
        case = _case(suite, checked, "rehearsal")
        _outcome(case, "error", checked.problem.message, _where(checked, checked.problem.line))
    failures = checked.exploration.failures if checked.exploration else ()
    for values, problem in failures:
        case = _case(suite, checked, f"rehearsal with {values}")
        _outcome(case, "error", problem.message, _where(checked, problem.line))
    if checked.unanswered:
        _outcome(_case(suite, checked, "model"), "error", checked.unanswered, "")
    for finding in checked.findings:
        if finding.rule == MODEL:  # beyond the rules, so no rule's case holds it
            case = _case(suite, checked, MODEL)
            _outcome(
                case, "failure", finding.message, _told(checked, finding), finding.severity.value
            )
    reasons = {undecided.rule: undecided.told for undecided in checked.undecided}
    for rule in _rules(checked, run):
        case = _case(suite, checked, f"{rule.id} {rule.name}")
        findings = [finding for finding in checked.findings if finding.rule == rule.id]
        if findings:
            text = "\n\n".join(_told(checked, finding) for finding in findings)
            severity = findings[0].severity.value
            _outcome(case, "failure", findings[0].message, text, severity)
        elif rule.id in reasons:
            _outcome(case, "skipped", f"undecided: {reasons[rule.id]}", "")
    for count, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        suite.set(count, str(len(suite.findall(f"testcase/{tag}"))))
    suite.set("tests", str(len(suite)))
    if checked.remarks:  # no outcome of any case; CI systems show this beside the suite
        told = [f"{location(checked, r.line)}: warning: {r.message}" for r in checked.remarks]
        SubElement(suite, "system-out").text = _writable("\n".join(told))


def _rules(checked: CheckedProtocol, run: CheckRun) -> Iterator[RuleSpec]:
    """The rules that were judged, or would have been had enough been known."""
    if checked.report is None:
        return
    told = {*checked.report.judged, *(finding.rule for finding in checked.findings)}
    told |= {undecided.rule for undecided in checked.undecided}
    yield from (rule for rule in run.rule_set.rules if rule.id in told)


def _case(suite: Element, checked: CheckedProtocol, name: str) -> Element:
    return SubElement(
        suite, "testcase", name=_writable(name), classname=checked.file, file=checked.file
    )


def _outcome(case: Element, tag: str, message: str, text: str, kind: str = "") -> None:
    outcome = SubElement(case, tag, message=_writable(message))
    if kind:
        outcome.set("type", kind)
    if text:
        outcome.text = _writable(text)


def _told(checked: CheckedProtocol, finding: Finding) -> str:
    wells = ", ".join(well.address for well in finding.wells)
    where = "\n".join(_where(checked, line) for line in finding.lines)
    told = f"{finding.message}\n{where}\nwells: {wells}\nwhy: {finding.why}\nfix: {finding.fix}"
    return f"{told}\n{by_model(finding)}".rstrip("\n") if by_model(finding) else told


def _where(checked: CheckedProtocol, line: int | None) -> str:
    if not line or line > len(checked.lines):
        return checked.file
    return f"{location(checked, line)}: {checked.lines[line - 1].strip()}"


def _writable(text: str) -> str:
    return _UNWRITABLE.sub("\ufffd", text)
