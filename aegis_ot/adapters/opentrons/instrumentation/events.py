"""Hears of what is not pipetting: labware, liquids, modules, pauses, comments, fresh tips."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from .callsite import ProtocolStack
from .modules import MODULE_ACTIONS, action_text, carried_by
from .operation import Event, EventKind, Listener
from .wells import WellResolver

Make = Callable[[Callable[..., Any]], Callable[..., Any]]
Replace = Callable[[Any, str, Make], None]


class EventTap:
    """Wraps a protocol core (and the engine client behind it) for events.

    Args:
        core: The protocol core.
        wells: Where labware is registered.
        listeners: Told of each event after it happened.
        stack: Finds the protocol's lines.
        replace: Puts a method in front of an instance's own until the tap is removed.
    """

    def __init__(
        self,
        core: Any,
        wells: WellResolver,
        listeners: Sequence[Listener],
        stack: ProtocolStack,
        replace: Replace,
    ) -> None:
        self._core = core
        self._wells = wells
        self.listeners = listeners
        self._stack = stack
        self._replace = replace
        self._liquids: dict[str, tuple[str, str]] = {}

    def install(self) -> None:
        """Wrap what this core has; the legacy one has less."""
        for labware_core in self._core.get_labware_cores():
            self._loaded(labware_core)
        for name in ("load_labware", "load_adapter", "load_lid"):
            self._after(self._core, name, lambda result, *_: self._loaded(result))
        self._before(self._core, "move_labware", self._moving)
        self._after(self._core, "move_labware", self._moved)
        self._after(self._core, "define_liquid", self._defined)
        for module_core in self._core.get_module_cores():
            self._tap_module(module_core)
        self._after(self._core, "load_module", lambda result, *_: self._tap_module(result))
        self._before(self._core, "pause", self._said(EventKind.PAUSED))
        self._after(self._core, "comment", self._said(EventKind.COMMENT))
        client = getattr(self._core, "_engine_client", None)
        if client is not None:
            # Liquids are loaded through wells and labware alike; both end here.
            self._after(client, "execute_command", self._commanded)

    def _before(self, target: Any, name: str, tell: Callable[..., None]) -> None:
        def make(original: Callable[..., Any]) -> Callable[..., Any]:
            def method(_self: Any, *args: Any, **kwargs: Any) -> Any:
                tell(None, args, kwargs)
                return original(*args, **kwargs)

            return method

        self._replace_if_there(target, name, make)

    def _after(self, target: Any, name: str, tell: Callable[..., None]) -> None:
        def make(original: Callable[..., Any]) -> Callable[..., Any]:
            def method(_self: Any, *args: Any, **kwargs: Any) -> Any:
                result = original(*args, **kwargs)
                tell(result, args, kwargs)
                return result

            return method

        self._replace_if_there(target, name, make)

    def _replace_if_there(self, target: Any, name: str, make: Make) -> None:
        if hasattr(target, name):
            self._replace(target, name, make)

    def _tell(self, event: Event) -> None:
        for listener in self.listeners:
            listener.event(event)

    def _line(self) -> int | None:
        return self._stack.call_site(skip=2).line

    def _loaded(self, labware_core: Any) -> None:
        info = self._wells.register(labware_core)
        # What ``set_offset`` calls: every height on this labware changes.
        self._after(labware_core, "set_calibration", lambda *_: self._wells.forget_heights())
        if info.is_tip_rack:
            self._after(
                labware_core,
                "reset_tips",
                lambda *_: self._tell(Event(EventKind.TIPS_RESET, self._line(), info.key)),
            )
        self._tell(
            Event(
                EventKind.LABWARE_LOADED, self._line(), info.key, text=info.slot, labware_info=info
            )
        )

    def _tap_module(self, module_core: Any) -> None:
        for name in MODULE_ACTIONS:
            self._after(module_core, name, self._module_did(module_core, name))

    def _module_did(self, module_core: Any, name: str) -> Callable[..., None]:
        def tell(result: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
            if name == "retrieve":
                self._handed_out(result)
            on_it = carried_by(self._core, module_core)
            key = self._wells.register(on_it).key if on_it is not None else ""
            text = action_text(name, args, kwargs)
            self._tell(Event(EventKind.MODULE, self._line(), key, text=text))

        return tell

    def _handed_out(self, labware_core: Any) -> None:
        """A stacker gives a labware that nobody saw before, or one that was stored: with the same
        identifier it is the same plate, and holds what it held."""
        if self._wells.knows(labware_core):
            self._moved(None, (labware_core,), {})
        else:
            self._loaded(labware_core)

    def _moving(self, _result: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        info = self._wells.register(kwargs.get("labware_core", args[0] if args else None))
        self._tell(Event(EventKind.LABWARE_MOVING, self._line(), info.key))

    def _moved(self, _result: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        info = self._wells.moved(kwargs.get("labware_core", args[0] if args else None))
        slot = self._wells.slot(info.key)
        self._tell(Event(EventKind.LABWARE_MOVED, self._line(), info.key, text=slot))

    def _defined(self, liquid: Any, *_: Any) -> None:
        self._liquids[str(liquid._id)] = (str(liquid.name), str(liquid.description or ""))

    def _said(self, kind: EventKind) -> Callable[..., None]:
        def tell(_result: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
            text = kwargs.get("msg", args[-1] if args else "")
            self._tell(Event(kind, self._line(), text=text if isinstance(text, str) else ""))

        return tell

    def _commanded(self, _result: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        params: Any = kwargs.get("params", args[0] if args else None)
        if type(params).__name__ != "LoadLiquidParams":
            return
        key = self._wells.key_of_id(params.labwareId)
        name, description = self._liquids.get(params.liquidId, ("", ""))
        line = self._line()
        for well, volume in params.volumeByWell.items():
            self._tell(
                Event(
                    EventKind.LIQUID_LOADED,
                    line,
                    key,
                    (self._wells.ref(key, well),),
                    text=name,
                    volume=float(volume),
                    description=description,
                )
            )
