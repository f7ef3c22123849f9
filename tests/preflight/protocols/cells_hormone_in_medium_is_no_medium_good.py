# expect: cell_treatment pass
metadata = {"protocolName": "Myotubes, hormone", "apiLevel": "2.13"}
TUBES = {"A1": "plain DMEM", "A2": "glucagon in DMEM"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_filtertiprack_200ul", 1)
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", 3, "myotube cells")
    pip = ctx.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
    plain, hormone = [tubes[spot] for spot in TUBES]
    untreated, drugged = plate.columns()[0][:4], plate.columns()[1][:4]
    pip.transfer(50, hormone, drugged, new_tip="once")
    pip.transfer(50, plain, untreated, new_tip="once")
