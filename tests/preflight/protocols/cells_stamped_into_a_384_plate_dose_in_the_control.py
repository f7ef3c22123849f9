# expect: cell_treatment warn CELL-1
# Stamp one dose plate into the four quadrants of a 384 plate of HT-29 cells.
# dose plate: columns 1-11 SN-38, column 12 vehicle (DMSO)
metadata = {"apiLevel": "2.13", "protocolName": "SN-38, quadruplicates"}


def run(protocol):
    doses = protocol.load_labware("nest_96_wellplate_200ul_flat", 1, "dose plate")
    cells = protocol.load_labware("corning_384_wellplate_112ul_flat", 2, "HT-29 cells")
    boxes = [protocol.load_labware("opentrons_96_filtertiprack_20ul", s) for s in (4, 5)]
    m20 = protocol.load_instrument("p20_multi_gen2", "left", tip_racks=boxes)

    for n, column in enumerate(doses.columns()):
        m20.pick_up_tip()
        for target in (*cells.columns()[2 * n][:2], *cells.columns()[2 * n + 1][:2]):
            m20.transfer(5, column[0], target, new_tip="never")
        m20.drop_tip()
    # the tips of column 11 did not fill: again
    m20.transfer(5, doses["A11"], cells["A23"])
