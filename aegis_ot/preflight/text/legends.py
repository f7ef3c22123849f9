"""Legends: short codes and what they stand for.

"V: vehicle, U: untreated, d1..d8: alpelisib" in a comment or docstring, ``{"V": "vehicle"}`` in
a dict.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterable, Mapping
from typing import Any

from ...instrumentation import is_spot
from .comments import comment_blocks
from .facts import SourceFacts

_CODE = r"[A-Za-z+*.#-]|[A-Za-z+-][A-Za-z0-9+-]{0,3}"
_MEANS = r"\s*(?:=>|->|→|[:=])\s*|\s+[-–]\s+"
_ENTRY = re.compile(
    rf"(?:(?<=[\s,;(|/])|^)['\"]?(?P<code>{_CODE})['\"]?"
    rf"(?:\s*(?:\.\.+|…|-|–|to)\s*['\"]?(?P<last>{_CODE})['\"]?)?"
    rf"(?:{_MEANS})(?P<said>[^\W_][^,;|\n=:]{{1,59}}?)"
    rf"(?=\s*(?:[,;|\n]|$)|\s+['\"]?(?:{_CODE})['\"]?(?:{_MEANS}))",
    re.MULTILINE,
)
_COLUMN = re.compile(
    rf"^\s*(?P<code>{_CODE})(?:\s*(?:\.\.+|…|-|–|to)\s*(?P<last>{_CODE}))?\s{{2,}}"
    r"(?P<said>\S(?:[^\s=:|]| (?! )){1,60})$",
    re.MULTILINE,
)
"""Codes in a column of their own, what they stand for in the next: "S1 .. S4   extracts"."""
_SPACED = re.compile(r"(?P<codes>[A-Z]{1,2}(?:/[A-Z]{1,2})*)\s+(?P<said>\S.{1,60})")
"""Codes beside each other in one line: "U untreated   V DMSO   L/M/H 0.1, 1, 10 uM"."""
_LETTERS = " %/" + string.ascii_letters + "µμ"
_FEWEST = 2
"""A single "x = y" in prose may be anything."""
_LONGEST_CODE = 4


def legend_of(facts: SourceFacts, fewest: int = _FEWEST) -> dict[str, str]:
    """What each code stands for; codes that are explained in two ways are left out.

    Args:
        facts: What the text says.
        fewest: So many codes beside each other are a legend.
    """
    found: dict[str, set[str]] = {}
    for codes in (*_written(facts, fewest), *_in_dicts(facts.constants)):
        for code, said in codes.items():
            found.setdefault(code, set()).add(said)
    return {code: next(iter(said)) for code, said in found.items() if len(said) == 1}


def _written(facts: SourceFacts, fewest: int) -> Iterable[dict[str, str]]:
    texts = [text for _, text in facts.docstrings]
    texts += [text for _, text in comment_blocks(facts)]
    for text in texts:
        codes: dict[str, str] = {}
        for match in _ENTRY.finditer(text):
            for code in _run_of(match["code"], match["last"]):
                codes.setdefault(code, match["said"].strip())
        for match in _COLUMN.finditer(text):
            for code in _run_of(match["code"], match["last"]) if match["last"] else [match["code"]]:
                codes.setdefault(code, match["said"].strip())
        for line in text.splitlines():
            for code, said in _side_by_side(line):
                codes.setdefault(code, said)
        if len(codes) >= fewest:
            yield codes


def _side_by_side(line: str) -> Iterable[tuple[str, str]]:
    """The entries of a line of codes that stand apart; a list of as many goes to one each.

    "1..4 remdesivir" may stand among them: a number is too little for a code.
    """
    parts = [part for part in re.split(r"\s{3,}", line.strip()) if not part[:1].isdigit()]
    entries = [_SPACED.fullmatch(part) for part in parts]
    if len(entries) < _FEWEST or not all(entries):
        return
    for entry in filter(None, entries):
        codes = entry["codes"].split("/")
        unit = entry["said"][len(entry["said"].rstrip(_LETTERS)) :]
        listed = [part.strip() + unit for part in entry["said"].removesuffix(unit).split(",")]
        for at, code in enumerate(codes):
            yield code, listed[at] if len(listed) == len(codes) > 1 else entry["said"]


def _run_of(first: str, last: str | None) -> list[str]:
    """``d1`` to ``d8``, or the one code; names of wells are none."""
    if is_spot(first):
        return []
    one, other = re.fullmatch(r"(\D+)(\d+)", first), re.fullmatch(r"(\D+)(\d+)", last or "")
    if last is None or one is None or other is None or one[1] != other[1]:
        return [first]
    return [f"{one[1]}{number}" for number in range(int(one[2]), int(other[2]) + 1)]


def _in_dicts(constants: Mapping[str, Any]) -> Iterable[dict[str, str]]:
    for name, value in constants.items():
        if isinstance(value, dict) and len(value) >= _FEWEST and name != "metadata":
            texts = all(isinstance(item, str) for pair in value.items() for item in pair)
            if texts and all(len(key) <= _LONGEST_CODE for key in value):
                spots = any(is_spot(item) for pair in value.items() for item in pair)
                if not spots:
                    yield dict(value)
