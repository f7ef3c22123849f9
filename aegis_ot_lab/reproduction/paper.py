"""The paper's results, row by row: what every figure of ours stands beside.

From "AEGIS: Assay-Aware Protocol Validation and Runtime Monitoring for Open-Source Liquid Handling
Robots" (Setty, Ramanathan, Foster, Stevens).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class PaperRow:
    """One result of the paper.

    Attributes:
        key: What the experiments call it.
        what: What it is of.
        result: What the paper reports.
        place: Where in the paper.
    """

    key: str
    what: str
    result: str
    place: str


_BACKENDS = "o4-mini, Nemotron-3 Ultra, Claude Opus 4: {}; GPT-4o: {}; Claude Sonnet 4.5: {}"

ROWS = (
    PaperRow("rules", "Rules", "22 over five assay families", "Methods, Layer 1"),
    PaperRow(
        "benchmark",
        "Protocol benchmark",
        "24 protocols: 11 correct, 13 with one injected bug each; 3 more with 2-3 bugs, 8 in all",
        "Methods, Benchmark",
    ),
    PaperRow(
        "hybrid",
        "Layer 1, rules and LLM: adjusted F1, recall",
        _BACKENDS.format("0.968", "0.938", "0.909") + "; recall 13/13 for all",
        "Layer 1 results",
    ),
    PaperRow("llm-only", "Layer 1, LLM only: F1", "0.909 to 0.789", "Layer 1 results"),
    PaperRow(
        "rules-only", "Layer 1, rules only: F1", "0.741 (regex), five bugs missed",
        "Layer 1 results",
    ),
    PaperRow("multi-bug", "Several bugs at once", "8/8 found, one legitimate extra",
             "Layer 1 results"),
    PaperRow("time", "Time per protocol", "about 6 s (GPT-4o) to 57 s (open weights)",
             "Layer 1 results"),
    PaperRow(
        "scoring", "Strict and adjusted scoring", "two tutorial protocols relabelled as buggy",
        "Methods, Benchmark",
    ),
    PaperRow(
        "data",
        "Layer 2 data",
        "64 p1000 trajectories on 16 plates: 26 normal, 36 failures, 2 no-tip; red, yellow, "
        "water; a matched p20 set (real OT-2 frames)",
        "Methods, Data",
    ),
    PaperRow(
        "detector", "Tip detector",
        "YOLOv8-nano on 69 labelled frames: mAP50 0.995, about 2 min on one GPU",
        "Methods, Tip detection",
    ),
    PaperRow(
        "world-model", "World model",
        "four 48x48 grey crops, 9,216-vector, PCA with k = 15: 97.7 % of variance",
        "Methods, PCA",
    ),
    PaperRow(
        "lopo",
        "Leave one plate out, p1000",
        "AP 0.887 [0.799, 0.949], AUROC 0.804 [0.685, 0.902], F1 0.708, precision 0.793, "
        "recall 0.639 (23/36; 6 false positives on 10 normals)",
        "Layer 2 evaluation",
    ),
    PaperRow(
        "failure-types",
        "Recall by failure type and reagent",
        "25 % dispensed 3/3, 50 % 2/3, 75 % 1/3, single and accumulated 11/15, no dispense 5/6, "
        "air bubble 1/6; red 8/12, yellow 7/12, water 8/12",
        "Layer 2 evaluation",
    ),
    PaperRow("p20", "Leave one plate out, p20", "AP 0.771, AUROC 0.666, F1 0.468, recall 0.306",
             "Layer 2 evaluation"),
    PaperRow(
        "components", "Component sweep",
        "k = 2 to 25: F1 flat from 15 on, threshold falls by 1e12 from 15 to 25", "SI C",
    ),
    PaperRow(
        "baselines", "Baselines and negative results",
        "isolation forest, one-class SVM, autoencoder, uncalibrated VLM, single-frame PCA, "
        "15-dimensional Mahalanobis: all worse than PCA",
        "SI B",
    ),
    PaperRow(
        "calibration", "Calibration",
        "first six wells; silent-pass band median ± 0.7·MAD; blank floor 1e-4",
        "Methods, Cascade",
    ),
    PaperRow(
        "live-cascade", "Live, cascade",
        "partial dispense 3/5 red, 3/5 yellow, 0/5 water; no aspirate 3/5; no tip 5/5; "
        "one false pause",
        "Live demonstration",
    ),
    PaperRow(
        "live-always", "Live, always-VLM",
        "partial dispense 5/5 red, 5/5 yellow, 1/5 water; no aspirate 2/5",
        "Live demonstration",
    ),
    PaperRow(
        "routed", "Routed to the VLM, and what it costs",
        "15.7 % of wells; $0.108 a call; $1.63 a plate against $10.33 for always-VLM",
        "Live demonstration, Cost",
    ),
    PaperRow(
        "latency", "Latency",
        "9.5 s to the pause call (4.0 s frame wait + 5.5 s VLM); 13.27 ± 0.47 s to the halt",
        "Live demonstration, Latency",
    ),
    PaperRow(
        "fleet", "Fleet",
        "N = 1, 2, 4, 8, 16: 157.5, 86.0, 45.4, 29.2, 20.1 s; 7.84x; 15/16 detected throughout",
        "SI A",
    ),
)  # fmt: skip
