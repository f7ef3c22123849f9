"""``guard``: the whole public face of the robot half.

Opentrons executes a protocol's text twice per load, once on the event loop of the robot server,
so nothing here does I/O or raises at decoration: settings are read, and wrong ones reported,
when ``run`` is called.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from types import FrameType
from typing import Any, TypeVar, overload

Run = TypeVar("Run", bound=Callable[..., Any])
Context = TypeVar("Context")

_MARK = "__aegis_guard__"


@overload
def guard(target: Run, /, **settings: Any) -> Run: ...
@overload
def guard(target: None = None, /, **settings: Any) -> Callable[[Run], Run]: ...
def guard(target: Any = None, /, *nameless: Any, **settings: Any) -> Any:
    """Guard a protocol.

    Four forms::

        @guard
        def run(protocol): ...

        @guard(assay="pcr", sidecar="http://192.168.1.20:7645", on_fail="pause")
        def run(protocol): ...

        def run(protocol):
            protocol = guard(protocol)
            ...

        with guard(protocol):  # in a notebook's cell, or at the top level of a program
            ...

    Args:
        target: The ``run`` function, or the ``ProtocolContext`` inside it.
        *nameless: Nothing belongs here. What stands here by mistake is reported inside ``run``.
        **settings: See :class:`aegis_ot.settings.Settings`; each can also come from an
            environment variable or a file.

    Returns:
        A function with the same signature, or the very same context.

    Raises:
        ConfigurationError: Inside ``run``: a setting cannot be used.
        ProtocolRejected: Inside ``run``: Layer 1 found errors. On a robot no tip has moved.
        RunAborted: Inside ``run``: Layer 2 ended the run, as configured.
    """
    if _is_context(target):
        return _guard_context(target, settings, nameless, sys._getframe(1))
    if callable(target):
        return _decorate(target, settings, nameless)
    if target is not None:  # @guard("pcr")
        nameless = (target, *nameless)
    return functools.partial(_decorate, settings=settings, nameless=nameless)


def _is_context(target: Any) -> bool:
    return hasattr(target, "load_instrument") and hasattr(target, "_core")


def _decorate(function: Any, settings: dict[str, Any], nameless: tuple[Any, ...]) -> Any:
    inner, inner_settings = getattr(function, _MARK, (function, {}))
    if getattr(function, "__wrapped__", None) is not inner:
        # Another decorator stands in between, and functools.wraps gave it a copy of the mark.
        inner, inner_settings = function, {}
    merged = {**inner_settings, **settings}

    @functools.wraps(inner)
    def run(protocol: Any, *args: Any, **kwargs: Any) -> Any:
        from .guarded_run import run_guarded

        _refuse(nameless)
        return run_guarded(lambda: inner(protocol, *args, **kwargs), protocol, merged, inner)

    setattr(run, _MARK, (inner, merged))
    return run


def _refuse(nameless: tuple[Any, ...]) -> None:
    if nameless:
        from .errors import ConfigurationError

        shown = ", ".join("a text" if isinstance(x, str) else repr(x)[:80] for x in nameless)
        raise ConfigurationError(
            f"guard() was given {shown} without a name. Settings have names: "
            '@guard(assay="pcr"), or guard(protocol, assay="pcr").'
        )


def _guard_context(
    protocol: Any, settings: dict[str, Any], nameless: tuple[Any, ...], caller: FrameType
) -> Any:
    from .guarded_run import guard_rest_of

    _refuse(nameless)
    guard_rest_of(caller, protocol, settings)
    return protocol
