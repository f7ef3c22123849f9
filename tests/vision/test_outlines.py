"""Which outline a run's tips have: both free frames are laid straight by the same one."""

from __future__ import annotations

from typing import Any, cast

import pytest

from aegis_ot.simulation import SessionParameters, SimulatedCamera
from aegis_ot.vision.column import TipLook, shapes_of
from aegis_ot.vision.outlines import Outlines
from aegis_ot.vision.run_analyser_factory import RunAnalyserFactory
from aegis_ot.vision.scorers.looks import look
from aegis_ot.vision.tips import TIPS, tip_for
from aegis_ot.vision.types import FREE, TipDetection

from .test_run_analyser_factory import Told, keyframes

SMALL = TIPS["ot2_300"]
STRAIGHT, NARROW = shapes_of(SMALL)


def told(*clarities: float) -> TipLook:
    return TipLook(cast(Any, None), cast(Any, None), (0, 0), (0, 1), STRAIGHT, clarities)


def test_the_outline_that_fits_most_frames_best_is_the_runs() -> None:
    known = Outlines()
    assert known.best(SMALL) is None
    known.note(told(5.0, 4.9))
    assert known.best(SMALL) == STRAIGHT
    for _ in range(5):
        assert known.known(SMALL) is None, "too few frames"
        known.note(told(5.0, 5.4))
    assert known.known(SMALL) == NARROW
    for _ in range(40):
        known.note(told(9.0, 1.0))
    assert known.known(SMALL) == NARROW, "a run keeps to it: its wells are compared"


def test_a_tip_of_one_outline_has_nothing_to_tell() -> None:
    known = Outlines()
    known.note(told())
    assert known.best(TIPS["ot2_1000"]) is None


@pytest.mark.parametrize("seed", [3, 5])
def test_both_free_frames_of_a_run_are_laid_straight_by_one_outline(seed: int) -> None:
    camera = SimulatedCamera(seed, [], SessionParameters.bench(seed))
    detector = Told()
    analyser = RunAnalyserFactory(detector).begin("run")
    for keyframe in keyframes(5, pipette="p300", volumes=(100.0,)):
        camera.announce(keyframe)
        frame, truth = camera.frame_after(0.0, 1.0), camera.truth
        assert truth is not None
        assert truth.box is not None
        found = TipDetection(*truth.box, 0.99, truth.tip.orifice, truth.tip.collar)
        detector.found = found
        analyser.observe(keyframe, frame)
        if keyframe.kind is FREE[-1]:
            seen = analyser._open[keyframe.trajectory]
            analyser._stream(keyframe).settle(seen, detector)
            tip = tip_for(keyframe.pipette, keyframe.capacity_ul)
            found_in = ((kind, seen.detections[kind]) for kind in FREE)
            laid = [look(seen.frames, kind, each, tip).shape for kind, each in found_in]
            assert laid[0] == laid[1]
            analyser.judge(keyframe.trajectory)
