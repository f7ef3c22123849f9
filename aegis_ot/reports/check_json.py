"""Checked protocols as JSON, for programs.

::

    {"schema_version": 2, "version",
     "summary": {"protocols", "pass", "warn", "fail", "error", "errors", "warnings",
                 "undecided", "waived", "baselined", "exit_code"},
     "protocols": [{"file", "family", "verdict": "pass|warn|fail|error",
                    "findings": [{"rule", "severity", "wells", "lines", "message", "fix"}],
                    "undecided": [{"rule", "reason", "paste"}],
                    "rules": {RULE: "decided|undecided|not_applicable|off"}}]}

Wells are ``slot:well``. ``rules`` names every rule in force, for a protocol that was judged: those
of other assays, and those that nothing in it concerns, are not applicable; those left out by the
options, its guard or its project are off. A protocol has further keys only where there is something
to say: ``error`` (``message``, ``line``) where it could not be judged, ``model`` (``name``,
``state``, ``detail``, ``seconds``, ``tokens``) where a model was asked, ``waived``, ``baselined``,
``remarks`` (``line``, ``message``) on conflicting evidence, modules that were found around it and
waivers that waive nothing, ``notes``, ``parameters`` and, on request, ``families`` and ``roles``.
A finding that a model made and no check has ``"source": "model"``. Of a file that has commands
for lines (``lines_are``), a finding has ``steps`` (``number``, ``name``) where the file tells
Protocol Designer's.
"""

from __future__ import annotations

import dataclasses
import json
from collections import Counter
from typing import Any

from ..vocabulary import Finding
from ..workbench import CheckedProtocol, CheckRun, Exploration

SCHEMA_VERSION = 2


def check_json(run: CheckRun) -> str:
    """Render as JSON text."""
    protocols = [
        {**protocol_values(c, run.explain_roles), "rules": c.states(run.rule_set)}
        for c in run.protocols
    ]
    data = {
        "schema_version": SCHEMA_VERSION,
        "version": run.version,
        "summary": _summary(run),
        "protocols": protocols,
    }
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _summary(run: CheckRun) -> dict[str, int]:
    verdicts = Counter(checked.verdict.value for checked in run.protocols)
    severities = Counter(f.severity.value for checked in run.protocols for f in checked.findings)
    return {
        "protocols": len(run.protocols),
        **{word: verdicts[word] for word in ("pass", "warn", "fail", "error")},
        "errors": severities["error"],
        "warnings": severities["warning"],
        "undecided": sum(len(checked.undecided) for checked in run.protocols),
        "waived": sum(len(checked.waived) for checked in run.protocols),
        "baselined": sum(len(checked.baselined) for checked in run.protocols),
        "exit_code": run.exit_code,
    }


def protocol_values(checked: CheckedProtocol, explain_roles: bool = False) -> dict[str, Any]:
    """One protocol as plain values."""
    values: dict[str, Any] = {
        "file": checked.file,
        "family": checked.family,
        "verdict": checked.verdict.value,
        "findings": [_finding(checked, finding) for finding in checked.findings],
        "undecided": [
            {"rule": u.rule, "reason": u.reason, "paste": u.paste, "to_write": u.to_write}
            for u in checked.undecided
        ],
    }
    if checked.unit != "line":
        values["lines_are"] = f"{checked.unit}s"
    if checked.problem is not None:
        values["error"] = {"message": checked.problem.message, "line": checked.problem.line}
    reply = checked.judgement.reply if checked.judgement else None
    if reply is not None:
        values["model"] = {
            "name": reply.model,
            "state": reply.state.value,
            "detail": reply.detail,
            "seconds": round(reply.seconds, 3),
            "tokens": dataclasses.asdict(reply.usage),
        }
    if checked.waived:
        values["waived"] = [
            {**_finding(checked, w.finding), "reason": w.waiver.reason} for w in checked.waived
        ]
    if checked.baselined:
        values["baselined"] = [_finding(checked, finding) for finding in checked.baselined]
    if checked.remarks:
        values["remarks"] = [{"line": r.line, "message": r.message} for r in checked.remarks]
    if checked.notes:
        values["notes"] = list(checked.notes)
    if checked.exploration is not None:
        values["parameters"] = _exploration(checked.exploration)
    if explain_roles and checked.report is not None:
        values["families"] = [
            {"family": i.family, "confidence": i.confidence, "reasons": list(i.reasons)}
            for i in checked.report.families
        ]
        values["roles"] = [
            {
                "well": role.well.address,
                "family": role.family,
                "role": role.role,
                "level": role.level,
                "evidence": list(role.evidence),
                "conflict": role.conflict,
            }
            for role in checked.roles
        ]
    return values


def _finding(checked: CheckedProtocol, finding: Finding) -> dict[str, Any]:
    values: dict[str, Any] = {
        "rule": finding.rule,
        "severity": finding.severity.value,
        "wells": [well.address for well in finding.wells],
        "lines": list(finding.lines),
        "message": finding.message,
        "fix": finding.fix,
    }
    steps = [checked.steps[line] for line in finding.lines if line in checked.steps]
    if steps:
        values["steps"] = [dataclasses.asdict(step) for step in dict.fromkeys(steps)]
    if finding.source != "rules":
        values["source"] = finding.source
    return values


def _exploration(exploration: Exploration) -> dict[str, Any]:
    return {
        "runs": exploration.runs,
        "combinations": exploration.combinations,
        "tried": {name: list(values) for name, values in exploration.parameters.items()},
        "broken": [
            {"rule": b.rule, "values": b.values, "runs": b.runs} for b in exploration.broken
        ],
        "failures": [
            {"values": values, "message": problem.message, "line": problem.line}
            for values, problem in exploration.failures
        ],
        "not_varied": list(exploration.not_varied),
    }
