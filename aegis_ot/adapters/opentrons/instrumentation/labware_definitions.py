"""From Opentrons' labware definitions to what a run needs of them."""

from __future__ import annotations

import functools
import json
from typing import Any

from .labware import LabwareInfo, WellInfo


def describe(definition: Any) -> LabwareInfo:
    """What a definition says; the key, label and place of one piece of labware are left open."""
    parameters = definition.get("parameters", {})
    metadata = definition.get("metadata", {})
    return LabwareInfo(
        key="",
        load_name=str(parameters.get("loadName", "")),
        display_name=str(metadata.get("displayName", "")),
        label="",
        slot="",
        is_tip_rack=bool(parameters.get("isTiprack", False)),
        is_trash=metadata.get("displayCategory") == "trash"
        or parameters.get("format") == "trash"
        or "fixedTrash" in (parameters.get("quirks") or ()),
        centers_channels="centerMultichannelOnWells" in (parameters.get("quirks") or ()),
        wells=_describe_wells(definition),
    )


def _describe_wells(definition: Any) -> dict[str, WellInfo]:
    bottoms = {
        name: str(group.get("metadata", {}).get("wellBottomShape") or "")
        for group in definition.get("groups", ())
        for name in group.get("wells", ())
    }
    sections = _inner_sections(definition)
    if not sections and definition.get("namespace") == "opentrons":
        sections = _newest_inner_sections(str(definition["parameters"]["loadName"]))
    return {
        name: _describe_well(well, bottoms.get(name, ""), sections.get(name, ()))
        for name, well in definition["wells"].items()
    }


def _inner_sections(definition: Any) -> dict[str, tuple[Any, ...]]:
    """Each well's inner geometry, where the definition has one."""
    inner = definition.get("innerLabwareGeometry") or {}
    by_key = {
        key: tuple(sorted(geometry.get("sections", ()), key=lambda one: one["bottomHeight"]))
        for key, geometry in inner.items()
    }
    found = {
        name: by_key.get(well.get("geometryDefinitionId"), ())
        for name, well in definition["wells"].items()
    }
    return found if any(found.values()) else {}


@functools.cache
def _newest_inner_sections(load_name: str) -> dict[str, tuple[Any, ...]]:
    """The same of the newest definition of this name: older ones do without."""
    try:
        from opentrons_shared_data import get_shared_data_root

        folder = get_shared_data_root() / "labware" / "definitions" / "2" / load_name
        newest = max(folder.glob("*.json"), key=lambda path: int(path.stem))
        return _inner_sections(json.loads(newest.read_text(encoding="utf-8")))
    except (ImportError, OSError, ValueError):  # no Opentrons, or definitions kept elsewhere
        return {}


def _describe_well(well: Any, bottom: str, sections: tuple[Any, ...]) -> WellInfo:
    return WellInfo(
        max_volume=float(well.get("totalLiquidVolume", 0.0)),
        depth=well.get("depth", 0.0),
        x=well.get("x", 0.0),
        y=well.get("y", 0.0),
        diameter=well.get("diameter"),
        x_size=well.get("xDimension"),
        y_size=well.get("yDimension"),
        bottom=bottom,
        sections=sections,
    )
