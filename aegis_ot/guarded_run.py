"""What the guard does around a protocol's ``run``.

In analysis and simulation the run itself is the rehearsal: it is recorded, judged at its end,
and rejected there. On a robot the protocol is rehearsed and judged first, before anything
moves; then it runs with the watcher on its instruments.
"""

from __future__ import annotations

import sys
import weakref
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from contextvars import ContextVar
from types import FrameType
from typing import TYPE_CHECKING, Any, NamedTuple

from .errors import AegisError, ProtocolRejected, RehearsalError
from .instrumentation import NameCollector, Tap, tapped
from .known_tips import KnownTips, heard_by, recovers_by_itself
from .protocol_frames import at_return_of, line_of, make_final, outermost, raise_in_protocol
from .settings import Settings, load_settings

if TYPE_CHECKING:
    from .preflight.judging import Report
    from .preflight.rehearsal import Recording
    from .runtime import Watcher


class _Layer1(NamedTuple):
    """What Layer 1 says: a line for the run log, and the report where there is one."""

    text: str
    report: Report | None = None


# Which context is guarded, and not merely that one is: a robot server runs the next protocol
# in a thread of the same pool, and a mark left there must not leave that one unguarded.
_GUARDED: ContextVar[weakref.ref[Any] | None] = ContextVar("aegis_ot_guarded", default=None)


def _is_guarded(protocol: Any) -> bool:
    guarded = _GUARDED.get()
    return guarded is not None and guarded() is protocol


def run_guarded(call: Callable[[], Any], protocol: Any, keywords: dict[str, Any], run: Any) -> Any:
    """Call ``call()``, which runs the user's protocol, with both layers around it.

    Args:
        call: The user's ``run``, bound to its context.
        protocol: The context.
        keywords: The guard's keyword arguments.
        run: What the user decorated.
    """
    from .preflight.rehearsal import find_home, is_rehearsing

    if is_rehearsing() or _is_guarded(protocol):
        return call()
    file_name, module = find_home(run)
    token = _GUARDED.set(weakref.ref(protocol))
    try:
        settings = load_settings(**keywords)
        _announce(protocol, settings)
        recovers = recovers_by_itself(protocol, settings)
        if protocol.is_simulating() and not recovers:
            return _rehearse_by_running(call, protocol, settings, file_name, module)
        tips = KnownTips() if recovers else None
        layer1 = _preflight(protocol, settings, file_name, tips)
        return _watched(call, protocol, settings, file_name, layer1, tips)
    except AegisError as error:
        make_final(error, protocol, file_name, sys._getframe(1))
        raise_in_protocol(error, file_name, line_of(run))
        raise
    finally:
        _GUARDED.reset(token)


def guard_rest_of(frame: FrameType, protocol: Any, keywords: dict[str, Any]) -> None:
    """Guard what is left of the protocol function that calls from ``frame``.

    Used for ``protocol = guard(protocol)``. There is no call to wrap, so the protocol is
    rehearsed here, in simulation too, and the end of the run is seen by a profile hook on the
    return of the protocol's outermost function.
    """
    from .preflight.rehearsal import find_home, is_rehearsing

    if is_rehearsing() or _is_guarded(protocol):
        return
    file_name, _ = find_home(frame)
    try:
        settings = load_settings(**keywords)
        _announce(protocol, settings)
        tips = KnownTips() if recovers_by_itself(protocol, settings) else None
        layer1 = _preflight(protocol, settings, file_name, tips)
        watcher = _new_watcher(protocol, settings, file_name, layer1, tips)
        with ExitStack() as beginning:
            beginning.callback(_GUARDED.reset, _GUARDED.set(weakref.ref(protocol)))
            if watcher is not None:
                tap = Tap(protocol, heard_by(watcher, tips), file_name)
                watcher.begin(tap)
                beginning.callback(tap.remove)
                tap.install()
            ending = beginning.pop_all()
    except AegisError as error:
        make_final(error, protocol, file_name, frame)
        raise_in_protocol(error, file_name, frame.f_lineno)
        raise
    run = outermost(frame, file_name) or frame
    at_return_of(run, lambda by_itself: _end(by_itself, protocol, layer1, watcher, ending))


def _announce(protocol: Any, settings: Settings) -> None:
    """What goes on before the first move, which can take a while on a robot.

    In analysis too: the Opentrons App compares the commands of both.
    """
    if settings.rules != "off":
        protocol.comment("aegis_ot: Layer 1 rehearses the protocol; then the run begins.")


def _rehearse_by_running(
    call: Callable[[], Any],
    protocol: Any,
    settings: Settings,
    file_name: str,
    module: Mapping[str, Any],
) -> Any:
    from .preflight.rehearsal import Recorder, Recording, plain_values

    recorder = Recorder() if settings.rules != "off" else None
    watcher = _new_watcher(protocol, settings, file_name)
    listeners = [listener for listener in (recorder, watcher) if listener is not None]
    if not listeners:
        return call()
    with tapped(protocol, listeners, file_name) as tap:
        if recorder is None:
            result = _call_watched(call, watcher, tap)
            _say(protocol, _Layer1(""), watcher)
            return result
        names = NameCollector(tap.wells, tap.stack, file_name)
        with names.watching(module):
            result = _call_watched(call, watcher, tap)
    text = _text_of(file_name, protocol)
    values = plain_values(getattr(protocol, "_params", None))
    recording = Recording(file_name, text, recorder.log, recorder.labware, names.bindings, values)
    layer1 = _judge(recording, protocol, settings)
    _say(protocol, layer1, watcher)
    return result


def _preflight(
    protocol: Any, settings: Settings, file_name: str, tips: KnownTips | None = None
) -> _Layer1:
    """Rehearse and judge before anything moves; what there is to say of it."""
    if settings.rules == "off" and tips is None:
        return _Layer1("")
    from .preflight.rehearsal import find_script, record
    from .runtime.runstate import RunState

    script = find_script(file_name, protocol)
    if script is None:
        return _Layer1("Layer 1 could not find the protocol's text, so it was not checked.")
    state = RunState(protocol)
    try:
        recording = record(
            script,
            [] if tips is None else [tips.forecast],
            # The property is refused below apiLevel 2.18.
            live_parameters=getattr(protocol, "_params", None),
            timeout_s=settings.rehearsal_timeout_s,
            is_stopping=lambda: state.stopping,
        )
    except RehearsalError as error:
        # A protocol that fails by itself fails with its own error; that is not the guard's to
        # change.
        return _Layer1(f"Layer 1 could not rehearse the protocol: {error}")
    except AegisError:
        raise
    except Exception as error:  # as in _judge
        return _failed(error)
    if tips is not None:
        tips.forecast.complete = True
    return _judge(recording, protocol, settings) if settings.rules != "off" else _Layer1("")


def _watched(
    call: Callable[[], Any],
    protocol: Any,
    settings: Settings,
    file_name: str,
    layer1: _Layer1,
    tips: KnownTips | None,
) -> Any:
    watcher = _new_watcher(protocol, settings, file_name, layer1, tips)
    if watcher is None:
        result = call()
    else:
        with tapped(protocol, heard_by(watcher, tips), file_name) as tap:
            result = _call_watched(call, watcher, tap)
    _say(protocol, layer1, watcher)
    return result


def _call_watched(call: Callable[[], Any], watcher: Watcher | None, tap: Tap) -> Any:
    if watcher is None:
        return call()
    watcher.begin(tap)
    try:
        result = call()
    except BaseException as error:
        watcher.end(error)
        raise
    watcher.end(None)
    return result


def _end(
    by_itself: bool, protocol: Any, layer1: _Layer1, watcher: Watcher | None, ending: ExitStack
) -> None:
    try:
        if watcher is not None:
            error = None if by_itself else RuntimeError()
            watcher.end(error, "The protocol raised an error; the robot's run log has it.")
    finally:
        ending.close()
    if by_itself:
        _say(protocol, layer1, watcher)


def _new_watcher(
    protocol: Any,
    settings: Settings,
    file_name: str,
    layer1: _Layer1 | None = None,
    tips: KnownTips | None = None,
) -> Watcher | None:
    """Layer 2, where a sidecar is configured.

    In an analysis it only moves as it will in the live run, so that both show the Opentrons App
    the same sequence of commands.
    """
    if settings.sidecar is None:
        return None
    from .runtime import Watcher

    knowledge = None if tips is None else tips.knowledge
    report = layer1.report if layer1 else None
    text = _text_of(file_name, protocol)
    return Watcher(protocol, settings, file_name, report, knowledge, text)


def _text_of(file_name: str, protocol: Any) -> str:
    """The source of the protocol that is running, ``""`` where it cannot be had."""
    from .preflight.rehearsal import find_script

    script = find_script(file_name, protocol)
    return script.text if script is not None else ""


def _judge(recording: Recording, protocol: Any, settings: Settings) -> _Layer1:
    """Layer 1's report and its summary.

    Raises:
        ProtocolRejected: It found errors, and ``rules`` is ``"on"`` or ``"strict"``.
    """
    from .preflight.check_protocol import errors_of, read_for_guard, rejection, summary
    from .preflight.judging import judge, uncollected

    try:
        with uncollected():
            reading = read_for_guard(recording, settings)
            report = judge(reading)
        if settings.opinion == "ask":
            from .preflight.asking import with_opinion

            report = with_opinion(report, reading, settings, protocol)
    except AegisError:
        raise
    except Exception as error:  # a fault of ours must not keep a good protocol from running
        return _failed(error)
    errors = errors_of(report)
    if settings.rules in ("on", "strict") and errors:
        line = next((line for finding in errors for line in finding.lines), None)
        raise ProtocolRejected(rejection(report), line)
    return _Layer1(summary(report), report)


def _failed(error: Exception) -> _Layer1:
    return _Layer1(f"Layer 1 failed and judged nothing ({type(error).__name__}: {error}).")


def _say(protocol: Any, layer1: _Layer1, watcher: Watcher | None) -> None:
    """One closing comment in analysis and live alike."""
    parts = [layer1.text] if layer1.text else []
    if watcher is not None:
        parts.append(watcher.summary())
    if parts:
        protocol.comment(f"aegis_ot: {' '.join(parts)}")
