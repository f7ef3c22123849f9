"""What a judge of protocols says, whoever it is: the rules, a model, or both."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...checking import CheckedProtocol, CheckSettings, check_files
from ...preflight import Database
from ...vocabulary import Finding, Undecided


@dataclass(frozen=True)
class Prediction:
    """The judgement on one protocol.

    Attributes:
        file: File name within the folder.
        family: The family that it takes the protocol for.
        findings: What it holds against it.
        undecided: Rules that it could not judge.
        seconds: How long it took, s.
        problem: Why the protocol could not be judged, or ``""``.
        tokens: Asked of and answered by a model; 0 where none was asked.
        cost_usd: What that cost, US dollars.
    """

    file: str
    family: str
    findings: tuple[Finding, ...]
    undecided: tuple[Undecided, ...] = ()
    seconds: float = 0.0
    problem: str = ""
    tokens: int = 0
    cost_usd: float = 0.0

    @property
    def is_flagged(self) -> bool:
        """Whether it fails or warns."""
        return bool(self.findings)


class Judge(Protocol):
    """Judges protocol files, and tells ``done`` of each."""

    def __call__(
        self, files: Sequence[Path], done: Callable[[Prediction], None]
    ) -> list[Prediction]:
        """One prediction per file, in the order of the files."""


class RulesOnly:
    """The rules, with no model.

    Args:
        settings: How to check. Waivers and a baseline are left out: they would hide findings.
        database: The rules.
    """

    def __init__(self, settings: CheckSettings, database: Database) -> None:
        self._settings = settings
        self._database = database

    def __call__(
        self, files: Sequence[Path], done: Callable[[Prediction], None]
    ) -> list[Prediction]:
        """Check the files one after another."""
        run = check_files(
            files, self._settings, self._database, lambda checked: done(_prediction(checked))
        )
        return [_prediction(checked) for checked in run.protocols]


def _prediction(checked: CheckedProtocol) -> Prediction:
    problem = ""
    if checked.problem is not None:
        line = f"line {checked.problem.line}: " if checked.problem.line else ""
        problem = f"{line}{checked.problem.message}"
    return Prediction(
        file=Path(checked.file).name,
        family=checked.family,
        findings=checked.findings,
        undecided=checked.undecided,
        seconds=checked.seconds,
        problem=problem,
    )
