"""Reads concentrations and doses in names and other texts.

Only the order of levels matters to the rules, so a number without a unit is good enough,
as long as it is a concentration and no running number: ``std_125`` is one, ``std_3`` is not
known to be.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..rules import Common
from .words import Lexicon, lexicon_of, tokens

_NUMBER = r"(?<![\w.])(\d+(?:[.,]\d+)?(?:[eE]-?\d+)?)"

_UNITS: dict[str, float] = {
    "pm": 1e-12,
    "nm": 1e-9,
    "um": 1e-6,
    "mm": 1e-3,
    "m": 1.0,
    "pg/ul": 1e-6,
    "ng/ul": 1e-3,
    "ug/ul": 1.0,
    "mg/ul": 1e3,
    "pg/l": 1e-12,
    "ng/l": 1e-9,
    "ug/l": 1e-6,
    "pg/ml": 1e-9,
    "ng/ml": 1e-6,
    "ug/ml": 1e-3,
    "mg/ml": 1.0,
    "u/ul": 1e3,
    "u/ml": 1.0,
    "u/l": 1e-3,
    "iu/ul": 1e3,
    "iu/ml": 1.0,
    "iu/l": 1e-3,
    "g/l": 1.0,
    "mg/l": 1e-3,
    "%": 1.0,
    "x": 1.0,
}


class Concentration(float):
    """A level that has a unit, in the units above; plain numbers are on a scale of their own."""


class Rank(float):
    """A place in a rising or falling list, counted from 0: it says how much of nothing."""


def comparable(one: float, other: float) -> bool:
    """Whether two levels are on one scale: both with a unit, or both without, or both in a list;
    0 is on any but a list's.
    """
    mine, theirs = _scale(one), _scale(other)
    return mine is theirs or (Rank not in (mine, theirs) and not (one and other))


def _scale(level: float) -> type[float]:
    return next((kind for kind in (Rank, Concentration) if isinstance(level, kind)), float)


_WITH_UNIT = re.compile(
    r"(?<![A-Za-z.\d])(\d+(?:[.,p]\d+)?)[\s_]*"
    r"((?:pg|ng|ug|mg|i?u)\s*(?:/|per|_)\s*(?:ul|ml|l)|g/l|pm|nm|um|mm|m|%|x)(?![a-z])",
    re.IGNORECASE,
)

_STRENGTH = re.compile(r"(?<![\w.])\d+(?:[.,]\d+)?\s?[x×](?!\w)", re.IGNORECASE)

_GLUED = re.compile(r"(?<=[A-Za-z])(\d+(?:\.\d+)?)(?=[pnum]M\b)")

_LONG_NUMBER = re.compile(r"(?<![\d.])((?!0\d)\d{2,}(?:\.\d+)?|\d+\.\d+|0)(?![\d.])")

_RATIO = re.compile(r"\b1\s*(?::|/|to|in)\s*(\d+)\b", re.IGNORECASE)


_POWER = re.compile(r"(?<![\w.])(?:10\s?\^\s?\(?|10\*\*|1e)-\s?0?(\d)(?!\d)", re.IGNORECASE)
"""A ten-fold series is told by powers of ten: "10^-3"."""
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_RAISED = re.compile("10([⁻][⁰¹²³⁴⁵⁶⁷⁸⁹]+)")


def level_in(text: str, common: Common, plain_numbers: bool = True) -> float | None:
    """The one level that a text states: with a unit, in words, or as a plain number.

    Plain numbers count in names and liquids only: in a comment they may be anything.
    """
    plain = with_u(text).lower()
    found = _WITH_UNIT.findall(plain)
    # "3 uM (100x)" is 3 uM, and "1 mM in 0.5 % DMSO" is 1 mM.
    found = [(v, unit) for v, unit in found if unit not in ("%", "x")] or found
    with_unit = {_with_unit(value, unit) for value, unit in found}
    if len(with_unit) == 1:
        return with_unit.pop()
    if with_unit:
        return None
    ratios = {1.0 / float(value) for value in _RATIO.findall(plain) if float(value) > 0}
    ratios |= {10.0 ** -int(value) for value in _POWER.findall(_lowered(plain))}
    if len(ratios) == 1:
        return ratios.pop()
    words = {common.levels[match.topic] for match in _level_words(common).find(text)}
    if len(words) == 1:
        return words.pop()
    if not plain_numbers:
        return None
    numbers = set(_LONG_NUMBER.findall(plain.replace("_", " ")))
    if len(numbers) == 1:
        return float(numbers.pop())
    return None


def concentration_in(text: str) -> float | None:
    """The one concentration with a unit that a text states; per cent and "10x" are none."""
    found = concentrations_in(text)
    return found.pop() if len(found) == 1 else None


def concentrations_in(text: str) -> set[float]:
    """All concentrations with a unit that a text states; per cent and "10x" are none."""
    plain = with_u(text).lower()
    return {
        _with_unit(value, unit)
        for value, unit in _WITH_UNIT.findall(plain)
        if unit not in ("%", "x")
    }


def without_strength(text: str) -> str:
    """A text without the strength of a working solution: "inhibitor" of "inhibitor (6x)"."""
    return _STRENGTH.sub(" ", text)


def name_without_level(text: str, common: Common) -> tuple[str, ...]:
    """The words of a name that say neither how much nor what sort of thing it is.

    Two liquids whose names differ in these are different compounds; those whose names do not
    differ are doses of one.
    """
    plain = _WITH_UNIT.sub(" ", with_u(text))
    lexicon = lexicon_of({"noise": (*common.noise, *common.levels)})
    words = tokens(plain)
    covered = {at for match in lexicon.find(plain) for at in range(match.start, match.end)}
    return tuple(
        word
        for at, word in enumerate(words)
        if at not in covered and not word.replace(".", "").isdigit()
    )


def numbers_in_order(text: str) -> list[float]:
    """All plain numbers of a text, in order, well names and units apart."""
    cleaned = re.sub(r"\b[A-P]\d{1,2}\b", " ", text)
    return [float(value.replace(",", "")) for value in re.findall(_NUMBER, cleaned)]


def direction_in(text: str, common: Common) -> int:
    """1 where a text says that levels rise, -1 where they fall, 0 where it says neither."""
    topics = {match.topic for match in _direction_words(common).find(text)}
    if topics == {"rising"}:
        return 1
    if topics == {"falling"}:
        return -1
    return 0 if topics else _direction_of_range(text)


def listed_levels(text: str) -> tuple[float, ...]:
    """The levels of the one list that a text holds, with a unit: "10, 3 and 1 uM".

    The unit may stand before them: "BSA (mg/ml): 0, 0.1, 0.2".
    """
    lists = [amounts for amounts in _joined(text, _BETWEEN) if len(amounts) > 1]
    lists = lists or [amounts for amounts in _joined(text, _SPACES) if len(amounts) > 2]
    if len(lists) != 1:
        return ()
    ahead = {unit.lower() for unit in _UNIT_AHEAD.findall(_plain(text))}
    if len(ahead) == 1 and not any(unit for _, unit in lists[0]):
        lists[0][-1] = (lists[0][-1][0], ahead.pop())
    return _in_units(lists[0])


def unit_in(text: str) -> str:
    """The unit of concentration that stands apart from numbers in a text, ``""`` without one."""
    found = {match[1].lower() for match in _UNIT_APART.finditer(_plain(text))}
    return found.pop() if len(found) == 1 else ""


def _direction_of_range(text: str) -> int:
    """As :func:`direction_in`, of the one range that a text holds: "10 uM down to 0.1 uM"."""
    ranges = [_in_units(amounts) for amounts in _joined(text, _TO) if len(amounts) == 2]
    first, last = ranges[0] if len(ranges) == 1 and ranges[0] else (0, 0)
    return (last > first) - (last < first)


UNITS = r"(?:pg|ng|ug|mg|i?u)/(?:ul|ml|l)|g/l|pm|nm|um"
"""Units of concentration that stand for nothing else, as a pattern."""
_AMOUNT = re.compile(rf"(?<![\w.])(\d+(?:\.\d+)?)\s?({UNITS}|mm|m)?(?![\w.]*\w)", re.IGNORECASE)
_UNIT_APART = re.compile(rf"(?<![\w/])(?<!\d\s)({UNITS})(?![\w/])", re.IGNORECASE)
_UNIT_AHEAD = re.compile(rf"(?<![\d.\s])\s*[(\[ ]({UNITS})[)\]]?\s*:", re.IGNORECASE)
_BETWEEN = re.compile(r"\s*(?:[,;/&+]|\band\b|,\s*and\b)\s*")
_SPACES = re.compile(r"\s+")
_TO = re.compile(r"\s*(?:down|up) to\b\s*")
"""A plain "0.1-10 uM" says which doses there are, and not in which order they stand; an arrow may
be a stock's dilution."""


def _joined(text: str, joint: re.Pattern[str]) -> list[list[tuple[float, str]]]:
    """Runs of amounts, each with its unit, that nothing but this joint stands between."""
    plain = _plain(text)
    runs: list[list[tuple[float, str]]] = []
    end = -1
    for match in _AMOUNT.finditer(plain):
        amount = (_number(match[1]), (match[2] or "").lower())
        if end >= 0 and joint.fullmatch(plain, end, match.start()):
            runs[-1].append(amount)
        else:
            runs.append([amount])
        end = match.end()
    return runs


def amounts_in(text: str) -> Iterator[tuple[re.Match[str], float]]:
    """Each concentration with a unit, where it stands in a text as :func:`with_u` writes that."""
    for match in _AMOUNT.finditer(_plain(text)):
        if match[2]:
            yield match, Concentration(_number(match[1]) * _UNITS[match[2].lower()])


def _in_units(amounts: Sequence[tuple[float, str]]) -> tuple[float, ...]:
    """The levels of some amounts, of which the last one's unit holds for those without any."""
    last = amounts[-1][1]
    return tuple(Concentration(n * _UNITS[unit or last]) for n, unit in amounts) if last else ()


def _level_words(common: Common) -> Lexicon:
    return lexicon_of({word: (word,) for word in common.levels})


def _direction_words(common: Common) -> Lexicon:
    return lexicon_of({"rising": common.rising, "falling": common.falling})


def _with_unit(value: str, unit: str) -> Concentration:
    return Concentration(_number(value) * _UNITS.get(_unit(unit), 1.0))


def _unit(unit: str) -> str:
    return re.sub(r"\s|per|_", lambda m: "/" if m.group() in ("per", "_") else "", unit.lower())


def _number(text: str) -> float:
    return float(text.replace(",", ".").replace("p", "."))


def _lowered(text: str) -> str:
    """A text with "10^-3" for "10⁻³"."""
    return _RAISED.sub(lambda match: "10^" + match[1].translate(_SUPERSCRIPTS), text)


_PREFIXES = {"pico": "p", "nano": "n", "micro": "u", "mikro": "u", "milli": "m"}
_SHORT_UNITS = {
    prefix + unit: _PREFIXES[prefix] + short
    for prefix in _PREFIXES
    for short, units in {
        "g": ("gram", "grams", "gramm", "gramme", "grammes"),
        "l": ("liter", "liters", "litre", "litres"),
        "M": ("molar",),
    }.items()
    for unit in units
}
_SPELLED = re.compile(
    rf"\b(?:{'|'.join(sorted(_SHORT_UNITS, key=len, reverse=True))})\b", re.IGNORECASE
)


def with_u(text: str) -> str:
    """A text with "u" for the micro sign and the Greek letter, and ``R10nM`` as "R 10nM"; units
    that are spelled out are written short: "micrograms per mL" is "ug per mL".
    """
    short = _SPELLED.sub(lambda match: _SHORT_UNITS[match[0].lower()], text)
    return _GLUED.sub(r" \1", short.replace("µ", "u").replace("μ", "u"))


_DECIMAL_COMMA = re.compile(r"(?<![\d.,])(\d+),(\d+)(?![\d,])")


def _plain(text: str) -> str:
    """A text as :func:`with_u` writes it, and decimal points where "0,2" is one number.

    One such number tells that a comma is no separator in the others: "0,5 / 1,0 mg/ml".
    """
    plain = with_u(text)
    if any(match[1] == "0" for match in _DECIMAL_COMMA.finditer(plain)):
        plain = _DECIMAL_COMMA.sub(r"\1.\2", plain)
    return plain
