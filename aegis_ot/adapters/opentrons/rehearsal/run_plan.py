"""What a rehearsal moved, step by step, and whether the run that follows it does the same.

Compared are the moves of liquid and tips: in which order, which wells, how much, whether a tip
is one that was on before, and whether what is given falls from above or low down in its well, where
the tip may touch what stands there. A run may differ from its rehearsal in everything else: which
fresh tip is the next, how high the liquid stands, how long something takes, how often it is mixed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ....vocabulary import WellRef
from ..instrumentation import Event, EventKind, Operation, OperationKind

_COMPARED = {
    OperationKind.PICK_UP_TIP: "picks up a tip",
    OperationKind.DROP_TIP: "drops its tip",
    OperationKind.ASPIRATE: "aspirates",
    OperationKind.DISPENSE: "dispenses",
    OperationKind.BLOW_OUT: "blows out",
}
_MIX = "mixes"
_SAME_UL = 0.01
_SAME_SHARE = 0.01
_SAME_MM = 2.0
_UPPER_PART = 2 / 3
"""Of a well's depth: above it no liquid is expected."""


class Height(NamedTuple):
    """Where the end of a tip is that gives: over its well's top, and over its bottom, mm."""

    from_top: float
    from_bottom: float

    @property
    def _part(self) -> str:
        if self.from_top >= 0:
            return "over the well"
        is_high = self.from_bottom >= _UPPER_PART * (self.from_bottom - self.from_top)
        return "high" if is_high else "low"

    def equals(self, other: Height) -> bool:
        """Whether it meets the same, as far as heights alone tell."""
        near = abs(self.from_top - other.from_top) < _SAME_MM
        return self._part == other._part or (near and max(self.from_top, other.from_top) < 0)

    def __str__(self) -> str:
        if self.from_top >= 0:
            return f"{self.from_top:.3g} mm above its top"
        return f"{self.from_bottom:.3g} mm above its bottom"


class PlannedMove(NamedTuple):
    """One move: by which pipette, what, in which wells (of as many tips), how much, µL, and how
    high, if it gives."""

    mount: str
    action: str
    wells: tuple[tuple[str, str, str] | None, ...]
    volume: float = 0.0
    line: int | None = None
    height: Height | None = None

    def equals(self, other: PlannedMove) -> bool:
        """Whether it is the same move, as far as numbers go."""
        if self[:3] != other[:3]:
            return False
        most = max(self.volume, other.volume)
        if abs(self.volume - other.volume) > _SAME_UL + _SAME_SHARE * most:
            return False
        return not (self.height and other.height) or self.height.equals(other.height)

    def __str__(self) -> str:
        first = next((well for well in self.wells if well is not None), None)
        into = {"aspirates": "from", "dispenses": "into"}.get(self.action, "in")
        much = f" {self.volume:.4g} µL" if self.volume else ""
        where = f" {into} {WellRef('', first[2], first[1], first[0])}" if first else ""
        high = f", {self.height}," if self.height else ""
        return f"the {self.mount} pipette {self.action}{much}{where}{high}"


class Steps:
    """Tells operations as steps; knows which tips were on before, until their rack is filled."""

    def __init__(self) -> None:
        self._used: dict[WellRef, int] = {}
        self._pick_ups = 0

    def of(self, operation: Operation) -> PlannedMove | None:
        """The step that an operation is; ``None`` for one that moves neither liquid nor a tip."""
        kind, mount = operation.kind, operation.pipette.mount
        action = _COMPARED.get(kind)
        if action is None or operation.is_air:
            return None
        if kind in (OperationKind.PICK_UP_TIP, OperationKind.DROP_TIP):
            if kind is OperationKind.PICK_UP_TIP:
                # By when it was on, not by its place: the first tip may be another one.
                used = [self._used[well] for well in operation.wells if well in self._used]
                action = f"picks up again the tip of its pick-up {min(used)}" if used else action
            elif not operation.disposal:
                action = "puts its tip back"
            return PlannedMove(mount, action, (None,) * len(operation.nozzles), line=operation.line)
        if operation.mixing:
            action = _MIX
        wells = tuple(
            None if well is None else (well.slot, well.label, well.name) for well in operation.wells
        )
        # What was asked for: a simulator that counts below zero cuts a dispense, and no robot.
        asked = operation.arguments.get("volume") or operation.volume
        volume = 0.0 if kind is OperationKind.BLOW_OUT else float(asked)
        return PlannedMove(mount, action, wells, volume, operation.line, _height(operation))

    def done(self, operation: Operation) -> None:
        """It was done."""
        if operation.kind is OperationKind.PICK_UP_TIP:
            self._pick_ups += 1
            for well in operation.wells:
                if well is not None:
                    self._used.setdefault(well, self._pick_ups)

    def event(self, event: Event) -> None:
        """A rack may have been filled, or taken away to be."""
        refilled = event.kind is EventKind.LABWARE_MOVED and not event.text
        if refilled or event.kind is EventKind.TIPS_RESET:
            self._used = {
                well: number for well, number in self._used.items() if well.labware != event.labware
            }


def _height(operation: Operation) -> Height | None:
    """Of a tip that gives, where it does not follow the liquid."""
    gives = operation.kind in (OperationKind.DISPENSE, OperationKind.BLOW_OUT)
    top, bottom = operation.from_top, operation.from_bottom
    if not gives or operation.mixing or operation.from_liquid is not None:
        return None
    return None if top is None or bottom is None else Height(top, bottom)


def _goes_on(last: PlannedMove | None, step: PlannedMove) -> bool:
    """Whether a step only goes on with the mixing that came before it."""
    return step.action == _MIX and last is not None and last[:3] == step[:3]


class RunPlan:
    """A listener of the rehearsal: what the run will do under its guard.

    Attributes:
        steps: In order.
        head: Records of the rehearsal from before the guard began.

    Args:
        earlier: How many guards of the same run are over: it may have several, one after another.
    """

    def __init__(self, earlier: int = 0) -> None:
        self.steps: list[PlannedMove] = []
        self.head = 0
        self._earlier = earlier
        self._listens, self._begun = not earlier, False
        self._steps = Steps()

    @property
    def under(self) -> int | None:
        """Under which guard the rehearsal stands now; ``None`` under none of this plan's."""
        return self.head if self._listens else None

    def guard_began(self, records: int) -> None:
        """A guard of the protocol begins, after so many records of the rehearsal."""
        if self._earlier or self._begun:
            self._earlier = max(0, self._earlier - 1)
            return
        self._listens = self._begun = True
        self.head, self._steps = records, Steps()
        self.steps.clear()

    def guard_ended(self) -> None:
        """And ends; what comes then this one will not hear."""
        if self._begun:
            self._listens = False

    def before(self, operation: Operation) -> None:
        """Only what was done counts."""

    def after(self, operation: Operation) -> None:
        """Of :class:`.Listener`."""
        step = self._steps.of(operation) if self._listens else None
        self._steps.done(operation)
        if step is not None and not _goes_on(self.steps[-1] if self.steps else None, step):
            self.steps.append(step)

    def event(self, event: Event) -> None:
        """Likewise."""
        self._steps.event(event)


class Comparison:
    """Follows a run along its plan.

    Attributes:
        difference: Where the run first did otherwise, in a sentence without its end; ``""`` as
            long as it did not.
    """

    def __init__(self, steps: Sequence[PlannedMove]) -> None:
        self._plan = steps
        self._steps = Steps()
        self._done = 0
        self._last: PlannedMove | None = None
        self.difference = ""

    def fits(self, operation: Operation) -> bool:
        """Whether the run does as planned if it does this next."""
        step = self._steps.of(operation)
        if self.difference:
            return False
        if step is None or _goes_on(self._last, step):
            return True
        return self._done < len(self._plan) and self._plan[self._done].equals(step)

    def done(self, operation: Operation) -> bool:
        """Take in what was done; whether it is the first that differs."""
        step, fits = self._steps.of(operation), self.fits(operation)
        self._steps.done(operation)
        if self.difference or step is None or _goes_on(self._last, step):
            return False
        if not fits:
            line = f" at line {step.line}" if step.line else ""
            planned = self._plan[self._done] if self._done < len(self._plan) else None
            if planned is None or not planned._replace(height=None).equals(step):
                step = step._replace(height=None)
            self.difference = f"{step}{line}, where {self._planned(bool(step.height))}"
            return True
        self._last = step
        self._done += 1
        return False

    def event(self, event: Event) -> None:
        """Something happened that is no operation."""
        self._steps.event(event)

    def ended(self) -> None:
        """The run has ended by itself."""
        if not self.difference and self._done < len(self._plan):
            self.difference = f"it ended where {self._planned()}"

    def _planned(self, told_height: bool = False) -> str:
        if self._done >= len(self._plan):
            return "the rehearsal had ended" if self._plan else "the rehearsal moved nothing"
        planned = self._plan[self._done]
        if not told_height:
            planned = planned._replace(height=None)
        return f"in the rehearsal {planned}" + (f" at line {planned.line}" if planned.line else "")
