"""One renderer per output. Pure: values in, text out."""

from collections.abc import Callable

from ..checking import CheckRun
from .check_json import check_json
from .check_text import check_text
from .dryrun_html import dry_run_html

RENDERERS: dict[str, Callable[[CheckRun], str]] = {
    "text": check_text,
    "json": check_json,
}
"""Renderers of checked protocols, by the name of their format."""

__all__ = ["RENDERERS", "check_json", "check_text", "dry_run_html"]
