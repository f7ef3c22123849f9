"""From the places where rules are broken to findings: one per cause, each told once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ...vocabulary import Finding, Severity, WellRef
from ..checks import Violation
from ..rules import RuleSpec


class Broken(NamedTuple):
    """A rule and the places where it is broken.

    ``severity`` is the highest that its findings have.
    """

    rule: RuleSpec
    severity: Severity
    violations: list[Violation]


def findings_of(broken: Sequence[Broken], strict: bool) -> list[Finding]:
    """The findings on one protocol, in the order of its lines; ``strict``: all are errors."""
    findings = [finding for one in without_replaced(broken) for finding in _joined(one, strict)]
    return sorted(findings, key=lambda finding: (min(finding.lines, default=0), finding.rule))


def _joined(broken: Broken, strict: bool) -> Iterable[Finding]:
    """One finding per cause, with all the wells that it spoils."""
    rule = broken.rule
    groups: dict[tuple[object, ...], list[Violation]] = {}
    for violation in broken.violations:
        groups.setdefault(violation.cause, []).append(violation)
    for group in groups.values():
        first = group[0]
        wells = list(dict.fromkeys(violation.well.ref for violation in group))
        message = first.message
        if len(wells) > 1:
            message = f"{message} Likewise {_listed(wells)}."
        severity = Severity.WARNING if first.warning else broken.severity
        if strict:
            severity = Severity.ERROR
        sites = tuple(dict.fromkeys(site for one in group for site in one.sites))
        told = f"{message} {first.warning}".rstrip()
        yield Finding(rule.id, severity, told, sites, why=rule.rationale, fix=rule.fix)


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


def without_replaced(found: Sequence[Broken]) -> list[Broken]:
    """Drop violations in wells that a more telling rule already reports."""
    wells: dict[str, set[WellRef]] = {}
    for one in found:
        wells.setdefault(one.rule.id, set()).update(v.well.ref for v in one.violations)
    return [
        one._replace(
            violations=[
                violation
                for violation in one.violations
                if not any(violation.well.ref in wells.get(o, ()) for o in one.rule.unless_reported)
            ]
        )
        for one in found
    ]
