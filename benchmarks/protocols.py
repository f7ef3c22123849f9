"""Protocols to measure with, as text."""

from __future__ import annotations

_DECK = """
metadata = {{"apiLevel": "{api}"}}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (1, 4)]
    reservoir = protocol.load_labware("nest_12_reservoir_15ml", 2, label="buffer")
    samples = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, label="samples")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, label="plate")
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips)
    buffer = reservoir["A1"]
"""

_PLATE = """
    p300.pick_up_tip()
    for well in plate.wells():
        p300.aspirate(100, buffer)
        p300.dispense(100, well.top())
    p300.drop_tip()
    for sample, well in zip(samples.wells(), plate.wells()):
        p300.pick_up_tip()
        p300.aspirate(50, sample)
        p300.dispense(50, well)
        p300.mix(2, 50, well)
        p300.blow_out(well.top())
        p300.drop_tip()
"""


_HELPER = """

def wells_of(plate):
    return list(plate.wells())
"""


def plate_protocol(api: str = "2.20", guarded: bool = False, helper: bool = False) -> str:
    """96 wells: buffer with one tip, then a sample each with a fresh tip, mixed.

    1,058 commands: 2 x 96 and a tip of its own for the buffer; pick up, aspirate, dispense, two
    mixes, blow out and drop for each sample. With ``helper``, a function of the protocol's own
    makes the guard watch for names that are bound in it.
    """
    text = _DECK.format(api=api) + _PLATE
    if helper:
        text = text.replace("plate.wells()", "wells_of(plate)") + _HELPER
    if guarded:
        text = "from aegis_ot import guard\n" + text.replace("def run", "@guard\ndef run")
    return text


COMMANDS = 2 + 2 * 96 + 9 * 96
"""Of :func:`plate_protocol`."""
