metadata = {'apiLevel': '2.0', 'protocolName': 'every option of transfer'}


def run(ctx):
    tips = [ctx.load_labware('opentrons_96_tiprack_300ul', s) for s in ('1', '2')]
    plate = ctx.load_labware('corning_96_wellplate_360ul_flat', '3')
    trough = ctx.load_labware('usascientific_12_reservoir_22ml', '4')
    p300 = ctx.load_instrument('p300_single', 'left', tip_racks=tips)

    p300.transfer(100, trough['A1'], plate.columns()[0])
    p300.transfer(100, trough['A1'], plate.columns()[1], new_tip='always', touch_tip=True)
    p300.transfer(80, plate.columns()[0][:4], plate.columns()[2][:4], air_gap=20, blow_out=True)
    p300.transfer([30, 60, 90, 120], trough.wells()[:4], plate.rows()[0][4:8], mix_before=(2, 100))
    p300.transfer([30, 120] * 4, trough['A2'], plate.columns()[8], mix_after=(3, 50))
    p300.transfer(700, trough['A3'], plate['A10'].top(), carryover=True)
    p300.transfer(50, trough['A1'], plate['H12'].bottom(3), trash=False)
    p300.pick_up_tip()
    p300.transfer(40, trough['A4'], plate.columns()[10], new_tip='never', rate=0.5)
    p300.transfer(0, trough['A4'], plate['A11'], new_tip='never')
    p300.drop_tip()
    p300.home()
