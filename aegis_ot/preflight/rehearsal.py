"""Runs a protocol in Opentrons' own simulator, with listeners on every instrument.

The rehearsal executes the protocol's *text* afresh, in a namespace of its own, as Opentrons
does on every load: nothing that the live protocol has at module level is touched by it.
"""

from __future__ import annotations

import ctypes
import threading
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

from ..errors import RehearsalError, RehearsalTimeout
from ..instrumentation import LabwareInfo, Listener, NameBinding, NameCollector, tapped
from .script import Script
from .simulated_context import simulated_context

_REHEARSING: ContextVar[bool] = ContextVar("aegis_ot_rehearsing", default=False)


def is_rehearsing() -> bool:
    """Whether the caller runs inside a rehearsal, where a guard has nothing to do."""
    return _REHEARSING.get()


@dataclass(frozen=True)
class Rehearsal:
    """What a rehearsal yields besides what its listeners heard.

    Attributes:
        names: Names that held wells.
        labware: Every labware of the run, by key.
        robot_type: ``"OT-2 Standard"`` or ``"OT-3 Standard"``.
        api_level: ``"2.15"``.
    """

    names: tuple[NameBinding, ...]
    labware: Mapping[str, LabwareInfo]
    robot_type: str
    api_level: str


def rehearse(
    script: Script,
    listeners: Sequence[Listener],
    *,
    live_parameters: Any = None,
    timeout_s: float = 120.0,
) -> Rehearsal:
    """Run ``script`` in the simulator from its first line to its last.

    Args:
        script: The protocol.
        listeners: Hear of every operation and event.
        live_parameters: The ``Parameters`` object of a live run, used as it is.
        timeout_s: After this long the protocol is interrupted.

    Raises:
        RehearsalError: It cannot be parsed or raised by itself; with its line.
        RehearsalTimeout: It did not end in time.
    """
    protocol = _parse(script)
    parameters = live_parameters
    if parameters is None:
        parameters = _parameters(protocol, script)
    token = _REHEARSING.set(True)
    try:
        with (
            simulated_context(
                protocol.api_level,
                protocol.robot_type,
                extra_labware=protocol.extra_labware,
                bundled_labware=protocol.bundled_labware,
                bundled_data=protocol.bundled_data,
            ) as context,
            tapped(context, listeners, script.file_name) as tap,
        ):
            names = NameCollector(tap.wells, script.file_name)
            _execute(protocol, context, parameters, names, script.file_name, timeout_s)
            return Rehearsal(
                names.bindings,
                dict(tap.wells.labware),
                protocol.robot_type,
                str(protocol.api_level),
            )
    finally:
        _REHEARSING.reset(token)


def _parse(script: Script) -> Any:
    from opentrons.protocols.parse import parse
    from opentrons.protocols.types import ApiDeprecationError, PythonProtocol

    try:
        compile(script.text, script.file_name, "exec", dont_inherit=True)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        reason = getattr(error, "msg", None) or str(error)
        where = f"{script.file_name}, line {line}" if line else script.file_name
        raise RehearsalError(f"{where}: not valid Python: {reason}", line) from error
    try:
        protocol = parse(
            script.text,
            script.file_name,
            extra_labware=dict(script.extra_labware),
            extra_data=dict(script.data_files),
        )
    except ApiDeprecationError as error:
        raise RehearsalError(
            f"{script.file_name} uses an apiLevel that this opentrons no longer runs: {error}"
        ) from error
    except Exception as error:  # opentrons raises its own zoo, and plain RuntimeErrors
        raise RehearsalError(f"Opentrons cannot load {script.file_name}: {error}") from error
    if not isinstance(protocol, PythonProtocol):
        raise RehearsalError(
            f"{script.file_name} is a JSON protocol; only Python protocols can be rehearsed."
        )
    return protocol


def _parameters(protocol: Any, script: Script) -> Any:
    from opentrons.protocol_api._parameter_context import ParameterContext
    from opentrons.protocols.execution.execute_python import exec_add_parameters

    known = dict(script.parameters)
    try:
        return exec_add_parameters(
            protocol,
            ParameterContext(api_version=protocol.api_level),
            known or None,
            dict(script.csv_parameters) or None,
        )
    except Exception as error:
        raise RehearsalError(
            f"The runtime parameters of {script.file_name} cannot be set: {error}",
            _line_of(error, script.file_name),
        ) from error


def _execute(
    protocol: Any,
    context: Any,
    parameters: Any,
    names: NameCollector,
    file_name: str,
    timeout_s: float,
) -> None:
    namespace: dict[str, Any] = {}
    if parameters:
        context._params = parameters
    try:
        with _interrupted_after(timeout_s, file_name):
            exec(protocol.contents, namespace)
            run = namespace.get("run")
            if not callable(run):
                raise RehearsalError(f"{file_name} defines no function run(protocol).")
            with names.watching():
                run(context)
    except RehearsalError:
        raise
    except Exception as error:
        line = _line_of(error, file_name)
        where = f"{file_name}, line {line}" if line else file_name
        raise RehearsalError(f"{where}: {type(error).__name__}: {error}", line) from error
    finally:
        names.look(namespace, "<module>", 1)


def _line_of(error: BaseException, file_name: str) -> int | None:
    """The innermost line of the protocol in a traceback."""
    seen: BaseException | None = error
    while seen is not None:
        for entry in reversed(traceback.extract_tb(seen.__traceback__)):
            if entry.filename == file_name:
                return entry.lineno
        seen = seen.__cause__
    return getattr(error, "lineno", None)


@contextmanager
def _interrupted_after(timeout_s: float, file_name: str) -> Iterator[None]:
    """Raise :class:`RehearsalTimeout` in this thread after ``timeout_s`` seconds.

    An endless loop in plain Python never comes back to a listener, so it is interrupted from a
    timer thread. A call that blocks inside C code is interrupted when it returns.
    """
    thread = threading.get_ident()
    lock = threading.Lock()
    state = {"open": True, "fired": False}

    def interrupt() -> None:
        with lock:
            if state["open"]:
                state["fired"] = True
                ctypes.pythonapi.PyThreadState_SetAsyncExc(
                    ctypes.c_ulong(thread), ctypes.py_object(_Interrupted)
                )

    timer = threading.Timer(timeout_s, interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    except _Interrupted as error:
        raise RehearsalTimeout(
            f"{file_name} did not end within {timeout_s:g} s of rehearsal.",
            _line_of(error, file_name),
        ) from None
    finally:
        with lock:
            state["open"] = False
        timer.cancel()


class _Interrupted(BaseException):
    """Not an ``Exception``, so that a protocol's own ``except Exception`` lets it pass."""
