"""The plates of a run, well by well, with what is known of each well."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .seen import state_of

FORMATS = ((1, 1), (2, 3), (3, 4), (4, 6), (6, 8), (8, 12), (16, 24), (32, 48))
"""Rows and columns of the plates that there are; the smallest that has all wells is drawn."""

GRAVITY = (
    *("fail", "undecided", "waiting", "running", "recovered", "abandoned"),
    *("unobserved", "pass", "calibration"),
)
"""States from the one that a person must see to the one that needs nobody."""


@dataclass(frozen=True)
class PlateCell:
    """One well of a plate that received something.

    Attributes:
        well: ``"B3"``.
        state: One of :data:`GRAVITY`; of several deliveries the gravest one's.
        trajectory: Number of the delivery that gave the state.
        deliveries: How many there were.
        failure: What went wrong, for a fail.
        decided: Whether a person decided it.
    """

    well: str
    state: str
    trajectory: int
    deliveries: int = 1
    failure: str = ""
    decided: bool = False


@dataclass
class PlateMap:
    """One plate of a run.

    Attributes:
        key: Of the labware, unique within the run.
        title: What the scientist called it, and where it stood.
        rows, columns: Its size as far as the wells tell.
        cells: By well.
    """

    key: str
    title: str
    rows: Sequence[str] = ()
    columns: Sequence[int] = ()
    cells: dict[str, PlateCell] = field(default_factory=dict)


def plate_maps(trajectories: Sequence[Mapping[str, Any]]) -> list[PlateMap]:
    """The plates that liquid was delivered to, in the order in which that began.

    Args:
        trajectories: Of the run's overview.
    """
    plates: dict[str, PlateMap] = {}
    for trajectory in trajectories:
        told = _channels(trajectory)
        for well in _destinations(trajectory):
            title = str(well["label"] or well["labware"])
            slot = f"slot {well['slot']}" if well["slot"] else "off deck"
            plate = plates.setdefault(
                str(well["labware"]), PlateMap(str(well["labware"]), f"{title}, {slot}")
            )
            name = str(well["name"])
            plate.cells[name] = _graver(
                plate.cells.get(name), _cell(name, trajectory, told.get(name))
            )
    for plate in plates.values():
        plate.rows, plate.columns = _size(list(plate.cells), plate.title)
    return list(plates.values())


def _destinations(trajectory: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """The wells of the last keyframe that names any."""
    for keyframe in reversed(trajectory["keyframes"]):
        if keyframe["destinations"]:
            return list(keyframe["destinations"])
    return []


def _channels(trajectory: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """What the verdict says of each channel, by well; of several over one well, the gravest."""
    told: dict[str, Mapping[str, Any]] = {}
    for channel in (trajectory["verdict"] or {}).get("channels") or ():
        name = str((channel["well"] or {}).get("name", ""))
        known = told.get(name)
        if known is None or GRAVITY.index(channel["outcome"]) < GRAVITY.index(known["outcome"]):
            told[name] = channel
    return told


def _cell(name: str, trajectory: Mapping[str, Any], channel: Mapping[str, Any] | None) -> PlateCell:
    state, said = state_of(trajectory), channel or trajectory["verdict"] or {}
    if channel is not None and state in ("pass", "calibration", "fail", "undecided", "unobserved"):
        calibrates = state == "calibration" and channel["outcome"] == "pass"
        state = state if calibrates else str(channel["outcome"])
    return PlateCell(
        name,
        state,
        int(trajectory["trajectory"]),
        failure=str(said.get("failure") or "").replace("_", " "),
        decided=bool(trajectory["decisions"]),
    )


def _graver(known: PlateCell | None, new: PlateCell) -> PlateCell:
    if known is None:
        return new
    worse = GRAVITY.index(new.state) <= GRAVITY.index(known.state)
    shown = new if worse else known
    return PlateCell(
        shown.well,
        shown.state,
        shown.trajectory,
        known.deliveries + 1,
        shown.failure,
        shown.decided,
    )


def _size(wells: Sequence[str], title: str) -> tuple[Sequence[str], Sequence[int]]:
    """Letters of the rows and numbers of the columns of the smallest plate with these wells.

    A name such as ``"Corning 96 Well Plate"`` tells the size before the wells do.
    """
    places = [match for well in wells if (match := re.fullmatch(r"([A-Z]{1,2})(\d+)", well))]
    lowest = max((_row_number(match[1]) for match in places), default=0)
    last = max((int(match[2]) for match in places), default=0)
    named = re.search(r"\b(\d+)[ -]?well", title, re.IGNORECASE)
    least = int(named[1]) if named else 0
    fitting = [size for size in FORMATS if lowest <= size[0] and last <= size[1]]
    rows, columns = next(
        (size for size in fitting if size[0] * size[1] == least),
        fitting[0] if fitting else (lowest, last),
    )
    return [_row_letters(number) for number in range(rows)], range(1, columns + 1)


def _row_number(letters: str) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _row_letters(number: int) -> str:
    first, last = divmod(number, 26)
    return (chr(ord("A") + first - 1) if first else "") + chr(ord("A") + last)
