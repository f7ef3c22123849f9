"""Columns, rows and troughs that a text counts: "the third and fourth column", "first row"."""

from __future__ import annotations

import functools
import re
from collections.abc import Collection, Mapping

from ..rules import Common
from ..text import UNITS, any_of, tokens, words_of
from .well_names import WellNames, well_names

_MOST_FURTHER = 12
_VERSION = re.compile(r"\bv\.?\s?\d")
"""A line of a list of changes."""

_LONGEST = 1000
"""A longer line is no sentence."""

_AMOUNT = rf"\d[\d.,]*\s?(?i:{UNITS}|mm|[µμ]m|%)"
"""A number that is none of a column: "the second column 100 nM"."""


def with_numbers(text: str, common: Common) -> str:
    """A sentence with numbers for such words, "columns 3 and 4", and for those that go on with
    them: "the second column 100 nM, the third with 10 nM".

    Not one that speaks of tips, or of what is on paper: "the second column of the sample sheet".
    """
    words = tokens(text)
    if not words_of(common.on_paper).isdisjoint(words) or len(text) > _LONGEST:
        return text
    if _is_of_tips(words, common) or _VERSION.search(text):
        return text
    names = well_names(common)
    troughs = set(common.layout.get("trough", ()))
    # The "first well" may be one of a plate.
    channels = tuple(sorted(troughs.difference(common.places, common.positions)))
    ordinals = tuple(common.ordinal_numbers.items())
    cardinals = tuple(common.cardinal_numbers.items())
    return _made(ordinals, cardinals, channels, tuple(common.articles), names).with_numbers(text)


def _is_of_tips(words: tuple[str, ...], common: Common) -> bool:
    """Whether columns are those of tips: "tip box: first column ...", "column of the tips"."""
    tips, articles = words_of(common.tips), words_of((*common.articles, *common.belonging))
    return any(
        word in tips and (at == 0 or words[at - 1] in articles) for at, word in enumerate(words)
    )


class _Ordinals:
    """The patterns for such words.

    Args:
        ordinals: What "first" is.
        cardinals: What "two" is.
        channels: What people call a trough of a reservoir.
        articles: "The" and the like.
        names: For columns and rows.
    """

    def __init__(
        self,
        ordinals: Mapping[str, float],
        cardinals: Mapping[str, float],
        channels: Collection[str],
        articles: Collection[str],
        names: WellNames,
    ) -> None:
        self._ordinals, self._cardinals = ordinals, cardinals
        article, ordinal = rf"(?i:{any_of(articles)})\s+", rf"\b(?i:{any_of(ordinals)})\b"
        kind = (
            rf"(?:(?P<column>{names.any_column})|(?P<row>{names.any_row})"
            rf"|(?i:{any_of(channels)}))\b(?!-|\s*(?!{_AMOUNT})\d)"
        )
        joint = rf"(?:{names.to}|{names.conjunction})"
        self._ordinal = re.compile(ordinal)
        self._said = re.compile(
            rf"(?:{article})?(?P<all>{ordinal}(?:{joint}(?:{article})?{ordinal}){{0,12}})\s+(?P<kind>{kind})"
        )
        self._first = re.compile(
            rf"(?:{article})?(?P<one>{ordinal})\s+(?P<count>(?i:{any_of(cardinals)}))\s+(?P<kind>{kind})"
        )
        self._article = re.compile(article)
        column, row = names.any_column, names.any_row
        self._further = re.compile(
            rf"(?P<begun>\b(?:(?P<column>{column})|(?P<row>{row}))\s(?:\d{{1,2}}|[A-P])\b(?:[^.;:\n]|(?<=\d)\.(?=\d)){{0,120}}?)"
            rf"{article}(?P<all>{ordinal})(?=\s+(?:[a-z]{{2,4}}\b|{_AMOUNT}))"
        )
        self._names = names

    def with_numbers(self, text: str) -> str:
        """See :func:`with_numbers`."""
        if self._ordinal.search(text) is None:
            return text
        text = self._said.sub(self._counted, self._first.sub(self._first_ones, text))
        for _ in range(_MOST_FURTHER):
            text, found = self._further.subn(self._gone_on, text)
            if not found:
                break
        return text

    def _counted(self, match: re.Match[str]) -> str:
        several = self._article.sub("", match["all"])
        return self._put(match, self._ordinal.sub(lambda m: self._number(m[0], match), several))

    def _first_ones(self, match: re.Match[str]) -> str:
        """The columns of "the first two columns"; "the second two columns" may be any."""
        if self._ordinals[match["one"].lower()] != 1:
            return match[0]
        first, last = (
            self._place(at, match) for at in (1, self._cardinals[match["count"].lower()])
        )
        return self._put(match, f"{first}-{last}")

    def _gone_on(self, match: re.Match[str]) -> str:
        kind = self._names.first_word_of["row" if match["row"] else "column"]
        return f"{match['begun']}{kind} {self._number(match['all'], match)}"

    def _put(self, match: re.Match[str], numbers: str) -> str:
        """Several have the plural, whatever is written: "third and fourth column"."""
        kind = match["kind"]
        if match["column"] and len(numbers) > 2:
            kind = self._names.plural_columns
        elif match["row"] and len(numbers) > 1:
            kind = self._names.plural_rows
        # A sentence still begins with a capital: "The first column ... The second one".
        return f"{kind.capitalize() if match[0][0].isupper() else kind} {numbers}"

    def _number(self, said: str, match: re.Match[str]) -> str:
        return self._place(self._ordinals[said.lower()], match)

    @staticmethod
    def _place(number: float, match: re.Match[str]) -> str:
        return chr(ord("A") + int(number) - 1) if match["row"] else str(int(number))


@functools.lru_cache(maxsize=8)
def _made(
    ordinals: tuple[tuple[str, float], ...],
    cardinals: tuple[tuple[str, float], ...],
    channels: tuple[str, ...],
    articles: tuple[str, ...],
    names: WellNames,
) -> _Ordinals:
    return _Ordinals(dict(ordinals), dict(cardinals), channels, articles, names)
