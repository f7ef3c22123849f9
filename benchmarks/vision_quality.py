"""What Layer 2 finds, leave-one-plate-out, beside the paper's scorer on the same frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from .figure import Figure
from .vision_data import label

SCORERS = ("ensemble", "pca")
TARGETS = {"average_precision": 0.98, "auroc": 0.95, "f1": 0.95}


def figures(datasets: Sequence[Path]) -> Iterator[Figure]:
    """Average precision, AUROC, F1 and flagged normals, with detector boxes.

    The targets are those for p1000 on rendered frames; on other sets none is printed.
    """
    from aegis_ot_lab.evaluation.layer2 import evaluate_layer2

    for folder in datasets:
        for scorer in SCORERS:
            result = evaluate_layer2(folder, scorer)
            tells = scorer == "ensemble" and result.source == "rendered" and "p1000" in folder.name
            values = result.to_json()
            data = f"{result.dataset}, leave one plate out"
            for name, target in TARGETS.items():
                value = values[name]
                yield Figure(
                    f"{scorer}: {name.replace('_', ' ')}", data, label(result.source),
                    value["value"], "", target if tells else None, at_least=True,
                    note=f"95 % interval {value['low']:.3f} to {value['high']:.3f}",
                )  # fmt: skip
            yield Figure(
                f"{scorer}: normal wells flagged", data, label(result.source),
                100 * result.flagged_normals.caught / max(result.flagged_normals.total, 1), "%",
            )  # fmt: skip
