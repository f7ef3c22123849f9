"""Labware offsets: what the robot keeps of them, for a run that would not have them otherwise.

The Opentrons App measures them (Labware Position Check) and gives them to the runs that it makes;
a run that is made through the robot's HTTP API has those that come with the request.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import ConfigurationError
from .client import RobotClient
from .places import Place

ANYWHERE = "anyLocation"
"""What a store says of an offset that serves wherever its labware stands."""
Record = Mapping[str, Any]


@dataclass(frozen=True)
class Offset:
    """An offset that the run will have.

    Attributes:
        place: Of the labware.
        vector: x, y, z, mm.
        source: Where it is kept, in words.
        request: What the robot is sent.
    """

    place: Place
    vector: tuple[float, float, float]
    source: str
    request: Record


def known_offsets(robot: RobotClient, places: Iterable[Place], flex: bool) -> list[Offset]:
    """The offsets that the robot keeps for these places.

    A Flex of 8.4 or newer has a store of them, which counts alone: what was cleared there is not
    brought back from an old run. Elsewhere it is what the newest run that had one for the place
    had: one without may have been made here.

    Args:
        robot: Where the run is to be.
        places: See :func:`~.places.places_of`.
        flex: Whether it is a Flex.

    Raises:
        RobotError: It does not tell them.
    """
    stored = robot.stored_offsets()
    runs: Sequence[Record] = () if flex and stored is not None else robot.runs()
    newest = sorted(runs, key=lambda run: str(run.get("createdAt", "")), reverse=True)
    found = []
    for place in sorted(set(places)):
        offset = _pick(stored or (), place, "the robot's store")
        for run in newest:
            if offset is not None:
                break
            day = str(run.get("createdAt", ""))[:10]
            offset = _pick(run.get("labwareOffsets") or (), place, f"its run of {day}")
        if offset is not None:
            found.append(offset)
    return found


def offsets_in_file(path: Path, places: Iterable[Place]) -> list[Offset]:
    """The offsets of a file that these places have: a list as the robot's API tells them
    (``/labwareOffsets``, or ``labwareOffsets`` of a run), bare or as ``data``.

    Raises:
        ConfigurationError: It cannot be read, is no such list, or has none for the protocol.
    """
    try:
        told = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ConfigurationError(f"--offsets {path}: {error.strerror}.") from None
    except ValueError:
        raise ConfigurationError(f"--offsets {path}: this is no JSON file.") from None
    for name in ("data", "labwareOffsets"):
        told = told.get(name, told) if isinstance(told, Mapping) else told
    records: list[Any] = told if isinstance(told, list) else [None]
    wrong = [n for n, record in enumerate(records, start=1) if not _is_offset(record)]
    if wrong:
        raise ConfigurationError(
            f"--offsets {path}: entry {wrong[0]} is no labware offset. One has a definitionUri, a "
            "location or locationSequence, and a vector of x, y and z in mm."
        )
    wanted = sorted(set(places))
    picked = [_pick(records, place, path.name) for place in wanted]
    found = [offset for offset in picked if offset is not None]
    if not found:
        known = "; ".join(map(tell_place, wanted)) or "none"
        raise ConfigurationError(
            f"--offsets {path}: no entry is for a labware of this protocol where it stands. Its "
            f"labware: {known}."
        )
    return found


def _pick(records: Iterable[Record], place: Place, source: str) -> Offset | None:
    """The newest for exactly this place, else the newest that serves anywhere."""
    best: Record | None = None
    for record in records:
        if record.get("definitionUri") != place.uri or not _vector(record):
            continue
        where = record.get("locationSequence")
        if where != ANYWHERE and not _is_at(record, place):
            continue
        if best is None or _rank(record) >= _rank(best):
            best = record
    if best is None:
        return None
    vector = _vector(best) or (0.0, 0.0, 0.0)
    request: dict[str, Any] = {
        "definitionUri": place.uri,
        "vector": dict(zip("xyz", vector, strict=True)),
    }
    if isinstance(best.get("locationSequence"), list):
        request["locationSequence"] = best["locationSequence"]
    else:
        request["location"] = _location(place)
    return Offset(place, vector, source, request)


def _rank(record: Record) -> tuple[bool, str]:
    return record.get("locationSequence") != ANYWHERE, str(record.get("createdAt", ""))


def _location(place: Place) -> dict[str, str]:
    """As robots of every version take it."""
    location = {"slotName": place.slot}
    if place.module:
        location["moduleModel"] = place.module
    if place.under:
        location["definitionUri"] = place.under[0]
    return location


def _is_at(record: Record, place: Place) -> bool:
    sequence = record.get("locationSequence")
    if not isinstance(sequence, list):
        location = record.get("location")
        return isinstance(location, Mapping) and _location(place) == {
            name: value for name, value in location.items() if value is not None
        }
    parts = [part for part in sequence if isinstance(part, Mapping)]
    under = tuple(str(part["labwareUri"]) for part in parts if part.get("labwareUri"))
    modules = [str(part["moduleModel"]) for part in parts if part.get("moduleModel")]
    if under != place.under or (modules or [""]) != [place.module]:
        return False
    areas = [str(part.get("addressableAreaName", "")) for part in parts]
    # A Flex calls the place on a module "temperatureModuleV2D1", on its one thermocycler without
    # a slot; an OT-2 by the slot.
    return (
        areas[-1:] == [place.slot]
        or (place.slot[:1].isalpha() and areas[-1:] == [f"{place.module}{place.slot}"])
        or areas[-1:] == [place.module]
    )


def _is_offset(record: Any) -> bool:
    if not isinstance(record, Mapping) or not isinstance(record.get("definitionUri"), str):
        return False
    where = record.get("locationSequence") or record.get("location")
    return bool(where) and _vector(record) is not None


def _vector(record: Record) -> tuple[float, float, float] | None:
    told = record.get("vector")
    values = [told.get(axis, 0.0) for axis in "xyz"] if isinstance(told, Mapping) else []
    if not values or any(isinstance(v, bool) or not isinstance(v, (int, float)) for v in values):
        return None
    x, y, z = map(float, values)
    return (x, y, z) if all(map(math.isfinite, (x, y, z))) else None


def tell_offsets(offsets: Sequence[Offset], places: Iterable[Place]) -> list[str]:
    """What the run will have, and what it will not, a line each."""
    lines = [
        f"Offset of {tell_place(one.place)}: "
        f"{', '.join(f'{axis} {v:g}' for axis, v in zip('xyz', one.vector, strict=True))} mm "
        f"(from {one.source})."
        for one in offsets
    ]
    rest = sorted(set(places) - {one.place for one in offsets})
    if rest:
        lines.append(f"No labware offset for {'; '.join(map(tell_place, rest))}.")
    return lines


def tell_place(place: Place) -> str:
    """``"corning_96_wellplate_360ul_flat in slot 2"``."""
    on = [name_of(uri) for uri in place.under] + ([place.module] if place.module else [])
    return f"{name_of(place.uri)} {f'on {on[0]} ' if on else ''}in slot {place.slot}"


def name_of(uri: str) -> str:
    """The load name in a definition's URI."""
    parts = uri.split("/")
    return parts[1] if len(parts) > 1 else uri
