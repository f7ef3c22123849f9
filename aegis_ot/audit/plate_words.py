"""What two pictures of a plate say of its wells, in words and units."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..vocabulary import counted
from .plate_fit import CONTRADICTS, UNJUDGED, PlateReading, WellReading
from .plate_record import RecordedPlate

_NAMED = 24
"""Wells that a sentence names at most."""

_NOTHING, _LESS, _MORE = 0.2, 0.8, 1.2
"""Shares of the expected change: up to none is seen, up to less, from which on more."""

_UNJUDGED: Mapping[str, str] = {
    "hidden": "glare, darkness, the picture's edge or something that lies over the plate hides "
    "{them} in one of the pictures.",
    "unknown": "the record does not tell what {they} held: liquid that was there before the run "
    "was drawn, or a delivery was given up.",
    "weak": "a change shows, but half of the volume could look alike in these pictures.",
    "lighter": "{they} became lighter, as by a reflection. Look at {them}.",
    "uneven": "part of {them} contradicts the record and part agrees, as where a wall or a shadow "
    "is seen. Look at {them}.",
    "alone": "too few other wells got the same liquids to compare the colour with.",
}


def contradiction_words(reading: PlateReading, recorded: RecordedPlate) -> list[str]:
    """``"B3 shows no change although 50 µL of dye were dispensed into it."``, the farthest off
    first; wells of which the same is said stand together."""
    told: dict[tuple[str, str, str], list[str]] = {}
    for one in reading.of(CONTRADICTS):
        well = recorded.wells.get(one.well)
        held = _held(well.gained) if well is not None else ""
        told.setdefault((*_contradiction(one, held), one.why), []).append(one.well)
    said = []
    for (single, many, why), wells in told.items():
        order = sorted(wells, key=recorded.plate.names.index)
        known = " The run had failed it, too." if len(wells) == 1 else " The run had failed them."
        words = single if len(wells) == 1 else many
        said.append(f"{listed(order)} {words}{known if why else ''}")
    return said


def _contradiction(one: WellReading, held: str) -> tuple[str, str]:
    """What is said of a well, and of several."""
    share = one.share
    if not held:
        said = "changed although the record tells of no delivery into"
        return f"{said} it.", f"{said} them."
    if share is None:
        said = f"changed although {held} are too clear in other wells to be seen."
        return said, said
    if share <= _NOTHING:
        said = f"no change although {held} were dispensed into"
        return f"shows {said} it.", f"show {said} each of them."
    if one.other:
        said = f"changed, but to another colour than {held} give other wells."
        return said, said
    amount = f"{share * 100:.0f} % of" if not _LESS < share < _MORE else "not quite"
    said = f"{amount} the change that {held} make in other wells"
    if amount.endswith("of"):
        said += f": too {'little' if share < 1 else 'much'} may be in"
        return f"shows {said} it.", f"show {said} them."
    return f"shows {said}.", f"show {said}."


def arrived_words(wells: Sequence[str]) -> str:
    """Of wells that the run failed and that look as if nothing had."""
    return f"{listed(wells)}: failed by the run, but of the colour that the record lets expect."


def unjudged_words(reading: PlateReading, recorded: RecordedPlate) -> list[str]:
    """Wells about which the pictures say nothing, by reason; each liquid that shows nothing by
    itself."""
    told: dict[tuple[str, str], list[str]] = {}
    for one in reading.of(UNJUDGED):
        liquids = ""
        if one.why == "faint":
            liquids = ", ".join(sorted(recorded.wells[one.well].gained))
        told.setdefault((one.why, liquids), []).append(one.well)
    said = []
    for (why, liquids), wells in told.items():
        order = sorted(wells, key=recorded.plate.names.index)
        named = f"Not judged: {listed(order)}: "
        if why == "faint":
            single = len(wells) == 1
            said.append(
                f"{named}{'it shows' if single else f'none of these {len(wells)} wells shows'} a "
                f"change that could be told from none. {liquids[:1].upper()}{liquids[1:]}: too "
                f"clear or too little for these pictures, or nothing arrived in "
                f"{'it' if single else 'any of them'}."
            )
        else:
            many = len(wells) > 1
            words = {"them": "them" if many else "it", "they": "they" if many else "it"}
            said.append(named + _UNJUDGED[why].format_map(words))
    return said


def doubt_words(reading: PlateReading, recorded: RecordedPlate, before: str, after: str) -> str:
    """Why the pictures are to be doubted as a whole; empty if nothing speaks against them."""
    judged = len(reading.wells) - len(reading.of(UNJUDGED))
    off = [one.well for one in reading.of(CONTRADICTS) if not one.why]
    check = (
        f"Check that both pictures show {recorded.title}, that {before} was taken before the run "
        f"and {after} after it, and where A1 is (--a1)."
    )
    if reading.lighter:
        return (
            "The wells that received liquid are lighter in the second picture than in the first: "
            f"are they in the wrong order? {check}"
        )
    order = listed(sorted(off, key=recorded.plate.names.index))
    if not reading.shows and recorded.wells:
        others = f", but other wells do: {order}" if len(off) > 1 else ""
        return (
            f"None of the wells that received liquid shows a change{others}. {check} If all that "
            "is right, their liquids are too clear for these pictures, or nothing arrived."
        )
    if len(off) > 1 and 3 * len(off) > judged:
        return (
            f"{len(off)} of {counted(judged, 'judged well')} contradict the record: rather the "
            f"pictures are wrong than so many wells. {check} If all that is right, look at {order}."
        )
    return ""


def listed(wells: Iterable[str]) -> str:
    """``"A1, A2, A3 and 9 more"``."""
    named = list(wells)
    more = f" and {len(named) - _NAMED} more" if len(named) > _NAMED else ""
    return ", ".join(named[:_NAMED]) + more


def _held(gained: Mapping[str, float]) -> str:
    parts = [f"{ul:.3g} µL of {liquid}" for liquid, ul in sorted(gained.items()) if ul > 0]
    return " and ".join(parts)
