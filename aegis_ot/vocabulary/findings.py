"""What Layer 1 says about a protocol."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from .wells import WellRef

NOT_AS_REHEARSED = "not as rehearsed"
"""In a verdict's place for a run that did otherwise than its rehearsal."""


class Severity(str, Enum):
    """How bad a finding is: an error fails the protocol, a warning only warns."""

    ERROR = "error"
    WARNING = "warning"


class VerdictWord(str, Enum):
    """A protocol's verdict; ``ERROR`` means that it could not be judged at all."""

    PASS = "pass"
    WARN = "warn"
    FAIL = "fail"
    ERROR = "error"


@dataclass(frozen=True)
class Site:
    """One end of a finding: what happened to which well, caused by which source line.

    Attributes:
        line: 1-based line in the protocol file, ``None`` where none is known.
        well: The well concerned, if any.
        action: What was done there, in plain words: ``"drew template"``.
        place: Which record of the rehearsal's log it was, from 1, where that is known: a line in a
            loop is run many times.
    """

    line: int | None
    well: WellRef | None = None
    action: str = ""
    place: int | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class Finding:
    """One violation of one rule.

    Attributes:
        rule: Rule identifier, ``"PCR-2"``.
        severity: Severity in force (after the user's configuration).
        message: One sentence saying what happened in this protocol.
        sites: Both ends where there are two: where it began, where it did harm.
        why: Why it ruins the assay.
        fix: How to mend it.
        source: Who found it: ``"rules"`` or ``"model"``.
    """

    rule: str
    severity: Severity
    message: str
    sites: tuple[Site, ...]
    why: str = ""
    fix: str = ""
    source: str = "rules"

    @property
    def wells(self) -> tuple[WellRef, ...]:
        """The wells concerned, each once, in the order of the sites."""
        return tuple(dict.fromkeys(site.well for site in self.sites if site.well is not None))

    @property
    def lines(self) -> tuple[int, ...]:
        """The source lines concerned, each once, in the order of the sites."""
        return tuple(dict.fromkeys(site.line for site in self.sites if site.line is not None))


@dataclass(frozen=True)
class Remark:
    """Something to be put right that breaks no rule: a waiver that waives nothing.

    Attributes:
        message: One or two sentences for people.
        line: 1-based line in the protocol file, ``None`` where none is known.
    """

    message: str
    line: int | None = None


@dataclass(frozen=True)
class Undecided:
    """A rule that could not be judged.

    Attributes:
        rule: Rule identifier.
        reason: What it lacked, in one line.
        paste: What the protocol's author can write to decide it; ``""`` where nothing short does.
        to_write: What to do with it, in a few words: not all that it offers may be meant.
    """

    rule: str
    reason: str
    paste: str = ""
    to_write: str = "write"

    @property
    def told(self) -> str:
        """The reason, and what to write, on one line."""
        return (
            f"{self.reason}. {self.to_write.capitalize()}: {self.paste}"
            if self.paste
            else self.reason
        )
