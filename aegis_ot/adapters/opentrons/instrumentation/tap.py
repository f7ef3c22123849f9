"""Wraps the instruments of one protocol run, so that listeners hear of every operation.

Each loaded instrument's *core* gets instance attributes in front of its methods; the
``InstrumentContext`` that the protocol holds is untouched, and classes and modules are never
patched, because a robot server may analyse another protocol in the same process meanwhile.
Everything is taken off again when the run ends.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from types import MethodType
from typing import Any

from .calls import CORE_METHODS, CallReader, least_volume
from .callsite import CallSite, ProtocolStack
from .events import EventTap
from .operation import Listener, Operation, PipetteInfo
from .repeating import repeated
from .wells import WellResolver

_MOVES_WHAT_IS_WRITTEN = (2, 17)
"""From this apiLevel on a volume of 0 is none, and what a tip does not hold is refused."""


class Tap:
    """Hears everything that one protocol context does with liquids.

    Args:
        protocol: A ``ProtocolContext`` of any apiLevel.
        listeners: Told of each operation, in order.
        file_name: ``co_filename`` of the protocol's code, to find source lines.
    """

    def __init__(self, protocol: Any, listeners: Sequence[Listener], file_name: str) -> None:
        self._core = protocol._core
        self._listeners = tuple(listeners)
        self.stack = ProtocolStack(file_name)
        self.stack.looks_for_volumes = tuple(protocol.api_version) < _MOVES_WHAT_IS_WRITTEN
        self.wells = WellResolver(self._core)
        self._undo = ExitStack()
        self._readers: dict[str, CallReader] = {}
        self._events = EventTap(self._core, self.wells, self._listeners, self.stack, self._replace)
        self._protocol = protocol
        self._instead: CallSite | None = None

    def listen(self, listeners: Sequence[Listener]) -> None:
        """Tell these instead; before :meth:`install`."""
        self._listeners = tuple(listeners)
        self._events.listeners = self._listeners

    def install(self) -> None:
        """Wrap what is loaded already, and whatever is loaded from now on."""
        self._events.install()
        self._replace(self._core, "load_instrument", self._tapped_load_instrument)
        for instrument in self._protocol.loaded_instruments.values():
            self._tap_instrument(instrument._core)

    def remove(self) -> None:
        """Take everything off again and forget the run. Idempotent."""
        self._undo.close()
        self.stack.close()
        self._readers.clear()

    def lift(self, operation: Operation) -> None:
        """Move straight up (or over) to the top of the operation's first well.

        The robot passes that point anyway: every move between wells rises above the one and
        comes down from above the other. No listener hears of it.
        """
        self._readers[operation.pipette.key].move_above(operation)

    def instrument(self, mount: str) -> Any:
        """The pipette that the protocol loaded on ``"left"`` or ``"right"``."""
        return self._protocol.loaded_instruments[mount]

    def slot_of(self, labware: Any) -> str:
        """Where a labware that the protocol loaded stands; ``""`` off deck."""
        return self.wells.slot(self.wells.register(labware._core).key)

    def repeat(self, operation: Operation, volume: float | None = None) -> None:
        """Do an earlier operation again, as a command of the same pipette.

        Listeners hear of it as they did before, with the source line that first caused it.

        Args:
            operation: Heard by a listener in this run.
            volume: Instead of its own, µL.
        """
        self._instead = CallSite(operation.lines, operation.call, operation.mixing)
        try:
            repeated(self.instrument(operation.pipette.mount), operation, volume)
        finally:
            self._instead = None

    def _tapped_load_instrument(self, original: Callable[..., Any]) -> Callable[..., Any]:
        def load_instrument(core: Any, *args: Any, **kwargs: Any) -> Any:
            instrument_core = original(*args, **kwargs)
            self._tap_instrument(instrument_core)
            return instrument_core

        return load_instrument

    def _tap_instrument(self, core: Any) -> None:
        mount = core.get_mount().name.lower()
        pipette = PipetteInfo(
            key=mount,
            name=str(core.get_pipette_name()),
            mount=mount,
            channels=int(core.get_channels()),
            max_volume=float(core.get_max_volume()),
            min_volume=least_volume(core),
        )
        reader = self._readers[mount] = CallReader(core, pipette, self.wells)
        for name in CORE_METHODS:
            if hasattr(core, name):
                self._replace(core, name, functools.partial(self._tapped_method, reader, name))
        if hasattr(core, "configure_for_volume"):
            self._replace(core, "configure_for_volume", functools.partial(_setting_anew, reader))

    def _tapped_method(
        self, reader: CallReader, name: str, original: Callable[..., Any]
    ) -> Callable[..., Any]:
        def method(core: Any, *args: Any, **kwargs: Any) -> Any:
            if reader.busy:  # a legacy core moves by its own move_to inside an aspirate
                return original(*args, **kwargs)
            site = self._instead or self.stack.call_site()
            operation = reader.read(name, args, kwargs, site)
            if operation is None:
                return original(*args, **kwargs)
            for listener in self._listeners:
                listener.before(operation)
            reader.busy = True
            try:
                result = original(*args, **kwargs)
            finally:
                reader.busy = False
            for listener in self._listeners:
                listener.after(operation)
            return result

        return method

    def _replace(
        self, target: Any, name: str, make: Callable[[Callable[..., Any]], Callable[..., Any]]
    ) -> None:
        """Put a method in front of ``target.name``, on this instance only, until removal."""
        original = getattr(target, name)
        replacement = MethodType(functools.wraps(original)(make(original)), target)
        had_own = name in vars(target)
        setattr(target, name, replacement)

        def undo() -> None:
            # Only what is still ours: a protocol may have put its own in front meanwhile.
            if vars(target).get(name) is replacement:
                if had_own:
                    setattr(target, name, original)
                else:
                    delattr(target, name)

        self._undo.callback(undo)


def _setting_anew(reader: CallReader, original: Callable[..., Any]) -> Callable[..., Any]:
    def configure_for_volume(_core: Any, *args: Any, **kwargs: Any) -> Any:
        result = original(*args, **kwargs)
        reader.set_anew()
        return result

    return configure_for_volume


@contextmanager
def tapped(protocol: Any, listeners: Sequence[Listener], file_name: str) -> Iterator[Tap]:
    """Tap ``protocol`` for the duration of a ``with`` block."""
    tap = Tap(protocol, listeners, file_name)
    try:
        tap.install()
        yield tap
    finally:
        tap.remove()
