"""Leader dots: "A3 ....... stop reagent" says of A3 what "A3   stop reagent" says.

Dots between two places, "A1 ... A6", stand for what is left out, and stay.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from .facts import SourceFacts

_SPOT = r"(?:[A-P]?\d{1,2}|[A-P])(?!\w)"
_LINE = re.compile(
    rf"\W*(?:(?P<word>[^\W\d_]{{2,12}})\.?\s+)?{_SPOT}"
    rf"(?P<more>(?:\s*(?:[,/&+–-]|[^\W\d_]{{1,4}}\s)\s*{_SPOT}){{0,24}})\s*(?P<dots>\.{{3,}}|…+)\s*"
    r"(?P<next>\S[^\s,;:.)]*)(?P<after>\s?\S*)"
)
"""A line that begins with places and dots, up to the word behind them."""
_PLACE = re.compile(_SPOT)
_UNIT = re.compile(r"\s?(?:[pnuµμm]?(?:M|mol|[gl](?:/|\b))|%|pp[mb]\b)", re.IGNORECASE)
_PART = re.compile(r"[.:]\d")
_LEADING = re.compile(r"(?<=[^\W\d]|[)\]%\"'])\s?\.{5,}(?=\s)")
"""Dots from a thing to anything."""

_SURE = 5
"""So many dots lead the eye; three may say "and so on" behind a list."""


def read_leaders(facts: SourceFacts) -> None:
    """Put spaces in place of the leader dots in docstrings and comments."""
    facts.docstrings[:] = [
        (line, "\n".join(without_leaders(text.split("\n")))) for line, text in facts.docstrings
    ]
    said = without_leaders([*facts.comments.values()])
    facts.comments.update(zip(facts.comments, said, strict=True))


def without_leaders(lines: Sequence[str]) -> list[str]:
    """Lines with as many spaces in place of the dots that lead from a place to what is there.

    Three dots behind a list, "A1, A2 ... buffer", do so only beside lines that leave no doubt.
    """
    found = [
        _LINE.match(written) if ".." in written or "…" in written else None for written in lines
    ]
    plain = [match is not None and _leads(match) for match in found]
    several = any(plain)
    spaced = []
    for written, match, leads in zip(lines, found, plain, strict=True):
        if match and (leads or (several and _may_lead(match))):
            start, end = match.span("dots")
            written = f"{written[:start]}{' ' * (end - start)}{written[end:]}"
        spaced.append(_LEADING.sub(lambda dots: " " * len(dots[0]), written))
    return spaced


def _leads(match: re.Match[str]) -> bool:
    """Whether dots are leaders without a doubt: many, or behind a single place."""
    return _may_lead(match) and (len(match["dots"]) >= _SURE or not match["more"])


def _may_lead(match: re.Match[str]) -> bool:
    """Whether what follows some dots is no further place: "column 1 ... column 12", "1 ... 12"."""
    said, after = match["next"], match["after"]
    if _PLACE.match(said):
        part, unit = _PART.match(after), _UNIT.match(after)
        sure = len(match["dots"]) >= _SURE
        return _PLACE.fullmatch(said) is not None and bool(part or (unit and sure))
    return said.lower().rstrip("s") != (match["word"] or "").lower().rstrip("s")
