# expect: bradford pass BRD-1!
"""Bradford with fresh standards.

Rack "standards" (slot 1)
    A1 BSA 2000 ug/ml (top standard), A2 dilution buffer (blank)
    B1-B3 empty tubes for 250, 500 and 1000 ug/ml
"""

metadata = {"apiLevel": "2.17", "protocolName": "Bradford, fresh standards"}
LEVELS = {"B1": 250, "B2": 500, "B3": 1000}


def run(protocol):
    rack = "opentrons_24_tuberack_nest_1.5ml_snapcap"
    standards = protocol.load_labware(rack, 1, "standards")
    antibodies = protocol.load_labware(rack, 2, "antibodies")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "Bradford plate")
    reagent = protocol.load_labware("nest_12_reservoir_15ml", 4, "reagent")["A1"]
    small = protocol.load_labware("opentrons_96_tiprack_20ul", 5)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 6)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    bsa, buffer = standards["A1"], standards["A2"]

    for name, level in LEVELS.items():
        p300.transfer(400 * (1 - level / 2000), buffer, standards[name])
    for name, level in LEVELS.items():
        p300.transfer(400 * level / 2000, bsa, standards[name], mix_after=(8, 250))
    curve = [buffer, *[standards[name] for name in LEVELS], bsa]
    p20.transfer(10, curve, plate.columns()[0][:5], new_tip="once")
    p20.transfer(10, antibodies.rows()[0][:3], plate.columns()[1][:3], new_tip="always")
    wells = plate.columns()[0][:5] + plate.columns()[1][:3]
    p300.transfer(200, reagent, wells, mix_after=(3, 100), new_tip="always")
