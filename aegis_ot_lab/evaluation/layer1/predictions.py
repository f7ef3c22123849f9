"""What a judge of protocols says, whoever it is: the rules, a model, or both."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from aegis_ot.llm import Reply
from aegis_ot.preflight import RuleSet
from aegis_ot.vocabulary import Finding, Undecided, VerdictWord
from aegis_ot.workbench import CheckedProtocol, CheckSettings, check_files


@dataclass(frozen=True)
class Prediction:
    """The judgement on one protocol.

    Attributes:
        file: File name within the folder.
        family: The family that it takes the protocol for.
        findings: What it holds against it.
        undecided: Rules that it could not judge.
        seconds: How long it took, the model's time included, s.
        problem: Why the protocol could not be judged, or ``""``.
        reply: What came of asking a model, where one was asked.
    """

    file: str
    family: str
    findings: tuple[Finding, ...]
    undecided: tuple[Undecided, ...] = ()
    seconds: float = 0.0
    problem: str = ""
    reply: Reply | None = None

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


class Checking:
    """The rules, or a model, or both: as :func:`~aegis_ot.workbench.check_files` judges.

    Args:
        settings: How to check; ``asking`` says with which model, in which configuration. Waivers
            and a baseline are left out: they would hide findings.
        rule_set: The rules.
    """

    def __init__(self, settings: CheckSettings, rule_set: RuleSet) -> None:
        self._settings = settings
        self._rule_set = rule_set

    def __call__(
        self, files: Sequence[Path], done: Callable[[Prediction], None]
    ) -> list[Prediction]:
        """Check the files one after another."""
        run = check_files(
            files, self._settings, self._rule_set, lambda checked: done(_prediction(checked))
        )
        return [_prediction(checked) for checked in run.protocols]


def _prediction(checked: CheckedProtocol) -> Prediction:
    problem = ""
    if checked.problem is not None:
        line = f"line {checked.problem.line}: " if checked.problem.line else ""
        problem = f"{line}{checked.problem.message}"
    elif checked.verdict is VerdictWord.ERROR:
        problem = checked.unanswered
    reply = checked.judgement.reply if checked.judgement else None
    # A replayed answer took no time now, and counts with the time that it once took.
    replayed_s = reply.seconds if reply is not None and reply.attempts == 0 else 0.0
    return Prediction(
        file=Path(checked.file).name,
        family=checked.family,
        findings=checked.findings,
        undecided=checked.undecided,
        seconds=checked.seconds + replayed_s,
        problem=problem,
        reply=reply,
    )
