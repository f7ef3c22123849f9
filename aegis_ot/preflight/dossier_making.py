"""Puts a dossier together from a rehearsal and what the checks made of it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from ..instrumentation import Event
from ..vocabulary import Severity, WellRef
from . import record
from .database import load_database, shipped_rules
from .dossier import DeckItem, Dossier, RoleLine, RuleBrief
from .judging import Options, Report, RoleEvidence, judge
from .rehearsal import Recording, Script
from .rules import Database, RuleSpec
from .trace import Pauses, Trace, build_trace, places, row_column, trace_table

LONGEST_SOURCE = 40_000
"""Characters of source that are shown; what is cut is said."""

MOST_ROLES = 40
"""Lines of roles that are shown."""


def make_dossier(
    recording: Recording,
    report: Report,
    database: Database,
    options: Options | None = None,
    parameters: Mapping[str, Any] | None = None,
) -> Dossier:
    """Put together what there is to know.

    Args:
        recording: What the rehearsal yielded.
        report: What the checks made of it.
        database: The rules.
        options: How it was judged.
        parameters: Values of runtime parameters, by variable name.
    """
    options = options or Options()
    pauses = Pauses(database.common.pauses)
    trace = build_trace(recording.log, recording.labware, pauses)
    best = report.families[0] if report.families else None
    wells = [well.ref for well in trace.wells.values()]
    wells += [role.well for role in report.roles]
    return Dossier(
        file=recording.file,
        source=_shortened(recording.text),
        parameters=json.dumps(dict(parameters or {}), sort_keys=True, default=str),
        family=report.family,
        family_known=bool(best and best.sure) or bool(options.assay),
        table=trace_table(trace),
        deck=_deck(trace),
        wells=tuple(dict.fromkeys(wells)),
        lines=_lines(recording),
        roles=_roles(report),
        rules=tuple(_rules(report, database, options)),
        questions=report.undecided,
        findings=(*report.findings, *(waived.finding for waived in report.waived)),
    )


def check_with_dossier(
    script: Script,
    database: Database | None = None,
    options: Options | None = None,
    timeout_s: float = 120.0,
) -> tuple[Report, Dossier]:
    """Rehearse a protocol, judge it, and put its dossier together.

    Raises:
        RehearsalError: It cannot be rehearsed.
        RuleError: A rule file cannot be used.
    """
    database = database or load_database()
    recording = record(script, timeout_s)
    report = judge(recording, database, options)
    given = {**script.parameters, **{k: str(v) for k, v in script.csv_parameters.items()}}
    return report, make_dossier(recording, report, database, options, given)


def _deck(trace: Trace) -> tuple[DeckItem, ...]:
    items = []
    for info in trace.labware.values():
        if info.is_tip_rack or info.is_trash or not info.wells:
            continue
        places_ = [row_column(name) for name in info.wells]
        rows, columns = max(p[0] for p in places_) + 1, max(p[1] for p in places_) + 1
        label = info.label or info.display_name
        items.append(DeckItem(info.key, info.slot, label, info.load_name, rows, columns))
    return tuple(items)


def _lines(recording: Recording) -> tuple[int, ...]:
    found: set[int] = set()
    for heard in recording.log:
        if heard.line is not None:
            found.add(heard.line)
        if not isinstance(heard, Event):
            found.update(heard.lines)
    return tuple(sorted(found))


def _roles(report: Report) -> tuple[RoleLine, ...]:
    groups: dict[tuple[str, str], list[RoleEvidence]] = {}
    told: set[tuple[WellRef, str]] = set()
    for item in report.roles:
        if (item.well, item.role) in told:
            continue
        told.add((item.well, item.role))
        said = item.evidence[0] if item.evidence else ""
        if item.conflict:
            said = f"CONFLICT: {item.conflict}"
        groups.setdefault((item.role, said), []).append(item)
    lines = [
        RoleLine(role + _levels(items), places([item.well for item in items]), said)
        for (role, said), items in groups.items()
    ]
    if len(lines) > MOST_ROLES:
        left = len(lines) - MOST_ROLES
        lines[MOST_ROLES:] = [RoleLine("...", f"{left} more lines", "not shown")]
    return tuple(lines)


def _levels(items: Sequence[RoleEvidence]) -> str:
    """Concentrations or doses, in the order of the wells."""
    levels = list(dict.fromkeys(f"{i.level:g}" for i in items if i.level is not None))
    if not levels:
        return ""
    shown = levels if len(levels) <= 10 else [*levels[:4], "...", *levels[-2:]]
    return f" (level {', '.join(shown)})"


def _rules(report: Report, database: Database, options: Options) -> list[RuleBrief]:
    applying = {inference.family for inference in report.families if inference.applies}
    open_rules = {undecided.rule for undecided in report.undecided}
    shipped = str(shipped_rules())
    briefs = []
    for family in database.families:
        for rule in family.rules:
            severity = options.severity.get(rule.id, rule.severity)
            if (options.select and rule.id not in options.select) or rule.id in options.ignore:
                continue
            if severity == "off":
                continue
            judged = rule.scope == "all" or family.family in applying
            decided = judged and rule.id not in open_rules
            text = "" if family.path.startswith(shipped) else rule_text(rule)
            briefs.append(RuleBrief(rule.id, Severity(severity), decided, text))
    return briefs


def rule_text(rule: RuleSpec) -> str:
    """One rule in a line: what must hold."""
    return f"{rule.id} {rule.name} ({rule.severity}): {rule.statement}"


def _shortened(text: str) -> str:
    if len(text) <= LONGEST_SOURCE:
        return text
    kept = text[:LONGEST_SOURCE].rpartition("\n")[0]
    return f"{kept}\n# ... {len(text) - len(kept)} more characters are not shown ..."
