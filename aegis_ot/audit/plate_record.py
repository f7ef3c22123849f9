"""What a run's record says was put into each well of a plate, and taken out of it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..account import plate_maps
from ..errors import ConfigurationError
from ..vision.plate import FORMATS, PlateFormat

Key = tuple[str, str]
"""Labware and well."""


@dataclass
class RecordedWell:
    """One well, by the record.

    Attributes:
        gained: µL of each liquid that is there now and was not before the run.
        received: µL that were dispensed, whatever left again.
        taken: µL that were drawn.
        unknown: Whether some of what it gained or lost is liquid that nobody can tell: its own from
            before the run.
        failed: Whether the run's verdict failed a delivery into it.
    """

    gained: dict[str, float] = field(default_factory=dict)
    received: float = 0.0
    taken: float = 0.0
    unknown: bool = False
    failed: bool = False

    @property
    def touched(self) -> bool:
        return self.received > 0 or self.taken > 0


@dataclass(frozen=True)
class RecordedPlate:
    """A plate that a run delivered to.

    Attributes:
        key: Of its labware.
        title: What the scientist called it, and where it stood.
        plate: Its kind.
        wells: By name; those that the run did not touch are left out.
    """

    key: str
    title: str
    plate: PlateFormat
    wells: Mapping[str, RecordedWell]


def recorded_plate(overview: Mapping[str, Any], slot: str, wells: int | None) -> RecordedPlate:
    """The plate that pictures show.

    Args:
        overview: Of the run.
        slot: Where it stood, as the user says; empty if there is one plate only.
        wells: How many it has, as the user says; ``None`` if its name tells.

    Raises:
        ConfigurationError: Which plate it is, or how many wells it has, cannot be told.
    """
    maps = plate_maps(overview["trajectories"])
    if not maps:
        raise ConfigurationError("--plate: by its record the run delivered to no plate.")
    asked = [one for one in maps if not slot or one.title.endswith(f", slot {slot}")]
    if len(asked) != 1:
        known = "; ".join(one.title for one in maps)
        problem = f"none stood in slot {slot}" if slot and not asked else "which one is it?"
        raise ConfigurationError(
            f"--plate: the run delivered to {known}: {problem} Name its slot with --plate-slot."
        )
    one = asked[0]
    named = re.search(r"\b(\d+)[ -_]?well", one.title, re.IGNORECASE)
    count = wells or (int(named[1]) if named else 0)
    plate = FORMATS.get(count)
    if plate is None:
        raise ConfigurationError(
            f"--plate: the record calls the plate {one.title!r}, which does not tell how many "
            f"wells it has. Say it with --plate-wells: {', '.join(map(str, FORMATS))}."
        )
    contents = _contents(overview["trajectories"], one.key)
    strange = [well for well in contents if well not in plate.names]
    if strange:
        raise ConfigurationError(
            f"--plate: the run used {strange[0]} of {one.title}, which a plate of {count} wells "
            "does not have. Say how many it has with --plate-wells."
        )
    return RecordedPlate(one.key, one.title, plate, contents)


def _contents(trajectories: Sequence[Mapping[str, Any]], key: str) -> dict[str, RecordedWell]:
    """Of the wells of one plate, after all deliveries. Recoveries only put right what failed."""
    held: dict[Key, RecordedWell] = {}
    for entry in trajectories:
        told = [frame for frame in entry["keyframes"] if frame["destinations"]]
        if not told or entry["abandoned"] or told[-1]["recovers"] is not None:
            continue
        last = told[-1]
        targets, sources = last["destinations"], last["sources"]
        for place, target in enumerate(targets):
            source = sources[place if len(sources) == len(targets) else 0] if sources else None
            well = held.setdefault((target["labware"], target["name"]), RecordedWell())
            if source is None:
                well.unknown = True
            else:
                _move(held, source, well, float(last["commanded_ul"]), last["reagent"], key)
            well.received += float(last["commanded_ul"])
            well.failed |= (entry["verdict"] or {}).get("outcome") == "fail"
    return {well: one for (labware, well), one in held.items() if labware == key and one.touched}


def _move(
    held: dict[Key, RecordedWell],
    source: Mapping[str, Any],
    target: RecordedWell,
    volume: float,
    reagent: str | None,
    key: str,
) -> None:
    """Move a volume: of what the run had put there as it is mixed, else of the source's own."""
    place = (source["labware"], source["name"])
    there = held.setdefault(place, RecordedWell())
    there.taken += volume
    total = sum(there.gained.values())
    if total >= volume - 1e-6 and not there.unknown:
        moved = {liquid: ul * volume / total for liquid, ul in there.gained.items()}
        for liquid, ul in moved.items():
            there.gained[liquid] -= ul
    else:
        # Its own liquid: on the pictured plate that is a liquid by itself, of unknown colour.
        own = place[0] == key or there.received > 0
        there.unknown = own
        name = f"liquid of {source['name']}" if own or not reagent else reagent
        moved = {name: volume}
    for liquid, ul in moved.items():
        target.gained[liquid] = target.gained.get(liquid, 0.0) + ul
