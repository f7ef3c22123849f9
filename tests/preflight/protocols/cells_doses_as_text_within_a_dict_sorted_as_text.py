# expect: cell_treatment fail CELL-4
"""Two interferons on fibroblasts in ng/mL, each with one tip from the lowest dose up."""

metadata = {"apiLevel": "2.14", "protocolName": "interferons"}

INTERFERONS = {
    "alpha": {"0.5": "A1", "2": "B1", "10": "C1", "50": "D1"},
    "gamma": {"0.5": "A2", "2": "B2", "10": "C2", "50": "D2"},
}
ROWS = {"alpha": "ABC", "gamma": "DEF"}
COLUMN = {"0.5": 6, "2": 7, "10": 8, "50": 9}


def run(ctx):
    cells = ctx.load_labware("corning_96_wellplate_360ul_flat", 8, "fibroblasts")
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 9, "interferons")
    medium = ctx.load_labware("nest_1_reservoir_195ml", 5, "vehicle: medium with BSA")["A1"]
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 10)
    p300 = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    vehicle_wells = [cells[f"{row}5"] for row in "ABCDEF"]

    p300.transfer(25, medium, vehicle_wells)
    for name, tubes in INTERFERONS.items():
        p300.pick_up_tip()
        for dose in sorted(tubes):
            for row in ROWS[name]:
                p300.aspirate(25, rack[tubes[dose]])
                p300.dispense(25, cells[f"{row}{COLUMN[dose]}"])
        p300.drop_tip()
