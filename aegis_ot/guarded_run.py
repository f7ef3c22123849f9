"""What the guard does around a protocol's ``run``: Layer 1 first, then the watcher on its
instruments, whether the whole function is guarded or what is left of one.
"""

from __future__ import annotations

import sys
import weakref
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import FrameType
from typing import Any

from .adapters.opentrons.protocol_frames import (
    at_return_of,
    line_of,
    make_final,
    outermost,
    raise_in_protocol,
)
from .errors import AegisError, ConfigurationError
from .judged_run import judge_before_run, rehearse_by_running
from .known_tips import KnownTips, recovers_by_itself
from .settings import Settings, load_settings

_GUARDED: weakref.WeakKeyDictionary[Any, Mapping[str, Any]] = weakref.WeakKeyDictionary()
"""The contexts under guard, and what their guards were told: a notebook's cells share no other
place, and a robot server runs the next protocol in the same thread."""


def is_guarded(protocol: Any) -> bool:
    """Whether this context stands under a guard already."""
    return protocol in _GUARDED


def run_guarded(call: Callable[[], Any], protocol: Any, keywords: dict[str, Any], run: Any) -> Any:
    """Call ``call()``, which runs the user's protocol, with both layers around it.

    Args:
        call: The user's ``run``, bound to its context.
        protocol: The context.
        keywords: The guard's keyword arguments.
        run: What the user decorated.
    """
    from .adapters.opentrons.rehearsal import find_home, rehearsal_under_way
    from .guarding import Guarding

    if (rehearsal := rehearsal_under_way()) is not None:
        return rehearsal.guarded(keywords, _refuse_second, call)
    file_name, module = find_home(run)
    is_first = False
    try:
        if (first := _GUARDED.get(protocol)) is not None:
            _refuse_second(first, keywords)
            return call()
        is_first = True
        _GUARDED[protocol] = keywords
        settings = load_settings(**keywords)
        _announce(protocol, settings)
        recovers = recovers_by_itself(protocol, settings)
        if protocol.is_simulating() and not recovers:
            return rehearse_by_running(call, protocol, settings, file_name, module)
        tips = KnownTips() if recovers else None
        layer1 = judge_before_run(protocol, settings, file_name, tips)
        guarding = Guarding(protocol, settings, file_name, module, layer1, tips)
        with guarding:
            result = call()
        guarding.say()
        return result
    except AegisError as error:
        make_final(error, protocol, file_name, sys._getframe(1))
        raise_in_protocol(error, file_name, line_of(run))
        raise
    finally:
        if is_first:
            _GUARDED.pop(protocol, None)


def guard_rest_of(frame: FrameType, protocol: Any, keywords: dict[str, Any]) -> None:
    """Guard what is left of the protocol function that calls from ``frame``.

    Used for ``protocol = guard(protocol)``. There is no call to wrap, so the protocol is
    rehearsed here, in simulation too, and the end of the run is seen by a hook on the return of the
    protocol's outermost function. At the top level of a notebook's cell or of a program there is no
    function: nothing can be rehearsed, and the guard ends with the cell or the program, or with the
    ``with`` that takes it over.
    """
    from .adapters.opentrons.rehearsal import find_home, rehearsal_under_way
    from .guard_block import GuardBlock, is_head_of_block, offer, offer_again
    from .guarding import Guarding, Layer1, place_of, tell_of_nothing, tell_what_is_covered

    if (rehearsal := rehearsal_under_way()) is not None:
        rehearsal.guarded(keywords, _refuse_second)
        offer(protocol, None)
        return
    file_name, module = find_home(frame)
    run = outermost(frame, file_name)
    try:
        if (first := _GUARDED.get(protocol)) is not None:
            _refuse_second(first, keywords)
            if run is None:
                offer_again(protocol, frame)
            else:
                offer(protocol, None)
            return
        settings = load_settings(**keywords)
        if run is None:
            place = "block" if is_head_of_block(frame) else place_of(file_name)
            tell_what_is_covered(protocol, settings, place)
            layer1 = Layer1.none("At the top level there is no run() to rehearse.", settings)
            tips = None
        else:
            _announce(protocol, settings)
            tips = KnownTips() if recovers_by_itself(protocol, settings) else None
            layer1 = judge_before_run(protocol, settings, file_name, tips)
        guarding = Guarding(protocol, settings, file_name, module, layer1, tips)
        _GUARDED[protocol] = keywords
        with ExitStack() as beginning:
            beginning.callback(_GUARDED.pop, protocol, None)
            guarding.begin()
            ending = beginning.pop_all()
    except AegisError as error:
        make_final(error, protocol, file_name, frame)
        raise_in_protocol(error, file_name, frame.f_lineno)
        raise

    def end(error: BaseException | None, place: str) -> None:
        told = "" if run is None else "The protocol raised an error; the robot's run log has it."
        if run is None and error is None and not guarding.moved:
            told = tell_of_nothing(protocol, place)
            error = RuntimeError(told)
        try:
            guarding.end(error, told)
        finally:
            ending.close()
        if error is None:
            guarding.say()

    if run is None:

        def tell(again: bool) -> None:
            if place != "block":
                tell_what_is_covered(protocol, settings, "again" if again else "stack")

        offer(protocol, GuardBlock(end, tell, place_of(file_name), frame))
    else:
        offer(protocol, None)
        at_return_of(run, lambda well: end(None if well else RuntimeError(), "protocol"))


def _refuse_second(first: Mapping[str, Any], second: Mapping[str, Any]) -> None:
    """Refuse what a guard inside a guard is told otherwise: it would never count.

    Raises:
        ConfigurationError: Naming the settings.
    """
    if not second:
        return
    before, now = load_settings(**first), load_settings(**{**first, **second})
    changed = [name for name in second if getattr(before, name) != getattr(now, name)]
    if changed:
        raise ConfigurationError(
            f"This protocol is guarded already, and guard() is called again with "
            f"{', '.join(changed)}. A protocol has one guard: write all settings into the first "
            "one, and leave the second out."
        )


def _announce(protocol: Any, settings: Settings) -> None:
    """What goes on before the first move, which can take a while on a robot.

    In analysis too: the Opentrons App compares the commands of both.
    """
    if settings.rules != "off":
        protocol.comment("aegis_ot: Layer 1 rehearses the protocol; then the run begins.")
