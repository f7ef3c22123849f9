"""The report of a fleet's run as one HTML page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .html_page import html_page


def fleet_report_html(report: Mapping[str, Any]) -> str:
    """Render a fleet's report (``aegis_ot.fleet.FleetReport.to_json`` with pictures)."""
    return html_page("aegis_ot.reports", "fleet.html", {"share": _share}, report=report)


def _share(seconds: float | None, whole: float) -> str:
    """Percent of the whole run, for a bar."""
    return f"{100 * (seconds or 0.0) / whole:.2f}%" if whole else "0%"
