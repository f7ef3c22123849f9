"""Makes a pipette fail on purpose, as the plan of a qualification says (``aegis-ot qualify``).

It stands beneath all that listens to the protocol: the guard, Layer 1 and the sidecar hear of plain
deliveries, and judge blind. In a rehearsal, and under another guard, it does nothing. Standard
library only.
"""

from __future__ import annotations

import functools
import inspect
import json
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from contextvars import copy_context
from types import MethodType
from typing import Any

NORMAL, LEFT, NOTHING, AIR, MORE, NO_TIP = KINDS = (
    "normal", "left", "nothing", "air", "more", "no_tip",
)  # fmt: skip
"""What can be planted: a share of the volume stays in the tip; nothing is drawn; a share of the
column is air; a share more is drawn than told; the tip is thrown away before the draw."""

BELOW_THE_AIR = 0.35
"""Share of the liquid that is drawn after the air."""

_ABOVE_MM = 5.0
"""Where air is drawn: over the top of the well, mm."""

Run = Callable[[Any], Any]
Original = Callable[..., Any]


def planted(plan: str) -> Callable[[Run], Run]:
    """Decorates a guarded ``run`` that picks up a fresh tip for each delivery.

    Args:
        plan: JSON with ``deliveries``: of each tip, in order, what is planted and its share.
    """

    def decorate(run: Run) -> Run:
        @functools.wraps(run)
        def failing(protocol: Any) -> Any:
            from .guarded_run import is_guarded

            # A guard from outside (a dry run's) would hear of what is planted.
            if _is_rehearsal() or is_guarded(protocol):
                return run(protocol)
            with ExitStack() as undone:
                deliveries = [
                    (str(kind), float(share)) for kind, share in json.loads(plan)["deliveries"]
                ]
                _plant_in(protocol, deliveries, undone)
                return run(protocol)

        # A guard from outside goes on with the protocol's own, beneath what is planted.
        if mark := failing.__dict__.get("__aegis_guard__"):
            failing.__dict__["__wrapped__"] = mark[0]
        return failing

    return decorate


def _is_rehearsal() -> bool:
    """Of this package, or of the one that rehearses a wrapped protocol, which carries its own."""
    values = copy_context().items()
    return any(one.name == "aegis_ot_rehearsing" and value is not None for one, value in values)


def _plant_in(protocol: Any, deliveries: Sequence[tuple[str, float]], undone: ExitStack) -> None:
    core = protocol._core
    load = core.load_instrument

    def load_instrument(_core: Any, *args: Any, **kwargs: Any) -> Any:
        instrument = load(*args, **kwargs)
        FailingPipette(protocol, instrument, deliveries).install(undone)
        return instrument

    core.load_instrument = MethodType(functools.wraps(load)(load_instrument), core)
    undone.callback(delattr, core, "load_instrument")


class FailingPipette:
    """Stands in front of one instrument core's methods.

    Args:
        protocol: The context that it was loaded in.
        core: The instrument's.
        deliveries: What is planted, by fresh tip.
    """

    def __init__(self, protocol: Any, core: Any, deliveries: Sequence[tuple[str, float]]) -> None:
        self._protocol = protocol
        self._core = core
        self._coming = iter(deliveries)
        self._kind, self._share = NORMAL, 0.0
        self._tip_mm = 0.0
        self._has_tip = False
        self._left_at: tuple[Any, Any] | None = None
        self._do: dict[str, Original] = {}

    def install(self, undone: ExitStack) -> None:
        """Until ``undone`` closes."""
        for name, instead in (
            ("pick_up_tip", self._pick_up_tip),
            ("aspirate", self._aspirate),
            ("dispense", self._dispense),
            ("move_to", self._move_to),
            ("drop_tip", self._drop_tip),
            ("drop_tip_in_disposal_location", self._drop_tip_there),
        ):
            original = self._do[name] = getattr(self._core, name)
            method = functools.wraps(original)(functools.partial(_call_by_name, instead, name))
            setattr(self._core, name, MethodType(method, self._core))
            undone.callback(delattr, self._core, name)

    def _pick_up_tip(self, a: dict[str, Any]) -> None:
        self._do["pick_up_tip"](**a)
        self._kind, self._share = next(self._coming, (NORMAL, 0.0))
        well = a["well_core"]
        # The depth of a rack's well is the length of its tip, or a little more.
        self._tip_mm = float(well.get_top(z_offset=0).z - well.get_bottom(z_offset=0).z)
        self._has_tip, self._left_at = True, None

    def _aspirate(self, a: dict[str, Any]) -> None:
        if self._kind == NO_TIP and self._has_tip:
            self._throw_tip_away()
        if self._kind in (NO_TIP, NOTHING):
            self._only_move(a)
        elif self._kind == AIR:
            air = self._share * a["volume"]
            liquid = a["volume"] - air
            above = _place(a["location"], a["well_core"].get_top(z_offset=_ABOVE_MM))
            self._do["aspirate"](**a | {"volume": (1 - BELOW_THE_AIR) * liquid})
            self._do["aspirate"](**a | {"volume": air, "location": above})
            self._do["aspirate"](**a | {"volume": BELOW_THE_AIR * liquid})
        else:
            more = self._share if self._kind == MORE else 0.0
            self._do["aspirate"](**a | {"volume": (1 + more) * a["volume"]})

    def _dispense(self, a: dict[str, Any]) -> None:
        stays = {NOTHING: 1.0, NO_TIP: 1.0, LEFT: self._share}.get(self._kind, 0.0)
        if self._kind in (LEFT, MORE):
            self._left_at = a["location"], a["well_core"]
        if stays >= 1.0:
            self._only_move(a)
        else:
            self._do["dispense"](**a | {"volume": (1 - stays) * a["volume"]})

    def _move_to(self, a: dict[str, Any]) -> None:
        # Without a tip the robot would bring the bare nozzle down to where a tip should end.
        raised = a if self._has_tip else a | {"location": _raised(a["location"], self._tip_mm)}
        self._do["move_to"](**raised)

    def _drop_tip(self, a: dict[str, Any]) -> None:
        self._away("drop_tip", a)

    def _drop_tip_there(self, a: dict[str, Any]) -> None:
        self._away("drop_tip_in_disposal_location", a)

    def _away(self, how: str, a: dict[str, Any]) -> None:
        """Clean up, once all has been seen: what was left goes into its well, the tip away."""
        if self._left_at is not None:
            location, well = self._left_at
            self._core.blow_out(location=location, well_core=well, in_place=False)
        if self._has_tip:
            self._do[how](**a)
        self._kind, self._has_tip, self._left_at = NORMAL, True, None

    def _throw_tip_away(self) -> None:
        mount = self._core.get_mount().name.lower()
        trash = self._protocol.loaded_instruments[mount].trash_container
        self._do["drop_tip_in_disposal_location"](trash, home_after=None)
        self._has_tip = False

    def _only_move(self, a: dict[str, Any]) -> None:
        """To where liquid would have moved; the plunger stays still."""
        self._move_to(
            {
                "location": a["location"], "well_core": a["well_core"], "force_direct": False,
                "minimum_z_height": None, "speed": None,
            }
        )  # fmt: skip


def _call_by_name(
    instead: Callable[[dict[str, Any]], None], name: str, core: Any, *args: Any, **kwargs: Any
) -> None:
    bound = inspect.signature(getattr(type(core), name)).bind(core, *args, **kwargs)
    values = dict(bound.arguments)
    values.pop(next(iter(values)))
    instead(values)


def _raised(location: Any, by_mm: float) -> Any:
    point = getattr(location, "point", None)
    if point is None:  # the trash
        return location
    return _place(location, type(point)(point.x, point.y, point.z + by_mm))


def _place(like: Any, point: Any) -> Any:
    return type(like)(point, like.labware)
