# expect: cell_treatment warn CELL-2
# U2OS, 90 uL per well
#   cols 1-2  untreated
#   cols 3-4  inhibitor
#   cols 5-6  vehicle control
metadata = {"apiLevel": "2.13"}


def run(ctx):
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 5, "U2OS cells")
    trough = ctx.load_labware("nest_12_reservoir_15ml", 6)
    tips = ctx.load_labware("opentrons_96_filtertiprack_20ul", 8)
    m20 = ctx.load_instrument("p20_multi_gen2", "left", tip_racks=[tips])
    vehicle, inhibitor = trough["A1"], trough["A3"]
    column = dict(enumerate(plate.rows()[0], 1))
    for n in range(5, 6):
        m20.transfer(10, vehicle, column[n], mix_after=(2, 15))
    for n in range(3, 5):
        m20.transfer(10, inhibitor, column[n], mix_after=(2, 15))
