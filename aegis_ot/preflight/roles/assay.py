"""Infers the assay family from words and from the shape of the liquid's ways."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from ..evidence import DOUBTFUL, Evidence, Kind
from ..rules import Common, Database, Family, Shape
from ..source import SourceFacts, lexicon_of, tokens
from ..trace import Trace
from .roles import Roles
from .shapes import shapes_of

PLACES = {"metadata": 3.0, "liquid": 2.0, "name": 1.5, "text": 1.0, "string": 0.7}
"""How much a word counts by where it stands: a title says more than a stray comment."""

SURE = 4.0
"""From this score on a family counts as known, if something defines it."""

LONE = 3.0
"""A signal of less weight makes no family known unless another one agrees."""

_OUTRIGHT = 0.8
"""A family that is defined by signals of less worth, for their weight, is no second one."""

AGREEING = 1.0
"""Nor does one of less weight than this count as another."""

ALSO = 0.6
"""A second family applies from this share of the first one's score on."""


@dataclass(frozen=True)
class Inference:
    """How well one family fits.

    Attributes:
        family: Name of the family.
        score: Weight of everything that speaks for it.
        confidence: 0 to 1: its share among all families, damped for little evidence.
        reasons: What speaks for it, strongest first.
        applies: Whether its rules are judged.
        sure: Whether it is more than a guess.
        left_over: Whether it is judged only because no other family fits.
        in_prose: Whether it would be no more than a guess without comments and docstrings.
    """

    family: str
    score: float
    confidence: float
    reasons: tuple[str, ...]
    applies: bool
    sure: bool
    left_over: bool = False
    in_prose: bool = False


def infer_families(
    database: Database,
    facts: SourceFacts,
    evidence: Sequence[Evidence],
    trace: Trace,
    assigned: Callable[[str], Roles],
    given: Sequence[str] = (),
) -> list[Inference]:
    """All families, the likeliest first; ``assigned`` tells what wells are for in a family's eyes.

    Families ``given`` by hand apply, and no other does.
    """
    texts = list(_texts(facts, evidence, trace))
    shapes = shapes_of(trace)

    def signals(family: Family, texts: Sequence[tuple[str, str]]) -> list[_Found]:
        found = _found(family, texts, database.common)
        found += _seen(family, shapes, bool(found))
        if family.known_by and found and not _is_known(found):
            in_texts = _shown(found) and any(one.defining for one in found)
            by_well = assigned(family.family).by_well.values()
            named = {one.role for one in by_well if in_texts or one.kind not in DOUBTFUL}
            found += _named(family, named, sum(one.worth for one in found if one.worth > 0))
        return sorted(found, key=lambda one: -one.worth)

    def in_prose(family: Family) -> bool:
        code = [(where, text) for where, text in texts if where != "text"]
        return len(code) < len(texts) and not _is_known(signals(family, code))

    scored = []
    for family in database.assays:
        found = signals(family, texts)
        scored.append((max(_score(found), 0.0), family, found))
    scored.sort(key=lambda item: -item[0])
    total = sum(score for score, _, _ in scored) or 1.0
    best = max((score for score, _, found in scored if _is_known(found)), default=0.0)
    # Where wells are given what a family's own are, its words outweigh "source" and "transfer";
    # and nothing is told twice, as the one family's fault and as the other's.
    outdone = any(
        not family.default and score >= ALSO * best and _is_known(found) and _shown(found)
        for score, family, found in scored
    )
    inferences = []
    for score, family, found in scored:
        name, reasons = family.family, tuple(one.said for one in found if one.worth > 0)[:6]
        sure = _is_known(found)
        applies = sure and (score == best or (score >= ALSO * best and _said_outright(found)))
        if given:
            applies = sure = name in given
        elif family.default:
            applies = applies and score == best and not outdone
            # What is left over is sure where no more than one word speaks against it.
            against = sum(one.worth < 0 for one in found)
            sure = sure if best else against <= 1 or _score(found) >= SURE
        confidence = 1.0 if given and applies else score / total * min(1.0, score / (2 * SURE))
        told = applies and sure and not (given or family.default) and in_prose(family)
        inferences.append(
            Inference(name, score, round(confidence, 2), reasons, applies, sure, in_prose=told)
        )
    if not given and not any(inference.applies for inference in inferences):
        inferences = [
            replace(i, reasons=(*i.reasons, "no other family fits"), applies=True, left_over=True)
            if database.family(i.family).default
            else i
            for i in inferences
        ]
    # What the run's own shape speaks against comes after another that applies.
    odd = {
        family.family for _, family, found in scored if any(f.shape and f.worth < 0 for f in found)
    }
    return sorted(inferences, key=lambda i: (not i.applies, i.family in odd, -i.score))


def _texts(
    facts: SourceFacts, evidence: Iterable[Evidence], trace: Trace
) -> Iterable[tuple[str, str]]:
    # A PCR plate holds whatever one likes: the maker's name of a labware says nothing.
    makers = {info.load_name for info in trace.labware.values()}
    for key in ("protocolName", "protocol_name", "description", "title"):
        if key in facts.metadata:
            yield "metadata", facts.metadata[key]
    for one in evidence:
        if one.kind is Kind.LIQUID:
            yield "liquid", one.text
        elif one.kind in (Kind.NAME, Kind.PASSING_NAME):
            yield "name", one.text
    for name in facts.names:
        yield "name", name
    for _, text in facts.docstrings:
        yield "text", text
    for text in facts.comments.values():
        yield "text", text
    for _, text in facts.strings:
        if text not in makers and len(text) < 200 and len(tokens(text)) < 30:
            yield "string", text


class _Found(NamedTuple):
    """One signal that was found: what it adds here, the words, its weight, if it defines.

    ``shape``: whether the run shows it rather than words.
    """

    worth: float
    said: str
    weight: float
    defining: bool
    shape: bool = False


def _score(found: Sequence[_Found]) -> float:
    return sum(one.worth for one in found)


def _is_known(found: Sequence[_Found]) -> bool:
    """Whether enough speaks for the family, and something defines it."""
    return _score(found) >= SURE and _defines(found)


def _defines(found: Sequence[_Found]) -> bool:
    """Whether some signal makes the family known: a telling one alone, another one in company."""
    company = sum(one.weight >= AGREEING for one in found) > 1
    return any(one.defining and (one.weight >= LONE or company) for one in found)


def _said_outright(found: Sequence[_Found]) -> bool:
    """Whether more than a text of the run defines the family: "seal it for the PCR" does not."""
    return _defines([one for one in found if one.worth >= _OUTRIGHT * one.weight])


def _shown(found: Sequence[_Found]) -> bool:
    """Whether the run has a shape that speaks for the family."""
    return any(one.shape and one.worth > 0 for one in found)


def _seen(
    family: Family, shapes: Mapping[Shape, tuple[float, str]], has_words: bool
) -> Iterable[_Found]:
    """What the shapes of the run say of a family; most of them only beside words."""
    for signal in family.shapes:
        if not (has_words or signal.defining):
            continue
        if signal.shape in shapes and shapes.keys().isdisjoint(signal.unless):
            clear, said = shapes[signal.shape]
            defining = signal.defining and clear >= 1
            yield _Found(signal.weight * clear, said, LONE if defining else 0.0, defining, True)


def _named(family: Family, named: set[str], said_by_words: float) -> Iterable[_Found]:
    """What the roles that wells are named for say of a family, beyond what their words said."""
    for signal in family.known_by:
        if all(named & set(either.split("|")) for either in signal.roles):
            titles = [family.roles[either.split("|")[0]].title for either in signal.roles]
            said = f"wells are named {', '.join(titles[:-1])} and {titles[-1]}"
            yield _Found(max(SURE - said_by_words, 0.0), said, LONE, True)
            return


def _found(family: Family, texts: Iterable[tuple[str, str]], common: Common) -> list[_Found]:
    lexicon = lexicon_of(
        {
            str(n): (*signal.words, *(w for role in signal.roles for w in family.roles[role].words))
            for n, signal in enumerate(family.signals)
        },
        common.aliases,
    )
    best: dict[str, _Found] = {}
    for where, text in texts:
        for match in lexicon.find(text):
            signal = family.signals[int(match.topic)]
            worth = signal.weight * PLACES[where]
            if match.topic not in best or abs(worth) > abs(best[match.topic].worth):
                said = f"'{match.phrase}' in a {where}"
                best[match.topic] = _Found(worth, said, signal.weight, signal.defining)
    return list(best.values())
