"""Synthetic trajectory data sets.

They are written in the format that every Layer 2 command reads, with ``meta.json`` saying that
their source is ``"synthetic"``: call results on them so.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from aegis_ot.simulation.dyes import DYES
from aegis_ot.simulation.exposure import decode
from aegis_ot.simulation.render import render_jpeg
from aegis_ot.simulation.renderer import Renderer
from aegis_ot.simulation.scene import place_tip
from aegis_ot.simulation.session import SessionParameters
from aegis_ot.simulation.truth import FrameTruth, TipTruth
from aegis_ot.vision.dataset_checks import in_data_sets
from aegis_ot.vision.dataset_writer import DatasetWriter
from aegis_ot.vision.tips import TipGeometry, tip_for
from aegis_ot.vision.types import TipDetection, TrajectorySample
from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.vocabulary.pipette_names import channels_of

from .plans import PlannedWell, contents_of, normal_plan, paper_plan
from .random_sessions import random_session


@dataclass(frozen=True)
class SimulatedPlate:
    """What is the same for all wells of a plate.

    Attributes:
        name: Unique in its set.
        session: Camera, light and deck.
        pipette: As the data set names it: the short class of an OT-2's, a Flex's whole name.
        volume_ul: Commanded volume, µL.
    """

    name: str
    session: SessionParameters
    pipette: str
    volume_ul: float


def write_dataset(
    folder: str | Path,
    plates: int = 16,
    seed: int = 0,
    pipette: str = "p1000",
    *,
    size: tuple[int, int] = (640, 480),
    parameters: SessionParameters | None = None,
    normals_per_plate: int = 0,
) -> Path:
    """Write a synthetic data set in the paper's shape, or one of normal wells only.

    Args:
        folder: New or empty folder.
        plates: Number of plates, each a session of its own.
        seed: Fixes everything.
        pipette: ``"p1000"``, ``"p20"``...
        size: Frame width and height, px.
        parameters: One session for all plates; by default one is drawn for each.
        normals_per_plate: If positive, so many normal wells per plate and no failures, the
            volume drawn anew for each plate from all that the tip can hold.

    Returns:
        The folder.

    Raises:
        ConfigurationError: Fewer than one plate.
        DatasetError: The folder holds a data set already.
    """
    rng = np.random.default_rng((seed, 20))
    plan = normal_plan(plates, normals_per_plate) if normals_per_plate else paper_plan(plates, rng)
    tip = tip_for(pipette)
    short = in_data_sets(pipette)
    sessions = [
        parameters or random_session(rng, pipette=pipette, size=size) for _ in range(plates)
    ]
    volumes = [typical_volume(rng, tip, of_any_tip=normals_per_plate > 0) for _ in range(plates)]
    drawn = [
        SimulatedPlate(f"plate{i:02d}", session, short, volume)
        for i, (session, volume) in enumerate(zip(sessions, volumes, strict=True))
    ]
    meta = {
        "source": "synthetic",
        "renderer": "aegis_ot.simulation",
        "seed": seed,
        "pipette": short,
        "tip": tip.name,
        "plates": [asdict(session) for session in sessions],
        "volumes_ul": volumes,
    }
    return write_plates(folder, drawn, plan, meta, rng)


def write_plates(
    folder: str | Path,
    plates: Sequence[SimulatedPlate],
    plan: Iterable[PlannedWell],
    meta: Mapping[str, Any],
    rng: np.random.Generator,
    render: Renderer = render_jpeg,
) -> Path:
    """Write the wells of a plan as a data set, in the plan's order.

    Args:
        folder: New or empty folder.
        plates: What the plan's plate numbers stand for.
        plan: The wells.
        meta: Content of ``meta.json``.
        rng: Source of randomness.
        render: Draws the frames.

    Raises:
        DatasetError: The folder holds a data set already.
    """
    counts = dict.fromkeys(range(len(plates)), 0)
    with DatasetWriter(folder, meta) as writer:
        for well in plan:
            order = counts[well.plate]
            counts[well.plate] += 1
            name = f"{'ABCDEFGH'[order % 8]}{order // 8 + 1}"
            writer.add(
                *render_trajectory(
                    f"p{well.plate:02d}_{name}", name, well, plates[well.plate], rng, render
                )
            )
    return Path(folder)


def typical_volume(rng: np.random.Generator, tip: TipGeometry, of_any_tip: bool = False) -> float:
    """A plate's volume: 10 to 30 % of a large tip, 40 to 90 % of a small one, µL.

    ``of_any_tip``: 15 to 95 %, whatever its size.
    """
    low, high = (0.1, 0.3) if tip.nominal_ul >= 1000 else (0.4, 0.9)
    if of_any_tip:
        low, high = 0.15, 0.95
    step = 50.0 if tip.nominal_ul >= 1000 else 25.0 if tip.nominal_ul >= 200 else 1.0
    return float(round(tip.nominal_ul * rng.uniform(low, high) / step) * step)


def render_trajectory(
    identifier: str,
    name: str,
    well: PlannedWell,
    plate: SimulatedPlate,
    rng: np.random.Generator,
    render: Renderer = render_jpeg,
) -> tuple[
    TrajectorySample, dict[KeyframeKind, bytes], dict[KeyframeKind, tuple[TipDetection, ...]]
]:
    """One trajectory with its true detections, its four frames as JPEG, and a row's other tips.

    Args:
        identifier: Its id.
        name: Name of its well, ``"A1"``.
        well: Reagent and failure type.
        plate: Its plate.
        rng: Source of randomness.
        render: Draws the frames.
    """
    session, volume, tip = plate.session, plate.volume_ul, tip_for(plate.pipette)
    channels = channels_of(plate.pipette)
    states, kept = contents_of(well.failure, volume, rng, session.film)
    drops = rng.random() < session.drop_chance and well.failure != "no_tip"
    column = 1 + int(rng.integers(12))
    jpegs: dict[KeyframeKind, bytes] = {}
    truths: dict[KeyframeKind, FrameTruth] = {}
    positions: dict[KeyframeKind, tuple[float, float, float]] = {}
    for kind, content in states.items():
        if drops and kind is KeyframeKind.POST_DISPENSE:
            content = replace(content, drop_ul=min(4.0, 0.02 * volume) * rng.uniform(0.3, 1.0))
        state = place_tip(
            session, kind, tip, (content,) * channels, DYES[well.reagent],
            source="A1", destination=f"{name[0]}{column}",
        )  # fmt: skip
        positions[kind] = state.orifice
        jpegs[kind], truths[kind] = render(state, session, rng)
    sample = TrajectorySample(
        id=identifier,
        plate=plate.name,
        well=name,
        pipette=plate.pipette,
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
        positions=positions,
    )
    beside = {
        kind: tuple(
            one for tip in truth.tips if tip is not truth.tip and (one := as_detection(tip))
        )
        for kind, truth in truths.items()
    }
    return sample, jpegs, beside


def as_detection(truth: TipTruth) -> TipDetection | None:
    """The detection that a perfect detector would give for a tip; ``None`` without one."""
    if truth.box is None:
        return None
    x, y, w, h = truth.box
    return TipDetection(x, y, w, h, 1.0, orifice=truth.orifice, collar=truth.collar)
