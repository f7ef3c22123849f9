# expect: cell_treatment fail CELL-1
# Primary hepatocytes. PLATE: B2-B6 apocynin, C2-C6 vehicle controls

metadata = {"protocolName": "Hepatocytes, overnight", "apiLevel": "2.12"}


def run(ctx):
    hepatocytes = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "hepatocyte plate")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 7)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])

    apocynin = rack["A1"]
    dmso = rack["A3"]
    vehicle_controls = hepatocytes.rows_by_name()["C"][1:6]

    p20.pick_up_tip()
    for well in vehicle_controls:
        p20.transfer(6, dmso, well, new_tip="never")
    for well in hepatocytes.rows_by_name()["B"][1:6] + vehicle_controls[-1:]:
        p20.transfer(6, apocynin, well, new_tip="never")
    p20.drop_tip()
