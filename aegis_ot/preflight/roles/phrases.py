"""Which roles a text names, and whether it speaks of one thing or of several."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping, Sequence

from ..rules import Common, Family
from ..text import Lexicon, concentrations_in, lexicon_of, tokens
from .clues import Clue, Strength
from .roles import Roles


def role_words(family: Family, common: Common) -> Lexicon:
    """The words of all roles of a family; those that speak against one stand under ``!role``."""
    phrases: dict[str, Sequence[str]] = {}
    for name, spec in family.roles.items():
        phrases[name] = spec.words
        phrases[f"!{name}"] = spec.never
    return lexicon_of(phrases, common.aliases, common.endings)


def roles_named(lexicon: Lexicon, clue: Clue, common: Common) -> list[str]:
    """The roles that the text of a clue names, the head of the phrase first.

    English puts the head last: ``sample_buffer`` is a buffer; but what follows "in" or "for"
    only says more about it, and so does all that stands beside a word that is always the head:
    ``diluent_plasma`` is a diluent, ``eau_pcr`` is water. A word that only says on which side of
    a transfer something stands comes last: ``water_src`` is water.
    """
    return [role for group in _named_by_words(lexicon, clue, common) for role in group]


def roles_denied(lexicon: Lexicon, text: str) -> set[str]:
    """The roles that a text speaks against: a "lysis enzyme" is no template."""
    return {m.topic[1:] for m in lexicon.find(text) if m.topic.startswith("!")}


def names_several(lexicon: Lexicon, clue: Clue, common: Common, roles: Roles) -> bool:
    """Whether two words of a clue name different things."""
    groups = [group for group in _named_by_words(lexicon, clue, common) if group]
    return any(
        all(_unlike((role, another), roles) for role in one for another in other)
        for one in groups
        for other in groups
    )


def joins_others(lexicon: Lexicon, text: str, common: Common) -> bool:
    """Whether a name joins what it names with something else: "sample and dilution strips"."""
    words = tokens(text)
    joints = [at for at, word in enumerate(words) if word in first_words(common.joining)]
    if not joints:
        return False
    starts, ends = [0, *(at + 1 for at in joints)], [*joints, len(words)]
    parts = [" ".join(words[a:b]) for a, b in zip(starts, ends, strict=True)]
    named = [_names_any(lexicon, part) for part in parts]
    return any(named) and not all(named)


def _names_any(lexicon: Lexicon, text: str) -> bool:
    return any(not match.topic.startswith("!") for match in lexicon.find(text))


def _named_by_words(lexicon: Lexicon, clue: Clue, common: Common) -> list[list[str]]:
    """What each word or phrase of a clue may name, the head of the whole first."""
    text = _telling_part(lexicon, clue).replace("%", " percent ")
    places: dict[int, list[str]] = {}
    for match in lexicon.find(text):
        places.setdefault(match.start, []).append(match.topic)
    words = lexicon.words(text)
    places = _without_additives(places, words, common)
    if clue.step == "source":
        places = _drawn(places, words, common)
    joints = [at for at, word in enumerate(words) if word in first_words(common.joints)]
    before = text.lower().partition(f" {words[joints[0]]} ")[0] if joints else ""
    if joints and any(at < joints[0] for at in places):
        # "drug in medium" is a drug.
        places = {at: topics for at, topics in places.items() if at < joints[0]}
    elif joints and (
        (clue.subject and any(map(_is_telling, words[: joints[0]]))) or concentrations_in(before)
    ):
        places = {}  # "insulin in DMEM" is no medium, whatever insulin may be, nor "3 mM in DMSO"
    always = first_words(common.heads) if clue.subject else frozenset()
    sides = first_words(common.sides)
    ordered = [
        places[at]
        for at in sorted(
            places, key=lambda at: (words[at] in always, words[at] not in sides, at), reverse=True
        )
    ]
    return [[topic for topic in group if not topic.startswith("!")] for group in ordered]


_SHORTEST_NAME = 4


def _is_telling(word: str) -> bool:
    """Whether a word may be the name of something."""
    return word.isalpha() and len(word) >= _SHORTEST_NAME


def _without_additives(
    places: dict[int, list[str]], words: Sequence[str], common: Common
) -> dict[int, list[str]]:
    """What a text names apart from what is only added to it: "TE + 10 ng/µL tRNA" is TE."""
    if len(places) < 2:
        return places
    found = lexicon_of({"additive": common.additives}).find(" ".join(words))
    added = {at for match in found for at in range(match.start, match.end)}
    return {at: topics for at, topics in places.items() if at not in added} or places


def _drawn(
    places: Mapping[int, list[str]], words: Sequence[str], common: Common
) -> dict[int, list[str]]:
    """What a comment beside a transfer says of what is drawn: nothing in "last 100 to waste".

    What follows "to", an article apart, is where the liquid goes, not what it is.
    """
    toward, articles = first_words(common.toward), first_words(common.articles)
    end = len(words)
    for at, word in enumerate(words):
        if word in toward:
            then = at + 1
            while then < end and words[then] in articles:
                then += 1
            if then in places:
                end = at
                break
    return {at: topics for at, topics in places.items() if at < end}


@functools.lru_cache(maxsize=16)
def first_words(phrases: tuple[str, ...]) -> frozenset[str]:
    """The first word of each phrase of a list."""
    return frozenset(tokens(phrase)[0] for phrase in phrases)


def _telling_part(lexicon: Lexicon, clue: Clue) -> str:
    """The field of a record, where both names together would say what neither does.

    ``assay.mix_tube`` is a mix and no assay mix; ``primer.mix`` is a primer mix.
    """
    record, dot, field = clue.text.rpartition(".")
    if not dot or clue.strength not in (Strength.NAME, Strength.LOOSE_NAME) or " " in field:
        return clue.text
    ends = len(lexicon.words(record))
    across = {m.topic for m in lexicon.find(clue.text) if m.start < ends < m.end}
    alone = {m.topic for m in lexicon.find(record)}
    return field if across and not across & alone and lexicon.find(field) else clue.text


def says_only_the_side(clue: Clue, common: Common) -> bool:
    """Whether a name is no more than ``src``: it is given to whatever is drawn from."""
    return set(tokens(clue.text)) <= first_words(common.sides)


def is_outright(lexicon: Lexicon, text: str) -> bool:
    """Whether a text is nothing but the word for a role: "diluent"."""
    words = lexicon.words(text)
    return any(match.end - match.start == len(words) for match in lexicon.find(text))


def says_only_a_place(clue: Clue, common: Common) -> bool:
    """Whether a name is no more than ``wells``, which says nothing of what is in them."""
    return set(tokens(clue.text)) <= first_words(common.places)


def _joins(clue: Clue, common: Common) -> bool:
    """Whether a word of a clue joins several things."""
    return not first_words(common.joining).isdisjoint(tokens(clue.text))


def _ambiguous(fitting: Sequence[str], roles: Roles, clue: Clue, common: Common) -> bool:
    """A text that joins several different things speaks of none of them in particular.

    In a name the last word is the head, unless the name joins several with "and".
    """
    if clue.subject and not _joins(clue, common):
        return False
    return _unlike(fitting, roles)


def _made_of_a_reagent(
    fitting: Sequence[str], roles: Roles, clue: Clue, common: Common
) -> str | None:
    """The NTC in "H3: water (NTC)": what the well is, beside the reagent that it is made of."""
    specs = roles.family.roles
    passed_on = [role for role in fitting if specs[role].passed_on]
    if clue.subject or clue.step or len(passed_on) != 1 or _joins(clue, common):
        return None
    reagents = all(specs[role].one_liquid for role in fitting if role not in passed_on)
    return passed_on[0] if reagents else None


def _unlike(named: Sequence[str], roles: Roles) -> bool:
    """Whether two of these are neither the same nor one a kind of the other."""
    return any(
        one not in roles.closure(other) and other not in roles.closure(one)
        for one in named
        for other in named
    )


_A_PLATE = 6


def _is_plate_of(clue: Clue) -> bool:
    """Whether a liquid stood in so many wells before the run that it was in a plate, not tubes."""
    return clue.strength is Strength.LIQUID and len(set(clue.wells)) >= _A_PLATE


def fitting_role(
    named: Iterable[str], roles: Roles, sides: tuple[str, bool], clue: Clue, common: Common
) -> str | None:
    """The first named role whose side agrees with how the run uses the well."""
    named = list(dict.fromkeys(named))
    if clue.strength is Strength.GIVEN:
        return named[0]
    specs = roles.family.roles
    side, passes_on = sides
    if clue.step and clue.step != side:
        return None
    fitting = [role for role in named if specs[role].side in ("any", side)]
    if passes_on and not _is_plate_of(clue) and any(specs[role].side == "source" for role in named):
        # A plate of doses that is made here and given on is no plate of treated cells; a plate
        # of samples that is given on was one of samples before, and only gets buffer here.
        fitting = [
            role
            for role in fitting
            if not specs[role].implies_contents
            or (specs[role].side == side and role in specs[role].filled_by)
        ]
    if not fitting and passes_on and not clue.whole and clue.strength is not Strength.COMMENT:
        fitting = [role for role in named if specs[role].side == "source"]
    if made_of := _made_of_a_reagent(fitting, roles, clue, common):
        return made_of
    if not fitting or _ambiguous(fitting, roles, clue, common):
        return None
    if clue.subject and is_for_controls(named, sides, roles) and _treats(fitting[0], roles):
        return None
    return _general(fitting, roles) if _is_of_a_series(clue) else fitting[0]


def is_for_controls(named: Sequence[str], sides: tuple[str, bool], roles: Roles) -> bool:
    """Whether a source is named as what controls are given: a control siRNA is no treatment."""
    specs = roles.family.roles
    return sides[0] == "source" and specs[named[0]].replicated and not specs[named[0]].receives


def _treats(role: str, roles: Roles) -> bool:
    """Whether wells that receive this are called after that."""
    return any(role in spec.receives for spec in roles.family.roles.values() if spec.replicated)


_A_SERIES = 3


def _is_of_a_series(clue: Clue) -> bool:
    """Whether a comment speaks of so many wells that they are not all its one blank."""
    return clue.strength is Strength.COMMENT and len(set(clue.wells)) >= _A_SERIES


def _general(fitting: Sequence[str], roles: Roles) -> str:
    """The role that all of a series have: "standards, H1 = blank" are standards."""
    first = fitting[0]
    if roles.family.roles[first].level is None:
        return first
    above = [role for role in fitting[1:] if role in roles.closure(first) - {first}]
    return above[0] if above else first
