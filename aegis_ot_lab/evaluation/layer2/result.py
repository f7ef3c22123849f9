"""What an evaluation of Layer 2 found, and how it is written down."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from aegis_ot.vocabulary import KeyframeKind
from aegis_ot.worldmodel.leave_one_out import HeldOut, ScoredWell

from .answers import ModelAnswers
from .metrics import Interval, bootstrap


@dataclass(frozen=True)
class Share:
    """How many of how many."""

    caught: int
    total: int

    def to_json(self) -> dict[str, int]:
        return {"caught": self.caught, "total": self.total}

    def __str__(self) -> str:
        return f"{self.caught}/{self.total}"


@dataclass(frozen=True)
class Layer2Result:
    """Result of one scorer on one data set.

    Attributes:
        dataset: Name of the set.
        source: ``"rendered"``, ``"synthetic"``, ``"real"``: printed with every figure.
        scorer: Name of the scorer.
        protocol: ``"lopo"`` or ``"cascade"``.
        threshold: How the operating point was set.
        detector: What found the tips.
        metrics: By name, with 95 % intervals.
        wells: All scored wells but those labelled ``no_tip``.
        flagged: Decision for each of them.
        no_tip: Those labelled ``no_tip``: how many were flagged.
        routed: Fraction of wells sent to a gate, by ``"normals"``, ``"failures"``, ``"all"``.
        seed: Of the bootstrap.
        tips: In how many of the frames a tip was found; wells labelled ``no_tip`` left out.
        untipped: Plates in whose calibration well no tip was found.
        settled: For the cascade: how many wells each gate settled and how.
        leave_out: What the model that judged a plate never saw: that ``"plate"``, its ``"camera"``.
        cameras: Kind of camera by plate, where the set names them.
        model: How the cascade's model answered; ``None`` if there was none.
    """

    dataset: str
    source: str
    scorer: str
    protocol: str
    threshold: str
    detector: str
    metrics: Mapping[str, Interval]
    wells: Sequence[ScoredWell] = field(repr=False)
    flagged: Sequence[bool] = field(repr=False)
    no_tip: Share
    routed: Mapping[str, float]
    seed: int = 0
    tips: Share = Share(0, 0)
    untipped: Sequence[str] = ()
    settled: Mapping[str, int] = field(default_factory=dict)
    leave_out: str = "plate"
    cameras: Mapping[str, str] = field(default_factory=dict)
    model: ModelAnswers | None = None

    @property
    def flagged_normals(self) -> Share:
        """Flagged among the scored normals."""
        flags = [f for w, f in zip(self.wells, self.flagged, strict=True) if not w.failed]
        return Share(sum(flags), len(flags))

    def by(self, key: Callable[[ScoredWell], str], failed: bool = True) -> dict[str, Share]:
        """Flagged failures, or normals, by a property of the well."""
        groups: dict[str, list[bool]] = {}
        for well, flag in zip(self.wells, self.flagged, strict=True):
            if well.failed == failed:
                groups.setdefault(key(well), []).append(flag)
        return {name: Share(sum(flags), len(flags)) for name, flags in sorted(groups.items())}

    def per_failure_type(self) -> dict[str, Share]:
        return self.by(lambda well: well.sample.failure_type)

    def per_reagent(self) -> dict[str, Share]:
        return self.by(lambda well: well.sample.reagent or "unknown")

    def per_severity(self) -> dict[str, Share]:
        return self.by(severity)

    def per_camera(self, failed: bool = True) -> dict[str, Share]:
        """Flagged failures, or normals, by kind of camera; empty where the set names none."""
        if not self.cameras:
            return {}
        return self.by(lambda well: self.cameras.get(well.sample.plate, "unknown"), failed)

    def notes(self) -> list[str]:
        """What a reader must know of the figures: those that are not defined here, and why."""
        failures = sum(well.failed for well in self.wells)
        notes = []
        if not self.wells:
            notes.append("No well is left to score: every well calibrates its plate.")
        elif not failures:
            notes.append(
                "This set has no failures among the scored wells: average precision, AUROC and "
                "recall are not defined."
            )
        elif not self.flagged_normals.total:
            notes.append(
                "No normal well is left to score: AUROC is not defined, and nothing is known of "
                "false alarms."
            )
        if self.untipped:
            notes.append(
                f"No tip was found in the calibration well of {', '.join(self.untipped)}: nothing "
                "is known of the other wells there."
            )
        if failures and not any(self.flagged):
            notes.append("No well was flagged: precision is not defined.")
        if self.model is not None and self.model.note:
            notes.append(self.model.note)
        return notes

    def to_json(self) -> dict[str, Any]:
        """Plain values; the five metrics stand at the top level."""
        groups = {
            "per_failure_type": self.per_failure_type(),
            "per_reagent": self.per_reagent(),
            "per_severity": self.per_severity(),
            "per_camera": self.per_camera(),
            "flagged_normals_per_camera": self.per_camera(failed=False),
        }
        return {
            "dataset": self.dataset,
            "data": self.source,
            "scorer": self.scorer,
            "protocol": self.protocol,
            "leave_out": self.leave_out,
            "threshold": self.threshold,
            "detector": self.detector,
            "frames": {"total": self.tips.total, "with_tip": self.tips.caught},
            "seeds": {"bootstrap": self.seed},
            **{name: interval.to_json() for name, interval in self.metrics.items()},
            "wells": {
                "scored": len(self.wells),
                "normals": self.flagged_normals.total,
                "failures": sum(well.failed for well in self.wells),
            },
            "flagged_normals": self.flagged_normals.to_json(),
            "no_tip": self.no_tip.to_json(),
            "routed_fraction": {
                name: None if np.isnan(value) else round(value, 4)
                for name, value in self.routed.items()
            },
            "settled": dict(self.settled),
            "model": None if self.model is None else self.model.to_json(),
            "notes": self.notes(),
            **{
                name: {group: share.to_json() for group, share in shares.items()}
                for name, shares in groups.items()
            },
            "scores": [
                {
                    "id": well.sample.id,
                    "plate": well.sample.plate,
                    "well": well.sample.well,
                    "label": well.sample.label,
                    "failure_type": well.sample.failure_type,
                    "score": well.score,
                    "limit": well.limit,
                    "standing": well.standing,
                    "flagged": bool(flag),
                }
                for well, flag in zip(self.wells, self.flagged, strict=True)
            ],
        }

    def text(self) -> str:
        """A few lines for the terminal."""
        title = f"{self.scorer} on {self.dataset} ({self.source} frames), {self.protocol}"
        lines = [
            f"{title}, leaving one {self.leave_out} out, threshold {self.threshold}",
            f"  tips found         {self.tips} frames, by {self.detector}",
            *(
                f"  {name.replace('_', ' '):18} {interval}"
                for name, interval in self.metrics.items()
            ),
            f"  normals flagged    {self.flagged_normals}",
            *([f"  no tip flagged     {self.no_tip} (counted apart)"] if self.no_tip.total else []),
            "  sent to a gate     "
            + ", ".join(
                f"{name} {value:.0%}" for name, value in self.routed.items() if value == value
            ),
        ]
        for name, shares in (
            ("failure types", self.per_failure_type()),
            ("reagents", self.per_reagent()),
            ("retained", self.per_severity()),
            ("cameras", self.per_camera()),
            ("normals of them", self.per_camera(failed=False)),
        ):
            if shares:
                parts = ", ".join(f"{group} {share}" for group, share in shares.items())
                lines.append(f"  {name:18} {parts}")
        if self.settled:
            parts = ", ".join(
                f"{how.replace('_', ' ')} {count}" for how, count in sorted(self.settled.items())
            )
            lines.append(f"  {'settled by':18} {parts}")
        if self.model is not None:
            lines.append(f"  {'asked of a model':18} {self.model}")
        return "\n".join([*lines, *(f"  Note: {note}" for note in self.notes())])


def severity(well: ScoredWell) -> str:
    """Class of the fraction left in the tip."""
    retained = well.sample.retained_fraction
    if retained is None:
        return "unknown"
    for limit, name in ((0.25, "under 25 %"), (0.5, "25-50 %"), (0.75, "50-75 %")):
        if retained < limit:
            return name
    return "75 % and more"


def summarise(
    wells: Sequence[ScoredWell],
    flagged: Sequence[bool],
    routed: Sequence[bool],
    *,
    held: HeldOut,
    seed: int,
    settled: Mapping[str, int] | None = None,
    cameras: Mapping[str, str] | None = None,
    model: ModelAnswers | None = None,
    **names: str,
) -> Layer2Result:
    """Turn decisions on wells into a result; ``no_tip`` wells are counted apart."""
    triples = list(zip(wells, flagged, routed, strict=True))
    kept = [(w, f, r) for w, f, r in triples if not w.without_tip]
    failed = np.array([w.failed for w, _, _ in kept], dtype=bool)
    standing = np.array([w.standing for w, _, _ in kept], dtype=np.float64)
    flags = np.array([f for _, f, _ in kept], dtype=bool)
    sent = np.array([r for _, _, r in kept], dtype=bool)
    tipless = [f for w, f, _ in triples if w.without_tip]
    tips = [
        well.sample.detections[kind] is not None
        for well in (*held.anchors, *held.wells)
        if not well.without_tip
        for kind in KeyframeKind
    ]

    def share(mask: Any) -> float:
        return float(sent[mask].mean()) if mask.any() else float("nan")

    return Layer2Result(
        metrics=bootstrap(failed, standing, flags, seed=seed),
        wells=[w for w, _, _ in kept],
        flagged=flags.tolist(),
        no_tip=Share(sum(tipless), len(tipless)),
        routed={
            "normals": share(~failed),
            "failures": share(failed),
            "all": share(np.ones_like(failed)),
        },
        seed=seed,
        tips=Share(sum(tips), len(tips)),
        untipped=[anchor.sample.plate for anchor in held.anchors if anchor.tips_missing],
        settled=settled or {},
        cameras=cameras or {},
        model=model,
        **names,
    )
