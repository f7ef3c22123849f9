"""From a recorded rehearsal to a verdict: trace, roles, family, rules, findings."""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from ..errors import ConfigurationError
from ..instrumentation import LabwareInfo, NameBinding
from ..vocabulary import Finding, Severity, Site, Undecided, VerdictWord, WellRef
from .checks import Case, Doubt, Violation, make_check
from .clues import Clue, gather
from .families import Inference, infer
from .recorder import Record
from .replacements import Replacements
from .roles import Roles, assign_roles, derive, implied_contents, settle_diluent, usage_of
from .rulefiles import Common, Database, Family, RuleSpec
from .source import SourceFacts, read_source
from .trace import Trace, build_trace
from .waivers import Waived, apply_waivers, first_statement, read_waivers
from .words import Lexicon


@dataclass(frozen=True)
class Recording:
    """What a rehearsal yields.

    Attributes:
        file: Name of the protocol file.
        text: Its source.
        log: Steps and events, from a :class:`Recorder`.
        labware: Facts of each labware, by key.
        names: Names that held wells.
    """

    file: str
    text: str
    log: Sequence[Record]
    labware: Mapping[str, LabwareInfo]
    names: Sequence[NameBinding] = ()


@dataclass(frozen=True)
class Options:
    """How to judge.

    Attributes:
        assay: Families given by hand; empty to infer.
        roles: Roles given by hand: role to places (``"4:H12"``, ``"PCR plate:A1-A8"``).
        select: Only these rules; empty for all.
        ignore: Not these rules.
        severity: Severity in force for a rule: ``error``, ``warning`` or ``off``.
    """

    assay: Sequence[str] = ()
    roles: Mapping[str, Sequence[str]] = field(default_factory=dict)
    select: Sequence[str] = ()
    ignore: Sequence[str] = ()
    severity: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def from_settings(cls, settings: Any) -> Options:
        """The part of the guard's settings that concerns judging."""
        assay = getattr(settings, "assay", None) or ()
        return cls(
            assay=(assay,) if isinstance(assay, str) else tuple(assay),
            roles=dict(getattr(settings, "roles", None) or {}),
            select=tuple(getattr(settings, "select", None) or ()),
            ignore=tuple(getattr(settings, "ignore", None) or ()),
            severity=dict(getattr(settings, "severity", None) or {}),
        )


@dataclass(frozen=True)
class RoleEvidence:
    """One well's role with its evidence, for ``--explain-roles``."""

    family: str
    well: WellRef
    role: str
    evidence: tuple[str, ...]
    level: float | None = None
    conflict: str = ""


@dataclass(frozen=True)
class Report:
    """The verdict on one protocol.

    Attributes:
        file: Name of the protocol file.
        family: The likeliest family.
        verdict: ``fail`` with any error, ``warn`` with warnings only, ``pass`` otherwise.
        findings: Violations that stand.
        undecided: Rules that could not be judged.
        roles: Every role assignment, with evidence.
        families: All families, the likeliest first.
        waived: Findings that a waiver covers.
        notes: Stale waivers and conflicting evidence.
        lines: The protocol's source lines.
    """

    file: str
    family: str
    verdict: VerdictWord
    findings: tuple[Finding, ...]
    undecided: tuple[Undecided, ...]
    roles: tuple[RoleEvidence, ...] = ()
    families: tuple[Inference, ...] = ()
    waived: tuple[Waived, ...] = ()
    notes: tuple[str, ...] = ()
    lines: tuple[str, ...] = ()


def judge(recording: Recording, database: Database, options: Options | None = None) -> Report:
    """Judge a recorded protocol by all rules in force.

    Raises:
        ConfigurationError: If an option names a rule, role or family that does not exist.
        RuleError: If a family given by hand does not exist.
    """
    options = options or Options()
    _check_options(options, database)
    with _uncollected():
        return _judge(recording, database, options)


@contextmanager
def _uncollected() -> Iterator[None]:
    """Hold the garbage collector: a trace is many small objects, none of them garbage."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def _judge(recording: Recording, database: Database, options: Options) -> Report:
    facts = read_source(recording.text)
    replacements = Replacements(database.common.pauses)
    trace = build_trace(recording.log, recording.labware, replacements)
    clues = gather(trace, recording.names, facts, options.roles, database.common)
    families = infer(database, facts, clues, trace, options.assay)
    return _Judge(
        recording, database, options, facts, replacements, trace, clues, families
    ).report()


def _check_options(options: Options, database: Database) -> None:
    for name in options.assay:
        database.family(name)
    rules = {rule.id for rule in database.rules}
    for rule_id in (*options.select, *options.ignore, *options.severity):
        if rule_id not in rules:
            raise ConfigurationError(
                f"there is no rule {rule_id!r}; known are {', '.join(sorted(rules))}"
            )
    for rule_id, severity in options.severity.items():
        if severity not in ("error", "warning", "off"):
            raise ConfigurationError(
                f"severity of {rule_id}: expected error, warning or off, found {severity!r}"
            )
    known = {role for family in database.families for role in family.roles}
    for role in options.roles:
        if role not in known:
            raise ConfigurationError(
                f"there is no role {role!r}; known are {', '.join(sorted(known))}"
            )


class _Judge:
    def __init__(
        self,
        recording: Recording,
        database: Database,
        options: Options,
        facts: SourceFacts,
        replacements: Replacements,
        trace: Trace,
        clues: list[Clue],
        families: list[Inference],
    ) -> None:
        self._recording = recording
        self._database = database
        self._options = options
        self._facts = facts
        self._replacements = replacements
        self._trace = trace
        self._clues = clues
        self._families = families
        self._common: Common = database.common
        self._violations: list[tuple[RuleSpec, Severity, list[Violation]]] = []
        self._undecided: list[Undecided] = []
        self._roles: list[Roles] = []

    def report(self) -> Report:
        applying = [(self._database.family(i.family), i.sure) for i in self._families if i.applies]
        usage = usage_of(self._trace)
        prefilled: set[WellRef] = set()
        for family, _ in applying:
            roles = assign_roles(family, self._common, self._clues, usage, self._trace)
            self._roles.append(roles)
            prefilled |= implied_contents(roles, self._trace)
        # Read again, now that roles say which wells held liquid before the run.
        prefilled -= {ref for ref, used in usage.items() if used.first_drawn or used.prefilled}
        trace = self._trace
        if prefilled & usage.keys():
            trace = build_trace(
                self._recording.log,
                self._recording.labware,
                self._replacements,
                prefilled.__contains__,
            )
            usage = usage_of(trace)
        waste = _waste(self._clues, self._common)
        loose = self._loose_volumes()
        unsure = frozenset(_prefilled_by_words(self._clues, self._common))
        for (family, sure), roles in zip(applying, self._roles, strict=False):
            settle_diluent(roles, trace)
            derive(roles, trace, usage)
            case = Case(trace, roles, usage, self._common, sure, waste, loose, unsure)
            for rule in family.rules:
                if rule.scope == "family":
                    self._judge_rule(rule, case)
        for family in self._database.families:
            for rule in family.rules:
                if rule.scope == "all":
                    roles = next((r for r in self._roles if r.family is family), Roles(family))
                    case = Case(trace, roles, usage, self._common, True, waste, loose, unsure)
                    self._judge_rule(rule, case)
        return self._assemble()

    def _loose_volumes(self) -> bool:
        """Whether the protocol is of a kind whose wells held liquid that nobody declares."""
        lexicon = Lexicon({"kind": self._common.protocol_prefilled})
        texts = [text for _, text in self._facts.docstrings]
        texts += list(self._facts.metadata.values())
        texts += [text for _, text in self._facts.strings]
        texts += list(self._facts.names)
        return any(lexicon.find(text) for text in texts)

    def _judge_rule(self, rule: RuleSpec, case: Case) -> None:
        options = self._options
        if options.select and rule.id not in options.select:
            return
        severity = options.severity.get(rule.id, rule.severity)
        if rule.id in options.ignore or severity == "off":
            return
        missing = [
            need
            for need in rule.needs
            if not any(case.roles.known(role) for role in need.split("|"))
        ]
        if missing:
            self._undecided.append(Undecided(rule.id, _missing(case.family, missing)))
            return
        if not case.confident and not self._options.assay:
            self._undecided.append(
                Undecided(rule.id, 'the assay is not known; say it with assay="..."')
            )
            return
        violations: list[Violation] = []
        doubts: list[str] = []
        for number, check in enumerate(rule.checks):
            for result in make_check(check, rule.id).find(case):
                if isinstance(result, Doubt):
                    doubts.append(result.reason)
                else:
                    violations.append(
                        Violation(
                            result.message,
                            result.sites,
                            result.well,
                            (number, *result.cause),
                        )
                    )
        self._violations.append((rule, Severity(severity), violations))
        if doubts and not violations:
            self._undecided.append(Undecided(rule.id, doubts[0]))

    def _assemble(self) -> Report:
        findings = [
            finding
            for rule, severity, violations in _without_replaced(self._violations)
            for finding in _join(rule, violations, severity)
        ]
        findings.sort(key=lambda finding: (min(finding.lines, default=0), finding.rule))
        waivers = read_waivers(self._facts, first_statement(self._recording.text))
        standing, waived, notes = apply_waivers(findings, waivers)
        conflicts = dict.fromkeys(note for roles in self._roles for note in roles.conflicts)
        notes += [f"Evidence conflicts for {note}" for note in conflicts]
        verdict = VerdictWord.PASS
        if any(finding.severity is Severity.ERROR for finding in standing):
            verdict = VerdictWord.FAIL
        elif standing:
            verdict = VerdictWord.WARN
        return Report(
            file=self._recording.file,
            family=self._families[0].family if self._families else "",
            verdict=verdict,
            findings=tuple(standing),
            undecided=tuple(dict.fromkeys(self._undecided)),
            roles=tuple(_evidence(self._roles)),
            families=tuple(self._families),
            waived=tuple(waived),
            notes=tuple(notes),
            lines=tuple(self._recording.text.splitlines()),
        )


def _prefilled_by_words(clues: Iterable[Clue], common: Common) -> set[WellRef]:
    """Wells whose names say, in any family, that they held liquid before the run."""
    lexicon = Lexicon({"prefilled": common.prefilled})
    return {
        ref
        for clue in clues
        if clue.whole and clue.subject and lexicon.find(clue.text)
        for ref in clue.wells
    }


def _waste(clues: Iterable[Clue], common: Common) -> frozenset[WellRef]:
    lexicon = Lexicon({"waste": common.waste})
    return frozenset(ref for clue in clues if lexicon.find(clue.text) for ref in clue.wells)


def _missing(family: Family, needs: Sequence[str]) -> str:
    names = [" or ".join(family.roles[role].title for role in need.split("|")) for need in needs]
    return f"nothing says which well is the {' and which the '.join(names)}"


def _join(rule: RuleSpec, violations: Sequence[Violation], severity: Severity) -> Iterable[Finding]:
    """One finding per cause, with all the wells that it spoils."""
    groups: dict[tuple[object, ...], list[Violation]] = {}
    for violation in violations:
        groups.setdefault(violation.cause, []).append(violation)
    for group in groups.values():
        first = group[0]
        wells = list(dict.fromkeys(violation.well.ref for violation in group))
        message = first.message
        if len(wells) > 1:
            shown = ", ".join(ref.name for ref in wells[1:7])
            more = f" and {len(wells) - 7} more" if len(wells) > 7 else ""
            message = f"{message} Likewise {shown}{more}."
        sites: dict[Site, None] = dict.fromkeys(first.sites)
        for violation in group[1:]:
            sites.update(dict.fromkeys(violation.sites))
        yield Finding(rule.id, severity, message, tuple(sites), why=rule.rationale, fix=rule.fix)


Judged = tuple[RuleSpec, Severity, list[Violation]]


def _without_replaced(found: Sequence[Judged]) -> list[Judged]:
    """Drop violations in wells that a more telling rule already reports."""
    wells: dict[str, set[WellRef]] = {}
    for rule, _, violations in found:
        wells.setdefault(rule.id, set()).update(v.well.ref for v in violations)
    return [
        (
            rule,
            severity,
            [
                violation
                for violation in violations
                if not any(violation.well.ref in wells.get(o, ()) for o in rule.unless_reported)
            ],
        )
        for rule, severity, violations in found
    ]


def _evidence(all_roles: Sequence[Roles]) -> Iterable[RoleEvidence]:
    for roles in all_roles:
        for ref, assigned in roles.by_well.items():
            yield RoleEvidence(
                roles.family.family,
                ref,
                assigned.role,
                tuple(assigned.evidence),
                roles.level(ref),
                assigned.conflict,
            )
        for ref, derived in roles.derived.items():
            for role in sorted(derived):
                yield RoleEvidence(
                    roles.family.family, ref, role, ("follows from what it receives",)
                )
