"""Doors that load a room's modules when a name is first asked for.

A command that lists rules or runs would else load the simulator, or the web service, with them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def door(package: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """The ``__getattr__`` of a package.

    Args:
        package: Its ``__name__``.
        names: By module of the package the public names that it defines, with spaces between.
    """
    modules = {name: module for module, those in names.items() for name in those.split()}

    def __getattr__(name: str) -> Any:
        if name not in modules:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(f".{modules[name]}", package), name)

    return __getattr__
