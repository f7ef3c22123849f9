"""Spells out what a layout leaves unsaid: "columns 3-10 drug, 11 vehicle, 12 untreated"."""

from __future__ import annotations

import re

from .well_names import COLUMN, COLUMNS, ROW, ROWS, TO, WELL_SPEC

_NEXT = re.compile(
    r"[^,;]*[,;]\s*(?:and\s+|und\s+|et\s+|y\s+)?(?P<of>(?P<low>\d{1,2}|[A-P])"
    rf"(?:{TO}(?P<high>\d{{1,2}}|[A-P]))?)(?=\s*[:=]?\s+[^\W\d_]{{3,}})"
)
_ENDS = re.compile(r"(\d+|[A-P])$")


_NUMBERED = re.compile(
    rf"(?:^|[:,;(])\s*(?P<of>(?P<low>\d{{1,2}})(?:{TO}(?P<high>\d{{1,2}}))?)"
    r"(?=\s*[:=]?\s+[^\W\d_]{3,})"
)
_FEWEST_NUMBERED = 3


def spelled_out(text: str) -> str:
    """The text with "column" or "row" before each number or letter that goes on where the last
    one ended.

    Only there: in "columns 1-3 standards, 8 samples" the eight are samples.
    """
    text = _numbered(text)
    at = 0
    while match := WELL_SPEC.search(text, at):
        at = match.end()
        kind = "column" if match["column"] or match["columns"] else "row"
        listed = match["column"] or match["columns"] or match["row"] or match["rows"]
        if not listed:
            continue
        ends = _ENDS.search(listed)
        follower = _NEXT.match(text, at)
        if ends and follower and _follows(ends[1], follower["low"]):
            start = follower.start("of")
            text = f"{text[:start]}{kind} {text[start:]}"
    return _crossed(text)


_OF_COLUMN = re.compile(rf"[^:]{{0,40}}?\b(?i:{COLUMN})\.?\s*\(?(\d{{1,2}})\b[^:\d]{{0,20}}:")
_OF_ROW = re.compile(rf"[^:]{{0,40}}?\b(?i:{ROW})\s*\(?([A-P])\b[^:\d]{{0,20}}:")
_ROW_WORD = rf"(?i:{ROWS}|{ROW})\s+"
_COLUMN_WORD = rf"(?i:{COLUMNS}|{COLUMN})\.?\s*"
_ROWS = re.compile(rf"\b{_ROW_WORD}([A-P])(?:{TO}([A-P]))?\b")
_COLUMNS = re.compile(rf"\b{_COLUMN_WORD}(\d{{1,2}})(?:{TO}(\d{{1,2}}))?\b")
_LETTERS = rf"(?P<row>[A-P])(?![A-Za-z0-9])(?:{TO}(?P<row2>[A-P])(?![A-Za-z0-9]))?"
_SPAN = rf"\d{{1,2}}(?:{TO}\d{{1,2}})?"
_NUMBERS = rf"(?P<columns>{_SPAN}(?:\s*(?:,|/|&|and|und|et|y)\s*{_SPAN})*)"
_BETWEEN = r"\s*(?:[,/x×;]|and|of|in|und|von|de)?\s*(?:the\s+)?"
_BOTH = (
    re.compile(rf"\b{_ROW_WORD}{_LETTERS}{_BETWEEN}{_COLUMN_WORD}{_NUMBERS}\b"),
    re.compile(rf"\b{_COLUMN_WORD}{_NUMBERS}{_BETWEEN}{_ROW_WORD}{_LETTERS}"),
)


def _met(match: re.Match[str]) -> str:
    """The wells where rows and columns meet: "row B, col 1-6" is B1-B6."""
    first, last = match["row"], match["row2"] or match["row"]
    spans = re.findall(rf"(\d+)(?:{TO}(\d+))?", match["columns"])
    return " and ".join(f"{first}{low}-{last}{high or low}" for low, high in spans)


def _crossed(text: str) -> str:
    """Rows and columns that stand together, or one under the other: "column 6: rows A-D ..."."""
    for both in _BOTH:
        text = both.sub(_met, text)
    if head := _OF_COLUMN.match(text):
        rest, number = text[head.end() :], head[1]
        wells, found = _ROWS.subn(lambda m: f"{m[1]}{number}-{m[2] or m[1]}{number}", rest)
    elif head := _OF_ROW.match(text):
        rest, letter = text[head.end() :], head[1]
        wells, found = _COLUMNS.subn(lambda m: f"{letter}{m[1]}-{letter}{m[2] or m[1]}", rest)
    else:
        return text
    return wells if found else text


def _numbered(text: str) -> str:
    """Bare numbers that count on from 1 are columns: "1-3 samples, 4 standard, 5 blank"."""
    found: list[re.Match[str]] = []
    for match in _NUMBERED.finditer(text):
        last = (found[-1]["high"] or found[-1]["low"]) if found else "0"
        if not _follows(last, match["low"]):
            return text
        found.append(match)
    if len(found) < _FEWEST_NUMBERED or WELL_SPEC.search(text):
        return text
    for match in reversed(found):
        text = f"{text[: match.start('of')]}column {text[match.start('of') :]}"
    return text


def _follows(last: str, low: str) -> bool:
    """Whether a column's number or a row's letter is the one after the last."""
    if last.isdigit() != low.isdigit():
        return False
    return int(low) == int(last) + 1 if low.isdigit() else ord(low) == ord(last) + 1
