"""Checked protocols as SARIF 2.1.0 (OASIS standard, 2020), for code scanning.

The primary location of a result is where the harm was done; its other end is a related
location, and both are the steps of a code flow. A waived finding is a suppressed result, and
so is one of the baseline. What could not be judged or decided is a notification.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import quote

from .._version import DOCUMENTATION
from ..preflight import load_rules
from ..preflight.rules import Family, RuleSpec
from ..vocabulary import Finding, Severity, Site
from ..workbench import CheckedProtocol, CheckRun
from .wording import by_model, file_line, place_in_file, site_label, sites_by_line

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)


def check_sarif(run: CheckRun) -> str:
    """Render as a SARIF log with one run."""
    families, rules = run.rule_set.families, run.rule_set.rules
    index = {rule.id: number for number, rule in enumerate(rules)}
    notifications = [n for checked in run.protocols for n in _notifications(checked, index)]
    log = {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {
                    "driver": {
                        "name": "aegis-ot",
                        "semanticVersion": run.version,
                        "rules": [
                            _rule(rule, family) for family in families for rule in family.rules
                        ],
                    }
                },
                "columnKind": "unicodeCodePoints",
                "invocations": [
                    {
                        "executionSuccessful": run.exit_code != 2,
                        "exitCode": run.exit_code,
                        "toolExecutionNotifications": notifications,
                    }
                ],
                "artifacts": [{"location": _artifact(checked)} for checked in run.protocols],
                "results": [r for checked in run.protocols for r in _results(checked, index)],
            }
        ],
    }
    return json.dumps(log, indent=2, ensure_ascii=False) + "\n"


def _rule(rule: RuleSpec, family: Family) -> dict[str, Any]:
    """A rule; its help is its page of the documentation, if it is not a laboratory's own."""
    shipped = {one.family for one in load_rules().families}
    place = f"{DOCUMENTATION}rules/{family.family}.html#{rule.id}-{rule.name}".lower()
    return {
        **({"helpUri": place} if family.family in shipped else {}),
        "id": rule.id,
        "name": "".join(word.capitalize() for word in rule.name.split("-")),
        "shortDescription": {"text": rule.name.replace("-", " ")},
        "fullDescription": {"text": rule.statement},
        "help": {"text": f"{rule.rationale}\n\nFix: {rule.fix}\n\nReference: {rule.reference}"},
        "defaultConfiguration": {"level": rule.severity},
    }


def _results(checked: CheckedProtocol, index: dict[str, int]) -> Iterator[dict[str, Any]]:
    for finding in checked.findings:
        yield _result(checked, finding, index, [])
    for waived in checked.waived:
        kind = "inSource" if waived.waiver.line else "external"
        suppression = {"kind": kind, "justification": waived.waiver.reason}
        yield _result(checked, waived.finding, index, [suppression])
    for finding in checked.baselined:
        suppression = {"kind": "external", "justification": "Listed in the baseline."}
        yield _result(checked, finding, index, [suppression])


def _result(
    checked: CheckedProtocol,
    finding: Finding,
    index: dict[str, int],
    suppressions: Sequence[dict[str, Any]],
) -> dict[str, Any]:
    sites = sites_by_line(finding)
    places = [_location(checked, line, site_label(at)) for line, at in sites.items()]
    mark = f"({by_model(finding)})" if by_model(finding) else ""
    message = " ".join(part for part in (finding.message, mark, finding.why) if part)
    result: dict[str, Any] = {
        "ruleId": finding.rule,
        "level": "error" if finding.severity is Severity.ERROR else "warning",
        "message": {"text": f"{message} Fix: {finding.fix}" if finding.fix else message},
        "locations": [{**(places[-1] if places else _location(checked, None)), "id": 0}],
        "partialFingerprints": {"aegisFinding/v1": _fingerprint(checked, finding, sites)},
        "properties": {
            "wells": [well.address for well in finding.wells],
            "lines": list(finding.lines),
        },
    }
    if finding.source != "rules":
        result["properties"]["source"] = finding.source
    if finding.rule in index:
        result["ruleIndex"] = index[finding.rule]
    if len(places) > 1:
        result["relatedLocations"] = [{**p, "id": n} for n, p in enumerate(places[:-1], start=1)]
        steps = [{"location": place} for place in places]
        result["codeFlows"] = [{"threadFlows": [{"locations": steps}]}]
    if suppressions:
        result["suppressions"] = list(suppressions)
    return result


def _location(checked: CheckedProtocol, line: int | None, label: str = "") -> dict[str, Any]:
    physical: dict[str, Any] = {"artifactLocation": _artifact(checked)}
    if line and file_line(checked, line) is None:
        label = f"{place_in_file(checked, line)}{': ' if label else ''}{label}"
    elif line:
        region: dict[str, Any] = {"startLine": line}
        if line <= len(checked.lines):
            region["snippet"] = {"text": checked.lines[line - 1]}
        physical["region"] = region
    location: dict[str, Any] = {"physicalLocation": physical}
    if label:
        location["message"] = {"text": label}
    return location


def _artifact(checked: CheckedProtocol) -> dict[str, str]:
    """A relative reference where the user gave a relative path, else a file URI."""
    path = PurePosixPath(checked.file)
    text = quote(path.as_posix(), safe="/" if not path.is_absolute() else "/:")
    return {"uri": f"file://{text}" if path.is_absolute() else text}


def _fingerprint(checked: CheckedProtocol, finding: Finding, sites: dict[int, list[Site]]) -> str:
    """Stays the same when lines move."""
    code = [
        " ".join(checked.lines[line - 1].split()) for line in sites if line <= len(checked.lines)
    ]
    wells = [well.address for well in finding.wells]
    told = json.dumps([checked.file, finding.rule, code, wells], ensure_ascii=False)
    return hashlib.sha256(told.encode()).hexdigest()[:32]


def _notifications(checked: CheckedProtocol, index: dict[str, int]) -> Iterator[dict[str, Any]]:
    failures = checked.exploration.failures if checked.exploration else ()
    problems = [("", checked.problem)] if checked.problem else []
    for values, problem in [*problems, *failures]:
        told = f" with {values}" if values else ""
        yield {
            "level": "error",
            "message": {"text": f"Cannot be judged{told}: {problem.message}"},
            "locations": [_location(checked, problem.line)],
        }
    for undecided in checked.undecided:
        notification: dict[str, Any] = {
            "level": "error" if undecided.reason == checked.unanswered else "note",
            "message": {"text": f"{undecided.rule} is undecided: {undecided.told}"},
            "locations": [_location(checked, None)],
        }
        if undecided.rule in index:
            notification["associatedRule"] = {"id": undecided.rule, "index": index[undecided.rule]}
        yield notification
    for remark in checked.remarks:
        yield {
            "level": "warning",
            "message": {"text": remark.message},
            "locations": [_location(checked, remark.line)],
        }
    for note in checked.notes:
        yield {"level": "note", "message": {"text": note}, "locations": [_location(checked, None)]}
