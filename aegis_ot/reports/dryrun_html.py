"""A report of dry runs as one HTML page: no script, no link, frames inside."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..preflight.checking import summary
from .html_page import KEYFRAME_TITLES, Filters, data_url, html_page


def dry_run_html(results: Sequence[Any]) -> str:
    """Render finished dry runs (``aegis_ot.dryrun.DryRun``) as one HTML page."""
    filters: Filters = {"data_url": data_url, "summary": summary}
    return html_page(
        "aegis_ot.reports", "dryrun.html", filters, results=results, titles=KEYFRAME_TITLES
    )
