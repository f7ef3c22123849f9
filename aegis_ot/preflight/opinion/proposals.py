"""Verifies the roles that a model proposes, against source, deck and trace.

A proposal that stands becomes evidence of the weakest kind; what is wrong with another is told.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...vocabulary import Citation, RoleProposal, WellRef, one_line
from ..evidence import Evidence, Kind
from ..judging import Reading
from ..roles import Roles
from ..source import level_of, source_lines


class Rejected(Exception):
    """Why a proposal is not accepted, in words that follow a colon."""


def verify_proposals(
    proposals: Sequence[RoleProposal], reading: Reading, model: str
) -> tuple[dict[Evidence, tuple[str, ...]], list[str]]:
    """The proposals that stand, as evidence, with the level of each well as it was told, if any;
    and the others, each with the reason in a sentence.

    ``reading`` is the protocol in the eyes of the families that are to be judged.
    """
    verifier = _Verifier(reading, model)
    accepted: dict[Evidence, tuple[str, ...]] = {}
    rejected: list[str] = []
    for proposal in proposals:
        try:
            evidence = verifier.evidence(proposal)
            told = tuple(filter(str.strip, proposal.levels))
            accepted[evidence] = told * len(evidence.wells) if len(told) == 1 else told
        except Rejected as reason:
            wells = ", ".join(proposal.wells) or "no well"
            rejected.append(f"{wells} as {proposal.role or 'nothing'}, not accepted: {reason}")
    return accepted, rejected


class _Verifier:
    """Knows the protocol, and what it has accepted so far."""

    def __init__(self, reading: Reading, model: str) -> None:
        self._reading = reading
        self._model = model
        self._lines = source_lines(reading.recording.text)
        self._taken: dict[WellRef, str] = {}

    def evidence(self, proposal: RoleProposal) -> Evidence:
        """What the proposal is worth.

        Raises:
            Rejected: Nothing.
        """
        families = [r for r in self._reading.roles if proposal.role in r.family.roles]
        if not families:
            names = ", ".join(roles.family.family for roles in self._reading.roles)
            raise Rejected(f"{names or 'no family in force'} knows no such role")
        wells = self._wells(proposal)
        self._check_quotes(proposal.citations)
        for roles in families:
            for ref in wells:
                self._check_well(roles, proposal.role, ref)
        levels = self._levels(proposal, len(wells))
        self._taken.update(dict.fromkeys(wells, proposal.role))
        said = proposal.citations[0]
        return Evidence(
            Kind.MODEL,
            proposal.role,
            wells,
            f"read by {self._model} at line {said.line}: '{said.quote}'",
            role=proposal.role,
            levels=levels,
        )

    def _wells(self, proposal: RoleProposal) -> tuple[WellRef, ...]:
        """The wells that are meant, all of one labware that the run uses.

        A well that the run forgets is one of them: a control that never gets its vehicle.
        """
        found: dict[WellRef, None] = {}
        for place in proposal.wells:
            named = self._reading.deck.at(place) if place.rpartition(":")[2].strip() else ()
            if not named:
                raise Rejected(f"there is no well {place!r} on the deck")
            found.update(dict.fromkeys(named))
        used = {ref.labware for ref in found if self._reading.deck.used_wells([ref.labware])}
        if not used:
            raise Rejected("the run does not use this labware" if found else "it names no well")
        if len(used) > 1:
            raise Rejected("these wells are in several labware")
        return tuple(ref for ref in found if ref.labware in used)

    def _check_quotes(self, citations: Sequence[Citation]) -> None:
        if not citations:
            raise Rejected("it cites nothing")
        for said in citations:
            quote = _plain(said.quote)
            if not any(map(str.isalpha, quote)):
                raise Rejected(f"{said.quote!r} says nothing")
            inside = 1 <= said.line <= len(self._lines)
            if not inside or quote not in _plain(self._lines[said.line - 1]):
                raise Rejected(f"{said.quote!r} does not stand at line {said.line}")

    def _check_well(self, roles: Roles, role: str, ref: WellRef) -> None:
        """Hold a role against how the run uses the well, and against what else is said of it."""
        spec = roles.family.roles[role]
        side, passes_on = self._reading.trace.sides(ref)
        if spec.side not in ("any", side) and not (passes_on and spec.side == "source"):
            use = {"source": "drawn from", "destination": "filled"}
            used = use.get(side, "neither drawn from nor filled")
            raise Rejected(f"{ref.address} is {used} first, and a {spec.title} is {use[spec.side]}")
        assigned = roles.by_well.get(ref)
        if assigned is not None and not roles.family.are_kin(role, assigned.role):
            said = assigned.evidence[0].citation
            raise Rejected(f"{ref.address} is {assigned.role} by {said}")
        taken = self._taken.get(ref)
        if taken is not None and not roles.family.are_kin(role, taken):
            raise Rejected(f"{ref.address} is proposed as {taken} as well")

    def _levels(self, proposal: RoleProposal, count: int) -> tuple[float | None, ...]:
        """The level of each well, where they are told."""
        told = [level for level in proposal.levels if level.strip()]
        if not told:
            return (None,) * count
        if len(told) not in (1, count):
            raise Rejected(f"it tells {len(told)} levels for {count} wells")
        words = self._reading.database.common.levels
        levels = []
        for text in told:
            level = level_of(text, words)
            if level is None:
                raise Rejected(f"{text!r} is no concentration or dose")
            if not any(_stands_in(said.quote, text) for said in proposal.citations):
                raise Rejected(f"the level {text!r} stands in no quote")
            levels.append(level)
        return tuple(levels * count if len(levels) == 1 else levels)


def _stands_in(quote: str, level: str) -> bool:
    """Whether a level is in a quote as it is written: not the 125 of "A125" or "1250". Its unit may
    stand once behind several numbers: "0, 0.5 and 1 mg/mL".
    """
    number, _, unit = _plain(level).casefold().partition(" ")
    pattern = rf"(?<![a-z\d.]){re.escape(number)}(?!\d|\.\d)"
    if unit:
        pattern += rf"(?:[\s\d.,;-]|\band\b|\bto\b|\bor\b)*{re.escape(unit)}(?![a-z])"
    return re.search(pattern, _plain(quote).casefold()) is not None


def _plain(text: str) -> str:
    """As the request shows it, but for blanks."""
    return one_line(text, len(text))
