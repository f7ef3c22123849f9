"""What a model gets to know of one protocol: source, trace, roles, open questions.

Put together where the rehearsal is (the robot, or a workstation), read where the model is. It
holds plain values only, so it crosses the wire as JSON; equal dossiers have equal digests, and
the sidecar asks a model once per digest.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..instrumentation import Event
from ..vocabulary import Finding, Severity, Undecided, WellRef, from_json, to_json
from .clues import Strength
from .judge import Options, Recording, Report, RoleEvidence, judge
from .recorder import Recorder
from .replacements import Replacements
from .roles import Assignment, Roles, implied_contents, usage_of
from .rulefiles import Database, RuleSpec, load_database, shipped_rules
from .script import Script
from .trace import Trace, build_trace, row_column
from .trace_table import places, trace_table

LONGEST_SOURCE = 40_000
"""Characters of source that are shown; what is cut is said."""

MOST_ROLES = 40
"""Lines of roles that are shown."""


@dataclass(frozen=True)
class DeckItem:
    """One piece of labware.

    Attributes:
        key: As in well references.
        slot: Where it was loaded.
        label: What the scientist called it, or its display name.
        load_name: Of its definition.
        rows: Rows of wells.
        columns: Columns of wells.
    """

    key: str
    slot: str
    label: str
    load_name: str
    rows: int
    columns: int


@dataclass(frozen=True)
class RuleBrief:
    """One rule in force.

    Attributes:
        id: Its identifier.
        severity: In force.
        decided: Whether the checks decided it, one way or the other.
        text: Statement and instruction, for rules that this package does not ship.
    """

    id: str
    severity: Severity
    decided: bool
    text: str = ""


@dataclass(frozen=True)
class RoleLine:
    """Wells that have one role on the same evidence."""

    role: str
    places: str
    evidence: str


@dataclass(frozen=True)
class Dossier:
    """See the module.

    Attributes:
        file: Name of the protocol file.
        source: Its text.
        parameters: Values of runtime parameters, as JSON text.
        family: The likeliest assay family.
        family_known: Whether that is more than a guess.
        table: The trace, see :mod:`~aegis_ot.preflight.trace_table`.
        deck: Labware that can hold liquid.
        wells: Wells that the run uses, or that have a role.
        lines: Source lines that did something in the run.
        roles: What wells are for.
        rules: Every rule in force.
        questions: Rules that the checks could not decide.
        findings: What the checks found.
    """

    file: str
    source: str
    parameters: str
    family: str
    family_known: bool
    table: tuple[str, ...]
    deck: tuple[DeckItem, ...]
    wells: tuple[WellRef, ...]
    lines: tuple[int, ...]
    roles: tuple[RoleLine, ...]
    rules: tuple[RuleBrief, ...]
    questions: tuple[Undecided, ...]
    findings: tuple[Finding, ...]

    @property
    def digest(self) -> str:
        """SHA-256 of everything but the file's name."""
        values = to_json(replace(self, file=""))
        text = json.dumps(values, sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()

    def to_json(self) -> dict[str, Any]:
        """Plain values for the wire."""
        values: dict[str, Any] = to_json(self)
        return values

    @classmethod
    def from_json(cls, data: Any) -> Dossier:
        """Back from :meth:`to_json`.

        Raises:
            ValueError: It is no dossier; says which field.
        """
        return from_json(cls, data)


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
    replacements = Replacements(database.common.pauses)
    trace = build_trace(recording.log, recording.labware, replacements)
    prefilled = _implied_contents(report, database, trace)
    if prefilled:
        trace = build_trace(recording.log, recording.labware, replacements, prefilled.__contains__)
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
    from .rehearsal import rehearse

    database = database or load_database()
    recorder = Recorder()
    rehearsal = rehearse(script, [recorder], timeout_s=timeout_s)
    recording = Recording(
        script.file_name, script.text, recorder.log, rehearsal.labware, rehearsal.names
    )
    report = judge(recording, database, options)
    given = {**script.parameters, **{k: str(v) for k, v in script.csv_parameters.items()}}
    return report, make_dossier(recording, report, database, options, given)


def _implied_contents(report: Report, database: Database, trace: Trace) -> set[WellRef]:
    """Wells whose role says that they held liquid before the run, as the checks saw it."""
    by_family: dict[str, Roles] = {}
    for item in report.roles:
        roles = by_family.get(item.family)
        if roles is None:
            roles = by_family[item.family] = Roles(database.family(item.family))
        # What a well receives gives it a further role; its own stands first.
        if item.role in roles.family.roles and item.well not in roles.by_well:
            roles.by_well[item.well] = Assignment(item.role, list(item.evidence), Strength.NAME, "")
    prefilled: set[WellRef] = set()
    for roles in by_family.values():
        prefilled |= implied_contents(roles, trace)
    used = usage_of(trace)
    return {ref for ref in prefilled if ref in used and not used[ref].first_drawn}


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
    for record in recording.log:
        if record.line is not None:
            found.add(record.line)
        if not isinstance(record, Event):
            found.update(record.lines)
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
