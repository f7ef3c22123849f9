"""Which keyframes, boundaries and inserted moves a sequence of operations yields.

A pure state machine: no I/O, no clock, no robot. Fed with every operation of a run, it says
before each one what has to be done first. What it says depends on the operations and on its
two settings only, so that analysis and live run insert the same moves.

The table of what each kind of call yields is ``docs/reference/keyframes.md``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..adapters.opentrons.instrumentation import Event, EventKind, Operation, OperationKind
from .ledger import Ledger
from .pipette_state import PipetteState, Place, in_place, unique, wells_of
from .probes import Probe, Probes, never_asked
from .steps import Abandon, Capture, Hold, Lift, Step, Trajectory
from .tip_contents import DrawnLayer, liquid_of
from .unjudged import EXPELLING, Awaiting, describe, is_on

Capacity = Callable[[Operation], "float | None"]


def _no_capacity(_operation: Operation) -> float | None:
    return None


class Tracker:
    """Follows every pipette of one run.

    Args:
        run: Identifier of the run, written into each keyframe.
        hold: ``"boundary"``, ``"well"`` (also right after each POST_DISPENSE) or ``"off"``.
        lift: Whether moves to the top of a well are inserted for TRANSIT and POST_DISPENSE.
        capacity: Working volume of the tip at an operation whose core may be asked, µL.
        probe: What a liquid probe that is over said.
    """

    def __init__(
        self,
        run: str,
        hold: str = "boundary",
        lift: bool = True,
        capacity: Capacity = _no_capacity,
        probe: Probe = never_asked,
    ) -> None:
        self._ledger = Ledger(run)
        self._hold = hold
        self._lift = lift
        self._capacity = capacity
        self._hands: dict[str, PipetteState] = {}
        self._awaiting = Awaiting()
        self._probes = Probes(probe)

    @property
    def trajectories(self) -> int:
        """How many trajectories have begun."""
        return self._ledger.trajectories

    def mark_recoveries(self, of_mount: Mapping[str, int]) -> None:
        """Trajectories that begin while their mount stands in ``of_mount`` recover that one."""
        self._ledger.recovering = of_mount

    def before(self, operation: Operation) -> list[Step]:
        """What has to be done before ``operation``, in order."""
        steps: list[Step] = []
        self._probes.before(operation)
        self._replaced(operation, steps)
        hand = self._hand(operation)
        if not in_place(operation):
            for other in self._hands.values():
                if other is not hand:
                    self._settle(other, steps)
                    other.displaced()
        if operation.kind is OperationKind.ASPIRATE and hand.capacity is None:
            hand.capacity = self._capacity(operation)
        self._owed_to_destination(hand, operation, steps)
        self._owed_to_source(hand, operation, steps)
        self._ask(self._awaiting.due_at(hand, operation), describe(operation), steps)
        self._arrival(hand, operation, steps)
        return steps

    def after(self, operation: Operation) -> list[Step]:
        """Take in what ``operation`` did; trajectories that it ended undelivered."""
        steps: list[Step] = []
        hand = self._hand(operation)
        target = hand.target(operation)
        found = self._probes.after(operation, target)
        kind = operation.kind
        if kind is OperationKind.PICK_UP_TIP:
            well = operation.well
            hand.tip = well.address if well is not None else ""
        if kind in (OperationKind.PICK_UP_TIP, OperationKind.DROP_TIP):
            self._give_up(hand, "the tip was dropped before it was delivered", steps)
            hand.contents.clear()
            hand.draw = hand.capacity = None
            if kind is OperationKind.DROP_TIP:
                hand.tip = ""
        elif operation.is_air:
            hand.contents.draw(DrawnLayer(operation.volume, liquid=False))
        elif kind is OperationKind.ASPIRATE:
            sources = unique(operation.wells)
            hand.contents.draw(DrawnLayer(operation.volume, sources, found=found))
            if not operation.mixing:
                hand.draw = operation
        elif kind in EXPELLING:
            self._expelled(hand, operation, steps)
        self._stand(hand, operation, target)
        return steps

    def event(self, event: Event) -> list[Step]:
        """A pause for the operator, or a labware that is taken away, is a boundary."""
        steps: list[Step] = []
        self._probes.event(event)
        if event.kind is EventKind.LIQUID_LOADED:
            for well in event.wells:
                self._ledger.reagents[well] = event.text
        elif event.kind is EventKind.PAUSED:
            for hand in self._hands.values():
                # No lift: what the protocol does next in place must happen in that place.
                self._settle(hand, steps, lift=False)
            self._ask(self._awaiting.all(), "a pause", steps)
        elif event.kind is EventKind.LABWARE_MOVING:
            for hand in self._hands.values():
                if hand.current and hand.current.delivered and is_on(hand.current, event.labware):
                    self._settle(hand, steps, lift=False)  # its wells are about to leave
            self._ask(self._awaiting.on(event.labware), "the labware is moved", steps)
        return steps

    def deck_touched(self) -> None:
        """The robot waits for a person, who may fill wells or put in others."""
        self._probes.forget()

    def finish(self) -> list[Step]:
        """The run has ended by itself: what is still owed, and the last boundary."""
        steps: list[Step] = []
        for hand in self._hands.values():
            hand.draw = None
            self._settle(hand, steps)
            self._give_up(hand, "the run ended before it was delivered", steps)
        waiting = self._awaiting.take(self._awaiting.all())
        if waiting:
            steps.append(Hold(waiting, "the end of the run", final=True))
        return steps

    def break_off(self, reason: str) -> list[Step]:
        """The run failed or was stopped: nothing moves any more, nothing is waited for."""
        steps: list[Step] = []
        for hand in self._hands.values():
            if hand.current is not None:
                steps.append(Abandon(hand.current.number, reason))
                hand.current = None
        self._awaiting.take(self._awaiting.all())
        return steps

    # What is owed before the tip goes on

    def _owed_to_destination(
        self, hand: PipetteState, operation: Operation, steps: list[Step]
    ) -> None:
        current = hand.current
        if current is None or not current.delivered:
            return
        stays = hand.stays(operation)
        is_more = operation.kind is OperationKind.DISPENSE and stays and not operation.mixing
        if current.frames < 3 and not is_more:
            self._capture(hand, current, steps)
        if not stays or _draws(operation):
            self._complete(hand, steps, lift=not in_place(operation))

    def _owed_to_source(self, hand: PipetteState, operation: Operation, steps: list[Step]) -> None:
        if _draws(operation):
            self._give_up(hand, "more was drawn before it was delivered", steps)
            return
        if hand.draw is None or operation.disposal or operation.kind is OperationKind.DROP_TIP:
            return
        comes_back = hand.stays(operation) or (
            operation.kind in (OperationKind.DISPENSE, OperationKind.BLOW_OUT)
            and hand.brings_home(operation)
        )
        # The draws of a consolidate are one: the gap between two of them ends nothing.
        gap_ends_it = operation.is_air and "consolidate" not in operation.call
        if gap_ends_it or not (comes_back or operation.is_air):
            self._begin(hand, steps)

    def _arrival(self, hand: PipetteState, operation: Operation, steps: list[Step]) -> None:
        delivers = hand.delivers(operation)
        carries = hand.contents.holds_liquid and not hand.brings_home(operation)
        draws = operation.kind is OperationKind.ASPIRATE and not operation.mixing
        if not delivers and (draws or not carries or not hand.enters(operation)):
            return
        if hand.current is None:
            self._begin(hand, steps)
        current = hand.current
        if current is None or current.delivered:
            return
        if delivers:
            current.commanded_ul = liquid_of(hand.leaving(operation))
            current.line = operation.line
        if current.frames >= 2:
            return
        hand.aim(current, operation)
        stands_there = hand.above and hand.stays(operation)
        if self._lift and not in_place(operation) and not stands_there and wells_of(operation):
            self._raise(hand, operation, steps)
        self._capture(hand, current, steps)

    # The life of a trajectory

    def _begin(self, hand: PipetteState, steps: list[Step]) -> None:
        hand.current = self._ledger.begin(hand)
        hand.draw = None
        self._capture(hand, hand.current, steps)

    def _capture(self, hand: PipetteState, trajectory: Trajectory, steps: list[Step]) -> None:
        steps.append(Capture(self._ledger.keyframe(hand, trajectory)))

    def _complete(self, hand: PipetteState, steps: list[Step], lift: bool) -> None:
        trajectory = hand.current
        if trajectory is None:
            return
        if lift and self._lift and not hand.above and hand.aimed is not None:
            self._raise(hand, hand.aimed, steps)
        self._capture(hand, trajectory, steps)
        hand.current = None
        self._awaiting.add(hand, trajectory)
        if self._hold == "well":
            self._ask([trajectory], "the well is done", steps)

    def _settle(self, hand: PipetteState, steps: list[Step], lift: bool = True) -> None:
        """All that this pipette owes, because something else is about to move."""
        if hand.draw is not None:
            self._begin(hand, steps)
        if hand.current is not None and hand.current.delivered:
            if hand.current.frames < 3:
                self._capture(hand, hand.current, steps)
            self._complete(hand, steps, lift)

    def _give_up(self, hand: PipetteState, reason: str, steps: list[Step]) -> None:
        if hand.current is not None and not hand.current.delivered:
            steps.append(Abandon(hand.current.number, reason))
            hand.current = None

    def _raise(self, hand: PipetteState, operation: Operation, steps: list[Step]) -> None:
        steps.append(Lift(operation))
        hand.above = True
        hand.place = wells_of(operation)
        if operation.position is None or operation.from_top is None:
            hand.position = None
        else:
            x, y, z = operation.position
            hand.position = (x, y, round(z - operation.from_top, 3))

    def _ask(self, due: list[Trajectory], reason: str, steps: list[Step]) -> None:
        if self._hold == "off" or not due:
            return
        steps.append(Hold(self._awaiting.take(due), reason))

    # What an operation changed

    def _expelled(self, hand: PipetteState, operation: Operation, steps: list[Step]) -> None:
        delivers = hand.delivers(operation)
        everything = operation.kind is OperationKind.BLOW_OUT
        layers = hand.contents.expel(None if everything else operation.volume)
        current = hand.current
        if delivers and current is not None:
            moved = liquid_of(layers)
            current.commanded_ul = moved + (current.commanded_ul if current.delivered else 0.0)
            current.delivered = True
            current.line = operation.line
            hand.aim(current, operation)
        if not hand.contents.holds_liquid:
            hand.draw = None
            self._give_up(hand, "its liquid was thrown away or put back", steps)

    def _stand(self, hand: PipetteState, operation: Operation, target: Place) -> None:
        hand.nozzles = operation.nozzles
        if wells_of(operation):
            hand.aimed = operation
        if operation.position is not None:
            hand.position = operation.position
        if in_place(operation):
            return
        if not wells_of(operation):
            hand.aimed = None
        hand.place = frozenset() if operation.disposal else target
        hand.above = operation.from_top is not None and operation.from_top >= 0

    def _replaced(self, operation: Operation, steps: list[Step]) -> None:
        """Another pipette was loaded on this mount: what the one before it owes ends here."""
        hand = self._hands.get(operation.pipette.key)
        if hand is not None and hand.pipette != operation.pipette:
            hand.draw = None
            self._settle(hand, steps, lift=False)
            self._give_up(hand, "its pipette was unloaded before it was delivered", steps)
            del self._hands[operation.pipette.key]

    def _hand(self, operation: Operation) -> PipetteState:
        key = operation.pipette.key
        if key not in self._hands:
            self._hands[key] = PipetteState(operation.pipette)
        return self._hands[key]


def _draws(operation: Operation) -> bool:
    return (
        operation.kind is OperationKind.ASPIRATE and not operation.is_air and not operation.mixing
    )
