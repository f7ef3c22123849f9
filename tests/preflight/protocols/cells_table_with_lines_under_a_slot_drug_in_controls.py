# expect: cell_treatment warn CELL-1 CELL-2
# +------+--------------------+---------------+----------+
# | Slot | Material           | Wells         | Volume   |
# +======+====================+===============+==========+
# | 3    | solvent (ethanol)  | A1            | 2 mL     |
# |      | estradiol 10 nM    | B1            | 2 mL     |
# |      | estradiol 100 nM,  | B2            | 2 mL     |
# |      |   made fresh       |               |          |
# +------+--------------------+---------------+----------+
# | 5    | vehicle controls   | columns 3, 4  | 180 uL   |
# |      | estradiol, low     | columns 5, 6  | 180 uL   |
# |      | estradiol, high    | columns 7, 8  | 180 uL   |
# +------+--------------------+---------------+----------+
metadata = {"protocolName": "Estradiol on MCF-7", "apiLevel": "2.13"}


def run(ctx):
    b = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", 3)
    m = ctx.load_labware("corning_96_wellplate_360ul_flat", 5)
    racks = [ctx.load_labware("opentrons_96_tiprack_20ul", slot) for slot in (8, 9)]
    p20 = ctx.load_instrument("p20_single_gen2", "left", tip_racks=racks)
    for tube, first in (("B1", 2), ("A1", 4), ("B2", 6)):
        for column in m.columns()[first : first + 2]:
            for well in column:
                p20.pick_up_tip()
                p20.aspirate(20, b[tube])
                p20.dispense(20, well)
                p20.drop_tip()
