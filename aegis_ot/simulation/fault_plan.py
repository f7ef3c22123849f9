"""What a simulated pipette truly holds at each keyframe, planted faults included."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from ..vocabulary import Keyframe, KeyframeKind, WellRef
from .faults import Fault, held_after, parse_faults
from .scene import TipContent


@dataclass(frozen=True)
class PhysicalState:
    """What is truly on a pipette at a keyframe.

    Attributes:
        contents: One tip per channel, ``A1`` first, each as left after the keyframe's moment.
        struck: The faults that act in this trajectory.
    """

    contents: tuple[TipContent, ...]
    struck: tuple[Fault, ...] = ()


@dataclass
class _Mount:
    """A pipette between two keyframes: how its trajectory began, and what happened since."""

    tip: str = ""
    expected: float = 0.0
    trajectory: int = -1
    start: tuple[TipContent, ...] = ()
    changes: list[float] = field(default_factory=list)
    contents: tuple[TipContent, ...] = ()


class FaultPlan:
    """Follows a run's keyframes and tells what each tip truly holds.

    What is drawn or delivered between two keyframes is the change of the volume that the robot
    expects in the tip; :mod:`.faults` says what a fault makes of it. The rest of a partial
    dispense stays in the tip, also for the next wells, until the robot reports another tip:
    keyframes do not tell of blow-outs, so one between two trajectories does not empty it.

    A transient fault (``C4x1``) strikes only the first deliveries into its well: a recovery finds
    it gone.

    A well address means the *destination*. While a trajectory's destination is still unknown (a
    robot learns it only after the aspirate), a well-addressed fault is not yet seen; from then
    on the tip looks as if the fault had struck from the beginning. Give ``expect`` the keyframes
    of a rehearsal, and each fault acts from its trajectory's first keyframe.

    Keyframes of several runs may be mixed. A resent keyframe (same run and sequence number) gets
    the answer it got the first time.
    """

    def __init__(self, faults: Iterable[Fault | str] = (), film: float = 0.004) -> None:
        self.faults = parse_faults(faults)
        self._film = film
        self._mounts: dict[tuple[str, str], _Mount] = {}
        self._answers: OrderedDict[tuple[str, int], PhysicalState] = OrderedDict()
        self._destinations: dict[int, tuple[WellRef | None, ...]] = {}
        self._recoveries: dict[str, set[int]] = {}
        self._struck: dict[tuple[str, Fault], dict[int, None]] = {}

    def expect(self, keyframes: Iterable[Keyframe]) -> None:
        """Learn the destinations of the coming trajectories from a rehearsal's keyframes."""
        for keyframe in keyframes:
            if keyframe.destinations:
                self._destinations[keyframe.trajectory] = _wells_of(keyframe)

    def unmatched(self, keyframes: Sequence[Keyframe]) -> tuple[Fault, ...]:
        """The faults that strike none of these keyframes: a mistyped well, most likely."""
        return tuple(
            fault
            for fault in self.faults
            if not any(
                self._strikes(fault, keyframe, channel)
                for keyframe in keyframes
                for channel in range(max(keyframe.channels, 1))
            )
        )

    def apply(self, keyframe: Keyframe) -> PhysicalState:
        """What the pipette truly holds at this keyframe."""
        key = (keyframe.run, keyframe.sequence)
        if keyframe.recovers is not None:
            self._recoveries.setdefault(keyframe.run, set()).add(keyframe.trajectory)
        if key in self._answers:
            return self._answers[key]
        state = self._advance(keyframe)
        self._answers[key] = state
        while len(self._answers) > 4096:
            self._answers.popitem(last=False)
        return state

    def _advance(self, keyframe: Keyframe) -> PhysicalState:
        channels = max(keyframe.channels, 1)
        mount = self._mounts.setdefault((keyframe.run, keyframe.mount), _Mount())
        if mount.tip != keyframe.tip or len(mount.contents) != channels:
            before = _expected_before(keyframe)
            fresh = tuple(TipContent(liquid_ul=before) for _ in range(channels))
            mount.tip, mount.expected, mount.contents = keyframe.tip, before, fresh
            mount.trajectory = -1
        if mount.trajectory != keyframe.trajectory:
            # A tip that was missing for one trajectory is a new one for the next.
            mount.start = tuple(c if c.present else TipContent() for c in mount.contents)
            mount.trajectory = keyframe.trajectory
            mount.changes = []
        mount.changes.append(keyframe.expected_ul - mount.expected)
        mount.expected = keyframe.expected_ul
        struck: dict[Fault, None] = {}
        contents = []
        for channel, start in enumerate(mount.start):
            faults = [f for f in self.faults if self._strikes(f, keyframe, channel)]
            faults = [f for f in faults if self._still(f, keyframe)]
            struck.update(dict.fromkeys(faults))
            acting = {fault.kind: fault for fault in faults}
            contents.append(held_after(start, mount.changes, acting, self._film))
        mount.contents = tuple(contents)
        return PhysicalState(mount.contents, tuple(struck))

    def _still(self, fault: Fault, keyframe: Keyframe) -> bool:
        """Whether a transient fault still strikes the trajectory that it would strike."""
        if fault.where.times is None:
            return True
        struck = self._struck.setdefault((keyframe.run, fault), {})
        if len(struck) < fault.where.times:
            struck[keyframe.trajectory] = None
        return keyframe.trajectory in struck

    def _planned(self, keyframe: Keyframe) -> tuple[WellRef | None, ...]:
        """Where the rehearsal says that the trajectory goes; it knows of no recoveries."""
        trajectory = keyframe.trajectory if keyframe.recovers is None else keyframe.recovers
        recoveries = self._recoveries.get(keyframe.run, ())
        earlier = sum(number < trajectory for number in recoveries)
        return self._destinations.get(trajectory - earlier, ())

    def _strikes(self, fault: Fault, keyframe: Keyframe, channel: int) -> bool:
        if fault.where.number is not None:
            return fault.where.number == keyframe.trajectory + 1
        wells = _wells_of(keyframe) or self._planned(keyframe)
        if len(wells) == max(keyframe.channels, 1):
            well = wells[channel]
            return well is not None and fault.where.matches(well)
        # Channels that share a well (a reservoir) share its fault.
        return any(well is not None and fault.where.matches(well) for well in wells)


def _wells_of(keyframe: Keyframe) -> tuple[WellRef | None, ...]:
    """The well of each channel, as far as the robot says; else those that the channels share."""
    return keyframe.targets or keyframe.destinations


def _expected_before(keyframe: Keyframe) -> float:
    """What the tip held before its first keyframe, as far as that one tells, µL."""
    if keyframe.kind in (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT):
        return 0.0
    return keyframe.expected_ul + keyframe.commanded_ul
