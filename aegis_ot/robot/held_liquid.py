"""What the tips of a run may hold, as its commands say: told when nobody else can tell any more."""

from __future__ import annotations

from dataclasses import dataclass

from .operations import number_of
from .server_answers import Command, RunSnapshot

_LEAST_UL = 0.05
_DROPS = ("dropTip", "dropTipInPlace", "unsafe/dropTipInPlace")
_DRAWS = ("aspirate", "aspirateInPlace", "aspirateWhileTracking")
_GIVES = ("dispense", "dispenseInPlace", "dispenseWhileTracking")
_EMPTIES = ("blowout", "blowOutInPlace")


@dataclass
class _Tip:
    volume_ul: float = 0.0
    labware: str = ""
    well: str = ""


class HeldLiquid:
    """Hears the commands of one run, in order."""

    def __init__(self) -> None:
        self._tips: dict[str, _Tip] = {}

    def began(self, command: Command) -> None:
        """What may be in the tip counts from the begin of a command on."""
        params = command.params
        if command.kind == "pickUpTip":
            self._tips[str(params.get("pipetteId", ""))] = _Tip()
        elif command.kind in _DRAWS:
            tip = self._tips.setdefault(str(params.get("pipetteId", "")), _Tip())
            tip.volume_ul += number_of(params.get("volume"))
            if params.get("wellName"):
                tip.labware, tip.well = str(params.get("labwareId", "")), str(params["wellName"])

    def done(self, command: Command) -> None:
        """What has left the tip counts from the end of a command on that succeeded."""
        pipette = str(command.params.get("pipetteId", ""))
        tip = self._tips.get(pipette)
        if tip is None or command.status != "succeeded":
            return
        if command.kind in _DROPS:
            del self._tips[pipette]
        elif command.kind in _GIVES:
            tip.volume_ul = max(0.0, tip.volume_ul - number_of(command.params.get("volume")))
        elif command.kind in _EMPTIES:
            tip.volume_ul = 0.0

    def told(self, view: RunSnapshot | None) -> str:
        """Which tips are on, and what they may hold.

        Args:
            view: The run as it was last seen, for names.
        """
        return " ".join(self._tip(pipette, tip, view) for pipette, tip in self._tips.items())

    @staticmethod
    def _tip(identifier: str, tip: _Tip, view: RunSnapshot | None) -> str:
        pipettes = view.pipettes if view is not None else ()
        name = next((f"{p.mount} {p.name}" for p in pipettes if p.id == identifier), "pipette")
        if tip.volume_ul < _LEAST_UL:
            return f"The {name} has a tip on."
        known = view.labware if view is not None else ()
        stood = next((one for one in known if one.id == tip.labware), None)
        place = f" of {stood.label} in slot {stood.slot}" if stood and stood.slot else ""
        source = f" from {tip.well}{place}" if tip.well else ""
        return f"The tip on the {name} may hold {tip.volume_ul:g} µL{source}."
