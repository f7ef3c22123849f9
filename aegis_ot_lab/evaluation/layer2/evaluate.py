"""Evaluate a scorer on a data set: leave-one-plate-out, with a threshold or with the cascade."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from aegis_ot.errors import ConfigurationError, DatasetError
from aegis_ot.progress import Progress
from aegis_ot.vision.dataset import Dataset, TrueBoxes, load_dataset
from aegis_ot.vision.gates import ConfirmingGate
from aegis_ot.vision.types import Detector, Scorer
from aegis_ot.vocabulary import Gate
from aegis_ot.worldmodel.cascade import run_cascade
from aegis_ot.worldmodel.leave_one_out import hold_out
from aegis_ot_lab.found_tips import FoundTips, find_tips

from ...scorers import BASELINES, make_scorer
from .answers import CountedGate, ModelAnswers
from .result import Layer2Result, summarise

PROTOCOLS = ("lopo", "cascade")
THRESHOLDS = ("first-normal", "pooled", "p-value")
LEAVE_OUT = ("plate", "camera")


def evaluate_layer2(
    dataset: Dataset | str | Path,
    scorer: str = "ensemble",
    protocol: str = "lopo",
    detector: Detector | TrueBoxes | str = "default",
    *,
    threshold: str = "",
    leave_out: str = "plate",
    make: Callable[[], Scorer] | None = None,
    seed: int = 0,
    tips: FoundTips | None = None,
    gates: Sequence[ConfirmingGate] = (),
    progress: Progress | None = None,
) -> Layer2Result:
    """Evaluate one scorer, leaving one plate out at a time.

    Args:
        dataset: A data set, or its folder.
        scorer: Name of the scorer (:data:`~aegis_ot.vision.scorers.SCORERS`).
        protocol: ``"lopo"``: a well is flagged by its plate's threshold. ``"cascade"``: a well
            is judged as a live run judges it (see :mod:`.cascade`); flagged is what it fails or
            leaves to the operator.
        detector: ``"default"``, a detector file, ``"true"`` for the labelled boxes, or a
            detector.
        threshold: ``"first-normal"`` (the default for the paper's scorers), ``"p-value"`` (for
            those whose score is one) or ``"pooled"``; see :func:`~.lopo.hold_out`.
        leave_out: ``"camera"``: the model that judges a plate saw no plate of its kind of camera
            (``cameras`` in ``meta.json``).
        make: Makes the scorer in ``make_scorer``'s place.
        seed: Of the bootstrap.
        tips: What :func:`find_tips` found in this set, in ``detector``'s place: several scorers
            then share what was read from the frames.
        gates: Of the cascade, asked after the volumetric gate: a vision model, say.
        progress: Told how far it is.

    Raises:
        ConfigurationError: If a name is not known.
        DatasetError: If the set is faulty, has fewer than two plates, or does not name the cameras
            that are to be left out.
        ModelError: If the detector's file cannot be used.
    """
    if leave_out not in LEAVE_OUT:
        raise ConfigurationError(f"leave_out {leave_out!r} is not one of {', '.join(LEAVE_OUT)}")
    if protocol not in PROTOCOLS:
        raise ConfigurationError(f"protocol {protocol!r} is not one of {', '.join(PROTOCOLS)}")
    build = make or (lambda: make_scorer(scorer))
    threshold = threshold or own_threshold(scorer, build)
    if threshold not in THRESHOLDS:
        raise ConfigurationError(f"threshold {threshold!r} is not one of {', '.join(THRESHOLDS)}")
    data = dataset if isinstance(dataset, Dataset) else load_dataset(dataset)
    tips = tips or find_tips(data, detector, progress)
    kinds = cameras_of(data) if leave_out == "camera" else None
    held = hold_out(tips.samples, build, threshold, progress, kinds=kinds)
    wells = list(held.wells)
    routed = flagged = [well.flagged for well in wells]
    settled: Counter[str] = Counter()
    model: ModelAnswers | None = None
    if protocol == "cascade":
        counting = [CountedGate(gate) for gate in gates]
        judged = [well for well in run_cascade(held, counting, tips.finder) if not well.calibration]
        model = next((gate.answers for gate in counting if gate.gate.traits.is_model), None)
        wells = [well.scored for well in judged]
        routed = [well.to_gate for well in judged]
        flagged = [well.flagged for well in judged]
        settled.update(
            f"{well.verdict.gate.value}_{well.verdict.outcome.value}"
            if well.verdict.gate is not Gate.NONE
            else well.verdict.route.value
            for well in judged
        )
    return summarise(
        wells,
        flagged,
        routed,
        held=held,
        seed=seed,
        settled=settled,
        leave_out=leave_out,
        cameras=data.cameras,
        model=model,
        dataset=data.name,
        source=data.source,
        scorer=scorer,
        protocol=protocol,
        threshold=threshold,
        detector=tips.detector,
    )


def cameras_of(data: Dataset) -> Mapping[str, str]:
    """The kind of camera of each plate.

    Raises:
        DatasetError: If ``meta.json`` does not name it for every plate, or names one kind only.
    """
    cameras = data.cameras
    if unnamed := [plate for plate in data.plates if plate not in cameras]:
        raise DatasetError(
            f'{data.root / "meta.json"}: "cameras" names no kind of camera for '
            f'{", ".join(unnamed[:5])}; add {{"cameras": {{"{unnamed[0]}": "KIND"}}}}, '
            "or leave one plate out"
        )
    if len({cameras[plate] for plate in data.plates}) < 2:
        raise DatasetError(
            f'{data.root / "meta.json"}: "cameras" names one kind only; leaving one out needs two'
        )
    return cameras


def own_threshold(scorer: str, make: Callable[[], Scorer]) -> str:
    """The threshold that a scorer is meant to be used with."""
    if scorer in BASELINES:
        return "first-normal"
    return "p-value" if hasattr(make(), "p_value") else "pooled"
