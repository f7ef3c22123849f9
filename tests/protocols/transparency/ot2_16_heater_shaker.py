metadata = {'protocolName': 'heater-shaker lysis', 'apiLevel': '2.16'}
requirements = {'robotType': 'OT-2'}


def run(ctx):
    hs = ctx.load_module('heaterShakerModuleV1', 1)
    adapter = hs.load_adapter('opentrons_96_deep_well_adapter')
    plate = adapter.load_labware('nest_96_wellplate_2ml_deep')
    tips = ctx.load_labware('opentrons_96_tiprack_300ul', 5)
    reagents = ctx.load_labware('nest_12_reservoir_15ml', 3)
    p300 = ctx.load_instrument('p300_single_gen2', 'left', tip_racks=[tips])

    hs.open_labware_latch()
    ctx.pause('place the plate')
    hs.close_labware_latch()
    hs.set_and_wait_for_temperature(37)
    for well in plate.columns()[6]:
        p300.transfer(200, reagents['A1'], well.top(-10), blow_out=True, blowout_location='destination well')
    hs.set_and_wait_for_shake_speed(rpm=800)
    ctx.delay(minutes=3, seconds=30)
    hs.deactivate_shaker()
    p300.transfer(100, plate.columns()[6], plate.columns()[7], new_tip='always', mix_before=(2, 90))
    hs.deactivate_heater()
