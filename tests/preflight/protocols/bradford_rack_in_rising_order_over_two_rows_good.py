# expect: bradford pass BRD-1!
"""Bradford of fractions.

3  plate: A1-A8 BSA 0 (blank), 100, 200, 300, 400, 600, 800, 1000 ug/ml; B1-B4 fractions
2  tube rack: A1-B2 BSA in rising order; B3-B6 fractions
"""

metadata = {"apiLevel": "2.14", "protocolName": "Bradford, fractions"}
CURVE = dict(zip(("A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8"), (0, 100, 200, 300, 400, 600, 800, 1000)))
CURVE_TUBES = ["A1", "A2", "A3", "A4", "A5", "A6", "B1", "B2"]


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "proteins")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 5, "dye reagent")["A1"]
    tips = protocol.load_labware("opentrons_96_tiprack_20ul", 6)
    large = protocol.load_labware("opentrons_96_tiprack_300ul", 7)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])

    p20.pick_up_tip()
    for tube, (well, _) in zip(CURVE_TUBES, CURVE.items()):
        p20.aspirate(10, rack[tube])
        p20.dispense(10, plate[well])
    p20.drop_tip()
    for at in range(4):
        p20.transfer(10, rack.rows()[1][2 + at], plate.rows()[1][at])
    for well in plate.rows()[0][:8] + plate.rows()[1][:4]:
        p300.transfer(190, dye, well, mix_after=(3, 100))
