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
from types import FrameType
from typing import TYPE_CHECKING, Any

from .adapters.opentrons.instrumentation import NameCollector, tapped
from .adapters.opentrons.protocol_frames import (
    at_return_of,
    line_of,
    make_final,
    outermost,
    raise_in_protocol,
)
from .errors import (
    AegisError,
    ConfigurationError,
    ProtocolRejected,
    RehearsalError,
    RehearsalTimeout,
    RuleError,
)
from .known_tips import KnownTips, recovers_by_itself
from .settings import Settings, load_settings
from .vocabulary import one_line

if TYPE_CHECKING:
    from .adapters.opentrons.rehearsal import Recording
    from .guarding import Layer1


_GUARDED: weakref.WeakKeyDictionary[Any, Mapping[str, Any]] = weakref.WeakKeyDictionary()
"""The contexts under guard, and what their guards were told: a notebook's cells share no other
place, and a robot server runs the next protocol in the same thread."""

_GUARDS: weakref.WeakKeyDictionary[Any, int] = weakref.WeakKeyDictionary()
"""How many guards a run has had so far, one after another."""


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
            return _rehearse_by_running(call, protocol, settings, file_name, module)
        tips = KnownTips() if recovers else None
        layer1 = _preflight(protocol, settings, file_name, tips)
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
            layer1 = _preflight(protocol, settings, file_name, tips)
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


def _announce_result(protocol: Any, settings: Settings, text: str) -> None:
    """Before the first move, where a run goes on whatever Layer 1 says. In analysis likewise."""
    if settings.rules == "warn":
        protocol.comment(f"aegis_ot: {one_line(text, 4000)}")


def _rehearse_by_running(
    call: Callable[[], Any],
    protocol: Any,
    settings: Settings,
    file_name: str,
    module: Mapping[str, Any],
) -> Any:
    """An analysis of a decorated ``run``: it is its own rehearsal."""
    from .adapters.opentrons.rehearsal import Recorder, Recording, plain_values
    from .guarding import call_watched, new_watcher, say, text_of

    _announce_result(protocol, settings, "Layer 1 judges this run at its end.")
    recorder = Recorder() if settings.rules != "off" else None
    watcher = new_watcher(protocol, settings, file_name, module=module)
    listeners = [listener for listener in (recorder, watcher) if listener is not None]
    if not listeners:
        return call()
    with tapped(protocol, listeners, file_name) as tap:
        if recorder is None:
            result = call_watched(call, watcher, tap)
            say(protocol, "", watcher)
            return result
        names = NameCollector(tap.wells, tap.stack, file_name)
        with names.watching(module):
            result = call_watched(call, watcher, tap)
    text = text_of(file_name, protocol)
    values = plain_values(getattr(protocol, "_params", None))
    recording = Recording(text, file_name, recorder.log, recorder.labware, names.bindings, values)
    try:
        layer1 = _judge(recording, protocol, settings)
    except AegisError:
        raise
    except Exception as error:  # whatever a fault of ours may be
        layer1 = _unjudged(error, protocol, settings, file_name)
    say(protocol, layer1.text, watcher)
    return result


def _preflight(
    protocol: Any, settings: Settings, file_name: str, tips: KnownTips | None = None
) -> Layer1:
    """Rehearse and judge before anything moves; what there is to say of it.

    Raises:
        ProtocolRejected: Layer 1 found errors, or could not judge the protocol, and ``rules`` is
            ``"on"`` or ``"strict"``.
    """
    from .adapters.opentrons.rehearsal import RunPlan, find_script, record
    from .adapters.opentrons.run_state import RunState
    from .guarding import Layer1, new_planner

    earlier = _GUARDS.get(protocol, 0)
    _GUARDS[protocol] = earlier + 1
    if settings.rules == "off" and tips is None:
        return Layer1("")
    script = find_script(file_name, protocol)
    if script is None:
        layer1 = Layer1.none("Layer 1 cannot find the protocol's text to rehearse it.", settings)
        _announce_result(protocol, settings, layer1.text)
        return layer1
    state, plan = RunState(protocol), RunPlan(earlier)
    planner = None if settings.sidecar is None else new_planner(plan)
    try:
        listeners = [plan, planner, None if tips is None else tips.forecast]
        recording = record(
            script,
            [one for one in listeners if one is not None],
            # The property is refused below apiLevel 2.18.
            live_parameters=getattr(protocol, "_params", None),
            timeout_s=settings.rehearsal_timeout_s,
            is_stopping=lambda: state.stopping,
        )
        if tips is not None:
            tips.forecast.complete = True
        ahead: Mapping[str, Any] = {}
        if planner is not None:
            planner.finish()
            ahead = planner.about(recording.labware)
        if settings.rules == "off":
            return Layer1("", ahead=ahead)
        layer1 = _judge(recording, protocol, settings)._replace(
            recording=recording, plan=plan, ahead=ahead
        )
    except (ConfigurationError, ProtocolRejected, RuleError):
        raise
    except Exception as error:  # whatever a fault of ours may be
        if settings.rules == "off":
            return Layer1("")
        layer1 = _unjudged(error, protocol, settings, file_name)
    _announce_result(protocol, settings, layer1.text)
    return layer1


def _judge(recording: Recording, protocol: Any, settings: Settings) -> Layer1:
    """Layer 1's report and its summary.

    Raises:
        ProtocolRejected: It found errors, and ``rules`` is ``"on"`` or ``"strict"``.
    """
    from .guarding import Layer1
    from .preflight.check_protocol import errors_of, read_for_guard, rejection, summary
    from .preflight.judging import judge, uncollected
    from .runtime import about_layer1

    with uncollected():
        reading = read_for_guard(recording, settings)
        report = judge(reading)
    if settings.opinion == "ask":
        from .preflight.asking import with_opinion

        report = with_opinion(report, reading, settings, protocol)
    errors = errors_of(report)
    if settings.rules in ("on", "strict") and errors:
        line = next((line for finding in errors for line in finding.lines), None)
        raise _rejected(
            rejection(report), line, about_layer1(report), protocol, settings, recording.file
        )
    return Layer1(summary(report), report)


def _unjudged(error: Exception, protocol: Any, settings: Settings, file_name: str) -> Layer1:
    """What becomes of a run whose rehearsal failed, or of which Layer 1 could make nothing.

    Raises:
        ProtocolRejected: Nobody has judged it, and ``rules`` is ``"on"`` or ``"strict"``.
    """
    from .adapters.opentrons.run_state import RunState
    from .guarding import Layer1

    fails_itself = isinstance(error, RehearsalError) and not isinstance(error, RehearsalTimeout)
    if isinstance(error, RehearsalError):
        why = f"Layer 1 could not rehearse the protocol: {str(error).rstrip('.')}."
    else:
        why = f"Layer 1 failed and judged nothing ({type(error).__name__}: {error})."
    layer1 = Layer1.none(why, settings)
    longer = f"rehearsal_timeout_s={10 * settings.rehearsal_timeout_s:g}"
    is_slow = isinstance(error, RehearsalTimeout)
    # An analysis of a protocol that fails by itself fails with its own error; and what a run that
    # is being stopped raises is Opentrons' to say.
    lets_be = RunState(protocol).stopping or (fails_itself and protocol.is_simulating())
    if settings.rules in ("on", "strict") and not lets_be:
        raise _rejected(
            f"{why} Nobody has judged what it would do, so it does not begin; no tip has moved. "
            + (f"If it only takes long: @guard({longer}). " if is_slow else "")
            + 'To run it all the same: @guard(rules="warn").',
            getattr(error, "line", None),
            layer1.words(),
            protocol,
            settings,
            file_name,
        )
    return layer1


def _rejected(
    text: str,
    line: int | None,
    words: Mapping[str, Any] | None,
    protocol: Any,
    settings: Settings,
    file_name: str,
) -> ProtocolRejected:
    """The error that keeps a run from beginning; the sidecar's page says so too."""
    from .runtime import tell_of_rejection

    tell_of_rejection(protocol, settings, file_name, words, text)
    return ProtocolRejected(text, line)
