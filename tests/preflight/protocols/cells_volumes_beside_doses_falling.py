# expect: cell_treatment fail CELL-4
metadata = {"protocolName": "Neutrophils", "apiLevel": "2.13"}
TUBES = {"A2": ("drug 2 uM", 30), "A3": ("drug 20 uM", 20), "A4": ("drug 200 uM", 10)}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "neutrophils")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle, vehicle_wells = tubes["A1"], plate.columns()[0][:4]
    pip.transfer(30, vehicle, vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for number, (spot, (_, volume)) in enumerate(reversed(TUBES.items())):
        for well in plate.columns()[number + 1][:4]:
            pip.transfer(volume, tubes[spot], well, new_tip="never")
    pip.drop_tip()
