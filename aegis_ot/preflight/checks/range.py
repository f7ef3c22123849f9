"""The check on volumes that a pipette is not made for, and on mixes with their numbers swapped."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ...adapters.opentrons.instrumentation import Operation, OperationKind
from ...vocabulary import Site, WellRef
from .check import Check, Result, Violation, microlitres
from .handling import called
from .rule_context import RuleContext, at

_TOLERATED = 0.5
"""From this share of the least volume on people use a pipette knowingly."""

_MANY = 25
"""So often one mixes with less than a pipette is made for only by mistake."""

_MORE = 40
_TIMES_THE_VOLUME = 8
"""So often, and so many times as often as there are µL, one mixes only by mistake."""


@dataclass
class _Mix:
    step: Operation
    times: int = 0


@dataclass
class _Small:
    """Volumes below what a pipette is made for, all of one pipette."""

    step: Operation
    volumes: list[float] = field(default_factory=list)
    sites: dict[Site, None] = field(default_factory=dict)

    def add(self, step: Operation, volume: float, well: WellRef) -> None:
        self.volumes.append(volume)
        self.sites[Site(step.line, well, f"{microlitres(volume)} moved")] = None


@dataclass(frozen=True)
class VolumeInRange(Check):
    """A volume that is delivered or mixed is one that the pipette is made for; a mix is repeated
    a plausible number of times.

    What goes to the waste, or back to where it came from, need not be exact.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        small: dict[str, _Small] = {}
        for mix in _mixes(case):
            step, well = mix.step, mix.step.well
            least, most = step.pipette.min_volume, step.pipette.max_volume
            low = EMPTY < step.volume < _TOLERATED * least
            swapped = mix.times >= _MORE and mix.times >= _TIMES_THE_VOLUME * step.volume
            if well is None:
                continue
            if swapped or (mix.times >= _MANY and low):
                yield _swapped(mix, well, least <= mix.times <= most)
            elif low:
                small.setdefault(step.pipette.key, _Small(step)).add(step, step.volume, well)
        for step, volume, well in _delivered(case):
            if EMPTY < volume < _TOLERATED * step.pipette.min_volume:
                small.setdefault(step.pipette.key, _Small(step)).add(step, volume, well)
        for found in small.values():
            yield _too_small(found)


EMPTY = 0.01


def _mixes(case: RuleContext) -> Iterator[_Mix]:
    """Each mix of the run, with how often it is repeated."""
    on: dict[str, _Mix] = {}
    for step in case.trace.log:
        if not isinstance(step, Operation) or not step.mixing:
            continue
        if step.kind is not OperationKind.ASPIRATE:
            continue
        mix, key = on.get(step.pipette.key), step.pipette.key
        same = mix and (mix.step.line, mix.step.wells) == (step.line, step.wells)
        if mix is None or not same or not step.in_place:
            if mix is not None:
                yield mix
            mix = on[key] = _Mix(step)
        mix.times += 1
    yield from on.values()


def _delivered(case: RuleContext) -> Iterator[tuple[Operation, float, WellRef]]:
    """Measured volumes that matter: drawn for a delivery, or delivered."""
    for load in case.loads:
        given = [
            (one, one.well)
            for one in load.given
            if one.well and one.liquid > 0 and one.step.kind is OperationKind.DISPENSE
            if one.well not in load.sources and not case.is_waste(one.well)
        ]
        if not given:
            continue
        for visit in load.drawn:
            if visit.step is not None:
                yield visit.step, visit.volume, visit.well.ref
        for one, well in given:
            if one.step.written is None:
                yield one.step, one.liquid + one.air, well.ref


def _swapped(mix: _Mix, well: WellRef, fits: bool) -> Violation:
    step, volume = mix.step, f"{mix.step.volume:.4g}"
    told = (
        f"The {called(step)} mixes {microlitres(step.volume)} {mix.times} times in {well} "
        f"{at(step.line)}"
    )
    if fits:
        told += (
            f": repetitions come first, then the volume. Write ({volume}, {mix.times}) for "
            f"{volume} times {mix.times} µL."
        )
    else:
        told += f", which is hardly meant: {volume} repetitions may be."
    site = Site(step.line, well, f"mixed {mix.times} times")
    return Violation(told, (site,), ("mix", step.line, step.pipette.key))


def _too_small(found: _Small) -> Violation:
    step, low, high = found.step, min(found.volumes), max(found.volumes)
    moved = microlitres(low) if low == high else f"{low:.4g} to {microlitres(high)}"
    lines = sorted({site.line for site in found.sites if site.line})
    where = f"at line{'s' * (len(lines) > 1)} {', '.join(map(str, lines[:5]))}"
    least, most = step.pipette.min_volume, step.pipette.max_volume
    told = (
        f"The {called(step)} moves {moved} {where}{' and others' * (len(lines) > 5)}; it is made "
        f"for {least:.4g} to {most:.4g} µL, and is inexact below: use a smaller pipette"
    )
    if step.pipette.name.startswith("p50_") and "flex" in step.pipette.name:
        told += ", or configure_for_volume() before the tip is filled"
    return Violation(f"{told}.", tuple(found.sites), ("small", step.pipette.key))
