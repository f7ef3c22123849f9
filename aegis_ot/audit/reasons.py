"""What the audit says of a well, in words and units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..vision.tips import tip_for
from ..vocabulary import KeyframeKind, counted
from .measures import Measures
from .patterns import Drift
from .surprise import WellStanding
from .wells import RunWell

SPEAKS = 2.0
"""Surprise of a sign, nats, from which it is told."""


def reasons(well: RunWell, measured: Measures, standing: WellStanding, others: int) -> list[str]:
    """What speaks against a well, the strongest first.

    Args:
        well: The well.
        measured: Its signs.
        standing: How far they stand from the others'.
        others: How many it was read beside.
    """
    told = sorted(standing.strongest().values(), key=lambda one: -one[1])
    said = [measured.contradiction] if measured.contradiction else []
    beside = f"the {counted(others, 'other well')}"
    for sign, surprise in told:
        if surprise >= SPEAKS:
            said.append(_sentence(sign, well, measured, standing.usual[sign], beside))
    return said


def liquid_words(well: RunWell) -> str:
    """``"water with the left p300_single_gen2"``."""
    keyframe = well.keyframe
    liquid = keyframe.reagent or "the same liquid"
    return f"{liquid} with the {keyframe.mount} {keyframe.pipette}"


def drift_words(drift: Drift, wells: Sequence[RunWell]) -> list[str]:
    """What a trend along the run says."""
    first, last = wells[drift.places[0]], wells[drift.places[-1]]
    where = f"from {first.sample.well} to {last.sample.well}"
    of = liquid_words(first)
    if drift.family == "after":
        said = [f"Along the wells of {of} more and more stays in the tip, {where}."]
        told = {"left_40": "lowest 40 %", "left_75": "lowest 75 %"}
        for sign, part in told.items():
            if sign in drift.changes:
                said.append(
                    f"From the first third of the wells to the last, the {part} of the column's "
                    f"height look {_points(drift.changes[sign])} after the dispense."
                )
        return said
    said = [f"Along the wells of {of} less and less is in the tip in transit, {where}."]
    if "short" in drift.changes:
        change = _points(drift.changes["short"], "emptier")
        said.append(f"From the first third of the wells to the last, the column looks {change}.")
    return said


def no_liquid_words(wells: Sequence[RunWell], found_right: RunWell | None) -> list[str]:
    """What it says that no liquid is seen in any well, though a person may have found one right."""
    volumes = sorted({well.sample.volume_ul for well in wells})
    drawn = f"{volumes[0]:g} µL"
    if len(volumes) > 1:
        drawn = f"{volumes[0]:g} to {volumes[-1]:g} µL"
    return [
        f"In none of the {counted(len(wells), 'well')} of {liquid_words(wells[0])} is any liquid "
        f"seen: {drawn} should stand in the tip, but its filled and its emptied frames look alike, "
        "and no surface is seen where the column should end. All wells agree with each other, so "
        "none stood out during the run.",
        "The source may have been empty from the first well on."
        if found_right is None
        else f"A person was asked about {found_right.sample.well} and went on: the liquid may only "
        "be too clear for this view.",
    ]


def neighbour_words(well: RunWell, wells: Sequence[RunWell]) -> Iterator[tuple[str, float]]:
    """What failures near by say, and how much that counts, nats."""
    failed = [other for other in wells if other is not well and other.outcome == "fail"]
    tip, sources = well.keyframe.tip, well.keyframe.sources
    same_tip = [other for other in failed if other.keyframe.tip == tip != ""]
    if same_tip:
        more = f" and {len(same_tip) - 1} more" if len(same_tip) > 1 else ""
        yield f"The same tip failed at {same_tip[0].sample.well}{more}.", 1.0
    for other in failed:
        after = other.trajectory - well.trajectory
        if abs(after) == 1 and other not in same_tip and other.keyframe.sources == sources != ():
            when = "just before" if after < 0 else "right after"
            yield f"{other.sample.well}, served {when} it from the same source, failed.", 0.5


def _points(share: float, word: str = "fuller") -> str:
    if share < 0:
        word = {"fuller": "emptier", "emptier": "fuller"}[word]
    return f"{abs(share) * 100:.0f} percentage points {word}"


def _sentence(sign: str, well: RunWell, measured: Measures, usual: float, beside: str) -> str:
    value = measured.signs[sign]
    if sign.startswith("left_"):
        part = measured.left_ul[sign]
        stayed = part * max(min(value, 1.0) - max(usual, 0.0), 0.0)
        return (
            f"After the dispense the tip's lowest {_ul(part)} look {_share(value)} filled, in "
            f"{beside} {_share(usual)}: about {_ul(stayed)} may have stayed."
        )
    tip = tip_for(well.keyframe.pipette, well.keyframe.capacity_ul)
    mm = abs(value - usual) * tip.length_mm
    drawn = well.sample.expected_ul[KeyframeKind.TRANSIT]
    lacking = drawn * max(min(value, 1.0) - max(usual, 0.0), 0.0)
    said: Mapping[str, str] = {
        "retained": "The frames speak more for a column that stayed after the dispense "
        f"(score {value**2:.0f}) than those of {beside} ({usual**2:.0f}).",
        "short": f"In transit the column looks {_share(1 - value)} filled, in {beside} "
        f"{_share(1 - usual)}: about {_ul(lacking)} may be missing.",
        "gap": f"The column in transit has a stronger break than in {beside}: air may have been "
        "drawn.",
        "low": f"In transit the column ends {mm:.1f} mm lower than in {beside}: too little may "
        "have been drawn.",
        "high": f"In transit the column ends {mm:.1f} mm higher than in {beside}: too much may "
        "have been drawn.",
        "absent": f"In transit no column of the colour that {beside} show ends near its place.",
        "faint": "From transit to after the dispense the tip changes only "
        f"{_share((1 - value) / max(1 - usual, 1e-6))} as much as in {beside}.",
        "score": f"The tip looks unlike those of {beside}: image score {value:.1f}, usually "
        f"{usual:.1f}.",
    }
    return said[sign]


def _share(value: float) -> str:
    return f"{min(max(value, 0.0), 1.0) * 100:.0f} %"


def _ul(volume: float) -> str:
    return f"{volume:.1f} µL" if volume < 30 else f"{volume:.0f} µL"
