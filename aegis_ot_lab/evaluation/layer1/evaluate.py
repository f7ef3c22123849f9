"""Scores a folder in the protocol benchmark format."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from aegis_ot.errors import DatasetError
from aegis_ot.llm import PriceTable, TokenUsage, load_prices
from aegis_ot.vocabulary import Finding

from .bill import bill_of, cost_of
from .labels import Label
from .metrics import Scores, score
from .overlap import Overlap, add_lines, add_wells
from .predictions import Judge, Prediction
from .result import Layer1Result, ProtocolRow, RuleLevel


def evaluate_layer1(
    folder: Path,
    labels: Sequence[Label],
    judge: Judge,
    judge_name: str,
    *,
    seed: int = 0,
    prices: PriceTable | None = None,
    model: str = "",
    done: Callable[[Prediction], None] = lambda prediction: None,
) -> Layer1Result:
    """Judge every labelled protocol of a folder and score the judgements.

    Args:
        folder: Holds the protocols.
        labels: As :func:`~aegis_ot_lab.evaluation.layer1.labels.read_labels` gives them.
        judge: Judges files.
        judge_name: What to call it: ``"rules-only"``.
        seed: Of the bootstrap.
        prices: What tokens cost; the shipped table if left out.
        model: Who was asked, as the user named it; ``""`` for nobody.
        done: Told of each prediction.
    """
    predictions = judge([folder / label.file for label in labels], done)
    if [prediction.file for prediction in predictions] != [Path(lb.file).name for lb in labels]:
        raise DatasetError(f"{judge_name} did not judge every protocol of {folder}.")
    return score_predictions(
        folder.name, labels, predictions, judge_name, seed=seed, prices=prices, model=model
    )


def score_predictions(
    name: str,
    labels: Sequence[Label],
    predictions: Sequence[Prediction],
    judge_name: str,
    *,
    seed: int = 0,
    prices: PriceTable | None = None,
    model: str = "",
) -> Layer1Result:
    """Score judgements against labels, one prediction per label in the same order.

    A protocol that could not be judged counts as wrong, whatever its label.
    """
    pairs = list(zip(labels, predictions, strict=True))
    prices = prices or load_prices()
    return Layer1Result(
        benchmark=name,
        judge=judge_name,
        seed=seed,
        strict=_protocol_level(pairs, adjusted=False, seed=seed),
        adjusted=_protocol_level(pairs, adjusted=True, seed=seed),
        family_right=sum(label.family == p.family for label, p in pairs),
        rules_strict=_rule_level(pairs, adjusted=False),
        rules_adjusted=_rule_level(pairs, adjusted=True),
        rows=tuple(_row(label, prediction, prices) for label, prediction in pairs),
        model=model,
        bill=bill_of([prediction.reply for prediction in predictions], prices),
    )


Pairs = Sequence[tuple[Label, Prediction]]


def _protocol_level(pairs: Pairs, adjusted: bool, seed: int) -> Scores:
    outcomes = []
    for label, prediction in pairs:
        is_bad = label.is_bad_adjusted if adjusted else label.is_bad
        flagged = not is_bad if prediction.problem else prediction.is_flagged
        outcomes.append((is_bad, flagged))
    return score(outcomes, seed=seed)


def _rule_level(pairs: Pairs, adjusted: bool) -> RuleLevel:
    violations = reported = findings = false = correct = correct_flagged = 0
    wells, lines = Overlap(), Overlap()
    for label, prediction in pairs:
        findings += len(prediction.findings)
        wrong = false_findings(label, prediction)
        false += len(wrong)
        is_bad = label.is_bad_adjusted if adjusted else label.is_bad
        if not is_bad:
            correct += 1
            correct_flagged += bool(wrong)
            continue
        citing = cite(label, prediction)
        violations += len(label.rules)
        reported += len(citing)
        for rule, by in citing.items():
            add_wells(wells, label, rule, by)
            add_lines(lines, label, rule, by)
    return RuleLevel(violations, reported, findings, false, correct, correct_flagged, wells, lines)


def cite(label: Label, prediction: Prediction) -> dict[str, list[Finding]]:
    """Labelled violations that were reported, each with the findings that report it.

    A violation is reported by its own rule, or else by an acceptable one; an acceptable rule
    stands for one violation only.
    """
    by_rule: dict[str, list[Finding]] = {}
    for finding in prediction.findings:
        by_rule.setdefault(finding.rule, []).append(finding)
    citing = {rule: by_rule[rule] for rule in label.rules if rule in by_rule}
    spare = [rule for rule in label.also_acceptable if rule in by_rule and rule not in citing]
    for rule in label.rules:
        if rule not in citing and spare:
            citing[rule] = by_rule[spare.pop(0)]
    return citing


def false_findings(label: Label, prediction: Prediction) -> list[Finding]:
    """Findings whose rule is neither labelled nor acceptable."""
    return [f for f in prediction.findings if f.rule not in label.acceptable]


def _row(label: Label, prediction: Prediction, prices: PriceTable) -> ProtocolRow:
    citing = cite(label, prediction)
    reply = prediction.reply
    return ProtocolRow(
        file=label.file,
        labelled="fail" if label.is_bad else "pass",
        adjusted="fail" if label.is_bad_adjusted else "pass",
        flagged=prediction.is_flagged,
        family=label.family,
        family_found=prediction.family,
        found=tuple(dict.fromkeys(finding.rule for finding in prediction.findings)),
        missed=tuple(rule for rule in label.rules if rule not in citing),
        false=tuple(dict.fromkeys(f.rule for f in false_findings(label, prediction))),
        undecided=tuple(dict.fromkeys(u.rule for u in prediction.undecided)),
        problem=prediction.problem,
        seconds=prediction.seconds,
        usage=reply.usage if reply else TokenUsage(),
        cost=cost_of(reply, prices),
        unanswered="" if reply is None or reply.answered else reply.state.value,
    )
