"""The protocol of a qualification: plain deliveries, a fresh tip each, and faults beneath."""

from __future__ import annotations

from importlib.resources import files
from typing import Any

from .plan import QualificationPlan

API_LEVEL = "2.16"

GUARD = {"on_fail": "continue", "on_undecided": "continue", "on_link_loss": "abort", "recover": {}}
"""A qualification goes on after what it planted, and nothing puts that right, whatever else the
robot is set to; without a sidecar it is worth nothing."""


def protocol_text(plan: QualificationPlan, settings: dict[str, Any] | None = None) -> str:
    """The protocol as a file for the Opentrons App.

    Args:
        plan: What it does.
        settings: Of its guard, besides those that a qualification needs.
    """
    from .. import __version__

    slots = ("D1", "D2", "D3") if plan.is_flex else ("1", "2", "3")
    counts = {
        liquid: sum(each.liquid == liquid for each in plan.deliveries) for liquid in plan.liquids
    }
    filled = min(1.15 * max(counts.values()) * plan.volume_ul + 1500.0, 15_000.0)
    fill = ", ".join(
        f"{filled / 1000:.1f} mL of {liquid} in A{place}" for place, liquid in enumerate(counts, 1)
    )
    text = (files(__package__) / "templates" / "protocol.txt").read_text("utf-8")
    return text.format(
        mark=plan.mark, version=__version__, pipette=plan.pipette, mount=plan.mount, tips=plan.tips,
        count=len(plan.deliveries), volume=plan.volume_ul, slots=slots, fill=fill,
        robot="Flex" if plan.is_flex else "OT-2", level=API_LEVEL, plan=plan.to_json(),
        settings=", ".join(f"{k}={v!r}" for k, v in (GUARD | (settings or {})).items()),
        filled=filled,
        trash='    protocol.load_trash_bin("A3")\n' if plan.is_flex else "",
        liquids=[(name, "#3355cc", count) for name, count in counts.items()],
    )  # fmt: skip
