# expect: cell_treatment pass
metadata = {"protocolName": "Sponge cells", "apiLevel": "2.13"}
COLUMNS = {"vehicle": 7, "drug": 8}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "sponge cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    solvent, drug = tubes["A1"], tubes["A6"]
    for row in "CDEF":
        pip.transfer(10, solvent, plate[f"{row}{COLUMNS['vehicle']}"], new_tip="always")
        pip.transfer(10, drug, plate[f"{row}{COLUMNS['drug']}"], new_tip="always")
