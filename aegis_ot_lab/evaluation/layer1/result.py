"""What an evaluation of Layer 1 found, and how it is written down."""

from __future__ import annotations

import dataclasses
import statistics
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from aegis_ot.llm import TokenUsage
from aegis_ot.vocabulary import counted

from .bill import Bill
from .metrics import Scores
from .overlap import Overlap


@dataclass(frozen=True)
class RuleLevel:
    """Scores of findings.

    Attributes:
        violations: Labelled violations.
        reported: Of these, how many were reported with an acceptable rule.
        findings: Findings made.
        false_findings: Of these, how many carry a rule that is neither labelled nor acceptable.
        correct: Correct protocols.
        correct_with_false: Of these, how many have false findings.
        wells: Overlap of wells.
        lines: Overlap of source lines.
    """

    violations: int
    reported: int
    findings: int
    false_findings: int
    correct: int
    correct_with_false: int
    wells: Overlap
    lines: Overlap


@dataclass(frozen=True)
class ProtocolRow:
    """One protocol.

    Attributes:
        file: Its file.
        labelled: Strict label.
        adjusted: Adjusted label.
        flagged: Whether it was flagged.
        family: Labelled family.
        family_found: Family found.
        found: Rules found.
        missed: Labelled rules that were not reported.
        false: Rules that were found and are neither labelled nor acceptable.
        undecided: Rules left undecided.
        problem: Why it could not be judged, or ``""``.
        seconds: Time taken, s.
        usage: Tokens of a model.
        cost: Of a model, in the price table's currency; ``None`` if it is not known.
        unanswered: How asking a model ended, where it gave no answer.
    """

    file: str
    labelled: str
    adjusted: str
    flagged: bool
    family: str
    family_found: str
    found: tuple[str, ...]
    missed: tuple[str, ...]
    false: tuple[str, ...]
    undecided: tuple[str, ...]
    problem: str
    seconds: float
    usage: TokenUsage = field(default_factory=TokenUsage)
    cost: float | None = 0.0
    unanswered: str = ""


@dataclass(frozen=True)
class Layer1Result:
    """Result of one judge on one folder.

    Attributes:
        benchmark: Name of the folder.
        judge: Who judged: ``"rules-only"``, ``"hybrid"``.
        seed: Of the bootstrap.
        strict: Protocol level, strict labels.
        adjusted: Protocol level, adjusted labels.
        family_right: Protocols whose family was found.
        rules_strict: Rule level, strict labels.
        rules_adjusted: Rule level, adjusted labels.
        rows: One per protocol.
        model: Who was asked, as the user named it; ``""`` for nobody.
        bill: What that took; ``None`` if no model was asked.
    """

    benchmark: str
    judge: str
    seed: int
    strict: Scores
    adjusted: Scores
    family_right: int
    rules_strict: RuleLevel
    rules_adjusted: RuleLevel
    rows: tuple[ProtocolRow, ...]
    model: str = ""
    bill: Bill | None = None

    @property
    def unjudged(self) -> tuple[ProtocolRow, ...]:
        """Protocols that could not be judged."""
        return tuple(row for row in self.rows if row.problem)

    @property
    def unanswered(self) -> tuple[ProtocolRow, ...]:
        """Protocols about which a model was asked in vain."""
        return tuple(row for row in self.rows if row.unanswered)

    @property
    def names_rules(self) -> bool:
        """Whether the judge knew the rules; else its findings cannot name the right ones."""
        return self.judge != "llm-only"

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        seconds = [row.seconds for row in self.rows]
        return {
            "benchmark": self.benchmark,
            "judge": self.judge,
            "model": self.model or None,
            "seed": self.seed,
            "protocols": len(self.rows),
            "unjudged": [row.file for row in self.unjudged],
            "unanswered": {row.file: row.unanswered for row in self.unanswered},
            "strict": _scores(self.strict),
            "adjusted": _scores(self.adjusted),
            "family_accuracy": self.family_right / len(self.rows),
            "rule_level": {
                "strict": _rule_level(self.rules_strict),
                "adjusted": _rule_level(self.rules_adjusted),
            }
            if self.names_rules
            else None,
            "seconds": {
                "mean": statistics.fmean(seconds),
                "median": statistics.median(seconds),
                "max": max(seconds),
            },
            "asked": None if self.bill is None else self.bill.to_json(),
            "rows": [dataclasses.asdict(row) for row in self.rows],
        }

    def text(self) -> str:
        """For people: the mistakes, then the scores."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        for row in self.rows:
            mistakes = list(_mistakes(row, self.names_rules))
            if mistakes:
                yield f"{row.file}: {'; '.join(mistakes)}"
        total = counted(len(self.rows), "protocol")
        judge = f"{self.judge} ({self.model})" if self.model else self.judge
        yield f"{self.benchmark}, {judge}: {total}, 95 % bootstrap intervals"
        for name, scores in (("strict", self.strict), ("adjusted", self.adjusted)):
            yield (
                f"  {name:9} F1 {scores.f1}  precision {scores.precision}  recall {scores.recall}"
                f"  (TP {scores.true_positives}, FP {scores.false_positives}, "
                f"FN {scores.false_negatives}, TN {scores.true_negatives})"
            )
        yield f"  family    {self.family_right}/{len(self.rows)} right"
        yield from self._rule_lines()
        seconds = [row.seconds for row in self.rows]
        yield (
            f"  seconds   {statistics.fmean(seconds):.2f} mean, "
            f"{statistics.median(seconds):.2f} median, {max(seconds):.2f} longest"
        )
        if self.bill is None:
            yield "  model     none asked"
        else:
            yield from self.bill.lines()
        if self.unanswered:
            states = ", ".join(f"{row.file} {row.unanswered}" for row in self.unanswered[:8])
            more = f" and {len(self.unanswered) - 8} more" if len(self.unanswered) > 8 else ""
            yield f"  {len(self.unanswered)} without the model's answer: {states}{more}"
        if self.unjudged:
            yield f"  {len(self.unjudged)} could not be judged and count as wrong"

    def _rule_lines(self) -> Iterator[str]:
        if not self.names_rules:
            yield "  rules     withheld from this judge, so not scored"
            return
        for name, level in (("strict", self.rules_strict), ("adjusted", self.rules_adjusted)):
            yield (
                f"  rules, {name}: {level.reported}/{level.violations} violations reported, "
                f"{level.false_findings}/{level.findings} findings false, on "
                f"{level.correct_with_false}/{level.correct} correct protocols"
            )
        yield f"  wells     {self.rules_adjusted.wells}"
        yield f"  lines     {self.rules_adjusted.lines}"


def _mistakes(row: ProtocolRow, names_rules: bool) -> Iterator[str]:
    if row.problem:
        yield f"cannot be judged: {' '.join(row.problem.split())}"
        return
    wrong = row.flagged != (row.adjusted == "fail")
    told = f"labelled {row.adjusted}, {'flagged' if row.flagged else 'not flagged'}"
    if not names_rules:
        if wrong:
            yield told
    elif row.missed and row.adjusted == "fail":
        found = f" (found {', '.join(row.found)})" if row.found else ""
        undecided = [rule for rule in row.missed if rule in row.undecided]
        open_ = f" (undecided: {', '.join(undecided)})" if undecided else ""
        yield f"missed {', '.join(row.missed)}{found}{open_}"
    elif wrong and not row.false:
        yield told
    if names_rules and row.false:
        yield f"false {', '.join(row.false)}"
    if row.family != row.family_found:
        yield f"family {row.family} taken for {row.family_found or 'none'}"


def _scores(scores: Scores) -> dict[str, Any]:
    return {
        "true_positives": scores.true_positives,
        "false_positives": scores.false_positives,
        "false_negatives": scores.false_negatives,
        "true_negatives": scores.true_negatives,
        "precision": scores.precision.to_json(),
        "recall": scores.recall.to_json(),
        "f1": scores.f1.to_json(),
    }


def _rule_level(level: RuleLevel) -> dict[str, Any]:
    return {
        "violations": level.violations,
        "reported": level.reported,
        "findings": level.findings,
        "false_findings": level.false_findings,
        "correct": level.correct,
        "correct_with_false_findings": level.correct_with_false,
        "wells": level.wells.to_json(),
        "lines": level.lines.to_json(),
    }
