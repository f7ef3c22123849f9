# expect: cell_treatment fail CELL-4
metadata = {"protocolName": "Microglia", "apiLevel": "2.13"}
DRUG_COLUMNS = {"2": [3], "4": [4], "8": [5]}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    stock = ctx.load_labware("nest_96_wellplate_2ml_deep", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "microglia cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle, vehicle_wells = stock["A1"], plate.columns()[0][:4]
    pip.transfer(30, vehicle, vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for dose in sorted(DRUG_COLUMNS, reverse=True):
        for number in DRUG_COLUMNS[dose]:
            for letter in "ABCD":
                drug = stock[f"A{number}"]
                pip.transfer(30, drug, plate[f"{letter}{number}"], new_tip="never")
    pip.drop_tip()
