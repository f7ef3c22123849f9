"""What a run's record says was put into each well of a plate, and taken out of it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ..errors import ConfigurationError
from ..run_view import PlateView, plates_of
from ..run_view.overview import DeliveryEntry, WellEntry
from ..vision.plate import FORMATS, PlateFormat

Key = tuple[str, str]
"""Labware and well."""


@dataclass
class RecordedWell:
    """One well, by the record.

    Attributes:
        gained: µL of each liquid that is there now and was not before the run. A liquid is what
            one source well holds: two sources of one name may differ in colour.
        received: µL that were dispensed, whatever left again.
        unknown: Whether some of what it gained or lost is liquid that nobody can tell: its own from
            before the run, or that of a delivery that was given up.
        failed: Whether the run's verdict failed a delivery into it, and nothing put it right.
    """

    gained: dict[str, float] = field(default_factory=dict)
    received: float = 0.0
    unknown: bool = False
    failed: bool = False


@dataclass(frozen=True)
class RecordedPlate:
    """A plate that a run delivered to.

    Attributes:
        title: What the scientist called it, and where it stood first.
        plate: Its kind.
        wells: By name; those that the run did not touch are left out.
    """

    title: str
    plate: PlateFormat
    wells: Mapping[str, RecordedWell]


def recorded_plate(
    trajectories: Sequence[DeliveryEntry], slot: str, wells: int | None
) -> RecordedPlate:
    """The plate that pictures show.

    Args:
        trajectories: Of the run's overview.
        slot: Where it stood at any time, or its label, or its key, as the user says; empty if there
            is one plate only.
        wells: How many it has, as the user says; ``None`` if its name tells.

    Raises:
        ConfigurationError: Which plate it is, or how many wells it has, cannot be told.
    """
    one = _asked(trajectories, slot)
    count = wells or _named(one.title)
    if count not in FORMATS:
        said = f"has {count} wells" if count else "does not tell how many wells it has"
        raise ConfigurationError(
            f"--plate: {one.title!r}, as the record calls it, {said}. Plates of "
            f"{', '.join(map(str, FORMATS))} wells can be compared: say it with --plate-wells."
        )
    plate = FORMATS[count]
    contents = _contents(trajectories, one)
    strange = next((well for well in contents if well not in plate.names), None)
    if strange is not None:
        raise ConfigurationError(
            f"--plate: the run used {strange} of {one.title}, which a plate of {count} wells "
            "does not have. Say how many it has with --plate-wells."
        )
    return RecordedPlate(one.title, plate, contents)


def _asked(trajectories: Sequence[DeliveryEntry], slot: str) -> PlateView:
    maps = plates_of({"trajectories": list(trajectories)})
    if not maps:
        raise ConfigurationError("--plate: by its record the run delivered to no plate.")
    if slot:
        asked = [one for one in maps if slot.lower() in _called(trajectories, one.key)]
    else:
        # Tube racks and reservoirs receive liquid too.
        asked = maps if len(maps) == 1 else [one for one in maps if _named(one.title) in FORMATS]
    if len(asked) == 1:
        return asked[0]
    known = "; ".join(f"{one.title} ({one.key})" for one in maps)
    problem = f"none of them is {slot!r}." if slot and not asked else "which one is it?"
    raise ConfigurationError(
        f"--plate: the run delivered to {known}: {problem} Name its slot, its label or what stands "
        "in brackets with --plate-slot."
    )


def _called(trajectories: Sequence[DeliveryEntry], key: str) -> set[str]:
    """Its key, its labels and all slots in which it stood, in small letters."""
    named = {key.lower()}
    for entry in trajectories:
        for frame in entry["keyframes"]:
            for well in (*frame["destinations"], *frame["sources"]):
                if well["labware"] == key:
                    named |= {str(well["slot"] or "off deck").lower(), str(well["label"]).lower()}
    return named - {""}


def _named(title: str) -> int:
    """How many wells a name such as ``"Corning 96 Well Plate"`` tells; 0 if none."""
    named = re.search(r"\b(\d+)[ -_]?well", title, re.IGNORECASE)
    return int(named[1]) if named else 0


def _contents(trajectories: Sequence[DeliveryEntry], plate: PlateView) -> dict[str, RecordedWell]:
    """Of the wells of one plate, after all deliveries. Recoveries only put right what failed."""
    held: dict[Key, RecordedWell] = {}
    for entry in trajectories:
        told = [frame for frame in entry["keyframes"] if frame["destinations"]]
        if not told or told[-1]["recovers"] is not None:
            continue
        last = told[-1]
        targets, sources = last["destinations"], last["sources"]
        for place, target in enumerate(targets):
            source = sources[place if len(sources) == len(targets) else 0] if sources else None
            well = held.setdefault((target["labware"], target["name"]), RecordedWell())
            volume = float(last["commanded_ul"])
            if source is None or entry["abandoned"] is not None:
                well.unknown = True
            else:
                _move(held, source, well, volume, last["reagent"], plate.key)
            well.received += volume
    touched = {
        well: one
        for (labware, well), one in held.items()
        if labware == plate.key and (one.received or one.unknown)
    }
    for name, held_well in touched.items():
        held_well.failed = name in plate.wells and plate.wells[name].state == "fail"
    return touched


def _move(
    held: dict[Key, RecordedWell],
    source: WellEntry,
    target: RecordedWell,
    volume: float,
    reagent: str | None,
    key: str,
) -> None:
    """Move a volume: of what the run had put there as it is mixed, else of the source's own."""
    place = (source["labware"], source["name"])
    there = held.setdefault(place, RecordedWell())
    total = sum(there.gained.values())
    if total >= volume - 1e-6 and not there.unknown:
        moved = {liquid: ul * volume / total for liquid, ul in there.gained.items()}
        for liquid, ul in moved.items():
            there.gained[liquid] -= ul
    else:
        # On the pictured plate its own liquid leaves a well of unknown colour.
        there.unknown = place[0] == key or there.received > 0
        where = f"{source['name']} of {source['label'] or source['labware']}"
        moved = {f"{reagent or 'liquid'} from {where}": volume}
    for liquid, ul in moved.items():
        target.gained[liquid] = target.gained.get(liquid, 0.0) + ul
