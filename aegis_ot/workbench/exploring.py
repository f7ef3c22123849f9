"""``--all-parameters``: rehearses a protocol with many values of its runtime parameters."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..adapters.opentrons.rehearsal import Parameter, Script
from ..preflight import Options, Report
from ..vocabulary import Finding, Remark
from .combinations import combinations, count_all, values_of
from .rehearser import Rehearser, TaskFailed
from .result import Broken, Exploration, Problem, with_findings
from .tasks import CheckTask, Describe, Examined

CAUSES_AT_MOST = 5
"""Causes told per rule."""

Values = Mapping[str, Any]
Outcome = Report | Problem


def explore(
    rehearser: Rehearser,
    script: Script,
    options: Options,
    rules: tuple[str, ...],
    timeout_s: float,
    default: Report,
) -> tuple[Report, Exploration]:
    """Judge the protocol with many values of its parameters.

    Parameters that ``script.parameters`` sets stay as they are. What breaks a rule is then
    narrowed down: values that can be put back to their default without mending it are.

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
    tried = {p.name: values_of(p) for p in declared if p.name not in script.parameters}
    varied = {name: values for name, values in tried.items() if len(values) > 1}

    def judge(values: Values) -> Outcome:
        there = dataclasses.replace(script, parameters={**script.parameters, **values})
        try:
            examined: Examined = rehearser.perform(CheckTask(there, options, rules, timeout_s))
        except TaskFailed as failed:
            return failed.problem
        return examined.report

    explorer = _Explorer({name: values[0] for name, values in varied.items()}, judge, default)
    if varied:
        for values in combinations(varied):
            explorer.run(values)
    runs = explorer.count
    failures = []
    for cause in explorer.causes(lambda outcome: isinstance(outcome, Problem)):
        outcome = explorer.run(cause)
        if isinstance(outcome, Problem):
            failures.append((explorer.in_words(cause), outcome))
    broken: list[Broken] = []
    findings = list(default.findings)
    for rule in explorer.rules():
        broken.append(_broken(explorer, rule, findings))
    exploration = Exploration(
        runs=runs,
        combinations=count_all(varied),
        parameters=varied,
        broken=tuple(entry for entry in broken if entry.values),
        failures=tuple(failures),
        not_varied=tuple(
            f"{name}: left as it is; it declares neither choices nor bounds"
            for name, values in tried.items()
            if len(values) < 2
        ),
    )
    remarks = tuple(r for r in default.remarks if explorer.always(r))
    return with_findings(default, findings, remarks=remarks), exploration


class _Explorer:
    """Runs values once each, and narrows down what some of them cause."""

    def __init__(
        self, defaults: Values, judge: Callable[[Values], Outcome], default: Report
    ) -> None:
        self._defaults = dict(defaults)
        self._judge = judge
        self._outcomes: dict[str, tuple[Values, Outcome]] = {}
        self._outcomes[self._key({})] = (self._defaults, default)

    @property
    def count(self) -> int:
        """Rehearsals so far."""
        return len(self._outcomes)

    def run(self, values: Values) -> Outcome:
        """What comes of these values, the others at their defaults."""
        key = self._key(values)
        if key not in self._outcomes:
            full = {**self._defaults, **values}
            self._outcomes[key] = (full, self._judge(full))
        return self._outcomes[key][1]

    def _key(self, values: Values) -> str:
        # As text: 1 == True.
        return repr([{**self._defaults, **values}[name] for name in self._defaults])

    def rules(self) -> list[str]:
        """Every rule that some run breaks."""
        reports = [o for _, o in self._outcomes.values() if isinstance(o, Report)]
        return sorted({finding.rule for report in reports for finding in report.findings})

    def always(self, remark: Remark) -> bool:
        """Whether every rehearsal that came to an end brings a remark: else a waiver is of use."""
        reports = [o for _, o in self._outcomes.values() if isinstance(o, Report)]
        return all(remark in report.remarks for report in reports)

    def showing(self, shows: Callable[[Outcome], bool]) -> int:
        """How many rehearsals show something."""
        return sum(shows(outcome) for _, outcome in self._outcomes.values())

    def causes(self, shows: Callable[[Outcome], bool]) -> list[Values]:
        """The smallest changes from the defaults after which an outcome shows something."""
        causes: list[Values] = []
        for values, outcome in list(self._outcomes.values()):
            if not shows(outcome) or any(self._contains(values, cause) for cause in causes):
                continue
            causes.append(self._narrowed(values, shows))
            if len(causes) >= CAUSES_AT_MOST:
                break
        return causes

    def _narrowed(self, values: Values, shows: Callable[[Outcome], bool]) -> Values:
        changed = {n: v for n, v in values.items() if repr(v) != repr(self._defaults[n])}
        for name in list(changed):
            without = {n: v for n, v in changed.items() if n != name}
            if shows(self.run(without)):
                changed = without
        return changed

    @staticmethod
    def _contains(values: Values, cause: Values) -> bool:
        return all(repr(values[name]) == repr(value) for name, value in cause.items())

    @staticmethod
    def in_words(cause: Values) -> str:
        """``columns=12, mix=False``."""
        return ", ".join(f"{name}={value}" for name, value in cause.items())


def _broken(explorer: _Explorer, rule: str, findings: list[Finding]) -> Broken:
    """What breaks a rule; adds to ``findings`` those that the defaults do not bring."""

    def breaks(outcome: Outcome) -> bool:
        return isinstance(outcome, Report) and any(f.rule == rule for f in outcome.findings)

    def keeps(outcome: Outcome) -> bool:
        return isinstance(outcome, Report) and not breaks(outcome)

    causes = explorer.causes(breaks)
    runs = explorer.showing(breaks)
    if not all(causes):  # the defaults break it
        cures = [explorer.in_words(cure) for cure in explorer.causes(keeps)]
        return Broken(rule, f"the defaults, unless {' or '.join(cures)}" if cures else "", runs)
    known = {finding.lines for finding in findings if finding.rule == rule}
    for cause in causes:
        outcome = explorer.run(cause)
        for finding in outcome.findings if isinstance(outcome, Report) else ():
            if finding.rule == rule and finding.lines not in known:
                known.add(finding.lines)
                message = f"With {explorer.in_words(cause)}: {finding.message}"
                findings.append(dataclasses.replace(finding, message=message))
    return Broken(rule, "; ".join(explorer.in_words(cause) for cause in causes), runs)
