"""A run that a sidecar has kept, well by well, for a person to look at."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import cv2
import numpy as np

from ..errors import StoreError
from ..evaluation.layer2 import Progress
from ..evaluation.layer2.recorded import run_source
from ..sidecar.overview import run_overview
from ..sidecar.store import Store
from ..vision.tips import TipGeometry, pipette_class, tip_for
from ..vision.types import Image
from ..vocabulary import KeyframeKind
from .choosing import pictured
from .levels import axis_of, mark_at, share_of
from .pictures import close_up, whole_frame
from .wells import Axis, Box, Inspection, Level, SeenFrame, SeenWell


def inspect_run(
    store: Store, run: str, most: int = 200, progress: Progress | None = None
) -> Inspection:
    """Gather what a person wants to see of a run; nothing is judged anew.

    Args:
        store: An open store.
        run: A run in it.
        most: Wells with pictures at most; the others keep their numbers. Flagged ones first.
        progress: Told how far it is.

    Raises:
        StoreError: The store cannot be read. A single frame that is missing or damaged is said
            in its place.
    """
    progress = progress or Progress()
    overview = run_overview(store, run)
    entries = overview["trajectories"]
    flagged = [
        (entry["verdict"] or {}).get("outcome") in ("fail", "undecided") for entry in entries
    ]
    chosen = pictured([(flag, False) for flag in flagged], most)
    progress.begin("Cutting pictures", len(entries))
    wells = []
    for entry, show in zip(entries, chosen, strict=True):
        wells.append(_well(store, run, entry, show))
        progress.step()
    source = run_source(overview)
    finished = overview.get("finished") or {}
    facts = [
        ("frames", source),
        ("protocol", str(overview.get("protocol") or "unknown")),
        ("run", str(finished.get("outcome") or "not finished")),
    ]
    names = {name for entry in entries for name in entry["evidence"].get("scores", {})}
    return Inspection(run, source, facts, wells, ", ".join(sorted(names)))


def _well(store: Store, run: str, entry: Mapping[str, Any], show: bool) -> SeenWell:
    verdict: Mapping[str, Any] = entry["verdict"] or {}
    evidence: Mapping[str, Any] = entry["evidence"]
    last: Mapping[str, Any] = entry["keyframes"][-1] if entry["keyframes"] else {}
    pipette, reagent = str(last.get("pipette", "")), last.get("reagent") or ""
    wells = last.get("destinations") or last.get("sources") or ()
    outcome, route = str(verdict.get("outcome", "")), str(verdict.get("route", ""))
    reason = str(verdict.get("reason", ""))
    if entry["abandoned"] is not None:
        reason = f"Given up: {entry['abandoned']}"
    band = evidence.get("band")
    return SeenWell(
        id=f"{run}-{entry['trajectory']}",
        group=", ".join(filter(None, (f"{last.get('mount', '')} {pipette}".strip(), reagent))),
        well=str(wells[0]["name"]) if wells else "-",
        title=f"{entry['well']}, {float(last.get('commanded_ul', 0.0)):g} µL {reagent}".rstrip(),
        outcome="calibration" if outcome == "pass" and route == "calibration" else outcome,
        route=route,
        gate=str(verdict.get("gate", "")),
        failure=str(verdict.get("failure") or ""),
        reason=reason,
        truth="",
        agreement="",
        score=verdict.get("score"),
        limit=band[1] if band else None,
        frames=_frames(store, run, entry, show),
    )


def _frames(
    store: Store, run: str, entry: Mapping[str, Any], show: bool
) -> dict[KeyframeKind, SeenFrame]:
    evidence = entry["evidence"]
    frames = {}
    for keyframe in entry["keyframes"]:
        kind = KeyframeKind(keyframe["kind"])
        image, missing = None, ""
        if show:
            image, missing = _image(store, run, int(keyframe["sequence"]))
        tip = tip_for(pipette_class(keyframe["pipette"]), keyframe["capacity_ul"])
        found = evidence.get("boxes", {}).get(kind.value)
        measured = evidence.get("measured_ul", {}).get(kind.value)
        box: Box | None = None if found is None else (*map(float, found),)  # type: ignore[assignment]
        # The store keeps no axes: an upright tip is drawn, which is a pixel or two off.
        axis = None if box is None else axis_of(box)
        frames[kind] = SeenFrame(
            None if image is None else whole_frame(image),
            None if image is None or box is None else close_up(image, box),
            box,
            evidence.get("confidence", {}).get(kind.value),
            None,
            axis,
            _level(tip, float(keyframe["expected_ul"]), axis, box),
            None
            if measured is None
            else _level(
                tip,
                float(measured["volume"]),
                axis,
                box,
                float(measured["uncertainty"] or 0.0),
                float(measured["air"] or 0.0),
            ),
            missing,
        )
    return frames


def _image(store: Store, run: str, sequence: int) -> tuple[Image | None, str]:
    try:
        data = store.frame(run, sequence)
    except StoreError:
        return None, "This frame is missing in the store."
    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR) if data else None
    if image is None:
        return None, "This frame is damaged in the store."
    return np.asarray(image, dtype=np.uint8), ""


def _level(
    tip: TipGeometry,
    volume: float,
    axis: Axis | None,
    box: Box | None,
    sigma: float = 0.0,
    air: float = 0.0,
) -> Level:
    mark = None
    if axis is not None and box is not None:
        mark = mark_at(axis, box, share_of(tip, volume + air))
    return Level(volume, sigma, air, mark)
