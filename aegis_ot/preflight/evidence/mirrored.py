"""Layouts that a plate shares with the one it is stamped from.

Where nearly all wells of a plate go into the wells of the same place of another one, or each
into the same few places of a grid twice as fine, what a layout says of the first holds for the
second: the well with the NTC's water makes the NTC.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from ...vocabulary import WellRef
from ..layouts import Deck
from ..rules import Common
from ..text import SourceFacts, first_words, lexicon_of, tokens, written_lines
from ..trace import in_trough, row_column
from .clues import Clue, Strength

_FEWEST = 8
"""So many wells of a plate, in line with those they go into, are no chance."""

_MOST = 0.9
"""This share of them goes where the pattern says; one column of twelve may be a mistake."""

_NEAR = 4
"""So many words after "same columns as" say which plate, so many before it that it is not so."""

_STEPS = (1, 2, 3, 4)
"""A column of samples in quadruplicate takes four columns."""

Place = tuple[int, int]


class _Stamp(NamedTuple):
    """Where wells go: row and column times ``steps``, plus each of the ``offsets``."""

    steps: Place
    offsets: frozenset[Place]


_SAME = _Stamp((1, 1), frozenset({(0, 0)}))


def mirrored(deck: Deck, clues: Iterable[Clue], facts: SourceFacts, common: Common) -> list[Clue]:
    """What is said of wells of a plate, for the wells that they are stamped into.

    Only for wells of which no layout says anything, in plates that pass nothing on. Where the
    text says that plates are laid out alike, the layout of the second holds for the first, too.
    """
    layouts = [clue for clue in clues if _is_layout(deck, clue)]
    said = {ref for clue in layouts for ref in clue.wells}
    stamps = dict(_stamps(deck))
    if _says_alike(facts, common):
        alike = {pair: stamp for pair, stamp in stamps.items() if stamp == _SAME}
        stamps |= {(target, source): stamp for (source, target), stamp in alike.items()}
    return [
        copy
        for (source, target), stamp in stamps.items()
        for clue in layouts
        for copy in _copied(deck, clue, source, target, stamp, said)
    ]


def _says_alike(facts: SourceFacts, common: Common) -> bool:
    """Whether a comment or a docstring says that one plate is laid out as another one."""
    phrases = lexicon_of({"alike": common.alike})
    nouns = {word for words in common.labware.values() for word in words} | {"slot"}
    negations = first_words(common.negations)
    for line in written_lines(facts):
        words = phrases.words(line)
        for match in phrases.find(line):
            before, after = words[: match.start][-_NEAR:], words[match.end :][:_NEAR]
            if negations.isdisjoint(before) and not nouns.isdisjoint(after):
                return True
    return False


def _is_layout(deck: Deck, clue: Clue) -> bool:
    """Whether a clue says of chosen wells of a plate what they hold."""
    if clue.strength is Strength.LOOSE_NAME or clue.whole or clue.step or clue.role:
        return False
    if all(level is None for level in clue.levels) and all(
        len(word) < 2 for word in tokens(clue.text)
    ):
        return False  # `D[2]`
    wells = set(clue.wells)
    keys = {ref.labware for ref in wells}
    return not in_trough(deck.trace, *keys) and not any(
        wells.issuperset(deck.used_wells((key,))) for key in keys
    )


def _copied(
    deck: Deck, clue: Clue, source: str, target: str, stamp: _Stamp, said: Container[WellRef]
) -> Iterator[Clue]:
    info = deck.trace.labware[target]
    names = {row_column(name): name for name in info.wells}
    wells: list[WellRef] = []
    copied_from: list[WellRef] = []
    levels: list[float | None] = []
    for at, ref in enumerate(clue.wells):
        row, column = row_column(ref.name)
        for down, across in sorted(stamp.offsets) if ref.labware == source else ():
            name = names.get((row * stamp.steps[0] + down, column * stamp.steps[1] + across))
            copy = deck.refs.get((target, name or ""))
            if copy is not None and copy not in said:
                wells.append(copy)
                copied_from.append(ref)
                levels.append(clue.levels[at] if at < len(clue.levels) else None)
    if wells:
        yield replace(
            clue,
            strength=Strength.COMMENT,
            wells=tuple(wells),
            levels=tuple(levels) if clue.levels else (),
            said=f"{clue.said}, in the plate that it is stamped from",
            placed=True,
            copied_from=tuple(copied_from),
        )


def _stamps(deck: Deck) -> Mapping[tuple[str, str], _Stamp]:
    """For each two plates of which the one is stamped into the other, how."""
    trace = deck.trace
    pairs: dict[tuple[str, str], set[tuple[Place, Place]]] = {}
    passing: set[str] = set()
    for source, well, _ in trace.feedings():
        if source.ref.labware != well.ref.labware:
            passing.add(source.ref.labware)
            places = row_column(source.ref.name), row_column(well.ref.name)
            pairs.setdefault((source.ref.labware, well.ref.labware), set()).add(places)
    found: dict[tuple[str, str], _Stamp] = {}
    for (source_key, target), made in pairs.items():
        if target not in passing and not in_trough(trace, source_key, target):
            stamp = _stamp_of(made)
            if stamp is not None:
                found[source_key, target] = stamp
    return found


def _stamp_of(made: set[tuple[Place, Place]]) -> _Stamp | None:
    """The steps and offsets that nearly all transfers have in common, if there are such."""
    sources = {one for one, _ in made}
    if len(sources) < _FEWEST or len({column for _, column in sources}) < 2:
        return None
    for steps in ((down, across) for down in _STEPS[:2] for across in _STEPS):
        offsets = Counter(
            (other[0] - one[0] * steps[0], other[1] - one[1] * steps[1]) for one, other in made
        )
        common = {offset for offset, count in offsets.items() if count >= _MOST * len(sources)}
        inside = all(0 <= down < steps[0] and across < steps[1] for down, across in common)
        covered = sum(offsets[offset] for offset in common)
        if common and covered >= _MOST * len(made) and (inside or steps == (1, 1)):
            return _Stamp(steps, frozenset(common))
    return None
