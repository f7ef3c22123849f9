"""The page: self-contained, with the pictures inside and no link to anywhere."""

from __future__ import annotations

import base64
from collections import Counter

from jinja2 import Environment, PackageLoader, StrictUndefined

from .. import __version__
from ..vocabulary import KeyframeKind
from .wells import Inspection, Level, Picture, SeenWell

_TITLES = {
    KeyframeKind.ASPIRATE: "aspirate",
    KeyframeKind.TRANSIT: "transit",
    KeyframeKind.DISPENSE: "dispense",
    KeyframeKind.POST_DISPENSE: "post-dispense",
}


def inspection_html(inspection: Inspection) -> str:
    """Render one inspection as an HTML page."""
    environment = Environment(
        loader=PackageLoader("aegis_ot.inspection"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["data_url"] = _data_url
    environment.filters["level"] = _level
    groups: dict[str, list[tuple[int, SeenWell]]] = {}
    for number, well in enumerate(inspection.wells):
        groups.setdefault(well.group, []).append((number, well))
    wells = inspection.wells
    return environment.get_template("inspect.html").render(
        inspection=inspection,
        groups=groups,
        flagged=sum(well.flagged for well in wells),
        outcomes=Counter(well.outcome or "no verdict" for well in wells),
        agreements=Counter(well.agreement for well in wells if well.agreement),
        unpictured=sum(not well.pictured for well in wells),
        titles=_TITLES,
        version=__version__,
    )


def _data_url(picture: Picture) -> str:
    return "data:image/jpeg;base64," + base64.b64encode(picture.jpeg).decode("ascii")


def _level(level: Level) -> str:
    """``150 ± 6 µL``; one decimal below 30 µL."""
    digits = 1 if level.volume_ul < 30 else 0
    text = f"{level.volume_ul:.{digits}f}"
    if level.sigma_ul:
        text += f" ± {level.sigma_ul:.{digits}f}"
    air = f", {level.air_ul:.{digits}f} µL air" if level.air_ul > 0.05 else ""
    return f"{text} µL{air}"
