# expect: bradford pass BRD-1!
from opentrons import protocol_api

metadata = {"protocolName": "Bradford, whey", "apiLevel": "2.13"}

bgg_curve = [(0, "A1"), (125, "A2"), (250, "A3"), (500, "A4"), (1000, "A5")]  # ug/ml, tube


def run(protocol: protocol_api.ProtocolContext):
    tips = [protocol.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (1, 4)]
    tips300 = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=tips)
    p300 = protocol.load_instrument("p300_multi_gen2", "right", tip_racks=[tips300])
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "BGG")
    whey = protocol.load_labware("nest_96_wellplate_2ml_deep", 3, "whey samples")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 5, "reading plate")
    dye = protocol.load_labware("axygen_1_reservoir_90ml", 6, "bradford dye")["A1"]

    for column in (1, 2):
        order = list(zip(bgg_curve, "ABCDE"))
        p20.pick_up_tip()
        for (amount, tube), letter in order:
            p20.aspirate(5, rack[tube])
            p20.dispense(5, plate[f"{letter}{column}"])
        p20.drop_tip()
    p20.transfer(5, whey.columns()[0], plate.columns()[2], new_tip="always")
    for column in plate.columns()[:3]:
        p300.transfer(245, dye, column[0], mix_after=(3, 150), new_tip="always")
