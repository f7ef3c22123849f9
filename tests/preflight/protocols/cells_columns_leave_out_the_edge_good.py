# expect: cell_treatment pass
metadata = {"protocolName": "Keratinocytes and arsenite", "apiLevel": "2.13"}
VEHICLE_COLUMNS = [3, 4]
ARSENITE_COLUMNS = [5, 6, 7, 8]


def run(ctx):
    tips = [ctx.load_labware("opentrons_96_filtertiprack_200ul", slot) for slot in (1, 2)]
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 3)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 4, "keratinocytes")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=tips)
    vehicle, drug = tubes["A1"], tubes["B1"]
    for number in VEHICLE_COLUMNS:
        for well in plate.columns()[number - 1][1:7]:
            pip.transfer(10, vehicle, well, new_tip="always")
    for number in ARSENITE_COLUMNS:
        for well in plate.columns()[number - 1][1:7]:
            pip.transfer(10, drug, well, new_tip="always")
