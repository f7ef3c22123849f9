"""How many rules, and what the benchmark holds: counts of what ships."""

from __future__ import annotations

from aegis_ot.preflight import load_rules

from ..evaluation.layer1 import read_labels
from .context import Context, benchmark_folder
from .experiment import Experiment, ExperimentOutcome, table


def run(context: Context) -> ExperimentOutcome:
    """Count."""
    rule_set = load_rules()
    families = [family.family for family in rule_set.assays]
    rules = {family.family: len(family.rules) for family in rule_set.assays}
    known = families, [rule.id for rule in rule_set.rules]
    labels = read_labels(benchmark_folder("benchmark"), *known)
    several = read_labels(benchmark_folder("benchmark-multi"), *known)
    bad = [label for label in labels if label.is_bad]
    relabelled = [label.file for label in labels if label.is_bad_adjusted and not label.is_bad]
    figures = {
        "rules": rules,
        "protocols": len(labels),
        "correct": len(labels) - len(bad),
        "with_one_bug": sum(len(label.rules) == 1 for label in bad),
        "with_several_bugs": {label.file: len(label.rules) for label in several},
        "relabelled": relabelled,
    }
    bugs = sum(len(label.rules) for label in several)
    return ExperimentOutcome(
        data=("protocols: the rule database and the benchmark of this version",),
        answers={
            "rules": (f"{sum(rules.values())} over {len(rules)} assay families",),
            "benchmark": (
                f"{len(labels)} protocols: {figures['correct']} correct, {len(bad)} with one bug "
                f"each; {len(several)} more with 2-3 bugs, {bugs} in all",
            ),
            "scoring": (
                f"{len(relabelled)} tutorial protocols ({', '.join(relabelled)}) pass in strict "
                "and fail in adjusted scoring",
            ),
        },
        tables=(table("Rules by family", ("family", "rules"), list(rules.items())),),
        notes=(
            "The paper's protocols are not published with it: these were written to its "
            "description, and so are the rules.",
        ),
        figures=figures,
    )


EXPERIMENT = Experiment(
    "rules",
    "Rules and protocol benchmark",
    "Methods, Benchmark and Layer 1",
    ("rules", "benchmark", "scoring"),
    (),
    run,
)
