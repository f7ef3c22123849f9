from opentrons.protocol_api import SINGLE, ALL, PARTIAL_COLUMN

metadata = {"protocolName": "part of an 8-channel"}
requirements = {"robotType": "OT-2", "apiLevel": "2.20"}


def run(ctx):
    tips = ctx.load_labware("opentrons_96_tiprack_300ul", "8")
    full = ctx.load_labware("opentrons_96_tiprack_300ul", "7")
    plate = ctx.load_labware("corning_96_wellplate_360ul_flat", "2")
    tubes = ctx.load_labware("opentrons_24_tuberack_nest_2ml_snapcap", "3")
    res = ctx.load_labware("nest_12_reservoir_15ml", "1")
    m300 = ctx.load_instrument("p300_multi_gen2", "right")

    m300.configure_nozzle_layout(style=SINGLE, start="H1", tip_racks=[tips])
    assert m300.active_channels == 1
    for tube, well in zip(tubes.wells(), plate.columns()[0][:4]):
        m300.transfer(50, tube, well)
    m300.configure_nozzle_layout(style=PARTIAL_COLUMN, start="H1", end="F1", tip_racks=[tips])
    assert m300.active_channels == 3
    m300.pick_up_tip()
    m300.aspirate(90, res["A2"])
    m300.dispense(90, plate["H3"])
    m300.mix(2, 40, plate["H3"])
    m300.drop_tip()
    m300.configure_nozzle_layout(style=ALL, tip_racks=[full])
    m300.transfer(100, res["A1"], plate.columns()[4:7], new_tip="once")
