"""The guard's ``roles`` of one protocol, ready to be completed and pasted into it."""

from __future__ import annotations

from collections.abc import Iterable

from ..errors import ConfigurationError
from ..preflight import Database, Report
from ..preflight.judging import RoleEvidence, spelled
from ..vocabulary import WellRef
from .result import CheckedProtocol

_OPEN = "# which wells?"


def roles_template(checked: CheckedProtocol, database: Database) -> str:
    """A decorator with every role of the protocol's family: filled with what is known, each entry
    with its evidence; what nothing names stands in comments below.

    Args:
        checked: The protocol.
        database: The rules, for the roles of its family.

    Raises:
        ConfigurationError: It could not be judged, so nothing of its roles is known.
    """
    report = checked.report
    if report is None:
        why = checked.problem.message if checked.problem else "it could not be judged"
        raise ConfigurationError(f"{checked.file}: no roles can be told: {why}")
    family = database.family(report.family)
    known = _by_role(report)
    lines = ["@guard(", f'    assay="{family.family}",', "    roles={"]
    for name, spec in family.roles.items():
        found = known.get(name, {})
        listed = ", ".join(f'"{place}"' for place in spelled(found))
        why = "; ".join(dict.fromkeys(found.values())) or _OPEN.removeprefix("# ")
        lines.append(f'        "{name}": [{listed}],  # {spec.title}: {why}')
    lines += ["    },", ")"]
    unnamed = [ref for ref in report.unnamed if all(ref not in wells for wells in known.values())]
    if unnamed:
        lines.append("# Used, and nothing says what they are for:")
        lines += [f"#   {place}" for place in spelled(unnamed)]
    return "\n".join(lines) + "\n"


def _by_role(report: Report) -> dict[str, dict[WellRef, str]]:
    """The wells of each role that evidence names, with the first evidence; not what follows."""
    found: dict[str, dict[WellRef, str]] = {}
    for item in _named(report.roles, report.family):
        found.setdefault(item.role, {})[item.well] = item.evidence[0]
    return found


def _named(roles: Iterable[RoleEvidence], family: str) -> Iterable[RoleEvidence]:
    told: set[WellRef] = set()
    for item in roles:
        if item.family == family and item.evidence and item.well not in told:
            told.add(item.well)
            yield item
