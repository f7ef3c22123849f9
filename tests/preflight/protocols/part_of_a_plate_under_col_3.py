# expect: cell_treatment pass
# Colchicine, imaging plate. Released above the wells, so that no tip gets wet.
#
#          col 4      col 5     col 6     col 7
#  row B   vehicle    10 nM     30 nM     90 nM
#  row C   vehicle    10 nM     30 nM     90 nM
#  row D   vehicle    10 nM     30 nM     90 nM

metadata = {"protocolName": "Colchicine on RPE1", "apiLevel": "2.13"}


def run(protocol):
    tips = protocol.load_labware("opentrons_96_filtertiprack_200ul", "1")
    p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    plate = protocol.load_labware("corning_96_wellplate_360ul_flat", "2", "RPE1")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", "3", "colchicine 4x")
    vehicle = tubes["A1"]
    for number, tube in enumerate([vehicle, tubes["A2"], tubes["A3"], tubes["A4"]], start=4):
        p300.pick_up_tip()
        p300.aspirate(150, tube)
        for row in "BCD":
            p300.dispense(50, plate[f"{row}{number}"].top())
        p300.drop_tip()
