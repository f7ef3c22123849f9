"""A run as plain JSON, for the page and the report."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any
from urllib.parse import quote

from ..vocabulary import WellRef, from_json, to_json
from .decisions import effective
from .store import Store
from .unrecorded import Unrecorded

NO_VERDICT = "No verdict came before the run was over; look at this well."


def run_overview(
    store: Store, run: str, at_work: bool = False, unrecorded: Unrecorded | None = None
) -> dict[str, Any]:
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
    trajectories: dict[int, dict[str, Any]] = {}
    abandoned, decisions = store.abandoned(run), store.decisions(run)
    verdicts = {v.trajectory: (v, evidence, at) for v, evidence, at in store.verdicts(run)}
    for row in _waiting(unrecorded, "verdict"):
        verdicts[row["verdict"].trajectory] = (row["verdict"], row["evidence"], row["at"])
    for row in _waiting(unrecorded, "decision"):
        decisions.setdefault(row["trajectory"], []).append(row)

    def entry(number: int) -> dict[str, Any]:
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
            }
        return trajectories[number]

    for keyframe in store.told_keyframes(run):
        trajectory = entry(keyframe["trajectory"])
        address = f"/v1/runs/{quote(run, safe='')}/frames/{keyframe['sequence']}.jpg"
        trajectory["keyframes"].append(keyframe | {"frame": address})
        wells = keyframe["destinations"] or keyframe["sources"]
        if wells and (keyframe["destinations"] or not trajectory["well"]):
            more = f" and {len(wells) - 1} more" if len(wells) > 1 else ""
            trajectory["well"] = f"{from_json(WellRef, wells[0])}{more}"
    for number in (*verdicts, *abandoned):
        entry(number)
    holds = [*store.holds(run), *_waiting(unrecorded, "hold")]
    for hold in {(hold["trajectory"], hold["number"]): hold for hold in holds}.values():
        entry(hold["trajectory"])["holds"].append(hold)
    for number in store.put_right(run):
        entry(number)["recovered"] = True
    row = store.run(run) or {}
    for end in _waiting(unrecorded, "end"):
        row["finished"] = end
    for trajectory in trajectories.values() if row.get("finished") and not at_work else ():
        if trajectory["verdict"] is None and trajectory["abandoned"] is None:
            trajectory["unjudged"] = NO_VERDICT
    return row | {
        "trajectories": [trajectories[number] for number in sorted(trajectories)],
        "costs": _costs(evidence for _, evidence, _ in verdicts.values()),
        "actions": [*store.actions(run), *_waiting(unrecorded, "action")],
        "unrecorded": [
            {"kind": kind, **row}
            for kind in ("action", "decision")
            for row in _waiting(unrecorded, kind)
        ],
        "incidents": store.incidents(run),
        "recoveries": store.recoveries(run),
        "audit": store.audit(run),
    }


def _waiting(unrecorded: Unrecorded | None, kind: str) -> list[dict[str, Any]]:
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
