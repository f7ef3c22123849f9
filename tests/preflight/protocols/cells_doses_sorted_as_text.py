# expect: cell_treatment fail CELL-4
metadata = {"protocolName": "Cardiomyocytes, isoprenaline", "apiLevel": "2.13"}
DRUG_NM = {"5": ("B1", 3), "50": ("B2", 4), "500": ("B3", 5)}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "cardiomyocyte cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    drug = {dose: tubes[tube] for dose, (tube, _) in DRUG_NM.items()}
    vehicle, vehicle_wells = tubes["A1"], plate.columns()[1][1:5]
    pip.transfer(10, vehicle, vehicle_wells, new_tip="always")
    pip.pick_up_tip()
    for dose in sorted(DRUG_NM, reverse=True):
        for letter in "BCDE":
            pip.transfer(10, drug[dose], plate[f"{letter}{DRUG_NM[dose][1]}"], new_tip="never")
    pip.drop_tip()
