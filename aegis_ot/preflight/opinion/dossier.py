"""What a model gets to know of one protocol: source, trace, roles, open questions.

Put together where the rehearsal is (the robot, or a workstation), read where the model is. It
holds plain values only, so it crosses the wire as JSON; equal dossiers have equal digests, and
the sidecar asks a model once per digest.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, replace

from ...vocabulary import Finding, Severity, Undecided, WellRef, to_json


@dataclass(frozen=True)
class DeckItem:
    """One piece of labware.

    Attributes:
        key: As in well references.
        slot: Where it was loaded.
        label: What the scientist called it, or its display name.
        load_name: Of its definition.
        rows: Rows of wells.
        columns: Columns of wells.
    """

    key: str
    slot: str
    label: str
    load_name: str
    rows: int
    columns: int


@dataclass(frozen=True)
class RuleBrief:
    """One rule in force.

    Attributes:
        id: Its identifier.
        severity: In force.
        decided: Whether the checks decided it, one way or the other.
        text: Statement and instruction, for rules that this package does not ship.
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
