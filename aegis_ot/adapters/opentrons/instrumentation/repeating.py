"""Does an operation of a protocol again.

An engine core (apiLevel 2.14 and newer) makes each of its calls a command of the run, so the very
same call is made once more. A legacy core tells nobody what it does; there the instrument context
announces the commands, so the call goes through it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .operation import Operation

Arguments = Mapping[str, Any]


def _touch(context: type, instrument: Any, a: Arguments) -> None:
    well = a["location"].labware.as_well()
    context.touch_tip(instrument, well, a["radius"], a["z_offset"], a["speed"])  # type: ignore[attr-defined]


_IN_CONTEXT: Mapping[str, Callable[[Any, Any, Arguments], Any]] = {
    "aspirate": lambda c, i, a: c.aspirate(i, a["volume"], a["location"], a["rate"]),
    "dispense": lambda c, i, a: c.dispense(i, a["volume"], a["location"], a["rate"]),
    "blow_out": lambda c, i, a: c.blow_out(i, a["location"]),
    "move_to": lambda c, i, a: c.move_to(i, a["location"], speed=a.get("speed")),
    "touch_tip": _touch,
}


def is_repeatable(operation: Operation) -> bool:
    """Whether :func:`repeated` knows how."""
    core = operation.core()
    return bool(operation.method) and (_has_engine(core) or operation.method in _IN_CONTEXT)


def repeated(instrument: Any, operation: Operation, volume: float | None) -> None:
    """Call the core, or the context, as ``operation`` did, with another ``volume`` if there is one.

    Args:
        instrument: The ``InstrumentContext`` that did it.
        operation: What it did.
        volume: µL.
    """
    arguments = dict(operation.arguments)
    if volume is not None:
        arguments["volume"] = volume
    core = instrument._core
    if _has_engine(core):
        if operation.is_air and operation.well is None and not core.get_current_volume():
            # Air drawn in place by an empty tip: whoever did that had prepared the plunger first,
            # which no listener hears.
            core.prepare_to_aspirate()
        getattr(core, operation.method)(**arguments)
    else:
        # The class's own: a protocol may have put another method in front on its instance.
        _IN_CONTEXT[operation.method](type(instrument), instrument, arguments)


def _has_engine(core: Any) -> bool:
    return hasattr(core, "_engine_client")
