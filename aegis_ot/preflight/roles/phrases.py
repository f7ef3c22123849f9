"""Which roles a text names, and whether it speaks of one thing or of several."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from ..evidence import Clue, Strength
from ..rules import Common, Family
from ..text import Lexicon, concentrations_in, first_words, lexicon_of, tokens, words_of
from .roles import Roles


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


def without_differing(
    lexicon: Lexicon, clue: Clue, named: Sequence[str], family: Family
) -> list[str]:
    """Without roles that are named only by words that for many wells stand for various liquids."""
    said: dict[str, set[str]] = {}
    for match in lexicon.find(clue.text):
        said.setdefault(match.topic, set()).add(match.phrase)
    return [
        role
        for role in named
        if role not in said or not said[role].issubset(family.roles[role].differing)
    ]


def names_several(lexicon: Lexicon, clue: Clue, common: Common, roles: Roles) -> bool:
    """Whether two words of a clue name different things."""
    groups = [group for group in _named_by_words(lexicon, clue, common) if group]
    return any(
        all(unlike((role, another), roles) for role in one for another in other)
        for one in groups
        for other in groups
    )


def what_all_are(named: Sequence[str], roles: Roles) -> list[str]:
    """The role that all of these are kinds of, if there is one: "DNA + controls" holds DNA."""
    every = [role for role in named if all(role in roles.closure(other) for other in named)]
    return every[:1] or list(named)


def joins_others(lexicon: Lexicon, text: str, common: Common) -> bool:
    """Whether a name joins what it names with something else: "sample and dilution strips"."""
    parts = parts_joined(text, common, lambda piece: piece.strip() in ("/", "+", "&"))
    parts = [part for part in parts if re.search(r"[^\W\d_]", part)]  # not "channels 1 and 2"
    named = [names_any(lexicon, part) for part in parts]
    return any(named) and not all(named)


def parts_joined(text: str, common: Common, is_mark: Callable[[str], bool]) -> list[str]:
    """The parts of a name between the words for "and", and between what else joins them."""
    joining = first_words(common.joining)
    parts = [""]
    for piece in re.split(r"(\W+)", text):
        if is_mark(piece) or not joining.isdisjoint(tokens(piece)):
            parts.append("")
        else:
            parts[-1] += piece
    return parts


def names_any(lexicon: Lexicon, text: str) -> bool:
    """Whether a text has a word for any role."""
    return any(not match.topic.startswith("!") for match in lexicon.find(text))


def _named_by_words(lexicon: Lexicon, clue: Clue, common: Common) -> list[list[str]]:
    """What each word or phrase of a clue may name, the head of the whole first."""
    text = _telling_part(lexicon, clue).replace("%", " percent ").replace(" + ", " plus ")
    if what_it_is := _called_at_the_end(lexicon, text, first_words(common.articles)):
        return [what_it_is]
    places: dict[int, list[str]] = {}
    ends: dict[int, int] = {}
    for match in lexicon.find(text):
        places.setdefault(match.start, []).append(match.topic)
        ends[match.start] = match.end
    words = lexicon.words(text)
    places = _without_additives(places, words, common)
    places = _without_what_is_not(places, words, common)
    if clue.step == "source":
        places = _without_wells(_drawn(places, words, common), ends, words, common)
    apart = first_words(common.replicates)  # "lysates in triplicate + BSA curve" is two things
    joints = [
        at
        for at, word in enumerate(words)
        if word in first_words(common.joints) and apart.isdisjoint(words[at + 1 : at + 2])
    ]
    whole = clue.subject or clue.strength is Strength.DESCRIPTION  # it says what that is
    before = text.lower().partition(f" {words[joints[0]]} ")[0] if joints else ""
    if joints and any(at < joints[0] for at in places):
        # "drug in medium" is a drug.
        places = {at: topics for at, topics in places.items() if at < joints[0]}
    elif joints and (
        (whole and not _says_only_labware(words[: joints[0]], common)) or concentrations_in(before)
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
    if joints:
        ordered.append(_called_at_the_end(lexicon, text, frozenset()))
    return [[topic for topic in group if not topic.startswith("!")] for group in ordered]


_IN_BRACKETS_AT_END = re.compile(r"\(([^()]+)\)\W*$")


def _called_at_the_end(lexicon: Lexicon, text: str, articles: frozenset[str]) -> list[str]:
    """What a text says in brackets that it speaks of: "medium with DMSO only (vehicle)".

    With one of these ``articles`` before it, if there are any: "blocking buffer (the diluent)".
    """
    match = _IN_BRACKETS_AT_END.search(text)
    if match is None:
        return []
    first, _, rest = match[1].partition(" ")
    called = rest if first.lower() in articles else "" if articles else match[1]
    found = lexicon.find(called) if called and is_outright(lexicon, called) else ()
    return [match.topic for match in found if not match.topic.startswith("!")]


_SHORTEST_NAME = 3


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


def _without_what_is_not(
    places: dict[int, list[str]], words: Sequence[str], common: Common
) -> dict[int, list[str]]:
    """What a text names apart from what this stands for: "water instead of DNA" is water.

    And apart from what is not in it: ``rpmi_without_lps`` is medium. "No template" is a name.
    """
    found = lexicon_of({"instead": common.instead}).find(" ".join(words))
    end = min((match.start for match in found), default=len(words))
    lacking = first_words(common.lacking)
    return {
        at: topics
        for at, topics in places.items()
        if at < end and (at == 0 or words[at - 1] not in lacking)
    }


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


def _without_wells(
    places: dict[int, list[str]], ends: Mapping[int, int], words: Sequence[str], common: Common
) -> dict[int, list[str]]:
    """Nothing of a comment beside a transfer that names several things, one of them as wells:
    "treated columns, then controls" says where something goes.
    """
    lines = (common.layout.get(kind, ()) for kind in ("column", "columns", "row", "rows"))
    wells = first_words(common.places).union(*map(words_of, lines))
    of_wells = any(not wells.isdisjoint(words[ends[at] : ends[at] + 1]) for at in places)
    return {} if len(places) > 1 and of_wells else places


def _says_only_labware(words: Sequence[str], common: Common) -> bool:
    """Whether words name no more than a vessel: what is in a "trough with PBS" is PBS."""
    listed = (*common.labware.values(), common.pauses.get("trough", ()))
    nouns = words_of(tuple(word for several in listed for word in several))
    return all(word in nouns for word in words if _is_telling(word))


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


_ITEM = re.compile(r"(\w+)\[.*\]")


def of_its_dict(
    lexicon: Lexicon, clue: Clue, named: list[str], common: Common, roles: Roles
) -> list[str]:
    """The roles that the name of a source in a dict names: ``mixes["neg. desert"]`` is a mix.

    A dict of one liquid, or of what dilutes a series, tells what its items are, unless the key
    names another liquid or a drug.
    """
    match = _ITEM.fullmatch(clue.text)
    specs, series = roles.family.roles, roles.family.series
    if match is None or specs[named[0]].one_liquid or specs[named[0]].dosed:
        return named
    base = roles_named(lexicon, replace(clue, text=match[1]), common)
    diluting = (*series.diluent, *series.diluent_else) if series else ()
    return base if base and (specs[base[0]].one_liquid or base[0] in diluting) else named


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


def unlike(named: Sequence[str], roles: Roles) -> bool:
    """Whether two of these are neither the same nor one a kind of the other."""
    return any(
        one not in roles.closure(other) and other not in roles.closure(one)
        for one in named
        for other in named
    )
