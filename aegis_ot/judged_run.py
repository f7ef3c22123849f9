"""Layer 1 around a run: on a robot before anything moves, in a simulation at the run's end."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from .adapters.opentrons.instrumentation import NameCollector, tapped
from .errors import (
    AegisError,
    ConfigurationError,
    ProtocolRejected,
    RehearsalError,
    RehearsalTimeout,
    RuleError,
)
from .known_tips import KnownTips
from .settings import Settings
from .vocabulary import one_line

if TYPE_CHECKING:
    from .adapters.opentrons.rehearsal import Recording
    from .guarding import Layer1


_GUARDS: weakref.WeakKeyDictionary[Any, int] = weakref.WeakKeyDictionary()
"""How many guards a run has had so far, one after another."""


def rehearse_by_running(
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


def judge_before_run(
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
        from .model_opinion import with_opinion

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


def _announce_result(protocol: Any, settings: Settings, text: str) -> None:
    """Before the first move, where a run goes on whatever Layer 1 says. In analysis likewise."""
    if settings.rules == "warn":
        protocol.comment(f"aegis_ot: {one_line(text, 4000)}")
