"""Reads a recorded run, step by step, as tips that meet wells and liquids that move.

What counts as a touch, an empty well, a carry or air is fixed in ``spec/rules.md``; this
module is where those words become values. One pass over the recorded steps, no rule in sight.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence

from ...adapters.opentrons.instrumentation import (
    Event,
    EventKind,
    LabwareInfo,
    Operation,
    OperationKind,
)
from ...adapters.opentrons.rehearsal import Record
from ...vocabulary import WellRef
from .geometry import CLEARANCE_MM, Contact
from .model import Above, Layer, Tip, Transfer, Visit, Well
from .pauses import Words, read_pause, topics_in
from .plates import Plates
from .tips import TipBox
from .trace import Beside, Imbalance, Trace

_MOST = 0.5
"""A mix gives back at least this share of what it drew."""

TO_EMPTY = 1.25
"""So many times what a well holds is drawn from it to leave nothing behind."""

_MOVING = (OperationKind.ASPIRATE, OperationKind.DISPENSE, OperationKind.BLOW_OUT)

FALLS_MM = 20.0
"""A drop let go higher over a well's top than this may land anywhere."""


_EMPTY = re.compile(r"empty(\W+(well|tube|vial|plate|position)s?)?", re.I)
"""Names of liquids that say there is none."""


def build_trace(
    log: Sequence[Record],
    labware: Mapping[str, LabwareInfo],
    words: Words,
    prefilled: Callable[[WellRef], bool] = lambda ref: False,
    through: Collection[str] = (),
    supposed: Collection[WellRef] = (),
) -> Trace:
    """Read a recorded run.

    Args:
        log: Operations and events, in order.
        labware: Facts of each labware, by key.
        words: Of pauses: was a plate replaced, shaken, refilled?
        prefilled: Whether a well's role implies that it held liquid before the run.
        through: Keys of filters and columns. One that the run draws from holds something.
        supposed: Wells whose role implies it, and is no more than a variable's name.
    """
    drawn = {
        ref.labware
        for step in log
        if isinstance(step, Operation) and step.kind is OperationKind.ASPIRATE
        for ref in (step.wells if through else ())
        if ref is not None
    }
    return _Builder(labware, words, prefilled, set(through) - drawn, supposed).run(log)


class _Builder:
    def __init__(
        self,
        labware: Mapping[str, LabwareInfo],
        words: Words,
        prefilled: Callable[[WellRef], bool],
        through: Collection[str],
        supposed: Collection[WellRef],
    ) -> None:
        self._box = TipBox()
        self._trace = Trace(labware, tips=self._box.tips, retakings=self._box.retakings)
        self._half_loaded = {
            key
            for key, info in labware.items()
            if info.is_tip_rack and "half" in topics_in(info.label, words)
        }
        self._words = words
        self._plates = Plates(labware, prefilled, self._trace.wells, through, supposed)
        self._slots = {key: info.slot for key, info in labware.items()}
        self._index = 0
        self._last: dict[Tip, Visit] = {}
        self._heights: dict[Tip, tuple[Well, float]] = {}
        self._cycle: dict[str, tuple[object, set[OperationKind]]] = {}
        self._strayed: dict[Tip, Beside] = {}
        self._thinned = False

    def run(self, log: Sequence[Record]) -> Trace:
        self._trace.log = log
        taken: set[WellRef | None] = {None}
        for step in log:
            if isinstance(step, Operation) and step.kind in _MOVING and _is_in_pairs(step.wells):
                labware = step.wells[0].labware if step.wells[0] else ""
                self._trace.in_pairs.setdefault(step.pipette.key, set()).add(labware)
            elif isinstance(step, Operation) and step.kind is OperationKind.PICK_UP_TIP:
                taken.update(step.wells)
            elif isinstance(step, Operation) and step.kind is OperationKind.DROP_TIP:
                # No tip can be put onto another: where none was taken, the rack was empty.
                put = () if step.disposal else step.wells
                self._box.bare.update(ref.labware for ref in put if ref and ref not in taken)
        for record in log:
            # Wherever it stands in the text, it tells what is there before the run.
            if isinstance(record, Event) and record.kind is EventKind.LIQUID_LOADED:
                self._liquid(record)
        for record in log:
            self._index += 1
            if isinstance(record, Event):
                self._event(record)
            else:
                self._step(record)
        return self._trace

    # -- events

    def _event(self, event: Event) -> None:
        kind = event.kind
        if kind is EventKind.TIPS_RESET:
            self._box.refill_rack(event.labware)
        elif kind is EventKind.LABWARE_MOVED:
            self._slots[event.labware] = event.text
            if not event.text:  # the same plate comes back, but nobody saw what was done to it
                self._plates.forget_volumes(event.labware)
                self._box.refill_rack(event.labware)
        elif kind is EventKind.PAUSED:
            self._paused(event)
        elif kind is EventKind.MODULE and "shake" in topics_in(event.text, self._words):
            plates = frozenset({event.labware}) if event.labware else None
            self._trace.shaken.append((self._index, plates))

    def _liquid(self, event: Event) -> None:
        for ref in event.wells:
            well = self._plates.well(ref)
            if _EMPTY.fullmatch(event.text.strip()):
                well.declared = 0.0  # the volume is for the app's picture of the deck
                continue
            if event.text and event.text not in well.liquids:
                well.liquids.append(event.text)
            if event.description:
                self._trace.descriptions.setdefault(event.text, event.description)
            well.fill_before_run(event.volume)
            if not event.text and event.volume == 0:
                well.declared = 0.0  # declared to be empty, which "no volume" does not say

    def _paused(self, event: Event) -> None:
        said = read_pause(event.text, self._words, self._trace.labware, self._slots)
        if said.shaken:
            self._trace.shaken.append((self._index, None))
        self._thinned = self._thinned or said.thinned
        if said.tips:
            for key in self._trace.labware:
                self._box.refill_rack(key, returned_too=True)
        for key in said.replaced:
            self._replace(key)
        if said.volumes_unsure:
            self._plates.forget_volumes()

    def _replace(self, key: str) -> None:
        """Another rack of tips, or another plate, stands there from now on."""
        self._box.refill_rack(key, returned_too=True)
        self._plates.replace(key)

    # -- steps

    def _step(self, step: Operation) -> None:
        kind = step.kind
        if kind is OperationKind.PICK_UP_TIP:
            self._box.pick_up(step, self._loaded(step))
        elif kind is OperationKind.DROP_TIP:
            homes = (None,) * len(step.nozzles) if step.disposal else step.wells
            self._box.drop(step.pipette.key, step.nozzles, homes)
        elif not self._repeats(step):
            self._note_group(step)
            if self._strayed or not all(step.wells):
                self._note_beside(step)
            for nozzle, ref in zip(step.nozzles, step.wells, strict=False):
                tip = self._box.on(step.pipette.key, nozzle)
                if tip is None:
                    continue  # a multi-channel pipette that took up fewer tips
                well = None if ref is None or step.disposal else self._plates.well(ref)
                self._act(step, tip, well)

    def _loaded(self, step: Operation) -> Sequence[WellRef | None]:
        """Where the tips stand that are picked up: of a rack that is called half loaded every other
        one, where the pipette goes two tips a well elsewhere.
        """
        if step.pipette.key not in self._trace.in_pairs:
            return step.wells
        return [
            None if number % 2 and ref is not None and ref.labware in self._half_loaded else ref
            for number, ref in enumerate(step.wells)
        ]

    def _repeats(self, step: Operation) -> bool:
        """Whether a step only repeats a mixing cycle that is noted already.

        A further cycle of the same volume in the same wells leaves tips and wells as they are.
        """
        key = (step.wells, step.volume, step.line) if step.mixing else None
        cycle, kinds = self._cycle.get(step.pipette.key, (None, set()))
        if key is None or key != cycle:
            self._cycle[step.pipette.key] = (key, {step.kind})
            return False
        if step.kind in kinds and len(kinds) > 1:
            return True
        kinds.add(step.kind)
        return False

    def _note_group(self, step: Operation) -> None:
        first = step.wells[0] if step.wells else None
        if first is None:
            return
        if len(step.wells) == 1:
            self._trace.singles.add(first)
        elif first not in self._trace.groups:
            refs = tuple(ref for ref in step.wells if ref)
            if len(set(refs)) > 1:
                self._trace.groups[first] = refs

    def _note_beside(self, step: Operation) -> None:
        """Tips that stand over no well of a labware, and wells that get air from them later."""
        if step.kind not in _MOVING or step.disposal or not any(step.wells):
            return
        tips = [self._box.on(step.pipette.key, nozzle) for nozzle in step.nozzles]
        placed = [
            (n, tip, ref) for n, tip, ref in zip(step.nozzles, tips, step.wells, strict=False)
        ]
        bare = {nozzle: tip for nozzle, tip, ref in placed if tip is not None and ref is None}
        if bare:
            holding = any(one.source is not None for tip in bare.values() for one in tip.layers)
            beside = Beside(step, tuple(bare), holding, perhaps_bare=self._thinned)
            self._trace.beside.append(beside)
            if step.kind is OperationKind.ASPIRATE:
                self._strayed.update(dict.fromkeys(bare.values(), beside))
        if step.kind is OperationKind.DISPENSE:
            for _, tip, ref in placed:
                if tip in self._strayed and ref is not None:
                    self._strayed.pop(tip).missed = True

    def _act(self, step: Operation, tip: Tip, well: Well | None) -> None:
        kind = step.kind
        draws = kind is OperationKind.ASPIRATE
        if draws and well is not None and not (step.is_air or self._draws_air(step, tip, well)):
            self._aspirate(step, tip, well)
        elif draws or kind is OperationKind.AIR_GAP:
            tip.layers.append(Layer(None, step.volume, {}, step.line))
        elif kind is OperationKind.DISPENSE or kind is OperationKind.BLOW_OUT:
            parts = tip.pop(step.volume if kind is OperationKind.DISPENSE else math.inf)
            if well is not None:
                self._give(step, tip, well, parts)
            elif tip in self._last:
                self._last[tip].air = 0.0  # air leaves first
        elif kind is OperationKind.TOUCH_TIP and well is not None and not well.empty:
            visit = self._visit(step, tip, well)
            contact = well.contact(step.from_top, step.from_bottom, step.from_liquid)
            # A touch meets the wall, at most; what tells its distance to the liquid is a probe.
            visit.contact = min(contact, Contact.NEAR) if step.from_liquid is None else contact
            self._touch(visit)

    def _visit(self, step: Operation, tip: Tip, well: Well) -> Visit:
        visit = Visit(step.kind, tip, well, self._index, step.line, step.mixing, step=step)
        if len(step.lines) > 1:
            visit.caller = step.lines[1]
            self._trace.callers.setdefault(step.lines[0], set()).add(step.lines[1])
        well.visits.append(visit)
        tip.visits.append(visit)
        self._trace.visits.append(visit)
        return visit

    def _touch(self, visit: Visit) -> None:
        if visit.touches:
            visit.tip.touch(visit, visit.contact)

    def _draws_air(self, step: Operation, tip: Tip, well: Well) -> bool:
        """Whether a tip that drew from a well draws on from above the liquid: an air gap."""
        drawn, height = self._heights.get(tip, (None, 0.0))
        return (
            drawn is well
            and bool(tip.layers)
            and step.from_bottom is not None
            and step.from_bottom >= height + CLEARANCE_MM
            and well.contact(step.from_top, step.from_bottom) is Contact.CLEAR
        ) or self._is_over(step, tip, well)

    def _is_over(self, step: Operation, tip: Tip, well: Well) -> bool:
        """Whether a tip draws from above what it has just given to a well: air, too."""
        gave = tip.visits[-1] if tip.visits else None
        return (
            gave is not None
            and gave.well is well
            and gave.kind is not OperationKind.ASPIRATE
            and not gave.mixing
            and well.known
            and not step.mixing
            and well.contact(step.from_top, step.from_bottom) is Contact.CLEAR
        )

    def _aspirate(self, step: Operation, tip: Tip, well: Well) -> None:
        if well.empty and not well.fed and not well.prefilled and well.declared is None:
            well.fill_before_run(None)  # first drawn from: it must have held something
            well.assumed = True
        visit = self._visit(step, tip, well)
        visit.volume = step.volume
        if not (well.empty or any(one.source for one in tip.layers)):
            self._note_above(visit, step)
        visit.contact = Contact.WET
        tip.touch(visit)
        if step.from_bottom is not None:
            self._heights[tip] = (well, step.from_bottom)
        liquid, held, least = well.liquid(), well.volume, well.least
        if well.full * TO_EMPTY < step.volume and not step.mixing:
            self._trace.overdrawn.setdefault(well, visit)
        missing = well.draw(step.volume)
        # Of a sample of unknown volume that the run adds to, it is not known where its end is.
        if well.known or not well.prefilled or well.fed:
            tip.unsure += max(step.volume - least, 0.0)
        visit.air = missing if well.declared is not None else 0.0
        if missing > 0 and missing > _slack(step.volume):
            self._trace.imbalances.append(Imbalance(visit, False, step.volume, held))
        tip.layers.append(Layer(well, step.volume, liquid, step.line))
        self._last[tip] = visit

    def _note_above(self, visit: Visit, step: Operation) -> None:
        well, height, inside = visit.well, step.from_bottom, visit.well.geometry
        if not well.known or height is None or inside is None or step.from_liquid is not None:
            return
        at_the_mouth = (step.from_top or 0.0) >= -CLEARANCE_MM  # where air is drawn on purpose
        if not at_the_mouth and inside.volume_below(height - CLEARANCE_MM) > well.volume:
            level = inside.level_of(well.volume)
            self._trace.above.append(Above(visit, height, level, well.volume))

    def _give(self, step: Operation, tip: Tip, well: Well, parts: list[Layer]) -> None:
        visit = self._visit(step, tip, well)
        drawn = self._last.get(tip)
        for source, volume, liquid, line in parts:
            if source is not None and source is not well:
                visit.brought.append(Transfer(source, well, visit, volume, liquid, line))
            visit.volume += volume
            unsure = min(tip.unsure, volume)
            tip.unsure -= unsure
            air = 0.0
            if drawn is not None and drawn.well is source is well:
                air = min(drawn.air, volume)  # goes back as nothing
                drawn.air -= air
            well.add(volume - air, liquid, max(unsure - air, 0.0))
        well.received += visit.brought
        self._trace.transfers += visit.brought
        if step.from_top is not None and step.from_top > FALLS_MM:
            well.fallen += visit.volume
        # What goes back into a well of unknown volume was there before.
        fills = bool(visit.brought) or (well.known and visit.volume > 0)
        least, capacity = well.least, well.capacity
        if fills and least > capacity and least > capacity + _slack(capacity):
            self._trace.imbalances.append(Imbalance(visit, True, least, capacity))
        heights = (step.from_top, step.from_bottom, step.from_liquid)
        visit.contact = well.contact(*heights, empty=visit.empty_before)
        self._touch(visit)
        self._note_mix(tip, visit)

    def _note_mix(self, tip: Tip, visit: Visit) -> None:
        """Liquid drawn from a well and given straight back mixes it, whoever calls it what.

        What is left over after most of it went elsewhere, or a little given back beforehand
        (reverse pipetting, the conditioning of a liquid class), is returned, but mixes nothing.
        """
        drawn = self._last.get(tip)
        if drawn is None or visit.volume <= 0:
            return
        gives_back = drawn.well is visit.well and visit.volume >= drawn.volume * _MOST
        if visit.brought or gives_back:
            del self._last[tip]
        if visit.brought or not gives_back:
            return
        drawn.mixing = visit.mixing = True
        mixes = visit.well.mixes
        if mixes and mixes[-1][1] >= drawn.index - 1:
            mixes[-1] = (mixes[-1][0], visit.index)
        else:
            mixes.append((drawn.index, visit.index))


def _is_in_pairs(wells: Sequence[WellRef | None]) -> bool:
    """Whether of eight tips only every other one has a well of its own: labware of four rows."""
    if len(wells) != 8:
        return False
    own = set(wells[::2])
    return len(own) == 4 and None not in own and own >= {*wells} - {None}


def _slack(volume: float) -> float:
    """Rounding that volumes computed in a protocol may show, µL."""
    return max(0.1, abs(volume) * 2e-3)
