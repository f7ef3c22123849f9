"""A run as plain JSON, for the page and the report."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, cast
from urllib.parse import quote

from ..errors import StoreError
from ..run_view import count_wells, plates_of
from ..run_view.overview import DecisionEntry, DeliveryEntry, RunOverview
from ..vocabulary import (
    Outcome,
    Verdict,
    WellRef,
    from_json,
    to_json,
    wells_with_places,
    with_places,
)
from .decisions import effective
from .run_record import RunRecord
from .store import Store

NO_VERDICT = "No verdict came before the run was over; look at this well."


def run_overview(
    store: Store, run: str, at_work: bool = False, unrecorded: RunRecord | None = None
) -> RunOverview:
    """All that the store knows of a run: its start and end, and per trajectory its keyframes,
    verdict (as it stands, and as it was judged), evidence, decisions, holds; the audit.

    Args:
        store: An open store.
        run: Which run.
        at_work: Whether verdicts of it may still come. Where none can, a delivery of a run that is
            over says under ``unjudged`` that it has none.
        unrecorded: What counts already, and the store could not take.

    Returns:
        The answer of ``GET /v1/runs/{run}``, without ``version``.
    """
    trajectories = _deliveries(store, run, unrecorded)
    recoveries = [*store.recoveries(run), *_waiting(unrecorded, "recovery")]
    known = cast("RunOverview", store.run(run) or {})
    for end in _waiting(unrecorded, "end"):
        known["finished"] = end
    if known.get("finished") and not at_work:
        for trajectory in trajectories:
            if trajectory["verdict"] is None and trajectory["abandoned"] is None:
                trajectory["unjudged"] = NO_VERDICT
    return {
        **known,
        "trajectories": trajectories,
        "costs": _costs(one["evidence"] for one in trajectories),
        "actions": [*store.actions(run), *_waiting(unrecorded, "action")],
        "unrecorded": [
            {"kind": kind, **row}
            for kind in ("action", "decision")
            for row in _waiting(unrecorded, kind)
        ],
        "incidents": [*store.incidents(run), *_waiting(unrecorded, "incident")],
        "recoveries": _last_words(recoveries, "attempt"),
        "audit": store.audit(run),
    }


def _deliveries(store: Store, run: str, unrecorded: RunRecord | None) -> list[DeliveryEntry]:
    """In order."""
    trajectories: dict[int, DeliveryEntry] = {}
    abandoned, decisions = store.abandoned(run), store.decisions(run)
    verdicts = {v.trajectory: (v, evidence, at) for v, evidence, at in store.verdicts(run)}
    for row in _waiting(unrecorded, "verdict"):
        verdicts[row["verdict"].trajectory] = (row["verdict"], row["evidence"], row["at"])
    for row in _waiting(unrecorded, "abandon"):
        abandoned.setdefault(row["trajectory"], row["reason"])
    for row in _waiting(unrecorded, "decision"):
        decisions.setdefault(row["trajectory"], []).append(row)

    def entry(number: int) -> DeliveryEntry:
        if number not in trajectories:
            verdict, evidence, judged = verdicts.get(number, (None, {}, None))
            decided = decisions.get(number, [])
            now = None if verdict is None else to_json(effective(verdict, decided))
            trajectories[number] = {
                "trajectory": number,
                "well": "",
                "keyframes": [],
                "verdict": now,
                "judged": None if verdict is None else to_json(verdict),
                "judged_at": judged,
                "evidence": evidence,
                "decisions": decided,
                "holds": [],
                "abandoned": abandoned.get(number),
                "recovered": False,
                "unjudged": None,
                "clip": None,
            }
        return trajectories[number]

    for keyframe in store.told_keyframes(run):
        trajectory = entry(keyframe["trajectory"])
        address = f"/v1/runs/{quote(run, safe='')}/frames/{keyframe['sequence']}.jpg"
        trajectory["keyframes"].append({**keyframe, "frame": address})
        wells = keyframe["destinations"] or keyframe["sources"]
        if wells and (keyframe["destinations"] or not trajectory["well"]):
            trajectory["well"] = wells_with_places([from_json(WellRef, well) for well in wells])
    for number in (*verdicts, *abandoned):
        entry(number)
    for number, (verdict, _, _) in verdicts.items():
        named = _wells_in_question(verdict, decisions.get(number, []))
        trajectories[number]["well"] = named or trajectories[number]["well"]
    for hold in _last_words([*store.holds(run), *_waiting(unrecorded, "hold")], "number"):
        entry(hold["trajectory"])["holds"].append(hold)
    for number in store.put_right(run):
        entry(number)["recovered"] = True
    for number in store.clips(run) & trajectories.keys():
        entry(number)["clip"] = f"/v1/runs/{quote(run, safe='')}/clips/{number}.webm"
    return [trajectories[number] for number in sorted(trajectories)]


def runs_overview(
    store: Store, search: str = "", most: int = -1, skip: int = 0
) -> list[dict[str, Any]]:
    """Runs, newest first (see :meth:`.Store.runs`), with ``deliveries`` and ``wells`` by state:
    each well has its own, as on the run's page.
    """
    rows = store.runs(search, most, skip)
    for row in rows:
        try:
            overview = run_overview(store, row["run"])
            counts = count_wells(plates_of(overview), overview["trajectories"])
        except StoreError:  # the row itself says that it is damaged
            counts = {"wells": 0, "deliveries": 0}
        first = counts.pop("calibration", 0)
        counts |= {"pass": counts.get("pass", 0) + first} if first else {}
        del counts["wells"]
        row |= {"deliveries": counts.pop("deliveries"), "wells": counts}
    return rows


def _wells_in_question(verdict: Verdict, decided: list[DecisionEntry]) -> str:
    """Of a row of tips the wells that the verdict is about; ``""``: all that were delivered to."""
    for said in (effective(verdict, decided), verdict):
        about = [one for one in said.channels if one.outcome.value == said.outcome.value]
        if about and said.outcome is not Outcome.PASS:
            return with_places(about)
    return ""


def _last_words(rows: list[Any], counted: str) -> list[Any]:
    """What is told again under the same number stands once, as it was told last."""
    return list({(row["trajectory"], row[counted]): row for row in rows}.values())


def _waiting(unrecorded: RunRecord | None, kind: str) -> list[Any]:
    return [] if unrecorded is None else unrecorded.rows(kind)


def _costs(evidences: Iterable[Mapping[str, Any]]) -> dict[str, Any] | None:
    """What asking models took in a run; ``None`` if none was asked."""
    asked = [cost for evidence in evidences for cost in evidence.get("costs") or ()]
    if not asked:
        return None
    amounts: dict[str, Any] = {}
    for cost in asked:
        if cost["amount"] is not None:
            amounts[cost["currency"]] = amounts.get(cost["currency"], 0.0) + cost["amount"]
    return {
        "models": ", ".join(sorted({cost["model"] for cost in asked})),
        "calls": sum(cost["calls"] for cost in asked),
        "unpriced_calls": sum(cost["calls"] for cost in asked if cost["amount"] is None),
        "tokens_read": sum(cost["tokens_in"] for cost in asked),
        "tokens_written": sum(cost["tokens_out"] for cost in asked),
        "seconds": round(sum(cost["seconds"] for cost in asked), 1),
        **{currency: round(amount, 6) for currency, amount in amounts.items()},
    }
