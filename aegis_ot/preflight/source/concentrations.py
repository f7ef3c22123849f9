"""Reads concentrations and doses in names and labels.

Only the order of levels matters to the rules, so a number without a unit is good enough,
as long as it is a concentration and no running number: ``std_125`` is one, ``std_3`` is not
known to be.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence

from .lexicon import lexicon_of, tokens

_MOLAR = {"pm": -12, "nm": -9, "um": -6, "mm": -3, "m": 0}
_AMOUNTS = {"pg": -12, "ng": -9, "ug": -6, "mg": -3, "g": 0, "u": -3, "iu": -3}
_VOLUMES = {"ul": -6, "ml": -3, "l": 0}
_UNITS = {
    **{unit: 10.0**power for unit, power in _MOLAR.items()},
    **{
        f"{amount}/{volume}": 10.0 ** (power - below)
        for amount, power in _AMOUNTS.items()
        for volume, below in _VOLUMES.items()
    },
}
"""Molar units in M, mass units in g/l, activities in U/ml."""


class Concentration(float):
    """A level that has a unit, in the units above; plain numbers are on a scale of their own."""


def comparable(one: float, other: float) -> bool:
    """Whether two levels are on one scale: both with a unit, or both without; 0 is on any."""
    return isinstance(one, Concentration) is isinstance(other, Concentration) or not (one and other)


_WITH_UNIT = re.compile(
    r"(?<![A-Za-z.\d])(\d+(?:[.,p]\d+)?)[\s_]*"
    r"((?:pg|ng|ug|mg|i?u)\s*(?:/|per|_)\s*(?:ul|ml|l)|g/l|pm|nm|um|mm|m|%|x)(?![a-z])",
    re.IGNORECASE,
)
_GLUED = re.compile(r"(?<=[A-Za-z])(\d+(?:\.\d+)?)(?=[pnum]M\b)")
_LONG_NUMBER = re.compile(
    r"(?<![\d.])(?<!\d-)(?<!\b[a-z])((?!0\d)\d{2,}(?:\.\d+)?|\d+\.\d+|0)"
    r"(?![\d.]|-[a-z]|\s*(?:h|hrs?|hours?|mins?|minutes?|sec|s|d|days?)\b)"
)
"""Not of a catalogue number (RD5-18), a sample (S10), a substance (25-OH) or a time (24 h)."""
_WAVELENGTH = re.compile(r"\b[3-8]\d\d ?nm\b")
_RATIO = re.compile(r"\b1\s*(?::|/|to|in)\s*(\d+)\b", re.IGNORECASE)
_STRENGTH = re.compile(r"(?<![\w.])\d+(?:[.,]\d+)?\s?[x×](?!\w)", re.IGNORECASE)


def level_in(text: str, words: Mapping[str, float], plain_numbers: bool = True) -> float | None:
    """The one level that a name or label states: with a unit, in words (``{"blank": 0.0}``), or, if
    they count, as a plain number.
    """
    plain = _with_u(_WAVELENGTH.sub(" ", text)).lower()
    found = _WITH_UNIT.findall(plain)
    # "3 uM (100x)" is 3 uM, and "1 mM in 0.5 % DMSO" is 1 mM.
    found = [(value, unit) for value, unit in found if unit not in ("%", "x")] or found
    stated = {_concentration(value, unit) for value, unit in found}
    if stated:
        return stated.pop() if len(stated) == 1 else None
    ratios = {1.0 / float(value) for value in _RATIO.findall(plain) if float(value) > 0}
    said = {words[match.topic] for match in lexicon_of({w: (w,) for w in words}).find(text)}
    numbers = set(_LONG_NUMBER.findall(plain.replace("_", " "))) if plain_numbers else set()
    return next((float(one.pop()) for one in (ratios, said, numbers) if len(one) == 1), None)


def level_of(text: str, words: Mapping[str, float]) -> float | None:
    """The level that a text gives which is nothing else: a number however short, or as above."""
    try:
        number = float(text)
    except ValueError:
        return level_in(text, words)
    return number if 0 <= number < math.inf else None


def without_concentrations(text: str) -> str:
    """A text without its concentrations: "BSA standard" of "BSA standard 125 ug/mL"."""
    return _WITH_UNIT.sub(" ", _with_u(text))


def without_strength(text: str) -> str:
    """A text without the strength of a working solution: "inhibitor" of "inhibitor (6x)"."""
    return _STRENGTH.sub(" ", text)


def name_without_level(text: str, noise: Sequence[str]) -> tuple[str, ...]:
    """The words of a name that say neither how much nor what sort of thing it is.

    Two liquids whose names differ in these are different compounds; those whose names do not
    differ are doses of one. Words of ``noise`` tell no compound from another: "stock", "blank".
    """
    plain = without_concentrations(text)
    words = tokens(plain)
    found = lexicon_of({"noise": tuple(noise)}).find(plain)
    covered = {at for match in found for at in range(match.start, match.end)}
    return tuple(
        word
        for at, word in enumerate(words)
        if at not in covered and not word.replace(".", "").isdigit()
    )


def _concentration(value: str, unit: str) -> Concentration:
    short = re.sub(r"\s", "", unit.lower()).replace("per", "/").replace("_", "/")
    return Concentration(float(value.replace(",", ".").replace("p", ".")) * _UNITS.get(short, 1.0))


def _with_u(text: str) -> str:
    """A text with "u" for the micro sign and the Greek letter, and ``R10nM`` as "R 10nM"."""
    return _GLUED.sub(r" \1", text.replace("µ", "u").replace("μ", "u"))
