"""What an evaluation of Layer 1 found, and how it is written down."""

from __future__ import annotations

import dataclasses
import statistics
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

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
class Row:
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
        tokens: Of a model.
        cost_usd: Of a model.
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
    tokens: int = 0
    cost_usd: float = 0.0

    @property
    def is_right(self) -> bool:
        """Nothing missed, nothing false, the family right, by the adjusted label."""
        return (
            not self.problem
            and self.flagged == (self.adjusted == "fail")
            and not (self.missed and self.adjusted == "fail")
            and not self.false
            and self.family == self.family_found
        )


@dataclass(frozen=True)
class Layer1Result:
    """Result of one judge on one folder.

    Attributes:
        benchmark: Name of the folder.
        judge: Who judged: ``"rules-only"``.
        seed: Of the bootstrap.
        strict: Protocol level, strict labels.
        adjusted: Protocol level, adjusted labels.
        family_right: Protocols whose family was found.
        rules_strict: Rule level, strict labels.
        rules_adjusted: Rule level, adjusted labels.
        rows: One per protocol.
    """

    benchmark: str
    judge: str
    seed: int
    strict: Scores
    adjusted: Scores
    family_right: int
    rules_strict: RuleLevel
    rules_adjusted: RuleLevel
    rows: tuple[Row, ...]

    @property
    def unjudged(self) -> tuple[Row, ...]:
        """Protocols that could not be judged."""
        return tuple(row for row in self.rows if row.problem)

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        seconds = [row.seconds for row in self.rows]
        return {
            "benchmark": self.benchmark,
            "judge": self.judge,
            "seed": self.seed,
            "protocols": len(self.rows),
            "unjudged": [row.file for row in self.unjudged],
            "strict": _scores(self.strict),
            "adjusted": _scores(self.adjusted),
            "family_accuracy": self.family_right / len(self.rows),
            "rule_level": {
                "strict": _rule_level(self.rules_strict),
                "adjusted": _rule_level(self.rules_adjusted),
            },
            "seconds": {
                "mean": statistics.fmean(seconds),
                "median": statistics.median(seconds),
                "max": max(seconds),
            },
            "tokens": sum(row.tokens for row in self.rows),
            "cost_usd": sum(row.cost_usd for row in self.rows),
            "rows": [dataclasses.asdict(row) for row in self.rows],
        }

    def text(self) -> str:
        """For people: the mistakes, then the scores."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        for row in self.rows:
            if not row.is_right:
                yield f"{row.file}: {'; '.join(_mistakes(row))}"
        total = len(self.rows)
        yield f"{self.benchmark}, {self.judge}: {total} protocols, 95 % bootstrap intervals"
        for name, scores in (("strict", self.strict), ("adjusted", self.adjusted)):
            yield (
                f"  {name:9} F1 {scores.f1}  precision {scores.precision}  recall {scores.recall}"
                f"  (TP {scores.true_positives}, FP {scores.false_positives}, "
                f"FN {scores.false_negatives}, TN {scores.true_negatives})"
            )
        yield f"  family    {self.family_right}/{total} right"
        for name, level in (("strict", self.rules_strict), ("adjusted", self.rules_adjusted)):
            yield (
                f"  rules, {name}: {level.reported}/{level.violations} violations reported, "
                f"{level.false_findings}/{level.findings} findings false, on "
                f"{level.correct_with_false}/{level.correct} correct protocols"
            )
        yield f"  wells     {self.rules_adjusted.wells}"
        yield f"  lines     {self.rules_adjusted.lines}"
        seconds = [row.seconds for row in self.rows]
        yield (
            f"  seconds   {statistics.fmean(seconds):.2f} mean, "
            f"{statistics.median(seconds):.2f} median, {max(seconds):.2f} longest"
        )
        tokens = sum(row.tokens for row in self.rows)
        cost = sum(row.cost_usd for row in self.rows)
        yield f"  model     {f'{tokens} tokens, ${cost:.3f}' if tokens else 'none asked'}"
        if self.unjudged:
            yield f"  {len(self.unjudged)} could not be judged and count as wrong"


def _mistakes(row: Row) -> Iterator[str]:
    if row.problem:
        yield f"cannot be judged: {' '.join(row.problem.split())}"
        return
    if row.missed and row.adjusted == "fail":
        found = f" (found {', '.join(row.found)})" if row.found else ""
        undecided = [rule for rule in row.missed if rule in row.undecided]
        told = f" (undecided: {', '.join(undecided)})" if undecided else ""
        yield f"missed {', '.join(row.missed)}{found}{told}"
    elif row.flagged != (row.adjusted == "fail") and not row.false:
        yield f"labelled {row.adjusted}, {'flagged' if row.flagged else 'not flagged'}"
    if row.false:
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
