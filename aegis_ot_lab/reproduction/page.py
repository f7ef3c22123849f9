"""The page: ours beside the paper's, with what each figure stands on. Self-contained."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aegis_ot.reports.html_page import html_page

from .experiment import NOT_RUN
from .paper import ROWS, PaperRow
from .runner import Entry


def reproduction_html(entries: Sequence[Entry], out: Path) -> str:
    """Render the page.

    Args:
        entries: One for each experiment.
        out: Holds the pictures.
    """
    return html_page(
        "aegis_ot_lab.reproduction",
        "reproduction.html",
        {"png": lambda file: _png(out / file), "kind": _kind},
        rows=[(row, _answers(row, entries)) for row in ROWS],
        entries=entries,
        seconds=sum(entry.seconds for entry in entries),
        not_run=NOT_RUN,
    )


def reproduction_json(entries: Sequence[Entry]) -> dict[str, Any]:
    """The same as plain values."""
    return {
        "format": "aegis-ot reproduction",
        "rows": [
            vars(row)
            | {
                "ours": [
                    {"experiment": entry.experiment.name, "state": entry.state, "answer": answer}
                    for entry, answer in _answers(row, entries)
                ]
            }
            for row in ROWS
        ],
        "experiments": [entry.to_json() for entry in entries],
    }


def _answers(row: PaperRow, entries: Sequence[Entry]) -> list[tuple[Entry, tuple[str, ...]]]:
    """Who answers a row, and what; the reason where there is no answer."""
    told = []
    for entry in entries:
        if row.key not in entry.experiment.rows:
            continue
        if entry.outcome is not None:
            answer = entry.outcome.answers.get(row.key, ())
        elif entry.problem:
            answer = (f"failed: {entry.problem}",)
        else:
            answer = (f"{NOT_RUN} yet, or left out with --only",)
        told.append((entry, answer))
    return told


def _kind(data: str) -> str:
    """``simulated`` of ``simulated: a set of ...``."""
    return data.partition(":")[0]


def _png(path: Path) -> str:
    """A picture as an address that holds it."""
    return "data:image/png;base64," + base64.b64encode(path.read_bytes()).decode("ascii")
