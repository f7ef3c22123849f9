"""The page: self-contained, with the pictures inside and no link to anywhere."""

from __future__ import annotations

from collections import Counter

from ..account import Inspection, Level, SeenWell
from ..reports.html_page import KEYFRAME_TITLES, data_url, html_page


def inspection_html(inspection: Inspection) -> str:
    """Render one inspection as an HTML page."""
    groups: dict[str, list[tuple[int, SeenWell]]] = {}
    for number, well in enumerate(inspection.wells):
        groups.setdefault(well.group, []).append((number, well))
    wells = inspection.wells
    return html_page(
        "aegis_ot.inspection",
        "inspect.html",
        {"data_url": lambda picture: data_url(picture.jpeg), "level": _level},
        inspection=inspection,
        groups=groups,
        flagged=sum(well.flagged for well in wells),
        outcomes=Counter(well.outcome or "no verdict" for well in wells),
        agreements=Counter(well.agreement for well in wells if well.agreement),
        unpictured=sum(not well.pictured for well in wells),
        titles=KEYFRAME_TITLES,
    )


def _level(level: Level) -> str:
    """``150 ± 6 µL``; one decimal below 30 µL."""
    digits = 1 if level.volume_ul < 30 else 0
    text = f"{level.volume_ul:.{digits}f}"
    if level.sigma_ul:
        text += f" ± {level.sigma_ul:.{digits}f}"
    air = f", {level.air_ul:.{digits}f} µL air" if level.air_ul > 0.05 else ""
    return f"{text} µL{air}"
