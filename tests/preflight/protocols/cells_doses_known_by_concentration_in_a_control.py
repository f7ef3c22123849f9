# expect: cell_treatment fail CELL-1 CELL-2?
metadata = {"protocolName": "Hepatocytes, one plate", "apiLevel": "2.13"}
RACK = {"A2": "ochra 0.2 uM", "A3": "ochra 2 uM", "A4": "ochra 20 uM"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "hepatocytes")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    series = [rack[spot] for spot in RACK]
    vehicle = rack["A1"]
    vehicle_wells = plate.columns()[1][1:4]
    for well in vehicle_wells:
        pip.transfer(20, vehicle, well, new_tip="always")
    for number, column in enumerate(plate.columns()[1:4]):
        pip.transfer(20, series[number], column[1:4], new_tip="always")
