# expect: bradford fail BRD-1
"""Lectin content of seeds by Bradford; the list comes from the balance's computer."""

metadata = {"apiLevel": "2.13"}
LIST = """
A1 A1 0    blank
A2 B1 125  BSA
A3 C1 250  BSA
A4 D1 500  BSA
A5 E1 1000 BSA
C1 A2 -    seed
C2 B2 -    seed
"""


def run(ctx):
    t20 = ctx.load_labware("opentrons_96_tiprack_20ul", 1)
    t300 = ctx.load_labware("opentrons_96_tiprack_300ul", 2)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4)
    dye = ctx.load_labware("nest_1_reservoir_195ml", 5, "Coomassie dye")["A1"]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=[t20])
    p300 = ctx.load_instrument("p300_single_gen2", "right", tip_racks=[t300])
    rows = LIST.strip().split("\n")
    p20.pick_up_tip()
    for row in rows[4::-1]:
        tube, well, ug_per_ml, _ = row.split()
        p20.transfer(5, rack[tube], plate[well], new_tip="never")
    p20.drop_tip()
    for row in rows[5:]:
        tube, well, ug_per_ml, _ = row.split()
        p20.transfer(5, rack[tube], plate[well])
    for row in rows:
        p300.transfer(250, dye, plate[row.split()[1]], mix_after=(3, 150), new_tip="always")
