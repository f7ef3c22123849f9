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
ON_MODULE = """
metadata = {"apiLevel": "2.15"}

def run(protocol):
    module = protocol.load_module("temperature module gen2", "4")
    module.load_labware("corning_96_wellplate_360ul_flat")
"""
CSV = """
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}

def add_parameters(parameters):
    parameters.add_csv_file("plan", "plan", "wells and volumes")

def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "3")
    pipette = protocol.load_instrument("p300_single_gen2", "left", [tips])
    for well, volume in protocol.params.plan.parse_as_csv():
        pipette.transfer(float(volume), trough["A1"], plate[well])
"""
FLEX = """
requirements = {"robotType": "Flex", "apiLevel": "2.20"}

def run(protocol):
    tips = protocol.load_labware("opentrons_flex_96_tiprack_200ul", "B2")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "C2")
    trough = protocol.load_labware("nest_12_reservoir_15ml", "C1")
    protocol.load_trash_bin("A3")
    pipette = protocol.load_instrument("flex_1channel_1000", "left", [tips])
    pipette.transfer(50, trough["A1"], plate.wells()[:2], new_tip="always")
"""
NEEDS_LIQUID = FLEX.replace(
    'pipette.transfer(50, trough["A1"], plate.wells()[:2], new_tip="always")',
    """pipette.pick_up_tip()
    pipette.aspirate(20, trough["A2"])
    pipette.dispense(20, plate["B1"])
    pipette.require_liquid_presence(trough["A1"])
    pipette.aspirate(50, trough["A1"])
    pipette.dispense(50, plate["A1"])
    pipette.drop_tip()""",
)
"""A simulated probe finds no liquid."""
