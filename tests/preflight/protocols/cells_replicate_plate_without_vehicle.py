# expect: cell_treatment fail CELL-2
metadata = {"protocolName": "etoposide, two copies", "apiLevel": "2.13"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 1)
    copies = [
        ctx.load_labware("corning_96_wellplate_360ul_flat", slot, f"U2OS copy {n}")
        for n, slot in enumerate((2, 3), 1)
    ]
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 5)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle, etoposide = tubes["A1"], tubes["A2"]
    vehicle_controls = copies[0].columns()[0]
    p20.transfer(5, vehicle, vehicle_controls, new_tip="once")
    for plate in copies:
        for column in plate.columns()[1:4]:
            p20.transfer(5, etoposide, column, new_tip="once")
