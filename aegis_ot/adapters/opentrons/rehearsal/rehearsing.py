"""Runs a protocol in Opentrons' own simulator, with listeners on every instrument.

The rehearsal executes the protocol's *text* afresh, in a namespace of its own, as Opentrons
does on every load: nothing that the live protocol has at module level is touched by it.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import partial
from typing import Any

from ....errors import AegisError, RehearsalError
from ..instrumentation import Listener, NameCollector, tapped
from .interruption import interrupted_after
from .loading import load
from .parameters import Limit, copied_parameters, lacking_files, plain_values, runtime_parameters
from .recording import Recorder, Recording
from .refusals import refuse_unexecuted, stopped
from .run_plan import RunPlan
from .script import Script
from .short_stops import short_stops_told
from .simulated_context import simulated_context
from .virtual_time import builtins_in_virtual_time

Run = Callable[[Any], Any]


class Rehearsal:
    """One that is under way, as the guards in its protocol see it.

    Args:
        recorder: Of all that is done.
        listeners: Those that want to know where the run's guard begins and ends.
    """

    def __init__(self, recorder: Recorder, listeners: Sequence[Listener]) -> None:
        self._recorder = recorder
        self._plans = [one for one in listeners if isinstance(one, RunPlan)]
        self._first: Mapping[str, Any] | None = None

    def guarded(
        self,
        settings: Mapping[str, Any],
        refuse_second: Callable[[Mapping[str, Any], Mapping[str, Any]], None],
        call: Callable[[], Any] | None = None,
    ) -> Any:
        """Call what a guard is around, which has nothing else to do here; without ``call``, a
        guard of the rest of the protocol.

        Args:
            settings: What the guard was given.
            refuse_second: Given what the first guard was told and what one inside it is told.
        """
        if self._first is not None:
            refuse_second(self._first, settings)
            return call() if call is not None else None
        self._first = settings
        for plan in self._plans:
            plan.guard_began(len(self._recorder.log))
        if call is None:
            return None
        try:
            return call()
        finally:
            self._first = None
            for plan in self._plans:
                plan.guard_ended()


_REHEARSING: ContextVar[Rehearsal | None] = ContextVar("aegis_ot_rehearsing", default=None)
"""Found by its name where a wrapped protocol carries another copy of this module."""


def rehearsal_under_way() -> Rehearsal | None:
    """The rehearsal inside which the caller runs, if it does."""
    return _REHEARSING.get()


def record(
    script: Script,
    listeners: Sequence[Listener] = (),
    *,
    live_parameters: Any = None,
    timeout_s: float = 120.0,
    is_stopping: Callable[[], bool] = lambda: False,
    look: Callable[[Any], None] = lambda context: None,
) -> Recording:
    """Run ``script`` in the simulator from its first line to its last, and write down what it does.

    Args:
        script: The protocol.
        listeners: Hear of every operation and event as well.
        live_parameters: The ``Parameters`` object of a live run; a copy is used.
        timeout_s: After this long the protocol is interrupted.
        is_stopping: Asked every 0.1 s whether the live run is being stopped meanwhile.
        look: Given the simulated ``ProtocolContext`` once the protocol has ended in it.

    Raises:
        RehearsalError: It cannot be parsed, raised by itself, or was stopped; with its line.
        RehearsalTimeout: It did not end in time.
    """
    protocol = load(script)
    recorder = Recorder()
    limit = partial(interrupted_after, timeout_s, script.file_name, is_stopping)
    token = _REHEARSING.set(Rehearsal(recorder, listeners))
    try:
        with (
            _chance_kept(),
            _stage(protocol, script, live_parameters, limit) as context,
            tapped(context, [recorder, *listeners], script.file_name) as tap,
            short_stops_told(context, recorder, tap),
        ):
            names = NameCollector(tap.wells, tap.stack, script.file_name)
            namespace = {"__builtins__": builtins_in_virtual_time()}
            with names.watching(namespace):
                _perform(protocol, context, limit, namespace)
            look(context)
            return Recording(
                script.text,
                script.file_name,
                recorder.log,
                dict(tap.wells.labware),
                names.bindings,
                plain_values(context._params),
            )
    finally:
        _REHEARSING.reset(token)


def play(script: Script, wrap: Callable[[Run], Run], *, timeout_s: float = 3600.0) -> None:
    """Run ``script`` in the simulator with ``wrap`` around its ``run``, as no rehearsal.

    A guard in it does its work. Used to try a protocol with both layers on one machine.

    Raises:
        RehearsalError: It cannot be parsed or raised by itself; with its line.
        AegisError: Whatever ``wrap`` raises on purpose, unchanged.
    """
    protocol = load(script)
    limit = partial(interrupted_after, timeout_s, script.file_name)
    with _stage(protocol, script, None, limit) as context:
        _perform(protocol, context, limit, {}, wrap)


@contextmanager
def _chance_kept() -> Iterator[None]:
    """The live protocol draws what it would without a rehearsal, and this draws the same."""
    numbers = sys.modules.get("numpy.random")  # the protocol's own affair; never imported here
    drawn = random.getstate(), numbers and numbers.get_state()
    try:
        yield
    finally:
        random.setstate(drawn[0])
        if numbers:
            numbers.set_state(drawn[1])


@contextmanager
def _stage(protocol: Any, script: Script, live_parameters: Any, limit: Limit) -> Iterator[Any]:
    """A simulated context that is ready for this protocol."""
    if live_parameters is None:
        parameters = runtime_parameters(protocol, script, limit)
    else:
        parameters = copied_parameters(live_parameters)
    with simulated_context(
        protocol.api_level,
        protocol.robot_type,
        extra_labware=protocol.extra_labware,
        bundled_data=protocol.bundled_data,
    ) as context:
        if parameters:
            context._params = parameters
        yield context


def _perform(
    protocol: Any,
    context: Any,
    limit: Limit,
    namespace: dict[str, Any],
    wrap: Callable[[Run], Run] = lambda run: run,
) -> None:
    """Execute a loaded protocol in ``namespace``, and its ``run``.

    Called so, with these names, for :func:`~.script.find_script` to find what it executes.
    """
    file_name = protocol.filename
    try:
        with limit():
            exec(protocol.contents, namespace)
            run = namespace.get("run")
            if not callable(run):
                raise RehearsalError(f"{file_name} defines no function run(protocol).")
            refuse_unexecuted(wrap(run)(context), file_name)
    except AegisError:
        raise
    except Exception as error:
        lacking = lacking_files(context)
        raise stopped(error, file_name, namespace.get("run"), lacking, protocol.text) from error
