# expect: cell_treatment pass
from dataclasses import dataclass

metadata = {"apiLevel": "2.15"}


@dataclass(frozen=True)
class Layout:
    vehicle_control: tuple = (1, 2)
    treated: tuple = (3, 4, 5)
    untreated_control: tuple = (6,)


PLAN = Layout()


def run(ctx):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 1, "Jurkat cells")
    drugs = ctx.load_labware("nest_96_wellplate_2ml_deep", 2, "drug doses")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 4)
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", 3)
    m300 = ctx.load_instrument("p300_multi_gen2", "left", tip_racks=[tips])
    medium, vehicle = trough["A1"], trough["A2"]

    def column(plate, n):
        return plate[f"A{n}"]

    for n in PLAN.vehicle_control:
        m300.transfer(20, vehicle, column(cells, n), new_tip="always")
    for n in PLAN.treated:
        m300.transfer(20, column(drugs, n), column(cells, n), new_tip="always")
    for n in PLAN.vehicle_control + PLAN.treated + PLAN.untreated_control:
        m300.transfer(50, medium, column(cells, n).top(), new_tip="always")
