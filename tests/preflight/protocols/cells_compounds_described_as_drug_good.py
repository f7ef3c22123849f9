# expect: cell_treatment pass CELL-4!
"""Two antivirals on Vero cells: row A remdesivir, row B ribavirin, columns 1-2 rising, column 3 vehicle."""

metadata = {"apiLevel": "2.15", "protocolName": "Antivirals on Vero cells"}


def run(protocol):
    plate = protocol.load_labware("corning_24_wellplate_3.4ml_flat", 1, "Vero cells")
    rack = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "compounds")
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", 3)
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    for row, compound in (("A", "remdesivir"), ("B", "ribavirin")):
        for number, dose in ((1, 5), (2, 50)):
            liquid = protocol.define_liquid(f"{compound} {dose} uM (20x)", "drug", "#8833BB")
            rack[f"{row}{number}"].load_liquid(liquid, 300)
    for row in "AB":
        p300.pick_up_tip()
        for number in (1, 2):
            p300.aspirate(50, rack[f"{row}{number}"])
            p300.dispense(50, plate[f"{row}{number}"])
        p300.drop_tip()
