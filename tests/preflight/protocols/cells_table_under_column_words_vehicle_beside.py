# expect: cell_treatment warn CELL-2
"""Antivirals on Vero cells, 24-well plate (slot 1).

            col 1        col 2        col 3      col 4
            5 uM         50 uM        vehicle    untreated
   row A    remdesivir   remdesivir   DMSO       -
   row B    ribavirin    ribavirin    DMSO       -

Rack (slot 2), 20x: row A remdesivir, row B ribavirin; columns 1-2 = 5, 50 uM; D1 DMSO (vehicle)
"""

metadata = {"apiLevel": "2.15", "protocolName": "Antivirals on Vero cells"}


def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "Vero cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "20x compounds")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])

    for row in "AB":
        p300.transfer(50, rack["D1"], plate[f"{row}{4}"])
        for column in (1, 2):
            p300.transfer(50, rack[f"{row}{column}"], plate[f"{row}{column}"])
