"""
Plate map (slot 1, flat bottom):

           1       2       3
    A    800      K1      K4
    B    400      K2      K5
    C    200      K3      K6
    D      0

  figures: albumin in ug/mL (0 = blank, PBS); K = unknown
Tubes (slot 4): at the places of the map, 120 uL each
Bradford reagent: 50 mL tube A1 of the rack in slot 5
"""

metadata = {"apiLevel": "2.14"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 1)
    rack = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 4)
    big = ctx.load_labware("opentrons_6_tuberack_falcon_50ml_conical", 5)
    p20 = ctx.load_instrument(
        "p20_single_gen2", "left", tip_racks=[ctx.load_labware("opentrons_96_tiprack_20ul", 10)]
    )
    p300 = ctx.load_instrument(
        "p300_single_gen2", "right", tip_racks=[ctx.load_labware("opentrons_96_tiprack_300ul", 11)]
    )
    p20.pick_up_tip()
    for n in ("A1", "B1", "C1", "D1"):
        p20.transfer(10, rack[n], plate[n], new_tip="never")
    p20.drop_tip()
    for n in ("A2", "B2", "C2", "A3", "B3", "C3"):
        p20.transfer(10, rack[n], plate[n], new_tip="always")
    for n in ("A1", "B1", "C1", "D1", "A2", "B2", "C2", "A3", "B3", "C3"):
        p300.transfer(200, big["A1"], plate[n], mix_after=(3, 120), new_tip="always")
