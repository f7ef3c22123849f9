"""Render a trajectory data set of several kinds of camera by path tracing.

``python -m scripts.path_traced OUT [--kind NAME]... [--plates 4] [--seed 1]``
``python -m scripts.path_traced OUT --mixed [--seed 1]``
``python -m scripts.path_traced OUT --for-detector N [--rows] [--sleeves] [--seed 1]``

It needs ``pip install mitsuba pyoidn`` beside ``aegis-ot[sidecar]``; a plate of twelve wells
takes a minute or two. ``meta.json`` names the kind of each plate, which
``aegis-ot evaluate layer2 OUT --leave-out camera`` leaves out as a whole. ``--mixed`` renders two
plates of each of all ten kinds, one after the other with other pipettes and liquids.
``--for-detector``
renders instead N plates of three wells, each before a camera of its own and the last without a
tip: for ``aegis-ot train detector``; ``--sleeves``: of tips whose upper part is a sleeve, as real
ones' is. ``--rows``: of eight tips each, whose axes stand in ``axes.csv``.
"""

from __future__ import annotations

import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from aegis_ot.simulation.dyes import DYES
from aegis_ot.vision.tips import tip_for
from aegis_ot_lab.drawing.dataset import SimulatedPlate, typical_volume, write_plates
from aegis_ot_lab.drawing.plans import REAGENTS, PlannedWell

from .kinds import KINDS, LATER_KINDS, CameraKind, any_kind, any_row, draw_session
from .stage import Lamps
from .tips import Sleeve

FIRST_NORMALS = 4
"""Normal wells at a plate's start: a run's calibration."""
LATER = (
    *("", "", "partial_25", "partial_50", "partial_75"),
    *("partial_single", "no_dispense", "air_bubble"),
)
"""The wells after them, in a random order."""


def main() -> None:
    from .tracer import FOR_DETECTOR, PathTracer

    parser = argparse.ArgumentParser(prog="python -m scripts.path_traced", description=__doc__)
    parser.add_argument("out", type=Path, help="new or empty folder")
    kinds = {**KINDS, **LATER_KINDS}
    parser.add_argument(
        "--kind", action="append", choices=list(kinds), help="default: the first six"
    )
    parser.add_argument("--plates", type=int, default=4, help="of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--for-detector",
        type=int,
        default=0,
        metavar="N",
        help="cameras, instead of plates of kinds",
    )
    parser.add_argument("--mixed", action="store_true", help="two plates of all ten kinds")
    parser.add_argument("--rows", action="store_true", help="of eight tips, for the detector")
    parser.add_argument("--sleeves", action="store_true", help="on the tips, for the detector")
    asked = parser.parse_args()
    if asked.for_detector and asked.kind:
        parser.error("--for-detector draws its own cameras: leave --kind out")
    if asked.mixed and (asked.for_detector or asked.kind):
        parser.error("--mixed renders all ten kinds: leave --kind and --for-detector out")
    if (asked.rows or asked.sleeves) and not asked.for_detector:
        parser.error("--rows and --sleeves say what --for-detector N renders: name that too")
    rng = np.random.default_rng((asked.seed, 31))
    plates, plan, lamps, cameras, sleeves = [], [], {}, {}, {}
    if asked.mixed:
        wanted = [(name, at + turn) for turn in (0, 1) for at, name in enumerate(kinds)]
    else:
        named = () if asked.for_detector else asked.kind or KINDS
        wanted = [(name, number) for name in named for number in range(asked.plates)]
    for name, number in wanted:
        plate, light = _plate(name, kinds[name], number, rng)
        plan += _wells(len(plates), number, rng)
        plates.append(plate)
        lamps[plate.session.seed] = light
        if kinds[name].sleeves:
            sleeves[plate.session.seed] = Sleeve.draw(rng)
        cameras[plate.name] = name
    for number in range(asked.for_detector):
        kind = any_row(rng) if asked.rows else any_kind(rng)
        plate, light = _plate("row" if asked.rows else "any", kind, number, rng)
        # A data set's plate begins with a normal well.
        for failure in ("", str(rng.choice(LATER)), "no_tip"):
            plan.append(PlannedWell(number, str(rng.choice(tuple(DYES))), failure))
        plates.append(plate)
        lamps[plate.session.seed] = light
        if asked.sleeves:
            sleeves[plate.session.seed] = Sleeve.draw(rng)
    meta: dict[str, Any] = {
        "source": "rendered",
        "renderer": "path-traced (scripts/path_traced)",
        "seed": asked.seed,
        "cameras": cameras,
        "plates": [asdict(plate.session) for plate in plates],
        "lamps": [asdict(lamps[plate.session.seed]) for plate in plates],
        "sleeves": [asdict(sleeve) for sleeve in sleeves.values()],
    }
    quality = FOR_DETECTOR if asked.for_detector else None
    write_plates(asked.out, plates, plan, meta, rng, PathTracer(lamps, quality, sleeves))


def _plate(
    name: str, kind: CameraKind, number: int, rng: np.random.Generator
) -> tuple[SimulatedPlate, Lamps]:
    pipette = kind.pipettes[number % len(kind.pipettes)]
    session, light = draw_session(kind, pipette, rng)
    volume = typical_volume(rng, tip_for(pipette))
    return SimulatedPlate(f"{name}-{number:02d}", session, pipette, volume), light


def _wells(plate: int, number: int, rng: np.random.Generator) -> list[PlannedWell]:
    reagent = REAGENTS[number % len(REAGENTS)]
    later = rng.permutation(np.array(LATER, dtype=object))
    return [PlannedWell(plate, reagent, str(kind)) for kind in [""] * FIRST_NORMALS + list(later)]


if __name__ == "__main__":
    main()
