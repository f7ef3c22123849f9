"""The page: self-contained, with the pictures inside and no link to anywhere."""

from __future__ import annotations

from collections import Counter

from ..reports.html_page import html_page
from ..run_view import Inspection, SeenWell


def inspection_html(inspection: Inspection) -> str:
    """Render one inspection as an HTML page."""
    groups: dict[str, list[tuple[int, SeenWell]]] = {}
    for number, well in enumerate(inspection.wells):
        groups.setdefault(well.group, []).append((number, well))
    wells = inspection.wells
    return html_page(
        "aegis_ot.inspection",
        "inspect.html",
        {},
        inspection=inspection,
        groups=groups,
        flagged=sum(well.flagged for well in wells),
        outcomes=Counter(well.outcome or "no verdict" for well in wells),
        agreements=Counter(well.agreement for well in wells if well.agreement),
        in_nats=any(well.signs for well in wells),
        unpictured=sum(not well.pictured for well in wells),
    )
