"""The report of one run, or of several, as one HTML page: no script, no link, pictures inside."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..account import PlateMap, SeenWell, plate_maps, run_account, seen_well
from ..account.pictures import cut_pictures
from ..account.summary import is_flagged
from .html_page import html_page

MOST_PICTURED = 60
"""Flagged wells with pictures; of further ones the numbers are told. About 0.15 MB each."""


@dataclass(frozen=True)
class ReportedRun:
    """All that a report shows of a run.

    Attributes:
        account: See :func:`~aegis_ot.account.run_account`; the JSON report.
        plates: In the order in which they were filled.
        flagged: Wells that failed, are undecided, or that a person decided, with their frames.
        notes: What else must be said.
    """

    account: Mapping[str, Any]
    plates: Sequence[PlateMap]
    flagged: Sequence[SeenWell]
    notes: Sequence[str] = ()


def report_run(
    overview: Mapping[str, Any],
    frame: Callable[[int], bytes | None],
    notes: Sequence[str] = (),
) -> ReportedRun:
    """Gather a run's report.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        frame: The JPEG of a keyframe's number; ``None`` where it is missing.
        notes: What else must be said.
    """
    entries = [entry for entry in overview["trajectories"] if is_flagged(entry)]
    pictures = cut_pictures(frame)
    wells = [
        seen_well(str(overview["run"]), entry, pictures if number < MOST_PICTURED else _none)
        for number, entry in enumerate(entries)
    ]
    return ReportedRun(
        run_account(overview), plate_maps(overview["trajectories"]), wells, tuple(notes)
    )


def run_report_html(runs: Sequence[ReportedRun], title: str = "") -> str:
    """Render runs as one HTML page."""
    named = title or str(runs[0].account["protocol"] or runs[0].account["run"])
    return html_page("aegis_ot.reports", "run.html", {}, runs=runs, title=named)


def _none(_sequence: int, _box: Any) -> tuple[None, None, str]:
    return None, None, "Left out, to keep this report small."
