"""The wells of a finished run, looked at anew with what the whole run tells of its tips."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ..errors import StoreError
from ..progress import Progress
from ..sidecar.store import Store
from ..vision.column_reader import MeasuredColumns
from ..vision.consistency import TipConsistency, once_each, second_look
from ..vision.delivery import Delivery, delivery_of
from ..vision.first_wells import Liquid, liquid_of
from ..vision.measuring import TipView
from ..vision.scorers.looks import looks as scorer_looks
from ..vision.scorers.patches import describe
from ..vision.tips import tip_for
from ..vision.types import Detector, Image, TipDetection, TrajectorySample
from ..vocabulary import Keyframe, KeyframeKind
from ..worldmodel.recorded import recorded_runs

Detections = dict[KeyframeKind, TipDetection | None]


@dataclass(frozen=True)
class RunWell:
    """One well of a recorded run.

    Attributes:
        trajectory: Its number in the run.
        keyframe: Its last one: who pipettes what, from where to where.
        entry: The delivery in the run's overview, with its verdict as it stands.
        recorded: Trajectory whose frames are read from the store when asked for.
        sample: The same with its tips settled. Its frames are gone: what the scorers read in
            them is remembered.
        looks: What the column reader took from each frame.
        delivery: What its own frames show of its delivery.
    """

    trajectory: int
    keyframe: Keyframe
    entry: Mapping[str, Any]
    recorded: TrajectorySample
    sample: TrajectorySample
    looks: Mapping[KeyframeKind, object] = field(repr=False)
    delivery: Delivery

    @property
    def liquid(self) -> Liquid:
        return liquid_of(self.keyframe)

    @property
    def outcome(self) -> str:
        """Of its verdict after the operator: ``pass``, ``fail``, ``undecided``; empty without."""
        return str((self.entry["verdict"] or {}).get("outcome") or "")

    @property
    def without_tip(self) -> bool:
        """Whether no tip was found in a frame that shows one wherever there is one."""
        return self.sample.lacks_tip


def run_wells(
    store: Store, run: str, detector: Detector, progress: Progress | None = None
) -> tuple[list[RunWell], int]:
    """The wells of a run in order, and how many cannot be looked at: frames are missing or
    damaged, came late, or the delivery was given up.

    Raises:
        ConfigurationError: The run is not in the store.
        StoreError: The store cannot be read.
    """
    progress = progress or Progress()
    (recorded,) = recorded_runs(store, detector, [run])
    keyframes = {one.keyframe.trajectory: one.keyframe for one in store.keyframes(run)}
    progress.begin("Finding tips", len(recorded.samples))
    tips = _Tips(detector)
    found: list[tuple[Mapping[str, Any], TrajectorySample]] = []
    for entry, sample in zip(recorded.entries, recorded.samples, strict=True):
        progress.step()
        try:
            tips.meet(keyframes[entry["trajectory"]], sample)
        except StoreError:
            continue
        found.append((entry, sample))
    progress.begin("Reading tips", len(found))
    wells = []
    for entry, sample in found:
        wells.append(_well(entry, sample, keyframes[entry["trajectory"]], tips))
        progress.step()
    return wells, recorded.left_out + len(recorded.samples) - len(wells)


class _Tips:
    """The run's tips: met well by well, then settled by what all of them showed."""

    def __init__(self, detector: Detector) -> None:
        self._detector = detector
        self._found: dict[str, Detections] = {}
        self._tips: dict[tuple[str, float], TipConsistency] = {}

    def meet(self, keyframe: Keyframe, sample: TrajectorySample) -> None:
        """Find a well's tips, and learn what this pipette's look like."""
        frames = dict(sample.frames)
        self._found[sample.id] = {kind: self._detector.detect(frames[kind]) for kind in frames}
        self.settled(keyframe, sample, frames)

    def settled(
        self, keyframe: Keyframe, sample: TrajectorySample, frames: Mapping[KeyframeKind, Image]
    ) -> Detections:
        """A well's detections, put right by all that is known of the run by now."""
        key = liquid_of(keyframe)[:2]
        tip = self._tips.setdefault(key, TipConsistency())
        detections = dict(self._found[sample.id])
        guess = getattr(self._detector, "best_guess", None)
        if guess is not None:
            guess = once_each(guess)
            detections.update(second_look(guess, detections, frames))
            detections.update(tip.recognise(guess, detections, frames))
        return tip.settle(detections, frames)


def _well(
    entry: Mapping[str, Any], recorded: TrajectorySample, keyframe: Keyframe, tips: _Tips
) -> RunWell:
    frames = dict(recorded.frames)
    detections = tips.settled(keyframe, recorded, frames)
    sample = replace(recorded, frames=frames, detections=detections)
    tip = tip_for(keyframe.pipette, keyframe.capacity_ul)
    reader = MeasuredColumns()
    looks = {
        kind: reader.look(TipView(kind, frames[kind], found, tip, sample.expected_ul[kind]))
        for kind, found in detections.items()
        if found is not None
    }
    scorer_looks(sample)
    describe(sample)
    frames.clear()
    delivery = delivery_of(looks, sample.expected_ul)
    return RunWell(int(entry["trajectory"]), keyframe, entry, recorded, sample, looks, delivery)


def by_liquid(wells: Sequence[RunWell]) -> Iterator[list[RunWell]]:
    """Wells that look alike when all is well, in order: of one pipette, kind of tip and liquid."""
    streams: dict[Liquid, list[RunWell]] = {}
    for well in wells:
        streams.setdefault(well.liquid, []).append(well)
    yield from streams.values()
