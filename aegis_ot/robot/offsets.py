"""Labware offsets that a robot keeps, and that a run made here would not have.

The Opentrons App measures them (Labware Position Check) and gives them to the runs that it makes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..errors import RobotError
from .client import RobotClient
from .places import Place

_LEAST_MM = 1e-3


def refuse_lost_offsets(robot: RobotClient, places: Iterable[Place]) -> None:
    """Refuse a run that would go without the offsets that its labware had before.

    Args:
        robot: Where it is to run.
        places: The labware that it uses: see :func:`~.places.places_of`.

    Raises:
        RobotError: A run that the robot keeps, or its own store, has an offset for one of them.
    """
    runs = sorted(robot.runs(), key=lambda run: str(run.get("createdAt", "")), reverse=True)
    stored = robot.stored_offsets()
    lost = []
    for uri, slot in sorted(set(places)):
        vector = _last_offset(runs, stored, uri, slot)
        if vector is not None and any(abs(part) >= _LEAST_MM for part in vector):
            shown = ", ".join(f"{part:g}" for part in vector)
            lost.append(f"{uri.split('/')[1]} in slot {slot} ({shown} mm)")
    if lost:
        raise RobotError(
            f"On this robot labware offsets are known for {'; '.join(lost)}. Runs that aegis-ot "
            "makes carry none, so the pipette would go elsewhere than in the last run. Start the "
            "run in the Opentrons App and follow it with aegis-ot watch, or start it without "
            "offsets: --offsets none."
        )


def _last_offset(
    runs: Iterable[Mapping[str, Any]], stored: Iterable[Mapping[str, Any]], uri: str, slot: str
) -> tuple[float, ...] | None:
    """What the newest run that had one for it had; else what the robot's store has.

    A run without any says nothing against it: it may have been made here.
    """
    for run in runs:
        found = [
            offset
            for offset in run.get("labwareOffsets") or ()
            if offset.get("definitionUri") == uri and _is_at(offset, slot)
        ]
        if found:
            return _vector(found[-1])
    kept = [o for o in stored if o.get("definitionUri") == uri and _is_at(o, slot)]
    return _vector(kept[-1]) if kept else None


def _is_at(offset: Mapping[str, Any], slot: str) -> bool:
    sequence = offset.get("locationSequence")
    areas = [part.get("addressableAreaName") for part in sequence or () if isinstance(part, dict)]
    return slot in areas or (offset.get("location") or {}).get("slotName") == slot


def _vector(offset: Mapping[str, Any]) -> tuple[float, ...]:
    vector = offset.get("vector") or {}
    return tuple(float(vector.get(axis, 0.0)) for axis in "xyz")
