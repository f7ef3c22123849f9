"""The tips of a multi-channel pipette: which stand in one row, and how their wells are named."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from .trajectories import ChannelOutcome, ChannelVerdict, Verdict
from .wells import WellRef


def is_row(nozzles: Sequence[str]) -> bool:
    """Whether these nozzles stand in one line: a column of the head (``A1`` to ``H1``), or a row.

    They do where they share their column's number or their row's letter; in Opentrons' layouts no
    active nozzle lies between two others without being one of them.
    """
    places = [re.fullmatch(r"([A-Z]+)(\d+)", nozzle) for nozzle in nozzles]
    found = [(place[1], place[2]) for place in places if place is not None]
    if len(found) < len(nozzles) or len(found) < 2:
        return False
    letters, numbers = {place[0] for place in found}, {place[1] for place in found}
    return len(letters) == 1 or len(numbers) == 1


def named_wells(channels: Iterable[ChannelVerdict]) -> str:
    """Their wells in few words: ``"A3 to E3, G3"``."""
    return in_few_words(channel.name for channel in channels)


def with_places(channels: Sequence[ChannelVerdict]) -> str:
    """The same with where the first of them is: ``"A3 to E3 of plate (slot 2)"``."""
    return named_wells(channels) + _place(next((c.well for c in channels if c.well), None))


def wells_with_places(wells: Sequence[WellRef]) -> str:
    """``"A2 to H2 of plate (slot 4)"``; ``"4:A2 to H2"`` of labware without a name."""
    first = next(iter(wells), None)
    if first is None:
        return ""
    words = in_few_words(well.name for well in wells)
    return words + _place(first) if first.label else words.replace(first.name, first.address, 1)


def in_few_words(names: Iterable[str]) -> str:
    """Names of wells, those that stand one below the other as a range: ``"A3 to E3, G3"``."""
    runs: list[list[str]] = []
    for name in dict.fromkeys(names):
        if runs and _follows(runs[-1][-1], name):
            runs[-1].append(name)
        else:
            runs.append([name])
    return ", ".join(f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(run) for run in runs)


def _place(first: WellRef | None) -> str:
    if first is None:
        return ""
    return str(first).removeprefix(first.name) if first.label else ""


def unobserved(verdicts: Iterable[Verdict]) -> tuple[ChannelVerdict, ...]:
    """The channels that the camera could not see."""
    return tuple(
        channel
        for verdict in verdicts
        for channel in verdict.channels
        if channel.outcome is ChannelOutcome.UNOBSERVED
    )


def _follows(before: str, after: str) -> bool:
    """Whether two wells stand one below the other: the next letter, the same number."""
    a, b = (re.fullmatch(r"([A-Z])(\d+)", name) for name in (before, after))
    return a is not None and b is not None and a[2] == b[2] and ord(b[1]) - ord(a[1]) == 1
