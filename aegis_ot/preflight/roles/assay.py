"""Infers the assay family from words and from the shape of the liquid's ways."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from ..evidence import DOUBTFUL, Evidence, Kind
from ..rules import Family, Shape
from ..source import SourceFacts, tokens
from ..trace import Trace
from .inference import Inference
from .naming import FamilyWords
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


def infer_families(
    assays: Sequence[FamilyWords],
    facts: SourceFacts,
    evidence: Sequence[Evidence],
    trace: Trace,
    assigned: Callable[[str], Roles],
    given: Sequence[str] = (),
) -> list[Inference]:
    """All families, the likeliest first; ``assigned`` tells what wells are for in a family's eyes.

    Families ``given`` by hand apply, and no other does.
    """
    reader = _SignalReader(shapes_of(trace), assigned)
    texts = list(_texts(facts, evidence, trace))
    fits = [_Fit(words, reader.signals(words, texts)) for words in assays]
    fits.sort(key=lambda fit: -fit.score)
    if given:
        inferences = [_given_by_hand(fit, fit.family.family in given, fits) for fit in fits]
    else:
        inferences = [
            _inferred(fit, fits, lambda words: reader.in_prose(words, texts)) for fit in fits
        ]
        if not any(inference.applies for inference in inferences):
            inferences = list(map(_left_over, inferences, fits))
    # What the run's own shape speaks against comes after another that applies; so does a family
    # that is judged beside others.
    odd = {fit.family.family for fit in fits if any(f.shape and f.worth < 0 for f in fit.found)}
    beside = {fit.family.family for fit in fits if fit.family.beside}
    return sorted(
        inferences, key=lambda i: (not i.applies, i.family in odd, i.family in beside, -i.score)
    )


class _Fit(NamedTuple):
    """A family with all signals found for it, the strongest first."""

    words: FamilyWords
    found: Sequence[_Found]

    @property
    def family(self) -> Family:
        return self.words.family

    @property
    def score(self) -> float:
        return max(_score(self.found), 0.0)

    @property
    def is_known(self) -> bool:
        return _is_known(self.found)

    @property
    def reasons(self) -> tuple[str, ...]:
        return tuple(one.said for one in self.found if one.worth > 0)[:6]

    def share(self, fits: Sequence[_Fit]) -> float:
        """Its share among all families, damped for little evidence."""
        total = sum(fit.score for fit in fits) or 1.0
        return self.score / total * min(1.0, self.score / (2 * SURE))

    def outdoes_default(self, best: float) -> bool:
        """Where wells are given what a family's own are, its words outweigh "source" and
        "transfer"; and nothing is told twice, as the one family's fault and as the other's.
        """
        strong = not self.family.default and self.score >= ALSO * best
        return strong and self.is_known and _shown(self.found)


def _given_by_hand(fit: _Fit, named: bool, fits: Sequence[_Fit]) -> Inference:
    confidence = 1.0 if named else round(fit.share(fits), 2)
    return Inference(fit.family.family, fit.score, confidence, fit.reasons, named, named)


def _inferred(
    fit: _Fit, fits: Sequence[_Fit], in_prose: Callable[[FamilyWords], bool]
) -> Inference:
    rivals = [other for other in fits if other.is_known and not other.family.beside]
    best = max((other.score for other in rivals), default=0.0)
    sure = fit.is_known
    second = fit.score >= ALSO * best and _said_outright(fit.found)
    applies = sure and (fit.family.beside or fit.score == best or second)
    if fit.family.default:
        applies = applies and fit.score == best
        applies = applies and not any(other.family.beside and other.is_known for other in fits)
        applies = applies and not any(other.outdoes_default(best) for other in fits)
        if not best:  # sure where no more than one word speaks against it
            against = sum(one.worth < 0 for one in fit.found)
            sure = against <= 1 or _score(fit.found) >= SURE
    told = applies and sure and not fit.family.default and in_prose(fit.words)
    confidence = round(fit.share(fits), 2)
    return Inference(
        fit.family.family, fit.score, confidence, fit.reasons, applies, sure, in_prose=told
    )


def _left_over(inference: Inference, fit: _Fit) -> Inference:
    """The default family is judged where no other fits."""
    if not fit.family.default:
        return inference
    reasons = (*inference.reasons, "no other family fits")
    return replace(inference, reasons=reasons, applies=True, left_over=True)


class _SignalReader:
    """Finds what speaks for a family: words, shapes of the run, names of wells."""

    def __init__(
        self, shapes: Mapping[Shape, tuple[float, str]], assigned: Callable[[str], Roles]
    ) -> None:
        self._shapes, self._assigned = shapes, assigned

    def signals(self, words: FamilyWords, texts: Sequence[tuple[str, str]]) -> list[_Found]:
        """All signals of a family, the strongest first."""
        family, found = words.family, _found(words, texts)
        found += _seen(family, self._shapes, bool(found))
        if family.known_by and found and not _is_known(found):
            in_texts = _shown(found) and any(one.defining for one in found)
            by_well = self._assigned(family.family).by_well.values()
            named = {one.role for one in by_well if in_texts or one.kind not in DOUBTFUL}
            found += _named(family, named, sum(one.worth for one in found if one.worth > 0))
        return sorted(found, key=lambda one: -one.worth)

    def in_prose(self, words: FamilyWords, texts: Sequence[tuple[str, str]]) -> bool:
        """Whether it is known only by comments and docstrings."""
        code = [(where, text) for where, text in texts if where != "text"]
        return len(code) < len(texts) and not _is_known(self.signals(words, code))


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
    for name in sorted(facts.names):  # reasons are told in this order
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


def _found(words: FamilyWords, texts: Iterable[tuple[str, str]]) -> list[_Found]:
    best: dict[str, _Found] = {}
    for where, text in texts:
        for match in words.signals.find(text):
            signal = words.family.signals[int(match.topic)]
            worth = signal.weight * PLACES[where]
            if match.topic not in best or abs(worth) > abs(best[match.topic].worth):
                said = f"'{match.phrase}' in a {where}"
                best[match.topic] = _Found(worth, said, signal.weight, signal.defining)
    return list(best.values())
