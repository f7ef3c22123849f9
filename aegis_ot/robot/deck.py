"""What a run has loaded, by the identifiers that its commands use."""

from __future__ import annotations

import contextlib
import re
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from ..adapters.opentrons.instrumentation import PipetteInfo
from ..errors import RobotError, RobotRefused, RobotUnreachable
from ..vocabulary import WellRef
from ..vocabulary.pipette_names import channels_of, largest_volume
from ..workbench.nozzles import Layout, under
from .client import RobotClient
from .following import PATIENCE_S
from .server_answers import Labware, RunSnapshot

T = TypeVar("T")
_AGAIN_S = 0.5
_TRASH = re.compile(r"trash|waste", re.IGNORECASE)


class Deck:
    """Pipettes and labware of one run, asked for as its commands name them."""

    def __init__(self, robot: RobotClient, run: str) -> None:
        self._robot = robot
        self._run = run
        self._view: RunSnapshot | None = None
        self._definitions: dict[str, Mapping[str, Any]] = {}
        self._moved: dict[str, str] = {}

    def pipette(self, identifier: str) -> PipetteInfo | None:
        """The pipette of this identifier."""
        view = self._known(lambda v: any(p.id == identifier for p in v.pipettes))
        for pipette in view.pipettes:
            if pipette.id == identifier:
                name = pipette.name
                return PipetteInfo(
                    pipette.mount, name, pipette.mount, channels_of(name), largest_volume(name)
                )
        return None

    def well(self, labware: str, name: str) -> WellRef:
        """One well; it need not be known to be named."""
        found = self._labware(labware)
        if found is None:
            return WellRef(labware, name)
        slot = self._moved.get(labware, found.slot)
        return WellRef(labware, name, self._label(found), slot)

    def wells(self, labware: str, name: str, layout: Layout) -> tuple[WellRef, ...]:
        """The well under each tip, the primary nozzle's over ``name``."""
        columns: Sequence[Sequence[str]] = self._definition(labware).get("ordering") or ()
        names = under(columns, name, layout)
        return tuple(self.well(labware, known) for known in names)

    def is_trash(self, labware: str) -> bool:
        """Whether liquid and tips that go there are thrown away."""
        found = self._labware(labware)
        return bool(_TRASH.search(found.load_name if found is not None else labware))

    def depth(self, labware: str, name: str) -> float | None:
        """Of a well, mm; ``None`` if it is not known."""
        depth = self._well(labware, name).get("depth")
        return float(depth) if isinstance(depth, (int, float)) else None

    def tip_volume(self, labware: str, name: str) -> float | None:
        """What a tip of this rack holds, µL; ``None`` if it is not known."""
        volume = self._well(labware, name).get("totalLiquidVolume")
        return float(volume) if isinstance(volume, (int, float)) and volume > 0 else None

    def liquid(self, identifier: str) -> str:
        """Name of a declared liquid."""
        view = self._known(lambda v: identifier in v.liquids)
        return view.liquids.get(identifier, "")

    def liquid_found(self, command: str) -> bool | None:
        """What a probe that may find no liquid says; ``None`` where the robot does not tell.

        Asked once: a run that goes on is not kept waiting for a witness.
        """
        try:
            result = self._robot.result(self._run, command)
        except RobotError:
            return None
        return result.get("z_position") is not None if result else None

    def moved(self, labware: str, slot: str) -> None:
        """A labware stands elsewhere now."""
        self._moved[labware] = slot

    def _labware(self, identifier: str) -> Labware | None:
        view = self._known(lambda v: any(one.id == identifier for one in v.labware))
        return next((one for one in view.labware if one.id == identifier), None)

    def _label(self, labware: Labware) -> str:
        if labware.label != labware.load_name:
            return labware.label
        metadata = self._definition(labware.id).get("metadata") or {}
        return str(metadata.get("displayName") or labware.label)

    def _definition(self, identifier: str) -> Mapping[str, Any]:
        labware = self._labware(identifier)
        if labware is None:
            return {}
        if labware.uri not in self._definitions:
            with contextlib.suppress(RobotRefused):  # a server that does not tell them
                self._definitions.update(
                    patiently(lambda: self._robot.labware_definitions(self._run))
                )
            self._definitions.setdefault(labware.uri, {})
        return self._definitions[labware.uri]

    def _well(self, labware: str, name: str) -> Mapping[str, Any]:
        wells: Mapping[str, Mapping[str, Any]] = self._definition(labware).get("wells") or {}
        return wells.get(name) or {}

    def _known(self, enough: Any) -> RunSnapshot:
        if self._view is None or not enough(self._view):
            self._view = patiently(lambda: self._robot.run(self._run))
        return self._view


def patiently(ask: Callable[[], T]) -> T:
    """Ask again while the robot does not answer; raises RobotUnreachable in the end."""
    until = time.monotonic() + PATIENCE_S
    while True:
        try:
            return ask()
        except RobotUnreachable:
            if time.monotonic() > until:
                raise
            time.sleep(_AGAIN_S)
