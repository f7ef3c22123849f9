"""The tip detector on frames that it has not learnt from, one line for each kind.

``python -m benchmarks.detector [--weights FILE.onnx] [--frames N] [DATASET ...]``

Of the data sets only the plates are looked at that the weights' description says were held out.
The other frames are drawn or simulated from seeds that no training uses. Tips of which labware
hides more than 40 % are left out, since the scorers cannot use them either.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from pathlib import Path

import cv2
import numpy as np

from aegis_ot.simulation import FrameTruth, SessionParameters, place_tip, render_jpeg
from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.exposure import decode
from aegis_ot.vision.detection import HeatmapDetector
from aegis_ot.vision.tips import tip_for
from aegis_ot.vision.types import Image, TipDetection
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.vocabulary.pipette_names import channels_of
from aegis_ot_lab.drawing import random_frames
from aegis_ot_lab.drawing.plans import contents_of
from aegis_ot_lab.training.axes import TipLabel
from aegis_ot_lab.training.figures import Box, LabelledFrame, measure, read_images
from aegis_ot_lab.training.recorded import read_frames
from aegis_ot_lab.training.scenes import draw_frame

UNSEEN = 70_000_001
"""First seed; trainings draw from small ones and from a million upwards."""

_MOST_HIDDEN = 0.4
_SINGLE, _EIGHT = ("p20", "p300", "p1000"), ("p20_multi_gen2", "p300_multi_gen2")


def drawn(count: int) -> Iterator[LabelledFrame]:
    """Procedural frames as in training: every property anew, bare nozzles one in three."""
    rng = np.random.default_rng(UNSEEN)
    for _ in range(count):
        image, label, _missing = draw_frame(rng)
        yield LabelledFrame(image, ((_box(label), label),) if label else ())


def sessions(count: int) -> Iterator[LabelledFrame]:
    """Simulated sessions with camera, light, deck, pipette and tip drawn at random."""
    made = (_labelled(*each) for each in random_frames(UNSEEN, frames_per_session=2))
    return islice((frame for frame in made if frame is not None), count)


def placed(
    view: Callable[[int], SessionParameters], pipettes: tuple[str, ...], count: int
) -> Iterator[LabelledFrame]:
    """Simulated frames of a measured camera view; one frame in six without a tip.

    Args:
        view: Gives the session of a seed, e.g. ``SessionParameters.webcam``.
        pipettes: Opentrons names, drawn from for each frame.
        count: Number of frames.
    """
    rng = np.random.default_rng(UNSEEN)
    given = 0
    for seed in range(UNSEEN, UNSEEN + 2 * count):
        session = view(seed)
        pipette = pipettes[int(rng.integers(len(pipettes)))]
        channels, tip = channels_of(pipette), tip_for(pipette)
        kind = tuple(KeyframeKind)[int(rng.integers(4))]
        fault = "no_tip" if seed % 6 == 0 else ("", "no_dispense", "partial_50")[seed % 3]
        volume = tip.nominal_ul * float(rng.uniform(0.1, 1.0))
        content = contents_of(fault, volume, rng, session.film)[0][kind]
        wells = [f"{'ABCDEFGH'[rng.integers(8)]}{rng.integers(1, 13)}" for _ in range(2)]
        dye = tuple(DYES.values())[int(rng.integers(len(DYES)))]
        state = place_tip(
            session, kind, tip, (content,) * channels, dye, source=wells[0], destination=wells[1]
        )
        jpeg, truth = render_jpeg(state, session, rng)
        frame = _labelled(decode(jpeg), truth)
        if frame is not None:
            yield frame
            given += 1
        if given == count:
            return


def _labelled(image: Image, truth: FrameTruth) -> LabelledFrame | None:
    """The frame with all its tips; ``None`` if labware hides the foremost one."""
    if truth.tip.hidden > _MOST_HIDDEN:
        return None
    tips: list[tuple[Box, TipLabel]] = []
    for tip in truth.tips:
        if tip.box is not None:
            tips.append((tip.box, TipLabel(tip.collar, tip.orifice, tip.box[2] / 2)))
    return LabelledFrame(image, tuple(tips))


def _box(label: TipLabel) -> Box:
    (cx, cy), (ox, oy) = label.collar, label.orifice
    return (min(cx, ox) - label.radius, cy, abs(cx - ox) + 2 * label.radius, oy - cy)


def _held_out(folder: Path, plates: set[str]) -> Iterator[LabelledFrame]:
    return read_images(f for f in read_frames(folder) if f.plate.rpartition("/")[2] in plates)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.detector", description=__doc__)
    parser.add_argument("datasets", nargs="*", type=Path, help="sets with boxes.csv")
    parser.add_argument("--weights", type=Path, help="an .onnx file; the shipped one if not given")
    parser.add_argument("--frames", type=int, default=300, help="of each kind drawn here")
    asked = parser.parse_args()
    cv2.setNumThreads(1)
    detector = HeatmapDetector(asked.weights)
    held = set(detector.description.get("data", {}).get("held_out_plates", ()))
    kinds: dict[str, Iterable[LabelledFrame]] = {
        f"{folder.name}, plates held out": _held_out(folder, held) for folder in asked.datasets
    }
    kinds |= {
        "simulated, any camera": sessions(asked.frames),
        "simulated, OT-2 webcam 640x480": placed(SessionParameters.webcam, _SINGLE, asked.frames),
        "simulated, 8 channels from the corner": placed(
            SessionParameters.corner, _EIGHT, asked.frames
        ),
        "drawn": drawn(asked.frames),
    }
    print(f"threshold {detector.threshold}; found: IoU over 0.5; ends: median and 95 %, px")
    for kind, frames in kinds.items():
        watched = _Timed(detector)
        got = measure(watched, frames)
        print(
            f"{kind:<38} found {got.found:.3f} of {got.tip_frames:<3}  "
            f"false {got.false_alarms} of {got.empty_frames:<3}  mAP50 {got.map50:.3f}  "
            f"IoU {got.mean_overlap:.3f}  orifice {got.orifice_px}  collar {got.collar_px}  "
            f"margin {got.highest_empty} / {got.lowest_tip}  {watched.ms():.1f} ms",
            flush=True,
        )


class _Timed(HeatmapDetector):
    """A detector that counts the processor time of its looks."""

    def __init__(self, detector: HeatmapDetector) -> None:
        self.__dict__ |= detector.__dict__
        self._spent: list[float] = []

    def best_guess(self, image: Image) -> TipDetection | None:
        begun = time.process_time()
        best = super().best_guess(image)
        self._spent.append(time.process_time() - begun)
        return best

    def ms(self) -> float:
        """Median of a look, ms."""
        return 1e3 * float(np.median(self._spent))


if __name__ == "__main__":
    main()
