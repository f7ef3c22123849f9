# expect: cell_treatment pass CELL-4!
import json

metadata = {"protocolName": "Vorinostat, K562 cells", "apiLevel": "2.13"}

PLAN = json.loads("""{
  "doses_um": {"B1": 0.5, "B2": 1, "B3": 2, "B4": 4},
  "replicates": 3
}""")


def run(ctx):
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 1)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 2, "K562 cells")
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    vehicle = tubes["A1"]

    p20.transfer(5, vehicle, plate.columns()[0][:3], new_tip="always")
    order = sorted(PLAN["doses_um"])
    p20.pick_up_tip()
    for number, tube in enumerate(order):
        for well in plate.columns()[number + 1][: PLAN["replicates"]]:
            p20.transfer(5, tubes[tube], well, new_tip="never")
    p20.drop_tip()
