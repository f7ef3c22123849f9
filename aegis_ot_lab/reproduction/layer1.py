"""Layer 1 ablation: who judges the 24 protocols, and how well (paper, Fig. "Layer 1 ablation")."""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from aegis_ot.llm import Backend, TokenUsage
from aegis_ot.preflight import RuleSet, load_rules
from aegis_ot.workbench import CheckSettings

from ..configurations import AskingConfiguration, asking_in
from ..evaluation.layer1 import (
    Checking,
    Label,
    Layer1Result,
    Prediction,
    draw_ablation,
    evaluate_layer1,
    read_labels,
)
from .context import Context, benchmark_folder
from .experiment import NOT_RUN, Experiment, ExperimentOutcome, ExperimentPicture, table

NO_MODEL = f"{NOT_RUN}: no model; give one with --model NAME, or replay:FOLDER"

RULES = AskingConfiguration.RULES_ONLY.value
ASKING = tuple(c.value for c in (AskingConfiguration.HYBRID, AskingConfiguration.TRACE_BLIND,
                                 AskingConfiguration.LLM_ONLY))  # fmt: skip
PAPER = {
    RULES: "rules only (regex): 0.741",
    "hybrid": "no counterpart: the paper's models see no trace",
    "trace-blind": "rules + LLM: 0.968 to 0.909",
    "llm-only": "LLM only: 0.909 to 0.789",
}


def judge_benchmark(
    context: Context, name: str, labels: list[Label], rule_set: RuleSet,
    configuration: str = RULES, backend: Backend | None = None,
) -> Layer1Result:  # fmt: skip
    """One configuration on one folder of protocols."""

    def done(_: Prediction) -> None:
        context.progress.step()

    who = f"{configuration}, {backend.name}" if backend is not None else configuration
    context.progress.begin(f"Checking {name}, {who}", len(labels))
    asking = None if backend is None else asking_in(configuration, backend)
    return evaluate_layer1(
        benchmark_folder(name).resolve(),
        labels,
        Checking(CheckSettings(asking=asking), rule_set),
        configuration,
        seed=context.options.seed,
        model=backend.name if backend is not None else "",
        done=done,
    )


def labels_of(name: str, rule_set: RuleSet) -> list[Label]:
    """Of a benchmark folder."""
    families = [family.family for family in rule_set.assays]
    return read_labels(benchmark_folder(name), families, [rule.id for rule in rule_set.rules])


def run(context: Context) -> ExperimentOutcome:
    """Judge in every configuration that there is somebody for."""
    rule_set = load_rules()
    labels = labels_of("benchmark", rule_set)
    results = [judge_benchmark(context, "benchmark", labels, rule_set)]
    silent: list[tuple[str, str, str]] = []
    for backend in context.backends:
        for name in ASKING:
            result = judge_benchmark(context, "benchmark", labels, rule_set, name, backend)
            if len(result.unanswered) == len(labels):
                states = {row.unanswered for row in result.rows}
                silent.append((name, backend.name, ", ".join(sorted(states))))
            else:
                results.append(result)
    drawn = draw_ablation(results, context.pictures("layer1"))
    return ExperimentOutcome(
        data=("protocols: examples/benchmark, 24 protocols with planted mistakes",),
        answers=_answers(results, silent),
        tables=(
            table(
                "F1 with 95 % bootstrap intervals over protocols",
                ("who judges", "model", "F1, adjusted", "F1, strict", "recall, adjusted",
                 "false alarms", "paper, adjusted F1"),
                [*_rows(results), *_left_out(results, silent)],
            ),
        ),
        pictures=_pictures(context, drawn),
        notes=tuple(_notes(results)),
        figures={"results": [_figures(result) for result in results]},
        timings={
            f"{result.judge} {result.model}".strip(): [row.seconds for row in result.rows]
            for result in results
        },
    )  # fmt: skip


def _rows(results: list[Layer1Result]) -> Iterator[tuple[str, ...]]:
    for result in results:
        caught = f"{result.adjusted.true_positives}/{_bad(result)}"
        yield (
            "rules with the rehearsed trace, no model" if result.judge == RULES else result.judge,
            result.model or "none",
            str(result.adjusted.f1),
            str(result.strict.f1),
            caught,
            str(result.adjusted.false_positives),
            PAPER[result.judge],
        )


def _bad(result: Layer1Result) -> int:
    return result.adjusted.true_positives + result.adjusted.false_negatives


def _left_out(
    results: list[Layer1Result], silent: list[tuple[str, str, str]]
) -> Iterator[tuple[str, ...]]:
    """Configurations that nobody answered for."""
    ran = {result.judge for result in results} | {name for name, _, _ in silent}
    for name, model, states in silent:
        why = f"{NOT_RUN}: the model gave no answer ({states})"
        yield name, model, why, "", "", "", PAPER[name]
    for name in ASKING:
        if name not in ran:
            yield name, "none", NO_MODEL, "", "", "", PAPER[name]


def _answers(
    results: list[Layer1Result], silent: list[tuple[str, str, str]]
) -> dict[str, tuple[str, ...]]:
    left_out = {row[0]: row[2] for row in _left_out(results, silent)}
    alone = results[0]
    said: dict[str, tuple[str, ...]] = {
        "rules-only": (
            f"{alone.adjusted.f1} adjusted, {alone.strict.f1} strict (rules over the rehearsed "
            f"trace, no regex); {alone.adjusted.false_negatives} bugs missed",
        )
    }
    for row, judges in (("hybrid", ("trace-blind", "hybrid")), ("llm-only", ("llm-only",))):
        found = [
            f"{r.judge}, {r.model}: {r.adjusted.f1}, recall {r.adjusted.true_positives}/{_bad(r)}"
            for judge in judges
            for r in results
            if r.judge == judge
        ]
        said[row] = tuple(found) or (left_out[judges[-1]],)
    mean = statistics.fmean(row.seconds for row in alone.rows)
    asked = [
        f"{statistics.median(row.seconds for row in r.rows):.1f} s with {r.judge}, {r.model}"
        for r in results[1:]
        if r.bill is not None and r.bill.usage != TokenUsage()  # an imported answer has no time
    ]
    said["time"] = (f"{mean:.2f} s without a model", *asked)
    return said


def _notes(results: list[Layer1Result]) -> Iterator[str]:
    yield (
        "The paper's rules-only baseline matches patterns in the source. This package has no such "
        "baseline: its rules judge what the protocol did in Opentrons' simulator. trace-blind is "
        "the paper's own hybrid (a model with rules and source alone); hybrid adds the trace and "
        "lets the model only add to the checks."
    )
    yield (
        "The checks were developed with these 24 protocols in sight: their F1 is no estimate for "
        "protocols that nobody looked at."
    )
    for result in results:
        if result.unanswered:
            count = len(result.unanswered)
            yield f"{result.judge}, {result.model}: {count} protocols without the model's answer."


def _figures(result: Layer1Result) -> dict[str, Any]:
    """All but the times."""
    told = {name: value for name, value in result.to_json().items() if name != "seconds"}
    told["rows"] = [
        {name: value for name, value in row.items() if name != "seconds"} for row in told["rows"]
    ]
    return told


def _pictures(context: Context, drawn: list[Path]) -> tuple[ExperimentPicture, ...]:
    captions = ("Layer 1 ablation, adjusted labels", "Layer 1 ablation, strict labels")
    return tuple(
        ExperimentPicture(context.picture(file), caption)
        for file, caption in zip(drawn, captions, strict=True)
    )


EXPERIMENT = Experiment(
    "layer1",
    "Layer 1 ablation",
    "Layer 1 results, Fig. ablation",
    ("hybrid", "llm-only", "rules-only", "time"),
    ("models",),
    run,
)
