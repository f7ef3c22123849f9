"""What a list says once for all its entries: "A1 = 0.1, A2 = 0.4, A3 = 0.8 mg/ml BSA"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ..text import amounts_in, tokens, with_u
from .clauses import Part

_NUMBER = re.compile(r"(?<![\w.])\d+(?:[.,]\d+)?(?![\w.])")


def with_shared_words(
    parts: Sequence[Part], above: Amount | None = None
) -> tuple[list[Part], Amount | None]:
    """The parts of a line, those that are no more than a number with the words of the one that
    has a unit, and those with the same word and a number with its unit.

    Args:
        parts: The parts that name wells.
        above: The amount with a unit that the lines above gave; returned for the lines below.
    """
    whole = [Amount(part.words) for part in parts if len([*amounts_in(part.words)]) == 1]
    alike = len({(amount.before, amount.unit, amount.after) for amount in whole}) == 1
    model = whole[0] if alike else above
    if whole and not alike:
        return list(parts), None
    return [_like(model, part) if model else part for part in parts], model


def unit_in_brackets(heading: str) -> str:
    """The unit of all that stands under a heading: "BSA ampoules (ug/mL):"; or ``""``."""
    for inside in _IN_BRACKETS.findall(heading):
        inner = inside.strip().removeprefix("in ").strip()
        found = [match for match, _ in amounts_in(f"1 {inner}")]
        if len(found) == 1 and len(found[0].group()) == len(f"1 {inner}"):
            return str(inner)
    return ""


def with_unit(parts: Sequence[Part], unit: str) -> list[Part]:
    """The parts of a line, with the unit of the heading after the one number that each ends in."""
    return [_measured(part, unit) if unit else part for part in parts]


def _measured(part: Part, unit: str) -> Part:
    number = _only_number(part)
    if number is None:
        return part
    before = tokens(part.words[: number.start()])[-1:]
    if before and len(before[0]) > 1 and re.fullmatch(r"1?\d", number.group()):
        return part  # "compound 7"
    end = number.end()
    rest = part.words[end:]
    if _IN_BRACKETS.sub("", rest).strip():
        return part
    return part._replace(words=f"{part.words[:end]} {unit}{rest}")


def _only_number(part: Part) -> re.Match[str] | None:
    """The one number of a part that says no amount with a unit."""
    numbers = list(_NUMBER.finditer(part.words))
    return None if len(numbers) != 1 or any(amounts_in(part.words)) else numbers[0]


_IN_BRACKETS = re.compile(r"\(([^()]*)\)")


class Amount:
    """An amount with its unit, and the words before and after it."""

    def __init__(self, text: str) -> None:
        text = with_u(text)
        match, _ = next(amounts_in(text))
        self.before = tokens(text[: match.start()])
        self.unit = match[2]
        self.after = tokens(text[match.end() :])


def _like(model: Amount, part: Part) -> Part:
    """A part that says a number only, as the model says its own; no more than a nought has no
    unit: "PBS (0)".
    """
    number = _only_number(part)
    if number is None:
        return part
    before, after = tokens(part.words[: number.start()]), tokens(part.words[number.end() :])
    if not before + after or (before == model.before and not after):
        words = (*model.before, number.group(), model.unit, *model.after)
    elif float(number.group().replace(",", ".")) == 0 and not after:
        words = (*before, number.group(), model.unit)
    else:
        return part
    return part._replace(words=" ".join(words))
