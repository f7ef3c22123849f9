"""Checks on where tips stand: over a well, above its bottom."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...adapters.opentrons.instrumentation import LabwareInfo, Operation, OperationKind, wells_under
from ...vocabulary import Site, WellRef, counted
from ..trace import Beside
from .check import Check, Doubt, Result, Violation
from .rule_context import RuleContext, at

_TROUGH_MM = 50.0
"""A well so long stands for a whole column: definitions differ in which nozzle it is aimed at."""

_BORDER_MM = 5.0
"""So far beyond the outermost wells a labware still reaches."""

_AT_THE_BOTTOM_MM = 0.05
_PRESSED_MM = 0.5
"""A tip sent no further below the bottom is pressed on it on purpose."""

_FEWEST_ALIKE = 3
"""Where so many statements go below the bottom, the definition's depth is what is wrong."""

_LEFT_OUT = (
    "Elsewhere it goes two tips a well: if every other tip is left out of the rack, say so in the "
    "rack's label, 'half loaded'."
)

_DOES = {
    OperationKind.ASPIRATE: "draws from",
    OperationKind.DISPENSE: "gives to",
    OperationKind.BLOW_OUT: "blows out in",
    OperationKind.TOUCH_TIP: "touches the wall of",
}


def called(step: Operation) -> str:
    """A pipette in a message: "left p300_multi_gen2"."""
    return f"{step.pipette.mount} {step.pipette.name}"


@dataclass(frozen=True)
class TipsOverWells(Check):
    """Every tip that takes part in a draw or a delivery stands over a well.

    Long troughs, waste and labware of a single well are excepted. Tips that hold nothing, stand
    beyond the labware and are to give nothing later are a warning. After a pause that asks for
    tips to be taken out it is open whether these were there.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        found: dict[tuple[object, ...], list[Beside]] = {}
        for one in case.trace.beside:
            step, target = one.step, target_of(one.step)
            info = case.trace.labware.get(target.labware)
            if info is None or len(info.wells) == 1 or target in case.waste:
                continue
            if _is_trough(info, step):
                continue
            place = (step.line, step.pipette.key, step.kind, target.labware)
            found.setdefault(place, []).append(one)
        for cause, together in found.items():
            worst = sorted(together, key=lambda one: (_is_harmless(one, case), -len(one.nozzles)))
            if worst[0].perhaps_bare:
                yield Doubt(
                    f"not all tips of the {called(worst[0].step)} stand over a well "
                    f"{at(worst[0].step.line)}, and a pause asks for tips to be taken out before"
                )
                continue
            warning = ""
            if _is_harmless(worst[0], case):
                warning = "They hold nothing, and stand beyond the labware."
            elif _may_be_left_out(case, together):
                warning = _LEFT_OUT
            message = _beside(worst[0], case.trace.labware[target_of(worst[0].step).labware])
            for target in dict.fromkeys(target_of(one.step) for one in worst):
                site = Site(worst[0].step.line, target, "not all tips stand over a well")
                yield Violation(message, (site,), cause, warning=warning)


def _may_be_left_out(case: RuleContext, together: Sequence[Beside]) -> bool:
    """Whether only every other tip strays, of a pipette that goes two tips a well elsewhere."""
    rows = {_LETTERS.index(nozzle[0]) for one in together for nozzle in one.nozzles}
    step = together[0].step
    elsewhere = case.trace.in_pairs.get(step.pipette.key, set())
    return bool(elsewhere - {target_of(step).labware}) and all(row % 2 for row in rows)


def target_of(step: Operation) -> WellRef:
    """The well that the protocol names, or the first that a tip stands over."""
    target = step.wells[step.lead] or step.well
    assert target is not None
    return target


def _is_trough(info: LabwareInfo, step: Operation) -> bool:
    in_one_column = len({name.lstrip(_LETTERS) for name in step.nozzles}) == 1
    rows = {name.rstrip("0123456789") for name in info.wells}
    long = max((well.y_size or 0.0 for well in info.wells.values()), default=0.0) >= _TROUGH_MM
    return in_one_column and (info.centers_channels or (len(rows) == 1 and long))


_LETTERS = "ABCDEFGHIJKLMNOP"
_PITCH_MM = 9.0


def offsets_of(step: Operation) -> Mapping[str, tuple[float, float]]:
    """Where each nozzle is from the one that leads, mm."""
    places = {n: (_LETTERS.index(n[0]), int(n[1:])) for n in step.nozzles}
    row, column = places[step.nozzles[step.lead]]
    return {n: (_PITCH_MM * (c - column), -_PITCH_MM * (r - row)) for n, (r, c) in places.items()}


def _is_harmless(one: Beside, case: RuleContext) -> bool:
    """Whether these tips hold nothing, owe nothing and meet nothing: beyond the labware."""
    if one.holding or one.missed:
        return False
    step, offsets = one.step, offsets_of(one.step)
    known = next((n, ref) for n, ref in zip(step.nozzles, step.wells, strict=False) if ref)
    wells = case.trace.labware[known[1].labware].wells
    anchor, (away_x, away_y) = wells[known[1].name], offsets[known[0]]
    xs, ys = [well.x for well in wells.values()], [well.y for well in wells.values()]
    for nozzle in one.nozzles:
        x = anchor.x + offsets[nozzle][0] - away_x
        y = anchor.y + offsets[nozzle][1] - away_y
        reach = _BORDER_MM + max(anchor.diameter or 0.0, anchor.x_size or 0.0) / 2
        inside = min(xs) - reach <= x <= max(xs) + reach
        if inside and min(ys) - reach <= y <= max(ys) + reach:
            return False
    return True


def _beside(one: Beside, info: LabwareInfo) -> str:
    step, target = one.step, target_of(one.step)
    first, last = one.nozzles[0], one.nozzles[-1]
    channels = f"channel {first}" if first == last else f"channels {first} to {last}"
    over = f"{len(one.nozzles)} of {counted(len(step.nozzles), 'tip')}"
    verb = "stands" if len(one.nozzles) == 1 else "stand"
    place = str(target).partition(" of ")[2] or target.labware
    told = (
        f"{over} of the {called(step)} ({channels}) {verb} over no well of {place} "
        f"{at(step.line)}, where it {_DOES[step.kind]} {target.name}."
    )
    lead = step.nozzles[step.lead]
    if better := _where_all_fit(step, info, target.name):
        return f"{told} The named well is the one under nozzle {lead}: write {better} there."
    return f"{told} No well of it has room for all of them: use fewer nozzles, or a single channel."


def _where_all_fit(step: Operation, info: LabwareInfo, name: str) -> str:
    """The nearest well that has every tip over a well."""
    offsets = list(offsets_of(step).values())
    here = info.wells[name]

    def away(other: str) -> float:
        return math.hypot(info.wells[other].x - here.x, info.wells[other].y - here.y)

    others = (w for w in info.wells if w != name and None not in wells_under(info, w, offsets))
    return min(others, key=away, default="")


@dataclass(frozen=True)
class TipAboveBottom(Check):
    """No tip is sent below a well's bottom.

    Up to 0.5 mm is a warning, for a tip is pressed on the bottom on purpose; so is one depth in
    several statements, which makes up for a well that is deeper than its definition says.
    """

    def find(self, case: RuleContext) -> Iterator[Result]:
        below: dict[str, dict[int | None, Operation]] = {}
        for step in case.trace.log:
            if isinstance(step, Operation) and _is_below(step):
                kind = case.trace.labware[target_of(step).labware].load_name
                known = below.setdefault(kind, {}).setdefault(step.line, step)
                if (step.from_bottom or 0.0) < (known.from_bottom or 0.0):
                    below[kind][step.line] = step
        for kind, by_line in below.items():
            steps = sorted(by_line.values(), key=lambda step: step.from_bottom or 0.0)
            deepest, target = -(steps[0].from_bottom or 0.0), target_of(steps[0])
            depth = case.trace.labware[target.labware].wells[target.name].depth
            message = (
                f"The tip of the {called(steps[0])} is sent {deepest:.3g} mm below the bottom of "
                f"{target} {at(steps[0].line)}, which is {depth:.3g} mm deep: write a height above "
                f"it, {target.name}.bottom(1)."
            )
            warning = ""
            if deepest <= _PRESSED_MM:
                warning = "So little may be meant: the tip is pressed on the bottom."
            elif len(steps) >= _FEWEST_ALIKE:
                warning = (
                    f"{len(steps)} statements do so: if {kind} is deeper, mend its definition."
                )
            for step in steps:
                site = Site(step.line, target_of(step), "below the bottom")
                yield Violation(message, (site,), (kind,), warning=warning)


def _is_below(step: Operation) -> bool:
    return (
        step.from_bottom is not None
        and step.from_bottom < -_AT_THE_BOTTOM_MM
        and step.kind not in (OperationKind.PICK_UP_TIP, OperationKind.DROP_TIP)
        and not step.disposal
        and step.wells[step.lead] is not None
    )
