"""Numbers trajectories and keyframes, and writes on each what the robot knows."""

from __future__ import annotations

from collections.abc import Mapping

from ..vocabulary import Keyframe, KeyframeKind, WellRef
from .pipette_state import PipetteState
from .steps import Trajectory

_ORDER = tuple(KeyframeKind)


class Ledger:
    """Counts of one run; both numbers rise from 0 without gaps.

    Attributes:
        trajectories: How many have begun.
        recovering: The failed trajectory that a pipette is recovering just now, by mount.
        reagents: Name of the liquid that was loaded into a well.
    """

    def __init__(self, run: str) -> None:
        self._run = run
        self._sequence = 0
        self.trajectories = 0
        self.recovering: Mapping[str, int] = {}
        self.reagents: dict[WellRef, str] = {}

    def begin(self, hand: PipetteState) -> Trajectory:
        """A new trajectory for what this pipette holds."""
        sources = hand.contents.sources
        names = dict.fromkeys(name for well in sources if (name := self.reagents.get(well)))
        trajectory = Trajectory(
            number=self.trajectories,
            sources=sources,
            channels=max(1, len(hand.nozzles)),
            nozzles=hand.nozzles if len(hand.nozzles) > 1 else (),
            commanded_ul=hand.contents.liquid,
            reagent=" + ".join(names) or None,
            line=hand.draw.line if hand.draw is not None else None,
            recovers=self.recovering.get(hand.pipette.mount),
            found=hand.contents.found,
        )
        self.trajectories += 1
        return trajectory

    def keyframe(self, hand: PipetteState, trajectory: Trajectory) -> Keyframe:
        """The next of the four keyframes, as things stand now."""
        known = {found for found in trajectory.found if found is not None}
        one = len(trajectory.sources) == 1
        each = known and not one and len(trajectory.found) == trajectory.channels
        keyframe = Keyframe(
            run=self._run,
            sequence=self._sequence,
            trajectory=trajectory.number,
            kind=_ORDER[trajectory.frames],
            pipette=hand.pipette.name,
            mount=hand.pipette.mount,
            channels=trajectory.channels,
            tip=hand.tip,
            sources=trajectory.sources,
            destinations=trajectory.destinations,
            commanded_ul=round(trajectory.commanded_ul, 3),
            expected_ul=round(hand.contents.liquid, 3),
            capacity_ul=hand.capacity or hand.pipette.max_volume,
            reagent=trajectory.reagent,
            position=hand.position,
            line=trajectory.line,
            recovers=trajectory.recovers,
            nozzles=trajectory.nozzles,
            targets=trajectory.targets,
            liquid_found=known.pop() if one and len(known) == 1 else None,
            channels_found=trajectory.found if each else (),
        )
        self._sequence += 1
        trajectory.frames += 1
        return keyframe
