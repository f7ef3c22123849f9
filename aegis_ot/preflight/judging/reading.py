"""A recorded rehearsal as the rules see it: trace, evidence, families, roles, and cases."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from ...vocabulary import WellRef
from ..checks import Case
from ..evidence import Evidence, gather
from ..rehearsal import Recording
from ..roles import (
    Inference,
    Roles,
    assign_roles,
    derive,
    implied_contents,
    infer_families,
    settle_diluent,
)
from ..rules import Common, Database, Family, RuleSpec
from ..source import SourceFacts, lexicon_of, read_source, tokens
from ..trace import Pauses, Trace, build_trace
from .options import Options, check_options

_PLAUSIBLE = 1.0
"""From this score on a family that is not judged may still say what wells held."""


@dataclass(frozen=True)
class Reading:
    """What a protocol is taken for; made once, then judged, shown to a model, judged again.

    Attributes:
        recording: The rehearsal.
        database: The rules.
        options: How to judge.
        facts: What its text says as Python.
        trace: What it does.
        evidence: All that speaks for roles.
        families: All families, the likeliest first.
        roles: What the wells are for, in each family that applies.
        waste: Wells that are called waste.
        unsure: Wells that may have held liquid before the run, as names go.
    """

    recording: Recording
    database: Database
    options: Options
    facts: SourceFacts
    trace: Trace
    evidence: tuple[Evidence, ...]
    families: tuple[Inference, ...]
    roles: tuple[Roles, ...]
    waste: frozenset[WellRef]
    unsure: frozenset[WellRef]

    @property
    def family_known(self) -> bool:
        """Whether the likeliest family is given, or more than a guess and more than a fallback."""
        first = self.families[0] if self.families else None
        return bool(self.options.assay or (first and first.sure and not first.left_over))

    def cases(self) -> Iterator[tuple[RuleSpec, Case]]:
        """Every rule that concerns this protocol, with the case that it is judged on."""
        families = {inference.family: inference for inference in self.families}
        for roles in self.roles:
            inference = families[roles.family.family]
            case = self._case(roles, inference.sure, inference.left_over)
            for rule in roles.family.rules:
                if rule.scope == "family":
                    yield rule, case
        for family in self.database.families:
            for rule in family.rules:
                if rule.scope == "all":
                    known = next((r for r in self.roles if r.family is family), Roles(family))
                    yield rule, self._case(known, True)

    def with_evidence(self, more: Sequence[Evidence], assay: Sequence[str] = ()) -> Reading:
        """The same recording read with more evidence: nothing is rehearsed again.

        Args:
            more: Further evidence, a model's.
            assay: The family that it is taken for; as before if empty.
        """
        options = replace(self.options, assay=tuple(assay)) if assay else self.options
        return _read(self.recording, self.database, options, self.facts, more)

    def _case(self, roles: Roles, sure: bool, left_over: bool = False) -> Case:
        return Case(
            self.trace,
            roles,
            self.database.common,
            sure,
            self.waste,
            self.unsure,
            left_over,
        )


@contextmanager
def uncollected() -> Iterator[None]:
    """Hold the garbage collector: a trace is many small objects, none of them garbage."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def read_recording(recording: Recording, database: Database, options: Options) -> Reading:
    """Read a recording with the eyes of every family that applies.

    Raises:
        ConfigurationError: If an option names a rule, role or family that does not exist.
        RuleError: If a family given by hand does not exist.
    """
    check_options(options, database)
    with uncollected():
        return _read(recording, database, options, read_source(recording.text), ())


def _read(
    recording: Recording,
    database: Database,
    options: Options,
    facts: SourceFacts,
    more: Sequence[Evidence],
) -> Reading:
    common = database.common
    pauses = Pauses(common.pauses)
    trace = build_trace(recording.log, recording.labware, pauses)
    evidence = [*gather(trace, recording.names, facts, options.roles, common), *more]
    assigned: dict[str, Roles] = {}

    def roles_of(family: Family) -> Roles:
        if family.family not in assigned:
            assigned[family.family] = assign_roles(family, common, evidence, trace)
        return assigned[family.family]

    families = infer_families(database, facts, evidence, trace, roles_of, options.assay)
    roles = [roles_of(database.family(found.family)) for found in families if found.applies]
    empty = _said_to_be_empty(evidence, common)
    prefilled = {ref for one in roles for ref in implied_contents(one, trace)} - empty
    # Read again, now that roles say which wells held liquid before the run.
    prefilled -= {ref for ref, used in trace.usage.items() if used.first_drawn or used.prefilled}
    if prefilled & trace.usage.keys():
        trace = build_trace(recording.log, recording.labware, pauses, prefilled.__contains__)
    for one in roles:
        settle_diluent(one, trace)
        derive(one, trace)
    elsewhere = _implied_elsewhere(database, families, roles_of, trace)
    return Reading(
        recording=recording,
        database=database,
        options=options,
        facts=facts,
        trace=trace,
        evidence=tuple(evidence),
        families=tuple(families),
        roles=tuple(roles),
        waste=_called(evidence, common.waste),
        unsure=(_called(evidence, common.prefilled) | elsewhere) - empty,
    )


def _implied_elsewhere(
    database: Database,
    families: Iterable[Inference],
    roles_of: Callable[[Family], Roles],
    trace: Trace,
) -> frozenset[WellRef]:
    """Wells that held liquid before the run in the eyes of a family that is not judged.

    Too little to accuse anyone, enough not to.
    """
    if not any(i.visit.well.declared is None and not i.overfilled for i in trace.imbalances):
        return frozenset()
    return frozenset(
        ref
        for inference in families
        if not inference.applies and inference.score >= _PLAUSIBLE
        for ref in implied_contents(roles_of(database.family(inference.family)), trace)
    )


def _called(evidence: Iterable[Evidence], words: Sequence[str]) -> frozenset[WellRef]:
    """Wells whose names, labels or liquids have one of these words."""
    lexicon = lexicon_of({"called": tuple(words)})
    return frozenset(ref for one in evidence if lexicon.find(one.text) for ref in one.wells)


def _said_to_be_empty(evidence: Iterable[Evidence], common: Common) -> frozenset[WellRef]:
    """Wells called no more than empty: ``empty_tubes``, not those of an "empty vector"."""
    empty, nouns = set(common.empty), {token for noun in common.noise for token in tokens(noun)}
    return frozenset(
        ref
        for one in evidence
        if not one.whole
        if empty & (words := set(tokens(one.text))) and words <= empty | nouns
        for ref in one.wells
    )
