"""The wells of a finished run, looked at anew with what the whole run tells of its tips."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from ..errors import StoreError
from ..progress import Progress
from ..run_view.overview import DeliveryEntry
from ..sidecar.store import Store
from ..vision.column_look import Looks
from ..vision.column_reader import MeasuredColumns
from ..vision.consistency import guesses_in, second_look
from ..vision.delivery import Delivery, delivery_of
from ..vision.first_wells import Liquid, liquid_of
from ..vision.registration import TipLocator
from ..vision.scorers.looks import hang_alike
from ..vision.scorers.looks import looks as scorer_looks
from ..vision.scorers.pair import pair_of
from ..vision.tips import tip_for
from ..vision.types import FREE, Detector, Frames, TrajectorySample
from ..vocabulary import Keyframe, KeyframeKind
from ..worldmodel.recorded import recorded_runs
from ..worldmodel.registered_tips import learned_locator, located_tips


@dataclass(frozen=True)
class RunWell:
    """One well of a recorded run.

    Attributes:
        trajectory: Its number in the run.
        keyframe: Its last one: who pipettes what, from where to where.
        entry: The delivery in the run's overview, with its verdict as it stands.
        recorded: Trajectory whose frames are read from the store when asked for.
        sample: The same with its tips found. Its frames are gone: what the scorers read in
            them is remembered.
        looks: What the column reader took from each frame.
        delivery: What its own frames show of its delivery.
    """

    trajectory: int
    keyframe: Keyframe
    entry: DeliveryEntry
    recorded: TrajectorySample
    sample: TrajectorySample
    looks: Looks = field(repr=False)
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
    progress.begin("Reading tips", len(recorded.samples))
    locator = learned_locator(recorded.samples, detector)
    wells = []
    for entry, sample in zip(recorded.entries, recorded.samples, strict=True):
        progress.step()
        try:
            frames = Frames(sample.frames)
        except StoreError:
            continue
        wells.append(
            _well(entry, sample, frames, keyframes[entry["trajectory"]], detector, locator)
        )
    return wells, recorded.left_out + len(recorded.samples) - len(wells)


def _well(
    entry: DeliveryEntry,
    recorded: TrajectorySample,
    frames: Frames,
    keyframe: Keyframe,
    detector: Detector,
    locator: TipLocator,
) -> RunWell:
    (located,) = located_tips([replace(recorded, frames=frames)], locator).values()
    detections = dict(located)
    guess = guesses_in(detector, frames)
    if guess is not None:
        detections.update(second_look(guess, detections))
    sample = replace(recorded, frames=frames, detections=detections)
    tip = tip_for(keyframe.pipette, keyframe.capacity_ul)
    reader = MeasuredColumns()
    alike = hang_alike(detections, sample.positions)
    before = detections.get(KeyframeKind.TRANSIT) if alike else None
    looks = {
        kind: reader.look(frames, kind, found, tip, None, before if kind is FREE[1] else None)
        for kind, found in detections.items()
        if found is not None
    }
    scorer_looks(sample)
    pair_of(sample)
    frames.clear()
    delivery = delivery_of(looks, sample.expected_ul)
    return RunWell(int(entry["trajectory"]), keyframe, entry, recorded, sample, looks, delivery)


def by_liquid(wells: Sequence[RunWell]) -> Iterator[list[RunWell]]:
    """Wells that look alike when all is well, in order: of one pipette, kind of tip and liquid."""
    streams: dict[Liquid, list[RunWell]] = {}
    for well in wells:
        streams.setdefault(well.liquid, []).append(well)
    yield from streams.values()
