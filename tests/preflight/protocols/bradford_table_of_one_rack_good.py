# expect: bradford pass BRD-1!
metadata = {"protocolName": "Bradford, membrane fractions", "apiLevel": "2.15"}

CALIBRATORS = """
spot;mg_per_ml
A1;0
A2;0.15
A3;0.4
A4;0.9
A5;1.6
"""


def run(protocol):
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 4)
    cal_plate = protocol.load_labware("nest_96_wellplate_200ul_flat", 2)
    samples = protocol.load_labware("nest_96_wellplate_200ul_flat", 3, "membrane samples")
    reader = protocol.load_labware("corning_96_wellplate_360ul_flat", 5)
    dye = protocol.load_labware("nest_12_reservoir_15ml", 6, "Bradford dye")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    wells = [cal_plate[row.split(";")[0]] for row in CALIBRATORS.split()[1:]]
    for column in reader.columns()[:2]:
        p20.pick_up_tip()
        for source, well in zip(wells, column):
            p20.aspirate(6, source)
            p20.dispense(6, well)
        p20.drop_tip()
    for source, well in zip(samples.rows()[0][:6], reader.columns()[2]):
        p20.transfer(6, source, well)
    for well in reader.columns()[0][:5] + reader.columns()[1][:5] + reader.columns()[2][:6]:
        p300.transfer(194, dye, well, mix_after=(3, 100))
