"""The plates of a run, well by well, with what is known of each well."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from ..vocabulary import in_few_words
from .overview import (
    ChannelEntry,
    DeliveryEntry,
    LabwareEntry,
    PlannedEntry,
    RunOverview,
    WellEntry,
    channels_of,
    well_name,
)
from .states import failure_in_words, state_of

FORMATS = ((1, 1), (2, 3), (3, 4), (4, 6), (6, 8), (8, 12), (16, 24), (32, 48))
"""Rows and columns of the plates that there are; the smallest that has all wells is drawn."""

GRAVITY = (
    *("fail", "undecided", "waiting", "running", "recovered", "abandoned"),
    *("unobserved", "pass", "calibration"),
)
"""States from the one that a person must see to the one that needs nobody."""

JUDGED = ("fail", "undecided", "recovered", "unobserved", "pass", "calibration")
"""States of a well of which no further verdict is awaited."""


@dataclass(frozen=True)
class WellView:
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
class PlateView:
    """One plate of a run.

    Attributes:
        key: Of the labware, unique within the run.
        title: What the scientist called it, and where it stood.
        rows, columns: Its size, as the robot told it, or as far as the wells tell.
        wells: Those that received something, by name.
        planned: Those that are still to receive something.
    """

    key: str
    title: str
    rows: list[str] = field(default_factory=list)
    columns: list[int] = field(default_factory=list)
    wells: dict[str, WellView] = field(default_factory=dict)
    planned: list[str] = field(default_factory=list)


def plates_of(overview: RunOverview) -> list[PlateView]:
    """The plates that liquid is delivered to, in the order in which that begins.

    Args:
        overview: Of the run; of an older guard it tells no sizes and no plan.
    """
    plates: dict[str, PlateView] = {}
    for trajectory in overview["trajectories"]:
        for place, view in wells_of(trajectory):
            plate = plates.setdefault(str(place["labware"]), _plate(place))
            plate.wells[view.well] = _graver(plate.wells.get(view.well), view)
    for delivery in still_planned(overview):
        known: LabwareEntry = {"labware": delivery["labware"], "label": "", "slot": ""}
        plate = plates.setdefault(delivery["labware"], _plate(known))
        plate.planned += [well for well in delivery["wells"] if well not in plate.planned]
    told = {plate["labware"]: plate for plate in overview.get("plates") or ()}
    for plate in plates.values():
        size = told.get(plate.key)
        if size is not None:
            plate.rows, plate.columns = _letters(size["rows"]), _numbers(size["columns"])
            if not plate.wells:
                plate.title = _plate(size).title
        else:
            plate.rows, plate.columns = _size([*plate.wells, *plate.planned], plate.title)
    return list(plates.values())


def wells_of(trajectory: DeliveryEntry) -> Iterator[tuple[WellEntry, WellView]]:
    """The wells that a delivery went into, each with its own state: where it stands, and how."""
    told = _channels(trajectory)
    for keyframe in reversed(trajectory["keyframes"]):
        if keyframe["destinations"]:
            for place in keyframe["destinations"]:
                name = str(place["name"])
                yield place, _well(name, trajectory, told.get(name))
            return


def count_wells(
    plates: Iterable[PlateView], trajectories: Sequence[DeliveryEntry]
) -> dict[str, int]:
    """How many wells stand how; a delivery of which no well is known counts as one."""
    states = Counter(well.state for plate in plates for well in plate.wells.values())
    states += Counter(state_of(one) for one in trajectories if not any(wells_of(one)))
    return dict(states) | {"wells": states.total(), "deliveries": len(trajectories)}


def still_planned(overview: RunOverview) -> Sequence[PlannedEntry]:
    """What the rehearsal delivered and the run has not begun to; nothing once it has ended."""
    if overview.get("finished"):
        return ()
    planned = (overview.get("planned") or ())[deliveries_begun(overview) :]
    return [delivery for delivery in planned if delivery["wells"]]


def short_name(trajectory: DeliveryEntry) -> str:
    """The wells that a delivery's verdict is about, in few words: ``"C2"``."""
    wells, state = [well for _, well in wells_of(trajectory)], state_of(trajectory)
    about = [well for well in wells if well.state == state != "pass"] or wells
    return in_few_words(well.well for well in about) or str(trajectory["well"])


def deliveries_begun(overview: RunOverview) -> int:
    """How many of the planned deliveries have begun: a recovery is none of them.

    Of the one under way no well is known while its liquid is only drawn: then it is still planned.
    """
    own = [
        trajectory
        for trajectory in overview["trajectories"]
        if all(keyframe.get("recovers") is None for keyframe in trajectory["keyframes"])
    ]
    draws = own and own[-1] is overview["trajectories"][-1] and is_drawing(own[-1])
    return len(own) - bool(draws)


def is_drawing(trajectory: DeliveryEntry) -> bool:
    """Whether a delivery is under way, and no frame tells yet which well it goes to."""
    return state_of(trajectory) == "running" and not any(wells_of(trajectory))


def _plate(place: LabwareEntry) -> PlateView:
    title = str(place["label"] or place["labware"])
    where = f"slot {place['slot']}" if place["slot"] else "off deck"
    return PlateView(key=str(place["labware"]), title=f"{title}, {where}")


def _channels(trajectory: DeliveryEntry) -> dict[str, ChannelEntry]:
    """What the verdict says of each channel, by well; of several over one well, the gravest."""
    told: dict[str, ChannelEntry] = {}
    for channel in channels_of(trajectory):
        name = well_name(channel) or ""
        known = told.get(name)
        if known is None or GRAVITY.index(channel["outcome"]) < GRAVITY.index(known["outcome"]):
            told[name] = channel
    return told


def _well(name: str, trajectory: DeliveryEntry, channel: ChannelEntry | None) -> WellView:
    state = state_of(trajectory)
    if channel is not None and state in JUDGED:
        own = str(channel["outcome"])
        # What is said of the row is said of the channels that made it so.
        because = {"calibration": "pass", "recovered": "fail"}.get(state)
        state = state if own == because else own
    return WellView(
        well=name,
        state=state,
        trajectory=int(trajectory["trajectory"]),
        failure=failure_in_words(trajectory, channel) if state in ("fail", "recovered") else "",
        decided=bool(trajectory["decisions"]),
    )


def _graver(known: WellView | None, new: WellView) -> WellView:
    if known is None:
        return new
    worse = GRAVITY.index(new.state) <= GRAVITY.index(known.state)
    return replace(new if worse else known, deliveries=known.deliveries + 1)


def _size(wells: Sequence[str], title: str) -> tuple[list[str], list[int]]:
    """Letters of the rows and numbers of the columns of the smallest plate with these wells.

    A name such as ``"Corning 96 Well Plate"`` tells the size before the wells do.
    """
    places = [row_and_column(well) for well in wells]
    lowest = max((row + 1 for row, _ in places), default=0)
    last = max((column + 1 for _, column in places), default=0)
    named = re.search(r"\b(\d+)[ -]?well", title, re.IGNORECASE)
    least = int(named[1]) if named else 0
    fitting = [size for size in FORMATS if lowest <= size[0] and last <= size[1]]
    rows, columns = next(
        (size for size in fitting if size[0] * size[1] == least),
        fitting[0] if fitting else (lowest, last),
    )
    return _letters(rows), _numbers(columns)


def _letters(rows: int) -> list[str]:
    return [row_letters(number) for number in range(rows)]


def _numbers(columns: int) -> list[int]:
    return list(range(1, columns + 1))


def row_and_column(well: str) -> tuple[int, int]:
    """Counted from 0; -1 for a name that tells no place."""
    match = re.fullmatch(r"([A-Z]{1,2})(\d+)", well)
    if match is None:
        return -1, -1
    row = 0
    for letter in match[1]:
        row = 26 * row + ord(letter) - ord("A") + 1
    return row - 1, int(match[2]) - 1


def row_letters(number: int) -> str:
    """Of a row counted from 0: ``"A"``, ``"AF"``."""
    first, last = divmod(number, 26)
    return (chr(ord("A") + first - 1) if first else "") + chr(ord("A") + last)
