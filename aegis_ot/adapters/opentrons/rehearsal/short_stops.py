"""Hears where ``distribute`` or ``consolidate`` ends without a word.

Opentrons splits volumes by what the pipette can hold, and fills a tip by what the tip can: a volume
between the two ends the whole command, and what is left of it is never moved. So each call of a
rehearsal is held against the wells that it reached.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from ....vocabulary import WellRef
from ..instrumentation import Event, EventKind, Operation, OperationKind, Tap
from .recording import Recorder

_SEVERAL = {
    "distribute": ("dest", 2, OperationKind.DISPENSE),
    "consolidate": ("source", 1, OperationKind.ASPIRATE),
}
"""The argument that names several wells, where it stands, and what is done in each of them."""


@contextmanager
def short_stops_told(context: Any, recorder: Recorder, tap: Tap) -> Iterator[None]:
    """Tell the recorder of each call in a simulated context that ends before its last well."""
    load = context.load_instrument

    @functools.wraps(load)
    def load_instrument(*args: Any, **kwargs: Any) -> Any:
        instrument = load(*args, **kwargs)
        for name in _SEVERAL:
            setattr(instrument, name, _followed(getattr(instrument, name), name, recorder, tap))
        return instrument

    context.load_instrument = load_instrument
    try:
        yield
    finally:
        del context.load_instrument


def _followed(
    original: Callable[..., Any], name: str, recorder: Recorder, tap: Tap
) -> Callable[..., Any]:
    argument, place, kind = _SEVERAL[name]

    @functools.wraps(original)
    def followed(*args: Any, **kwargs: Any) -> Any:
        began = len(recorder.log)
        result = original(*args, **kwargs)
        volumes = kwargs.get("volume", args[0] if args else None)
        wells = kwargs.get(argument, args[place] if len(args) > place else None)
        reached = {
            ref
            for step in recorder.log[began:]
            if isinstance(step, Operation) and step.kind is kind
            for ref in step.wells
        }
        left = [(ref, ul) for ref, ul in _written(volumes, wells, tap) if ref not in reached]
        if left:
            refs = tuple(dict.fromkeys(ref for ref, _ in left))
            line = tap.stack.call_site(skip=0).line
            recorder.event(Event(EventKind.CUT_SHORT, line, "", refs, name, left[0][1]))
        return result

    return followed


def _written(volumes: Any, wells: Any, tap: Tap) -> Iterator[tuple[WellRef, float]]:
    """The wells of a call, each with what is written to be moved there; nothing that is odd."""
    flat = list(_flat(wells))
    if isinstance(volumes, (int, float)):
        volumes = [volumes] * len(flat)
    if not isinstance(volumes, Sequence) or len(volumes) != len(flat):
        return  # a gradient, say
    for well, volume in zip(flat, volumes, strict=True):
        core: Any = getattr(well, "_core", None)
        if isinstance(volume, (int, float)) and volume > 0 and hasattr(core, "get_name"):
            yield tap.wells.ref(tap.wells.info_of(core).key, str(core.get_name())), float(volume)


def _flat(wells: Any) -> Iterator[Any]:
    if isinstance(wells, (list, tuple)) and not hasattr(wells, "labware"):
        for one in wells:
            yield from _flat(one)
    else:
        place = getattr(wells, "labware", None)
        is_well = getattr(place, "is_well", False)
        yield place.as_well() if place is not None and is_well else wells
