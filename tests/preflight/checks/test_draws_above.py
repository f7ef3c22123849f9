"""A tip that draws from above the liquid draws air, unless that is meant."""

from __future__ import annotations

import pytest

from .test_handling import found, ot2, told

FILLED = """
buffer = ctx.define_liquid("buffer", "", "#0000ff")
deep["A1"].load_liquid(buffer, {declared})
pip.pick_up_tip()
"""
"""60 mm² of a deep well: 600 µL stand about 9 mm high."""


def drawn(code: str, declared: int = 1500) -> str:
    return told(ot2(FILLED.format(declared=declared) + code, "2.14"), "HND-5")


def test_a_fixed_height_while_the_well_runs_low() -> None:
    message = drawn(
        "for well in plate.wells()[:6]:\n"
        "    pip.aspirate(200, deep['A1'].bottom(15))\n"
        "    pip.dispense(200, well.top())"
    )
    assert message.startswith("warning: 200 µL are drawn from A1 of")
    assert "the tip 15 mm above its bottom, and the 500 µL that are left, as declared" in message
    assert message.endswith("it draws air. Aim lower.")


def test_one_statement_is_one_finding() -> None:
    code = (
        "for well in plate.wells()[:6]:\n"
        "    pip.aspirate(100, deep['A1'].bottom(25))\n"
        "    pip.dispense(100, well.top())"
    )
    (finding,) = found(ot2(FILLED.format(declared=900) + code, "2.14"), "HND-5")
    assert finding.message.endswith("Aim lower.")


def test_what_the_run_itself_has_filled() -> None:
    message = drawn(
        "pip.transfer(100, deep['A1'], deep['B1'], new_tip='never')\n"
        "pip.transfer(20, trough['A1'], plate['B1'], new_tip='never')\n"
        "pip.aspirate(50, deep['B1'].bottom(20))\n"
        "pip.dispense(50, plate['A1'].top())"
    )
    assert "50 µL are drawn from B1" in message
    assert "declared" not in message


@pytest.mark.parametrize(
    ("code", "why"),
    [
        ("pip.aspirate(200, deep['A1'].bottom(15))", "the liquid reaches so high"),
        ("pip.aspirate(20, deep['A1'].top())\npip.aspirate(100, deep['A1'])", "air from the mouth"),
        ("pip.aspirate(20, deep['A1'].top(-5))\npip.aspirate(100, deep['A1'])", "air comes first"),
        ("pip.aspirate(100, deep['A1'])\npip.aspirate(20, deep['A1'].top(-5))", "air comes last"),
        ("pip.aspirate(100, deep['A1'])\npip.aspirate(20, deep['B1'].top(-5))", "on its way"),
        ("pip.aspirate(100, deep['B1'].bottom(15))", "nobody says how much stands there"),
        ("pip.aspirate(100, plate['A1'])", "a usual height over little liquid"),
    ],
)
def test_what_reaches_the_liquid_or_is_air_on_purpose(code: str, why: str) -> None:
    assert not drawn(f"{code}\npip.dispense(10, plate['H12'].top())"), why


@pytest.mark.parametrize("pause", ["Refill the deep well plate", "Replace the deep well plate"])
def test_after_a_refill_by_hand_nobody_knows_the_level(pause: str) -> None:
    code = (
        "pip.transfer(200, deep['A1'], plate['A1'], new_tip='never')\n"
        f"ctx.pause({pause!r})\n"
        "pip.aspirate(50, deep['A1'].bottom(25))\n"
        "pip.dispense(50, plate['B1'].top())"
    )
    assert not drawn(code, declared=400)
