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
    "alone": "too few other wells got the same liquids to compare the colour with.",
    "doubt": "the pictures as a whole do not fit the record (see above).",
}


def contradiction_words(one: WellReading, recorded: RecordedPlate) -> str:
    """``"B3 shows no change although 50 µL of dye were dispensed into it."``."""
    told = recorded.wells.get(one.well)
    if told is None or not told.gained:
        return f"{one.well} changed although the record tells of no delivery into it."
    held, share = _held(told.gained), one.share
    if share is None:
        said = f"{one.well} changed although {held} show too little in other wells to be seen."
    elif share <= _NOTHING:
        change = "shows no change" if share > -_NOTHING else "became lighter"
        said = f"{one.well} {change} although {held} were dispensed into it."
    elif one.other:
        said = (
            f"{one.well} changed, but not to the colour of the other wells with these liquids: "
            f"{held} were dispensed into it."
        )
    elif _LESS < share < _MORE:
        said = f"{one.well} does not show the change that {held} make in other wells."
    else:
        said = (
            f"{one.well} shows {share * 100:.0f} % of the change that {held} make in other wells: "
            f"too {'little' if share < 1 else 'much'} may be in it."
        )
    return said + (" The run had failed it, too." if one.why == "known" else "")


def arrived_words(wells: Sequence[str]) -> str:
    """Of wells that the run failed and that look as if nothing had."""
    return (
        f"{listed(wells)}: failed by the run, but of the colour that the record lets expect."
    )


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
            one = len(wells) == 1
            said.append(
                f"{named}{'it shows' if one else f'none of these {len(wells)} wells shows'} a "
                f"change that could be told from none. {liquids[:1].upper()}{liquids[1:]}: too "
                f"clear or too little for these pictures, or nothing arrived in "
                f"{'it' if one else 'any of them'}."
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
    check = f"that both show {recorded.title}, that {before} was taken before the run and {after} after it"
    if reading.lighter:
        return (
            "The wells that received liquid are lighter in the second picture than in the first: "
            f"are they in the wrong order? Check {check}."
        )
    if len(off) > 1 and 3 * len(off) > judged:
        order = sorted(off, key=recorded.plate.names.index)
        return (
            f"{len(off)} of {counted(judged, 'judged well')} contradict the record: rather the "
            f"pictures are wrong than so many wells. Check {check}, and where A1 is "
            f"(--a1). If all that is right, look at {listed(order)}."
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
