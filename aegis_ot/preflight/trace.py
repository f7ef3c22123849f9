"""The trace: a rehearsal read as tips that meet wells, and liquids that move between them.

What counts as a touch, an empty well, a carry or air is fixed in ``spec/rules.md``; this
module is where those words become values. One pass over the recorded steps, no rule in sight.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ..instrumentation import Event, EventKind, LabwareInfo, OperationKind
from ..vocabulary import WellRef
from .recorder import Record, Step
from .replacements import Replacements
from .tips import Layer, Tip, TipBox
from .wells import Well

_REPEATED = "(repeated)"

PlaceKey = tuple[str, int, str]
"""Labware key, generation of the plate, well name."""


class Visit:
    """One thing that one tip did at one well.

    Attributes:
        kind: ``aspirate``, ``dispense``, ``blow_out`` or ``touch_tip``.
        tip: The tip.
        session: Which of the tip's sessions this was.
        well: The well.
        index: Position in the run; channels that act together share it.
        line: Source line.
        volume: µL of liquid drawn or given, air left out.
        parts: What was given: liquid by the well it was drawn from.
        below: Whether liquid or tip came below the well's top.
        touch: Whether the tip touched the well (never an empty one).
        empty_before: Whether the well held nothing just before.
        mixing: Whether it is part of a mix.
        carried: How many liquids the tip had met before (a prefix of ``tip.origins``).
        met: How many wells the tip had touched before (a prefix of ``tip.touched``).
    """

    __slots__ = (
        "below",
        "carried",
        "empty_before",
        "index",
        "kind",
        "line",
        "lines",
        "met",
        "mixing",
        "parts",
        "session",
        "tip",
        "touch",
        "volume",
        "well",
    )

    def __init__(
        self,
        kind: OperationKind,
        tip: Tip,
        well: Well,
        index: int,
        line: int | None,
        lines: tuple[int, ...],
        mixing: bool,
    ) -> None:
        self.kind = kind
        self.tip = tip
        self.session = tip.session
        self.well = well
        self.index = index
        self.line = line
        self.lines = lines
        self.mixing = mixing
        self.volume = 0.0
        self.parts: Sequence[Layer] = ()
        self.below = False
        self.touch = False
        self.empty_before = False
        self.carried = 0
        self.met = 0

    def __repr__(self) -> str:
        return f"<{self.kind.value} {self.well!r} tip {self.tip.number} line {self.line}>"


@dataclass(frozen=True)
class Imbalance:
    """A well that was filled beyond its capacity, or drawn below what it held.

    Attributes:
        overfilled: Which of the two.
        volume: What it would hold, or what was drawn, µL.
        limit: Its capacity, or what it held, µL.
    """

    well: Well
    index: int
    line: int | None
    overfilled: bool
    volume: float
    limit: float


@dataclass
class Trace:
    """Everything that checks may ask about one rehearsal.

    Attributes:
        labware: Facts of each labware, by key.
        wells: Every well that was visited or filled, by place.
        tips: Every tip.
        visits: Every visit, in order.
        imbalances: Volumes that do not add up.
        shaken: Index, labware keys (``None``: any) of each time a plate was shaken.
        comments: What the run said or asked, with its line.
        steps: Number of recorded operations.
    """

    labware: Mapping[str, LabwareInfo]
    wells: dict[PlaceKey, Well] = field(default_factory=dict)
    tips: list[Tip] = field(default_factory=list)
    visits: list[Visit] = field(default_factory=list)
    imbalances: list[Imbalance] = field(default_factory=list)
    shaken: list[tuple[int, frozenset[str] | None]] = field(default_factory=list)
    comments: list[tuple[int | None, str]] = field(default_factory=list)
    groups: dict[WellRef, tuple[WellRef, ...]] = field(default_factory=dict)
    singles: set[WellRef] = field(default_factory=set)
    steps: int = 0

    def deliveries(self, well: Well) -> Iterator[Visit]:
        """Visits that brought liquid from elsewhere into ``well``."""
        for visit in well.visits:
            if visit.parts and any(part[0] is not well for part in visit.parts):
                yield visit

    def mixed_since(self, well: Well, index: int, before: float) -> bool:
        """Whether ``well`` was mixed or shaken after ``index`` and before ``before``."""
        if any(index < last and first < before for first, last, _ in well.mixes):
            return True
        return any(
            index < at < before and (keys is None or well.ref.labware in keys)
            for at, keys in self.shaken
        )


def build_trace(
    log: Iterable[Record],
    labware: Mapping[str, LabwareInfo],
    replacements: Replacements,
    prefilled: Callable[[WellRef], bool] = lambda ref: False,
) -> Trace:
    """Read a recorded run.

    Args:
        log: Steps and events, in order.
        labware: Facts of each labware, by key.
        replacements: Reads pauses: was a plate replaced, shaken, refilled?
        prefilled: Whether a well's role implies that it held liquid before the run.
    """
    return _Builder(labware, replacements, prefilled).run(log)


class _Builder:
    def __init__(
        self,
        labware: Mapping[str, LabwareInfo],
        replacements: Replacements,
        prefilled: Callable[[WellRef], bool],
    ) -> None:
        self._trace = Trace(labware)
        self._replacements = replacements
        self._prefilled = prefilled
        self._box = TipBox()
        self._generation: dict[str, int] = {}
        self._slots = {key: info.slot for key, info in labware.items()}
        self._current: dict[WellRef, Well] = {}
        self._orders: dict[str, dict[str, tuple[int, int]]] = {}
        self._index = 0
        self._last: dict[Tip, Visit] = {}
        self._cycle: dict[str, Step] = {}

    def run(self, log: Iterable[Record]) -> Trace:
        for record in log:
            self._index += 1
            if isinstance(record, Event):
                self._event(record)
            else:
                self._step(record)
                self._trace.steps += 1
        self._trace.tips = self._box.tips
        return self._trace

    # -- events

    def _event(self, event: Event) -> None:
        kind = event.kind
        if kind is EventKind.LABWARE_LOADED:
            self._slots[event.labware] = event.text
        elif kind is EventKind.LIQUID_LOADED:
            for ref in event.wells:
                well = self._well(ref)
                if event.text and event.text not in well.liquids:
                    well.liquids.append(event.text)
                well.fill_before_run(event.volume)
        elif kind is EventKind.TIPS_RESET:
            self._box.refill_rack(event.labware)
        elif kind is EventKind.LABWARE_MOVED:
            self._slots[event.labware] = event.text
            if not event.text:
                self._replace(event.labware)
        elif kind is EventKind.PAUSED:
            self._paused(event)
        elif kind is EventKind.MODULE:
            if self._replacements.shakes(event.text):
                self._trace.shaken.append((self._index, None))
        elif kind is EventKind.COMMENT:
            self._trace.comments.append((event.line, event.text))

    def _paused(self, event: Event) -> None:
        self._trace.comments.append((event.line, event.text))
        said = self._replacements.read(event.text, self._trace.labware, self._slots)
        if said.shaken:
            self._trace.shaken.append((self._index, None))
        if said.all_tips:
            self._box.replace_all_racks()
        for key in said.replaced:
            self._replace(key)
        if said.volumes_unsure:
            for well in self._current.values():
                if well.visits or well.prefilled:
                    well.forget_volume()

    def _replace(self, key: str) -> None:
        info = self._trace.labware.get(key)
        if info is not None and info.is_tip_rack:
            self._box.replace_rack(key)
            return
        self._generation[key] = self._generation.get(key, 0) + 1
        for ref in [ref for ref in self._current if ref.labware == key]:
            del self._current[ref]

    # -- steps

    def _step(self, step: Step) -> None:
        kind = step.kind
        if kind is OperationKind.PICK_UP_TIP:
            self._box.pick_up(step.pipette, step.nozzles, step.wells, step.line)
        elif kind is OperationKind.DROP_TIP:
            homes = (None,) * len(step.nozzles) if step.disposal else step.wells
            self._box.drop(step.pipette, step.nozzles, homes)
        elif not self._repeats(step):
            self._note_group(step)
            for nozzle, ref in zip(step.nozzles, step.wells, strict=False):
                tip = self._box.on(step.pipette, nozzle, step.line)
                if tip is None:
                    continue  # a multi-channel pipette that took up fewer tips
                well = None if ref is None or step.disposal else self._well(ref)
                self._act(step, kind, tip, well)

    def _repeats(self, step: Step) -> bool:
        """Whether a step only repeats a mixing cycle that is noted already.

        A further cycle of the same volume in the same wells leaves tips and wells as they are.
        """
        before = self._cycle.get(step.pipette)
        ends_a_cycle = before is not None and (
            before.kind is OperationKind.DISPENSE or before.call == _REPEATED
        )
        if (
            before is not None
            and ends_a_cycle
            and step.mixing
            and before.mixing
            and before.kind is not step.kind
            and before.wells == step.wells
            and before.volume == step.volume
            and before.line == step.line
        ):
            self._cycle[step.pipette] = step._replace(call=_REPEATED)
            return True
        self._cycle[step.pipette] = step
        return False

    def _note_group(self, step: Step) -> None:
        refs = step.wells
        if len(refs) > 1:
            first = refs[0]
            if first is not None and len(set(refs)) > 1:
                self._trace.groups.setdefault(first, tuple(ref for ref in refs if ref))
        elif refs and refs[0] is not None:
            self._trace.singles.add(refs[0])

    def _act(self, step: Step, kind: OperationKind, tip: Tip, well: Well | None) -> None:
        if kind is OperationKind.AIR_GAP or (kind is OperationKind.ASPIRATE and step.air):
            tip.push(None, step.volume, {}, step.line)
        elif kind is OperationKind.ASPIRATE:
            if well is None:
                tip.push(None, step.volume, {}, step.line)
            else:
                self._aspirate(step, tip, well)
        elif kind is OperationKind.DISPENSE or kind is OperationKind.BLOW_OUT:
            blown = kind is OperationKind.BLOW_OUT
            parts = tip.pop_all() if blown else tip.pop(step.volume)
            if well is not None:
                self._give(step, tip, well, parts)
        elif kind is OperationKind.TOUCH_TIP and well is not None and not well.empty:
            visit = self._visit(step, tip, well)
            visit.below = visit.touch = True
            tip.touch(well, step.line, self._index)

    def _visit(self, step: Step, tip: Tip, well: Well) -> Visit:
        visit = Visit(step.kind, tip, well, self._index, step.line, step.lines, step.mixing)
        visit.carried = len(tip.origins)
        visit.met = len(tip.touched)
        visit.empty_before = well.empty
        well.visits.append(visit)
        self._trace.visits.append(visit)
        return visit

    def _aspirate(self, step: Step, tip: Tip, well: Well) -> None:
        if well.empty and not well.fed and not well.prefilled:
            well.fill_before_run(None)  # first drawn from: it must have held something
        visit = self._visit(step, tip, well)
        visit.volume = step.volume
        visit.below = visit.touch = True
        tip.touch(well, step.line, self._index)
        liquid = well.liquid()
        held = well.volume
        missing = well.draw(step.volume)
        if missing > _slack(step.volume):
            self._trace.imbalances.append(
                Imbalance(well, self._index, step.line, False, step.volume, held)
            )
        tip.push(well, step.volume, liquid, step.line)
        self._last[tip] = visit

    def _give(self, step: Step, tip: Tip, well: Well, parts: list[Layer]) -> None:
        visit = self._visit(step, tip, well)
        visit.parts = parts
        for _, volume, liquid, _ in parts:
            visit.volume += volume
            well.add(volume, liquid)
        if well.volume > well.capacity + _slack(well.capacity) and visit.volume > 0:
            self._trace.imbalances.append(
                Imbalance(well, self._index, step.line, True, well.volume, well.capacity)
            )
        visit.below = step.from_top is None or step.from_top < 0
        if visit.below and not visit.empty_before and not well.clear_of_liquid(step.from_bottom):
            visit.touch = True
            tip.touch(well, step.line, self._index)
        self._note_mix(tip, visit)

    def _note_mix(self, tip: Tip, visit: Visit) -> None:
        """Liquid drawn from a well and given straight back mixes it, whoever calls it what."""
        drawn = self._last.get(tip)
        if drawn is None or drawn.well is not visit.well or visit.volume <= 0:
            return
        if any(part[0] is not visit.well for part in visit.parts):
            return
        drawn.mixing = visit.mixing = True
        mixes = visit.well.mixes
        if mixes and mixes[-1][1] >= drawn.index - 1:
            mixes[-1] = (mixes[-1][0], visit.index, mixes[-1][2])
        else:
            mixes.append((drawn.index, visit.index, drawn.line))
        del self._last[tip]

    # -- wells

    def _well(self, ref: WellRef) -> Well:
        well = self._current.get(ref)
        if well is None:
            generation = self._generation.get(ref.labware, 0)
            info = self._trace.labware.get(ref.labware)
            well = Well(
                ref, generation, info.wells.get(ref.name) if info else None, self._order(ref)
            )
            self._current[ref] = well
            self._trace.wells[(ref.labware, generation, ref.name)] = well
            if self._prefilled(ref):
                well.fill_before_run(None)
        return well

    def _order(self, ref: WellRef) -> tuple[int, int]:
        orders = self._orders.get(ref.labware)
        if orders is None:
            info = self._trace.labware.get(ref.labware)
            names = list(info.wells) if info else []
            orders = self._orders[ref.labware] = {name: row_column(name) for name in names}
        return orders.get(ref.name) or row_column(ref.name)


def row_column(name: str) -> tuple[int, int]:
    """``"B12"`` -> ``(1, 11)``; names that are not of this form count as the first well."""
    letters = name.rstrip("0123456789")
    digits = name[len(letters) :]
    row = 0
    for letter in letters.upper():
        if not "A" <= letter <= "Z":
            return (0, 0)
        row = row * 26 + ord(letter) - ord("A") + 1
    return (max(row - 1, 0), int(digits) - 1 if digits else 0)


def _slack(volume: float) -> float:
    """Rounding that volumes computed in a protocol may show, µL."""
    return max(0.01, abs(volume) * 1e-4)
