"""What a model gets to know of one protocol, and what it answers.

A dossier (source, trace, roles, open questions) is put together where the rehearsal is (the robot,
or a workstation), and read where the model is. It holds plain values only, so it crosses the wire
as JSON; equal dossiers have equal digests, and the sidecar asks a model once per digest.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, replace

from .findings import Finding, Severity, Undecided
from .wells import WellRef
from .wire import to_json

MODEL_FORMS = (
    "anthropic:MODEL, openai:MODEL, openai:MODEL@URL, replay:FOLDER, scripted:FILE, export:FILE"
)
"""How a model is named, for people."""


@dataclass(frozen=True)
class DeckItem:
    """One piece of labware, with a ``key`` as in well references.

    ``label`` is what the scientist called it, or its display name.
    """

    key: str
    slot: str
    label: str
    load_name: str
    rows: int
    columns: int


@dataclass(frozen=True)
class RuleBrief:
    """One rule in force; ``decided``: whether the checks decided it, one way or the other.

    ``text`` is statement and instruction, for rules that this package does not ship.
    """

    id: str
    severity: Severity
    decided: bool
    text: str = ""


@dataclass(frozen=True)
class RoleLine:
    """Wells that have one role on the same evidence."""

    role: str
    places: str
    evidence: str


@dataclass(frozen=True)
class Dossier:
    """See the module.

    Attributes:
        file: Name of the protocol file.
        source: Its text.
        parameters: Values of runtime parameters, as JSON text.
        family: The likeliest assay family.
        family_known: Whether that is more than a guess.
        table: The trace, see :mod:`~aegis_ot.preflight.trace.table`.
        deck: Labware that can hold liquid.
        wells: Wells that the run uses, or that have a role.
        lines: Source lines that did something in the run.
        roles: What wells are for.
        rules: Every rule in force.
        questions: Rules that the checks could not decide.
        wanted: What they lack: ``"PCR-2: template, ntc"``.
        findings: What the checks found.
    """

    file: str
    source: str
    parameters: str
    family: str
    family_known: bool
    table: tuple[str, ...]
    deck: tuple[DeckItem, ...]
    wells: tuple[WellRef, ...]
    lines: tuple[int, ...]
    roles: tuple[RoleLine, ...]
    rules: tuple[RuleBrief, ...]
    questions: tuple[Undecided, ...]
    wanted: tuple[str, ...]
    findings: tuple[Finding, ...]

    @property
    def digest(self) -> str:
        """SHA-256 of everything but the file's name."""
        values = to_json(replace(self, file=""))
        text = json.dumps(values, sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


@dataclass(frozen=True)
class Citation:
    """Where the protocol says something: the words, verbatim, at a source line."""

    line: int
    quote: str


@dataclass(frozen=True)
class RoleProposal:
    """What a model takes wells for, and where it read that.

    Attributes:
        role: Name of a role: ``"ntc"``.
        wells: Places: ``"4:H12"``, ``"4:A1-H1"``.
        levels: Concentrations or doses as they are written, with their unit: one for all wells, one
            for each of their columns, or one for each well.
        citations: What says so.
    """

    role: str
    wells: tuple[str, ...]
    levels: tuple[str, ...] = ()
    citations: tuple[Citation, ...] = ()


@dataclass(frozen=True)
class RuleAnswer:
    """The model's answer to an open question: ``holds``, ``violated``, ``cannot_tell``, or
    ``not_applicable`` where the protocol does nothing that the rule speaks of.
    """

    rule: str
    answer: str
    reason: str = ""


@dataclass(frozen=True)
class Opinion:
    """What came of asking a model about one protocol.

    Attributes:
        state: ``answered``, or why there is no answer.
        model: Who was asked.
        detail: One sentence on what went wrong.
        family: The assay family that it reads, or ``""``.
        proposals: What it takes wells for; not yet verified.
        answers: To the open questions.
        findings: Violations that it sees, in wells and lines that exist.
        left_out: What it said that cannot be used, and why.
        summary: Its own words.
    """

    state: str
    model: str
    detail: str = ""
    family: str = ""
    proposals: tuple[RoleProposal, ...] = ()
    answers: tuple[RuleAnswer, ...] = ()
    findings: tuple[Finding, ...] = ()
    left_out: tuple[str, ...] = ()
    summary: str = ""

    @property
    def answered(self) -> bool:
        """Whether the model gave an answer."""
        return self.state == "answered"


def is_known(finding: Finding, others: Sequence[Finding]) -> bool:
    """Whether one of the others is of the same rule, and of some of the same wells."""
    return any(
        other.rule == finding.rule and not set(other.wells).isdisjoint(finding.wells)
        for other in others
    )
