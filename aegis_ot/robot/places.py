"""Which labware stands where in the commands of an analysis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple


class Place(NamedTuple):
    """A labware and where it stands, as far as an offset depends on it.

    Attributes:
        uri: Definition, ``"opentrons/corning_96_wellplate_360ul_flat/2"``.
        slot: Of the deck, ``""`` off it.
        module: Model of the module that it stands on, or ``""``.
        under: Definitions of the labware below it (an adapter), from the top.
    """

    uri: str
    slot: str
    module: str = ""
    under: tuple[str, ...] = ()


def places_of(commands: Iterable[Mapping[str, Any]]) -> Iterator[Place]:
    """Where the labware of an analysis, or of a run, stands in turn; off the deck left out."""
    known: dict[str, Place] = {}  # labware and modules; of a module the definition is empty
    for command in commands:
        kind, params = command.get("commandType"), command.get("params") or {}
        result = command.get("result") or {}
        if kind == "loadModule":
            slot = place_at(params.get("location"), known).slot
            known[str(result.get("moduleId"))] = Place("", slot, str(params.get("model") or ""))
            continue
        if kind == "loadLabware":
            labware, where = str(result.get("labwareId")), params.get("location")
            definition = result.get("definition") or {}
            name = (definition.get("parameters") or {}).get("loadName") or params.get("loadName")
            named = (definition.get(part) or params.get(part) for part in ("namespace", "version"))
            uri = "{0}/{2}/{1}".format(*named, name)
        elif kind == "moveLabware" and str(params.get("labwareId")) in known:
            labware, where = str(params.get("labwareId")), params.get("newLocation")
            uri = known[labware].uri
        else:
            continue
        known[labware] = place_at(where, known)._replace(uri=uri)
        if known[labware].slot:
            yield known[labware]


def place_at(location: Any, known: Mapping[str, Place]) -> Place:
    """A location: a slot, or on what stands in it; its definition is empty."""
    if not isinstance(location, Mapping):
        return Place("", "")
    on = known.get(str(location.get("moduleId") or location.get("labwareId") or ""))
    if on is not None:
        return on._replace(uri="", under=(on.uri, *on.under) if on.uri else ())
    return Place("", str(location.get("slotName") or location.get("addressableAreaName") or ""))
