"""One renderer per output. Pure: values in, text out."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..workbench import CheckRun

FORMATS = tuple(
    module.name.removeprefix("check_")
    for module in iter_modules(__path__)
    if module.name.startswith("check_")
)
"""Of a report on checked protocols: each is a module ``check_NAME`` of this room."""

SHOW_ROLES = ("text", "json", "html")
"""Formats that show what the wells are taken for, where that is asked for."""

__all__ = ["FORMATS", "SHOW_ROLES", "renderer"]


def renderer(name: str) -> Callable[[CheckRun], str]:
    """What writes a report in one of :data:`FORMATS`; only its own libraries are loaded."""
    render: Callable[[CheckRun], str] = getattr(
        import_module(f".check_{name}", __name__), f"check_{name}"
    )
    return render
