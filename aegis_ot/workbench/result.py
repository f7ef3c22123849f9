"""What checking yields: one record per protocol file, and the run over all of them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..preflight import Report, RuleSet
from ..preflight.judging import RoleEvidence, Waived, unanswered, verdict_of
from ..vocabulary import Dossier, Finding, Remark, Undecided, VerdictWord
from .designer_steps import DesignerStep

if TYPE_CHECKING:
    from ..llm import Judgement


@dataclass(frozen=True)
class Problem:
    """Why a protocol could not be judged.

    Attributes:
        message: One sentence for people, without file name and line.
        line: 1-based source line at which it stopped, if known.
        missing: The module that it imports and that is not found, if that is why.
        bug: Whether aegis-ot itself failed.
    """

    message: str
    line: int | None = None
    missing: str = ""
    bug: bool = False


@dataclass(frozen=True)
class Broken:
    """A rule that some values of the runtime parameters break.

    Attributes:
        rule: Rule identifier.
        values: The values that break it, in words: ``"columns=12"``.
        runs: How many of the rehearsals broke it.
    """

    rule: str
    values: str
    runs: int


@dataclass(frozen=True)
class Exploration:
    """What ``--all-parameters`` tried.

    Attributes:
        runs: Rehearsals made.
        combinations: All combinations of the values considered.
        parameters: Values considered, by variable name.
        broken: Rules that some values break.
        failures: Values that cannot be rehearsed, and why.
        not_varied: Parameters that were left at their default, and why.
    """

    runs: int
    combinations: int
    parameters: Mapping[str, tuple[Any, ...]]
    broken: tuple[Broken, ...] = ()
    failures: tuple[tuple[str, Problem], ...] = ()
    not_varied: tuple[str, ...] = ()


@dataclass(frozen=True)
class CheckedProtocol:
    """One protocol file, checked.

    Attributes:
        file: The path as the user gave it, with forward slashes.
        report: What Layer 1 found; ``None`` if the protocol could not be judged.
        problem: Why not.
        lines: Source lines, as far as the file could be read.
        seconds: Rehearsal and judgement, s.
        baselined: Findings that the baseline file lists.
        settled: What is wrong with the project's waivers and baseline.
        exploration: What ``--all-parameters`` tried.
        judgement: What came of asking a model, where one was asked.
        dossier: What that model got to know.
        declared: Its runtime parameters, where values were given for some and it could be asked.
        off: Rules that the options, its guard or the project leave out.
        modules: Those from around it that its rehearsal imported, with their paths.
        rehearsal_s: Time of the rehearsal, s.
        verdict_s: Time from the recording to the verdict, s.
        playback: The rehearsal as a page plays it, where that was asked for.
        unit: What the numbers of lines count: ``"line"``, or ``"command"`` where there are none.
        steps: Of Protocol Designer, by the command's number, where the file tells them.
    """

    file: str
    report: Report | None = None
    problem: Problem | None = None
    lines: tuple[str, ...] = ()
    seconds: float = 0.0
    baselined: tuple[Finding, ...] = ()
    settled: tuple[Remark, ...] = ()
    exploration: Exploration | None = None
    judgement: Judgement | None = None
    dossier: Dossier | None = None
    declared: tuple[str, ...] | None = None
    off: tuple[str, ...] = ()
    modules: Mapping[str, str] = field(default_factory=dict)
    rehearsal_s: float = 0.0
    verdict_s: float = 0.0
    playback: Mapping[str, Any] | None = None
    unit: str = "line"
    steps: Mapping[int, DesignerStep] = field(default_factory=dict)

    def states(self, rule_set: RuleSet) -> dict[str, str]:
        """What became of each rule: ``decided``, ``undecided``, ``not_applicable`` (its assay is
        not this one, or nothing of it occurs), or ``off``; empty where it could not be judged."""
        if self.report is None:
            return {}
        open_ = {one.rule for one in self.undecided}
        decided = {*self.report.judged, *(one.rule for one in self.findings)}
        return {
            rule.id: "off"
            if rule.id in self.off
            else "undecided"
            if rule.id in open_
            else "decided"
            if rule.id in decided
            else "not_applicable"
            for rule in rule_set.rules
        }

    @property
    def verdict(self) -> VerdictWord:
        """``error`` where it could not be judged, or not with all values of its parameters."""
        if self.report is None or (self.exploration and self.exploration.failures):
            return VerdictWord.ERROR
        return self.report.verdict

    @property
    def family(self) -> str:
        """The likeliest assay family, ``""`` if the protocol could not be judged."""
        return self.report.family if self.report else ""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Findings that stand."""
        return self.report.findings if self.report else ()

    @property
    def undecided(self) -> tuple[Undecided, ...]:
        """Rules that could not be judged."""
        return self.report.undecided if self.report else ()

    @property
    def unanswered(self) -> str:
        """Why the model that was asked gave no answer, ``""`` if it did or none was asked."""
        return unanswered(self.report) if self.report else ""

    @property
    def waived(self) -> tuple[Waived, ...]:
        """Findings that a waiver covers."""
        return self.report.waived if self.report else ()

    @property
    def roles(self) -> tuple[RoleEvidence, ...]:
        """Roles of wells, with evidence."""
        return self.report.roles if self.report else ()

    @property
    def notes(self) -> tuple[str, ...]:
        """What there is to say beyond findings: of labware, of what it reaches, of a model."""
        return self.report.notes if self.report else ()

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """Conflicting evidence, waivers that waive nothing, known findings that are gone."""
        return (*(self.report.remarks if self.report else ()), *self.settled)


@dataclass(frozen=True)
class CheckRun:
    """All protocols of one call, with the rules that judged them.

    Attributes:
        protocols: In the order given.
        rule_set: The rules in force.
        version: Of this package.
        explain_roles: Whether roles and their evidence are to be shown.
    """

    protocols: Sequence[CheckedProtocol]
    rule_set: RuleSet
    version: str
    explain_roles: bool = field(default=False)

    @property
    def exit_code(self) -> int:
        """0 clean, 1 findings, 2 a protocol could not be judged or a model did not answer."""
        if any(
            checked.verdict is VerdictWord.ERROR or checked.unanswered for checked in self.protocols
        ):
            return 2
        return 1 if any(checked.findings for checked in self.protocols) else 0


def with_findings(report: Report, findings: Sequence[Finding], **changes: Any) -> Report:
    """A report with other findings and the verdict that follows from them.

    What could not be judged (a model that judges alone gave no answer) stays so.
    """
    verdict = verdict_of(findings)
    if report.verdict is VerdictWord.ERROR:
        verdict = report.verdict
    return dataclasses.replace(report, findings=tuple(findings), verdict=verdict, **changes)
