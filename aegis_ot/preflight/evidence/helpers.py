"""What helper functions are called: ``add_water(tube, target)`` says what it draws.

A name speaks of what is drawn while the function is at work, if it says what is done and with
one thing. Where several functions around a draw say something, each is heard; the one that
draws from fewer wells knows better (see :mod:`..roles.choosing`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..rules import Common
from ..text import SourceFacts, first_words, lexicon_of, tokens
from ..trace import Trace
from .clues import Clue, Strength

SAID_BY_FUNCTION = "function"
"""How such evidence begins, for people."""


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
            f"{SAID_BY_FUNCTION} `{name}` at line {line}",
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
