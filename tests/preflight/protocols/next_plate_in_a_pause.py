# expect: bradford pass
metadata = {"protocolName": "Bradford, two plates of samples", "apiLevel": "2.13"}


def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in ("1", "5")]
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3", "Bradford plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", "4", "Bradford reagent")["A1"]
    samples = [rack[name] for name in ("A1", "A2", "A3", "A4")]
    for number in (1, 2):
        p300.transfer(10, samples, plate.columns()[0][:4], new_tip="always")
        p300.transfer(200, dye, plate.columns()[0][:4], mix_after=(3, 100), new_tip="always")
        if number == 1:
            protocol.pause("Remove the plate, put the following one there and start again.")
