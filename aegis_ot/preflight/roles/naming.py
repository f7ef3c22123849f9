"""What the words of a family say: which of its roles a name, a label or a liquid names."""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Sequence, Set

from ..evidence import Evidence, Kind
from ..rules import Common, Family
from ..source import Lexicon, Match, lexicon_of, tokens, without_concentrations

_SEVERAL = 3
"""Two wells may well hold one liquid that is called by a plural."""


class FamilyWords:
    """The words of one family: of its roles, and of what reveals it; made once for all protocols.

    Attributes:
        family: The family.
        signals: Finds what reveals it; the topics are the places in its list of signals.
    """

    def __init__(self, family: Family, common: Common) -> None:
        self.family = family
        self._joints = _first_words(common.joints)
        self._sides = _first_words(common.sides)
        self._joining = _first_words(common.joining)
        self._lacking = _first_words(common.lacking)
        self._aliases = common.aliases
        self.signals = lexicon_of(
            {
                str(n): (*one.words, *(w for role in one.roles for w in family.roles[role].words))
                for n, one in enumerate(family.signals)
            },
            common.aliases,
        )

    @functools.cached_property
    def _lexicon(self) -> Lexicon:
        roles = self.family.roles.items()
        phrases = {name: spec.words for name, spec in roles}
        # What only looks like a role's name is found as such, and names nothing.
        return lexicon_of(phrases | {f"!{name}": spec.never for name, spec in roles}, self._aliases)

    @functools.cached_property
    def _of_control(self) -> Set[str]:
        roles = self.family.roles
        liquids = {role for spec in roles.values() for role in spec.follows}
        names: dict[bool, set[tuple[str, ...]]] = {True: set(), False: set()}
        for name, spec in roles.items():
            if spec.follows or name in liquids:
                names[bool(spec.follows)].update(map(self._lexicon.words, spec.words))
        return {name[0] for name in names[True] - names[False] if len(name) == 1}

    def has_word_of_control(self, text: str) -> bool:
        """Whether one of a name's words says that it is a control, not what liquid: "control"."""
        return not self._of_control.isdisjoint(self._lexicon.words(text))

    def of(self, evidence: Evidence) -> list[str]:
        """The roles that a piece of evidence may give its wells, the likeliest first.

        English puts the head last: ``sample_buffer`` is a buffer; but what follows "in" or "for"
        only says more about it. A word that only says on which side of a transfer something
        stands comes last: ``water_src`` is water.
        """
        if evidence.role in self.family.roles:
            return [evidence.role]
        if evidence.kind is Kind.MODEL:
            return []  # a verified role, of another family
        text = evidence.text
        plain = text.replace("%", " percent ")  # most texts have no word of a family
        if not any(map(self._lexicon.may_find, (plain, plain.replace(".", " ")))):
            return []
        record, dot, field = text.rpartition(".")
        if dot:
            # `assay.mix_tube` is a mix and no assay mix; `NO_DNA.dna_tube` holds no DNA.
            own = " ".join(word for word in tokens(field) if word not in tokens(record))
            text = field if self._lexicon.find(own) else record
        key = text.rpartition("[")[2] if text.endswith("]") else ""
        if key and self._head(key):
            text = key  # `tubes["water"]` is water, whatever the dict is called
        # `REAGENTS["control RNA"]` is one of various ones, and no reagent of this family.
        various = text != key and any(map(str.isalpha, key))
        heads = self._head(text, evidence.is_name)
        named = list(dict.fromkeys(match.topic for match in heads))
        named += [role for role in self._controls_behind(text) if self._may_serve(named, role)]
        if self._speaks_of_several(evidence, text, heads):
            return []
        several = evidence.text.rstrip("]'\"").endswith("s") and len(evidence.wells) >= _SEVERAL
        if various or several or (evidence.whole and len(evidence.wells) > 1):
            named = [role for role in named if not self._is_loose_plural(text, role)]
        return named

    def is_outright(self, text: str) -> bool:
        """Whether a text is nothing but the word for a role: "diluent"."""
        words = self._lexicon.words(text)
        return any(match.end - match.start == len(words) for match in self._lexicon.find(text))

    def _head(self, text: str, is_name: bool = True) -> list[Match]:
        words = self._lexicon.words(text.replace("%", " percent "))
        ends = (at for at, word in enumerate(words) if word in self._joints)
        # "in lysis buffer" says what something is in; `for_ntc` is a name.
        end = next((at for at in ends if at or not is_name), len(words))
        found = [
            match
            for match in self._lexicon.find(text.replace("%", " percent "))
            if match.start < end and not (match.start and words[match.start - 1] in self._lacking)
        ]
        telling = [match for match in found if words[match.start] not in self._sides]
        found = telling or found  # `SAMPLE_POS` is the place of a sample
        return [match for match in reversed(found) if not match.topic.startswith("!")]

    def _controls_behind(self, text: str) -> set[str]:
        """The control that something is for: "water for the NTC"; not "for samples and NTC"."""
        words = self._lexicon.words(text)
        start = next(
            (at for at, word in enumerate(words) if at and word in self._joints), len(words)
        )
        behind = {match.topic for match in self._lexicon.find(text) if match.start >= start}
        controls = {role for role, spec in self.family.roles.items() if spec.follows}
        return behind if behind <= controls else set()

    def _may_serve(self, named: Sequence[str], control: str) -> bool:
        """Whether what is named, if anything, may be a control's liquid: water is, a mix not."""
        specs = self.family.roles
        return not named or any(control in specs[role].may_be for role in named)

    def _speaks_of_several(self, evidence: Evidence, text: str, heads: Sequence[Match]) -> bool:
        """Whether a text joins things that differ: "samples and NTC" says of no well which.

        Nor does "MM / ctrl" on a rack, of which one part names nothing that is known.
        """
        parts = [part for part in self._parts(text) if any(map(str.isalpha, part))]
        if len(parts) < 2 and evidence.is_name:
            return False
        # A word may name a liquid and the wells for it: "standards".
        told: list[set[str]] = [{match.topic for match in self._head(part)} for part in parts]
        if len(parts) < 2:
            starts = {match.start for match in heads}
            told = [{match.topic for match in heads if match.start == start} for start in starts]
        specs = self.family.roles

        def kin(one: str, other: str) -> bool:
            if one not in specs or other not in specs:
                return one == other
            used = other in specs[one].may_be or one in specs[other].may_be
            return used or self.family.are_kin(one, other)

        unlike = any(
            some != others and not all(kin(one, other) for one in some for other in others)
            for some, others in itertools.combinations(filter(None, told), 2)
        )
        return unlike or (evidence.whole and any(told) and not all(told))

    def _parts(self, text: str) -> list[str]:
        """The parts of a text between words and marks that join."""
        parts = [""]
        for piece in re.split(r"(\W+)", without_concentrations(text)):
            if not set(piece).isdisjoint(",;/+&") or not self._joining.isdisjoint(tokens(piece)):
                parts.append("")
            else:
                parts[-1] += piece
        return parts

    def _is_loose_plural(self, text: str, role: str) -> bool:
        """Whether only words name a role that for many wells stand for various liquids: a rack of
        "stocks" holds different ones.
        """
        said = {match.phrase for match in self._lexicon.find(text) if match.topic == role}
        return bool(said) and said <= set(self.family.roles[role].differing)


def _first_words(phrases: Sequence[str]) -> frozenset[str]:
    return frozenset(tokens(phrase)[0] for phrase in phrases if tokens(phrase))
