"""From the places where rules are broken to findings: one per cause, each told once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...vocabulary import Finding, Severity, WellRef
from ..checks import Violation
from ..rule_set import RuleSet
from ..rules import RuleSpec
from .options import Options


def findings_of(
    violations: Mapping[str, Sequence[Violation]], rule_set: RuleSet, options: Options
) -> list[Finding]:
    """The findings on one protocol, in the order of its lines; ``violations`` by rule."""
    wells = {rule: {one.well for one in found} for rule, found in violations.items()}
    findings: list[Finding] = []
    for name, found in violations.items():
        _, rule = rule_set.rule(name)
        # A more telling rule reports these already.
        replaced = set().union(*(wells.get(other, ()) for other in rule.unless_reported))
        left = [
            one
            for one in found
            if one.well not in replaced and one.well not in wells.get(one.told_by, ())
        ]
        findings += [_joined(group, rule, options) for group in _by_cause(left)]
    return sorted(findings, key=lambda finding: (min(finding.lines, default=0), finding.rule))


def _by_cause(violations: Sequence[Violation]) -> list[list[Violation]]:
    """Violations of one cause together, and those that one tip makes in the same way: the count
    grows with the tips, and not with all the wells that each has been in.
    """
    joined: dict[object, object] = {}

    def first(key: object) -> object:
        while (other := joined.setdefault(key, key)) != key:
            key = other
        return key

    for one in violations:
        if one.tip:
            joined[first(one.tip)] = first(one.cause)
    groups: dict[object, list[Violation]] = {}
    for one in violations:
        groups.setdefault(first(one.cause), []).append(one)
    return list(groups.values())


def _joined(group: Sequence[Violation], rule: RuleSpec, options: Options) -> Finding:
    """The finding on violations of one cause, with all the wells that they spoil."""
    first = min(group, key=lambda violation: bool(violation.warning))  # the worst of one cause
    wells = list(dict.fromkeys(violation.well for violation in (first, *group)))
    likewise = f" Likewise {_listed(wells)}." if len(wells) > 1 else ""
    severity = Severity.WARNING if first.warning else Severity(options.severity_of(rule))
    if options.strict:
        severity = Severity.ERROR
    sites = tuple(dict.fromkeys(site for one in (first, *group) for site in one.sites))
    told = f"{first.message}{likewise} {first.warning}".rstrip()
    return Finding(rule.id, severity, told, sites, why=rule.rationale, fix=rule.fix)


_MOST_SHOWN = 6


def _listed(wells: Sequence[WellRef]) -> str:
    """The wells behind the first one, by labware if they are in several: "B1, C1 of PCR plate"."""
    shown: dict[str, list[WellRef]] = {}
    further = wells[1:]
    for ref in further[:_MOST_SHOWN]:
        shown.setdefault(ref.labware, []).append(ref)
    several = len({ref.labware for ref in wells}) > 1
    parts = [
        ", ".join([*(ref.name for ref in refs[:-1]), str(refs[-1]) if several else refs[-1].name])
        for refs in shown.values()
    ]
    more = f" and {len(further) - _MOST_SHOWN} more" if len(further) > _MOST_SHOWN else ""
    return ", ".join(parts) + more
