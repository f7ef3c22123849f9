"""Finds the functions that are the protocol's own, and not Opentrons' or a library's.

Its own are those of its text, and those of helper modules that the scientist keeps beside it:
modules that belong neither to Python nor to an installed package.
"""

from __future__ import annotations

import functools
import inspect
import os
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from contextlib import suppress
from types import CodeType, FunctionType, MethodType, ModuleType
from typing import Any

_LONGEST = 100
"""A table of functions is shorter than this; anything longer is data."""
_CONTAINERS = (dict, list, tuple, set, frozenset)


def helper_modules(namespace: Mapping[str, Any]) -> tuple[ModuleType, ...]:
    """Modules that the protocol imported from beside itself, however deep, each once."""
    found: dict[int, ModuleType] = {}
    waiting = [namespace]
    while waiting:
        for value in list(waiting.pop().values()):
            module = _module_of(value)
            if module is not None and id(module) not in found and _is_helper(module):
                found[id(module)] = module
                waiting.append(vars(module))
    return tuple(found.values())


def _module_of(value: Any) -> ModuleType | None:
    """A module, or the one that a function or class (``from layout import wells``) is from."""
    if type(value) is ModuleType:
        return value
    if type(value) is FunctionType or _is_class(value):
        module = sys.modules.get(_module_name(value))
        return module if type(module) is ModuleType else None
    return None


def _is_class(value: Any) -> bool:
    # Not isinstance, which asks the value: a proxy may answer anything, or raise.
    return issubclass(type(value), type)


def _module_name(value: Any) -> str:
    """Of a function or class; ``""`` for a class whose metaclass does not tell."""
    try:
        return str(value.__module__)
    except Exception:
        return ""


def _is_helper(module: ModuleType) -> bool:
    file = vars(module).get("__file__")
    root = str(vars(module).get("__name__", "")).partition(".")[0]
    if not isinstance(file, str) or not file.endswith(".py"):
        return False
    if root in ("opentrons", "opentrons_shared_data", __name__.partition(".")[0]):
        return False  # may be checked out in a folder of its own
    return not os.path.abspath(file).startswith(_installed())


@functools.lru_cache(maxsize=1)
def _installed() -> tuple[str, ...]:
    """The folders of Python itself and of installed packages."""
    paths = sysconfig.get_paths()
    folders = {paths[name] for name in ("stdlib", "platstdlib", "purelib", "platlib")}
    folders |= {path for path in sys.path if path.endswith(("site-packages", "dist-packages"))}
    return tuple(os.path.join(os.path.abspath(folder), "") for folder in folders)


def own_functions(
    namespace: Mapping[str, Any], files: frozenset[str] | set[str]
) -> tuple[FunctionType, ...]:
    """The functions that can be reached from a namespace, if their code is of these files.

    Found as globals, in classes, behind decorators, in partials, tables and closures. Functions
    that are defined within others are part of their code (see :func:`codes_of`).

    Args:
        namespace: Globals of a module.
        files: ``co_filename`` of the code that counts.
    """
    found: dict[int, FunctionType] = {}
    seen: set[int] = set()
    waiting = list(namespace.values())
    while waiting:
        value = waiting.pop()
        if id(value) in seen:
            continue
        seen.add(id(value))
        if type(value) is FunctionType and value.__code__.co_filename in files:
            found[id(value)] = value
        waiting.extend(_within(value))
    return tuple(found.values())


def _within(value: Any) -> Iterator[Any]:
    """What may hold further functions in a value."""
    kind = type(value)
    if kind is FunctionType:
        if "__wrapped__" in vars(value):
            yield vars(value)["__wrapped__"]
        for cell in value.__closure__ or ():
            try:
                held = cell.cell_contents
            except ValueError:  # not assigned yet
                continue
            if type(held) in (FunctionType, MethodType, functools.partial, *_CONTAINERS):
                yield held
    elif kind is MethodType:
        yield value.__func__
    elif kind is functools.partial:
        yield value.func
    elif kind in (staticmethod, classmethod):
        yield value.__func__
    elif kind is property:
        yield from (value.fget, value.fset)
    elif kind in _CONTAINERS and len(value) <= _LONGEST:
        yield from value.values() if kind is dict else value
    elif _is_class(value) and not _module_name(value).startswith("opentrons"):
        with suppress(Exception):  # a metaclass that does not tell
            yield from list(vars(value).values())


def codes_of(code: CodeType) -> Iterator[CodeType]:
    """A function's code and that of all functions within it, in the order of the text.

    Comprehensions and lambdas are left out: they bind no names that tell of a well's use.
    """
    if not code.co_name.startswith("<"):
        yield code
    for inner in code.co_consts:
        if inspect.iscode(inner):
            yield from codes_of(inner)
