# expect: bradford fail BRD-1
"""Membrane fractions, Bradford; the bovine gamma globulin comes in vials called by letters."""

requirements = {"robotType": "Flex", "apiLevel": "2.18"}

SET_B = dict(P=1500, Q=1000, R=500, S=250, T=100, U=0)  # ug/ml, see the leaflet


def run(protocol):
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "C1", "BGG, fractions")
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "C2")
    dye = protocol.load_labware("nest_1_reservoir_195ml", "D2", "Coomassie dye")["A1"]
    tips50 = protocol.load_labware("opentrons_flex_96_tiprack_50ul", "A1")
    tips1000 = protocol.load_labware("opentrons_flex_96_tiprack_1000ul", "B1")
    protocol.load_trash_bin("A3")
    p50 = protocol.load_instrument("flex_1channel_50", "left", tip_racks=[tips50])
    p1000 = protocol.load_instrument("flex_1channel_1000", "right", tip_racks=[tips1000])
    globulin = {letter: rack.rows()[0][i] for i, letter in enumerate(SET_B)}
    row_of = {letter: plate.rows()[i] for i, letter in enumerate(SET_B)}

    p50.pick_up_tip()
    for letter in "PQRSTU":
        for well in row_of[letter][:2]:
            p50.aspirate(10, globulin[letter])
            p50.dispense(10, well)
    p50.drop_tip()
    for tube, row in zip(rack.rows()[2], plate.rows()[:6], strict=True):
        p50.transfer(10, tube, row[3:5])
    for row in plate.rows()[:6]:
        p1000.transfer(240, dye, row[:2] + row[3:5], new_tip="always", mix_after=(2, 120))
