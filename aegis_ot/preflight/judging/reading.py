"""A recorded rehearsal as the rules see it: trace, families, roles, and a case for each rule."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..checks import Case
from ..evidence import Clue, Strength, gather
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
from ..text import SourceFacts, lexicon_of, read_source, tokens
from ..trace import Pauses, Trace, Usage, build_trace, usage_of
from .options import Options


@dataclass(frozen=True)
class Reading:
    """What a protocol is taken for.

    Attributes:
        facts: What its text says.
        trace: What it does.
        usage: How it uses each well.
        families: All families, the likeliest first.
        roles: What the wells are for, in each family that applies.
        waste: Wells that are called waste.
        loose_volumes: Whether its wells held liquid that nobody declares.
        unsure: Wells that may have held liquid before the run, as the labware's name goes.
        database: The rules.
    """

    facts: SourceFacts
    trace: Trace
    usage: Mapping[WellRef, Usage]
    families: tuple[Inference, ...]
    roles: tuple[Roles, ...]
    waste: frozenset[WellRef]
    loose_volumes: bool
    unsure: frozenset[WellRef]
    database: Database

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

    def _case(self, roles: Roles, sure: bool, left_over: bool = False) -> Case:
        return Case(
            self.trace,
            roles,
            self.usage,
            self.database.common,
            sure,
            self.waste,
            self.loose_volumes,
            self.unsure,
            left_over,
        )


def read_recording(recording: Recording, database: Database, options: Options) -> Reading:
    """Read a recording with the eyes of every family that applies."""
    common = database.common
    facts = read_source(recording.text, recording.parameters)
    pauses = Pauses(common.pauses)
    trace = build_trace(recording.log, recording.labware, pauses)
    clues = gather(trace, recording.names, facts, options.roles, common)
    usage = usage_of(trace)
    assigned: dict[str, Roles] = {}

    def roles_of(family: Family) -> Roles:
        if family.family not in assigned:
            assigned[family.family] = assign_roles(family, common, clues, usage, trace)
        return assigned[family.family]

    families = infer_families(database, facts, clues, trace, roles_of, options.assay)
    roles = [roles_of(database.family(found.family)) for found in families if found.applies]
    prefilled: set[WellRef] = set()
    for one in roles:
        prefilled |= implied_contents(one, trace)
    # Read again, now that roles say which wells held liquid before the run.
    prefilled -= {ref for ref, used in usage.items() if used.first_drawn or used.prefilled}
    empty = _said_to_be_empty(clues, common)
    prefilled -= empty
    if prefilled & usage.keys():
        trace = build_trace(recording.log, recording.labware, pauses, prefilled.__contains__)
        usage = usage_of(trace)
    for one in roles:
        settle_diluent(one, trace)
        derive(one, trace, usage, common)
    return Reading(
        facts=facts,
        trace=trace,
        usage=usage,
        families=tuple(families),
        roles=tuple(roles),
        waste=_waste(clues, common, trace),
        loose_volumes=_loose_volumes(facts, common),
        unsure=(
            frozenset(_prefilled_by_words(clues, common))
            | _implied_elsewhere(database, families, clues, usage, trace)
        )
        - empty,
        database=database,
    )


def _loose_volumes(facts: SourceFacts, common: Common) -> bool:
    """Whether the protocol is of a kind whose wells held liquid that nobody declares."""
    lexicon = lexicon_of({"kind": common.protocol_prefilled})
    texts = [text for _, text in facts.docstrings]
    texts += list(facts.metadata.values())
    texts += [text for _, text in facts.strings]
    texts += list(facts.names)
    return any(lexicon.find(text) for text in texts)


_PLAUSIBLE = 1.0
"""From this score on a family that is not judged may still say what wells held."""


def _implied_elsewhere(
    database: Database,
    families: Iterable[Inference],
    clues: Sequence[Clue],
    usage: Mapping[WellRef, Usage],
    trace: Trace,
) -> frozenset[WellRef]:
    """Wells that held liquid before the run in the eyes of a family that is not judged.

    Too little to accuse anyone, enough not to.
    """
    if not any(i.visit.well.declared is None and not i.overfilled for i in trace.imbalances):
        return frozenset()
    found: set[WellRef] = set()
    for inference in families:
        if not inference.applies and inference.score >= _PLAUSIBLE:
            family = database.family(inference.family)
            roles = assign_roles(family, database.common, clues, usage, trace)
            found |= implied_contents(roles, trace)
    return frozenset(found)


def _prefilled_by_words(clues: Iterable[Clue], common: Common) -> set[WellRef]:
    """Wells whose names say, in any family, that they held liquid before the run."""
    lexicon = lexicon_of({"prefilled": common.prefilled})
    return {
        ref
        for clue in clues
        if clue.whole and clue.subject and lexicon.find(clue.text)
        for ref in clue.wells
    }


def _said_to_be_empty(clues: Iterable[Clue], common: Common) -> set[WellRef]:
    """Wells that are said to be empty at first: ``mix = rack["D1"]  # empty tube``.

    Not those of an "empty vector", nor where it is said when they will be empty.
    """
    empty = set(common.empty)
    nouns = {word for words in (*common.labware.values(), common.places) for word in words}
    return {
        ref
        for clue in clues
        if not clue.whole and not clue.step
        if empty & (words := set(tokens(clue.text))) and words <= empty | nouns
        for ref in clue.wells
    }


def _waste(clues: Iterable[Clue], common: Common, trace: Trace) -> frozenset[WellRef]:
    """Wells that are called waste; "to waste" beside a transfer means where it goes.

    Where a comment says "discard the surplus of column 10", that is drawn from, and no waste.
    """
    lexicon = lexicon_of({"waste": common.waste})
    drawn = {v.well.ref for v in trace.visits if v.kind is OperationKind.ASPIRATE}
    return frozenset(
        ref
        for clue in clues
        if clue.step != "source" and lexicon.find(clue.text)
        for ref in clue.wells
        if clue.strength > Strength.COMMENT or ref not in drawn
    )
