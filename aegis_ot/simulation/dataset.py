"""Synthetic trajectory data sets, and an endless supply of frames with their truth.

Data sets are written in the format that every Layer 2 command reads, with ``meta.json`` saying
that their source is ``"synthetic"``: call results on them so.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import ConfigurationError
from ..vision.dataset_writer import DatasetWriter
from ..vision.tips import TIPS, TipGeometry, pipette_class, tip_for
from ..vision.types import Image, TipDetection, TrajectorySample
from ..vocabulary import KeyframeKind
from .dyes import DYES, Dye
from .exposure import decode
from .render import FrameTruth, TipTruth, render_jpeg
from .scene import SceneState, SessionParameters, TipContent, place_tip

REAGENTS = ("red", "yellow", "water")

_PARTIALS = ("partial_25", "partial_50", "partial_75")
_REST = (
    *("partial_single",) * 9,
    *("partial_accumulated",) * 6,
    *("no_dispense",) * 6,
    *("air_bubble",) * 6,
)
_KEPT = {"partial_25": 0.75, "partial_50": 0.5, "partial_75": 0.25, "no_dispense": 1.0}


@dataclass(frozen=True)
class PlannedWell:
    """One trajectory of a data set before it is rendered: ``""`` is a normal one."""

    plate: int
    reagent: str
    failure: str


def paper_plan(plates: int = 16, rng: np.random.Generator | None = None) -> list[PlannedWell]:
    """The wells of a set in the paper's shape.

    With 16 plates: 26 normal, 36 failures (25, 50 and 75 % dispensed three each, nine single and
    six accumulated partials, six without dispense, six bubbles; twelve of each kind of reagent)
    and two without a tip. Other numbers of plates keep these proportions. A plate's first well
    is normal, and it has one reagent.

    Raises:
        ConfigurationError: Fewer than one plate.
    """
    if plates < 1:
        raise ConfigurationError(f"A data set needs at least one plate, not {plates}.")
    rng = rng or np.random.default_rng(0)
    normals, failures = round(26 * plates / 16), round(36 * plates / 16)
    # Each reagent gets its share of every kind of failure.
    kinds = [*_PARTIALS * 3, *_REST] * (failures // 36 + 1)
    by_reagent: dict[str, list[str]] = {reagent: [] for reagent in REAGENTS}
    for kind in sorted(set(kinds), key=kinds.index):
        for i in range(round(kinds.count(kind) * failures / len(kinds))):
            by_reagent[REAGENTS[i % 3]].append(kind)
    short = failures - sum(len(queue) for queue in by_reagent.values())
    for i in range(max(short, 0)):
        by_reagent[REAGENTS[i % 3]].append("partial_single")
    for queue in by_reagent.values():
        rng.shuffle(queue)

    reagents = [REAGENTS[plate % 3] for plate in range(plates)]
    wells: list[list[str]] = [[""] for _ in range(plates)]
    for plate in range(normals - plates):
        wells[plate % plates].append("")
    homes = {r: [p for p in range(plates) if reagents[p] == r] or [0] for r in REAGENTS}
    for reagent, queue in by_reagent.items():
        for i, kind in enumerate(queue):
            wells[homes[reagent][i % len(homes[reagent])]].append(kind)
    for plate in range(round(2 * plates / 16)):
        wells[plate].append("no_tip")
    plan = []
    for plate, kinds_here in enumerate(wells):
        later = kinds_here[1:]
        rng.shuffle(later)
        plan += [PlannedWell(plate, reagents[plate], kind) for kind in ["", *later]]
    return plan


def write_dataset(
    folder: str | Path,
    plates: int = 16,
    seed: int = 0,
    pipette: str = "p1000",
    *,
    size: tuple[int, int] = (640, 480),
    parameters: SessionParameters | None = None,
) -> Path:
    """Write a synthetic data set in the paper's shape.

    Args:
        folder: New or empty folder.
        plates: Number of plates, each a session of its own.
        seed: Fixes everything.
        pipette: ``"p1000"``, ``"p20"``...
        size: Frame width and height, px.
        parameters: One session for all plates; by default one is drawn for each.

    Returns:
        The folder.

    Raises:
        ConfigurationError: Fewer than one plate.
        DatasetError: The folder holds a data set already.
    """
    rng = np.random.default_rng((seed, 20))
    plan = paper_plan(plates, rng)
    tip = tip_for(pipette)
    short = pipette_class(pipette)
    sessions = [
        parameters or SessionParameters.draw(rng, pipette=pipette, size=size) for _ in range(plates)
    ]
    volumes = [_volume(rng, tip) for _ in range(plates)]
    meta = {
        "source": "synthetic",
        "renderer": "aegis_ot.simulation",
        "seed": seed,
        "pipette": short,
        "tip": tip.name,
        "plates": [asdict(session) for session in sessions],
        "volumes_ul": volumes,
    }
    counts = dict.fromkeys(range(plates), 0)
    with DatasetWriter(folder, meta) as writer:
        for well in plan:
            order = counts[well.plate]
            counts[well.plate] += 1
            name = f"{'ABCDEFGH'[order % 8]}{order // 8 + 1}"
            sample, jpegs = render_trajectory(
                f"p{well.plate:02d}_{name}", name, well, short, tip, volumes[well.plate],
                sessions[well.plate], rng,
            )  # fmt: skip
            writer.add(sample, jpegs)
    return Path(folder)


def _volume(rng: np.random.Generator, tip: TipGeometry) -> float:
    """A plate's volume: 10 to 30 % of a large tip, 40 to 90 % of a small one, µL."""
    low, high = (0.1, 0.3) if tip.nominal_ul >= 1000 else (0.4, 0.9)
    step = 50.0 if tip.nominal_ul >= 1000 else 25.0 if tip.nominal_ul >= 200 else 1.0
    return float(round(tip.nominal_ul * rng.uniform(low, high) / step) * step)


def contents_of(
    failure: str, volume: float, rng: np.random.Generator, film: float = 0.004
) -> tuple[dict[KeyframeKind, TipContent], float | None]:
    """What a tip holds at each keyframe of one trajectory, and the retained fraction, if any.

    ``failure`` is a failure type of the data set format, empty for a normal one.
    """
    if failure == "no_tip":
        return dict.fromkeys(KeyframeKind, TipContent(present=False)), None
    drawn, gap, kept = volume, 0.0, 0.0
    before = 0.0
    if failure in _KEPT:
        kept = _KEPT[failure]
    elif failure == "partial_single":
        kept = float(rng.uniform(0.15, 0.85))
    elif failure == "partial_accumulated":
        kept = float(rng.uniform(0.15, 0.6))
        before = kept * volume * float(rng.uniform(0.3, 1.0))
    elif failure == "air_bubble":
        gap = volume * float(rng.uniform(0.03, 0.12))
        drawn = volume - gap
    elif failure == "no_aspirate":
        drawn = 0.0
    full = TipContent(
        liquid_ul=before + drawn, gap_ul=gap, gap_below_ul=drawn * float(rng.uniform(0.2, 0.7))
    )
    left = kept * volume
    wet = film * drawn
    empty = TipContent(liquid_ul=left, film_ul=wet, film_to_ul=full.liquid_ul + gap)
    states = {
        KeyframeKind.ASPIRATE: full,
        KeyframeKind.TRANSIT: full,
        KeyframeKind.DISPENSE: empty,
        KeyframeKind.POST_DISPENSE: empty,
    }
    return states, kept if kept > 0 else (1.0 if failure == "no_dispense" else None)


def render_trajectory(
    identifier: str,
    name: str,
    well: PlannedWell,
    pipette: str,
    tip: TipGeometry,
    volume: float,
    session: SessionParameters,
    rng: np.random.Generator,
) -> tuple[TrajectorySample, dict[KeyframeKind, bytes]]:
    """One trajectory with its true detections, and its four frames as JPEG.

    Args:
        identifier: Its id.
        name: Name of its well, ``"A1"``.
        well: Plate, reagent and failure type.
        pipette: Short class, ``"p1000"``.
        tip: The tip it carries.
        volume: Commanded volume, µL.
        session: Camera, light and deck.
        rng: Source of randomness.
    """
    states, kept = contents_of(well.failure, volume, rng, session.film)
    drops = rng.random() < session.drop_chance and well.failure != "no_tip"
    column = 1 + int(rng.integers(12))
    jpegs: dict[KeyframeKind, bytes] = {}
    truths: dict[KeyframeKind, FrameTruth] = {}
    for kind, content in states.items():
        if drops and kind is KeyframeKind.POST_DISPENSE:
            content = replace(content, drop_ul=min(4.0, 0.02 * volume) * rng.uniform(0.3, 1.0))
        state = place_tip(
            session, kind, tip, (content,), DYES[well.reagent],
            source="A1", destination=f"{name[0]}{column}",
        )  # fmt: skip
        jpegs[kind], truths[kind] = render_jpeg(state, session, rng)
    sample = TrajectorySample(
        id=identifier,
        plate=f"plate{well.plate:02d}",
        well=name,
        pipette=pipette,
        reagent=well.reagent,
        volume_ul=volume,
        frames={kind: decode(jpeg) for kind, jpeg in jpegs.items()},
        detections={kind: as_detection(truth.tip) for kind, truth in truths.items()},
        expected_ul={
            kind: volume if kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT) else 0.0
            for kind in KeyframeKind
        },
        label="failure" if well.failure else "normal",
        failure_type=well.failure,
        retained_fraction=kept,
    )
    return sample, jpegs


def as_detection(truth: TipTruth) -> TipDetection | None:
    """The detection that a perfect detector would give for a tip; ``None`` without one."""
    if truth.box is None:
        return None
    x, y, w, h = truth.box
    return TipDetection(x, y, w, h, 1.0, orifice=truth.orifice, collar=truth.collar)


_PIPETTES = ("p1000", "p300", "p20", "p10", "flex_1channel_50", "flex_1channel_1000")
_SIZES = ((640, 480), (640, 480), (960, 540), (1280, 720))


def random_frames(
    seed: int,
    *,
    pipettes: tuple[str, ...] = _PIPETTES,
    sizes: tuple[tuple[int, int], ...] = _SIZES,
    frames_per_session: int = 6,
    measured: float = 0.0,
    without_tip: float = 0.125,
) -> Iterator[tuple[Image, FrameTruth]]:
    """Frames with their truth, without end, for training a detector.

    A new session (camera, light, deck, pipette, tip) is drawn every ``frames_per_session``
    frames; reagent, volume, fault, well and height change with each frame. Synthetic,
    deterministic in ``seed``.

    Args:
        seed: Fixes the sequence.
        pipettes: Pipettes to draw from, Opentrons names or classes.
        sizes: Frame sizes to draw from, px.
        frames_per_session: Frames that share a session.
        measured: Share of sessions that stand where the measured webcam and the recommended one
            do, whatever the pipette; their frame sizes are their own.
        without_tip: Share of frames without a tip.
    """
    rng = np.random.default_rng((seed, 21))
    while True:
        pipette = pipettes[int(rng.integers(len(pipettes)))]
        channels = 8 if "multi" in pipette or "8channel" in pipette else 1
        if measured and rng.random() < measured:
            views = (SessionParameters.webcam, SessionParameters.webcam, SessionParameters.bench)
            fixed = views[int(rng.integers(3))] if channels == 1 else SessionParameters.corner
            session = fixed(int(rng.integers(2**31)))
        else:
            size = sizes[int(rng.integers(len(sizes)))]
            session = SessionParameters.draw(rng, pipette=pipette, size=size)
        tip = _any_tip(rng, pipette)
        for _ in range(frames_per_session):
            state = _random_state(rng, session, tip, without_tip, channels)
            jpeg, truth = render_jpeg(state, session, rng)
            yield decode(jpeg), truth


def _any_tip(rng: np.random.Generator, pipette: str) -> TipGeometry:
    """The pipette's tip, now and then a smaller one that fits it too."""
    tip = tip_for(pipette)
    smaller = [
        t for t in TIPS.values()
        if t.name[:4] == tip.name[:4] and abs(t.nozzle_radius_mm - tip.nozzle_radius_mm) < 0.5
    ]  # fmt: skip
    return smaller[int(rng.integers(len(smaller)))] if smaller else tip


def _random_state(
    rng: np.random.Generator,
    session: SessionParameters,
    tip: TipGeometry,
    without_tip: float,
    channels: int,
) -> SceneState:
    kind = tuple(KeyframeKind)[int(rng.integers(4))]
    volume = tip.nominal_ul * float(rng.uniform(0.05, 1.0))
    failure = "no_tip" if rng.random() < without_tip else _random_failure(rng)
    content = contents_of(failure, volume, rng, session.film)[0][kind]
    if content.present and rng.random() < 0.1:
        content = replace(content, drop_ul=float(rng.uniform(0.1, 4.0)))
    names = tuple(DYES)
    dye: Dye = DYES["water" if rng.random() < 0.3 else names[int(rng.integers(len(names)))]]
    wells = [f"{'ABCDEFGH'[rng.integers(8)]}{rng.integers(1, 13)}" for _ in range(2)]
    state = place_tip(
        session, kind, tip, (content,) * channels, dye, source=wells[0], destination=wells[1],
        transit_over="source" if rng.random() < 0.5 else "destination",
    )  # fmt: skip
    x, y, z = state.orifice
    lift = 0.0 if state.rim_z is not None else float(rng.uniform(-20.0, 15.0))
    return replace(state, orifice=(x + rng.uniform(-4, 4), y + rng.uniform(-20, 20), z + lift))


def _random_failure(rng: np.random.Generator) -> str:
    kinds = ("", "", *_PARTIALS, *sorted(set(_REST)), "no_aspirate")
    return kinds[int(rng.integers(len(kinds)))]
