"""The concentration or dose that a clue gives a well."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import replace
from typing import Any

from ...vocabulary import WellRef
from ..rules import Common
from ..text import (
    Rank,
    concentration_in,
    direction_in,
    first_words,
    labware_words,
    level_in,
    lexicon_of,
    listed_levels,
    name_without_level,
    numbers_in_order,
    tokens,
    words_of,
)
from ..trace import row_column
from .clues import Clue, Strength


def levels_of(clue: Clue, common: Common) -> tuple[float | None, ...]:
    """Level that a clue gives each of its wells, in their order; ``None`` where it gives none."""
    count = len(clue.wells)
    beside = clue.levels[:count]
    return (*beside, *_said(clue, common)[len(beside) :]) if len(beside) < count else beside


def levels_beside(clue: Clue, common: Common) -> tuple[float | None, ...]:
    """Levels that a clue gives its wells without a word for what they hold: ``"2 mg/ml"``.

    A comment gives one only where it says nothing else, but for a vessel: "vial B 2 mg/ml"; beside
    a list it may say that this is "rising".
    """
    if clue.levels or clue.whole or clue.step or clue.strength is Strength.LOOSE_NAME:
        return clue.levels
    if clue.lone and len(clue.wells) > 1 and not _is_block(clue):
        direction = direction_in(clue.text, common) if _says_order_only(clue.text, common) else 0
        if direction:
            return tuple(Rank(direction * position) for position in range(len(clue.wells)))
    if clue.strength is Strength.COMMENT and _says_more(clue.text, common):
        return ()
    several = listed_levels(clue.text)
    if len(several) > 1:  # "0, 125, 250 ug/ml": one for each
        return several if len(several) == len(set(several)) == len(clue.wells) else ()
    level = level_in(clue.text, common, plain_numbers=False)
    return () if level is None else (level,) * len(clue.wells)


def _says_order_only(text: str, common: Common) -> bool:
    """Whether a text says no more than that doses rise or fall: "rising", not "falling height"."""
    lexicon = lexicon_of({"order": (*common.rising, *common.falling)})
    words = lexicon.words(text)
    said = {at for match in lexicon.find(text) for at in range(match.start, match.end)}
    amounts = words_of((*common.amounts, *common.joints, *common.articles))
    return bool(said) and all(at in said or word in amounts for at, word in enumerate(words))


def _says_more(text: str, common: Common) -> bool:
    """Whether a text says more than an amount, and perhaps a vessel by its letter."""
    vessels = labware_words(common)
    return any(len(w) > 1 and w not in vessels for w in name_without_level(text, common))


def without_lone_middle(common: Common, clues: Iterable[Clue]) -> Common:
    """Without the words for a middle level where no clue names what it lies between.

    "HEK293 in 100 uL medium" tells what the cells stand in.
    """
    middle = common.levels.get("middle")
    words = lexicon_of({word: (word,) for word, level in common.levels.items() if level})
    told = {common.levels[match.topic] for clue in clues for match in words.find(clue.text)}
    if told != {middle}:
        return common
    kept = {word: level for word, level in common.levels.items() if level != middle}
    return replace(common, levels=kept)


def _said(clue: Clue, common: Common) -> tuple[float | None, ...]:
    """The levels that the words of a clue give its wells."""
    count = len(clue.wells)
    if count > 1:
        listed = tuple(numbers_in_order(clue.text))
        if len(listed) == count and len(set(listed)) == count:
            return listed
        if clue.whole:
            return (None,) * count
        # Beside a step the wells stand in the order of the run: whether they rise is the question.
        direction = 0 if clue.step or _is_block(clue) else direction_in(clue.text, common)
        if direction:
            return tuple(Rank(direction * position) for position in range(count))
        several = listed_levels(clue.text)
        if len(several) > 1:  # one for each, of these wells or of others
            alike = len(several) == len(set(several)) == count
            return several if alike else (None,) * count
        if clue.step:  # "row H = blank" beside a loop is one of them
            return (concentration_in(clue.text),) * count
    level = level_in(clue.text, common, plain_numbers=clue.subject)
    if level == 0 and count > 1 and any(numbers_in_order(clue.text)):
        return (None,) * count  # "blank, 250 ... 2000": one of them is the blank
    return (level,) * count


def _is_block(clue: Clue) -> bool:
    """Whether a comment speaks of a part of several columns: in which order is not said.

    Whole columns of a rack or a plate go one after the other.
    """
    places = [row_column(ref.name) for ref in clue.wells]
    rows, columns = ({place[axis] for place in places} for axis in (0, 1))
    whole = len(rows) in _ALL_ROWS
    return clue.strength is Strength.COMMENT and min(len(rows), len(columns)) > 1 and not whole


_ALL_ROWS = (4, 8, 16)
"""Of a rack of 24 tubes, of a plate of 96 wells, and of one of 384."""


def speaks_of_amounts(name: str, common: Common) -> bool:
    """Whether a name says that its numbers are amounts: ``CONC``, or no more than ``std_curve``."""
    amounts, curves = first_words(common.amounts), first_words(common.curves)
    words = set(tokens(name))
    of_a_curve = bool(words & curves) and words <= amounts | curves
    return of_a_curve or names_amounts(name, common)


def names_amounts(name: str, common: Common) -> bool:
    """Whether a name has a word for concentrations or doses: ``CONC``, ``dose_of_column``."""
    return bool(lexicon_of({"amount": common.amounts}).find(name))


def names_counts(name: str, common: Common) -> bool:
    """Whether a name has a word for volumes, places or numbers of times: ``VOLUMES``, ``reps``."""
    return bool(lexicon_of({"count": common.countings}).find(name))


def words_for_zero(common: Common) -> tuple[str, ...]:
    """The words for nothing at all: "blank"."""
    return tuple(word for word, level in common.levels.items() if level == 0)


def names_zero(text: str, common: Common) -> bool:
    """Whether a text has a word for nothing at all."""
    return bool(lexicon_of({"zero": words_for_zero(common)}).find(text))


def is_number(value: Any) -> bool:
    """Whether a value of the protocol is a number, and no larger than a float can be."""
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def number_in(value: Any) -> float | None:
    """The number that a value of the protocol is, or that its text says."""
    if isinstance(value, str):
        with suppress(ValueError):
            value = float(value)
    return float(value) if is_number(value) else None


def as_one_of_amounts(
    wells: tuple[WellRef, ...], line: int | None, where: str, levels: tuple[float, ...]
) -> Clue:
    """So many amounts of one thing, ``where`` they stand together, are its standards."""
    said = f"one of several amounts in {where}"
    return Clue(Strength.LOOSE_NAME, "standard", wells, line, said, levels=levels)


_FEWEST_AMOUNTS = 3

_FAR = 10
"""Numbers as large as so many times their count are amounts."""


def far_apart(numbers: Collection[float]) -> bool:
    """Whether these are amounts of one thing: so many, and too far apart to count something."""
    return len(numbers) >= _FEWEST_AMOUNTS and max(numbers) >= _FAR * len(numbers)


def are_amounts(numbers: Collection[float]) -> bool:
    """Whether these count nothing and name no places: decimals, and numbers far apart."""
    return far_apart(numbers) or any(number % 1 for number in numbers)


def are_one(levels: Collection[float]) -> bool:
    """Whether levels are one, told with a unit and without: 250 and, in "ug/ml", 0.25."""
    times = max(levels) / min(levels) if min(levels) > 0 else 0.0
    return len({*levels}) == 1 or any(math.isclose(times, units) for units in _UNITS_APART)


_UNITS_APART = (1e3, 1e6, 1e9)
