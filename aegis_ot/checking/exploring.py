"""``--all-parameters``: rehearses a protocol with many values of its runtime parameters."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from ..preflight import Options, Report
from ..preflight.script import Script
from ..vocabulary import Finding
from .combinations import combinations, count_all, values_of
from .rehearser import Rehearser, TaskFailed
from .result import Broken, Exploration, Problem, with_findings
from .tasks import Check, Describe, Parameter

Values = Mapping[str, Any]


def explore(
    rehearser: Rehearser,
    script: Script,
    options: Options,
    rules: tuple[str, ...],
    timeout_s: float,
    default: Report,
) -> tuple[Report, Exploration]:
    """Judge the protocol with many values of its parameters.

    Parameters that ``script.parameters`` sets stay as they are.

    Args:
        rehearser: Performs the rehearsals.
        script: The protocol, with the values that the user gave.
        options: How to judge.
        rules: Paths of further rules.
        timeout_s: Longest rehearsal, s.
        default: The report with the user's values and otherwise the defaults.

    Returns:
        A report with the findings of all runs, each once, those that need certain values saying
        so; and what was tried.

    Raises:
        TaskFailed: The parameters cannot be read.
    """
    declared: Sequence[Parameter] = rehearser.perform(Describe(script, timeout_s))
    open_ones = [p for p in declared if p.name not in script.parameters and p.kind != "csv_file"]
    tried = {p.name: values_of(p) for p in open_ones}
    fixed = [name for name, values in tried.items() if len(values) < 2]
    varied = {name: values for name, values in tried.items() if len(values) > 1}
    runs: list[tuple[Values, Report]] = []
    failures: list[tuple[str, Problem]] = []
    for values in combinations(varied) if varied else [{}]:
        if all(values[name] == options_[0] for name, options_ in varied.items()):
            runs.append((values, default))
            continue
        there = dataclasses.replace(script, parameters={**script.parameters, **values})
        try:
            runs.append((values, rehearser.perform(Check(there, options, rules, timeout_s))))
        except TaskFailed as failed:
            failures.append((in_words(values, varied), failed.problem))
    broken = tuple(_broken(rule, runs, varied) for rule in _rules(runs, default))
    exploration = Exploration(
        runs=len(runs) + len(failures),
        combinations=count_all(varied),
        parameters=varied,
        broken=broken,
        failures=tuple(failures),
        not_varied=tuple(f"{name} declares neither choices nor bounds" for name in fixed),
    )
    return with_findings(default, _merged(default, runs, varied)), exploration


def in_words(values: Values, varied: Mapping[str, Sequence[Any]]) -> str:
    """``columns=12, mix=False``: the values that are not the default, or all if all are."""
    changed = {name: value for name, value in values.items() if value != varied[name][0]}
    return ", ".join(f"{name}={value}" for name, value in (changed or values).items())


def _rules(runs: Sequence[tuple[Values, Report]], default: Report) -> list[str]:
    """Rules that some runs break and others do not."""
    everywhere = {finding.rule for finding in default.findings}
    for _, report in runs:
        everywhere &= {finding.rule for finding in report.findings}
    found = {finding.rule for _, report in runs for finding in report.findings}
    return sorted(found - everywhere)


def _broken(
    rule: str, runs: Sequence[tuple[Values, Report]], varied: Mapping[str, Sequence[Any]]
) -> Broken:
    """The shortest statement of which values break a rule.

    Values, then pairs of values, that break it wherever they occur and together account for
    every run that does; where there are none, the runs themselves.
    """
    bad = [v for v, report in runs if any(f.rule == rule for f in report.findings)]
    good = [v for v, report in runs if not any(f.rule == rule for f in report.findings)]
    for size in (1, 2):
        sets = [
            chosen
            for names in itertools.combinations(varied, size)
            for chosen in itertools.product(*([(n, v) for v in varied[n]] for n in names))
            if any(_holds(chosen, values) for values in bad)
            and not any(_holds(chosen, values) for values in good)
        ]
        if sets and all(any(_holds(chosen, values) for chosen in sets) for values in bad):
            return Broken(rule, _told(sets), len(bad))
    shown = "; ".join(in_words(values, varied) for values in bad[:6])
    return Broken(rule, shown + (" and others" if len(bad) > 6 else ""), len(bad))


def _holds(chosen: Sequence[tuple[str, Any]], values: Values) -> bool:
    return all(values[name] == value for name, value in chosen)


def _told(sets: Sequence[tuple[tuple[str, Any], ...]]) -> str:
    if all(len(chosen) == 1 for chosen in sets):
        by_name: dict[str, list[str]] = {}
        for ((name, value),) in sets:
            by_name.setdefault(name, []).append(str(value))
        return "; ".join(f"{name}={' or '.join(values)}" for name, values in by_name.items())
    return "; ".join(" with ".join(f"{n}={v}" for n, v in chosen) for chosen in sets[:6])


def _merged(
    default: Report, runs: Sequence[tuple[Values, Report]], varied: Mapping[str, Sequence[Any]]
) -> list[Finding]:
    """The default's findings, and once each those that need other values, which say so."""
    findings = list(default.findings)
    known = {(finding.rule, finding.lines) for finding in findings}
    for values, report in runs:
        for finding in report.findings:
            key = (finding.rule, finding.lines)
            if key not in known:
                known.add(key)
                message = f"With {in_words(values, varied)}: {finding.message}"
                findings.append(dataclasses.replace(finding, message=message))
    return findings
