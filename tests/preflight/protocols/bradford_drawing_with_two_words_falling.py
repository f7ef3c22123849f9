# expect: bradford fail BRD-1
metadata = {"protocolName": "Bradford of column fractions", "apiLevel": "2.13"}

# layout of the read plate (BSA in ug/ml)
#          1          2          3        4
#  A    V1 1500    V1 1500     fr 7     fr 7
#  B    V2  750    V2  750     fr 8     fr 8
#  C    V3  300    V3  300     fr 9     fr 9
#  D    V4   60    V4   60     fr 10    fr 10
#  E    blank      blank       fr 11    fr 11
TUBES = {"V1": "B1", "V2": "B2", "V3": "B3", "V4": "B4", "blank": "B5"}
FRACTIONS = {"fr 7": "D1", "fr 8": "D2", "fr 9": "D3", "fr 10": "D4", "fr 11": "D5"}


def run(protocol):
    small = protocol.load_labware("opentrons_96_filtertiprack_20ul", 1)
    large = protocol.load_labware("opentrons_96_filtertiprack_200ul", 4)
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 3, "read plate")
    dye = protocol.load_labware("nest_12_reservoir_15ml", 5, "Bradford reagent")["A1"]
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[small])
    p300 = protocol.load_instrument("p300_single_gen2", "right", tip_racks=[large])
    for column in plate.columns()[:2]:
        p20.pick_up_tip()
        for tube, well in zip(TUBES.values(), column[:5]):
            p20.aspirate(8, rack[tube])
            p20.dispense(8, well)
        p20.drop_tip()
    for tube, row in zip(FRACTIONS.values(), plate.rows()):
        for well in row[2:4]:
            p20.transfer(8, rack[tube], well)
    for row in plate.rows()[:5]:
        for well in row[:4]:
            p300.transfer(190, dye, well, mix_after=(3, 100))
