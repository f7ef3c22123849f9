"""Whole live runs on simulated frames: normal wells, and the same wells with a fault planted.

``python -m benchmarks.live_runs [--seeds FIRST COUNT] [--wells N] [--no-faults] [--json OUT]
[--only planted|silent|camera] [--flex]``

Every run is judged as the sidecar judges it, with an operator who finds sound wells right where
the frames prove nothing. At four of its wells (the second, the fifth, and two
after the calibration) each fault is also tried in the well's place: the run's state is put back
after each, so that one run gives many faults and none of them changes another. Then come the runs
of ``silent_passes``, in which nothing looks unlike the rest because all of it is wrong: one fault
in all wells, faults among the first six, a failure that drifts in, a camera that shows nothing.
Results are those of simulated frames, and say so.
"""

from __future__ import annotations

import argparse
import copy
import json
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

DEVELOPMENT_SEED, REPORT_SEED = 1000, 5000
"""First seeds: the limits were chosen while looking at the runs of the first, and are reported on
those of the second."""

FAULTS = (
    *("partial:25", "partial:50", "partial:75", "no_dispense"),
    *("no_aspirate", "air_bubble", "no_tip"),
)
CAMERAS = ("bench", "webcam", "corner", "drawn")
REAGENTS = ("red", "yellow", "water")
PIPETTES = {
    "p20": ("p20_single_gen2", 20.0),
    "p300": ("p300_single_gen2", 300.0),
    "p1000": ("p1000_single_gen2", 1000.0),
}
"""Name of Opentrons' and working volume of the tip, µL."""
FLEX = {
    "flex 50": ("flex_1channel_50", 50.0),
    "flex 200": ("flex_1channel_1000", 200.0),
    "flex 1000": ("flex_1channel_1000", 1000.0),
}
VOLUMES = {
    "p20": ((15.0,), (8.0, 18.0, 12.0, 20.0, 5.0)),
    "p300": ((100.0,), (150.0, 60.0, 200.0, 250.0, 40.0)),
    "p1000": ((300.0,), (60.0, 500.0, 200.0, 800.0, 120.0)),
    "flex 50": ((30.0,), (15.0, 40.0, 25.0, 48.0, 10.0)),
    "flex 200": ((100.0,), (150.0, 60.0, 180.0, 40.0, 120.0)),
    "flex 1000": ((300.0,), (60.0, 500.0, 200.0, 800.0, 120.0)),
}
STRUCK = (1, 4, 8, 13)
CALIBRATION = 6


@dataclass(frozen=True)
class Run:
    """One simulated run: camera, pipette, reagent, volumes in µL and seed."""

    camera: str
    pipette: str
    reagent: str
    volumes: tuple[float, ...]
    seed: int


def runs(first: int, count: int, flex: bool = False) -> Iterator[Run]:
    """``count`` runs through cameras, pipettes, reagents and constant or varied volumes."""
    kinds = [
        (camera, pipette, reagent)
        for camera, pipette, reagent in product(CAMERAS, FLEX if flex else PIPETTES, REAGENTS)
        # At 640x480 a p20 tip is a hundred pixels long and its bore two wide.
        if pipette != "p20" or camera in ("bench", "drawn")
    ]
    for number in range(count):
        camera, pipette, reagent = kinds[number % len(kinds)]
        turn = number // len(kinds) + number
        yield Run(camera, pipette, reagent, VOLUMES[pipette][turn % 2], first + number)


def judged(
    run: Run, number_of_wells: int = 16, planted: Sequence[str] = FAULTS
) -> Iterator[tuple[int, str, Any, Any]]:
    """Number of the well, the fault planted in its place (or none), verdict and evidence."""
    from aegis_ot.sidecar import make_analyser
    from aegis_ot.simulation import SimulatedCamera
    from aegis_ot.vision.types import TrajectorySample

    session = session_of(run)
    analyser: Any = make_analyser().begin("run")
    wells = keyframes_of(run, number_of_wells)

    def judge(number: int, fault: str) -> Any:
        faults = [f"{fault}@#{number + 1}"] if fault else []
        camera = SimulatedCamera(run.seed, faults, session)
        for keyframe in wells[number]:
            camera.announce(keyframe)
            analyser.observe(keyframe, camera.frame_after(0.0, 5.0))
        return analyser.judge(number)

    for number in range(number_of_wells):
        for fault in planted if number in STRUCK else ():
            # Samples of earlier wells are looked up by identity: they stay what they are.
            streams = analyser._streams
            kept = {
                id(sample): sample
                for stream in streams.values()
                for sample in [*stream.scorer._own, *(pair[1] for pair in stream._first)]
                if isinstance(sample, TrajectorySample)
            }
            known = analyser._first, analyser._leftovers, analyser._asked
            analyser._streams = copy.deepcopy(streams, kept)
            analyser._first, analyser._leftovers = copy.deepcopy(known[:2])
            analyser._asked = dict(known[2])
            yield number, fault, *judge(number, fault)
            analyser._streams = streams
            analyser._first, analyser._leftovers, analyser._asked = known
        verdict, evidence = judge(number, "")
        yield number, "", verdict, evidence
        if is_question(verdict):
            analyser.confirm(number)


def session_of(run: Run) -> Any:
    """Camera, light and deck of a run."""
    import numpy as np

    from aegis_ot.simulation import SessionParameters
    from aegis_ot_lab.drawing.random_sessions import random_session

    if run.camera == "drawn":
        rng = np.random.default_rng((run.seed, 5))
        pipette, _ = (PIPETTES | FLEX)[run.pipette]
        return random_session(rng, pipette=pipette, size=(960, 540))
    return getattr(SessionParameters, run.camera)(run.seed)


def is_question(verdict: Any) -> bool:
    """Whether the operator is asked because the frames of a first well prove nothing."""
    return verdict.outcome.value == "undecided" and verdict.reason.startswith("No liquid is seen")


def well_name(number: int) -> str:
    """Of a run's wells, counted from 0, column by column."""
    return f"{'ABCDEFGH'[number % 8]}{number // 8 + 1}"


def keyframes_of(run: Run, number_of_wells: int) -> list[list[Any]]:
    from aegis_ot.vocabulary import Keyframe, KeyframeKind, WellRef

    source = WellRef("reservoir", "A1", "reservoir", "1")
    pipette, capacity = (PIPETTES | FLEX)[run.pipette]
    wells = []
    for number in range(number_of_wells):
        volume = run.volumes[number % len(run.volumes)]
        well = WellRef("plate", well_name(number), "plate", "2")
        frame = Keyframe(
            "run", 0, number, KeyframeKind.ASPIRATE, pipette, "left", 1,
            f"1:{number}", (source,), (well,), volume, volume, capacity, run.reagent,
        )  # fmt: skip
        loaded = (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
        wells.append(
            [
                replace(
                    frame, kind=kind, sequence=4 * number + place,
                    expected_ul=volume if kind in loaded else 0.0,
                    position=_place_of(kind, number),
                )
                for place, kind in enumerate(KeyframeKind)
            ]
        )  # fmt: skip
    return wells


def _place_of(kind: Any, number: int) -> tuple[float, float, float]:
    """Where a guarded robot holds the tip's end, mm: at the well's top before and after."""
    from aegis_ot.vocabulary import KeyframeKind

    if kind is KeyframeKind.ASPIRATE:
        return 146.9, 42.8, 5.6
    height = 4.5 if kind is KeyframeKind.DISPENSE else 14.3
    return 279.3 + 9.0 * (number // 8), 74.2 - 9.0 * (number % 8), height


def measure(
    first: int,
    count: int,
    progress: bool = False,
    wells: int = 16,
    planted: Sequence[str] = FAULTS,
    flex: bool = False,
) -> dict[str, Any]:
    """Counts over ``count`` runs: normal wells by outcome and route, faults caught by kind."""
    normals: Counter[str] = Counter()
    faults: Counter[tuple[str, str, str, str]] = Counter()
    drawn: defaultdict[str, list[float | None]] = defaultdict(list)
    alarms = []
    for run in runs(first, count, flex):
        liquid = "water" if run.reagent == "water" else "dye"
        for number, fault, verdict, evidence in judged(run, wells, planted):
            outcome = verdict.outcome.value
            if fault:
                when = "first wells" if number < CALIBRATION else "later"
                faults[run.pipette, liquid, fault, f"{when}: tried"] += 1
                faults[run.pipette, liquid, fault, f"{when}: caught"] += outcome != "pass"
                continue
            if is_question(verdict):
                outcome = "asked"
            normals[outcome] += 1
            if liquid == "dye":
                drawn[run.pipette] += _drawn_off(evidence)
            if number >= CALIBRATION:
                normals["after calibration"] += 1
                normals["routed"] += verdict.route.value != "silent_pass"
            if outcome not in ("pass", "asked"):
                alarms.append((repr(run), number + 1, outcome, verdict.reason))
        if progress:
            sys.stderr.write(f"{run}\n")
    table = [
        {"pipette": pipette, "liquid": liquid, "fault": fault, "which": which, "count": number}
        for (pipette, liquid, fault, which), number in sorted(faults.items())
    ]
    return {
        "frames": "simulated", "seeds": [first, first + count - 1], "normals": dict(normals),
        "faults": table, "alarms": alarms, "drawn": drawn,
    }  # fmt: skip


def _drawn_off(evidence: Any) -> list[float | None]:
    """By what share the volume that the camera saw drawn is off; ``None`` if it told none."""
    told = evidence["drawn_ul"]
    return [told and told[0] / evidence["expected_ul"]["transit"] - 1.0]


def show(found: dict[str, Any]) -> str:
    """The counts as text."""
    normals = found["normals"]
    total = sum(normals.get(outcome, 0) for outcome in ("pass", "asked", "fail", "undecided"))
    first, last = found["seeds"]
    alarmed = len({alarm[0] for alarm in found["alarms"]})
    after, routed = normals.get("after calibration", 0), normals.get("routed", 0)
    lines = [
        f"Live runs on simulated frames, seeds {found['seeds'][0]} to {found['seeds'][1]}",
        f"normal wells: {total}, asked about {normals.get('asked', 0)} (once a run at most), "
        f"failed {normals.get('fail', 0)}, "
        f"undecided {normals.get('undecided', 0)}; "
        f"to the gate {routed}/{after} ({100 * routed / max(after, 1):.1f} %)",
        f"runs with a normal well failed or undecided: {alarmed} of {last - first + 1}",
    ]
    for pipette, wells in sorted(found["drawn"].items()):
        off = [abs(one) for one in wells if one is not None]
        within = ", ".join(
            f"{sum(one <= limit for one in off)} within {limit:.0%}" for limit in (0.05, 0.1)
        )
        lines.append(
            f"{pipette}, dye: volume drawn told of {len(off)}/{len(wells)} normal wells, {within}"
        )
    lines.append("faults caught of those tried, in a liquid's first six wells and later:")
    counts = {
        (row["pipette"], row["liquid"], row["fault"], row["which"]): row["count"]
        for row in found["faults"]
    }
    lines.append(f"{'pipette':9} {'liquid':6} " + " ".join(f"{fault:>12}" for fault in FAULTS))
    for pipette, liquid in sorted({key[:2] for key in counts}):
        cells = []
        for fault in FAULTS:
            shares = [
                f"{counts.get((pipette, liquid, fault, f'{when}: caught'), 0)}"
                f"/{counts.get((pipette, liquid, fault, f'{when}: tried'), 0)}"
                for when in ("first wells", "later")
            ]
            cells.append(f"{' '.join(shares):>12}")
        lines.append(f"{pipette:9} {liquid:6} " + " ".join(cells))
    lines += [f"alarm on a normal well: {alarm}" for alarm in found["alarms"]]
    return "\n".join(lines) + "\n"


def main(arguments: list[str] | None = None) -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.live_runs", description=__doc__)
    parser.add_argument("--seeds", nargs=2, type=int, default=(REPORT_SEED, 30))
    parser.add_argument("--wells", type=int, default=16, help="of each run")
    parser.add_argument("--no-faults", action="store_true", help="normal wells only")
    parser.add_argument("--only", choices=("planted", "silent", "camera"))
    parser.add_argument("--flex", action="store_true", help="a Flex's pipettes and tips")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args(arguments)
    planted = () if given.no_faults else FAULTS
    first, count = given.seeds
    found: dict[str, Any] = {}
    if given.only in (None, "planted"):
        found = measure(
            first, count, progress=True, wells=given.wells, planted=planted, flex=given.flex
        )
        sys.stdout.write(show(found))
    if given.only != "planted" and not given.no_faults:
        from . import silent_passes

        found["silent"] = silent_passes.measure(
            list(runs(first, count, given.flex)), progress=True, faults=given.only != "camera"
        )
        sys.stdout.write(silent_passes.show(found["silent"]))
    if given.json is not None:
        given.json.write_text(json.dumps(found, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
