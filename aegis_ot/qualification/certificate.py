"""The result of a qualification: plain values for a JSON file and the page."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .._version import __version__
from ..errors import ConfigurationError, StoreError
from ..inspection.aiming import check_camera
from ..planted import AIR, LEFT, MORE, NO_TIP, NOTHING
from ..reports.html_page import html_page
from ..sidecar.store import Store
from ..vision.types import Detector
from ..vocabulary import Outcome
from ..worldmodel.recorded import run_source
from .camera_state import camera_state, changes
from .counting import rate_of, smallest_leftover
from .fitted import spread_of
from .opening import JudgedDelivery, open_plan
from .plan import QualificationPlan

FORMAT, VERSION = "aegis-ot qualification", 3
_READ = (2, 3)  # can be compared with; intervals of version 2 were of the one run alone

WORDS = {
    LEFT: "{} % of the volume left in the tip",
    NOTHING: "nothing drawn",
    AIR: "{} % air inside the column",
    MORE: "{} % more drawn than told",
    NO_TIP: "no tip",
}
_COMPARED = {"run", "began", "robot", "pipette", "mount", "tips"}
_COARSE_PX_PER_MM = 3.3
_DARK, _BRIGHT = 60, 180


def certificate(
    store: Store,
    run: str,
    plan: QualificationPlan,
    detector: Detector,
    previous: Mapping[str, Any] | None = None,
    anew: Mapping[str, bool] | None = None,
) -> dict[str, Any]:
    """Open the plan of a run, and count.

    Args:
        store, run, plan: As for :func:`~.opening.open_plan`.
        detector: Finds tips, where the camera is to be registered.
        previous: The last certificate, to compare the camera with.
        anew: See :func:`~.fitted.flagged_anew`; without, intervals are of this run alone.

    Raises:
        ConfigurationError: The run is none of this plan, or ``previous`` no certificate.
        StoreError: The store cannot be read.
    """
    if previous is not None:
        check_certificate(previous)
    deliveries, overview = open_plan(store, run, plan)
    frames = store.frames_of(run)
    camera = camera_state(deliveries, frames)
    source = run_source(overview)
    known = _registration(store, run, detector) if source == "real" else None
    liquids = [
        count_liquid(name, [e for e in deliveries if e.planned.liquid == name], plan, anew)
        for name in dict.fromkeys(each.planned.liquid for each in deliveries)
    ]
    ended = overview["finished"]
    assert ended is not None  # no other run is opened
    robot = overview.get("robot_name") or overview.get("robot")
    return {
        "format": FORMAT,
        "version": VERSION,
        "frames": "real" if source == "real" else "simulated",
        "run": run,
        "robot": robot,
        "pipette": plan.pipette,
        "mount": plan.mount,
        "tips": plan.tips,
        "volume_ul": plan.volume_ul,
        "began": overview["registered"],
        "ended": ended["at"],
        "outcome": ended["outcome"],
        "planned": len(plan.deliveries),
        "delivered": len(deliveries),
        "uncounted": sum(not each.is_counted for each in deliveries),
        "liquids": liquids,
        "seconds": _seconds(deliveries),
        "camera": camera,
        "registration": known,
        "advice": _advice(camera, known, liquids),
        "changes": _changes(camera, previous, plan, robot),
        "previous": None if previous is None else {k: previous[k] for k in ("run", "began")},
        "record": {
            "aegis_ot": __version__,
            "aegis_ot_on_the_robot": overview.get("package"),
            "api_level": overview.get("api_level"),
            "guard": overview.get("guard"),
            "sidecar": overview.get("sidecar"),
            "protocol_sha256": overview.get("protocol_sha256"),
            "plan": {"seed": plan.seed, "sha256": plan.digest},
            **_hashes(deliveries, store, run),
        },
        "deliveries": [_told(each) for each in deliveries],
    }


def certificate_html(made: Mapping[str, Any]) -> str:
    """A certificate as one HTML page: no script, no link."""
    shown = {"fitted": None, **made}
    return html_page("aegis_ot.qualification", "certificate.html", {}, c=shown, words=WORDS)


def check_certificate(told: Any) -> None:
    """Refuse what the camera cannot be compared with.

    Raises:
        ConfigurationError: It is no certificate of this version.
    """
    try:
        if told["format"] == FORMAT and told["version"] in _READ and not _COMPARED - told.keys():
            changes(told["camera"], told["camera"])  # half an hour later would be too late
            return
    except (AttributeError, KeyError, TypeError, ValueError):
        pass
    raise ConfigurationError(
        "The file to compare with is no certificate of this version of aegis-ot qualify."
    )


def count_liquid(
    name: str, deliveries: Sequence[JudgedDelivery], plan: QualificationPlan,
    anew: Mapping[str, bool] | None = None,
) -> dict[str, Any]:  # fmt: skip
    """What is counted of one liquid's deliveries; ``anew`` as for :func:`certificate`."""
    # Whatever makes a run miss more need not make it flag more: each has a spread of its own.
    of_faults, of_normals = (
        spread_of([e for e in deliveries if e.is_normal is normal], anew or {})
        for normal in (False, True)
    )
    spread = of_faults or 0.0
    counted = [each for each in deliveries if each.is_counted]
    # Of the first wells only what a gate failed tells of the camera: the others are not judged.
    fail = Outcome.FAIL.value
    normal = [e for e in counted if e.is_normal and (not e.calibrates or e.outcome == fail)]
    normals = rate_of((e.is_flagged for e in normal), of_normals or 0.0)

    def caught(alike: Iterable[JudgedDelivery]) -> dict[str, float | int]:
        return rate_of((each.is_flagged for each in alike), spread).to_json()

    faults = [each for each in counted if not each.is_normal]
    kinds = sorted({(each.planned.kind, each.planned.share) for each in faults})
    rows = [
        {
            "kind": kind,
            "share": share,
            "words": WORDS[kind].format(f"{100 * share:g}"),
            "ul": round(share * plan.volume_ul, 2) if share else None,
            "caught": caught(
                e for e in faults if (e.planned.kind, e.planned.share) == (kind, share)
            ),
        }
        for kind, share in sorted(kinds, key=lambda each: (list(WORDS).index(each[0]), each[1]))
    ]
    left = [each for each in faults if each.planned.kind == LEFT]
    smallest = smallest_leftover(
        [each.planned.share for each in left], [each.is_flagged for each in left], normals, spread
    )
    many = f"{normals.hits} of {normals.of} normal wells were flagged: where so many are, no "
    return {
        "name": name,
        "spread": None if of_faults is None else round(of_faults, 4),
        "normals_spread": None if of_normals is None else round(of_normals, 4),
        "caught": caught(faults),
        "by_kind": {
            kind: caught(e for e in faults if e.planned.kind == kind)
            for kind in dict.fromkeys(row["kind"] for row in rows)
        },
        "rows": rows,
        "normals_flagged": normals.to_json(),
        "first_asked": rate_of(e.is_left_open for e in counted if e.calibrates).to_json(),
        "smallest_leftover": None if smallest is None else smallest.to_json(),
        "no_smallest": f"{many}smallest leftover can be told." if left and smallest is None else "",
    }


def _seconds(deliveries: Sequence[JudgedDelivery]) -> dict[str, float | None]:
    """By the sidecar's clock: from one delivery to the next, and held for its verdict."""
    begun = [
        each.entry["keyframes"][0]["captured"] for each in deliveries if each.entry["keyframes"]
    ]
    holds = [sum(hold["seconds"] for hold in each.entry["holds"]) for each in deliveries]
    return {
        "per_delivery": round(float(np.median(np.diff(begun))), 2) if len(begun) > 1 else None,
        "held": round(float(np.median(holds)), 3) if holds else None,
    }


def _registration(store: Store, run: str, detector: Detector) -> dict[str, Any] | None:
    try:
        check = check_camera(store, run, detector)
    except ConfigurationError:
        return None
    if check.registration is None:
        return {"known": False, "error_px": None, "moved": False, "lacking": []}
    lacking = sorted({place.lacking for place in check.places if place.lacking})
    return {
        "known": True, "error_px": round(check.error_px, 2), "moved": bool(check.moved),
        "lacking": lacking,
    }  # fmt: skip


def _advice(
    camera: Mapping[str, Any], known: Mapping[str, Any] | None, liquids: Iterable[Mapping[str, Any]]
) -> list[str]:
    """What would help, a sentence each."""
    told = []
    missed, looked = camera["missed"]
    if missed > 0.02 * max(looked, 1):
        told.append(f"The tip was not found in {missed} of {looked} frames: aim the camera at it.")
    weak = []
    for liquid in liquids:
        smallest = liquid["smallest_leftover"]
        if smallest and (smallest["share"] is None or smallest["share"] > 0.25):
            weak.append(liquid["name"])
        if liquid["normals_flagged"]["hits"]:
            told.append(
                f"Normal wells of {liquid['name']} were flagged: keep lamps and camera still."
            )
        if liquid["first_asked"]["hits"]:
            told.append(
                f"First wells of {liquid['name']} were left to the operator. They are normal by "
                "plan: answer so on the page, or qualify with first_wells = trust."
            )
    scale, light = camera["px_per_mm"], camera["light"]
    if weak and scale:
        least = max(2 * scale, _COARSE_PX_PER_MM) if scale < _COARSE_PX_PER_MM else 1.5 * scale
        told.append(
            f"To see less of {' and '.join(weak)}: come closer (now {scale:.1f} px/mm, try "
            f"{least:.1f}), or dye it more strongly."
        )
    if weak and light is not None and not _DARK <= light <= _BRIGHT:
        told.append(
            f"A {'lighter' if light < _DARK else 'darker'}, grey panel behind the tips helps."
        )
    for part in (known or {}).get("lacking", ()):
        told.append(f"The {part} is out of view somewhere: aim anew, or look from another side.")
    if known and not known["known"]:
        told.append("The camera could not be registered: see aegis-ot aim.")
    if known and known["moved"]:
        told.append("The camera was moved during the run: fix it where it stands.")
    return told


def _changes(
    camera: Mapping[str, Any],
    previous: Mapping[str, Any] | None,
    plan: QualificationPlan,
    robot: str | None,
) -> list[str]:
    if previous is None:
        return []
    others = {
        "robot": previous["robot"] != robot,
        "pipette": (previous["pipette"], previous["mount"]) != (plan.pipette, plan.mount),
        "kind of tips": previous["tips"] != plan.tips,
    }
    if differing := " and ".join(f"another {name}" for name, differs in others.items() if differs):
        return [f"The last certificate is of {differing}: the cameras are not compared."]
    return changes(camera, previous["camera"])


def _hashes(deliveries: Sequence[JudgedDelivery], store: Store, run: str) -> dict[str, Any]:
    hashes: dict[str, str] = {}
    for each in deliveries:
        for keyframe in each.entry["keyframes"]:
            try:
                jpeg = store.frame(run, int(keyframe["sequence"]))
            except StoreError:
                jpeg = None
            hashes[str(keyframe["sequence"])] = hashlib.sha256(jpeg).hexdigest() if jpeg else ""
    whole = hashlib.sha256("\n".join(hashes.values()).encode()).hexdigest()
    return {"frames": len(hashes), "frames_sha256": whole, "frame_sha256": hashes}


def _told(each: JudgedDelivery) -> dict[str, Any]:
    judged = each.entry["judged"] or {}
    return {
        "well": each.planned.well, "liquid": each.planned.liquid, "kind": each.planned.kind,
        "share": each.planned.share, "calibrates": each.calibrates, "counted": each.is_counted,
        "outcome": each.outcome, "failure": judged.get("failure"),
        "reason": judged.get("reason", ""), "score": judged.get("score"),
    }  # fmt: skip
