# expect: cell_treatment pass
"""Fibroblasts of patients with bosentan.

column      2      3      4      5      6      7
row B     patient 1
row C     patient 2
row D     patient 3
row H     undosed control in each column
"""

metadata = {"protocolName": "Bosentan on fibroblasts", "apiLevel": "2.13"}
DOSE_UM = {2: 0.1, 3: 0.3, 4: 1, 5: 3, 6: 10, 7: 30}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "fibroblasts")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "bosentan")
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    for number, column in enumerate(DOSE_UM):
        wells = plate.columns_by_name()[str(column)]
        p20.transfer(5, rack.rows()[0][number], wells[1:4], new_tip="always")
