"""Verifies the roles that a model proposes, against source, deck and trace.

A proposal that stands becomes evidence of the weakest kind; what is wrong with another is told.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...vocabulary import Citation, RoleProposal, WellRef, one_line
from ..evidence import Evidence, Kind
from ..judging import Interpretation
from ..roles import Roles
from ..source import level_of, source_lines
from ..trace import row_column


class Rejected(Exception):
    """Why a proposal is not accepted, in words that follow a colon."""


def verify_proposals(
    proposals: Sequence[RoleProposal], reading: Interpretation, model: str
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
            accepted[evidence] = proposal_levels(proposal, evidence.wells)
        except Rejected as reason:
            wells = ", ".join(proposal.wells) or "no well"
            rejected.append(f"{wells} as {proposal.role or 'nothing'}, not accepted: {reason}")
    return accepted, rejected


def quote_problem(said: Citation, lines: Sequence[str]) -> str:
    """Why a quote is none of these source lines, in words that follow a colon; ``""``: it is."""
    quote = _plain(said.quote)
    if not any(map(str.isalpha, quote)):
        return f"{said.quote!r} says nothing"
    if 1 <= said.line <= len(lines) and quote in _plain(lines[said.line - 1]):
        return ""
    places = [n for n, line in enumerate(lines, 1) if quote in _plain(line)]
    elsewhere = f"; it stands at line {places[0]}" if len(places) == 1 else ""
    return f"{said.quote!r} does not stand at line {said.line}{elsewhere}"


def proposal_levels(proposal: RoleProposal, wells: Sequence[WellRef]) -> tuple[str, ...]:
    """The level of each well as it is told: one for all, one a column, or one a well.

    Raises:
        Rejected: It tells another number of them.
    """
    told = tuple(filter(str.strip, proposal.levels))
    columns = list(dict.fromkeys(row_column(ref.name)[1] for ref in wells))
    if len(told) in (0, len(wells)):
        return told
    if len(told) == 1:
        return told * len(wells)
    if len(told) == len(columns):
        return tuple(told[columns.index(row_column(ref.name)[1])] for ref in wells)
    raise Rejected(f"it tells {len(told)} levels for {len(wells)} wells")


class _Verifier:
    """Knows the protocol, and what it has accepted so far."""

    def __init__(self, reading: Interpretation, model: str) -> None:
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
        levels = self._levels(proposal, wells)
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
            if problem := quote_problem(said, self._lines):
                raise Rejected(problem)

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

    def _levels(self, proposal: RoleProposal, wells: Sequence[WellRef]) -> tuple[float | None, ...]:
        """The level of each well, where they are told."""
        told = proposal_levels(proposal, wells)
        if not told:
            return (None,) * len(wells)
        words = self._reading.rule_set.common.levels
        levels = []
        for text in told:
            level = level_of(text, words)
            if level is None:
                raise Rejected(f"{text!r} is no concentration or dose")
            if not any(_stands_in(said.quote, text) for said in proposal.citations):
                raise Rejected(f"the level {text!r} stands in no quote")
            levels.append(level)
        return tuple(levels)


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
