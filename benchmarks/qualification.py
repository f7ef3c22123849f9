"""Whether a qualification's claims are true, and what a fit on its frames brings: simulated labs.

``python -m benchmarks.qualification [--labs 20] [--truth 5] [--seed 44000] [--fit N] [--json OUT]``
``python -m benchmarks.qualification --duration``: robot time of 48 deliveries, estimated.

Each laboratory is a camera, light, pipette and liquid drawn at random. As a real robot does, it
says where each tip is, which registers the camera. Its truth are the shares caught in further
qualifications of the same laboratory, with orders and noise of their own. A claim covers it if the
claim's 95 % interval holds it. Further qualifications are few, so their mean is itself off: a miss
is "near" if the mean's own 95 % interval (Student's t over those runs) meets the claim. It counts
as a miss all the same. Beside it stand the exact intervals of one run.

With ``--fit`` the first qualification's frames teach a lab its own limits (``aegis-ot fit --start
shipped``; ``--own``: a scorer of its own, too), which judge further ones beside the shipped ones.
Where a qualification teaches nothing, as no tip was found, the shipped ones stand in both places.
All results are simulated.
"""

from __future__ import annotations

import argparse
import json
import logging
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from aegis_ot.errors import DatasetError
from aegis_ot.planted import NORMAL
from aegis_ot.qualification.frames import with_located_tips, write_frames
from aegis_ot.qualification.opening import JudgedDelivery
from aegis_ot.qualification.plan import CALIBRATING, QualificationPlan, make_plan
from aegis_ot.qualification.protocol import protocol_text
from aegis_ot.sidecar import make_analyser
from aegis_ot.sidecar.config import CascadeSettings
from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.simulation.scene import TipContent, place_tip
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import TipDetection, TrajectorySample
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef
from aegis_ot.worldmodel import fit_model
from aegis_ot_lab.drawing.random_sessions import random_session

from .qualification_claims import counted, coverage, show
from .qualification_gain import AFTER, BEFORE, JUDGES, gain_row, show_gain

PIPETTES = {"p20_single_gen2": 20.0, "p300_single_gen2": 300.0, "p1000_single_gen2": 1000.0}
LIQUIDS = ("red", "yellow", "blue", "water")


@dataclass(frozen=True)
class Lab:
    """One simulated laboratory."""

    seed: int
    pipette: str
    liquid: str
    session: SessionParameters

    @classmethod
    def drawn(cls, seed: int) -> Lab:
        rng = np.random.default_rng((seed, 44))
        pipette = list(PIPETTES)[seed % len(PIPETTES)]
        liquid = str(rng.choice(LIQUIDS, p=(0.3, 0.25, 0.25, 0.2)))
        return cls(seed, pipette, liquid, random_session(rng, pipette=pipette, size=(960, 540)))

    def run(self, number: int) -> LabRun:
        """Its ``number``-th qualification."""
        seed = 1000 * self.seed + number
        return LabRun(self, make_plan(self.pipette, "left", [self.liquid], 30, seed), seed)


class LabRun:
    """One qualification of a laboratory, without a robot: its frames are drawn once."""

    def __init__(self, lab: Lab, plan: QualificationPlan, seed: int) -> None:
        self.lab, self.plan = lab, plan
        self._detector = _Remembering()
        camera = SimulatedCamera(seed, plan.faults(), lab.session)
        self.wells: list[list[tuple[Keyframe, Any]]] = []
        for keyframes in _keyframes(plan, PIPETTES[lab.pipette], lab.session):
            shown = []
            for keyframe in keyframes:
                camera.announce(keyframe)
                frame = camera.frame_after(0.0, 5.0)
                # The robot's positions register no camera that is known to be a simulated one.
                shown.append((keyframe, replace(frame, simulated=False)))
            self.wells.append(shown)

    def judged(
        self, model: Path | None = None, numbers: Sequence[int] | None = None
    ) -> list[JudgedDelivery]:
        """As the sidecar judges it, with the shipped world model or another; all of it, or as if
        the run had nothing but some of its deliveries."""
        cascade = CascadeSettings(first_wells="trust", model=model)
        analyser = make_analyser(cascade, detector=self._detector).begin("run")
        judged: list[JudgedDelivery] = []
        for number in range(len(self.wells)) if numbers is None else numbers:
            shown = self.wells[number]
            for keyframe, frame in shown:
                analyser.observe(keyframe, frame)
            verdict, _ = analyser.judge(number)
            entry: Any = {
                "judged": {"outcome": verdict.outcome.value},
                "keyframes": [
                    {"kind": keyframe.kind.value, "late": False} for keyframe, _ in shown
                ],
            }
            calibrates = len(judged) < CALIBRATING
            judged.append(JudgedDelivery(self.plan.deliveries[number], calibrates, entry))
        return judged

    def judged_anew(self, judged: Sequence[JudgedDelivery]) -> dict[str, bool]:
        """By well, whether it was flagged when its half was judged by itself; the first half of
        ``judged``, which is all of it, was."""
        halves = [each.half for each in self.plan.deliveries]
        second = [number for number, half in enumerate(halves) if half == 2]
        apart = [*judged[: second[0]], *self.judged(numbers=second)]
        return {each.planned.well: each.is_flagged for each in apart if not each.calibrates}

    @property
    def samples(self) -> list[TrajectorySample]:
        """Labelled by the plan, as the data set of a qualification has them."""
        found = []
        for planned, shown in zip(self.plan.deliveries, self.wells, strict=True):
            last = shown[-1][0]
            positions = {key.kind: key.position for key, _ in shown if key.position is not None}
            frames = {keyframe.kind: frame.image for keyframe, frame in shown}
            found.append(
                TrajectorySample(
                    id=f"{self.plan.seed}-{last.trajectory}",
                    plate=f"{planned.liquid} {planned.half}", well=planned.well,
                    pipette=self.lab.pipette, capacity_ul=last.capacity_ul,
                    volume_ul=self.plan.volume_ul, frames=frames, positions=positions,
                    detections={
                        kind: self._detector.detect(image) for kind, image in frames.items()
                    },
                    expected_ul={keyframe.kind: keyframe.expected_ul for keyframe, _ in shown},
                    reagent=planned.liquid,
                    label="normal" if planned.kind == NORMAL else "failure",
                    failure_type=planned.failure_type, retained_fraction=planned.leftover,
                )
            )  # fmt: skip
        return with_located_tips(found, self._detector)


class _Remembering(HeatmapDetector):
    """The shipped detector, which looks for a tip once in each frame, however many judge it."""

    def __init__(self) -> None:
        super().__init__()
        self._known: dict[int, tuple[Any, TipDetection | None]] = {}

    def detect(self, image: Any) -> TipDetection | None:
        if id(image) not in self._known:
            self._known[id(image)] = image, super().detect(image)
        return self._known[id(image)][1]


def _keyframes(
    plan: QualificationPlan, capacity_ul: float, session: SessionParameters
) -> Iterator[list[Keyframe]]:
    source, tip = WellRef("reservoir", "A1", "reservoir", "2"), tip_for(plan.pipette, capacity_ul)
    for number, planned in enumerate(plan.deliveries):
        first = Keyframe(
            f"run {plan.seed}", 0, number, KeyframeKind.ASPIRATE, plan.pipette, "left", 1,
            f"1:{planned.well}", (source,), (WellRef("plate", planned.well, "plate", "3"),),
            plan.volume_ul, plan.volume_ul, capacity_ul, planned.liquid,
        )  # fmt: skip
        loaded = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
        yield [
            replace(
                first, kind=kind, sequence=4 * number + place,
                expected_ul=plan.volume_ul if kind in loaded else 0.0,
                position=place_tip(
                    session, kind, tip, (TipContent(),), source="A1", destination=planned.well
                ).orifice,
            )
            for place, kind in enumerate(KeyframeKind)
        ]  # fmt: skip


def fitted(lab: Lab, further: int, folder: Path, start: str = "shipped") -> dict[str, Any]:
    """The shipped limits and those fitted on a lab's first qualification, on further ones."""
    first = lab.run(0)
    frames = write_frames(folder / str(lab.seed), first.samples, "synthetic")
    model, is_fitted = folder / f"{lab.seed}.model", True
    try:
        fit_model([frames], model, detector="true", measure=False, start=start)
    except DatasetError:  # in none of its normal wells a tip was found in every frame
        is_fitted = False
    told: dict[str, list[JudgedDelivery]] = {judge: [] for judge in JUDGES}
    for number in range(1, further + 1):
        run = lab.run(number)
        told[BEFORE] += run.judged()
        told[AFTER] += run.judged(model) if is_fitted else told[BEFORE][-len(run.wells) :]
    counts = {judge: counted(each, first.plan) for judge, each in told.items()}
    return gain_row(f"{lab.seed}, {lab.pipette}, {lab.liquid}", counts, is_fitted)


DROP_S, LIFT_S, KEYFRAME_S, VERDICT_S = 10.0, 2.0, 0.3, 1.0
"""What Opentrons' estimator leaves out, s: throwing a tip away (its own figure for a tip rack), the
guard's moves above a well, a frame, the wait for a verdict."""


def duration(pipette: str) -> tuple[int, float]:
    """Deliveries of half an hour's plan, and how long they take, s: as Opentrons estimates it."""
    from opentrons.legacy_commands.types import COMMAND
    from opentrons.protocols.duration import DurationEstimator

    from aegis_ot.adapters.opentrons.rehearsal import Script, play

    plan = make_plan(pipette, "right", ["dye"], 30, 3)
    estimator = DurationEstimator()

    def wrap(run: Any) -> Any:
        def timed(protocol: Any) -> None:
            protocol.broker.subscribe(COMMAND, estimator.on_message)
            run(protocol)

        return timed

    play(Script(protocol_text(plan), "qualification.py"), wrap)
    each = DROP_S + 2 * LIFT_S + 4 * KEYFRAME_S + VERDICT_S
    count = len(plan.deliveries)
    return count, estimator.get_total_duration() + count * each


def main(arguments: list[str] | None = None) -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.qualification", description=__doc__)
    parser.add_argument("--labs", type=int, default=20)
    parser.add_argument("--truth", type=int, default=5, help="further qualifications of each")
    parser.add_argument("--seed", type=int, default=44_000)
    parser.add_argument("--fit", type=int, default=0, help="so many laboratories fit a model")
    parser.add_argument("--own", action="store_true", help="they fit a scorer of their own, too")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--duration", action="store_true")
    given = parser.parse_args(arguments)
    logging.disable(logging.CRITICAL if given.duration else logging.WARNING)
    for pipette in PIPETTES if given.duration else ():
        count, seconds = duration(pipette)
        sys.stdout.write(f"{pipette}: {count} deliveries in {seconds / 60:.1f} minutes\n")
    if given.duration:
        return
    found = []
    for number in range(0 if given.fit else given.labs):
        lab = Lab.drawn(given.seed + number)
        first = lab.run(0)
        judged = first.judged()
        anew = first.judged_anew(judged)
        told = [lab.run(number).judged() for number in range(1, given.truth + 1)]
        rows = coverage(judged, told, first.plan, anew)
        spread = counted(judged, first.plan, anew)["spread"]
        named = f"{lab.seed}, {lab.pipette}, {lab.liquid}"
        found.append({"lab": named, "spread": spread, "rows": rows})
        sys.stderr.write(f"{json.dumps(found[-1])}\n")
    with tempfile.TemporaryDirectory(prefix="aegis-ot-") as folder:
        for number in range(given.fit):
            lab, start = Lab.drawn(given.seed + number), "" if given.own else "shipped"
            found.append(fitted(lab, given.truth, Path(folder), start))
            sys.stderr.write(f"{json.dumps(found[-1])}\n")
    sys.stdout.write(show_gain(found) if given.fit else show(found))
    if given.json is not None:
        given.json.write_text(json.dumps(found, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
