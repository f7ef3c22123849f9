"""One renderer per output. Pure: values in, text out."""

from collections.abc import Callable

from ..checking import CheckRun
from .check_github import check_github
from .check_html import check_html
from .check_json import check_json
from .check_junit import check_junit
from .check_sarif import check_sarif
from .check_text import check_text
from .rule_pages import rule_pages
from .rule_text import rule_list, rule_text

RENDERERS: dict[str, Callable[[CheckRun], str]] = {
    "text": check_text,
    "json": check_json,
    "sarif": check_sarif,
    "github": check_github,
    "junit": check_junit,
    "html": check_html,
}
"""Renderers of checked protocols, by the name of their format."""

SHOW_ROLES = ("text", "json", "html")
"""Formats that show what the wells are taken for, where that is asked for."""

__all__ = [
    "RENDERERS",
    "SHOW_ROLES",
    "check_github",
    "check_html",
    "check_json",
    "check_junit",
    "check_sarif",
    "check_text",
    "rule_list",
    "rule_pages",
    "rule_text",
]
