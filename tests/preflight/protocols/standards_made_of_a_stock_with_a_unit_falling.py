# expect: bradford fail BRD-1
metadata = {"protocolName": "Bradford, standards made here", "apiLevel": "2.14"}
STOCK_UL = [20, 50, 100, 160]

def run(protocol):
    tips = [protocol.load_labware("opentrons_96_tiprack_300ul", slot) for slot in (7, 8)]
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=tips)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
    trough = protocol.load_labware("nest_12_reservoir_15ml", 3)
    bsa_stock_2mg_ml = rack["A1"]
    standards = rack.rows()[1][:4]
    buffer, dye = trough["A1"], trough["A2"]
    lysates = rack.rows()[3][:3]
    p300.pick_up_tip()
    for volume, tube in zip(STOCK_UL, standards):
        p300.transfer(200 - volume, buffer, tube, new_tip="never")
    p300.drop_tip()
    for volume, tube in zip(STOCK_UL, standards):
        p300.transfer(volume, bsa_stock_2mg_ml, tube, mix_after=(3, 100))
    for column in plate.columns()[:2]:
        p300.pick_up_tip()
        for tube, well in zip([bsa_stock_2mg_ml, *standards], column):
            p300.aspirate(20, tube)
            p300.dispense(20, well)
        p300.drop_tip()
    for tube, well in zip(lysates, plate.columns()[3]):
        p300.transfer(20, tube, well)
    for well in plate.columns()[0][:5] + plate.columns()[1][:5] + plate.columns()[3][:3]:
        p300.transfer(200, dye, well, mix_after=(3, 150))
