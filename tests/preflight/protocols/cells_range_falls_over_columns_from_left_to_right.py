# expect: cell_treatment warn CELL-4
# Etoposide on A549, 48 h
# source: columns 2-6 etoposide 30 uM down to 0.4 uM
#         column 12 vehicle (0.3 % DMSO)
metadata = {"apiLevel": "2.9", "author": "tox unit"}


def run(protocol):
    source = protocol.load_labware("nest_96_wellplate_2ml_deep", 5, "source")
    a549 = protocol.load_labware("corning_96_wellplate_360ul_flat", 6, "A549")
    rack = protocol.load_labware("opentrons_96_filtertiprack_20ul", 8)
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=[rack])

    m20.transfer(12, source["A12"], a549["A11"])
    m20.pick_up_tip()
    for i in range(1, 6):
        m20.aspirate(12, source.rows()[0][i])
        m20.dispense(12, a549.rows()[0][i])
    m20.drop_tip()
