"""Spells out what a layout leaves unsaid: "columns 3-10 drug, 11 vehicle, 12 untreated"."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable
from itertools import pairwise

from ..rules import Common
from ..text import tokens
from .in_turn import in_turn
from .well_names import WellNames, well_names

_ENDS = re.compile(r"(\d+|[A-P])$")
_FEWEST_NUMBERED = 3
_TIMES = re.compile(r"(?:min|sec|hour|day|week|cycle|fold|time|rpm|deg|cells?\b)", re.IGNORECASE)
"""What follows a range of numbers that are no columns: "5-10 min"."""

_POINTING = re.compile(
    r"(?P<before>^\W*)(?P<first>[A-P]\d{1,2})\s*>\s*(?P<last>[A-P]\d{1,2})(?=\s{2,}[^\W\d_]{2,}|\s*:)"
)
"""Wells from one to another: "A1 > A5   standards"; what "A1 > A5 50 uL" says is a transfer."""


def spelled_out(text: str, common: Common) -> str:
    """The text with "column" or "row" before each number or letter that goes on where the last
    one ended.

    Only there: in "columns 1-3 standards, 8 samples" the eight are samples.
    """
    return _ellipses(well_names(common)).spelled_out(in_turn(text, common))


class Ellipses:
    """What may be left out of a layout, as patterns around well names."""

    def __init__(self, names: WellNames) -> None:
        self._names = names
        self._plural, self._plural_rows = names.plural_columns, names.plural_rows
        to, listing = names.to, names.conjunction
        column, row = names.any_column, names.any_row
        goes_on = (
            r"(?=\s*[:=]?\s+(?:[^\W\d_]{3,}|[^\W\d_]{2,}-\w|[A-Z]\s*(?:[,;|]|$))|\s*=\s*\S"
            r"|\s*[:=]?\s+\d+(?:[.,]\d+)?\s?(?:[pnuµμm]M\b|[pnuµμm]?g/))"  # "B 10 uM"
        )
        self._next = re.compile(
            rf"(?:[^,;|]*[,;|]){{1,3}}?(?:{listing})?\s*(?P<of>(?P<low>\d{{1,2}}|[A-P])"
            rf"(?:(?:{to}|/)(?P<high>\d{{1,2}}|[A-P]))?){goes_on}"
        )
        self._numbered = re.compile(
            rf"(?:^|[:,;(])\s*(?P<of>(?P<low>\d{{1,2}})(?:{to}(?P<high>\d{{1,2}}))?)"
            r"(?=\s*[:=]?\s+[^\W\d_]{3,})"
        )
        self._headed = re.compile(
            rf"\b({column}|{row})\s*:\s*(?=(?:1|A)(?![\w.])\W*\w[^\n]*[,;|]|\d{{1,2}}\s*=\s*[^\W\d])"
        )
        self._bracketed = re.compile(rf"\((?P<of>(?P<low>\d{{1,2}})(?:{to}(?P<high>\d{{1,2}}))?)\)")
        self._every_other = re.compile(
            rf"\b(?:(?P<odd>{names.odd})|{names.even})\s+(?P<columns>{names.columns})"
            rf"(?:\.?\s*(?P<low>\d{{1,2}}){to}(?P<high>\d{{1,2}})|(?!\.?\s*(?:\d|(?:{names.of})\b)))"
            rf"(?:\s*\((?P<listed>\d{{1,2}}(?:{listing}\d{{1,2}})+)\)|(?!\s*\())"
        )
        self._cell = re.compile(
            rf"\b{column}\.?\s*(?P<columns>\d{{1,2}})\s+(?P<row>[A-P])(?:{to}(?P<row2>[A-P]))?(?=\s*[=:](?!\w))"
        )
        # "row A to row H, columns 3-4": no "from column 1 to column 3", which may be a transfer
        self._ends_named = re.compile(
            rf"(?P<before>^\W*|[,;:(]\s*)(?:(?P<column>{column}\.?\s*(?=\d))|{row}\s+)"
            rf"(?P<low>\d{{1,2}}|[A-P])(?P<to>{to})(?:{column}\.?\s*(?=\d)|{row}\s+(?=[A-P]\b))"
            r"(?P<high>\d{1,2}|[A-P])(?!\w)"
        )
        self._strip = re.compile(rf"\b({names.strips})\s+(?=\d{{1,2}}\b)")
        span_of_list = rf"\d{{1,2}}(?:{to}\d{{1,2}})?"
        self._one_of_several = re.compile(
            rf"^(\W*){names.column}\.?(?=\s*{span_of_list}(?:{listing}{span_of_list})+"
            r"(?:\s{2,}[^\W\d]|\s*[:=]))"
        )
        numbered = rf"\(?(?P<columns>{span_of_list}(?:{listing}{span_of_list})*)(?!\w)"
        self._numbered_head = re.compile(rf"\b{column}\.?\s*{numbered}")
        self._down = re.compile(
            rf"(?P<lead>[:=(,;]|\.\.\.?|…|\b(?:{names.of}))\s*(?P<low>[A-P])(?:(?:{to}|\.\.\.?)(?P<high>[A-P])(?!\w)|(?![\w.]))"
            r"(?=\s*[:=]\s*\S|\s+[^\W\d_]{2,}|\s+\d+(?:[.,]\d+)?(?!\w)|\s*[,;)])"
        )
        self._short = re.compile(rf"(?<![\w.])c(\d{{1,2}})(?:{to}c?(\d{{1,2}}))?(?!\w)")
        self._row_head = re.compile(rf"\b{names.row}\s*\(?[A-P]\b[^:\d]{{0,20}}:")
        # "columns 3-4 lysates, rows A-D harvest 1, rows E-H harvest 2"
        several = rf",(?=\s*{row}\s[^;:\n]*,\s*{row}\s)"
        # "columns 1-2 standards, duplicate; row A = blank, rows B-H = 25, 50, ..."
        listed = rf"\s+[^:;.\d]{{2,40}};(?=\s*{row}\s[^;:\n]*,\s*{row}\s)"
        ended = rf"(?:[^:\d]{{0,20}}:|\s+[^:;,.\d]{{2,30}}{several}|{listed})"
        self._column_head = re.compile(rf"\b{column}\.?\s*{numbered}{ended}")
        self._of_column = re.compile(rf"[^:]{{0,40}}?\b{column}\.?\s*{numbered}{ended}")
        self._of_row = re.compile(rf"[^:]{{0,40}}?\b{names.row}\s*\(?([A-P])\b[^:\d]{{0,20}}:")
        self._rows = re.compile(
            rf"\b{row}\s+(?P<row>[A-P])(?:(?:{to}|[/&+])(?P<row2>[A-P]))?\b(?P<alone>(?=\s*(?:[,;.)]|$)))?"
        )
        self._columns = re.compile(rf"\b{column}\.?\s*(\d{{1,2}})(?:{to}(\d{{1,2}}))?\b")
        letter = r"[A-P](?![A-Za-z0-9])"
        letters = rf"(?P<row>{letter}(?:(?:{to}|{listing}){letter})*)(?P<row2>)"
        span = rf"\d{{1,2}}(?:{to}\d{{1,2}})?"
        numbers = rf"(?P<columns>{span}(?:{listing}{span})*)"
        between = rf"(?:{listing}|\s*(?:[x×;]|(?:{names.of})\b)?\s*)(?:the\s+)?"
        self._both = (
            re.compile(rf"\b{row}\s+{letters}{between}{column}\.?\s*{numbers}\b"),
            re.compile(rf"\b{column}\.?\s*{numbers}{between}{row}\s+{letters}"),
        )

    def spelled_out(self, text: str) -> str:
        """See :func:`spelled_out`."""
        text = self._strip.sub(lambda match: f"{match[1]} {self._plural} ", text)
        text = _POINTING.sub(_spanned, self._ends_named.sub(self._span_named, text))
        text = self._every_other.sub(self._others, text)
        if len(self._short.findall(text)) > 1:  # "c1 vehicle, c2-11 drug"
            text = self._short.sub(self._spelled, text)
        text = self._cell.sub(self._met, text)  # "c2 H = NTC"
        # "col 3, 11   vehicle"
        text = self._one_of_several.sub(lambda match: f"{match[1]}{self._plural}", text)
        text = self._headed.sub(r"\1 ", text)  # "cols: 1 = untreated, 2 = vehicle"
        text = self._down_columns(self._with_columns(text))
        at = 0
        while match := self._names.spec.search(text, at):
            at = match.end()
            kind = "column" if match["column"] or match["columns"] else "row"
            listed = match["column"] or match["columns"] or match["row"] or match["rows"]
            if not listed:
                continue
            ends = _ENDS.search(listed)
            follower = self._next.match(text, at)
            if ends and follower and self._goes_on(text, ends[1], follower):
                text = self._inserted(text, kind, follower.start("of"))
        return self._crossed(text)

    def _goes_on(self, text: str, last: str, follower: re.Match[str]) -> bool:
        """Whether a layout goes on there: with the next one, a later one and "=", or later ones."""
        low, after = follower["low"], text[follower.end("of") :].lstrip()
        passed = re.findall(r"[,;|]", text[follower.start() : follower.start("of")])
        barred = passed[-1:] == ["|"]  # "1 untreated | 2-11 drug, low to high | 12 vehicle"
        if len(passed) > 1 and not barred and after[:1] not in ("=", ":"):
            return False  # "columns 1-3: samples 1-3, one column each, 4 NTC wells follow"
        later = low.isdecimal() and last.isdecimal() and int(low) > int(last)
        placed = barred or after[:1] == "=" or bool(follower["high"] and not _TIMES.match(after))
        return _follows(last, low) or (later and placed)

    def _with_columns(self, text: str) -> str:
        """Bare numbers that count on from 1 are columns: "1-3 samples, 4 standard, 5 blank",
        "drug (1-6), vehicle (7)".
        """
        bracketed = _counting_on(self._bracketed.finditer(text))
        # "(1-6)", not "(1)": that numbers the steps of a text.
        if len(bracketed) < 2 or not any(match["high"] for match in bracketed):
            bracketed = []
        found = bracketed or _counting_on(self._numbered.finditer(text))
        fewest = 2 if bracketed else _FEWEST_NUMBERED
        if len(found) < fewest or self._names.spec.search(text):
            return text
        for match in reversed(found):
            text = self._inserted(text, "column", match.start("of"))
        return text

    def _down_columns(self, text: str) -> str:
        """Letters that count down one column are its wells: "column 6: A-D samples, E-H water"."""
        heads = list(self._numbered_head.finditer(text))
        ends = [*(head.start() for head in heads[1:]), len(text)]
        for head, end in reversed([*zip(heads, ends, strict=False)]):
            entries = [m for m in self._down.finditer(text, head.end(), end) if _is_entry(m)]
            if len(entries) < 2 or not _count_down(entries):
                continue
            between = text[head.end() : entries[0].start()].strip().removeprefix(":")
            if "." in between or ":" in between:
                continue  # "Column 1: tips. Tubes: A = vehicle"
            for entry in reversed(entries):
                wells = self._names.crossed(entry["low"], entry["high"] or "", head["columns"])
                text = f"{text[: entry.start('low')]}{wells}{text[entry.end() :]}"
        return text

    def _others(self, match: re.Match[str]) -> str:
        """The columns in "odd columns", where they are not listed behind it."""
        low, high = int(match["low"] or 1), int(match["high"] or 24)
        odd = 1 if match["odd"] else 0
        others = ",".join(str(at) for at in range(low, min(high, 24) + 1) if at % 2 == odd)
        return f"{match['columns']} {match['listed'] or others}"

    def _span_named(self, match: re.Match[str]) -> str:
        kind = self._plural if match["column"] else self._plural_rows
        if match["low"].isdecimal() != match["high"].isdecimal():
            return match[0]
        return f"{match['before']}{kind} {match['low']}-{match['high']}"

    def _spelled(self, match: re.Match[str]) -> str:
        last = f"-{match[2]}" if match[2] else ""
        return f"{self._plural} {match[1]}{last}"

    def _inserted(self, text: str, kind: str, at: int) -> str:
        return f"{text[:at]}{self._names.first_word_of[kind]} {text[at:]}"

    def _crossed(self, text: str) -> str:
        """Rows and columns that stand together, or one under the other: "column 6: rows A-D"."""
        for both in self._both:
            text = both.sub(self._met, text)
        heads = list(self._row_head.finditer(text)) or list(self._column_head.finditer(text))
        bounds = [0, *(head.start() for head in heads[1:]), len(text)]
        return "".join(self._under_its_head(text[one:other]) for one, other in pairwise(bounds))

    def _under_its_head(self, text: str) -> str:
        """The wells of one column or row that its rows or columns stand under."""
        if head := self._of_column.match(text):
            return self._of_columns(text, head)
        if head := self._of_row.match(text):
            rest, letter = text[head.end() :], head[1]
            wells, found = self._columns.subn(
                lambda m: f"{letter}{m[1]}-{letter}{m[2] or m[1]}", rest
            )
            return wells if found else text
        return text

    def _of_columns(self, text: str, head: re.Match[str]) -> str:
        """The same under columns: "column 6: rows A-D samples, rows E-H blank".

        "columns 1-3: standards, row G blank, row H water" names G1-G3 and H1-H3 besides the
        columns, "column 11: vehicle, rows B-G" only B11-G11.
        """
        rest, numbers = text[head.end() :], head["columns"]
        rows = list(self._rows.finditer(rest))
        if not rows:
            return text
        between = rest[: rows[0].start()]
        one_thing = between.rstrip().endswith((",", "("))
        if len(rows) == 1 and rows[0]["alone"] is not None and tokens(between) and one_thing:
            wells = self._names.crossed(rows[0]["row"], rows[0]["row2"] or "", numbers)
            return f"{wells}: {between.strip(' ,;')}{rest[rows[0].end() :]}"
        named = tokens(between) or head.group().endswith(";")
        kept = text[: head.end()] if named and len(rows) > 1 else ""
        return kept + self._rows.sub(
            lambda match: self._names.crossed(match["row"], match["row2"] or "", numbers), rest
        )

    def _met(self, match: re.Match[str]) -> str:
        """The wells where rows and columns meet, as a list: "row B, col 1-6" is B1-B6."""
        if match["row2"]:
            return self._names.crossed(match["row"], match["row2"], match["columns"])
        runs: list[str] = []
        for letter in self._names.numbers(match["row"]):
            if runs and _follows(runs[-1][-1], letter):
                runs[-1] += letter
            else:
                runs.append(letter)
        crossed = (
            self._names.crossed(run[0], run[-1] if len(run) > 1 else "", match["columns"])
            for run in runs
        )
        return ", ".join(crossed)


@functools.lru_cache(maxsize=8)
def _ellipses(names: WellNames) -> Ellipses:
    return Ellipses(names)


def _spanned(match: re.Match[str]) -> str:
    """A range with a hyphen, if the wells stand in one row or column and lie apart."""
    one, other = match["first"], match["last"]
    in_row = one[0] == other[0] and int(other[1:]) - int(one[1:]) > 1
    in_column = one[1:] == other[1:] and ord(other[0]) - ord(one[0]) > 1
    return f"{match['before']}{one}-{other}" if in_row or in_column else match[0]


def _counting_on(matches: Iterable[re.Match[str]]) -> list[re.Match[str]]:
    """These matches if they count from 1 without a gap, or else none."""
    found: list[re.Match[str]] = []
    for match in matches:
        last = (found[-1]["high"] or found[-1]["low"]) if found else "0"
        if not _follows(last, match["low"]):
            return []
        found.append(match)
    return found


def _is_entry(match: re.Match[str]) -> bool:
    """Whether a letter is followed by what is there, or follows it: "samples (A-F)"."""
    bare = match.string[match.end() :].lstrip()[:1] in (",", ";", ")")
    return not bare or match["lead"] == "(" or match["lead"].isalpha()


def _count_down(entries: Iterable[re.Match[str]]) -> bool:
    """Whether these letters go on from A, without a gap but where dots stand for the rest."""
    last = "@"  # before A
    for entry in entries:
        gap = entry["lead"] not in ":=(,;" and entry["low"] > last > "@"
        if not (gap or _follows(last, entry["low"])):
            return False
        last = entry["high"] or entry["low"]
    return True


def _follows(last: str, low: str) -> bool:
    """Whether a column's number or a row's letter is the one after the last."""
    if last.isdecimal() != low.isdecimal():
        return False
    return int(low) == int(last) + 1 if low.isdecimal() else ord(low) == ord(last) + 1
