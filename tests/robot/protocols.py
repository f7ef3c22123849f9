"""Protocols that the tests of this room upload."""

GOOD = """
metadata = {"apiLevel": "2.15", "protocolName": "Good"}

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    protocol.comment("hello")
    pipette.transfer(50, plate.wells()[:2], plate.wells()[8:10])
"""
PAUSES = (
    GOOD
    + """    protocol.pause("Take the lid off.")
    protocol.comment("after the pause")
"""
)
WAITS = (
    GOOD
    + """    for _ in range(100):
        protocol.delay(0.2)
"""
)
BAD = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    raise ValueError("no such thing")
"""
