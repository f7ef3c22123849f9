"""A recorded rehearsal as the rules see it: trace, evidence, families, roles, and cases."""

from __future__ import annotations

import functools
import gc
import re
from collections.abc import Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from dataclasses import replace

from ...adapters.opentrons.instrumentation import Operation
from ...adapters.opentrons.rehearsal import Recording
from ...vocabulary import WellRef
from ..checks import RuleContext
from ..evidence import DeckNames, Evidence, Kind, gather
from ..roles import Inference, Roles, assign_roles, derive, implied_contents, infer_families
from ..rule_set import RuleSet
from ..rules import Family, RuleSpec
from ..source import lexicon_of, read_source, steps_left_out
from ..trace import Well, build_trace
from .options import Options, check_options

_PLAUSIBLE = 1.0
"""From this score on a family that is not judged may still say what wells held."""


@contextmanager
def uncollected() -> Iterator[None]:
    """Hold the garbage collector, which takes a third of the time of a verdict: a trace is many
    small objects, none of them garbage.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


class Interpretation:
    """What a recorded protocol is taken for, with the eyes of every family that applies; made once,
    then judged, shown to a model, judged again.

    ``more`` is evidence beside what is gathered: a model's.

    Raises:
        ConfigurationError: If an option names a rule, role or family that does not exist.
        RuleError: If a family given by hand does not exist.

    Attributes:
        facts: What its text says as Python.
        trace: What it does.
        deck: Its labware, under all names.
        evidence: All that speaks for roles.
        families: All families, the likeliest first.
        roles: What the wells are for, in each family that applies.
        waste: Wells that are called waste.
        unsure: Wells that may have held liquid before the run, as names go.
    """

    @uncollected()
    def __init__(
        self,
        recording: Recording,
        rule_set: RuleSet,
        options: Options | None = None,
        more: Sequence[Evidence] = (),
    ) -> None:
        options = options or Options()
        check_options(options, rule_set)
        self.recording, self.rule_set, self.options = recording, rule_set, options
        self.facts = read_source(recording.text)
        common, log, labware = rule_set.common, recording.log, recording.labware
        named = lexicon_of({"through": common.flow_through})
        through = {
            key
            for key, info in labware.items()
            if any(map(named.find, (info.label, info.display_name, info.load_name)))
        }
        self.trace = trace = build_trace(log, labware, common.pauses, through=through)
        gathered = gather(trace, recording.names, self.facts, options.roles, common)
        self.evidence = evidence = (*gathered, *more)

        @functools.cache  # asked of few families
        def assigned(family: str) -> Roles:
            return assign_roles(rule_set.words[family], common, evidence, trace)

        assays = [words for words in rule_set.words.values() if words.family.is_assay]
        found = infer_families(assays, self.facts, evidence, trace, assigned, options.assay)
        self._assigned, self.families = assigned, tuple(found)
        self.roles = tuple(assigned(one.family) for one in found if one.applies)
        prefilled = {ref for one in self.roles for ref in implied_contents(one, trace)}
        # Read again, now that roles say which wells held liquid before the run.
        usage = trace.usage
        prefilled -= {ref for ref, used in usage.items() if used.first_drawn or used.prefilled}
        if prefilled & usage.keys():
            holds = prefilled.__contains__
            supposed = self._supposed(prefilled)
            self.trace = build_trace(log, labware, common.pauses, holds, through, supposed)
        for one in self.roles:
            derive(one, self.trace)
        self.deck = DeckNames(self.trace, recording.names)
        waste, groups = self._called(common.waste), self.trace.groups.items()
        # Where the first channel goes to the waste, the others do.
        self.waste = waste.union(*(group for first, group in groups if first in waste))
        self.unsure = self._called(common.prefilled) | self._implied_elsewhere()

    @property
    def family_known(self) -> bool:
        """Whether the likeliest family is given, or more than a guess and more than a fallback."""
        first = self.families[0] if self.families else None
        return bool(self.options.assay or (first and first.sure and not first.left_over))

    @functools.cached_property
    def left_out(self) -> Mapping[int, frozenset[WellRef]]:
        """The wells that each step names which is commented out, or which the run does not come by,
        by its line.
        """
        ran = {
            line for step in self.trace.log if isinstance(step, Operation) for line in step.lines
        }
        named = [one for one in self.evidence if one.variable]
        found: dict[int, set[WellRef]] = {}
        for step in steps_left_out(self.facts, ran):
            wells = found.setdefault(step.line, set())
            apart = {name for name, _ in step.places}
            for one in named:
                base = re.split(r"[.\[]", one.text)[0]
                means = step.names - apart if one.whole else step.names | step.origins
                if base in means:
                    wells.update(one.wells)
            for name, well in step.places:
                for key in self.deck.by_name.get(name, ()):
                    wells.update(self.deck.refs(key, [well]))
        return {line: frozenset(wells) for line, wells in found.items()}

    def cases(self) -> Iterator[tuple[RuleSpec, RuleContext]]:
        """Every rule that concerns this protocol, with the case that it is judged on.

        A rule of all assays is judged by composition: what a rule of the assay itself judges is
        left to that one.
        """
        applying = [inference for inference in self.families if inference.applies]
        cases = [self._case(*pair) for pair in zip(self.roles, applying, strict=True)]
        for case in cases:
            yield from ((rule, case) for rule in case.family.rules if rule.scope == "family")
        claims = [
            (check, case)
            for case in cases
            for rule in case.family.rules
            if rule.scope == "family"
            for check in self.rule_set.checks[rule.id]
        ]

        controls = {
            well
            for case in cases
            for well in self.trace.wells.values()
            if any(map(case.roles.is_control, case.of(well)))
        }

        @functools.cache
        def is_claimed(origin: Well, well: Well) -> bool | None:
            if origin in controls:
                return True  # what a control holds spoils nothing
            told = {check.claims(case, origin, well) for check, case in claims}
            return True in told or (None if None in told else False)

        known = {case.family.family: case for case in cases}
        for family in self.rule_set.families:
            shared = [rule for rule in family.rules if rule.scope == "all"]
            if shared:
                case = known.get(family.family) or self._case_beside(family, applying)
                case.is_claimed = is_claimed
                yield from ((rule, case) for rule in shared)

    def _case_beside(self, family: Family, applying: Sequence[Inference]) -> RuleContext:
        """A protocol of other families, seen with the eyes of one that does not apply.

        Roles that the guard gives are meant in the sense of theirs: a dilution's stock may be a
        row of samples.
        """
        told = [one for one in self.evidence if one.kind is not Kind.GIVEN]
        words, common = self.rule_set.words[family.family], self.rule_set.common
        roles = assign_roles(words, common, told, self.trace)
        derive(roles, self.trace)
        case = self._case(roles, max(applying, key=lambda one: one.sure, default=None))
        case.beside, case.in_prose = True, False  # whatever the assay is
        return case

    def with_evidence(self, more: Sequence[Evidence], assay: Sequence[str] = ()) -> Interpretation:
        """The same recording read with more evidence, and as another ``assay`` if one is named:
        nothing is rehearsed again.
        """
        options = replace(self.options, assay=tuple(assay)) if assay else self.options
        return Interpretation(self.recording, self.rule_set, options, more)

    def _case(self, roles: Roles, inferred: Inference | None = None) -> RuleContext:
        return RuleContext(
            self.trace,
            roles,
            self.rule_set.common,
            confident=inferred is None or inferred.sure,
            waste=self.waste,
            unsure=self.unsure,
            left_over=inferred is not None and inferred.left_over,
            in_prose=inferred is not None and inferred.in_prose,
            steps_left_out=lambda: self.left_out,
            absent=frozenset(role for role, wells in self.options.roles.items() if not wells),
        )

    def _called(self, words: Sequence[str]) -> frozenset[WellRef]:
        """Wells whose names, labels or liquids have one of these words."""
        lexicon = lexicon_of({"called": words})
        return frozenset(ref for e in self.evidence if lexicon.find(e.text) for ref in e.wells)

    def _supposed(self, prefilled: Set[WellRef]) -> Set[WellRef]:
        """Those of these wells that no more than a variable's name says held liquid before the run.

        Not those from which the run draws more than it gave them.
        """
        drawn = {one.visit.well.ref for one in self.trace.imbalances if not one.overfilled}
        said = [one for roles in self.roles for one in roles.by_well.items()]
        told = {ref for ref, one in said if not all(name.variable for name in one.evidence)}
        return prefilled - told - drawn

    def _implied_elsewhere(self) -> frozenset[WellRef]:
        """Wells that held liquid before the run in the eyes of a family that is not judged.

        Too little to accuse anyone, enough not to.
        """
        trace = self.trace
        if not any(i.visit.well.declared is None and not i.overfilled for i in trace.imbalances):
            return frozenset()
        return frozenset(
            ref
            for inference in self.families
            if not inference.applies and inference.score >= _PLAUSIBLE
            for ref in implied_contents(self._assigned(inference.family), trace)
        )
