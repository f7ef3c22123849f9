"""The plan is opened after the run: what was planted, beside what the sidecar made of it, blind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..errors import ConfigurationError
from ..planted import NO_TIP, NORMAL
from ..run_view.overview import DeliveryEntry, RunOverview, last_keyframe
from ..sidecar.overview import run_overview
from ..sidecar.store import Store
from ..vision.tips import is_flex, pipette_class
from ..vocabulary import KeyframeKind, Outcome
from .plan import CALIBRATING, QualificationPlan, QualifyingDelivery


@dataclass(frozen=True)
class JudgedDelivery:
    """One delivery of a qualification.

    Attributes:
        planned: What was planted.
        calibrates: Whether it is one of the normal ones with which its liquid begins.
        entry: Of the run's overview.
    """

    planned: QualifyingDelivery
    calibrates: bool
    entry: DeliveryEntry

    @property
    def outcome(self) -> str:
        """As it was judged before any person decided; empty without a verdict."""
        return str((self.entry["judged"] or {}).get("outcome", ""))

    @property
    def is_counted(self) -> bool:
        """Whether it was judged on four timely frames."""
        frames = {k["kind"] for k in self.entry["keyframes"] if not k["late"]}
        return bool(self.outcome) and len(frames) == len(KeyframeKind)

    @property
    def is_flagged(self) -> bool:
        """Failed, or left to the operator."""
        return self.outcome != Outcome.PASS.value

    @property
    def is_left_open(self) -> bool:
        """A first well that the sidecar left to the operator: it tells of nothing but that."""
        return self.calibrates and self.outcome == Outcome.UNDECIDED.value

    @property
    def is_normal(self) -> bool:
        return self.planned.kind == NORMAL

    @property
    def boxes(self) -> Mapping[str, Sequence[float]]:
        """Where the tip was found, by keyframe: x, y, width and height, px."""
        found = self.entry["evidence"].get("boxes") or {}
        return {} if self.planned.kind == NO_TIP else {k: box for k, box in found.items() if box}


def open_plan(
    store: Store, run: str, plan: QualificationPlan
) -> tuple[list[JudgedDelivery], RunOverview]:
    """The deliveries of a run that ended, as far as it came, and its overview.

    Raises:
        ConfigurationError: The run did not deliver what the plan says, or nothing of it.
        StoreError: The store cannot be read.
    """
    overview = run_overview(store, run)
    if plan.mark not in str(overview.get("title", "")):
        raise ConfigurationError(
            f"Run {run} is no run of this plan ({plan.mark}): it calls itself "
            f"{overview.get('title') or 'nothing'!r}. Name the file that was run (--of), or "
            "another run (--run; aegis-ot runs list shows them)."
        )
    if not overview.get("finished"):
        raise ConfigurationError(f"Run {run} has not ended: its plan stays closed until then.")
    entries = sorted(overview["trajectories"], key=lambda entry: int(entry["trajectory"]))
    delivered: list[JudgedDelivery] = []
    counts: dict[str, int] = {}
    for planned, entry in zip(plan.deliveries, entries, strict=False):
        last = last_keyframe(entry)
        wells = [well["name"] for well in last.get("destinations") or ()]
        another = _sort_of(last.get("pipette", plan.pipette)) != _sort_of(plan.pipette)
        if another or (wells and wells != [planned.well]) or entry["trajectory"] != len(delivered):
            raise ConfigurationError(
                f"Run {run} is no run of this plan: delivery {len(delivered) + 1} went into "
                f"{', '.join(wells) or 'no well that was seen'} with a "
                f"{last.get('pipette', 'pipette')}, and the plan has {planned.well} with a "
                f"{plan.pipette}. Name the file that was run."
            )
        counts[planned.liquid] = counts.get(planned.liquid, 0) + 1
        delivered.append(JudgedDelivery(planned, counts[planned.liquid] <= CALIBRATING, entry))
    if not any(each.is_counted for each in delivered) or len(entries) > len(plan.deliveries):
        raise ConfigurationError(
            f"Run {run} has {len(entries)} deliveries of which none was judged, or more than the "
            f"{len(plan.deliveries)} of this plan. Name the file that was run."
        )
    return delivered, overview


def _sort_of(pipette: str) -> tuple[bool, str]:
    """Opentrons has several names of one pipette, by API level."""
    return is_flex(pipette), pipette_class(pipette)
