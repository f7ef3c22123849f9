"""Simulated rows of tips, as a run's camera gives them."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from aegis_ot.simulation import FrameTruth, SessionParameters, SimulatedCamera
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

ROWS = "ABCDEFGH"


def keyframes(columns: int) -> Iterator[Keyframe]:
    """Of a p300 8-channel that fills the columns of a plate, new tips for each."""
    source = WellRef("trough", "A1", "trough", "1")
    for number in range(columns):
        wells = tuple(WellRef("plate", f"{row}{number + 1}", "plate", "2") for row in ROWS)
        for place, kind in enumerate(KeyframeKind):
            loaded = kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
            yield Keyframe(
                "run", 4 * number + place, number, kind, "p300_multi_gen2", "left", 8,
                f"3:A{number + 1}", (source,), wells, 100.0, 100.0 if loaded else 0.0, 300.0,
                "red", (147.0 + 9.0 * number, 74.2, 60.0),
                nozzles=tuple(f"{row}1" for row in ROWS), targets=wells,
            )  # fmt: skip


def frames(
    angle: float,
    faults: Sequence[str] = (),
    columns: int = 1,
    seed: int = 2,
    kinds: Container[KeyframeKind] = tuple(KeyframeKind),
) -> Iterator[tuple[Keyframe, Frame, FrameTruth]]:
    """Each keyframe of these kinds with its frame, and what that truly shows."""
    for keyframe in keyframes(columns):
        if keyframe.kind in kinds:
            yield keyframe, *_drawn(angle, tuple(faults), columns, seed, keyframe.sequence)


@lru_cache(maxsize=128)
def _drawn(
    angle: float, faults: tuple[str, ...], columns: int, seed: int, sequence: int
) -> tuple[Frame, FrameTruth]:
    """Drawn once for all tests: a frame's noise is its own, whatever was drawn before it."""
    camera = SimulatedCamera(seed, faults, SessionParameters.beside(angle, seed))
    camera.expect(keyframes(columns))
    for keyframe in keyframes(columns):
        if keyframe.sequence <= sequence:
            camera.announce(keyframe)
    frame = camera.frame_after(0.0, 5.0)
    assert camera.truth is not None
    return frame, camera.truth


def part_of(keyframe: Keyframe, first: int, last: int) -> Keyframe:
    """The same keyframe of a partial head: nozzles ``first`` to ``last``."""
    chosen = slice(first, last + 1)
    return replace(
        keyframe,
        channels=last - first + 1,
        nozzles=keyframe.nozzles[chosen],
        targets=keyframe.targets[chosen],
        destinations=keyframe.destinations[chosen],
    )
