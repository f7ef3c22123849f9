"""Checked protocols as one HTML page: no link, and no script but the one that plays rehearsals."""

from __future__ import annotations

from ..vocabulary import Finding
from ..workbench import CheckedProtocol, CheckRun
from ..workbench.playback import marks_of
from .html_page import Filters, html_page
from .played import mark_of, played
from .wording import (
    by_model,
    listed,
    listed_wells,
    model_line,
    site_label,
    sites_by_line,
    summary_line,
)

Row = tuple[int, str, str]
"""Line number, source, and what happened there (empty: shown for context)."""

_CONTEXT = 1


def check_html(run: CheckRun) -> str:
    """Render as HTML."""
    filters: Filters = {
        "wells": lambda finding: listed_wells(finding.wells, 96),
        "listed": lambda values: listed([str(v) for v in values], 16),
        "by_model": by_model,
        "model_line": model_line,
    }
    return html_page(
        "aegis_ot.reports",
        "check.html",
        filters,
        run=run,
        rules={rule.id: rule for rule in run.rule_set.rules},
        summary=summary_line(run),
        excerpt=_excerpt,
        played={
            checked.file: played(
                checked.playback, map(mark_of, checked.findings), checked.lines, checked.unit
            )
            for checked in run.protocols
        },
        steps=_steps,
    )


def _steps(checked: CheckedProtocol, finding: Finding) -> list[int]:
    """The steps at which a finding happened."""
    return [] if checked.playback is None else marks_of(checked.playback, finding.sites)


def _excerpt(checked: CheckedProtocol, finding: Finding) -> list[Row]:
    """The lines concerned, with their neighbours; line 0 stands for a gap."""
    sites = sites_by_line(finding)
    shown = sorted(
        {
            number
            for line in sites
            for number in range(line - _CONTEXT, line + _CONTEXT + 1)
            if 0 < number <= len(checked.lines)
        }
    )
    rows: list[Row] = []
    for number in shown:
        if rows and number > rows[-1][0] + 1:
            rows.append((0, "", ""))
        step = checked.steps.get(number)
        text = f"{f'{step}: ' if step else ''}{checked.lines[number - 1]}"
        rows.append((number, text, site_label(sites.get(number, []))))
    return rows
