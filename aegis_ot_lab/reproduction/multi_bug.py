"""Several mistakes in one protocol: is each one reported? (paper, Layer 1 results)"""

from __future__ import annotations

from aegis_ot.preflight import load_rules

from ..evaluation.layer1 import Layer1Result
from .context import Context
from .experiment import Experiment, ExperimentOutcome, table
from .layer1 import judge_benchmark, labels_of

FOLDER = "benchmark-multi"


def run(context: Context) -> ExperimentOutcome:
    """Judge the three protocols by the rules, and by each model that answers."""
    rule_set = load_rules()
    labels = labels_of(FOLDER, rule_set)
    results = [judge_benchmark(context, FOLDER, labels, rule_set)]
    for backend in context.backends:
        result = judge_benchmark(context, FOLDER, labels, rule_set, "hybrid", backend)
        if len(result.unanswered) < len(labels):
            results.append(result)
    return ExperimentOutcome(
        data=(f"protocols: examples/{FOLDER}, {len(labels)} protocols",),
        answers={"multi-bug": tuple(map(_short, results))},
        tables=(
            table(
                "By protocol (the paper: 8/8 and one more that the bugs would cause)",
                ("who judges", "protocol", "planted", "missed", "beside them"),
                [
                    (
                        f"{result.judge} {result.model}".strip(),
                        row.file,
                        ", ".join(label.rules),
                        ", ".join(row.missed) or "none",
                        ", ".join(sorted(set(row.found) - set(label.rules))) or "none",
                    )
                    for result in results
                    for label, row in zip(labels, result.rows, strict=True)
                ],
            ),
        ),
        figures={
            f"{result.judge} {result.model}".strip(): {
                "planted": result.rules_strict.violations,
                "reported": result.rules_strict.reported,
                "false_findings": result.rules_strict.false_findings,
            }
            for result in results
        },
    )


def _short(result: Layer1Result) -> str:
    level = result.rules_strict
    who = f"{result.judge}, {result.model}" if result.model else "rules without a model"
    return f"{level.reported}/{level.violations} found, {level.false_findings} false ({who})"


EXPERIMENT = Experiment(
    "multi-bug", "Several mistakes at once", "Layer 1 results", ("multi-bug",), ("models",), run
)
