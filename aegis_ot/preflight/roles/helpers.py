"""What helper functions are called: ``add_water(tube, target)`` says what it draws.

A name speaks of what is drawn while the function is at work, if it says what is done and with
one thing. Where several functions around a draw say something, each is heard; the one that
draws from fewer wells knows better (see :mod:`.assigning`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, lexicon_of, tokens
from ..trace import Trace
from .clues import Clue, Strength
from .deck import MOST_TUBES
from .phrases import first_words
from .roles import Roles

_SAID = "function"


def helper_names(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """For each function that says what it gives, the wells that are drawn from within it."""
    things = {
        function: thing
        for function in set(facts.within.values())
        if (thing := thing_given(function[0], common))
    }
    drawn: dict[tuple[str, int], dict[WellRef, None]] = {}
    for visit in trace.visits if things else ():
        if visit.mixing or visit.kind is not OperationKind.ASPIRATE:
            continue
        for line in visit.lines:
            function = facts.within.get(line)
            if function in things:
                drawn.setdefault(function, {})[visit.well.ref] = None
    deeds = first_words(common.giving) | first_words(common.filling)
    for (name, line), wells in drawn.items():
        if len(wells) > 1 and deeds.isdisjoint(tokens(name)):
            continue  # ``dilute_samples_into`` may draw diluent as well
        yield Clue(
            Strength.LOOSE_NAME,
            things[name, line],
            tuple(wells),
            line,
            f"{_SAID} `{name}` at line {line}",
            step="source",
        )


def thing_given(name: str, common: Common) -> str:
    """What a function of this name gives: "water" for ``add_water_to_wells``; ``""`` if unsaid.

    Without a verb too, where it says what that goes into or stands for: ``water_into(*wells)``.
    """
    words = list(tokens(name))
    giving, filling = first_words(common.giving), first_words(common.filling)
    at = next((at for at, word in enumerate(words) if word in giving | filling), None)
    if at is None:
        return " ".join(_before_its_aim(words, common))
    before, after = words[:at], words[at + 1 :]
    if words[at] in filling:  # its object is what is filled, unless it stands alone
        filled_with = [n for n, word in enumerate(after) if word in first_words(common.joints)]
        return " ".join(after[filled_with[0] + 1 :]) if filled_with else ""
    said = _one_thing(after, giving | filling | first_words(common.handling), common)
    return " ".join(said if after else before)


def _before_its_aim(words: list[str], common: Common) -> list[str]:
    """The words before "into" or "instead of"; none where neither is said, or something is done."""
    stands_for = lexicon_of({"instead": common.instead}).find(" ".join(words))
    aims = [match.start for match in stands_for]
    aims += [at for at, word in enumerate(words) if word in first_words(common.toward)]
    before = words[: min(aims, default=0)]
    done = not first_words(common.handling).isdisjoint(before[:1])  # a "master mix" is a thing
    return [] if done or not first_words(common.joining).isdisjoint(before) else before


def _one_thing(words: list[str], verbs: Collection[str], common: Common) -> list[str]:
    """The words up to where it goes; further deeds are left out, further things make it none."""
    joining = first_words(common.joining)
    while len(words) > 1 and words[0] in joining and words[1] in verbs:
        words = words[2:]  # dispense_and_mix_sample
    toward = first_words(common.toward)
    for at, word in enumerate(words):
        if word in toward:
            return words[:at]
        if word in joining:
            return words[:at] if at + 1 < len(words) and words[at + 1] in verbs else []
    return words


def unsay_controls(roles: Roles, trace: Trace) -> None:
    """Forget what only a function's name says of a source that goes into controls alone.

    ``add_template(tube, ntc)`` gives the control what stands in the template's place. So does a
    tube in a rack of "drugs": the vehicle stands beside them. And a well of a plate of "drugs",
    where nothing says of any other well that it holds what these controls are to get, and they
    get nothing else of their own.
    """
    only = {
        ref
        for ref, assigned in roles.by_well.items()
        if (all(said.startswith(_SAID) for said in assigned.evidence) or assigned.whole)
        and not roles.family.roles[assigned.role].one_liquid
    }
    fed: dict[WellRef, set[WellRef]] = {}
    given: dict[WellRef, set[WellRef]] = {}
    for_others: set[WellRef] = set()
    for source, well, _ in trace.feedings() if only else ():
        given.setdefault(well.ref, set()).add(source.ref)
        if not roles.is_set_apart(well.ref):
            for_others.add(source.ref)
        if source.ref in only:
            fed.setdefault(source.ref, set()).add(well.ref)
    awaited = _awaited(roles)
    for ref, wells in fed.items():
        of_tubes = not roles.by_well[ref].whole or _is_of_tubes(trace, ref)
        if all(
            roles.is_set_apart(well)
            and (
                of_tubes
                or (roles.by_well[well].role in awaited and given[well] - for_others <= {ref})
            )
            for well in wells
        ):
            del roles.by_well[ref]


def _awaited(roles: Roles) -> set[str]:
    """Roles of wells that have a liquid of their own, of which nothing says where it stands."""
    feeders = {name: spec.feeds for name, spec in roles.family.roles.items() if spec.one_liquid}
    return {role for name, feeds in feeders.items() if not roles.known(name) for role in feeds}


def _is_of_tubes(trace: Trace, ref: WellRef) -> bool:
    """Whether a well is one of few, in a rack or a reservoir, which hold various things."""
    info = trace.labware.get(ref.labware)
    return info is not None and (info.centers_channels or len(info.wells) <= MOST_TUBES)
