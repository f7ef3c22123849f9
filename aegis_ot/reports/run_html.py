"""The report of one run, or of several, as one HTML page: no link, pictures inside, and no script
but the one that plays rehearsals."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..run_view import PlateView, SeenWell, plates_of, run_account, seen_well
from ..run_view.overview import RunOverview
from ..run_view.pictures import cut_pictures
from ..run_view.summary import is_flagged
from .html_page import html_page, video_url

MOST_PICTURED = 60
"""Flagged wells with pictures; of further ones the numbers are told. About 0.15 MB each."""


MOST_CLIPS = 20
"""Flagged wells with a video, some 0.3 MB each."""


@dataclass(frozen=True)
class ReportedRun:
    """All that a report shows of a run.

    Attributes:
        account: See :func:`~aegis_ot.run_view.run_account`; the JSON report.
        plates: In the order in which they were filled.
        flagged: Wells that failed, are undecided, or that a person decided, with their frames.
        notes: What else must be said.
        clips: Videos of the seconds around flagged deliveries, and around what happened at others,
            as addresses that hold them.
        played: The rehearsal to play, see :func:`~.played.played`; ``None``: there is none.
    """

    account: Mapping[str, Any]
    plates: Sequence[PlateView]
    flagged: Sequence[SeenWell]
    notes: Sequence[str] = ()
    clips: Mapping[int, str] = field(default_factory=dict)
    played: Mapping[str, Any] | None = None


def report_run(
    overview: RunOverview,
    frame: Callable[[int], bytes | None],
    notes: Sequence[str] = (),
    clip: Callable[[int], bytes | None] = lambda _: None,
) -> ReportedRun:
    """Gather a run's report.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        frame: The JPEG of a keyframe's number; ``None`` where it is missing.
        notes: What else must be said.
        clip: The video of a delivery, WebM; ``None`` where there is none.
    """
    entries = [entry for entry in overview["trajectories"] if is_flagged(entry)]
    pictures = cut_pictures(frame)
    wells = [
        seen_well(str(overview["run"]), entry, pictures if number < MOST_PICTURED else _none)
        for number, entry in enumerate(entries)
    ]
    others = [one for one in overview["trajectories"] if one.get("clip") and one not in entries]
    numbers = [entry["trajectory"] for entry in (*entries[:MOST_CLIPS], *others[:MOST_CLIPS])]
    clips = {number: video_url(video) for number in numbers if (video := clip(number))}
    return ReportedRun(run_account(overview), plates_of(overview), wells, tuple(notes), clips)


def run_report_html(runs: Sequence[ReportedRun], title: str = "") -> str:
    """Render runs as one HTML page."""
    named = title or str(runs[0].account["protocol"] or runs[0].account["run"])
    return html_page("aegis_ot.reports", "run.html", {}, runs=runs, title=named)


def _none(_sequence: int, _box: Any) -> tuple[None, None, str]:
    return None, None, "Left out, to keep this report small."
