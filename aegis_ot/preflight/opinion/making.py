"""Puts a dossier together from a reading and what the checks made of it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

from ...adapters.opentrons.rehearsal import Recording
from ...vocabulary import DeckItem, Dossier, RoleLine, RuleBrief, Severity, WellRef
from ..judging import Interpretation, Report, RoleEvidence, missing_needs
from ..rule_set import shipped_rules
from ..rules import RuleSpec
from ..trace import places, row_column, trace_table

LONGEST_SOURCE = 40_000
"""Characters of source that are shown; what is cut is said."""

MOST_ROLES = 40
"""Lines of roles that are shown."""


def make_dossier(reading: Interpretation, report: Report) -> Dossier:
    """Put together what there is to know of a protocol and of what the checks made of it."""
    recording, trace = reading.recording, reading.trace
    wells = [well.ref for well in trace.wells.values()]
    wells += [role.well for role in report.roles]
    return Dossier(
        file=recording.file,
        source=_shortened(recording.text),
        parameters=json.dumps(dict(recording.parameters), sort_keys=True),
        family=report.family,
        family_known=reading.family_known,
        table=trace_table(trace),
        deck=tuple(_deck(reading)),
        wells=tuple(dict.fromkeys(wells)),
        lines=_lines(recording),
        roles=_roles(report),
        rules=tuple(_rules(reading, report)),
        questions=report.undecided,
        wanted=tuple(_wanted(reading, report)),
        findings=(*report.findings, *(waived.finding for waived in report.waived)),
    )


def _deck(reading: Interpretation) -> Iterable[DeckItem]:
    for info in reading.deck.plates():
        places_ = [row_column(name) for name in info.wells]
        rows, columns = max(p[0] for p in places_) + 1, max(p[1] for p in places_) + 1
        label = info.label or info.display_name
        yield DeckItem(info.key, info.slot, label, info.load_name, rows, columns)


def _lines(recording: Recording) -> tuple[int, ...]:
    log = recording.log
    lines = {one for heard in log for one in (heard.line, *getattr(heard, "lines", ()))}
    return tuple(sorted(line for line in lines if line is not None))


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


def _rules(reading: Interpretation, report: Report) -> Iterable[RuleBrief]:
    shipped = str(shipped_rules())
    for family in reading.rule_set.assays:
        for rule in family.rules:
            severity = reading.options.severity_of(rule)
            if severity != "off":
                text = "" if family.path.startswith(shipped) else _own_rule(rule)
                yield RuleBrief(rule.id, Severity(severity), rule.id in report.judged, text)


def _wanted(reading: Interpretation, report: Report) -> Iterable[str]:
    """The roles that open rules need and no well has."""
    open_rules = {undecided.rule for undecided in report.undecided}
    for rule, case in reading.cases():
        missing = missing_needs(rule, case.roles) if rule.id in open_rules else []
        if missing:
            yield f"{rule.id}: {', '.join(missing).replace('|', ' or ')}"


def rule_text(rule: RuleSpec) -> str:
    """One rule in a line: what must hold."""
    return f"{rule.id} {rule.name} ({rule.severity}): {rule.statement}"


def _own_rule(rule: RuleSpec) -> str:
    """A laboratory's own rule, with all that its file tells a model."""
    look_for = f"Look for: {'; '.join(rule.indicators)}." if rule.indicators else ""
    return " ".join(filter(None, (rule_text(rule), rule.prompt, look_for)))


def _shortened(text: str) -> str:
    if len(text) <= LONGEST_SOURCE:
        return text
    kept = text[:LONGEST_SOURCE].rpartition("\n")[0]
    return f"{kept}\n# ... {len(text) - len(kept)} more characters are not shown ..."
