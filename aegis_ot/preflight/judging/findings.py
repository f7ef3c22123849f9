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
    wells = {one.rule.id: {violation.well for violation in one.violations} for one in broken}
    findings = [finding for one in broken for finding in _joined(one, strict, wells)]
    return sorted(findings, key=lambda finding: (min(finding.lines, default=0), finding.rule))


def _joined(broken: Broken, strict: bool, reported: dict[str, set[WellRef]]) -> Iterable[Finding]:
    """One finding per cause, with all the wells that it spoils.

    Those that a more telling rule reports already (``reported``, by rule) are left out.
    """
    rule = broken.rule
    replaced = set().union(*(reported.get(other, ()) for other in rule.unless_reported))
    groups: dict[tuple[object, ...], list[Violation]] = {}
    for violation in broken.violations:
        if violation.well not in replaced:
            groups.setdefault(violation.cause, []).append(violation)
    for group in groups.values():
        first = group[0]
        wells = list(dict.fromkeys(violation.well for violation in group))
        likewise = f" Likewise {_listed(wells)}." if len(wells) > 1 else ""
        severity = Severity.WARNING if first.warning else broken.severity
        if strict:
            severity = Severity.ERROR
        sites = tuple(dict.fromkeys(site for one in group for site in one.sites))
        told = f"{first.message}{likewise} {first.warning}".rstrip()
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
