# expect: bradford pass
metadata = {"protocolName": "Bradford, BSA made on the deck", "apiLevel": "2.13"}

TOP = 1600
MADE = {"B1": 200, "B2": 400, "B3": 800}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "2", "standards")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "3", "Bradford plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", "4", "Coomassie reagent")["A1"]
    bsa, water = rack["A1"], rack["A6"]

    p300.pick_up_tip()
    for name, level in MADE.items():
        p300.transfer(400 * (1 - level / TOP), water, rack[name], new_tip="never")
    p300.drop_tip()
    for name, level in MADE.items():
        p300.transfer(400 * level / TOP, bsa, rack[name], mix_after=(6, 200))

    # on the plate: blank, 200 ... 1600
    curve = [water, *(rack[name] for name in MADE), bsa]
    for column in plate.columns()[:2]:
        p300.pick_up_tip()
        for tube, well in zip(curve, column):
            p300.aspirate(20, tube)
            p300.dispense(20, well)
        p300.drop_tip()
    for column in plate.columns()[:2]:
        p300.transfer(200, dye, column[:5], mix_after=(3, 120), new_tip="always")
