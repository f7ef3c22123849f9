"""From a recorded rehearsal to a verdict: each rule is judged, what it finds is told once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ...adapters.opentrons.instrumentation import OperationKind
from ...errors import ConfigurationError
from ...vocabulary import Remark, Site, Undecided, WellRef
from ..checks import Check, Doubt, RuleContext, Violation
from ..evidence import Kind, unknown_places
from ..roles import Roles
from ..rules import RuleSpec
from ..source import chances
from ..trace import Contact, Well, places
from .doubts import UNKNOWN_ASSAY, missing_needs, missing_roles, undecided_by, unnamed_wells
from .findings import findings_of
from .interpretation import Interpretation, uncollected
from .report import Report, RoleEvidence, verdict_of
from .waivers import apply_waivers, read_waivers, waiver_remarks

_NOT_SURELY = "{}, or only came near the liquid: it is not sure how high that stands"
_IN_PROSE = "Only a comment or docstring says which assay this is ({})."
_DOUBTFUL = "It rests on what is only read of a well: {}."
_UNSAID = "Nothing in the protocol says what these wells hold."
_NAME_ALONE = "No more than a name says what these wells hold."
_CHANCE = (
    "What is moved depends on {}: another run may move otherwise than what was judged here. The "
    "guard follows the run, and says where it differs."
)
_Outcome = tuple[list[Violation], Undecided | None]
_IDLE = Remark("It moves no liquid: there is nothing to judge.")


@uncollected()
def judge(reading: Interpretation, so_far: bool | None = None) -> Report:
    """Judge a rehearsal by all rules in force; ``so_far`` is of a run: whether it goes on, and what
    may follow mends. Raises ConfigurationError where given roles are misplaced."""
    judged = {
        rule.id: _judge_rule(rule, reading.rule_set.checks[rule.id], case, bool(so_far))
        for rule, case in reading.cases()
        if reading.options.severity_of(rule) != "off"
    }
    return _report(reading, judged, refuses=so_far is None)


def _judge_rule(
    rule: RuleSpec, checks: Sequence[Check], case: RuleContext, so_far: bool
) -> _Outcome:
    """Where a rule is broken, or why that cannot be said (``None`` if it can)."""
    if so_far:
        checks = [check for check in checks if check.lasting]
    missing = missing_needs(rule, case.roles)
    if missing and not _are_supposed(missing, case.roles):
        demanded = {role for check in checks for role in check.demanded(case)}
        cannot_break = case.absent - demanded
        if any(cannot_break.issuperset(need.split("|")) for need in missing):
            return [], None
        return [], missing_roles(rule, case, missing)
    if not case.confident and not case.family.default and rule.scope == "family":
        return [], undecided_by(UNKNOWN_ASSAY, rule, case)
    violations, doubts = _results(checks, case)
    if not case.confident and not violations and rule.scope == "family":
        doubts.append(UNKNOWN_ASSAY)
    if violations:
        return violations, None
    if missing:
        return [], missing_roles(rule, case, missing)
    return [], undecided_by(doubts[0], rule, case) if doubts else None


def _results(checks: Sequence[Check], case: RuleContext) -> tuple[list[Violation], list[Doubt]]:
    """What the checks of a rule find, each place once: two checks may see the same."""
    told: dict[str, list[tuple[Site, ...]]] = {}
    violations: list[Violation] = []
    doubts: list[Doubt] = []
    for check in checks:
        kind = type(check)  # what two checks of one kind see in one statement is one cause
        for result in check.find(case):
            doubt = result if isinstance(result, Doubt) else _doubt_about(result, case)
            if doubt is not None:
                doubts.append(doubt)
            elif isinstance(result, Violation):
                known = told.setdefault(result.message, [])
                if result.sites not in known:
                    known.append(result.sites)
                    result.warning = _why_warning(result, case)
                    result.cause = (kind, *result.cause)
                    result.tip = (kind, result.warning, *result.tip) if result.tip else ()
                    violations.append(result)
    return violations, doubts


def _doubt_about(violation: Violation, case: RuleContext) -> Doubt | None:
    """Why a violation is no more than a doubt, if it is not."""
    if not case.confident and not _plain(violation, case.roles):
        return UNKNOWN_ASSAY
    near = case.left_over and violation.contact is Contact.NEAR
    near = near and not all(well.liquids for well in violation.rests_on)
    if near or violation.contact is Contact.UNSURE:
        told = violation.message
        return Doubt(_NOT_SURELY.format(told[0].lower() + told[1:].rstrip(".")))
    return None


def _are_supposed(needs: Sequence[str], roles: Roles) -> bool:
    """Whether some wells may have the roles that no well surely has: enough to tell of them."""
    return all(any(roles.has(ref, need.split("|")) for ref in roles.supposed) for need in needs)


def _plain(violation: Violation, roles: Roles) -> bool:
    """Whether it holds whatever the assay is.

    Loaded liquids and the run alone say what the wells are for that it rests on; or names and
    labels do, and nothing is open in what happened.
    """
    least = Kind.NAME if violation.in_any_assay else Kind.LIQUID
    return all(
        well.liquids or well.ref not in roles.by_well or roles.by_well[well.ref].kind >= least
        for well in violation.rests_on
    )


def _why_warning(violation: Violation, case: RuleContext) -> str:
    """Why a violation is a warning at most, in a sentence; empty for an error.

    Errors are certain (``spec/rules.md``, Severity).
    """
    if violation.warning:
        return violation.warning
    if violation.contact is Contact.NEAR:
        return "The tip came near the liquid there and may have stayed clear of it."
    roles = case.roles
    if case.in_prose and all(one.kind is not Kind.GIVEN for one in roles.by_well.values()):
        return _IN_PROSE.format(case.family.family)
    for well in violation.rests_on:
        if roles.is_doubtful(well.ref):
            return _DOUBTFUL.format(roles.by_well[well.ref].evidence[0].citation)
    wells = violation.rests_on
    shown = violation.shown
    if case.family.default and not all(w.liquids or _is_named(w, case, shown) for w in wells):
        named = any(well.ref in roles.by_well for well in wells if not well.liquids)
        return _NAME_ALONE if named else _UNSAID
    return ""


def _is_named(well: Well, case: RuleContext, shown: bool) -> bool:
    """Whether a label, an argument or data says what a well is for; or a variable's name, where
    the run has ``shown`` as much.

    A "sample plate" that is only given water may be one for samples.
    """
    roles = case.roles
    assigned = roles.by_well.get(well.ref)
    if assigned is None or assigned.kind < Kind.NAME:
        return False
    drawn = any(visit.kind is OperationKind.ASPIRATE for visit in well.visits)
    # Some roles only say where something comes from or goes: others are kinds of them.
    general = any(assigned.role in spec.parents for spec in roles.family.roles.values())
    if case.beside and general and drawn:
        return False  # in an assay whose own words do not say more
    loose = (general or case.left_over) and not case.is_one_liquid(well)
    loose = loose and assigned.role not in roles.derived.get(well.ref, ())
    if loose and not shown and all(one.variable for one in assigned.evidence):
        return False  # a variable is called `source`, and nothing else speaks for it
    return drawn or general or not assigned.evidence[0].whole


def _report(reading: Interpretation, outcomes: Mapping[str, _Outcome], refuses: bool) -> Report:
    violations = {rule: found for rule, (found, _) in outcomes.items()}
    undecided = [open_ for _, open_ in outcomes.values() if open_]
    recording, options, rule_set = reading.recording, reading.options, reading.rule_set
    waivers = read_waivers(reading.facts)
    standing, waived = apply_waivers(findings_of(violations, rule_set, options), waivers)
    open_ = {question.rule for question in undecided}
    judged = [rule for rule in violations if rule not in open_]
    known = [rule.id for rule in rule_set.rules]
    misplaced = [*unknown_places(reading.deck, options.roles, rule_set.common.levels)]
    sure = [told for told, always in misplaced if always or "add_parameters" not in recording.text]
    if refuses and sure:
        raise ConfigurationError(" ".join(sure))
    by_chance = chances(recording.text, reading.facts.nodes)
    return Report(
        file=recording.file,
        family=reading.families[0].family if reading.families else "",
        verdict=verdict_of(standing),
        findings=tuple(standing),
        undecided=tuple(dict.fromkeys(undecided)) if reading.trace.visits else (),
        roles=tuple(_evidence(reading.roles)),
        families=reading.families,
        waived=tuple(waived),
        remarks=(
            *([] if reading.trace.visits else [_IDLE]),
            *(Remark(told) for told, _ in misplaced),
            *_conflicts(reading.roles),
            *waiver_remarks(waivers, waived, judged, known),
            *(Remark(_CHANCE.format(source), line) for source, line in by_chance.items()),
        ),
        judged=tuple(judged),
        unnamed=unnamed_wells(reading),
    )


def _conflicts(all_roles: Sequence[Roles]) -> Iterable[Remark]:
    """Evidence that conflicts, once for all the wells that it concerns."""
    wells: dict[str, dict[WellRef, None]] = {}
    for roles in all_roles:
        for conflict, refs in roles.conflicts.items():
            wells.setdefault(conflict, {}).update(dict.fromkeys(refs))
    for conflict, found in wells.items():
        labels = " and ".join(dict.fromkeys(ref.label for ref in found if ref.label))
        where = places(list(found)) + (f" of {labels}" if labels else "")
        yield Remark(f"What {where} is for is said in two ways: {conflict}.")


def _evidence(all_roles: Sequence[Roles]) -> Iterable[RoleEvidence]:
    for roles in all_roles:
        for ref, assigned in roles.by_well.items():
            yield RoleEvidence(
                roles.family.family,
                ref,
                assigned.role,
                tuple(one.citation for one in assigned.evidence),
                roles.level(ref),
                assigned.conflict,
            )
        for ref, derived in roles.derived.items():
            for role in sorted(derived):
                why = ("follows from what it receives",)
                yield RoleEvidence(roles.family.family, ref, role, why, derived=True)
