"""The protocol of a qualification: plain deliveries, a fresh tip each, and faults beneath."""

from __future__ import annotations

from typing import Any

from .plan import QualificationPlan, settings_text

API_LEVEL = "2.16"

GUARD = {"on_fail": "continue", "on_undecided": "continue", "on_link_loss": "abort", "recover": {}}
"""A qualification goes on after what it planted, and nothing puts that right, whatever else the
robot is set to; without a sidecar it is worth nothing."""

_TEXT = '''"""Qualification of the {pipette} on the {mount} mount, written by aegis-ot {version}.

{count} deliveries of {volume:g} µL with a fresh tip each. In some of them the pipette fails on
purpose: @planted does it, as PLAN says, beneath the guard, which judges blind. What fails stays in
tip, plate and trash. Do not read PLAN before the run is over, and put nothing of value on the deck.

Deck: {tips} in {slots[0]}, nest_12_reservoir_15ml in {slots[1]} ({fill}),
an empty corning_96_wellplate_360ul_flat in {slots[2]}.
"""

from aegis_ot import guard
from aegis_ot.planted import planted

metadata = {{"protocolName": "Qualification of {pipette}, {mount} ({mark})"}}
requirements = {{"robotType": "{robot}", "apiLevel": "{level}"}}

PLAN = {plan!r}


@planted(PLAN)
@guard({settings})
def run(protocol):
    tips = protocol.load_labware("{tips}", "{slots[0]}")
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", "{slots[1]}")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "{slots[2]}")
{trash}    pipette = protocol.load_instrument("{pipette}", "{mount}", [tips])
    wells = iter(plate.wells())
    for place, (name, colour, count) in enumerate({liquids}):
        source = reservoir.wells()[place]
        liquid = protocol.define_liquid(name, "", colour)
        source.load_liquid(liquid, {filled:.0f})
        for _ in range(count):
            pipette.pick_up_tip()
            pipette.aspirate({volume:g}, source)
            pipette.dispense({volume:g}, next(wells))
            pipette.drop_tip()
'''


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
    return _TEXT.format(
        mark=plan.mark, version=__version__, pipette=plan.pipette, mount=plan.mount, tips=plan.tips,
        count=len(plan.deliveries), volume=plan.volume_ul, slots=slots, fill=fill,
        robot="Flex" if plan.is_flex else "OT-2", level=API_LEVEL, plan=plan.to_json(),
        settings=settings_text(GUARD | (settings or {})), filled=filled,
        trash='    protocol.load_trash_bin("A3")\n' if plan.is_flex else "",
        liquids=[(name, "#3355cc", count) for name, count in counts.items()],
    )  # fmt: skip
