"""What the run says of itself: ``protocol.comment(f"{name} -> {well}")`` before a transfer.

A comment speaks of what is done until the next comment or pause, if that is one thing: all
draws stand at the same lines, or are from one well. One that heads a whole section, or says
what is done by now, says nothing of single wells.
"""

from __future__ import annotations

import re
from bisect import bisect
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from ...instrumentation import OperationKind
from ...vocabulary import WellRef
from ..layouts import well_names
from ..rules import Common
from ..text import SourceFacts, direction_in, first_words, labware_words, lexicon_of, tokens
from ..trace import Said, Trace, Visit
from .clues import Clue, Strength, shortened

_LONGEST = 14
_LONGEST_LABEL = 7
_MOST_WELLS = 24
"""A comment names the wells that one liquid goes to if they are few: a control, not a plate."""

_ARROW = re.compile(r"\s*(?:->|=>|-->|>>|\u2192|\u27f6)\s*")
_BRACKETS = re.compile(r"[(\[{]([^()\[\]{}]*)[)\]}]")
_LISTS = re.compile(r"[;|+&]|,\s")


@dataclass
class _Meant:
    """The wells that one text speaks of, and whether it was said of several draws at once."""

    line: int | None
    drawn: dict[WellRef, None] = field(default_factory=dict)
    given: dict[WellRef, None] = field(default_factory=dict)
    several: bool = False


def said_in_the_run(trace: Trace, facts: SourceFacts, common: Common) -> Iterator[Clue]:
    """Comments of the run, with the wells that are drawn from and given to under each."""
    silent = lexicon_of({"silent": (*common.negations, *common.afterwards)})
    meant: dict[str, _Meant] = {}
    for said, visits in _spans(trace):
        if said.paused or len(tokens(said.text)) > _LONGEST or silent.find(said.text):
            continue
        drawn = [visit for visit in visits if visit.kind is OperationKind.ASPIRATE]
        given = [visit for visit in visits if visit.parts]
        if _is_one_deed(drawn) and not _said_after(said, drawn, facts):
            found = meant.setdefault(said.text, _Meant(said.line))
            found.several |= _turns(drawn) > 1
            found.drawn.update(dict.fromkeys(visit.well.ref for visit in drawn))
            found.given.update(dict.fromkeys(visit.well.ref for visit in given))
    for text, found in meant.items():
        yield from _clues(text, found, common)


def laid_out_in_the_run(trace: Trace, common: Common) -> list[tuple[int, str]]:
    """Comments of the run that are lines of a layout: ``f"column {n}: {dose} uM"``, by line.

    Of "H12 is the NTC: 5 uL water from tube A2" the first clause is. Not what says how much goes
    there: "B1: 16.2 uL DNA + 43.8 uL TE".
    """
    spec, means = well_names(common).spec, first_words(common.means)
    nouns = labware_words(common)
    standing: defaultdict[str, set[str]] = defaultdict(set)
    for visit in trace.visits if trace.comments else ():
        standing[visit.well.ref.name].add(visit.well.ref.labware)
    found: list[tuple[int, str]] = []
    for said in dict.fromkeys(trace.comments):
        text = said.text.strip()
        first = text.split(maxsplit=1)
        begin = len(first[0]) + 1 if first and first[0].lower() in nouns else 0  # "tube A1 is"
        if (match := spec.match(text, begin)) is None:
            continue
        after = text[match.end() :].lstrip()
        if not means.isdisjoint(tokens(after)[:1]):
            if not begin and match["first"] and len(standing[match["first"]]) != 1:
                continue  # which labware's well it speaks of is not said
            text = _CLAUSE_ENDS.split(text, maxsplit=1)[0]
        elif after[:1] not in (":", "="):
            continue
        if not _VOLUME.search(text):
            found.append((said.line or 1, text))
    return found


_VOLUME = re.compile(r"\d\s*[uµμm]l\b", re.IGNORECASE)
_CLAUSE_ENDS = re.compile(r"[:;.,]\s")


def _spans(trace: Trace) -> Iterator[tuple[Said, list[Visit]]]:
    """Each comment or pause with what is done until the next one, mixing apart."""
    starts = [said.at for said in trace.comments]
    done: list[list[Visit]] = [[] for _ in starts]
    for visit in trace.visits if starts else ():
        at = bisect(starts, visit.index) - 1
        if at >= 0 and not visit.mixing:
            done[at].append(visit)
    yield from zip(trace.comments, done, strict=True)


def _is_one_deed(drawn: Sequence[Visit]) -> bool:
    return len({visit.lines for visit in drawn}) == 1 or _turns(drawn) == 1


def _said_after(said: Said, drawn: Sequence[Visit], facts: SourceFacts) -> bool:
    """Whether a loop went back to the deeds above the comment, which spoke of those before it."""
    if said.line is None:
        return False
    here = facts.within.get(said.line)
    return any(
        line < said.line and facts.within.get(line) == here
        for visit in drawn
        for line in visit.lines
    )


def _turns(drawn: Sequence[Visit]) -> int:
    """How many different things are drawn, the channels of one draw taken together."""
    wells: dict[int, list[WellRef]] = {}
    for visit in drawn:
        wells.setdefault(visit.index, []).append(visit.well.ref)
    return len(set(map(tuple, wells.values())))


def _clues(text: str, found: _Meant, common: Common) -> Iterator[Clue]:
    evidence = f"comment '{shortened(text)}' of the run at line {found.line}"
    what, _, where = _ARROW.sub("\0", text, count=1).partition("\0")
    sources = tuple(ref for ref in found.drawn if ref not in found.given)
    if sources:
        # One number is no level of several things, but "low to high" is one of each.
        unsaid = found.several and not direction_in(what, common)
        yield Clue(
            Strength.COMMENT,
            what,
            sources,
            found.line,
            evidence,
            subject=False,
            levels=(None,) * len(sources) if unsaid else (),
            step="source",
        )
    into = tuple(found.given)
    if found.several or not 0 < len(into) <= _MOST_WELLS:
        return
    for label in _labels(what, where, common):
        yield Clue(
            Strength.COMMENT,
            label,
            into,
            found.line,
            evidence,
            subject=False,
            step="destination",
            lone=True,
        )


def _labels(what: str, where: str, common: Common) -> Iterator[str]:
    """What a comment says of where liquid goes: "NTC", "water to the NTC", "x (control)".

    Only what is called a control: "DMSO" and "sample 3" are what is drawn.
    """
    controls = lexicon_of({"control": common.controls}, common.aliases, common.endings)
    if where and tokens(well_names(common).spec.sub(" ", where)):
        labels = [where]
    else:
        words = tokens(what)
        toward = [at for at, word in enumerate(words) if word in first_words(common.toward)]
        if toward:
            labels = [" ".join(words[toward[0] + 1 :])]
        elif first_words(common.giving).isdisjoint(words):
            labels = [_BRACKETS.sub(" ", what), *_BRACKETS.findall(what)]
        else:
            labels = []
    for label in labels:
        if (
            controls.find(label)
            and len(tokens(label)) <= _LONGEST_LABEL
            and not _LISTS.search(label)
        ):
            yield label
