"""Evaluate a scorer on a data set: leave-one-plate-out, with a threshold or with the cascade."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from ...errors import ConfigurationError
from ...vision.column_reader import MeasuredColumns
from ...vision.dataset import Dataset, TrueBoxes, first_normals, load_dataset
from ...vision.gates import Case, VolumetricGate
from ...vision.measuring import TipView
from ...vision.scorers import BASELINES, make_scorer
from ...vision.tips import pipette_class, tip_for
from ...vision.types import Detector, Scorer, TrajectorySample
from ...vocabulary import KeyframeKind, Outcome, Route
from .lopo import ScoredWell, hold_out
from .result import Layer2Result, summarise

PROTOCOLS = ("lopo", "cascade")
THRESHOLDS = ("first-normal", "pooled", "p-value")


def evaluate_layer2(
    dataset: Dataset | str | Path,
    scorer: str = "ensemble",
    protocol: str = "lopo",
    detector: Detector | TrueBoxes | str = "default",
    *,
    threshold: str = "",
    make: Callable[[], Scorer] | None = None,
    seed: int = 0,
) -> Layer2Result:
    """Evaluate one scorer, leaving one plate out at a time.

    Args:
        dataset: A data set, or its folder.
        scorer: Name of the scorer (:data:`~aegis_ot.vision.scorers.SCORERS`).
        protocol: ``"lopo"``: a well is flagged by its plate's threshold. ``"cascade"``: a well
            beyond the threshold, or without a tip, goes to the volumetric gate, which knows the
            plate's first normal; flagged is what the gate fails or leaves to the operator.
        detector: ``"default"``, a detector file, ``"true"`` for the labelled boxes, or a
            detector.
        threshold: ``"first-normal"`` (the default for the paper's scorers), ``"p-value"`` (for
            those whose score is one) or ``"pooled"``; see :func:`~.lopo.hold_out`.
        make: Makes the scorer in ``make_scorer``'s place.
        seed: Of the bootstrap.

    Raises:
        ConfigurationError: If a name is not known.
        DatasetError: If the set is faulty or has fewer than two plates.
        ModelError: If the detector's file cannot be used.
    """
    if protocol not in PROTOCOLS:
        raise ConfigurationError(f"protocol {protocol!r} is not one of {', '.join(PROTOCOLS)}")
    build = make or (lambda: make_scorer(scorer))
    if not threshold:
        own = "p-value" if hasattr(build(), "p_value") else "pooled"
        threshold = "first-normal" if scorer in BASELINES else own
    if threshold not in THRESHOLDS:
        raise ConfigurationError(f"threshold {threshold!r} is not one of {', '.join(THRESHOLDS)}")
    data = dataset if isinstance(dataset, Dataset) else load_dataset(dataset)
    finder, finder_name = find_detector(data, detector)
    samples = data.samples(finder)
    wells = hold_out(samples, build, threshold)
    routed = [well.flagged for well in wells]
    flagged, settled = routed, Counter[str]()
    if protocol == "cascade":
        flagged, settled = _gate(samples, wells, p_values=threshold == "p-value")
    return summarise(
        wells,
        flagged,
        routed,
        seed=seed,
        settled=settled,
        dataset=data.name,
        source=data.source,
        scorer=scorer,
        protocol=protocol,
        threshold=threshold,
        detector=finder_name,
    )


def find_detector(
    data: Dataset, detector: Detector | TrueBoxes | str
) -> tuple[Detector | TrueBoxes, str]:
    """The detector that is meant, and what to call it."""
    if not isinstance(detector, str):
        return detector, str(getattr(detector, "name", type(detector).__name__))
    if detector == "true":
        return data.true_boxes(), TrueBoxes.name
    from ...vision.detection import load_detector

    return load_detector(detector), f"detector {Path(detector).name}"


def _gate(
    samples: Sequence[TrajectorySample], wells: Sequence[ScoredWell], p_values: bool
) -> tuple[list[bool], Counter[str]]:
    """Send routed wells through the volumetric gate; undecided ones stay flagged."""
    first = first_normals(samples)
    gate = VolumetricGate()
    readers: dict[str, MeasuredColumns] = {}
    flagged: list[bool] = []
    settled: Counter[str] = Counter()
    for well in wells:
        sample = well.sample
        if not well.flagged:
            settled["silent_pass"] += 1
            flagged.append(False)
            continue
        if sample.plate not in readers:
            readers[sample.plate] = MeasuredColumns()
            anchor = first[sample.plate]
            readers[sample.plate].learn(_looks(readers[sample.plate], anchor), anchor.expected_ul)
        reader = readers[sample.plate]
        missing = tuple(kind for kind in KeyframeKind if sample.detections[kind] is None)
        readings = reader.read(_looks(reader, sample), sample.expected_ul)
        p_value = math.exp(-well.score) if p_values else None
        case = Case(sample, Route.GREY_ZONE, {}, readings, missing, p_value=p_value)
        outcome = gate.examine(case).outcome
        settled[f"gate_{outcome.value}"] += 1
        flagged.append(outcome is not Outcome.PASS)
    return flagged, settled


def _looks(reader: MeasuredColumns, sample: TrajectorySample) -> dict[KeyframeKind, object]:
    tip = tip_for(sample.pipette)
    looks: dict[KeyframeKind, object] = {}
    for kind in KeyframeKind:
        detection = sample.detections[kind]
        if detection is not None:
            expected = sample.expected_ul[kind]
            pipette = pipette_class(sample.pipette)
            looks[kind] = reader.look(
                TipView(kind, sample.frames[kind], detection, tip, pipette, expected)
            )
    return looks
