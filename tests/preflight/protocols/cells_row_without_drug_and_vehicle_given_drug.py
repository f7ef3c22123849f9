# expect: cell_treatment warn CELL-1
"""Antiviral assay on Vero cells (slot 2).

    row A   vehicle, columns 1-6        row B   no drug, no vehicle (1-6)
    row C   remdesivir 1 uM             (columns 1-6 each)
Drug block (slot 6): A1 1 uM, C1 vehicle
"""

metadata = {"apiLevel": "2.15", "protocolName": "Antiviral assay"}


def run(protocol):
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2, "Vero cells")
    block = protocol.load_labware("opentrons_24_aluminumblock_nest_2ml_screwcap", 6, "drug block")
    medium = protocol.load_labware("nest_12_reservoir_15ml", 5, "overlay medium")["A1"]
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 1)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    p300.transfer(25, block["C1"], plate.rows()[0][:6], new_tip="once")
    p300.transfer(25, block["A1"], plate.rows()[2][:6] + plate.rows()[1][:1], new_tip="once")
    for row in plate.rows()[:3]:
        p300.distribute(50, medium, [well.top() for well in row[:6]], disposal_volume=0)
