"""Spells out what a layout leaves unsaid: "columns 3-10 drug, 11 vehicle, 12 untreated"."""

from __future__ import annotations

import re

from .well_names import WELL_SPEC

_NEXT = re.compile(
    r"[^,;]*[,;]\s*(?:and\s+|und\s+|et\s+|y\s+)?(?P<of>(?P<low>\d{1,2}|[A-P])"
    r"(?:\s*(?:-|–|to|bis)\s*(?P<high>\d{1,2}|[A-P]))?)(?=\s*[:=]?\s+[^\W\d_]{3,})"
)
_ENDS = re.compile(r"(\d+|[A-P])$")


def spelled_out(text: str) -> str:
    """The text with "column" or "row" before each number or letter that goes on where the last
    one ended.

    Only there: in "columns 1-3 standards, 8 samples" the eight are samples.
    """
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
    return text


def _follows(last: str, low: str) -> bool:
    """Whether a column's number or a row's letter is the one after the last."""
    if last.isdigit() != low.isdigit():
        return False
    return int(low) == int(last) + 1 if low.isdigit() else ord(low) == ord(last) + 1
