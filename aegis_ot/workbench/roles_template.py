"""The guard's ``roles`` of one protocol, ready to be completed and pasted into it."""

from __future__ import annotations

from ..errors import ConfigurationError
from ..preflight import Report, RuleSet
from ..preflight.judging import spelled
from ..vocabulary import WellRef
from .result import CheckedProtocol

_HOW = (
    "# Put it above `def run(...)`, in place of a @guard that stands there already, below\n"
    "# `from aegis_ot import guard`. Complete the roles that no well has yet, without their #:\n"
    '# `"ntc": ["4:H12"]`, a concentration as `["4:A1 = 2 mg/mL"]`; `"ntc": []` says there is none.'
)


def roles_template(checked: CheckedProtocol, rule_set: RuleSet) -> str:
    """A decorator with every role of the families that apply: filled with what is known, each entry
    with its evidence; what nothing names stands in comments below.

    Raises:
        ConfigurationError: It could not be judged, so nothing of its roles is known.
    """
    report = checked.report
    if report is None:
        why = checked.problem.message if checked.problem else "it could not be judged"
        raise ConfigurationError(f"{checked.file}: no roles can be told: {why}")
    families = [one.family for one in report.families if one.applies] or [report.family]
    known = _by_role(report)
    lines = [_HOW, "@guard("]
    asked = (rule_set.rule(one.rule) for one in report.undecided)
    beside = {family.family for family, rule in asked if rule.scope == "family"} - {*families}
    if len(families) == 1 and not beside:  # one that names one of several judges by no other
        lines.append(f'    assay="{families[0]}",')
    lines.append("    roles={")
    titles = {
        name: spec.title for one in families for name, spec in rule_set.family(one).roles.items()
    }
    for name, title in titles.items():
        found = known.get(name, {})
        listed = ", ".join(f'"{place}"' for place in spelled(found))
        why = "; ".join(dict.fromkeys(found.values())) or "which wells?"
        lines.append(f'        {"" if found else "# "}"{name}": [{listed}],  # {title}: {why}')
    lines += ["    },", ")"]
    unnamed = [ref for ref in report.unnamed if all(ref not in wells for wells in known.values())]
    if unnamed:
        lines.append("# Used, and nothing says what they are for:")
        lines += [f"#   {place}" for place in spelled(unnamed)]
    return "\n".join(lines) + "\n"


def _by_role(report: Report) -> dict[str, dict[WellRef, str]]:
    """The wells of each role that evidence names, with the first evidence; not what follows."""
    found: dict[str, dict[WellRef, str]] = {}
    told: set[tuple[str, WellRef]] = set()
    for item in report.roles:
        if item.evidence and not item.derived and (item.family, item.well) not in told:
            told.add((item.family, item.well))
            found.setdefault(item.role, {})[item.well] = item.evidence[0]
    return found
