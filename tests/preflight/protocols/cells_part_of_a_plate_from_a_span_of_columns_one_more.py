# expect: cell_treatment fail CELL-1
"""Screen of four fragments, one a row, on Vero cells; the edge stays empty.

      2-6    7      8
B     frag   veh    med
C     frag   veh    med
D     frag   veh    med
E     frag   veh    med

frag = fragment, 50 uM; veh = vehicle; med = medium only
"""

metadata = {"protocolName": "Fragments, Vero cells", "apiLevel": "2.13"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "Vero cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 4)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    dmso, fragments = rack["D6"], rack.columns()[0]

    for row, fragment in zip("BCDE", fragments):
        wells = plate.rows_by_name()[row]
        p20.transfer(5, fragment, wells[1:7], new_tip="always")
        p20.transfer(5, dmso, wells[6])
