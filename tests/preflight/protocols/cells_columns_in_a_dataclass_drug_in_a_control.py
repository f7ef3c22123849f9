# expect: cell_treatment fail CELL-1
from dataclasses import dataclass

metadata = {"protocolName": "Zebrafish embryos in a plate", "apiLevel": "2.13"}


@dataclass
class Layout:
    vehicle: int = 2
    drug: int = 4


layout = Layout()


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "embryos")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    solvent, drug = tubes["A1"], tubes["A6"]
    for row in "BCDE":
        pip.transfer(10, solvent, plate[f"{row}{layout.vehicle}"], new_tip="always")
        pip.transfer(10, drug, plate[f"{row}{layout.vehicle}"], new_tip="always")
