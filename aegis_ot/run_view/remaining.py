"""What a run that stopped left: deliveries done and open, what wells and tips hold, tips used."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..vocabulary import counted
from .lineage import tip_of
from .overview import DeliveryEntry, RunOverview, WellEntry
from .plates import wells_of
from .rest import HeldWell, RehearsedDelivery, Rest, RestDelivery, Standing, UsedTip

_DONE = ("pass", "calibration", "recovered")
_BROKEN_OFF = ("stopped", "aborted", "failed")
_UNWATCHED = "nobody watched whether it was made"


def rest_of(
    overview: RunOverview,
    planned: Sequence[RehearsedDelivery] | None = None,
    began_ul: Mapping[str, float] | None = None,
) -> Rest:
    """Put it together.

    Args:
        overview: Answer of ``GET /v1/runs/{run}``.
        planned: The protocol's deliveries, from its rehearsal; ``None``: those that the run told
            of, without volumes.
        began_ul: What wells held before the run, µL, where the protocol declares it.
    """
    plan = _told(overview) if planned is None else list(planned)
    own = _own(overview)
    begun, whole = _told_by_robot(overview, len(own))
    deliveries, warnings = [], []
    for number in range(max(len(plan), len(own))):
        seen = own[number] if number < len(own) else None
        known = plan[number] if number < len(plan) else None
        if seen is None:
            known = known or RehearsedDelivery(wells=[])
            if known.wells or number >= len(plan):
                is_open = begun is not None and number >= begun
                standing: Standing = "open" if is_open else "look"
                why = "" if is_open else _UNWATCHED
                deliveries.append(
                    RestDelivery(number=number, standing=standing, why=why, **known.model_dump())
                )
            continue
        mine = _seen(seen)
        if known is not None and mine.wells and mine.wells != known.wells:
            warnings.append(
                f"Delivery {number} went to {', '.join(mine.wells)}, but the protocol delivers to "
                f"{', '.join(known.wells) or 'no well'} then: it is not the protocol of this run, "
                "or the run did otherwise. Read the rest of this table with care."
            )
        if known is not None and not known.wells and not mine.wells:
            continue  # the protocol itself gives it up
        standing, why = _standing(seen, whole)
        merged = {name: value for name, value in mine.model_dump().items() if value}
        base = known.model_dump() if known is not None else {"wells": []}
        deliveries.append(
            RestDelivery(
                number=number, standing=standing, why=why, tips=_tips(seen), **(base | merged)
            )
        )
    if len(plan) < int(overview.get("planned_wells") or 0):
        warnings.append(
            "The run told only the beginning of its plan; name the protocol to see all of it."
        )
    if unwatched := sum(one.why == _UNWATCHED for one in deliveries):
        warnings.append(
            f"{counted(unwatched, 'delivery', 'deliveries')} may have been made while nobody "
            "watched, or not at all: the robot did not say how far it came. Look at these wells."
        )
    finished = overview.get("finished")
    ended = finished["outcome"] if finished else ""
    if not ended:
        warnings.append("The run has not ended: what is said here changes while it goes on.")
    return Rest(
        run=str(overview["run"]),
        ended=ended,
        deliveries=deliveries,
        wells=_wells(overview, deliveries, own, began_ul or {}),
        tips=_used(overview),
        warnings=warnings,
    )


def _told(overview: RunOverview) -> list[RehearsedDelivery]:
    """The plan that the run told of; a plate's slot from its list of plates."""
    slots = {one["labware"]: one["slot"] for one in overview.get("plates") or ()}
    return [
        RehearsedDelivery(
            wells=[f"{slots.get(one['labware']) or one['labware']}:{name}" for name in one["wells"]]
        )
        for one in overview.get("planned") or ()
    ]


def _own(overview: RunOverview) -> list[DeliveryEntry | None]:
    """The deliveries that the protocol made, in order; ``None`` for one whose record is lost."""
    known = {t["trajectory"]: t for t in overview["trajectories"] if t["keyframes"]}
    rows = [known.get(number) for number in range(max(known, default=-1) + 1)]
    return [row for row in rows if row is None or _recovers(row) is None]


def _told_by_robot(overview: RunOverview, own: int) -> tuple[int | None, bool]:
    """How many of its deliveries a run may have begun at most, by the word of the robot itself,
    and whether each keyframe until then was recorded. ``None`` where the robot did not say: it
    may have gone on unwatched."""
    ended = overview.get("finished")
    if not ended or ended["outcome"] not in _BROKEN_OFF:
        return None, False
    trajectories, keyframes = ended.get("trajectories"), ended.get("keyframes")
    if trajectories is None or keyframes is None:
        return None, False
    recorded = [t for t in overview["trajectories"] if t["keyframes"]]
    lost = trajectories - max((t["trajectory"] + 1 for t in recorded), default=0)
    return own + max(0, lost), keyframes == sum(len(t["keyframes"]) for t in recorded)


def _recovers(trajectory: DeliveryEntry) -> int | None:
    return next((k["recovers"] for k in trajectory["keyframes"] if k["recovers"] is not None), None)


def _seen(trajectory: DeliveryEntry) -> RehearsedDelivery:
    last = next((k for k in reversed(trajectory["keyframes"]) if k["destinations"]), None)
    last = last or (trajectory["keyframes"][-1] if trajectory["keyframes"] else None)
    if last is None:
        return RehearsedDelivery(wells=[])
    return RehearsedDelivery(
        wells=[_address(well) for well in last["destinations"]],
        sources=[_address(well) for well in last["sources"]],
        volume_ul=last["commanded_ul"],
        channels=last["channels"],
    )


def _address(well: WellEntry) -> str:
    return f"{well.get('slot') or well.get('label') or well['labware']}:{well['name']}"


def _standing(trajectory: DeliveryEntry, whole: bool) -> tuple[Standing, str]:
    """A well that failed, is undecided or was not seen is never done; and one that was drawn for
    is open only if the record is ``whole``: else it may have got its volume unwatched."""
    kinds = {keyframe["kind"] for keyframe in trajectory["keyframes"]}
    views = [view for _, view in wells_of(trajectory)]
    states = {view.state for view in views}
    if states and states <= set(_DONE):
        return "done", ""
    if trajectory["verdict"] is None and kinds == {"aspirate"}:
        return ("open", "") if whole else ("look", _UNWATCHED)
    words = {
        "fail": "failed", "undecided": "undecided", "unobserved": "its tip was not seen",
        "abandoned": "given up on the way", "running": "interrupted on the way",
        "waiting": "not judged yet",
    }  # fmt: skip
    told = [
        f"{view.well} {words[view.state]}" + (f" ({view.failure})" if view.failure else "")
        for view in views
        if view.state not in _DONE
    ]
    return "look", ", ".join(told) or "nobody saw where it went"


def _tips(trajectory: DeliveryEntry) -> list[str]:
    first = trajectory["keyframes"][0] if trajectory["keyframes"] else None
    count = 0 if first is None else first["channels"]
    return [tip_of(first, channel) for channel in range(count) if first is not None]


def _wells(
    overview: RunOverview,
    deliveries: Sequence[RestDelivery],
    own: Sequence[DeliveryEntry | None],
    began: Mapping[str, float],
) -> list[HeldWell]:
    """What was there, and what every delivery that began, or may have, took and brought,
    recoveries too."""
    least: dict[str, float] = dict.fromkeys(began, 0.0)
    most: dict[str, float] = dict(least)
    begun = {one.number: one for one in deliveries}
    numbers = {row["trajectory"]: number for number, row in enumerate(own) if row is not None}
    drawn_from: set[str] = set()
    for trajectory in overview["trajectories"]:
        if not trajectory["keyframes"]:
            continue
        known = begun.get(numbers.get(trajectory["trajectory"], -1))
        seen = known or _seen(trajectory)
        standing = _standing(trajectory, False)[0] if known is None else known.standing
        volume = seen.volume_ul or 0.0
        tips = len(_tips(trajectory))
        put_right = bool(trajectory["recovered"])  # by a recovery: this one brought some, or none
        for well in seen.sources:
            taken = volume * tips / len(seen.sources)
            drawn_from.add(well)
            most[well] = most.get(well, 0.0) - (taken if standing == "done" else 0.0)
            least[well] = least.get(well, 0.0) - taken
        for well in seen.wells if standing != "open" else ():
            sure = standing == "done" and not put_right
            brought = volume * (tips / len(seen.wells) if len(seen.wells) < tips else 1.0)
            least[well] = least.get(well, 0.0) + (brought if sure else 0.0)
            most[well] = most.get(well, 0.0) + brought
    unseen = [one for one in deliveries if one.number >= len(own) or own[one.number] is None]
    first_open = next((one for one in unseen if one.standing == "open"), None)
    for one in unseen:
        # The robot may have drawn for the first one that it did not begin.
        if one.standing == "look" or one is first_open:
            for well in one.sources:
                taken = (one.volume_ul or 0.0) * one.channels / len(one.sources)
                drawn_from.add(well)
                most.setdefault(well, 0.0)
                least[well] = least.get(well, 0.0) - taken
        for well in one.wells if one.standing == "look" else ():
            share = one.channels / len(one.wells) if len(one.wells) < one.channels else 1.0
            least.setdefault(well, 0.0)
            most[well] = most.get(well, 0.0) + (one.volume_ul or 0.0) * share
    held = []
    for well in most:
        # A well that nothing is said of, and that only got liquid, is taken for empty before.
        start = began.get(well, None if well in drawn_from else 0.0)
        low, high = ((start or 0.0) + change for change in (least[well], most[well]))
        if start is not None:
            low, high = max(low, 0.0), max(high, 0.0)
        held.append(
            HeldWell(well=well, began_ul=start, least_ul=round(low, 2), most_ul=round(high, 2))
        )
    return held


def _used(overview: RunOverview) -> list[UsedTip]:
    tips: dict[str, UsedTip] = {}
    for trajectory in overview["trajectories"]:
        if not trajectory["keyframes"]:
            continue
        last = trajectory["keyframes"][-1]
        for name in _tips(trajectory):
            tip = tips.setdefault(
                name, UsedTip(tip=name, pipette=last["pipette"], mount=last["mount"])
            )
            tip.deliveries += 1
            tip.holds_ul = last["expected_ul"]
            tip.of = [_address(well) for well in last["sources"]] if tip.holds_ul else []
    return list(tips.values())
