"""A sidecar's store, filled with frames of the simulated camera and the verdicts on them."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np

from aegis_ot.sidecar import make_analyser
from aegis_ot.sidecar.analysis import plain
from aegis_ot.sidecar.store import Captured, Store
from aegis_ot.sidecar.wire import Finish, RunStart
from aegis_ot.simulation import SessionParameters
from aegis_ot.vision.camera import Frame
from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef
from aegis_ot_lab.drawing.dataset import PlannedWell, SimulatedPlate, render_trajectory

VOLUME = 150.0


def make_store(
    folder: Path, faults: tuple[str, ...], run: str = "run-1", pipette: str = "p300_single_gen2"
) -> Path:
    """One run with a well for each of ``faults`` (``""``: none), judged as a sidecar does."""
    rng = np.random.default_rng(7)
    tip = "flex_1channel_200" if pipette.startswith("flex") else "p300"
    plate = SimulatedPlate("plate00", SessionParameters.webcam(7), tip, VOLUME)
    store = Store(folder)
    store.register(RunStart(run=run, protocol="wells.py", simulated=True, started=time.time()))
    analyser = make_analyser().begin(run)
    for number, fault in enumerate(faults):
        name = f"{'ABCDEFGH'[number % 8]}{number // 8 + 1}"
        sample, jpegs, _ = render_trajectory(
            str(number), name, PlannedWell(0, "red", fault), plate, rng
        )
        for place, kind in enumerate(KeyframeKind):
            keyframe = Keyframe(
                run=run, sequence=4 * number + place, trajectory=number, kind=kind,
                pipette=pipette, mount="left", channels=1, tip=f"1:{name}",
                sources=(WellRef("2", "A1", "dye"),), destinations=(WellRef("3", name, "plate"),),
                commanded_ul=VOLUME, expected_ul=sample.expected_ul[kind], capacity_ul=300.0,
                reagent="red dye", line=10,
            )  # fmt: skip
            store.add_keyframe(Captured(keyframe, 0.02, time.time()), jpegs[kind])
            analyser.observe(keyframe, Frame(jpegs[kind], sample.frames[kind], time.monotonic()))
        verdict, evidence = analyser.judge(number)
        store.add_verdict(verdict, plain(evidence))
    store.finish(run, Finish(outcome="succeeded"))
    store.close()
    return folder
