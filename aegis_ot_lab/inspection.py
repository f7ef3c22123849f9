"""A trajectory data set, judged well by well, for a person to look at."""

from __future__ import annotations

from collections.abc import Sequence

from aegis_ot.inspection.choosing import pictured
from aegis_ot.progress import Progress
from aegis_ot.run_view.levels import expected_level, measured_level
from aegis_ot.run_view.pictures import close_up, whole_frame
from aegis_ot.run_view.scores import band_in, signs_in
from aegis_ot.run_view.wells import Box, Inspection, SeenFrame, SeenWell
from aegis_ot.vision.dataset import Dataset, first_normals
from aegis_ot.vision.types import Scorer, TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.cascade import JudgedWell, run_cascade
from aegis_ot.worldmodel.leave_one_out import HeldOut, ScoredWell, hold_out, score_with
from aegis_ot_lab.found_tips import find_tips

from .evaluation.layer2.evaluate import own_threshold
from .scorers import make_scorer


def inspect_dataset(
    data: Dataset,
    scorer: str = "ensemble",
    fitted: Scorer | None = None,
    boxes: str = "default",
    most: int = 200,
    progress: Progress | None = None,
) -> Inspection:
    """Judge a data set with the cascade, and gather what a person wants to see.

    Args:
        data: The set. With two plates or more each is judged by a model of the others' normals;
            one plate alone, without a fitted scorer, by its measured columns only.
        scorer: Name of the scorer.
        fitted: A fitted scorer, in its place.
        boxes: ``"default"``, a detector file, or ``"true"``.
        most: Wells with pictures at most; the others keep their numbers. Flagged and wrongly
            judged ones come first.
        progress: Told how far it is.

    Raises:
        ConfigurationError: There is no such scorer.
        DatasetError: The set cannot be judged.
        ModelError: A detector's file cannot be used.
    """
    progress = progress or Progress()
    make_scorer(scorer)  # a name that makes no sense is told before anything is looked for
    tips = find_tips(data, boxes, progress)
    notes = []
    if fitted is not None:
        held = score_with(tips.samples, fitted, progress)
        how = f"{fitted.name}, a fitted model"
    elif len(data.plates) > 1:
        held = hold_out(
            tips.samples,
            lambda: make_scorer(scorer),
            own_threshold(scorer, lambda: make_scorer(scorer)),
            progress,
        )
        how = f"{scorer}, fitted on the other plates' normals"
    else:
        held = _unscored(tips.samples)
        how = "none"
        notes.append(
            "One plate alone gives no model of what is normal: there are no scores, and the wells "
            "are judged by their measured columns. Name a world model (aegis-ot fit) to score them."
        )
    judged = run_cascade(held, detector=tips.finder)
    order = {record.id: place for place, record in enumerate(data.records)}
    judged.sort(key=lambda well: order[well.sample.id])
    chosen = pictured([(well.flagged, well.flagged != well.scored.failed) for well in judged], most)
    progress.begin("Cutting pictures", len(judged))
    wells = []
    for well, show in zip(judged, chosen, strict=True):
        wells.append(_well(data, well, show, scored=how != "none"))
        progress.step()
    facts = [
        ("frames", data.source),
        ("tips found by", tips.detector),
        ("scores", how),
        ("plates", str(len(data.plates))),
    ]
    scorer_name = "" if how == "none" else held.scorer
    return Inspection(data.name, data.source, facts, wells, scorer_name, (*notes, *data.warnings))


def _unscored(samples: Sequence[TrajectorySample]) -> HeldOut:
    first = first_normals(samples)
    wells = [
        ScoredWell(sample, 0.0, 0.0, -1.0, False)
        for sample in samples
        if sample is not first[sample.plate]
    ]
    anchors = [ScoredWell(sample, 0.0, 0.0, 0.0, False) for sample in first.values()]
    return HeldOut("none", True, anchors, wells, dict.fromkeys(first, _Unscored()))


class _Unscored:
    """In a scorer's place where there is none: no well looks unusual to it."""

    name = "none"

    def fit(self, normals: Sequence[TrajectorySample]) -> None:
        """There is nothing to learn."""

    def score(self, sample: TrajectorySample) -> float:
        return 0.0

    def p_value(self, sample: TrajectorySample) -> float:
        return 1.0


def _well(data: Dataset, judged: JudgedWell, show: bool, scored: bool) -> SeenWell:
    sample, verdict = judged.sample, judged.verdict
    outcome = "calibration" if judged.calibration else verdict.outcome.value
    return SeenWell(
        id=sample.id,
        group=sample.plate,
        well=sample.well,
        title=f"{sample.pipette}, {sample.volume_ul:g} µL {sample.reagent}".rstrip(),
        outcome=outcome,
        route=verdict.route.value,
        gate=verdict.gate.value,
        failure=verdict.failure.value if verdict.failure else "",
        reason=verdict.reason,
        truth=_truth(sample),
        agreement="" if judged.calibration else _agreement(judged.scored.failed, judged.flagged),
        score=verdict.score if scored else None,
        frames=_frames(data, judged, show),
        signs=signs_in(judged.evidence),
        band=band_in(judged.evidence) if scored else None,
    )


def _truth(sample: TrajectorySample) -> str:
    if sample.label != "failure":
        return sample.label
    retained = sample.retained_fraction
    return sample.failure_type + ("" if retained is None else f", {retained:.0%} retained")


def _agreement(failed: bool, flagged: bool) -> str:
    if failed:
        return "caught" if flagged else "missed"
    return "false alarm" if flagged else "passed"


def _frames(data: Dataset, judged: JudgedWell, show: bool) -> dict[KeyframeKind, SeenFrame]:
    sample, evidence = judged.sample, judged.evidence
    paths = next(record.frames for record in data.records if record.id == sample.id)
    frames = {}
    for kind in KeyframeKind:
        found = sample.detections[kind]
        image = sample.frames[kind] if show else None
        box = None if found is None else _box(found)
        axis = None if found is None else (found.orifice, found.collar)
        frames[kind] = SeenFrame(
            None if image is None else whole_frame(image),
            None if image is None or box is None else close_up(image, box),
            box,
            None if found is None else found.confidence,
            data.boxes.get(paths[kind]),
            axis,
            expected_level(evidence, kind, sample.expected_ul[kind], axis, box),
            None if found is None else measured_level(evidence, kind, axis, box),
        )
    return frames


def _box(found: TipDetection) -> Box:
    return found.x, found.y, found.w, found.h
