# expect: serial_dilution pass
from collections import namedtuple

metadata = {"protocolName": "Antibiotic dilution series", "apiLevel": "2.15"}
Ladder = namedtuple("Ladder", "name stock diluent wells")


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", s) for s in (1, 4)]
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_1.5ml_snapcap", 2)
    bottles = protocol.load_labware("opentrons_6_tuberack_falcon_50ml_conical", 5)
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 3)
    p = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    ladders = [
        Ladder("ampicillin", block["A1"], bottles["A1"], plate.rows()[0][:6]),
        Ladder("colistin", block["A2"], bottles["B1"], plate.rows()[1][:6]),
    ]
    for ladder in ladders:
        p.transfer(100, ladder.diluent, ladder.wells[1:], new_tip="once")
    for ladder in ladders:
        p.transfer(150, ladder.stock, ladder.wells[0])
        for left, right in zip(ladder.wells, ladder.wells[1:]):
            p.transfer(50, left, right, mix_after=(4, 80), new_tip="always")
