"""Which code is the scientist's own: the protocol's text, and helper modules kept beside it.

A helper module belongs neither to Python nor to an installed package.
"""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Mapping
from types import FunctionType, ModuleType
from typing import Any

_PACKAGES = ("opentrons", "opentrons_shared_data", __name__.partition(".")[0])
"""May be checked out in a folder of their own."""


@functools.lru_cache(maxsize=4096)
def is_helper_file(file_name: str) -> bool:
    """Whether a ``co_filename`` or ``__file__`` is that of a helper module."""
    if not file_name.endswith(".py") or not os.path.isabs(file_name):
        return False
    return not file_name.startswith(_installed())


@functools.lru_cache(maxsize=1)
def _installed() -> tuple[str, ...]:
    """The folders of Python itself and of installed packages."""
    # Not from sysconfig: it reads a module of build settings that a robot's system may lack.
    folders = {os.path.dirname(os.__file__)}
    folders |= {path for path in sys.path if path.endswith(("site-packages", "dist-packages"))}
    for name in _PACKAGES:
        file = getattr(sys.modules.get(name), "__file__", None)
        if file:
            folders.add(os.path.dirname(file))
    return tuple(os.path.join(os.path.abspath(folder), "") for folder in folders)


def helper_modules(namespace: Mapping[str, Any]) -> tuple[ModuleType, ...]:
    """Helper modules that the protocol imported, or something from, however deep, each once."""
    found: dict[int, ModuleType] = {}
    waiting = [namespace]
    while waiting:
        for value in list(waiting.pop().values()):
            module = _module_of(value)
            if module is not None and id(module) not in found and is_helper_module(module):
                found[id(module)] = module
                waiting.append(vars(module))
    return tuple(found.values())


def is_helper_module(module: Any) -> bool:
    """Whether this is a helper module; ``__main__`` is what was started, not what was imported."""
    if type(module) is not ModuleType or vars(module).get("__name__") == "__main__":
        return False
    file = vars(module).get("__file__")
    return isinstance(file, str) and is_helper_file(os.path.abspath(file))


def _module_of(value: Any) -> ModuleType | None:
    """A module, or the one that a function or class (``from layout import wells``) is from."""
    if type(value) is ModuleType:
        return value
    # Not isinstance, which asks the value: a proxy may answer anything, or raise.
    if type(value) is FunctionType or issubclass(type(value), type):
        try:
            module = sys.modules.get(value.__module__)
        except Exception:  # a metaclass that does not tell
            return None
        return module if type(module) is ModuleType else None
    return None
