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
WITH_INPUTS = """
requirements = {"robotType": "OT-2", "apiLevel": "2.18"}

def add_parameters(parameters):
    parameters.add_int("wells", "wells", default=1, minimum=1, maximum=8)

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("my_plate", "2", namespace="my_lab", version=2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    for well in plate.columns()[0][: protocol.params.wells]:
        pipette.transfer(50, trough["A1"], well)
"""
