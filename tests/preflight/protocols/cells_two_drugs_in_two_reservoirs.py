# expect: cell_treatment fail CELL-4
"""Two compounds, each in a reservoir of its own, given with one set of tips."""

metadata = {"apiLevel": "2.13", "protocolName": "Drug treatment of HeLa cells"}


def run(protocol):
    m300 = protocol.load_instrument(
        "p300_multi_gen2",
        "left",
        tip_racks=[protocol.load_labware("opentrons_96_tiprack_300ul", 1)],
    )
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "HeLa cells")
    cisplatin = protocol.load_labware("nest_12_reservoir_15ml", 3, "drug cisplatin")
    paclitaxel = protocol.load_labware("nest_12_reservoir_15ml", 4, "drug paclitaxel")
    m300.pick_up_tip()
    for drug, columns in ((cisplatin, cells.rows()[0][:4]), (paclitaxel, cells.rows()[0][4:8])):
        for treated_well in columns:
            m300.aspirate(20, drug["A1"])
            m300.dispense(20, treated_well)
    m300.drop_tip()
